// SPDX-License-Identifier: MIT
#include "plot/points_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <tuple>

#include "core/parallel.hpp"
#include "core/text.hpp"
#include "io/format.hpp"
#include "math/neighbors/planar_sites.hpp"
#include "plot/drawing/letters.hpp"

namespace stipple::plot {
namespace {

/// Level names of a coordinate; nullptr if it is numeric.
const std::vector<std::string>* words_in(const PointSet& set, std::size_t k) {
    const std::string name = coordinate_names(set.dimension(), set.provenance)[k];
    for (const auto& [column, words] : set.provenance.levels)
        if (column == name) return &words;
    return nullptr;
}

std::size_t points_of(const PointsPicture& picture) {
    std::size_t sum = 0;
    for (const PointSet* set : picture.sets) sum += set->count();
    return sum;
}

/// The point at the fractions a, b, c of the box's sides.
std::array<double, 3> corner(const Box& box, double a, double b, double c) {
    return {box.low[0] + a * box.extent(0), box.low[1] + b * box.extent(1),
            box.low[2] + c * box.extent(2)};
}

/// Whether the domain is a box, so that the picture's frame is its outline.
bool is_box(const PointSet& set) {
    const std::string spec = set.domain->spec();
    return spec.starts_with("unit-cube") || spec.starts_with("box");
}

bool all_inside(const PointSet& set) {
    for (std::size_t i = 0; i < set.count(); ++i)
        if (!set.domain->contains(set[i])) return false;
    return true;
}

bool is_log(const PointsPicture& picture, std::size_t k) {
    return k < picture.log.size() && picture.log[k];
}

/// Enlarges the box by a fraction of its extent on every side.
void widen(Box& box, double share, const PointsPicture& picture) {
    for (std::size_t k = 0; k < box.dimension(); ++k) {
        if (is_log(picture, k)) {
            const double factor = std::pow(box.high[k] / box.low[k], share);
            box.low[k] /= factor;
            box.high[k] *= factor;
            continue;
        }
        const double more = share * box.extent(k);
        box.low[k] -= more;
        box.high[k] += more;
    }
}

/// The box around the domain, if it is known and bounded, and all points.
Box whole_box(std::span<const PointSet* const> sets) {
    const PointSet& first = *sets[0];
    const std::vector<double> point(first[0].begin(), first[0].end());
    Box box = without_domain(first) ? Box{point, point} : first.domain->bounding_box();
    for (std::size_t k = 0; k < box.dimension(); ++k)
        if (!std::isfinite(box.extent(k))) box.low[k] = box.high[k] = point[k];
    for (const PointSet* set : sets) box = bounding_box(set->flat(), box);
    return box;
}

bool frame_is_outline(const PointsPicture& picture) {
    return std::ranges::all_of(
        picture.sets, [](const PointSet* set) { return is_box(*set) && !without_domain(*set); });
}

/// Fraction of its bounding box that a plane domain fills; 1 if unknown, or if below 2 %.
double share_of_box(const PointSet& set) {
    if (set.dimension() != 2 || without_domain(set)) return 1;
    const double share = set.domain->measure() / volume_of(set.domain->bounding_box());
    return share > 0.02 && share < 1 ? share : 1;
}

/// Maps a point of a set to its position in the drawing.
using Place = std::function<Position(std::span<const double>)>;

/// An area of a drawing, and the mapping of points into it.
struct View {
    Area area;
    Place place;
};

/// Draws points as disks, pixels or counts in areas of a drawing.
class PointMarks {
  public:
    PointMarks(const PointsPicture& picture, const PictureStyle& style, const RunContext& run)
        : picture_(picture), theme_(*style.theme), run_(run) {}

    [[nodiscard]] bool as_disks() const {
        return picture_.marking == Marking::disks || (picture_.marking == Marking::automatic &&
                                                      points_of(picture_) <= picture_.most_disks);
    }

    /// Whether a frame of this size shows counts, because single points would fill most of it.
    [[nodiscard]] bool as_density(double width, double height) const {
        if (as_disks() || picture_.sets.size() > 1) return false;
        return picture_.marking == Marking::density ||
               static_cast<double>(points_of(picture_)) >= density_share * width * height;
    }

    void disks(Drawing& drawing, const Area& area, const Place& place) const {
        const double side = std::max(area.width, area.height);
        const double unit = side / 1000;
        const auto n = static_cast<double>(points_of(picture_));
        // Small pictures have relatively larger disks.
        const double radius = std::max(
            0.6,
            1.25 * unit * io::disk_radius(share_ * area.width * area.height / (unit * unit), n));
        for (std::size_t s = 0; s < picture_.sets.size(); ++s) {
            const PointSet& set = *picture_.sets[s];
            Disks marks{.radius = radius, .colour = theme_.series_colour(s)};
            marks.centres.reserve(set.count());
            for (std::size_t i = 0; i < set.count(); ++i) {
                if (i % patience == 0) run_.check_stop();
                marks.centres.push_back(place(set[i]));
            }
            if (picture_.sets.size() > 1) marks.opacity = 0.85;
            drawing.add(std::move(marks));
        }
    }

