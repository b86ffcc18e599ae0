// SPDX-License-Identifier: MIT
//
// Unit square onto a polygon of any shape, with any number of holes and parts. Its boundary is a
// set of rings of straight edges; a point is inside if an odd number of rings surround it. xi0 is
// the fraction of the area below a row, xi1 the fraction of the row's length inside to the left:
//
//     xi0 = A(y) / A,    xi1 = L(x, y) / L(y)
//
// where A(y) is the area below y, L(y) the length of the row and L(x, y) its length up to x
// (polygon_domain.hpp): first the marginal of y, then x given y. The polygon is treated as one
// piece, so that strata are not cut as they would be by a triangulation.
//
// Shape   2 unit coordinates, 2 coordinates; any number of vertices.
// Strata  xi0 and xi1 are used directly, not as 1 - xi: small xi0 is at the bottom, small xi1 left.
//         Strata become pieces of horizontal bands; if a row has several parts, a stratum may lie
//         in two parts. The map of a convex polygon is continuous.
// Cost    O(n log n) time and memory for n vertices; O(1) a point if its row crosses two edges, at
//         most O(log(n)^3).
// Promise density 1 / area. Points lie in the closed polygon up to 16 epsilon (largest coordinate).
//         A round trip returns the same xi within 1e-14 times the area of the bounding box / area,
//         except that a row of length 0 returns xi1 = 0. It returns the same point within 1e-14 of
//         the largest coordinate, times A / L(y). The same bits on every machine.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/bytes/file_bytes.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "io/formats/delimited.hpp"
#include "math/geometry/polygon_contact.hpp"
#include "warps/planar/polygon_domain.hpp"

namespace stipple::warps::polygon {
namespace {

constexpr Param<Text> vertices{
    {.name = "vertices",
     .fallback = "0,0 2,0 2,1 1,1 1,2 0,2",
     .help = "Corners in order, x,y x,y ...; a / separates rings. A point is inside if an odd "
             "number of rings surround it, so that rings in rings are holes; two rings may touch "
             "in single points"}};

constexpr Param<Path> file{
    {.name = "file",
     .help = "File of corners, x,y on each line; a blank or comment line (#) starts another ring"}};

/// Origin of the rings, for messages.
struct Source {
    ErrorKind kind;
    std::string name;

