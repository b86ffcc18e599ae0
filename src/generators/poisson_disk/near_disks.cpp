// SPDX-License-Identifier: MIT
#include "generators/poisson_disk/near_disks.hpp"

#include <cmath>

#include "core/machine/wide.hpp"

namespace stipple::poisson_disk {
namespace {

constexpr std::size_t lanes = 8;

/// Number of lines of sub-cells in a gap.
template <std::size_t D>
constexpr std::size_t lines = power(subcells<D>, D - 1);

template <std::size_t D, class Real>
[[gnu::always_inline]] inline Hit hits_by_lanes(const NearDisks<D, Real>& near,
                                                const std::array<Real, D>& place, Real slack) {
    Real least[lanes];
    std::fill_n(least, lanes, Real{2});
    for (std::size_t i = 0; i < near.size(); i += lanes)
        for (std::size_t l = 0; l < lanes; ++l) {
            Real squared = 0;
            for (std::size_t k = 0; k < D; ++k) {
                const Real off = near.along(k)[i + l] - place[k];
                squared += off * off;
            }
            least[l] = std::min(least[l], squared);
        }
    for (std::size_t some = lanes / 2; some > 0; some /= 2)
        for (std::size_t l = 0; l < some; ++l) least[l] = std::min(least[l], least[l + some]);
    return least[0] < 1 - slack ? Hit::yes : least[0] < 1 + slack ? Hit::unsure : Hit::no;
}

/// Middles of eight lines, along all directions except the first.
template <std::size_t D, class Real>
[[gnu::always_inline]] inline void place_lines(const SubcellGrid<D, Real>& grid, std::size_t first,
                                               Real (&middle)[D][lanes]) {
    for (std::size_t l = 0; l < lanes; ++l) {
        std::size_t rest = first + l;
        for (std::size_t k = 1; k < D; ++k, rest /= subcells<D>)
            middle[k][l] = grid.corner[k] +
                           (static_cast<Real>(rest % subcells<D>) + Real{0.5}) * grid.sides[k];
    }
}

/// Keeps x in the range of integers. Floats need no limit: they serve large gaps only, so no disk
/// is millions of sub-cells away.
[[gnu::always_inline]] inline float within_int(float x) { return x; }
[[gnu::always_inline]] inline double within_int(double x) { return std::clamp(x, -1e9, 1e9); }

/// First sub-cell boundary (0 ... P) at or after x; last_end() gives the last at or before x.
template <std::size_t D, class Real>
[[gnu::always_inline]] inline std::int32_t next_end(Real x) {
    const auto whole = static_cast<std::int32_t>(within_int(x));
    const std::int32_t up = whole + (static_cast<Real>(whole) < x ? 1 : 0);
    return std::clamp(up, 0, static_cast<std::int32_t>(subcells<D>));
}
template <std::size_t D, class Real>
[[gnu::always_inline]] inline std::int32_t last_end(Real x) {
    const auto whole = static_cast<std::int32_t>(within_int(x));
    return std::clamp(whole, 0, static_cast<std::int32_t>(subcells<D>));
}

template <std::size_t D, class Real>
[[gnu::always_inline]] inline void choose(const NearDisks<D, Real>& near,
                                          const SubcellGrid<D, Real>& grid, Real slack,
                                          NearDisks<D, Real>& reaching) {
    std::array<Real, D> half;
    std::array<Real, D> middle;
    for (std::size_t k = 0; k < D; ++k) {
        half[k] = grid.sides[k] * (Real{subcells<D>} / 2);
        middle[k] = grid.corner[k] + half[k];
    }
    reaching.clear();
    for (std::size_t i = 0; i < near.size(); i += lanes) {
        Real squared[lanes] = {};
        for (std::size_t l = 0; l < lanes; ++l)
            for (std::size_t k = 0; k < D; ++k) {
                const Real out =
                    std::max(std::abs(near.along(k)[i + l] - middle[k]) - half[k], Real{0});
                squared[l] += out * out;
            }
        for (std::size_t l = 0; l < lanes; ++l) {
            if (squared[l] >= 1 + slack) continue;
            std::array<Real, D> center;
            for (std::size_t k = 0; k < D; ++k) center[k] = near.along(k)[i + l];
            reaching.add(center);
        }
    }
    reaching.close();
}

template <std::size_t D, class Real>
[[gnu::always_inline]] inline SubcellBits uncovered_by_lanes(const NearDisks<D, Real>& near,
                                                             const SubcellGrid<D, Real>& grid,
                                                             Real slack,
                                                             NearDisks<D, Real>& reaching) {
    constexpr std::size_t p = subcells<D>;
    choose<D, Real>(near, grid, slack, reaching);
    const Real scale = 1 / grid.sides[0];
    SubcellBits open = 0;
    for (std::size_t first = 0; first < lines<D>; first += lanes) {
        Real middle[D][lanes];
        place_lines<D, Real>(grid, first, middle);
        std::int32_t covered[lanes] = {};
        for (std::size_t i = 0; i < reaching.size(); ++i) {
            const Real at = (reaching.along(0)[i] - grid.corner[0]) * scale;
            for (std::size_t l = 0; l < lanes; ++l) {
                Real left = 1 - slack;
                for (std::size_t k = 1; k < D; ++k) {
                    const Real y =
                        std::abs(reaching.along(k)[i] - middle[k][l]) + grid.sides[k] / 2;
                    left -= y * y;
                }
                const Real half = std::sqrt(std::max(left, Real{0})) * scale;
                const std::int32_t begin = next_end<D>(at - half);
                const std::int32_t end = last_end<D>(at + half);
                covered[l] |= (1 << std::max(begin, end)) - (1 << begin);
            }
        }
        for (std::size_t l = 0; l < lanes; ++l)
            open |= SubcellBits{~static_cast<std::uint32_t>(covered[l]) & ((1U << p) - 1)}
                    << (p * (first + l));
    }
    return open;
}

}  // namespace

// Instances for every dimension and number type, as STIPPLE_WIDE does not apply to templates.
#define STIPPLE_NEAR_DISKS(D, Real)                                                              \
    STIPPLE_WIDE Hit wide_hits(const NearDisks<D, Real>& near, const std::array<Real, D>& place, \
                               Real slack) {                                                     \
        return hits_by_lanes<D, Real>(near, place, slack);                                       \
    }                                                                                            \
    STIPPLE_WIDE SubcellBits wide_uncovered(const NearDisks<D, Real>& near,                      \
                                            const SubcellGrid<D, Real>& grid, Real slack,        \
                                            NearDisks<D, Real>& reaching) {                      \
        return uncovered_by_lanes<D, Real>(near, grid, slack, reaching);                         \
    }                                                                                            \
    template <>                                                                                  \
    Hit hits(const NearDisks<D, Real>& near, const std::array<Real, D>& place, Real slack) {     \
        return wide_hits(near, place, slack);                                                    \
    }                                                                                            \
    template <>                                                                                  \
    SubcellBits uncovered(const NearDisks<D, Real>& near, const SubcellGrid<D, Real>& grid,      \
                          Real slack, NearDisks<D, Real>& reaching) {                            \
        return wide_uncovered(near, grid, slack, reaching);                                      \
    }

STIPPLE_NEAR_DISKS(2, float)
STIPPLE_NEAR_DISKS(3, float)
STIPPLE_NEAR_DISKS(4, float)
STIPPLE_NEAR_DISKS(5, float)
STIPPLE_NEAR_DISKS(6, float)
STIPPLE_NEAR_DISKS(2, double)
STIPPLE_NEAR_DISKS(3, double)
STIPPLE_NEAR_DISKS(4, double)
STIPPLE_NEAR_DISKS(5, double)
STIPPLE_NEAR_DISKS(6, double)

}  // namespace stipple::poisson_disk
