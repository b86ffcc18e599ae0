// SPDX-License-Identifier: MIT
#include "math/fourier/window_spreading.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <vector>

#include "core/rng.hpp"
#include "support/fourier.hpp"

namespace stipple::testing::window_spreading_test {

namespace stipple {
namespace {

constexpr std::size_t side = 64;
constexpr std::size_t tiles = 5;

/// A point's window along an axis.
struct Along {
    std::size_t first;  ///< grid point
    std::array<double, KaiserBessel::max_width> weights;
};

/// A window of some width on a grid of 64 cells per side, with a buffer for the whole grid.
struct Plane {
    explicit Plane(std::size_t width, std::size_t dimension, bool weighted = false)
        : window(width, 0.2), table(window), d(dimension) {
        tile.side = side;
        tile.tiles = tiles;
        tile.shift = width % 2 == 1 ? 0.5 : 0;
        tile.lead = static_cast<double>((width - 1) / 2);
        tile.width = width;
        tile.piece_bits = static_cast<unsigned>(std::countr_zero(table.pieces()));
        tile.coefficients = table.coefficients();
        tile.numbers = d + (weighted ? 1 : 0);
        tile.extent = side + 24;
    }

    [[nodiscard]] std::vector<double> spread(const std::vector<double>& rows,
                                             Vectors widest) const {
        std::size_t cells = 1;
        for (std::size_t k = 0; k < d; ++k) cells *= tile.extent;
        std::vector<double> buffer(cells + 16);
        spread_points(places(rows, widest), d, tile, buffer.data(), widest);
        return buffer;
    }

    [[nodiscard]] Along along(double x) const {
        const double place = side * x + tile.shift;
        const double cell = std::floor(place);
        Along along{static_cast<std::size_t>(cell - tile.lead), {}};
        for (std::size_t j = 0; j < window.width(); ++j)
            along.weights[j] = weight_of(table, j, place - cell);
        return along;
    }

    /// Grid values of one tile that is the whole grid.
    [[nodiscard]] std::vector<double> places(const std::vector<double>& rows,
                                             Vectors widest = Vectors::eights) const {
        SpreadTile whole = tile;
        whole.tiles = 1;
        std::vector<double> places(rows.size());
        std::vector<std::uint32_t> none(rows.size() / tile.numbers);
        find_places(rows, d, whole, none.data(), places.data(), widest);
        return places;
    }

