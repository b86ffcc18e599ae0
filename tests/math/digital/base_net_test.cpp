// SPDX-License-Identifier: MIT
#include "math/digital/base_net.hpp"

#include <gtest/gtest.h>

#include "core/rng.hpp"
#include "math/digital/base_scramble.hpp"
#include "math/functions/powers.hpp"
#include "support/exact.hpp"

namespace stipple::testing::base_net_test {
namespace {

DigitMatrix random_matrix(std::uint32_t base, std::size_t rows, std::size_t columns,
                          std::uint64_t stream) {
    DigitMatrix matrix(rows, columns);
    const Rng rng(1, stream);
    for (std::size_t i = 0; i < matrix.digits.size(); ++i)
        matrix.digits[i] = static_cast<std::uint32_t>(rng.below(i, base));
    return matrix;
}

/// Oracle: the sum in the definition, in fractions, over the relevant rows.
Fraction by_definition(const DigitMatrix& matrix, std::uint32_t base, std::uint64_t index) {
    Fraction sum = 0;
    Fraction weight(1, base);
    for (std::size_t r = 0; r < std::min(matrix.rows, digits_of(base)); ++r, weight /= base) {
        std::uint64_t digit = 0;
        std::uint64_t rest = index;
        for (std::size_t c = 0; rest > 0; ++c, rest /= base)
            digit = (digit + rest % base * matrix.at(r, c)) % base;
        sum += weight * digit;
    }
    return sum;
}

/// Compares indices from `first` on, up to 40 of them.
void expect_definition(const BaseNet& net, const std::vector<DigitMatrix>& matrices,
                       std::uint32_t base, std::uint64_t first, std::uint64_t end) {
    const std::size_t count = std::min<std::uint64_t>(40, end - first);
    std::vector<double> rows(count * matrices.size(), -1);
    net.fill(first, rows);
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t k = 0; k < matrices.size(); ++k)
            ASSERT_TRUE(is_nearest_double(rows[i * matrices.size() + k],
                                          by_definition(matrices[k], base, first + i)))
                << "base " << base << ", index " << first + i << ", coordinate " << k;
}

const std::vector<std::uint32_t> bases = {2,   3,   5,   7,    11,   13,    31,    97,
                                          127, 131, 257, 1009, 9739, 32749, 32771, 65521};

}  // namespace

TEST(BaseNet, IsTheNearestDoubleToItsDefinition) {
    for (const std::uint32_t base : bases) {
        const std::size_t columns = digits_of(base);
        const std::vector<DigitMatrix> matrices = {random_matrix(base, columns, columns, 1),
                                                   random_matrix(base, columns + 9, columns, 2),
                                                   random_matrix(base, columns, columns, 3)};
        BaseNet net(base, columns, columns);
        for (const auto& matrix : matrices) net.append(matrix);
        const std::uint64_t end = saturating_power(base, columns);
        for (const std::uint64_t first : {std::uint64_t{0}, base - std::uint64_t{2},
                                          std::uint64_t{16370}, end / base - 20, end / 3, end - 33})
            expect_definition(net, matrices, base, first, end);
    }
}

TEST(BaseNet, TakesMatricesOfAnyShape) {
    for (const std::uint32_t base : bases)
        for (const auto& [rows, columns] :
             {std::pair<std::size_t, std::size_t>{1, 1}, {2, 1}, {1, 3}, {3, 2}, {5, 3}, {17, 2}}) {
            const std::vector<DigitMatrix> matrices = {random_matrix(base, rows, columns, 4)};
            BaseNet net(base, rows, columns);
            net.append(matrices[0]);
            const std::uint64_t end = saturating_power(base, columns);
            expect_definition(net, matrices, base, 0, end);
            expect_definition(net, matrices, base, end - 1, end);
        }
}

// Blocks end inside of the ranges, so that their boundaries are tested.
TEST(BaseNet, AnyStretchIsThatOfTheWhole) {
    for (const std::uint32_t base : bases) {
        const std::size_t columns = digits_of(base);
        BaseNet net(base, columns, columns);
        for (std::uint64_t k = 0; k < 2; ++k) net.append(random_matrix(base, columns, columns, k));
        std::vector<double> whole(2 * 70000);
        net.fill(0, whole);
        for (const std::uint64_t first : {1, 16380, 16384, 65519, 65521, 69000}) {
            std::vector<double> part(2 * 900);
            net.fill(first, part);
            ASSERT_TRUE(std::ranges::equal(part, std::span(whole).subspan(2 * first, 2 * 900)))
                << "base " << base << " from " << first;
        }
    }
}

TEST(BaseNet, NeverReachesOne) {
    for (const std::uint32_t base : bases) {
        const std::size_t digits = digits_of(base);
        DigitMatrix all(digits, 1);
        for (std::uint32_t& digit : all.digits) digit = 1;
        BaseNet net(base, digits, 1);
        net.append(all);
        std::vector<double> last(1);
        net.fill(base - 1, last);
        EXPECT_LT(last[0], 1) << base;
        EXPECT_GE(last[0], 1 - 2e-12) << base;
    }
}

}  // namespace stipple::testing::base_net_test
