// SPDX-License-Identifier: MIT
//
// Distance that points should have at each position in a rectangle, up to a common factor:
//
//     f(x) = sqrt(largest density / density(x)),    or a given length,    or 1,
//
// constant on the cells of a grid that is stretched over the rectangle. Points are not allowed
// where the density is 0, or outside a mask; the largest density is that where they are allowed. If
// a density and a mask have different cells, the lines of both bound the field's cells.
//
// Cells are joined two by two, along the direction in which they are shorter, until one covers the
// rectangle. Each joined cell stores the minimum and the maximum of f in it.
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

/// Sources of a field, all of them optional; density and lengths exclude each other.
struct FieldSource {
    std::optional<DensityMap> density = {};
    std::optional<PlaneValues> lengths = {};
    std::optional<DensityMap> mask = {};
};

class RadiusField {
  public:
    /// Value of f where points are not allowed.
    static constexpr double closed = std::numeric_limits<double>::infinity();

    /// Maximum ratio of f to its minimum. Larger values of f are reduced to that, which has no
    /// effect on the points, because no box is so wide.
    static constexpr double widest = 1e75;

    /// A cell or joined cells: column i, row j of a level; level 0 has the field's own cells.
    struct Node {
        std::uint32_t level;
        std::uint32_t i;
        std::uint32_t j;
    };

    using Nodes = boost::container::static_vector<Node, 2>;

    /// @throws Error(input) if points are allowed nowhere; Error(limit)
    RadiusField(const Box& box, const FieldSource& source, const RunContext& run);

    [[nodiscard]] Node root() const {
        return {static_cast<std::uint32_t>(levels_.size() - 1), 0, 0};
    }

    /// The nodes that were joined to form a node above level 0.
    [[nodiscard]] Nodes children(const Node& node) const;

    /// Lowest and highest corner.
    [[nodiscard]] std::array<std::array<double, 2>, 2> corners(const Node& node) const;

    /// Minimum of f where points are allowed; `closed` if they are allowed nowhere.
    [[nodiscard]] double least(const Node& node) const {
        return levels_[node.level].least[index(node)];
    }

    /// Maximum of f where points are allowed; 0 if they are allowed nowhere.
    [[nodiscard]] double most(const Node& node) const {
        const Level& level = levels_[node.level];
        if (node.level > 0) return level.most[index(node)];
        const double value = level.least[index(node)];
        return value == closed ? 0 : value;
    }

    [[nodiscard]] double least() const { return least(root()); }

    /// f at a position in the rectangle; `closed` if points are not allowed there.
    [[nodiscard]] double at(double x, double y) const { return within(root(), x, y); }

    /// f at a position that is known to be in the node.
    [[nodiscard]] double within(const Node& node, double x, double y) const;

    /// A power of two near the minimum of f, used as a unit because 1 / f^2 may overflow.
    [[nodiscard]] double unit() const { return unit_; }

    /// Integral of (unit / f)^2 over the rectangle.
    [[nodiscard]] double darts() const { return darts_; }

  private:
    struct Level {
        std::array<std::size_t, 2> count;     ///< columns and rows
        std::array<std::uint32_t, 2> joined;  ///< a node joins 2^joined cells along each direction
        std::vector<double> least;
        std::vector<double> most;  ///< empty on level 0, where it is the same as `least`
    };

    [[nodiscard]] std::size_t index(const Node& node) const {
        return node.j * levels_[node.level].count[0] + node.i;
    }
    void fill(const Box& box, const FieldSource& source, const RunContext& run);
    void join(const Box& box, const RunContext& run);
    void measure();

    /// Boundaries between cells along each axis, including the two sides of the rectangle.
    std::array<std::vector<double>, 2> lines_;
    std::vector<Level> levels_;
    double unit_ = 1;
    double darts_ = 0;
};

}  // namespace stipple::poisson_disk