    /// Draws points in each view as pixels half a unit wide; nothing if they are drawn as disks. If
    /// `dense`, draws counts in squares that hold a few points on average, shaded relative to the
    /// largest count of all views. Returns that count, or 0 if not `dense`.
    double raster(Drawing& drawing, const std::vector<View>& views, bool dense) const {
        if (as_disks()) return 0;
        std::vector<PixelImage> images;
        std::vector<std::vector<std::uint32_t>> bins;
        std::uint32_t largest = 0;
        const auto n = static_cast<double>(points_of(picture_));
        for (const auto& [area, place] : views) {
            const double some = std::ceil(std::sqrt(6 * area.width * area.height / n));
            images.push_back(empty_raster(area, dense ? std::clamp(some, 1.0, 16.0) : 0.5));
            auto& here = bins.emplace_back(images.back().pixels.size());
            for (std::size_t s = 0; s < picture_.sets.size(); ++s)
                for_each_bin(*picture_.sets[s], images.back(), place, [&](std::size_t bin) {
                    here[bin] = dense ? here[bin] + 1 : static_cast<std::uint32_t>(s + 1);
                });
            largest = std::max(largest, *std::ranges::max_element(here));
        }
        const auto most = static_cast<double>(largest);
        for (std::size_t v = 0; v < views.size(); ++v) {
            for (std::size_t i = 0; i < bins[v].size(); ++i)
                if (const std::uint32_t bin = bins[v][i]; bin > 0)
                    images[v].pixels[i] = dense ? shade(static_cast<double>(bin) / most)
                                                : theme_.series_colour(bin - 1);
            drawing.add(std::move(images[v]));
        }
        return dense ? most : 0;
    }

    /// Draws the colour bar for counts from 0 to the largest.
    void draw_bar(Drawing& drawing, const Area& frame, double largest) const {
        Ticks ticks = linear_ticks(0, largest, 6, true);
        for (Tick& tick : ticks.numbers) tick.value /= largest;
        const std::string name = ticks.exponent == 0
                                     ? "points"
                                     : fmt::format("points (×{})", power_of_ten(ticks.exponent));
        draw_colour_bar(
            drawing, bar_beside(frame), name, theme_, [this](double share) { return shade(share); },
            ticks.numbers);
    }

    [[nodiscard]] Colour shade(double share) const { return shade_of(theme_, share); }

  private:
    static constexpr std::size_t patience = 65536;  ///< points between checks for a stop

    [[nodiscard]] PixelImage empty_raster(const Area& area, double side) const {
        PixelImage raster{.area = area,
                          .columns = static_cast<std::size_t>(std::ceil(area.width / side)),
                          .rows = static_cast<std::size_t>(std::ceil(area.height / side))};
        raster.pixels.assign(raster.columns * raster.rows, theme_.background);
        return raster;
    }

    template <class Visit>
    void for_each_bin(const PointSet& set, const PixelImage& raster, const Place& place,
                      const Visit& visit) const {
        const Area& a = raster.area;
        for (std::size_t i = 0; i < set.count(); ++i) {
            if (i % patience == 0) run_.tick(i, set.count());
            const Position position = place(set[i]);
            const auto column = cell_at((position.x - a.left) / a.width, raster.columns);
            const auto row = cell_at((a.bottom() - position.y) / a.height, raster.rows);
            if (column && row) visit((raster.rows - 1 - *row) * raster.columns + *column);
        }
    }

    const PointsPicture& picture_;
    const Theme& theme_;
    const RunContext& run_;
    double share_ = share_of_box(*picture_.sets[0]);  ///< the domain's fraction of the frame
};

std::vector<LegendEntry> legend_of(const PointsPicture& picture, const Theme& theme) {
    std::vector<LegendEntry> entries;
    for (std::size_t s = 0; picture.sets.size() > 1 && s < picture.sets.size(); ++s)
        entries.push_back({.kind = LegendEntry::Kind::disk,
                           .name = picture.names[s],
                           .colour = theme.series_colour(s)});
    return entries;
}

/// A drawing with title and legend, which take the height `top`.
struct Page {
    Drawing drawing;
    double top = 0;
    double width = 0;  ///< width between the margins

