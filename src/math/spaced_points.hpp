// SPDX-License-Identifier: MIT
//
// Points of a box that keep a distance r from each other, in a grid of cells that finds the
// neighbours of a place.
//
//     distance^2 = sum_k d_k^2,    d_k = |p_k - q_k|,  on the torus min(d_k, side_k - d_k).
//
// A cell's diagonal is below r, so that a cell holds one point at most. Cells divide each side
// evenly, so that the grid closes on the torus as well; how far to look around is worked out from
// the cell's own size, direction by direction, and no cell is looked at twice where the torus is
// smaller than the neighbourhood.
//
// Shape    D directions; at most 2^32 - 2 cells.
// Cost     O(1) a question; 4 bytes a cell, about 3 (D = 2) or 7 (D = 3) cells a point.
// Promise  exact to the last pair: fits(p) is whether distance^2 >= r^2 holds, as float64 computes
//          it by the formula above, for all points that are there.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/domain.hpp"
#include "core/run_context.hpp"

namespace stipple {

/// Squared distance in a box of these sides; across its faces too when they are joined (torus).
template <std::size_t D>
double squared_distance(const double* p, const double* q, const std::array<double, D>& sides,
                        bool torus) {
    double sum = 0;
    for (std::size_t k = 0; k < D; ++k) {
        double d = std::abs(p[k] - q[k]);
        if (torus) d = std::min(d, sides[k] - d);
        sum += d * d;
    }
    return sum;
}

/// Cells along each direction of a box, with a diagonal below `radius`; as doubles, since they may
/// be more than fit.
inline std::vector<double> cells_along(const Box& box, double radius) {
    constexpr double safety = 1 + 1e-9;  // far above what rounding does, far below what matters
    std::vector<double> cells;
    for (std::size_t k = 0; k < box.dimension(); ++k) {
        const double most = radius / std::sqrt(static_cast<double>(box.dimension()));
        cells.push_back(std::floor(box.extent(k) / most * safety) + 1);
    }
    return cells;
}

template <std::size_t D>
class SpacedPoints {
  public:
    using Point = std::array<double, D>;

    SpacedPoints(const Box& box, bool torus, double radius, const RunContext& run)
        : torus_(torus), squared_radius_(radius * radius) {
        std::size_t size = 1;
        const std::vector<double> cells = cells_along(box, radius);
        for (std::size_t k = 0; k < D; ++k) {
            low_[k] = box.low[k];
            sides_[k] = box.extent(k);
            counts_[k] = static_cast<std::size_t>(cells[k]);
            scales_[k] = cells[k] / sides_[k];
            const double across = radius * scales_[k] * (1 + 1e-9);
            reaches_[k] = across < cells[k] ? static_cast<std::size_t>(across) + 1 : counts_[k];
            strides_[k] = size;
            size *= counts_[k];
        }
        // Filling a large grid takes longer than one may wait for an answer to a stop.
        cells_.reserve(size);
        while (cells_.size() < size) {
            run.check_stop();
            cells_.resize(std::min(size, cells_.size() + (std::size_t{1} << 22)), none);
        }
    }

    [[nodiscard]] std::size_t count() const { return rows_.size() / D; }
    [[nodiscard]] const double* operator[](std::size_t i) const { return rows_.data() + i * D; }

    /// Whether p keeps the distance from all points; p is in the box.
    [[nodiscard]] bool fits(const Point& p) const {
        Windows windows;
        for (std::size_t k = 0; k < D; ++k) windows[k] = window(k, p[k]);
        return fits<D - 1>(p, windows, 0);
    }

    /// Adds a point that fits.
    void add(const Point& p) {
        std::size_t cell = 0;
        for (std::size_t k = 0; k < D; ++k) cell += cell_of(k, p[k]) * strides_[k];
        cells_[cell] = static_cast<std::uint32_t>(count());
        rows_.insert(rows_.end(), p.begin(), p.end());
    }

    /// All points, one after the other.
    [[nodiscard]] std::vector<double> take() { return std::move(rows_); }

  private:
    static constexpr std::uint32_t none = 0xffff'ffff;
    static_assert(D <= 3, "more directions have longer windows");

    /// Offsets of the cells to look at along one direction: at most 7 for D <= 3.
    struct Window {
        std::array<std::size_t, 8> offsets;
        std::size_t size;
    };
    using Windows = std::array<Window, D>;

    [[nodiscard]] std::size_t cell_of(std::size_t k, double x) const {
        return std::min(static_cast<std::size_t>((x - low_[k]) * scales_[k]), counts_[k] - 1);
    }

    /// The cells around x, from the middle on: most places that do not fit are found out there.
    [[nodiscard]] Window window(std::size_t k, double x) const {
        const std::size_t cells = counts_[k];
        const std::size_t reach = reaches_[k];
        const std::size_t center = cell_of(k, x);
        Window out{.offsets = {}, .size = 0};
        const auto look_at = [&](std::size_t cell) {
            out.offsets[out.size++] = (cell < cells ? cell : cell - cells) * strides_[k];
        };
        if (2 * reach + 1 >= cells) {
            for (std::size_t i = 0; i < cells; ++i) look_at(center + i);
            return out;
        }
        const std::size_t above = torus_ ? reach : std::min(reach, cells - 1 - center);
        const std::size_t below = torus_ ? reach : std::min(reach, center);
        for (std::size_t i = 0; i <= above; ++i) look_at(center + i);
        const std::size_t left = center + (below > center ? cells : 0);
        for (std::size_t i = 1; i <= below; ++i) look_at(left - i);
        return out;
    }

    template <std::size_t K>
    [[nodiscard]] bool fits(const Point& p, const Windows& windows, std::size_t base) const {
        for (std::size_t i = 0; i < windows[K].size; ++i) {
            const std::size_t cell = base + windows[K].offsets[i];
            if constexpr (K > 0) {
                if (!fits<K - 1>(p, windows, cell)) return false;
            } else if (cells_[cell] != none && squared_distance(p.data(), (*this)[cells_[cell]],
                                                                sides_, torus_) < squared_radius_) {
                return false;
            }
        }
        return true;
    }

    bool torus_;
    double squared_radius_;
    Point low_{};
    Point sides_{};
    Point scales_{};  ///< cells over side
    std::array<std::size_t, D> counts_{};
    std::array<std::size_t, D> reaches_{};  ///< cells that a distance r can lead across
    std::array<std::size_t, D> strides_{};
    std::vector<std::uint32_t> cells_;  ///< index of the cell's point, or none
    std::vector<double> rows_;
};

}  // namespace stipple
