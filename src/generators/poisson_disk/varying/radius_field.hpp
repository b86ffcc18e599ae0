// SPDX-License-Identifier: MIT
//
// How far apart points are to be at each place of a rectangle, up to a common factor:
//
//     f(x) = sqrt(largest density / density(x)),    or a given length,    or 1,
//
// constant on the cells of a grid that is stretched over the rectangle; no point may lie where the
// density is 0, and outside a mask. The largest density is that of the places where points may lie.
// Of a density and a mask with other cells, a cell is what the lines of both leave whole.
//
// Cells are joined two by two, along the direction in which they are shorter, until one covers the
// rectangle. Each of these has the bounds of what is in it.
//
// Shape   any rectangle, any grids.
// Cost    24 bytes a cell; at() O(log width + log height).
#pragma once

#include <array>
#include <boost/container/static_vector.hpp>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "core/domain.hpp"
#include "media/density_map.hpp"
#include "stipple/run.hpp"

namespace stipple::poisson_disk {

/// What a field is made of; nothing is needed, density and lengths exclude each other.
struct FieldSource {
    std::optional<DensityMap> density = {};
    std::optional<PlaneValues> lengths = {};
    std::optional<DensityMap> mask = {};
};

class RadiusField {
  public:
    /// A place where no point may lie.
    static constexpr double closed = std::numeric_limits<double>::infinity();

    /// The largest f is at most so many times the least; no box is that wide.
    static constexpr double widest = 1e75;

    /// A cell, or joined ones: column i and row j of its level; level 0 has the cells.
    struct Node {
        std::uint32_t level;
        std::uint32_t i;
        std::uint32_t j;
    };

    /// One or two of them.
    using Nodes = boost::container::static_vector<Node, 2>;

    /// @throws Error(input): no place is left; Error(limit)
    RadiusField(const Box& box, const FieldSource& source, const RunContext& run);

    [[nodiscard]] Node root() const {
        return {static_cast<std::uint32_t>(levels_.size() - 1), 0, 0};
    }

    /// What a node above level 0 joins.
    [[nodiscard]] Nodes children(const Node& node) const;

    /// The lowest and the highest corner.
    [[nodiscard]] std::array<std::array<double, 2>, 2> corners(const Node& node) const;

    /// The least f of places where points may lie; `closed` without any.
    [[nodiscard]] double least(const Node& node) const {
        return levels_[node.level].least[index(node)];
    }

    /// The largest; 0 without any.
    [[nodiscard]] double most(const Node& node) const {
        const Level& level = levels_[node.level];
        if (node.level > 0) return level.most[index(node)];
        const double value = level.least[index(node)];
        return value == closed ? 0 : value;
    }

    [[nodiscard]] double least() const { return least(root()); }

    /// f at a place of the rectangle, or `closed`.
    [[nodiscard]] double at(double x, double y) const { return within(root(), x, y); }

    /// The same where the place is known to be in the node.
    [[nodiscard]] double within(const Node& node, double x, double y) const;

    /// Integral of 1 / f^2 over the rectangle.
    [[nodiscard]] double darts() const { return darts_; }

  private:
    struct Level {
        std::array<std::size_t, 2> count;     ///< columns and rows
        std::array<std::uint32_t, 2> joined;  ///< 2^joined cells along each direction make one
        std::vector<double> least;
        std::vector<double> most;  ///< none for the cells: the same as the least
    };

    [[nodiscard]] std::size_t index(const Node& node) const {
        return node.j * levels_[node.level].count[0] + node.i;
    }
    void fill(const Box& box, const FieldSource& source, const RunContext& run);
    void join(const Box& box, const RunContext& run);
    void measure();

    std::array<std::vector<double>, 2> lines_;  ///< between cells, the faces too
    std::vector<Level> levels_;
    double darts_ = 0;
};

}  // namespace stipple::poisson_disk