    Page(const PointsPicture& picture, const PictureStyle& style, double usual_width) {
        auto titled = titled_drawing(picture.title, picture.subtitle, style, usual_width);
        drawing = std::move(titled.drawing);
        width = drawing.width - 2 * picture_margin;
        const auto entries = legend_of(picture, *style.theme);
        draw_legend(drawing, entries, {picture_margin, titled.top}, width, *style.theme);
        top = std::ceil(titled.top + legend_height(entries, width));
    }
};

// ---------------------------------------------------------------- points in the plane

void draw_outline(Drawing& drawing, const PointsPicture& picture, const Panel& panel,
                  const Theme& theme) {
    const PointSet& first = *picture.sets[0];
    if (is_box(first)) return;
    for (const auto& line : outline_of(*first.domain)) {
        Line outline{.colour = theme.frame, .width = 1};
        for (const Position& position : line)
            outline.vertices.push_back(panel.at(position.x, position.y));
        drawing.add(std::move(outline));
    }
}

/// The parts of [low, high] on an axis of the torus: two if low > high, which wraps around.
std::vector<std::pair<double, double>> parts_of_range(double low, double high) {
    if (low <= high) return {{low, high}};
    return {{0, high}, {low, 1}};
}

/// Draws the edges of the Voronoi cells, each edge once.
void draw_cells(Drawing& drawing, const PointSet& set, const Panel& panel, const Theme& theme,
                const RunContext& run) {
    const Box box = shown_box(std::array{&set});
    const PlanarSites sites = planar_sites(set.flat(), box, false, silent(run));
    const PlanarCells cells(sites, run);
    VoronoiCell cell;
    for (std::size_t i = 0; i < sites.count(); ++i) {
        cells.cut(i, cell);
        const auto corners = cell.corners();
        const auto at = [&](const CellCorner& corner) {
            return panel.at(box.low[0] + sites.at(i).x + corner.at.x,
                            box.low[1] + sites.at(i).y + corner.at.y);
        };
        for (std::size_t k = 0; k < corners.size(); ++k)
            if (corners[k].site != CellCorner::wall && corners[k].site > i)
                drawing.add(
                    Line{.vertices = {at(corners[k]), at(corners[(k + 1) % corners.size()])},
                         .colour = theme.guide,
                         .width = 0.8});
    }
}

/// Draws the lines and the circles, clipped to the frame; circles on the torus get periodic copies.
void draw_circles(Drawing& drawing, const PointsPicture& picture, const Panel& panel,
                  const Theme& theme) {
    for (const auto& [from, to] : picture.lines)
        drawing.add(Line{.vertices = {panel.at(from.x, from.y), panel.at(to.x, to.y)},
                         .colour = theme.guide,
                         .width = 0.8});
    if (picture.circles.empty()) return;
    const Box box = picture.sets[0]->domain->bounding_box();
    drawing.add(ClipWindow{.area = panel.frame()});
    for (const auto& [centre, radius, torus] : picture.circles)
        for (int across = -1; across <= 1; ++across)
            for (int up = -1; up <= 1; ++up) {
                if (!torus && (across != 0 || up != 0)) continue;
                std::vector<Position> rim;
                constexpr int corners = 180;
                for (int k = 0; k <= corners; ++k) {
                    const double angle = 2 * std::numbers::pi * k / corners;
                    rim.push_back(
                        panel.at(centre.x + across * box.extent(0) + radius * std::cos(angle),
                                 centre.y + up * box.extent(1) + radius * std::sin(angle)));
                }
                drawing.add(
                    Patch{.vertices = rim, .colour = theme.series_colour(1), .opacity = 0.12});
                drawing.add(Line{.vertices = rim, .colour = theme.series_colour(1), .width = 1.4});
            }
    drawing.add(ClipWindow{.open = true});
}

/// Draws the boxes projected onto the plane of two coordinates.
void draw_boxes(Drawing& drawing, const PointsPicture& picture, const Panel& panel, std::size_t i,
                std::size_t j) {
    const Box cube = picture.sets[0]->domain->bounding_box();
    const auto at = [&](double x, double y) {
        return panel.at(cube.low[i] + x * cube.extent(i), cube.low[j] + y * cube.extent(j));
    };
    for (const MarkedBox& box : picture.boxes) {
        drawing.add(SvgGroup{fmt::format("class=\"box {}\"", box.kind)});
        for (const auto& [x0, x1] : parts_of_range(box.low[i], box.high[i]))
            for (const auto& [y0, y1] : parts_of_range(box.low[j], box.high[j])) {
                std::vector<Position> corners = {at(x0, y0), at(x1, y0), at(x1, y1), at(x0, y1)};
                drawing.add(Patch{.vertices = corners, .opacity = 0.1});
                corners.push_back(corners[0]);
                drawing.add(Line{.vertices = std::move(corners),
                                 .width = 1.6,
                                 .dash = box.closed ? Dash::none : Dash::dashed});
            }
        drawing.add(SvgGroup{});
    }
}

/// Size of the frame for a box. x and y have equal scales, except if the box is very thin. @param
/// height limit; 0: automatic
std::pair<double, double> frame_size(const PointsPicture& picture, const Box& box, double width,
                                     double height) {
    double ratio = std::clamp(picture_ratio(picture, box), 0.12, 3.0);
    if (!(ratio > 0)) ratio = 1;
    double wide = width;
    if (height > 0 && wide * ratio > height) wide = height / ratio;
    if (height <= 0) wide = std::min(wide, 1.25 * width / ratio);
    constexpr double least = 30;
    return {std::floor(std::max(wide, least)), std::floor(std::max(wide * ratio, least))};
}

// ---------------------------------------------------------------- three coordinates

/// The projected box, with its scale and offset in the drawing.
struct Scene {
    const Box& box;
    double scale = 1;
    double left = 0;
    double top = 0;

