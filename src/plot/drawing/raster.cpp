// SPDX-License-Identifier: MIT
//
// Rasterizer of drawings. The fraction of a pixel that a shape covers is
//
//     lines and disks   w / 2 + 1/2 - distance of the pixel's centre, clamped to [0, 1],
//     patches           the mean over four rows in the pixel, each exact along x,
//
// where w is the width or diameter in pixels. Colours are blended by this fraction.
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/text.hpp"
#include "media/png_picture.hpp"
#include "plot/drawing/drawing.hpp"
#include "plot/drawing/letters.hpp"

namespace stipple::plot {
namespace {

/// Rectangle of pixels from (left, top) up to, but not including, (right, bottom).
struct Pixels {
    int left = 0;
    int top = 0;
    int right = 0;
    int bottom = 0;
};

constexpr double most_pixels = 2.5e8;

/// Index of a pixel, clamped to a range far beyond any picture.
int pixel(double x) { return static_cast<int>(std::clamp(x, -1e6, 1e6)); }

double squared_distance(Position p, Position a, Position b) {
    const double dx = b.x - a.x;
    const double dy = b.y - a.y;
    const double length = dx * dx + dy * dy;
    double t = length > 0 ? ((p.x - a.x) * dx + (p.y - a.y) * dy) / length : 0;
    t = std::clamp(t, 0.0, 1.0);
    const double x = a.x + t * dx - p.x;
    const double y = a.y + t * dy - p.y;
    return x * x + y * y;
}

/// The dashes of a line; `on` and `off` are the lengths of dashes and gaps, in units of the
/// drawing.
std::vector<std::vector<Position>> dashes_of(const std::vector<Position>& vertices, double on,
                                             double off) {
    std::vector<std::vector<Position>> dashes;
    double left = on;
    bool drawn = true;
    dashes.push_back({vertices[0]});
    for (std::size_t i = 1; i < vertices.size(); ++i) {
        Position at = vertices[i - 1];
        double length = std::hypot(vertices[i].x - at.x, vertices[i].y - at.y);
        while (length > left) {
            const double share = left / length;
            at = {at.x + share * (vertices[i].x - at.x), at.y + share * (vertices[i].y - at.y)};
            length -= left;
            if (drawn) dashes.back().push_back(at);
            drawn = !drawn;
            left = drawn ? on : off;
            if (drawn) dashes.push_back({at});
        }
        left -= length;
        if (drawn) dashes.back().push_back(vertices[i]);
    }
    return dashes;
}

class Rasterizer {
  public:
    Rasterizer(const Drawing& drawing, double scale)
        : scale_(scale),
          width_(pixel(std::round(drawing.width * scale))),
          height_(pixel(std::round(drawing.height * scale))),
          window_{0, 0, width_, height_},
          colours_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_),
                   drawing.background),
          shares_(colours_.size(), 0.0F) {}

    void operator()(const Line& line) {
        if (line.vertices.size() < 2) return;
        if (line.crisp && line.dash == Dash::none && line.vertices.size() == 2) {
            crisp(line);
            return;
        }
        if (line.dash == Dash::none) {
            stroke(line.vertices, line.width * scale_);
        } else {
            const bool dashed = line.dash == Dash::dashed;
            // Dashes are drawn shorter, since their round ends add the line's width.
            const double on = dashed ? std::max(6 - line.width, 1.0) : 0.5;
            for (const auto& dash : dashes_of(line.vertices, on, (dashed ? 10.0 : 4.5) - on))
                stroke(dash, line.width * scale_);
        }
        mix(line.colour, 1);
    }

    void operator()(const Patch& patch) {
        std::vector<Position> vertices;
        for (const Position& position : patch.vertices)
            vertices.push_back({position.x * scale_, position.y * scale_});
        fill(vertices);
        mix(patch.colour, patch.opacity);
    }

    void operator()(const Disks& disks) {
        const double radius = disks.radius * scale_;
        for (const Position& centre : disks.centres) {
            stroke({centre, centre}, 2 * radius);
            mix(disks.colour, disks.opacity);
        }
    }

    void operator()(const Label& label) {
        const double unit = label.size / em_units;
        double x = label.anchor == Anchor::start ? 0 : -text_width(label.text, label.size);
        if (label.anchor == Anchor::middle) x /= 2;
        const double pen = (label.bold ? 3 : 2.3) * unit * scale_;
        for (const char32_t letter : code_points(label.text)) {
            for (auto& points : strokes_of(letter)) {
                for (Position& position : points) {
                    const double right = x + position.x * unit;
                    const double down = -position.y * unit;
                    position = label.upward ? Position{label.at.x + down, label.at.y - right}
                                            : Position{label.at.x + right, label.at.y + down};
                }
                stroke(points, pen);
            }
            x += advance_of(letter) * unit;
        }
        mix(label.colour, 1);
    }

