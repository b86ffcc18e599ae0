// SPDX-License-Identifier: MIT
//
// The few disks about a place, and which parts of a window they cover. Lengths are in radii, so
// that a disk about p covers where sum_k (x_k - p_k)^2 < 1.
//
// A window is cut into `parts<D>` along each direction. Of a line of parts along the first
// direction a disk covers those between two ends, which one root gives:
//
//     |x_1 - p_1| < sqrt(1 - sum_{k > 1} y_k^2),    y_k from p_k to the farther face of the line.
//
// Shape   D = 2 ... 6.
// Cost    eight lines, or eight disks, at a time.
// Promise what is said to be covered is, by one disk alone, and what is said to be hit or not hit
//         is: within `slack` of a rim nothing is covered and the answer is `unsure`.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

namespace stipple {

/// Parts of a window along each direction.
template <std::size_t D>
inline constexpr std::size_t parts = D == 2   ? 8
                                     : D <= 4 ? 4
                                              : 2;

constexpr std::size_t power(std::size_t base, std::size_t exponent) {
    return exponent == 0 ? 1 : base * power(base, exponent - 1);
}

/// Lines of parts in a window.
template <std::size_t D>
inline constexpr std::size_t lines = power(parts<D>, D - 1);

/// How near to a rim arithmetic in `Real` can go wrong, where places are a few radii from zero.
inline constexpr float float_slack = 4e-6F;

/// Centres of disks, direction after direction, with eight far ones behind the last.
template <std::size_t D, class Real>
class NearDisks {
  public:
    static constexpr std::size_t lanes = 8;

    void clear() { size_ = 0; }

    void add(const std::array<Real, D>& center) {
        if constexpr (!bounded) make_room(size_ + lanes + 1);
        for (std::size_t k = 0; k < D; ++k) at_[k * room_ + size_] = center[k];
        ++size_;
    }

    /// To be called behind the last add().
    void close() {
        for (std::size_t k = 0; k < D; ++k)
            std::fill_n(at_.begin() + static_cast<std::ptrdiff_t>(k * room_ + size_), lanes,
                        Real{1e9});
    }

    /// Makes these the disks of `all` that are chosen: start_over(), take() for each eight,
    /// close().
    void start_over(const NearDisks& all) {
        if constexpr (!bounded) make_room(all.size() + 2 * lanes);
        size_ = 0;
    }
    [[gnu::always_inline]] void take(const NearDisks& all, std::size_t i,
                                     const std::int32_t (&chosen)[lanes]) {
        for (std::size_t l = 0; l < lanes; ++l) {
            for (std::size_t k = 0; k < D; ++k) at_[k * room_ + size_] = all.along(k)[i + l];
            size_ += static_cast<std::size_t>(chosen[l]);
        }
    }

    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] const Real* along(std::size_t k) const { return at_.data() + k * room_; }

  private:
    /// There are no more disks about a cell than cells about it, 7^D; for larger D mostly far
    /// fewer.
    static constexpr bool bounded = D <= 3;
    static constexpr std::size_t first_room = bounded ? power(7, D) + 2 * lanes : 128;

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

    using Store = std::conditional_t<bounded, std::array<Real, D * first_room>, std::vector<Real>>;
    static Store first_store() {
        if constexpr (bounded)
            return {};
        else
            return Store(D * first_room);
    }

    std::size_t size_ = 0;
    std::conditional_t<bounded, const std::size_t, std::size_t> room_ = first_room;
    Store at_ = first_store();
};

enum class Hit : std::uint8_t { no, yes, unsure };

/// Whether a disk covers the place.
template <std::size_t D, class Real>
Hit hits(const NearDisks<D, Real>& near, const std::array<Real, D>& place, Real slack);

/// A window by its lowest corner, and the sides of its parts.
template <std::size_t D, class Real>
struct Raster {
    std::array<Real, D> corner;
    std::array<Real, D> part;
};

/// For each line of parts the bits of those that no disk covers alone.
template <std::size_t D>
using OpenParts = std::array<std::uint8_t, lines<D>>;

/// Finds the disks that reach into a window, and what they leave open; false for nothing.
template <std::size_t D, class Real>
bool uncovered(const NearDisks<D, Real>& near, const Raster<D, Real>& window, Real slack,
               NearDisks<D, Real>& reaching, OpenParts<D>& open);

}  // namespace stipple