    template <class... Args>
    [[noreturn]] void refuse(fmt::format_string<Args...> what, Args&&... args) const {
        fail(kind, "{}: {}", name, fmt::format(what, std::forward<Args>(args)...));
    }
};

std::string shown(PlanePoint p) { return fmt::format("{},{}", p.x, p.y); }

PlanePoint parse_point(std::string_view text, const Source& source) {
    const auto parts = split(text, ',');
    const auto x = parts.size() == 2 ? parse_number(parts[0]) : std::nullopt;
    const auto y = parts.size() == 2 ? parse_number(parts[1]) : std::nullopt;
    if (!x || !y) source.refuse("'{}' is not a point x,y", text);
    return {*x, *y};
}

std::vector<Ring> parse_rings(std::string_view text, const Source& source) {
    std::vector<Ring> rings;
    for (const auto part : split(text, '/')) {
        Ring ring;
        for (const auto word : split(part, ' '))
            if (!word.empty()) ring.push_back(parse_point(word, source));
        rings.push_back(std::move(ring));
    }
    return rings;
}

/// Replaces the first blank or comment line after each ring by `#`, which separates the point sets
/// of a file, and removes all other comments.
std::string with_marks(std::string_view text) {
    std::string marked;
    bool in_ring = false;
    for (const auto line : split(text, '\n')) {
        const auto content = line.substr(0, line.find('#'));
        const bool blank = trim(content).empty();
        marked += blank ? (in_ring ? "#" : "") : content;
        marked += '\n';
        in_ring = !blank;
    }
    marked.erase(marked.find_last_not_of("#\n") + 1);  // no mark after the last ring
    return marked;
}

std::vector<Ring> read_rings(const std::string& path, const Source& source, const RunContext& run) {
    std::vector<Ring> rings;
    const ReadOptions options{.source = path, .all_columns = true};
    for (const PointSet& group : io::read_delimited(with_marks(read_file(path)), options, run)) {
        if (group.dimension() != 2)
            source.refuse("{} coordinates on a line; expected 2, x,y", group.dimension());
        Ring ring;
        for (std::size_t i = 0; i < group.count(); ++i) ring.push_back({group[i][0], group[i][1]});
        rings.push_back(std::move(ring));
    }
    return rings;
}

/// Normalizes rings: no -0, and no vertex equal to the preceding one (cyclically).
void tidy(std::vector<Ring>& rings, const Source& source) {
    for (std::size_t r = 0; r < rings.size(); ++r) {
        Ring& ring = rings[r];
        for (PlanePoint& p : ring) {
            if (!(std::abs(p.x) <= 1e150 && std::abs(p.y) <= 1e150))
                source.refuse("the vertex {} is outside [-1e150, 1e150]", shown(p));
            p = {p.x + 0.0, p.y + 0.0};
        }
        ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
        while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
        if (ring.size() < 3)
            source.refuse("ring {} has {} different vertices; expected at least 3", r + 1,
                          ring.size());
    }
}

std::string shown(const std::vector<Ring>& rings, const RingEdge& edge) {
    const Ring& ring = rings[edge.ring];
    const std::string of = rings.size() > 1 ? fmt::format(" of ring {}", edge.ring + 1) : "";
    return fmt::format("edge {}{} ({} to {})", edge.edge + 1, of, shown(ring[edge.edge]),
                       shown(ring[(edge.edge + 1) % ring.size()]));
}

/// Whether all vertices of a ring are exactly collinear.
bool is_flat(const Ring& ring) {
    const auto turn = [&](PlanePoint p, PlanePoint q) {
        return (p.x - ring[0].x) * (q.y - ring[0].y) - (p.y - ring[0].y) * (q.x - ring[0].x);
    };
    return std::ranges::all_of(ring, [&](PlanePoint p) { return turn(ring[1], p) == 0; });
}

/// Edges of the rings. @throws Error unless they bound a polygon; its area may still be 0
std::vector<RingSegment> edges_of(const Values& options, const Source& source,
                                  const RunContext& run) {
    auto rings = options.given(file) ? read_rings(options[file], source, run)
                                     : parse_rings(options[vertices], source);
    tidy(rings, source);
    for (std::size_t r = 0; r < rings.size(); ++r)
        if (is_flat(rings[r]))
            source.refuse("ring {} has no area: its vertices lie on one line", r + 1);
    std::vector<RingSegment> edges;
    if (const auto contact = find_contact(rings, run, &edges))
        source.refuse("{} and {} {}; edges may meet only at a shared vertex",
                      shown(rings, contact->first), shown(rings, contact->second),
                      contact->crossing ? "cross" : "touch");
    return edges;
}

std::unique_ptr<Mapping> make(const WarpRequest& want) {
    const bool from_file = want.options.given(file);
    if (from_file && want.options.given(vertices))
        fail(ErrorKind::usage, "--file: cannot be combined with --vertices; give one of them");
    const Source source{from_file ? ErrorKind::input : ErrorKind::usage,
                        from_file ? want.options[file] : "--vertices"};
    const auto domain = std::make_shared<const PolygonDomain>(
        want.spec(), edges_of(want.options, source, want.run), want.run);
    const Box box = domain->bounding_box();
    const double extent = std::max(box.extent(0), box.extent(1));
    if (!(extent > 1e-140 && domain->measure() > 4 * domain->slack() * extent))
        source.refuse("the area of the polygon is 0 or lost in rounding");
    return std::make_unique<DomainMapping<PolygonDomain>>(domain);
}

}  // namespace

Warp unit() {
    return {.name = "polygon",
            .summary = "Polygon of any shape, with holes and parts, uniform by area",
            .source =
                "the marginal of y, then x given y: Rosenblatt 1952, "
                "doi:10.1214/aoms/1177729394",
            .strata =
                "xi1 is the fraction of the area below, xi2 the position along the row; both are "
                "used directly; strata become pieces of horizontal bands",
            .options = Schema(vertices, file),
            .stream_version = 2,
            .mapping = make};
}

}  // namespace stipple::warps::polygon