    [[nodiscard]] Position at(std::span<const double> point) const {
        const Projected projected = project(box, point);
        return {left + scale * projected.right, top - scale * projected.up};
    }
    [[nodiscard]] Position at(double a, double b, double c) const {
        return at(corner(box, a, b, c));
    }
};

/// Draws the box's edges: the three at the far corner, behind all points, or the others if `front`.
void draw_edges(Drawing& drawing, const Scene& scene, const Theme& theme, bool front) {
    constexpr std::array hidden = {0, 1, 0};  // the far corner: high x, low y, high z
    for (int bits = 0; bits < 8; ++bits)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::array<int, 3> a = {bits & 1, bits >> 1 & 1, bits >> 2 & 1};
            if (a[k] != 0) continue;
            std::array<int, 3> b = a;
            ++b[k];
            if ((a == hidden || b == hidden) == front) continue;
            drawing.add(
                Line{.vertices = {scene.at(a[0], a[1], a[2]), scene.at(b[0], b[1], b[2])},
                     .colour = front ? theme.frame : mixed(theme.frame, theme.background, 0.6),
                     .width = 1});
        }
}

/// Numbers and names along three outer edges of the projected box, one per coordinate.
struct EdgeTexts {
    std::array<std::pair<std::string, std::string>, 3> ends;
    std::array<std::vector<std::string>, 3> names;  ///< wrapped lines

    EdgeTexts(const PointsPicture& picture, const Box& box) {
        const auto all = shown_names(picture);
        for (std::size_t k = 0; k < 3; ++k) {
            ends[k] = shown_ends(picture, box, k);
            names[k] = {all[k]};
        }
    }

    /// Width of the wider one of the numbers at the ends of coordinate k.
    [[nodiscard]] double wide(std::size_t k) const {
        return std::max(text_width(ends[k].first, number_size),
                        text_width(ends[k].second, number_size));
    }
    /// Height of all lines of a name except the first.
    [[nodiscard]] double more_rows(std::size_t k) const {
        return name_row * (static_cast<double>(names[k].size()) - 1);
    }
    /// Distance from the vertical edge to its name; the numbers are between them.
    [[nodiscard]] double aside() const { return std::max(36.0, 22 + wide(2)); }

    /// Space needed for texts on each side of the box.
    [[nodiscard]] double beside() const {
        return std::max({aside() + more_rows(2) + 10, wide(0), wide(1) + 10});
    }
    [[nodiscard]] double below() const { return 30 + std::max(more_rows(0), more_rows(1)); }

    /// Wraps the names to the available space.
    void wrap(const Scene& scene, double width) {
        constexpr double least = 40;
        const double before = scene.at(0.5, 0, 0).x - 8 - picture_margin;
        const double behind = width - scene.at(1, 0.5, 0).x - 14 - picture_margin;
        const double high = scene.at(0, 0, 0).y - scene.at(0, 0, 1).y;
        const std::array room = {before, behind, high + 20};
        for (std::size_t k = 0; k < 3; ++k)
            names[k] = wrapped(join(names[k], " "), name_size, std::max(least, room[k]));
    }