    void operator()(const PixelImage& raster) {
        const Area& a = raster.area;
        const double left = std::round(a.left * scale_);
        const double top = std::round(a.top * scale_);
        const double across = std::max(1.0, std::round(a.right() * scale_) - left);
        const double down = std::max(1.0, std::round(a.bottom() * scale_) - top);
        const double step_x = static_cast<double>(raster.columns) / across;
        const double step_y = static_cast<double>(raster.rows) / down;
        const Pixels area =
            visible({pixel(left), pixel(top), pixel(left + across), pixel(top + down)});
        for (int y = area.top; y < area.bottom; ++y)
            for (int x = area.left; x < area.right; ++x)
                colours_[index(x, y)] =
                    mean_colour(raster, (x - left) * step_x, (y - top) * step_y, step_x, step_y);
    }

    void operator()(const SvgGroup&) {}

    void operator()(const ClipWindow& window) {
        window_ = {0, 0, width_, height_};
        if (window.open) return;
        const Area& a = window.area;
        window_ =
            visible({pixel(std::floor(a.left * scale_)), pixel(std::floor(a.top * scale_)),
                     pixel(std::ceil(a.right() * scale_)), pixel(std::ceil(a.bottom() * scale_))});
    }

    [[nodiscard]] std::string png(const PictureNotes& notes) const {
        const auto size = [](int pixels) { return static_cast<std::size_t>(pixels); };
        return png_bytes_of({{}, size(width_), size(height_), colours_}, false, notes);
    }

