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

template <std::size_t D>
class WindowCounter {
  public:
    WindowCounter(const PointSet& points, const Box& box, std::span<const double> radii,
                  const RunContext& run)
        : box_(box),
          radii_(radii),
          run_(run),
          points_(GridFrame<D>(box, false, radii.back() / 4, static_cast<double>(points.count())),
                  points.flat(), run) {
        for (const double radius : radii) squares_.push_back(radius * radius);
    }

    [[nodiscard]] WindowCounts count(std::size_t windows) const {
        std::vector<Sums> parts(block_count(windows, windows_in_block));
        for_each_block(run_, windows, windows_in_block, [&](const Block& b) {
            Sums sums{std::vector<std::uint64_t>(radii_.size()),
                      std::vector<std::uint64_t>(radii_.size())};
            for (std::uint64_t w = b.first; w < b.last; ++w) {
                run_.check_stop();
                add_window(w, sums);
            }
            parts[b.index] = std::move(sums);
        });
        WindowCounts found;
        const auto all = static_cast<double>(windows);
        for (std::size_t k = 0; k < radii_.size(); ++k) {
            std::uint64_t count = 0;
            std::uint64_t squares = 0;
            for (const Sums& part : parts) {
                count += part.counts[k];
                squares += part.squares[k];
            }
            const double mean = static_cast<double>(count) / all;
            const double spread = static_cast<double>(squares) / all - mean * mean;
            found.mean.push_back(mean);
            found.variance.push_back(std::max(0.0, spread) * all / (all - 1));
        }
        return found;
    }

  private:
    void add_window(std::uint64_t window, Sums& sums) const {
        const Rng places(0, 0);
        std::array<double, D> center;
        for (std::size_t k = 0; k < D; ++k) {
            const double room = box_.extent(k) - 2 * radii_.back();
            center[k] = box_.low[k] + radii_.back() + room * places.uniform(window * D + k);
        }
        std::vector<std::uint64_t> shells(radii_.size());
        points_.visit(center.data(), radii_.back(), [&](std::size_t, double squared) {
            const auto at = std::ranges::lower_bound(squares_, squared);
            if (at != squares_.end()) ++shells[static_cast<std::size_t>(at - squares_.begin())];
        });
        std::uint64_t inside = 0;
        for (std::size_t k = 0; k < shells.size(); ++k) {
            inside += shells[k];
            sums.counts[k] += inside;
            sums.squares[k] += inside * inside;
        }
    }

    const Box& box_;
    std::span<const double> radii_;
    const RunContext& run_;
    SortedPoints<D> points_;
    std::vector<double> squares_;  ///< of the radii
};

}  // namespace

WindowCounts count_in_windows(const PointSet& points, const Box& box, std::span<const double> radii,
                              std::size_t windows, const RunContext& run) {
    const auto n = static_cast<double>(points.count());
    const auto sums = static_cast<double>(block_count(windows, windows_in_block) * radii.size());
    run.need_memory(n * (16 * static_cast<double>(points.dimension()) + 12) + 16 * sums,
                    "the counts in windows");
    if (points.dimension() == 1) return WindowCounter<1>(points, box, radii, run).count(windows);
    if (points.dimension() == 2) return WindowCounter<2>(points, box, radii, run).count(windows);
    return WindowCounter<3>(points, box, radii, run).count(windows);
}

}  // namespace stipple::analyzers
