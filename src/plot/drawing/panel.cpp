// SPDX-License-Identifier: MIT
#include "plot/drawing/panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/text.hpp"
#include "plot/drawing/letters.hpp"

namespace stipple::plot {
namespace {

constexpr double mark = 4;        ///< length of tick marks at numbers
constexpr double small_mark = 2;  ///< length of tick marks between numbers
constexpr double gap = 10;        ///< minimum space between neighbouring numbers
constexpr double capital = 0.714 * number_size;

constexpr double number_row = number_size + 2;
constexpr double name_row = name_size + 2;
constexpr double farthest = 1e5;  ///< limit for positions, in units; anything beyond is invisible

/// The width of a text's widest line.
double block_width(const std::string& text) {
    double widest = 0;
    for (const auto line : split(text, '\n'))
        widest = std::max(widest, text_width(line, number_size));
    return widest;
}

double rows_of(const std::string& text) {
    return static_cast<double>(std::ranges::count(text, '\n') + 1);
}

/// Adds a tick's text. Words may have several lines, the last of them at the label's position.
void add_text(Drawing& drawing, const Label& label) {
    std::vector<std::string> lines;
    for (const auto line : split(label.text, '\n')) lines.emplace_back(line);
    add_lines(drawing, label, lines, number_row);
}

/// Position of the middle of a number's text, in units from the axis's start. The text may extend
/// slightly beyond the ends, unless another frame is next to the axis.
double middle_of(const Axis& axis, const Tick& tick, double length) {
    constexpr double beyond = 20;  // units; less than the margins of pictures
    const double at = axis.share(tick.value) * length;
    const double inside = block_width(tick.text) / 2 - (axis.tight ? 0 : beyond);
    return length > 2 * inside ? std::clamp(at, inside, length - inside) : at;
}

/// Whether all neighbouring numbers have enough space between them.
bool fit(const Axis& axis, const Ticks& ticks, double length) {
    double end = -1e9;
    for (const Tick& tick : ticks.numbers) {
        const double middle = middle_of(axis, tick, length);
        const double half = block_width(tick.text) / 2;
        if (middle - half < end + gap) return false;
        end = middle + half;
    }
    return true;
}

/// Name of the axis, with the factor of its numbers: "frequency (×10³)".
std::string full_name(const Axis& axis, const Ticks& ticks) {
    if (ticks.exponent == 0) return axis.name;
    const std::string factor = fmt::format("×{}", power_of_ten(ticks.exponent));
    return axis.name.empty() ? factor : fmt::format("{} ({})", axis.name, factor);
}

double room_of_numbers(const Ticks& ticks) {
    double rows = 1;
    for (const Tick& tick : ticks.numbers) rows = std::max(rows, rows_of(tick.text));
    return rows * number_row;
}

/// The axis's name wrapped to the axis's length.
std::vector<std::string> rows_of_name(const Axis& axis, const Ticks& ticks, double length) {
    return wrapped(full_name(axis, ticks), name_size, length);
}

/// Height of the name's rows, plus `space` before them; 0 if no name is drawn.
double room_of_name(const Axis& axis, const Ticks& ticks, double length, double space) {
    const auto rows = static_cast<double>(rows_of_name(axis, ticks, length).size());
    return axis.numbers && rows > 0 ? name_row * rows + space : 0;
}

/// Words as tick labels; only every second, third, ... word if there is not enough space.
Ticks ticks_of_words(const Axis& axis, double length, bool upright) {
    constexpr double widest = 110;
    const double pitch = length / (axis.high - axis.low);  // distance between words
    const double least = upright ? number_row : 24;
    const double stride = std::max(1.0, std::ceil(least / pitch));
    const double room = upright ? widest : std::max(least, stride * pitch) - gap / 2;
    Ticks found;
    for (std::size_t i = 0; i < axis.words.size(); ++i) {
        const double value = axis.first_word + static_cast<double>(i);
        if (std::fmod(static_cast<double>(i), stride) == 0)
            found.numbers.push_back(
                {value, join(wrapped(axis.words[i], number_size, room, false, true), "\n")});
        else
            found.minor.push_back(value);
    }
    return found;
}

/// Draws the left and lower side; if `closed`, all four.
void draw_sides(Drawing& drawing, const Area& area, Colour colour, bool closed) {
    const double right = area.right();
    const double bottom = area.bottom();
    // Lines are one unit longer, to fill the corners.
    drawing.line({area.left, area.top}, {area.left, bottom + 1}, colour);
    drawing.line({area.left, bottom}, {right + 1, bottom}, colour);
    if (!closed) return;
    drawing.line({right, area.top}, {right, bottom + 1}, colour);
    drawing.line({area.left, area.top}, {right + 1, area.top}, colour);
}

}  // namespace

std::optional<std::size_t> cell_at(double share, std::size_t cells) {
    constexpr double slack = 1e-9;  // positions are rounded
    const double at = share * static_cast<double>(cells) + slack;
    if (!(at >= 0 && at <= static_cast<double>(cells) + 2 * slack)) return std::nullopt;
    return std::min(static_cast<std::size_t>(at), cells - 1);
}

Ticks Axis::ticks(double length, bool upright) const {
    if (!words.empty()) return ticks_of_words(*this, length, upright);
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
    const auto up_from_low = [this](double x) {  // log(x / low) resolves small differences
        const double ratio = x / low;
        return std::isfinite(ratio) ? std::log(ratio) : std::log(x) - std::log(low);
    };
    return up_from_low(std::max(value, least_shown)) / up_from_low(high);
}

void Axis::make_valid(int digits) {
    if (!std::isfinite(low) || !std::isfinite(high)) {
        low = log ? 0.1 : 0;
        high = 1;
    }
    if (low > high) std::swap(low, high);
    if (log && low <= 0) low = high > 0 ? high * 1e-6 : 0.1;
    if (log) {
        low = std::max(low, least_shown);
        high = std::max(high, least_shown);
    }
    if (const std::string flaw = flaw_of_range(low, high, digits); !flaw.empty())
        name += fmt::format("{}({})", name.empty() ? "" : " ", flaw);
    else if (low < high)
        return;
    if (log) {
        low = std::max(low / 2, least_shown);
        high = low * 4;
        return;
    }
    std::tie(low, high) = visible_range(low, high, digits);
}

Panel::Panel(const Area& frame, Axis x, Axis y)
    : frame_(frame), x_(std::move(x)), y_(std::move(y)) {
    x_.make_valid();
    y_.make_valid();
    x_ticks_ = x_.ticks(frame_.width, false);
    y_ticks_ = y_.ticks(frame_.height, true);
}

double Panel::x(double value) const {
    return std::clamp(frame_.left + x_.share(value) * frame_.width, -farthest, farthest);
}

double Panel::y(double value) const {
    return std::clamp(frame_.bottom() - y_.share(value) * frame_.height, -farthest, farthest);
}

double Panel::room_left(const Axis& y, double height) {
    Axis axis = y;
    axis.make_valid();
    const Ticks found = axis.ticks(height, true);
    double widest = 0;
    for (const Tick& tick : found.numbers) widest = std::max(widest, block_width(tick.text));
    return widest + mark + 6 + room_of_name(axis, found, height, 8);
}

double Panel::room_below(const Axis& x, double width) {
    Axis axis = x;
    axis.make_valid();
    const Ticks found = axis.ticks(width, false);
    return mark + (x.numbers ? room_of_numbers(found) + 4 : 0) +
           room_of_name(axis, found, width, 6);
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
            add_text(drawing, {.text = tick.text,
                               .at = {middle, bottom + mark + 4 + capital +
                                                  number_row * (rows_of(tick.text) - 1)},
                               .size = number_size,
                               .colour = theme.text,
                               .anchor = Anchor::middle});
    }
    const auto name = rows_of_name(x_, x_ticks_, frame_.width);
    if (!x_.numbers || name.empty()) return;
    const double end =
        bottom + mark + 4 + room_of_numbers(x_ticks_) + name_row * static_cast<double>(name.size());
    add_lines(drawing,
              {.text = {},
               .at = {frame_.left + frame_.width / 2, end - 2},
               .size = name_size,
               .colour = theme.ink,
               .anchor = Anchor::middle},
              name, name_row);
}

