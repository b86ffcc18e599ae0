// SPDX-License-Identifier: MIT
#include "math/fourier/fft.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "core/rng.hpp"
#include "math/fourier/grid_cells.hpp"

using namespace stipple;

namespace stipple::testing::fft_test {

using Complex = std::complex<double>;
using Kind = LineTransform::Kind;

Complex turn(double fraction) { return std::polar(1.0, -2 * std::numbers::pi * fraction); }

/// Oracle: the sum, term by term.
Complex sum_of(const std::vector<Complex>& x, std::size_t k) {
    Complex sum;
    for (std::size_t j = 0; j < x.size(); ++j)
        sum += x[j] * turn(static_cast<double>(j * k % x.size()) / static_cast<double>(x.size()));
    return sum;
}

struct Lines {
    Lines(std::size_t between, std::size_t count)
        : spacing(between), numbers(between * count), cells(numbers) {
        Rng(7).fill(0, {cells.get(), numbers});
    }
    [[nodiscard]] double* line(std::size_t i) const { return cells.get() + i * spacing; }

    std::size_t spacing;
    std::size_t numbers;
    GridCells cells;
};

// Lengths with all kinds of factors, and more lines than a vector holds.
TEST(LineTransform, IsTheSumTermByTerm) {
    for (const Kind kind : {Kind::real, Kind::complex})
        for (const std::size_t n : {2U, 6U, 30U, 64U, 97U, 250U}) {
            const std::size_t count = 11;
            const Lines lines((2 * n + 2) / 8 * 8 + 8, count);
            std::vector<std::vector<Complex>> x(count);
            for (std::size_t i = 0; i < count; ++i)
                for (std::size_t j = 0; j < n; ++j)
                    x[i].push_back(kind == Kind::real
                                       ? Complex(lines.line(i)[j])
                                       : Complex(lines.line(i)[2 * j], lines.line(i)[2 * j + 1]));
            LineTransform(kind, n, Planning::estimated)
                .execute(lines.cells.get(), lines.spacing, count);
            for (std::size_t i = 0; i < count; ++i)
                for (std::size_t k = 0; k < (kind == Kind::real ? n / 2 + 1 : n); ++k) {
                    const Complex here(lines.line(i)[2 * k], lines.line(i)[2 * k + 1]);
                    EXPECT_LE(std::abs(here - sum_of(x[i], k)), 1e-13 * static_cast<double>(n))
                        << "length " << n << ", line " << i << ", frequency " << k;
                }
        }
}

// The grouping of lines changes no bit of any line.
TEST(LineTransform, GivesALineTheSameBitsAloneAndAmongOthers) {
    for (const Kind kind : {Kind::real, Kind::complex})
        for (const std::size_t n : {48U, 500U, 512U}) {
            const Lines together(2 * n + 16, 15);
            const Lines alone(2 * n + 16, 15);
            const LineTransform transform(kind, n, Planning::estimated);
            transform.execute(together.cells.get(), together.spacing, 15);
            for (std::size_t i = 0; i < 15; ++i) transform.execute(alone.line(i), 0, 1);
            EXPECT_TRUE(std::equal(together.line(0), together.line(15), alone.line(0))) << n;
        }
}

TEST(GroupTransform, IsTheSumTermByTermAndGoesBack) {
    const std::vector<int> shape{3, 5, 14};
    const std::size_t size = 3 * 5 * 14;
    const GridCells values(size);
    const GridCells spectrum(std::size_t{3} * 5 * 8 * 2);
    const GroupTransform transform(shape, values.get(), spectrum.get());
    std::vector<double> x(size);
    Rng(8).fill(0, x);
    std::ranges::copy(x, values.get());
    transform.forward();
    for (std::size_t k = 0; k < 3 * 5 * 8; ++k) {
        const std::size_t a = k / 40, b = k / 8 % 5, c = k % 8;
        Complex sum;
        for (std::size_t j = 0; j < size; ++j)
            sum += x[j] * turn(static_cast<double>(j / 70 * a) / 3 +
                               static_cast<double>(j / 14 % 5 * b) / 5 +
                               static_cast<double>(j % 14 * c) / 14);
        EXPECT_LE(std::abs(sum - Complex(spectrum[2 * k], spectrum[2 * k + 1])), 1e-11) << k;
    }
    transform.backward();
    for (std::size_t j = 0; j < size; ++j)
        EXPECT_NEAR(values[j], static_cast<double>(size) * x[j], 1e-11) << j;
}

}  // namespace stipple::testing::fft_test