    void draw(Drawing& drawing, const Scene& scene, const Theme& theme) const {
        const auto put = [&](Position at, double dx, double dy, const std::string& text,
                             Anchor anchor) {
            drawing.add(Label{.text = text,
                              .at = {at.x + dx, at.y + dy},
                              .size = number_size,
                              .colour = theme.text,
                              .anchor = anchor});
        };
        put(scene.at(0.08, 0, 0), -2, 18, ends[0].first, Anchor::end);
        put(scene.at(0.95, 0, 0), -2, 18, ends[0].second, Anchor::end);
        put(scene.at(1, 0.08, 0), 10, 16, ends[1].first, Anchor::start);
        put(scene.at(1, 0.95, 0), 10, 16, ends[1].second, Anchor::start);
        put(scene.at(0, 0, 0.04), -8, 4, ends[2].first, Anchor::end);
        put(scene.at(0, 0, 0.98), -8, 4, ends[2].second, Anchor::end);
        const auto name = [&](std::size_t k, Position at, double dx, double dy, Anchor anchor) {
            add_lines(drawing,
                      {.text = {},
                       .at = {at.x + dx, at.y + dy},
                       .size = name_size,
                       .colour = theme.ink,
                       .anchor = anchor,
                       .upward = k == 2 && join(names[k], "").size() > 1},
                      names[k], name_row);
        };
        name(0, scene.at(0.5, 0, 0), -8, 24 + more_rows(0), Anchor::end);
        name(1, scene.at(1, 0.5, 0), 14, 22 + more_rows(1), Anchor::start);
        name(2, scene.at(0, 0, 0.5), -aside(), 0, Anchor::middle);
    }

    static constexpr double name_row = name_size + 2;
};

/// Draws disks in layers from far to near; distant ones are paler and smaller.
void draw_layers(Drawing& drawing, const PointsPicture& picture, const Scene& scene,
                 const Theme& theme, double side) {
    constexpr std::size_t layers = 10;
    const auto n = static_cast<double>(points_of(picture));
    const double radius = std::clamp(0.075 * side / std::cbrt(std::max(n, 1.0)), 0.7, 4.0);
    const auto [low, high] = projected_range(scene.box);
    std::vector<Disks> disks;
    for (std::size_t layer = 0; layer < layers; ++layer)
        for (std::size_t s = 0; s < picture.sets.size(); ++s) {
            const double share = static_cast<double>(layer) / (layers - 1);
            disks.push_back(
                {.radius = radius * (0.7 + 0.3 * share),
                 .colour = mixed(theme.series_colour(s), theme.background, 0.62 * (1 - share))});
        }
    for (std::size_t s = 0; s < picture.sets.size(); ++s)
        for (std::size_t i = 0; i < picture.sets[s]->count(); ++i) {
            const auto point = (*picture.sets[s])[i];
            const double share =
                (project(scene.box, point).depth - low.depth) / (high.depth - low.depth);
            const auto layer = static_cast<std::size_t>(
                std::clamp(share * layers, 0.0, static_cast<double>(layers - 1)));
            disks[layer * picture.sets.size() + s].centres.push_back(scene.at(point));
        }
    for (Disks& layer : disks)
        if (!layer.centres.empty()) drawing.add(std::move(layer));
}

Drawing draw_space(const PointsPicture& picture, const PictureStyle& style, const RunContext& run) {
    const Theme& theme = *style.theme;
    const PointMarks marks(picture, style, run);
    Page page(picture, style, 640);
    const Box box = shown_box(picture.sets);
    const auto [low, high] = projected_range(box);
    const double across = high.right - low.right;
    const double upward = high.up - low.up;
    constexpr double least = 20;
    EdgeTexts texts(picture, box);
    Drawing& drawing = page.drawing;
    double scale = 0;
    const auto scene_of = [&, &low = low, &high = high] {
        const double below = texts.below() + picture_margin;
        scale = (drawing.width - 2 * (texts.beside() + picture_margin)) / across;
        if (style.height > 0)
            scale = std::min(scale, (style.height - page.top - below - 8) / upward);
        scale = std::max(scale, least);
        drawing.width =
            std::max(drawing.width, scale * across + 2 * (texts.beside() + picture_margin));
        drawing.height = std::ceil(page.top + 8 + scale * upward + below);
        const double left = (drawing.width - scale * across) / 2;
        return Scene{box, scale, left - scale * low.right, page.top + 8 + scale * high.up};
    };
    texts.wrap(scene_of(), drawing.width);
    const Scene scene = scene_of();
    if (marks.as_disks()) {
        draw_edges(drawing, scene, theme, false);
        draw_layers(drawing, picture, scene, theme, scale);
    } else {
        const Place place = [&scene](std::span<const double> p) { return scene.at(p); };
        const Area area{std::floor((drawing.width - scale * across) / 2), std::floor(page.top + 8),
                        std::ceil(scale * across), std::ceil(scale * upward)};
        marks.raster(drawing, {{area, place}}, marks.as_density(area.width, area.height));
        draw_edges(drawing, scene, theme, false);
    }
    draw_edges(drawing, scene, theme, true);
    texts.draw(drawing, scene, theme);
    return std::move(page.drawing);
}

// ---------------------------------------------------------------- pairs of coordinates

/// Panels of all pairs of coordinates: the one in column i, row j - 1 (i < j) shows coordinate i to
/// the right and j upwards. Plane points have a single panel with equal scales.
class PairSheet {
  public:
    PairSheet(const PointsPicture& picture, const PictureStyle& style, const RunContext& run)
        : picture_(picture),
          theme_(*style.theme),
          run_(run),
          plane_(picture.sets[0]->dimension() == 2),
          marks_(picture, style, run),
          page_(picture, style, plane_ ? 640 : 800),
          box_(shown_box(picture.sets)),
          names_(shown_names(picture)),
          shown_(std::min(box_.dimension(), picture.most_coordinates)) {
        if (!frame_is_outline(picture)) widen(box_, 0.03, picture);
        const double tall = style.height > 0 ? style.height : page_.width;
        dense_ = plane_ && marks_.as_density(page_.width, tall);
        place_panels(style);
        if (!plane_) dense_ = marks_.as_density(width_, height_);
    }

