// SPDX-License-Identifier: MIT
//
// The few disks near a point, and the sub-cells of a gap that they cover. Lengths are in radii: a
// disk around p covers x if sum_k (x_k - p_k)^2 < 1.
//
// On a line of sub-cells along the first direction, a disk covers the sub-cells between two ends.
// Computing both takes one square root:
//
//     |x_1 - p_1| < sqrt(1 - sum_{k > 1} y_k^2),  y_k the distance from p_k to the line's far face.
//
// Shape   D = 2 ... 6.
// Cost    eight lines, or eight disks, at a time.
// Promise a sub-cell reported as covered is covered by a single disk, and the answers Hit::yes and
//         Hit::no are right. Within `slack` of a disk's rim, sub-cells count as uncovered, and the
//         answer is Hit::unsure.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "generators/poisson_disk/gaps.hpp"

namespace stipple::poisson_disk {

/// Bound on rounding errors of floats in distances to a rim, for coordinates of a few radii.
inline constexpr float float_slack = 4e-6F;

/// The same if distances in doubles have errors of up to `slack`, far from the origin.
inline float float_slack_beside(double slack) {
    return std::max(float_slack, static_cast<float>(3 * slack));
}

/// Centres of disks, one direction after the other, padded with eight far centres.
template <std::size_t D, class Real>
class NearDisks {
  public:
    static constexpr std::size_t lanes = 8;

    void clear() { size_ = 0; }

    void add(const std::array<Real, D>& center) {
        make_room(size_ + lanes + 1);
        for (std::size_t k = 0; k < D; ++k) at_[k * room_ + size_] = center[k];
        ++size_;
    }

    /// Adds the padding; to be called after the last add().
    void close() {
        for (std::size_t k = 0; k < D; ++k)
            std::fill_n(at_.begin() + static_cast<std::ptrdiff_t>(k * room_ + size_), lanes,
                        Real{1e9});
    }

    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] const Real* along(std::size_t k) const { return at_.data() + k * room_; }

  private:
    void make_room(std::size_t size) {
        while (size > room_) {
            std::vector<Real> more(2 * at_.size());
            for (std::size_t k = 0; k < D; ++k)
                std::copy_n(along(k), size_,
                            more.begin() + static_cast<std::ptrdiff_t>(2 * k * room_));
            at_ = std::move(more);
            room_ *= 2;
        }
    }

    std::size_t size_ = 0;
    std::size_t room_ = 128;
    std::vector<Real> at_ = std::vector<Real>(D * 128);
};

enum class Hit : std::uint8_t { no, yes, unsure };

/// Whether a disk covers `place`, a point in radii.
template <std::size_t D, class Real>
Hit hits(const NearDisks<D, Real>& near, const std::array<Real, D>& place, Real slack);

/// Sub-cells of a gap: its lowest corner, and the sides of a sub-cell, in radii.
template <std::size_t D, class Real>
struct SubcellGrid {
    std::array<Real, D> corner;
    std::array<Real, D> sides;

    /// @param scales sides of a cell, in radii
    SubcellGrid(const Gap<D>& gap, const std::array<double, D>& scales) {
        for (std::size_t k = 0; k < D; ++k) {
            corner[k] = static_cast<Real>(gap.corner[k] * scales[k]);
            sides[k] = static_cast<Real>(gap.subcell_side() * scales[k]);
        }
    }
};

/// Returns the sub-cells that no single disk covers; stores the disks over the gap in `reaching`.
template <std::size_t D, class Real>
SubcellBits uncovered(const NearDisks<D, Real>& near, const SubcellGrid<D, Real>& grid, Real slack,
                      NearDisks<D, Real>& reaching);

}  // namespace stipple::poisson_disk