void Panel::draw_y(Drawing& drawing, const Theme& theme) const {
    const double left = frame_.left;
    for (const double value : y_ticks_.minor)
        drawing.line({left - small_mark, y(value)}, {left, y(value)}, theme.frame);
    double widest = 0;
    for (const auto& [value, text] : y_ticks_.numbers) {
        drawing.line({left - mark, y(value)}, {left, y(value)}, theme.frame);
        if (!y_.numbers) continue;
        double base = y(value) + capital / 2 + number_row * (rows_of(text) - 1) / 2;
        if (y_.tight) base = std::clamp(base, frame_.top + capital, frame_.bottom());
        add_text(drawing, {.text = text,
                           .at = {left - mark - 4, base},
                           .size = number_size,
                           .colour = theme.text,
                           .anchor = Anchor::end});
        widest = std::max(widest, block_width(text));
    }
    if (!y_.numbers) return;
    add_lines(drawing,
              {.text = {},
               .at = {left - mark - 4 - widest - 9, frame_.top + frame_.height / 2},
               .size = name_size,
               .colour = theme.ink,
               .anchor = Anchor::middle,
               .upward = true},
              rows_of_name(y_, y_ticks_, frame_.height), name_row);
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
    if (name.empty()) return;
    drawing.add(Label{.text = name,
                      .at = {right, area.top - 8},
                      .size = number_size,
                      .colour = theme.ink,
                      .anchor = Anchor::middle});
}

}  // namespace stipple::plot