    Drawing draw() {
        std::vector<View> views;
        for (std::size_t j = 1; j < shown_; ++j)
            for (std::size_t i = 0; i < j; ++i) views.push_back(view(i, j));
        const double largest = marks_.raster(page_.drawing, views, dense_);
        // All pairs share one colour scale; its bar is in the free corner of the sheet.
        if (dense_) marks_.draw_bar(page_.drawing, panel(0, 1).frame(), largest);
        for (std::size_t j = 1; j < shown_; ++j)
            for (std::size_t i = 0; i < j; ++i) {
                const auto [frame, place] = view(i, j);
                panel(i, j).draw_axes(page_.drawing, theme_, true);
                if (plane_) draw_outline(page_.drawing, picture_, panel(i, j), theme_);
                if (plane_ && picture_.cells)
                    draw_cells(page_.drawing, *picture_.sets[0], panel(i, j), theme_, run_);
                if (plane_) draw_circles(page_.drawing, picture_, panel(i, j), theme_);
                if (marks_.as_disks()) marks_.disks(page_.drawing, frame, place);
                draw_boxes(page_.drawing, picture_, panel(i, j), i, j);
            }
        return std::move(page_.drawing);
    }

  private:
    static constexpr double gap = 10;
    static constexpr double least = 30;  ///< minimum side of a panel

    /// Iterates, since names of axes are wrapped to the panels' size, and more rows of them leave
    /// less space for the panels.
    void place_panels(const PictureStyle& style) {
        const auto columns = static_cast<double>(shown_ - 1);
        const double gaps = (columns - 1) * gap;
        const double right = picture_margin + (dense_ ? colour_bar_room : plane_ ? 8 : 0);
        top_ = page_.top + (dense_ ? 14 : 4);
        width_ = height_ = plane_ ? 500 : 200;
        double below = 0;
        double aside = 0;
        for (int rounds = 0; rounds < 4; ++rounds) {
            for (std::size_t k = 0; k < shown_; ++k) {
                if (k > 0)
                    left_ = std::max(left_, std::ceil(picture_margin / 2 +
                                                      Panel::room_left(axis(k, true), height_)));
                if (k + 1 < shown_)
                    below =
                        std::max(below, Panel::room_below(axis(k, true), width_) + picture_margin);
            }
            const double wide = (page_.drawing.width - left_ - right - gaps) / columns;
            const double high =
                style.height > 0
                    ? std::max(std::floor((style.height - top_ - below - gaps) / columns), least)
                    : 0;
            if (plane_) {
                std::tie(width_, height_) = frame_size(picture_, box_, wide, high);
                aside = std::max(std::floor((wide - width_) / 2), 0.0);
            } else {  // units may differ, so the panels need no common scale
                width_ = std::max(std::floor(wide), least);
                height_ = high > 0 ? high : width_;
            }
        }
        left_ += aside;
        page_.drawing.height = std::ceil(top_ + columns * height_ + gaps + below);
        page_.drawing.width =
            std::max(page_.drawing.width, left_ + columns * width_ + gaps + right);
    }

    /// Axis of a coordinate; if `edge`, at the sheet's edge, with numbers and name.
    [[nodiscard]] Axis axis(std::size_t k, bool edge) const {
        Axis axis = shown_axis(picture_, box_, k);
        if (edge) axis.name = names_[k];
        axis.numbers = edge;
        axis.tight = !plane_;
        return axis;
    }

    [[nodiscard]] Panel panel(std::size_t i, std::size_t j) const {
        const Area frame{left_ + static_cast<double>(i) * (width_ + gap),
                         top_ + static_cast<double>(j - 1) * (height_ + gap), width_, height_};
        return {frame, axis(i, j + 1 == shown_), axis(j, i == 0)};
    }

    [[nodiscard]] View view(std::size_t i, std::size_t j) const {
        const Panel here = panel(i, j);
        return {here.frame(),
                [here, i, j](std::span<const double> p) { return here.at(p[i], p[j]); }};
    }