  private:
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
               static_cast<std::size_t>(x);
    }

    /// The part of an area inside the clip window.
    [[nodiscard]] Pixels visible(const Pixels& area) const {
        return {std::max(area.left, window_.left), std::max(area.top, window_.top),
                std::min(area.right, window_.right), std::min(area.bottom, window_.bottom)};
    }

    /// Draws a line parallel to an axis, aligned to whole pixels.
    void crisp(const Line& line) {
        const double wide = std::max(1.0, std::round(line.width * scale_));
        const Position a{line.vertices[0].x * scale_, line.vertices[0].y * scale_};
        const Position b{line.vertices[1].x * scale_, line.vertices[1].y * scale_};
        const bool across = a.y == b.y;
        const double at = std::floor((across ? a.y : a.x) + 0.5 * (scale_ - wide));
        const double from = std::floor(across ? std::min(a.x, b.x) : std::min(a.y, b.y));
        const double to = std::ceil(across ? std::max(a.x, b.x) : std::max(a.y, b.y));
        if (across)
            fill({{from, at}, {to, at}, {to, at + wide}, {from, at + wide}});
        else
            fill({{at, from}, {at + wide, from}, {at + wide, to}, {at, to}});
        mix(line.colour, 1);
    }

    /// Adds the coverage of a polyline, `wide` pixels wide.
    void stroke(const std::vector<Position>& vertices, double wide) {
        if (vertices.size() == 1) stroke_piece(vertices[0], vertices[0], wide);
        for (std::size_t i = 1; i < vertices.size(); ++i)
            stroke_piece(vertices[i - 1], vertices[i], wide);
    }

    void stroke_piece(Position from, Position to, double wide) {
        const Position a{from.x * scale_, from.y * scale_};
        const Position b{to.x * scale_, to.y * scale_};
        const double reach = wide / 2 + 0.5;
        // A line thinner than a pixel covers at most the fraction `wide` of one.
        const double most = std::min(1.0, wide);
        const Pixels area = visible({pixel(std::floor(std::min(a.x, b.x) - reach)),
                                     pixel(std::floor(std::min(a.y, b.y) - reach)),
                                     pixel(std::ceil(std::max(a.x, b.x) + reach)) + 1,
                                     pixel(std::ceil(std::max(a.y, b.y) + reach)) + 1});
        for (int y = area.top; y < area.bottom; ++y)
            for (int x = area.left; x < area.right; ++x) {
                const double d = squared_distance({x + 0.5, y + 0.5}, a, b);
                if (d >= reach * reach) continue;
                float& share = shares_[index(x, y)];
                share = std::max(share,
                                 static_cast<float>(std::clamp(reach - std::sqrt(d), 0.0, most)));
            }
        marked(area);
    }

    /// Adds the coverage of a polygon given in pixels, by the even-odd rule.
    void fill(const std::vector<Position>& vertices) {
        constexpr int rows_in_pixel = 4;
        if (vertices.empty()) return;
        const auto [top, bottom] = std::ranges::minmax(vertices, {}, &Position::y);
        const auto [left, right] = std::ranges::minmax(vertices, {}, &Position::x);
        const Pixels area = visible({pixel(std::floor(left.x)), pixel(std::floor(top.y)),
                                     pixel(std::ceil(right.x)), pixel(std::ceil(bottom.y))});
        std::vector<double> crossings;
        for (int row = area.top * rows_in_pixel; row < area.bottom * rows_in_pixel; ++row) {
            const double y = (row + 0.5) / rows_in_pixel;
            crossings.clear();
            for (std::size_t i = 0; i < vertices.size(); ++i) {
                const Position a = vertices[i];
                const Position b = vertices[(i + 1) % vertices.size()];
                if ((a.y <= y) != (b.y <= y))
                    crossings.push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
            }
            std::ranges::sort(crossings);
            for (std::size_t i = 0; i + 1 < crossings.size(); i += 2)
                fill_row(row / rows_in_pixel, crossings[i], crossings[i + 1], 1.0 / rows_in_pixel);
        }
        marked(area);
    }

    void fill_row(int y, double from, double to, double share) {
        from = std::max(from, static_cast<double>(window_.left));
        to = std::min(to, static_cast<double>(window_.right));
        for (int x = pixel(std::floor(from)); x < to; ++x) {
            const double covered = std::min(to, x + 1.0) - std::max(from, static_cast<double>(x));
            shares_[index(x, y)] += static_cast<float>(share * covered);
        }
    }

    void marked(const Pixels& area) {
        if (area.left >= area.right || area.top >= area.bottom) return;
        if (touched_.left >= touched_.right) {
            touched_ = area;
            return;
        }
        touched_ = {std::min(touched_.left, area.left), std::min(touched_.top, area.top),
                    std::max(touched_.right, area.right), std::max(touched_.bottom, area.bottom)};
    }

    /// Blends a colour into the covered pixels, and clears the coverage.
    void mix(Colour colour, double opacity) {
        for (int y = touched_.top; y < touched_.bottom; ++y)
            for (int x = touched_.left; x < touched_.right; ++x) {
                float& share = shares_[index(x, y)];
                if (share <= 0) continue;
                Colour& background = colours_[index(x, y)];
                background =
                    mixed(background, colour, opacity * std::min(1.0, static_cast<double>(share)));
                share = 0;
            }
        touched_ = {};
    }

    /// Mean colour of the image's pixels in a rectangle of step_x x step_y from (x, y); at least
    /// one pixel.
    static Colour mean_colour(const PixelImage& raster, double x, double y, double step_x,
                              double step_y) {
        // If an image pixel is larger than the step, takes the pixel at the middle of the step.
        const auto range = [](double from, double step, std::size_t size) {
            const double first = step <= 1 ? from + step / 2 : from;
            const double last = step <= 1 ? first : from + step - 1e-9;
            const double most = static_cast<double>(size) - 1;
            return std::pair{static_cast<std::size_t>(std::clamp(std::floor(first), 0.0, most)),
                             static_cast<std::size_t>(std::clamp(std::floor(last), 0.0, most))};
        };
        const auto [left, right] = range(x, step_x, raster.columns);
        const auto [top, bottom] = range(y, step_y, raster.rows);
        double red = 0;
        double green = 0;
        double blue = 0;
        for (std::size_t j = top; j <= bottom; ++j)
            for (std::size_t i = left; i <= right; ++i) {
                const Colour c = raster.pixels[j * raster.columns + i];
                red += c.red;
                green += c.green;
                blue += c.blue;
            }
        const auto n = static_cast<double>((right - left + 1) * (bottom - top + 1));
        const auto part = [n](double sum) {
            return static_cast<std::uint8_t>(std::lround(sum / n));
        };
        return {part(red), part(green), part(blue)};
    }

    double scale_;
    int width_;
    int height_;
    Pixels window_;
    std::vector<Colour> colours_;
    std::vector<float> shares_;  ///< coverage of each pixel, 0 to 1
    Pixels touched_;             ///< bounds of the covered pixels
};

}  // namespace

std::string png_bytes_of(const PixelImage& image, bool grey, const PictureNotes& notes) {
    std::string bytes;
    bytes.reserve(image.pixels.size() * (grey ? 1 : 3));
    for (const auto& [red, green, blue] : image.pixels) {
        bytes += static_cast<char>(red);
        if (grey) continue;
        bytes += static_cast<char>(green);
        bytes += static_cast<char>(blue);
    }
    return encode_png({image.columns, image.rows, 8, !grey}, bytes, notes);
}

std::string png_bytes_of(const Drawing& drawing, double scale, const PictureNotes& notes) {
    if (drawing.width * scale * drawing.height * scale > most_pixels)
        fail(ErrorKind::limit,
             "a picture of {:.0f} x {:.0f} pixels is too large; expected at most {:.0f} pixels",
             drawing.width * scale, drawing.height * scale, most_pixels);
    Rasterizer rasterizer(drawing, scale);
    for (const Shape& shape : drawing.shapes) std::visit(rasterizer, shape);
    PictureNotes all = {{"Title", printable(drawing.title)}};
    for (const auto& [keyword, text] : notes) all.emplace_back(keyword, printable(text));
    return rasterizer.png(all);
}

}  // namespace stipple::plot
