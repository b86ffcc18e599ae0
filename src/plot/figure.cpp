// SPDX-License-Identifier: MIT
#include "plot/figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "core/error.hpp"
#include "core/text.hpp"
#include "plot/drawing/letters.hpp"

namespace stipple::plot {
namespace {

/// Whether the texts are within the drawing, and whether none covers another.
struct Legibility {
    bool inside = true;
    bool apart = true;

    explicit Legibility(const Drawing& drawing) {
        std::vector<Area> texts;
        for (const Shape& shape : drawing.shapes) {
            const auto* label = std::get_if<Label>(&shape);
            if (label == nullptr) continue;
            const Area a = room_of(*label);
            inside = inside && a.left >= 0 && a.top >= 0 && a.right() <= drawing.width &&
                     a.bottom() <= drawing.height;
            apart = apart && std::ranges::none_of(texts, [&](const Area& b) {
                        constexpr double slack = 3;  // space around letters
                        return std::min(a.right(), b.right()) - std::max(a.left, b.left) > slack &&
                               std::min(a.bottom(), b.bottom()) - std::max(a.top, b.top) > slack;
                    });
            texts.push_back(a);
        }
    }
};

using Draw = std::function<Drawing(const PictureStyle&)>;

constexpr double least_scale = 0.5;  // smallest scale with legible letters

/// A drawing in a style. `fits`: it has the style's size and all texts are inside.
struct Trial {
    Drawing drawing;
    bool fits;
    bool apart;

    Trial(const Draw& draw, const PictureStyle& style) : drawing(draw(style)) {
        const auto fits_in = [](double& size, double room) {
            if (room > 0 && size < room + 1) size = std::min(size, room);  // sizes are rounded up
            return room <= 0 || size <= room;
        };
        const bool wide = fits_in(drawing.width, style.width);
        const bool high = fits_in(drawing.height, style.height);
        const Legibility text(drawing);
        fits = wide && high && text.inside;
        apart = text.apart;
    }
};

/// Rejects the requested size, naming a larger one that was tried.
[[noreturn]] void refuse_size(const PictureStyle& asked, PictureStyle larger, const Draw& draw) {
    const auto in_pixels = [&larger](double size) { return std::ceil(size * larger.scale - 1e-9); };
    do {
        larger.width = in_pixels(1.05 * larger.width) / larger.scale;
        larger.height = in_pixels(1.05 * larger.height) / larger.scale;
    } while (in_pixels(larger.width + larger.height) < 1e5 && !Trial(draw, larger).fits);
    const char* names[] = {"width", "height"};
    const double sizes[] = {asked.width, asked.height};
    const double needed[] = {larger.width, larger.height};
    std::vector<std::string> given, enough;
    for (int k = 0; k < 2; ++k)
        if (sizes[k] > 0) {
            given.push_back(fmt::format("--{}: {:.0f}", names[k], sizes[k] * asked.scale));
            enough.push_back(fmt::format("{:.0f}", in_pixels(needed[k])));
        }
    const bool both = given.size() == 2;
    fail(ErrorKind::usage, "{} {} no room for the picture; at least {} {}", join(given, " and "),
         both ? "leave" : "leaves", join(enough, " and "), both ? "do" : "does");
}

/// Translates shapes of every kind.
struct Mover {
    double right;
    double down;

    void move(Position& position) const {
        position.x += right;
        position.y += down;
    }
    void move(Area& area) const {
        area.left += right;
        area.top += down;
    }
    void operator()(Line& line) const {
        for (Position& vertex : line.vertices) move(vertex);
    }
    void operator()(Patch& patch) const {
        for (Position& vertex : patch.vertices) move(vertex);
    }
    void operator()(Disks& disks) const {
        for (Position& centre : disks.centres) move(centre);
    }
    void operator()(Label& label) const { move(label.at); }
    void operator()(PixelImage& image) const { move(image.area); }
    void operator()(ClipWindow& window) const { move(window.area); }
    void operator()(SvgGroup&) const {}
};

void add_moved(Drawing& drawing, Drawing part, double right, double down) {
    for (Shape& shape : part.shapes) std::visit(Mover{right, down}, shape);
    std::ranges::move(part.shapes, std::back_inserter(drawing.shapes));
}

/// Number of columns for `parts` drawings that are about square. If `ratio` is the sheet's width
/// over height, chooses the number that makes the drawings largest. If `ratio` is 0: one row for up
/// to three drawings, otherwise two, three or four columns.
std::size_t sheet_columns(std::size_t parts, double ratio) {
    if (ratio > 0) {
        const auto rows_of = [parts](std::size_t columns) {
            return (parts + columns - 1) / columns;
        };
        std::size_t best = 1;
        double largest = 0;
        for (std::size_t columns = 1; columns <= parts; ++columns) {
            const std::size_t rows = rows_of(columns);
            const double side =
                std::min(ratio / static_cast<double>(columns), 1 / static_cast<double>(rows));
            if (side > largest || (side == largest && rows < rows_of(best))) best = columns;
            largest = std::max(largest, side);
        }
        return best;
    }
    if (parts <= 3) return parts;
    return parts == 4 ? 2 : parts <= 9 ? 3 : 4;
}

/// Adds parts in rows below `top`, from the left, and enlarges the drawing as needed.
void add_rows(Drawing& drawing, std::vector<Drawing> parts, std::size_t columns, double top) {
    double down = top;
    for (std::size_t first = 0; first < parts.size(); first += columns) {
        double right = 0;
        double highest = 0;
        for (std::size_t i = first; i < std::min(first + columns, parts.size()); ++i) {
            const double width = parts[i].width;
            highest = std::max(highest, parts[i].height);
            add_moved(drawing, std::move(parts[i]), right, down);
            right += width;
        }
        drawing.width = std::max(drawing.width, right);
        down += highest;
    }
    drawing.height = down;
}

/// Increases a drawing's height to `height`, centring its content; higher drawings are unchanged.
void fill_height(Drawing& drawing, double height) {
    const double more = height - drawing.height;
    if (!(more > 0)) return;
    for (Shape& shape : drawing.shapes) std::visit(Mover{0, std::floor(more / 2)}, shape);
    drawing.height = height;
}

/// Arrangement of frames on a sheet.
struct Places {
    std::size_t columns;
    double across;  ///< number of columns, as a floating-point number
    double rows;
    double usual;  ///< usual width and height of a frame
    double more;   ///< additional width of the last frame in each row, for a colour bar