    const PointsPicture& picture_;
    const Theme& theme_;
    const RunContext& run_;
    bool plane_;
    PointMarks marks_;
    Page page_;
    Box box_;
    std::vector<std::string> names_;
    std::size_t shown_;
    bool dense_ = false;
    double left_ = 0;
    double top_ = 0;
    double width_ = 0;  ///< width of a panel
    double height_ = 0;
};

std::vector<double> coordinate(const PointSet& set, std::size_t k) {
    std::vector<double> values;
    values.reserve(set.count());
    for (std::size_t i = 0; i < set.count(); ++i) values.push_back(set[i][k]);
    return values;
}

/// Number of histogram bins for n values: proportional to the cube root of n, which minimizes the
/// error for smooth densities.
std::size_t bins_of(std::size_t n) {
    return std::clamp<std::size_t>(
        static_cast<std::size_t>(std::ceil(2 * std::cbrt(static_cast<double>(n)))), 5, 200);
}

/// Whether a coordinate counts as whole numbers: all values are whole, and the domain is unknown or
/// not even(), as for discrete distributions.
bool is_whole(const PointsPicture& picture, std::size_t k) {
    const PointSet& first = *picture.sets[0];
    if (first.domain->even() && !without_domain(first)) return false;
    return std::ranges::all_of(picture.sets,
                               [&](const PointSet* set) { return are_whole(coordinate(*set, k)); });
}

/// Histogram of a categorical coordinate: frequencies of its levels as bars at 1, 2, ...
ChartPanel words_panel(const PointsPicture& picture, const std::vector<std::string>& words,
                       std::size_t k) {
    ChartPanel panel{.x_name = shown_names(picture)[k],
                     .y_name = "share",
                     .categories = words,
                     .from_zero = true};
    const auto end = static_cast<double>(words.size()) - 0.5;
    for (std::size_t s = 0; s < picture.sets.size(); ++s) {
        Bars bars = histogram_of(coordinate(*picture.sets[s], k), -0.5, end, words.size());
        for (double& edge : bars.edges) ++edge;
        bars.name = picture.names[s];
        panel.bars.push_back(std::move(bars));
    }
    return panel;
}

ChartPanel histogram_panel(const PointsPicture& picture, const Box& box, std::size_t k) {
    if (const auto* words = words_in(*picture.sets[0], k)) return words_panel(picture, *words, k);
    ChartPanel panel{.x_name = shown_names(picture)[k], .y_name = "density", .from_zero = true};
    panel.log_x = is_log(picture, k);
    if (panel.log_x) panel.y_name += fmt::format(" of ln {}", panel.x_name);
    panel.whole_x = is_whole(picture, k);
    const auto histogram = panel.whole_x ? whole_histogram : histogram_of;
    std::vector<std::vector<double>> all;
    for (const PointSet* set : picture.sets) all.push_back(coordinate(*set, k));
    std::pair range(box.low[k], box.high[k]);
    if (panel.log_x) {
        const auto positive = keep_positive(all, panel);
        if (!(range.first > 0)) range = {positive.first, std::max(range.second, positive.second)};
    }
    for (std::size_t s = 0; s < picture.sets.size(); ++s) {
        const std::size_t bins = bins_of(picture.sets[s]->count());
        Bars bars = histogram(all[s], range.first, range.second, bins, panel.log_x);
        bars.name = picture.names[s];
        panel.bars.push_back(std::move(bars));
    }
    if (frame_is_outline(picture) && !panel.log_x)
        panel.guides.push_back({.name = "uniform", .y = {1 / box.extent(k)}});
    if (picture.sets.size() == 1 && picture.sets[0]->count() <= 2000) panel.rug = std::move(all[0]);
    return panel;
}

}  // namespace

bool without_domain(const PointSet& set) {
    return set.domain->spec().starts_with("unit-cube") && !all_inside(set);
}

Box shown_box(std::span<const PointSet* const> sets) {
    Box box = whole_box(sets);
    for (std::size_t k = 0; k < box.dimension(); ++k) {
        if (const auto* words = words_in(*sets[0], k)) {
            box.low[k] = std::min(box.low[k], 0.0) - 0.5;
            box.high[k] = std::max(box.high[k], static_cast<double>(words->size()) - 1) + 0.5;
        }
        require_shown(box.low[k], box.high[k]);
        std::tie(box.low[k], box.high[k]) = visible_range(box.low[k], box.high[k]);
    }
    return box;
}

std::vector<std::string> shown_names(const PointsPicture& picture) {
    const PointSet& first = *picture.sets[0];
    auto names = coordinate_names(first.dimension(), first.provenance);
    const Box box = whole_box(picture.sets);
    for (std::size_t k = 0; k < std::min(names.size(), picture.units.size()); ++k)
        if (!picture.units[k].empty()) names[k] += fmt::format(" ({})", picture.units[k]);
    for (std::size_t k = 0; k < names.size(); ++k)
        if (const std::string flaw = flaw_of_range(box.low[k], box.high[k]); !flaw.empty())
            names[k] += fmt::format(" ({})", flaw);
    return names;
}