    KaiserBessel window;
    WeightTable table;
    SpreadTile tile;
    std::size_t d;
};

/// Points whose windows do not wrap around the grid's ends.
std::vector<double> inner_points(std::size_t count, std::size_t numbers, std::uint64_t seed) {
    std::vector<double> rows(count * numbers);
    Rng(seed).fill(0, rows);
    for (double& x : rows) x = 0.2 + 0.6 * x;
    // On a grid point, halfway between two, and next to both.
    rows[0] = 24.0 / side;
    rows[numbers] = 24.5 / side;
    rows[2 * numbers] = std::nextafter(24.0 / side, 0);
    rows[3 * numbers] = std::nextafter(24.5 / side, 0);
    return rows;
}

}  // namespace

// Compared with the table's weights, cell after cell.
TEST(WindowSpreading, AddsTheWindowsValues) {
    for (std::size_t d = 1; d <= 2; ++d)
        for (std::size_t width = KaiserBessel::min_width; width <= KaiserBessel::max_width; ++width)
            for (const bool weighted : {false, true}) {
                const Plane plane(width, d, weighted);
                const std::size_t numbers = plane.tile.numbers;
                const std::vector<double> rows = inner_points(37, numbers, width);
                std::vector<double> wanted(plane.tile.extent * plane.tile.extent);
                for (std::size_t i = 0; i < rows.size(); i += numbers) {
                    const Along x = plane.along(rows[i]);
                    const Along y = d == 2 ? plane.along(rows[i + 1]) : Along{0, {1}};
                    const double strength = weighted ? rows[i + d] : 1;
                    for (std::size_t l = 0; l < (d == 2 ? width : 1); ++l)
                        for (std::size_t j = 0; j < width; ++j)
                            wanted[(y.first + l) * plane.tile.extent + x.first + j] +=
                                strength * x.weights[j] * y.weights[l];
                }
                const std::vector<double> found = plane.spread(rows, Vectors::eights);
                double worst = 0;
                for (std::size_t c = 0; c < found.size() - 16; ++c)
                    worst = std::max(worst, std::abs(found[c] - wanted[c]));
                EXPECT_LE(worst, 1e-13) << d << "-D, width " << width;
            }
}

TEST(WindowSpreading, SameBitsForEveryWidthOfVectors) {
    for (std::size_t d = 1; d <= 3; ++d)
        for (const std::size_t width : {2U, 4U, 5U, 8U, 9U, 12U, 13U, 16U})
            for (const std::size_t count : {5U, 16U, 61U}) {
                const Plane plane(width, d);
                const std::vector<double> rows = inner_points(count, d, width + 100);
                const std::vector<double> eights = plane.spread(rows, Vectors::eights);
                EXPECT_EQ(plane.spread(rows, Vectors::fours), eights) << d << ' ' << width;
                EXPECT_EQ(plane.spread(rows, Vectors::anywhere), eights) << d << ' ' << width;
            }
}

// 1 - 2^-53 of a cell after a grid point keeps 52 bits, and is not rounded to the next one. A loose
// tolerance selects the narrowest window, a tight one the widest.
TEST(WindowSpreading, WindowsAreAsWideAsTheirToleranceNeeds) {
    EXPECT_EQ(window_for(0.5, 0.2).width(), 2U);
    EXPECT_EQ(window_for(1e-300, 0.2).width(), KaiserBessel::max_width);
    for (const double tolerance : {1e-2, 1e-5, 1e-9}) {
        const KaiserBessel window = window_for(tolerance, 0.2);
        EXPECT_LE(window.error(), tolerance);
        EXPECT_GT(KaiserBessel(window.width() - 1, 0.2).error(), tolerance);
    }
}

TEST(WindowSpreading, PlacesJustBeforeAGridPointStayThere) {
    Plane plane(6, 1);
    for (const Vectors vectors : {Vectors::anywhere, Vectors::fours, Vectors::eights}) {
        const std::vector<double> places = plane.places({std::nextafter(1.0 / side, 0)}, vectors);
        const auto word = std::bit_cast<std::uint64_t>(places[0]);
        EXPECT_EQ(word >> 52, side - 2U);
        EXPECT_EQ(word << 12 >> 12, (std::uint64_t{1} << 52) - 1);
    }
}

TEST(WindowSpreading, FindsTilesAsTheyAreDefined) {
    for (std::size_t d = 1; d <= 3; ++d)
        for (const std::size_t width : {6U, 9U}) {
            const Plane plane(width, d);
            std::vector<double> rows(501 * d);
            Rng(3).fill(0, rows);
            for (std::size_t c = 0; c <= side; ++c)
                rows[c * d] = static_cast<double>(c) / static_cast<double>(side);
            for (const Vectors vectors : {Vectors::anywhere, Vectors::fours, Vectors::eights}) {
                std::vector<std::uint32_t> found(rows.size() / d);
                std::vector<double> places(rows.size());
                find_places(rows, d, plane.tile, found.data(), places.data(), vectors);
                for (std::size_t i = 0; i < found.size(); ++i) {
                    std::size_t wanted = 0;
                    std::size_t step = 1;
                    for (std::size_t k = 0; k < d; ++k, step *= tiles) {
                        const double place = side * rows[i * d + k] + plane.tile.shift;
                        const auto first = static_cast<std::int64_t>(std::floor(place)) -
                                           static_cast<std::int64_t>(plane.tile.lead);
                        const auto cell =
                            static_cast<std::size_t>((first + static_cast<std::int64_t>(side)) %
                                                     static_cast<std::int64_t>(side));
                        std::size_t t = tiles - 1;
                        while (t * side / tiles > cell) --t;
                        wanted += t * step;
                        const auto word = std::bit_cast<std::uint64_t>(places[i * d + k]);
                        ASSERT_EQ(word >> 52, cell - t * side / tiles) << d << "-D, point " << i;
                        ASSERT_NEAR(static_cast<double>(word << 12) * 0x1p-64,
                                    place - std::floor(place), 1e-14);
                    }
                    ASSERT_EQ(found[i], wanted) << d << "-D, point " << i;
                }
            }
        }
}

}  // namespace stipple

}  // namespace stipple::testing::window_spreading_test
