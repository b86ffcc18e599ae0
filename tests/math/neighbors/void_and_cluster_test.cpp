// SPDX-License-Identifier: MIT
#include "math/neighbors/void_and_cluster.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "support/units.hpp"

namespace stipple::testing::void_and_cluster_test {
namespace {

/// Oracle: the energies of all cells by their definition.
class Energies {
  public:
    Energies(std::size_t width, std::size_t height, double stretch = 1)
        : width_(width), height_(height), stretch_(std::sqrt(stretch)) {}

    [[nodiscard]] std::vector<double> of(const std::vector<std::uint32_t>& filled,
                                         double sigma) const {
        const auto across = images(width_, sigma / stretch_);
        const auto along = images(height_, sigma * stretch_);
        std::vector<double> sums(width_ * height_);
        for (std::size_t c = 0; c < sums.size(); ++c)
            for (const std::uint32_t f : filled)
                sums[c] += across[(c % width_ + width_ - f % width_) % width_] *
                           along[(c / width_ + height_ - f / width_) % height_];
        return sums;
    }

  private:
    /// Factor of one coordinate by the difference, summed over periodic images.
    static std::vector<double> images(std::size_t period, double sigma) {
        std::vector<double> sums(period);
        for (std::size_t i = 0; i < period; ++i)
            for (int m = -30; m <= 30; ++m) {
                const double d = static_cast<double>(i) + m * static_cast<double>(period);
                sums[i] += std::exp(-d * d / (2 * sigma * sigma));
            }
        return sums;
    }

    std::size_t width_;
    std::size_t height_;
    double stretch_;  ///< a cell's width relative to the square root of its area
};

bool holds(const std::vector<std::uint32_t>& cells, std::uint32_t cell) {
    return std::ranges::find(cells, cell) != cells.end();
}

/// Whether no empty cell has an energy lower than this one's by more than the truncation error.
bool is_largest_void(const std::vector<double>& energies, const std::vector<std::uint32_t>& filled,
                     std::uint32_t cell) {
    for (std::uint32_t c = 0; c < energies.size(); ++c)
        if (!holds(filled, c) && energies[c] < energies[cell] - 1e-6) return false;
    return !holds(filled, cell);
}

bool is_tightest_cluster(const std::vector<double>& energies,
                         const std::vector<std::uint32_t>& filled, std::uint32_t cell) {
    return std::ranges::all_of(
        filled, [&](std::uint32_t c) { return energies[c] <= energies[cell] + 1e-6; });
}

}  // namespace

TEST(VoidAndClusterOrder, RanksEveryCellOnce) {
    for (const auto& [width, height] : std::vector<std::pair<std::size_t, std::size_t>>{
             {1, 1}, {1, 2}, {7, 1}, {2, 2}, {3, 5}, {16, 16}, {31, 8}, {40, 3}}) {
        auto order = void_and_cluster_order(width, height, width * height, 1, {});
        std::ranges::sort(order);
        std::vector<std::uint32_t> all(width * height);
        std::iota(all.begin(), all.end(), 0U);
        EXPECT_EQ(order, all) << width << " x " << height;
    }
}

TEST(VoidAndClusterOrder, FewerRanksAreTheFirstOfAll) {
    const auto all = void_and_cluster_order(20, 20, 400, 3, {});
    for (const std::size_t wanted : {1U, 5U, 39U, 40U, 41U, 200U}) {
        const auto some = void_and_cluster_order(20, 20, wanted, 3, {});
        EXPECT_TRUE(std::ranges::equal(some, std::span(all).first(wanted))) << wanted;
    }
}

TEST(VoidAndClusterOrder, EveryRankIsWhatTheDefinitionPicks) {
    struct Torus {
        std::size_t width, height;
        double stretch;
    };
    for (const auto& [width, height, stretch] : std::vector<Torus>{
             {24, 20, 1}, {13, 17, 1}, {60, 5, 1}, {30, 10, 0.3}, {15, 20, 4}, {9, 90, 100}}) {
        const std::size_t cells = width * height;
        const std::size_t tenth = cells / 10;
        const Energies energies(width, height, stretch);
        const auto order = void_and_cluster_order(width, height, cells, 5, {}, stretch);
        for (std::size_t i = tenth; i < cells; i += 7) {
            const std::vector<std::uint32_t> filled(order.begin(),
                                                    order.begin() + static_cast<long>(i));
            EXPECT_TRUE(is_largest_void(energies.of(filled, 1.5), filled, order[i])) << i;
        }
        double sigma = 1.5;
        for (std::size_t i = tenth, next = tenth / 4; i-- > 0;) {
            const std::vector<std::uint32_t> filled(order.begin(),
                                                    order.begin() + static_cast<long>(i + 1));
            EXPECT_TRUE(is_tightest_cluster(energies.of(filled, sigma), filled, order[i])) << i;
            if (i == next) {
                sigma *= 2;
                next /= 4;
            }
        }
    }
}

// In the first tenth, moving the tightest cluster to the largest void has converged.
TEST(VoidAndClusterOrder, TheFirstTenthIsAtRest) {
    const auto order = void_and_cluster_order(30, 30, 90, 7, {});
    const Energies energies(30, 30);
    const auto full = energies.of(order, 1.5);
    const std::uint32_t tightest =
        *std::ranges::max_element(order, {}, [&](std::uint32_t c) { return full[c]; });
    std::vector<std::uint32_t> rest;
    std::ranges::copy_if(order, std::back_inserter(rest),
                         [&](std::uint32_t c) { return c != tightest; });
    EXPECT_TRUE(is_largest_void(energies.of(rest, 1.5), rest, tightest));
}

TEST(VoidAndClusterOrder, RefusesWhatNeedsTooMuchMemory) {
    EXPECT_EQ(error_of([] { void_and_cluster_order(100, 100, 1, 1, {.max_memory = 100'000}); }),
              "limit: the torus of cells needs 439 KiB of memory; the limit is 97.7 KiB | raise "
              "the limit with --max-memory");
}

}  // namespace stipple::testing::void_and_cluster_test
