// SPDX-License-Identifier: MIT
//
// A list of points for each tile of a box: all that are within a distance, the reach, of any place
// of the tile. One stretch of memory then answers what is near a place.
//
// Shape   worth its memory in up to 3 directions, where a list has some tens of points.
// Cost    O(1) a place; to add a point, the tiles within reach of it.
// Promise points of a list are in the order in which they were added.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "math/neighbors/point_grid.hpp"

namespace stipple {

template <std::size_t D>
class NearLists {
  public:
    struct Near {
        std::array<double, D> at;
        std::uint32_t index;
    };

    NearLists(const Box& box, bool torus) : box_(box), frame_(box, torus, infinity) {}

    /// Distance within which lists are complete; 0 before the first call of renew.
    [[nodiscard]] double reach() const { return reach_; }
    /// Number of points at the last call of renew.
    [[nodiscard]] std::size_t renewed_at() const { return renewed_at_; }

    /// Makes all lists anew, for these points, one after the other.
    void renew(double reach, std::span<const double> rows) {
        reach_ = reach;
        count_ = 0;
        frame_ = GridFrame<D>(box_, frame_.torus(), reach / tiles_in_reach,
                              static_cast<double>(rows.size() / D) + 64);
        lists_.assign(frame_.size(), {});
        for (std::size_t i = 0; i < rows.size(); i += D) add(rows.data() + i);
        renewed_at_ = count_;
    }

    void add(const double* p) {
        Near near{{}, count_++};
        std::copy_n(p, D, near.at.begin());
        frame_.visit(p, reach_, [&](std::size_t first, std::size_t last) {
            for (std::size_t tile = first; tile < last; ++tile) lists_[tile].push_back(near);
            return true;
        });
    }

    /// All points within reach of the place, and some others.
    [[nodiscard]] const std::vector<Near>& at(const double* p) const {
        return lists_[frame_.cell_of(p)];
    }

  private:
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    static constexpr double tiles_in_reach = 2;

    Box box_;
    GridFrame<D> frame_;
    std::vector<std::vector<Near>> lists_;
    double reach_ = 0;
    std::uint32_t count_ = 0;
    std::size_t renewed_at_ = 0;
};

}  // namespace stipple
