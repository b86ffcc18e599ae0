// SPDX-License-Identifier: MIT
#include "plot/drawing/panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plot/drawing/letters.hpp"

namespace stipple::plot {
namespace {

constexpr double mark = 4;        ///< length of the marks at numbers
constexpr double small_mark = 2;  ///< between them
constexpr double gap = 10;        ///< at least, between numbers side by side
constexpr double capital = 0.714 * number_size;

/// The middle of a number's text, that many units from the axis's start.
double middle_of(const Axis& axis, const Tick& tick, double length) {
    const double at = axis.share(tick.value) * length;
    const double half = text_width(tick.text, number_size) / 2;
    return axis.tight && length > 2 * half ? std::clamp(at, half, length - half) : at;
}

/// Whether numbers side by side keep their distance.
bool fit(const Axis& axis, const Ticks& ticks, double length) {
    double end = -1e9;
    for (const Tick& tick : ticks.numbers) {
        const double middle = middle_of(axis, tick, length);
        const double half = text_width(tick.text, number_size) / 2;
        if (middle - half < end + gap) return false;
        end = middle + half;
    }
    return true;
}

/// "frequency (×10³)"
std::string full_name(const Axis& axis, const Ticks& ticks) {
    if (ticks.exponent == 0) return axis.name;
    const std::string factor = fmt::format("×{}", power_of_ten(ticks.exponent));
    return axis.name.empty() ? factor : fmt::format("{} ({})", axis.name, factor);
}

/// The left side and the lower one; closed: all four.
void draw_sides(Drawing& drawing, const Area& area, Colour colour, bool closed) {
    const double right = area.right();
    const double bottom = area.bottom();
    // One unit further, so that the corners are whole.
    drawing.line({area.left, area.top}, {area.left, bottom + 1}, colour);
    drawing.line({area.left, bottom}, {right + 1, bottom}, colour);
    if (!closed) return;
    drawing.line({right, area.top}, {right, bottom + 1}, colour);
    drawing.line({area.left, area.top}, {right + 1, area.top}, colour);
}

}  // namespace

Ticks Axis::ticks(double length, bool upright) const {
    if (!words.empty()) {
        const double room = length / static_cast<double>(words.size()) - gap / 2;
        Ticks found;
        for (const std::string& word : words)
            found.numbers.push_back({.value = static_cast<double>(found.numbers.size() + 1),
                                     .text = cut_to(word, number_size, room)});
        return found;
    }
    const double room = upright ? 34 : 44;
    auto most = static_cast<std::size_t>(std::clamp(length / room, 2.0, 11.0));
    for (;; --most) {
        Ticks found = log && binary ? binary_ticks(low, high, most)
                      : log         ? log_ticks(low, high, most)
                                    : linear_ticks(low, high, most, whole);
        if (upright || most <= 2 || fit(*this, found, length)) return found;
    }
}

double Axis::share(double value) const {
    if (!log) return (value - low) / (high - low);
    const double bottom = std::log(low);
    return (std::log(std::max(value, 1e-300)) - bottom) / (std::log(high) - bottom);
}

void Axis::make_valid() {
    if (!std::isfinite(low) || !std::isfinite(high)) {
        low = log ? 0.1 : 0;
        high = 1;
    }
    if (log && low <= 0) low = high > 0 ? high * 1e-6 : 0.1;
    if (low < high) return;
    if (log) {
        high = low * 2;
        low /= 2;
        return;
    }
    const double reach = low == 0 ? 0.5 : 0.5 * std::abs(low);
    high = low + reach;
    low -= reach;
}

Panel::Panel(const Area& frame, Axis x, Axis y)
    : frame_(frame), x_(std::move(x)), y_(std::move(y)) {
    x_.make_valid();
    y_.make_valid();
    x_ticks_ = x_.ticks(frame_.width, false);
    y_ticks_ = y_.ticks(frame_.height, true);
}

double Panel::x(double value) const { return frame_.left + x_.share(value) * frame_.width; }

double Panel::y(double value) const { return frame_.bottom() - y_.share(value) * frame_.height; }

double Panel::room_left(const Axis& y, double height) {
    Axis axis = y;
    axis.make_valid();
    double widest = 0;
    for (const Tick& tick : axis.ticks(height, true).numbers)
        widest = std::max(widest, text_width(tick.text, number_size));
    return widest + mark + 6 + (y.name.empty() ? 0 : name_size + 10);
}

double Panel::room_below(const Axis& x) {
    return (x.numbers ? mark + number_size + 6 : mark) + (x.name.empty() ? 0 : name_size + 8);
}

void Panel::draw_grid(Drawing& drawing, const Theme& theme) const {
    for (const Tick& tick : x_ticks_.numbers)
        drawing.line({x(tick.value), frame_.top}, {x(tick.value), frame_.bottom()}, theme.grid);
    for (const Tick& tick : y_ticks_.numbers)
        drawing.line({frame_.left, y(tick.value)}, {frame_.right(), y(tick.value)}, theme.grid);
}

void Panel::draw_x(Drawing& drawing, const Theme& theme) const {
    const double bottom = frame_.bottom();
    for (const double value : x_ticks_.minor)
        drawing.line({x(value), bottom}, {x(value), bottom + small_mark}, theme.frame);
    for (const Tick& tick : x_ticks_.numbers) {
        const double at = x(tick.value);
        drawing.line({at, bottom}, {at, bottom + mark}, theme.frame);
        const double middle = frame_.left + middle_of(x_, tick, frame_.width);
        if (x_.numbers)
            drawing.add(Label{.text = tick.text,
                              .at = {middle, bottom + mark + 4 + capital},
                              .size = number_size,
                              .colour = theme.text,
                              .anchor = Anchor::middle});
    }
    const std::string name = full_name(x_, x_ticks_);
    if (!x_.numbers || name.empty()) return;
    drawing.add(
        Label{.text = name,
              .at = {frame_.left + frame_.width / 2, bottom + mark + number_size + 6 + name_size},
              .size = name_size,
              .colour = theme.ink,
              .anchor = Anchor::middle});
}

void Panel::draw_y(Drawing& drawing, const Theme& theme) const {
    const double left = frame_.left;
    for (const double value : y_ticks_.minor)
        drawing.line({left - small_mark, y(value)}, {left, y(value)}, theme.frame);
    double widest = 0;
    for (const auto& [value, text] : y_ticks_.numbers) {
        drawing.line({left - mark, y(value)}, {left, y(value)}, theme.frame);
        if (!y_.numbers) continue;
        double base = y(value) + capital / 2;
        if (y_.tight) base = std::clamp(base, frame_.top + capital, frame_.bottom());
        drawing.add(Label{.text = text,
                          .at = {left - mark - 4, base},
                          .size = number_size,
                          .colour = theme.text,
                          .anchor = Anchor::end});
        widest = std::max(widest, text_width(text, number_size));
    }
    const std::string name = full_name(y_, y_ticks_);
    if (!y_.numbers || name.empty()) return;
    drawing.add(Label{.text = cut_to(name, name_size, frame_.height + 6),
                      .at = {left - mark - 4 - widest - 9, frame_.top + frame_.height / 2},
                      .size = name_size,
                      .colour = theme.ink,
                      .anchor = Anchor::middle,
                      .upward = true});
}

void Panel::draw_axes(Drawing& drawing, const Theme& theme, bool closed) const {
    draw_x(drawing, theme);
    draw_y(drawing, theme);
    draw_sides(drawing, frame_, theme.frame, closed);
}

void draw_colour_bar(Drawing& drawing, const Area& area, const std::string& name,
                     const Theme& theme, const std::function<Colour(double)>& colour,
                     const std::vector<Tick>& ticks) {
    constexpr std::size_t levels = 256;
    PixelImage bar{.area = area, .columns = 1, .rows = levels};
    for (std::size_t i = 0; i < levels; ++i)
        bar.pixels.push_back(colour(1 - static_cast<double>(i) / static_cast<double>(levels - 1)));
    drawing.add(std::move(bar));
    draw_sides(drawing, area, theme.frame, true);
    const double right = area.right();
    for (const auto& [share, text] : ticks) {
        const double y = area.bottom() - share * area.height;
        drawing.line({right, y}, {right + 4, y}, theme.frame);
        drawing.add(Label{.text = text,
                          .at = {right + 8, y + 0.36 * number_size},
                          .size = number_size,
                          .colour = theme.text});
    }
    drawing.add(Label{.text = name,
                      .at = {right, area.top - 8},
                      .size = number_size,
                      .colour = theme.ink,
                      .anchor = Anchor::middle});
}

}  // namespace stipple::plot