    Places(std::span<const Frame> frames, const PictureStyle& style)
        : columns(sheet_columns(
              frames.size(), style.width > 0 && style.height > 0 ? style.width / style.height : 0)),
          across(static_cast<double>(columns)),
          rows(std::ceil(static_cast<double>(frames.size()) / across)),
          usual(columns <= 2   ? 400
                : columns == 3 ? 330
                               : 280),
          more(std::ranges::any_of(frames, &Frame::bar) ? colour_bar_room - picture_margin / 2
                                                        : 0) {}

    [[nodiscard]] double usual_width() const { return usual * across + more; }
};

/// Arranges the frames below the title of the style.
Drawing sheet_of(std::span<const Frame> frames, PictureStyle style) {
    constexpr double least_width = 150;
    constexpr double least_height = 200;
    const Places places(frames, style);
    const bool untitled = style.title.value_or("").empty();
    PictureStyle titles = style;
    titles.letter.reset();
    auto [drawing, top] = titled_drawing("", "", titles, places.usual_width());
    if (untitled) top = 0;
    if (!style.title || !untitled) style.title.reset();  // the title "" hides those of frames
    const double width =
        std::max(std::floor((drawing.width - places.more) / places.across), least_width);
    if (style.height > 0)
        style.height = std::max(std::floor((style.height - top) / places.rows), least_height);
    std::vector<Drawing> drawn;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const bool last = i + 1 == frames.size() || (i + 1) % places.columns == 0;
        style.width = width + (last ? places.more : 0);
        drawn.push_back(frames[i].draw(style, last));
        if (style.letter) *style.letter += frames[i].panels;
    }
    add_rows(drawing, std::move(drawn), places.columns, top);
    return std::move(drawing);
}

/// Chooses the scale at which frames of the usual size fit the requested size.
void fit_to_frames(std::span<const Frame> frames, PictureStyle& style) {
    const double across = style.width * style.scale;
    const double upward = style.height * style.scale;
    if (!(across > 0 || upward > 0)) return;
    constexpr double least = 0.6;
    const Places places(frames, style);
    const double scale = std::min(across > 0 ? across / places.usual_width() : HUGE_VAL,
                                  upward > 0 ? upward / (places.usual * places.rows) : HUGE_VAL);
    style.scale = std::max(least, scale);
    style.width = across / style.scale;
    style.height = upward / style.scale;
}

/// Removes the letter of a single panel.
void take_letters(std::span<const Frame> frames, PictureStyle& style) {
    if (frames.size() == 1 && frames[0].panels == 1) style.letter.reset();
}

}  // namespace

Drawing fitted(PictureStyle& style, const Draw& draw) {
    constexpr double step = 0.85;
    constexpr int most = 12;
    const PictureStyle asked = style;
    const bool requested = asked.width > 0 || asked.height > 0;
    // First trial in which only texts overlap.
    std::optional<std::pair<Drawing, PictureStyle>> crowded;
    for (int round = 0;; ++round) {
        Trial trial(draw, style);
        if (trial.fits && trial.apart) return std::move(trial.drawing);
        if (trial.fits && !crowded) crowded.emplace(trial.drawing, style);
        const bool last = requested ? style.scale <= least_scale : round == most;
        if (last && crowded) {
            style = crowded->second;
            return std::move(crowded->first);
        }
        if (last && !requested) return std::move(trial.drawing);
        if (last) refuse_size(asked, style, draw);
        if (!requested) {
            style.width = std::ceil(trial.drawing.width / step);
            continue;
        }
        const double smaller = std::max(step * style.scale, least_scale);
        style.width *= style.scale / smaller;
        style.height *= style.scale / smaller;
        style.scale = smaller;
    }
}

Drawing draw_figure(std::span<const Frame> frames, PictureStyle& style) {
    take_letters(frames, style);
    const bool single = frames.size() == 1;
    if (!single) fit_to_frames(frames, style);
    Drawing drawing = fitted(style, [&](const PictureStyle& s) {
        return single ? frames[0].draw(s, true) : sheet_of(frames, s);
    });
    fill_height(drawing, style.height);
    return drawing;
}

std::string figure_as_text(std::span<const Frame> frames, PictureStyle style,
                           const TextRoom& room) {
    take_letters(frames, style);
    const auto line = [](const std::string& title) {
        return title.empty() ? "" : printable(title) + "\n";
    };
    const bool single = frames.size() == 1;
    const std::string title = line(style.title.value_or(single ? frames[0].title : ""));
    TextRoom part = single ? room : shared_room(room, frames.size());
    part.letter = style.letter;
    if (single) return title + frames[0].write(part);
    std::vector<std::string> written;
    for (const Frame& frame : frames) {
        const bool untitled = style.title && style.title->empty();
        written.push_back(line((frame.panels == 1 ? letter_of(part.letter) : "") +
                               (untitled ? "" : frame.title)) +
                          frame.write(part));
        if (part.letter) *part.letter += frame.panels;
    }
    return title + side_by_side(written, room);
}

}  // namespace stipple::plot