std::pair<std::string, std::string> shown_ends(const PointsPicture& picture, const Box& box,
                                               std::size_t k) {
    if (const auto* words = words_in(*picture.sets[0], k)) return {words->front(), words->back()};
    return rounded_ends(box.low[k], box.high[k]);
}

Axis shown_axis(const PointsPicture& picture, const Box& box, std::size_t k) {
    Axis axis{.low = box.low[k], .high = box.high[k], .log = is_log(picture, k)};
    if (const auto* words = words_in(*picture.sets[0], k)) {
        axis.words = *words;
        axis.first_word = 0;
    }
    return axis;
}

double picture_ratio(const PointsPicture& picture, const Box& box) {
    const double ratio = box.extent(1) / box.extent(0);
    const bool unlike = ratio > most_unlike || ratio < 1 / most_unlike;
    return unlike || is_log(picture, 0) || is_log(picture, 1) ? 1 : ratio;
}

bool is_space(const PointsPicture& picture) {
    const bool linear = std::ranges::find(picture.log, true) == picture.log.end();
    return picture.sets[0]->dimension() == 3 && !picture.pairs && linear;
}

bool is_positive(std::span<const PointSet* const> sets, std::size_t k) {
    return whole_box(sets).low[k] > 0 && words_in(*sets[0], k) == nullptr;
}

Projected project(const Box& box, std::span<const double> point) {
    // Seen from 30 degrees beside the y axis, and 25 degrees above the ground.
    constexpr double side_cosine = 0.8660254037844386;
    constexpr double side_sine = 0.5;
    constexpr double rise_cosine = 0.9063077870366499;
    constexpr double rise_sine = 0.42261826174069944;
    const auto extents = std::minmax({box.extent(0), box.extent(1), box.extent(2)});
    const double longest = extents.second;
    const bool alike = longest <= most_unlike * extents.first;
    const auto share = [&](std::size_t k) {
        return (point[k] - box.low[k]) / (alike ? longest : box.extent(k));
    };
    const double x = share(0);
    const double y = share(1);
    const double z = share(2);
    const double toward = side_sine * x - side_cosine * y;
    return {.right = side_cosine * x + side_sine * y,
            .up = rise_cosine * z - rise_sine * toward,
            .depth = rise_cosine * toward + rise_sine * z};
}

std::pair<Projected, Projected> projected_range(const Box& box) {
    Projected low{1e9, 1e9, 1e9};
    Projected high{-1e9, -1e9, -1e9};
    for (int bits = 0; bits < 8; ++bits) {
        const Projected projected =
            project(box, corner(box, bits & 1, bits >> 1 & 1, bits >> 2 & 1));
        low = {std::min(low.right, projected.right), std::min(low.up, projected.up),
               std::min(low.depth, projected.depth)};
        high = {std::max(high.right, projected.right), std::max(high.up, projected.up),
                std::max(high.depth, projected.depth)};
    }
    return {low, high};
}

Chart histogram_chart(const PointsPicture& picture) {
    constexpr std::size_t most_panels = 6;
    const Box box = shown_box(picture.sets);
    Chart chart{.title = picture.title, .subtitle = picture.subtitle};
    const std::size_t panels = std::min(box.dimension(), most_panels);
    for (std::size_t k = 0; k < panels; ++k)
        if (box.low[k] != box.low[0] || box.high[k] != box.high[0] || is_log(picture, k) ||
            words_in(*picture.sets[0], k) != nullptr)
            chart.own_x = true;
    for (std::size_t k = 0; k < panels; ++k) {
        ChartPanel panel = histogram_panel(picture, box, k);
        if (panels > 1 && !chart.own_x) {
            panel.y_name = fmt::format("density of {}", panel.x_name);
            panel.x_name = "coordinate";
        }
        if (k > 0)
            for (Guide& guide : panel.guides) guide.name.clear();
        chart.panels.push_back(std::move(panel));
    }
    return chart;
}

Drawing draw_points(const PointsPicture& picture, const PictureStyle& style,
                    const RunContext& run) {
    const std::size_t d = picture.sets[0]->dimension();
    if (d == 1) return draw_chart(histogram_chart(picture), style);
    return is_space(picture) ? draw_space(picture, style, run) : draw_pairs(picture, style, run);
}

Drawing draw_pairs(const PointsPicture& picture, const PictureStyle& style, const RunContext& run) {
    return PairSheet(picture, style, run).draw();
}

}  // namespace stipple::plot
