// SPDX-License-Identifier: MIT
//
// The outline of a planar domain, traced with its membership test.
//
// Shape   any domain of two coordinates.
// Cost    about 60 000 membership tests.
// Beware  parts and holes narrower than 1/200 of the box may be missed.
// Source  marching squares: W. E. Lorensen, H. E. Cline, SIGGRAPH Comput. Graph. 21 (1987) 163-169,
//         doi:10.1145/37402.37422, in two dimensions.

#include "plot/points_picture.hpp"

#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>

namespace stipple::plot {
namespace {

constexpr std::size_t cells_a_side = 200;  ///< cells of the grid along each side

class Tracer {
  public:
    explicit Tracer(const Domain& domain) : domain_(domain), box_(domain.bounding_box()) {
        // Extends the grid beyond the box, so that the whole boundary is inside. The fraction is
        // irregular, so that grid lines do not coincide with edges aligned with the box.
        for (std::size_t k = 0; k < 2; ++k) {
            const double more = 0.0137 * box_.extent(k);
            box_.low[k] -= more;
            box_.high[k] += 1.07 * more;
        }
        fineness_ = 1e-4 * std::hypot(box_.extent(0), box_.extent(1));
        for (std::size_t j = 0; j <= cells_a_side; ++j)
            for (std::size_t i = 0; i <= cells_a_side; ++i)
                inside_.push_back(inside(node(i, j)) ? 1 : 0);
    }

    std::vector<std::vector<Position>> trace() {
        for (std::size_t j = 0; j < cells_a_side; ++j)
            for (std::size_t i = 0; i < cells_a_side; ++i) cross_cell(i, j);
        std::vector<std::vector<Position>> lines;
        while (!next_.empty()) lines.push_back(follow());
        return lines;
    }

  private:
    /// An edge of the grid, from node (i, j) to the right (direction 0) or up (1).
    struct Edge {
        std::size_t i;
        std::size_t j;
        int direction;
        auto operator<=>(const Edge&) const = default;
    };

    [[nodiscard]] bool inside(Position p) const {
        const std::array<double, 2> point = {p.x, p.y};
        return domain_.contains(point);
    }

    [[nodiscard]] Position node(std::size_t i, std::size_t j) const {
        const auto along = [&](std::size_t k, std::size_t at) {
            return box_.low[k] + box_.extent(k) * static_cast<double>(at) / cells_a_side;
        };
        return {along(0, i), along(1, j)};
    }

    [[nodiscard]] bool inside_at(std::size_t i, std::size_t j) const {
        return inside_[j * (cells_a_side + 1) + i] != 0;
    }

    /// A point of the boundary between a position inside the domain and one outside, by bisection.
    [[nodiscard]] Position boundary_between(Position in, Position out) const {
        for (int halving = 0; halving < 30; ++halving) {
            const Position middle{(in.x + out.x) / 2, (in.y + out.y) / 2};
            (inside(middle) ? in : out) = middle;
        }
        return in;
    }

    [[nodiscard]] Position boundary_on(const Edge& edge) const {
        const Position a = node(edge.i, edge.j);
        const Position b =
            edge.direction == 0 ? node(edge.i + 1, edge.j) : node(edge.i, edge.j + 1);
        return inside_at(edge.i, edge.j) ? boundary_between(a, b) : boundary_between(b, a);
    }

    /// Records how the boundary crosses a cell, with the inside on its left. `ways` has an entry
    /// for each set of corners that are inside, as bits. "0321" means: from side 0 to 3 and from 2
    /// to 1 (0 bottom, 1 right, 2 top, 3 left).
    void cross_cell(std::size_t i, std::size_t j) {
        static constexpr std::array<std::string_view, 16> ways = {
            "",   "03", "10",   "13", "21", "0321", "20", "23",
            "32", "02", "1032", "12", "31", "01",   "30", ""};
        const std::array<Edge, 4> sides = {{{i, j, 0}, {i + 1, j, 1}, {i, j + 1, 0}, {i, j, 1}}};
        const std::size_t corners = (inside_at(i, j) ? 1U : 0U) + (inside_at(i + 1, j) ? 2U : 0U) +
                                    (inside_at(i + 1, j + 1) ? 4U : 0U) +
                                    (inside_at(i, j + 1) ? 8U : 0U);
        const auto side = [&](char digit) { return sides[static_cast<std::size_t>(digit - '0')]; };
        for (std::string_view way = ways[corners]; !way.empty(); way.remove_prefix(2))
            next_.emplace(side(way[0]), side(way[1]));
    }

    std::vector<Position> follow() {
        std::vector<Position> line;
        Edge at = next_.begin()->first;
        line.push_back(boundary_on(at));
        for (auto step = next_.find(at); step != next_.end(); step = next_.find(at)) {
            at = step->second;
            next_.erase(step);
            refine(line, boundary_on(at), 8);
        }
        return line;
    }

    /// Extends the line to `to`; splits the segment where the boundary deviates from it, as at
    /// corners.
    void refine(std::vector<Position>& line, Position to, int depth) const {
        const Position from = line.back();
        const Position middle{(from.x + to.x) / 2, (from.y + to.y) / 2};
        const double reach = std::hypot(to.x - from.x, to.y - from.y);
        const std::optional<Position> outline =
            depth > 0 ? boundary_beside(middle, from, to) : std::nullopt;
        const bool beside = outline &&
                            std::hypot(outline->x - middle.x, outline->y - middle.y) > fineness_ &&
                            reach > fineness_;
        if (beside) {
            refine(line, *outline, depth - 1);
            refine(line, to, depth - 1);
        } else {
            line.push_back(to);
        }
    }

    /// Point of the boundary on the perpendicular through a segment's middle, at most the segment's
    /// length away; nullopt if not found.
    [[nodiscard]] std::optional<Position> boundary_beside(Position middle, Position from,
                                                          Position to) const {
        const bool middle_inside = inside(middle);
        const double turn = middle_inside ? 1 : -1;  // the inside is left of the segment
        const Position far{middle.x + turn * (to.y - from.y), middle.y - turn * (to.x - from.x)};
        if (inside(far) == middle_inside) return std::nullopt;
        return middle_inside ? boundary_between(middle, far) : boundary_between(far, middle);
    }

    const Domain& domain_;
    Box box_;
    double fineness_;
    std::vector<char> inside_;
    std::multimap<Edge, Edge> next_;
};

}  // namespace

std::vector<std::vector<Position>> outline_of(const Domain& domain) {
    if (domain.dimension() != 2) return {};
    const Box box = domain.bounding_box();
    for (std::size_t k = 0; k < 2; ++k)
        if (!(box.extent(k) <= most_shown) ||
            visible_range(box.low[k], box.high[k]) != std::pair(box.low[k], box.high[k]))
            return {};
    return Tracer(domain).trace();
}

}  // namespace stipple::plot
