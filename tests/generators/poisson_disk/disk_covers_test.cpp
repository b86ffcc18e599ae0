// SPDX-License-Identifier: MIT
#include "generators/poisson_disk/disk_covers.hpp"

#include <gtest/gtest.h>

#include <set>

#include "core/rng.hpp"

namespace stipple::testing::disk_covers_test {
namespace {

/// Largest distance from p, or its nearest image, to a corner of a box of the domain.
template <std::size_t D>
double farthest(const BoxSpace& space, const std::array<double, D>& p,
                const std::array<double, D>& low, const std::array<double, D>& sides) {
    double squared = 0;
    for (std::size_t k = 0; k < D; ++k) {
        double least = INFINITY;
        for (const int image : {-1, 0, 1}) {
            if (image != 0 && !space.torus) continue;
            const double x = p[k] + image * space.box.extent(k);
            least =
                std::min(least, std::max(std::abs(x - low[k]), std::abs(x - low[k] - sides[k])));
        }
        squared += least * least;
    }
    return std::sqrt(squared);
}

/// Sets disks about random places, and compares every bit with all of them.
template <std::size_t D>
void expect_right_bits(const BoxSpace& space, double radius, double cell_radius, int disks,
                       bool shared) {
    const DiskGrid<D> grid(space, radius, cell_radius);
    DiskCovers<D> covers(grid);
    const Rng rng(static_cast<std::uint64_t>(disks));
    std::vector<std::array<double, D>> points;
    for (int i = 0; i < disks; ++i) {
        std::array<double, D> p;
        std::array<float, D> off;
        typename DiskGrid<D>::Index cell;
        for (std::size_t k = 0; k < D; ++k) {
            const double at = rng.uniform(D * static_cast<std::uint64_t>(i) + k) * grid.cells[k];
            cell[k] = static_cast<std::uint32_t>(at);
            off[k] = static_cast<float>((at - cell[k]) * grid.scales[k]);
            p[k] = grid.low[k] + at * grid.widths[k];
        }
        points.push_back(p);
        covers.add(cell, off, shared);
    }
    // A place of the table is at most a quarter of a cell wide.
    const double quarter = 0.25 * cell_radius;
    constexpr std::size_t p = cell_parts<D>;
    std::array<double, D> sides;
    for (std::size_t k = 0; k < D; ++k) sides[k] = grid.widths[k] / double{p};
    for (std::size_t c = 0; c < grid.cell_count; ++c) {
        typename DiskGrid<D>::Index cell;
        for (std::size_t k = 0, n = c; k < D; n /= grid.cells[k], ++k)
            cell[k] = static_cast<std::uint32_t>(n % grid.cells[k]);
        for (std::size_t bit = 0; bit < 64; ++bit) {
            std::array<double, D> low;
            for (std::size_t k = 0, b = bit; k < D; b /= p, ++k)
                low[k] =
                    grid.low[k] + cell[k] * grid.widths[k] + static_cast<double>(b % p) * sides[k];
            double least = INFINITY;
            for (const auto& point : points)
                least = std::min(least, farthest<D>(space, point, low, sides));
            const bool covered = (*covers.row(grid.spot_of(cell)) >> bit & 1) != 0;
            EXPECT_TRUE(covered ? least < radius : least > radius - quarter)
                << "cell " << c << ", part " << bit << ": " << covered << ", " << least;
        }
    }
}

BoxSpace space_of(const std::vector<double>& high, bool torus) {
    return {{std::vector<double>(high.size(), 0.0), high}, torus};
}

}  // namespace

TEST(DiskCovers, BitsAreCoveredAndWhatIsWellCoveredHasItsBit) {
    for (const bool torus : {true, false})
        for (const bool shared : {true, false}) {
            SCOPED_TRACE(fmt::format("torus {}, shared {}", torus, shared));
            expect_right_bits<2>(space_of(std::vector<double>{1, 1}, torus), 0.11, 0.11, 12,
                                 shared);
            expect_right_bits<2>(space_of(std::vector<double>{3, 0.5}, torus), 0.2, 0.2, 9, shared);
            expect_right_bits<3>(space_of(std::vector<double>{1, 1, 1}, torus), 0.3, 0.3, 9,
                                 shared);
        }
}

TEST(DiskCovers, AlsoWhereADiskLeadsAroundTheTorusOrAcrossManyCells) {
    expect_right_bits<2>(space_of(std::vector<double>{1, 1}, true), 0.45, 0.45, 1, false);
    expect_right_bits<2>(space_of(std::vector<double>{1, 0.1}, true), 0.2, 0.2, 2, false);
    expect_right_bits<2>(space_of(std::vector<double>{1, 1}, true), 0.2, 0.09, 3, false);
    expect_right_bits<3>(space_of(std::vector<double>{1, 1, 0.2}, true), 0.45, 0.45, 1, false);
}

TEST(DiskCovers, CountsAndFindsBits) {
    const Rng rng(4);
    for (std::uint64_t i = 0; i < 300; ++i) {
        const PartBits bits = i % 2 == 0
                                  ? rng.bits(3 * i) & rng.bits(3 * i + 1) & rng.bits(3 * i + 2)
                                  : PartBits{1} << rng.below(i, 64);
        ASSERT_EQ(ones_of(bits), static_cast<std::size_t>(std::popcount(bits)));
        std::size_t n = 0;
        for (std::size_t b = 0; b < 64; ++b) {
            if ((bits >> b & 1) == 0) continue;
            const auto plane = nth_part<2>(bits, n);
            const auto space = nth_part<3>(bits, n++);
            EXPECT_EQ(plane[0] * 8 + plane[1] * 64, static_cast<double>(b));
            EXPECT_EQ(space[0] * 4 + space[1] * 16 + space[2] * 64, static_cast<double>(b));
        }
    }
    EXPECT_EQ(ones_of(~PartBits{0}), 64U);
    EXPECT_EQ(ones_of(0), 0U);
}

TEST(DiskCovers, TheWindowHoldsAllBitsAndCannotBeHalved) {
    const Rng rng(5);
    for (std::uint64_t i = 0; i < 400; ++i) {
        PartBits bits = PartBits{1} << rng.below(4 * i, 64);
        for (std::uint64_t k = 0; k < i % 4; ++k) bits |= PartBits{1} << rng.below(4 * i + k, 64);
        const Window<2> window = window_around<2>(bits, 5);
        EXPECT_EQ(window.place, 5);
        std::array<double, 2> low = {1, 1};
        std::array<double, 2> high = {0, 0};
        for (std::size_t n = 0; n < ones_of(bits); ++n)
            for (std::size_t k = 0; k < 2; ++k) {
                low[k] = std::min(low[k], nth_part<2>(bits, n)[k]);
                high[k] = std::max(high[k], nth_part<2>(bits, n)[k] + 0.125);
            }
        for (std::size_t k = 0; k < 2; ++k) {
            EXPECT_LE(window.corner[k], low[k]);
            EXPECT_GE(window.corner[k] + window.side(), high[k]);
            EXPECT_GE(window.corner[k], 0);
            EXPECT_LE(window.corner[k] + window.side(), 1);
        }
        EXPECT_GT(std::max(high[0] - low[0], high[1] - low[1]),
                  window.side() > 0.125 ? window.side() / 2 : 0);
    }
}

}  // namespace stipple::testing::disk_covers_test
