// SPDX-License-Identifier: MIT
#include "analyzers/distances/window_counts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/parallel.hpp"
#include "core/rng.hpp"
#include "math/neighbors/point_grid.hpp"

namespace stipple::analyzers {
namespace {

/// Whole numbers, so that their order does not matter.
struct Sums {
    std::vector<std::uint64_t> counts;
    std::vector<std::uint64_t> squares;
};

constexpr std::uint64_t windows_in_block = 256;  ///< windows, of a thread

/// Adds the numbers of points within each radius of the window's centre.
template <std::size_t D>
void add_window(const SortedPoints<D>& points, const Box& box, std::span<const double> radii,
                std::uint64_t window, Sums& sums) {
    const Rng places(0, 0);
    std::array<double, D> center;
    for (std::size_t k = 0; k < D; ++k) {
        const double room = box.extent(k) - 2 * radii.back();
        center[k] = box.low[k] + radii.back() + room * places.uniform(window * D + k);
    }
    const auto squared_radius = [](double radius) { return radius * radius; };
    std::vector<std::uint64_t> shells(radii.size());
    points.visit(center.data(), radii.back(), [&](std::size_t, double squared) {
        const auto at = std::ranges::lower_bound(radii, squared, {}, squared_radius);
        if (at != radii.end()) ++shells[static_cast<std::size_t>(at - radii.begin())];
    });
    std::uint64_t inside = 0;
    for (std::size_t k = 0; k < shells.size(); ++k) {
        inside += shells[k];
        sums.counts[k] += inside;
        sums.squares[k] += inside * inside;
    }
}

template <std::size_t D>
Sums count_all(const PointSet& points, const Box& box, std::span<const double> radii,
               std::size_t windows, const RunContext& run) {
    const SortedPoints<D> sorted(
        GridFrame<D>(box, false, radii.back() / 4, static_cast<double>(points.count())),
        points.flat(), run);
    const std::vector<std::uint64_t> none(radii.size());
    std::vector<Sums> parts(block_count(windows, windows_in_block), {none, none});
    for_each_block(run, windows, windows_in_block, [&](const Block& b) {
        for (std::uint64_t w = b.first; w < b.last; ++w) {
            run.check_stop();
            add_window(sorted, box, radii, w, parts[b.index]);
        }
    });
    Sums all{none, none};
    for (const Sums& part : parts)
        for (std::size_t k = 0; k < radii.size(); ++k) {
            all.counts[k] += part.counts[k];
            all.squares[k] += part.squares[k];
        }
    return all;
}

}  // namespace

WindowCounts count_in_windows(const PointSet& points, const Box& box, std::span<const double> radii,
                              std::size_t windows, const RunContext& run) {
    const auto n = static_cast<double>(points.count());
    const auto sums = static_cast<double>(block_count(windows, windows_in_block) * radii.size());
    run.need_memory(n * (16 * static_cast<double>(points.dimension()) + 12) + 16 * sums,
                    "the counts in windows");
    const Sums all = with_dimension<3>(points.dimension(), [&]<std::size_t D>() {
        return count_all<D>(points, box, radii, windows, run);
    });
    WindowCounts found;
    const auto number = static_cast<double>(windows);
    for (std::size_t k = 0; k < radii.size(); ++k) {
        const double mean = static_cast<double>(all.counts[k]) / number;
        const double spread = static_cast<double>(all.squares[k]) / number - mean * mean;
        found.mean.push_back(mean);
        found.variance.push_back(std::max(0.0, spread) * number / (number - 1));
    }
    return found;
}

}  // namespace stipple::analyzers
