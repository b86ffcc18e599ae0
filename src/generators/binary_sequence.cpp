// SPDX-License-Identifier: MIT
#include "generators/binary_sequence.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>

#include "math/digital/binary_scramble.hpp"

namespace stipple {
namespace {

std::unique_ptr<Sequence> plain_sequence(BinaryNet net) {
    return sequence_of([net = std::move(net)](std::uint64_t first, std::span<double> rows) {
        net.fill(first, rows);
    });
}

/// Points a block at a time: Owen's scrambling takes the fractions of one coordinate.
constexpr std::size_t block_words = 2048;

/// Scrambles the k-th coordinate of some points.
void scramble_column(const BinaryOwen& owen, std::span<const std::uint64_t> block, std::size_t d,
                     std::size_t k, double* out) {
    std::array<std::uint64_t, block_words> column;
    const std::size_t count = block.size() / d;
    for (std::size_t i = 0; i < count; ++i) column[i] = block[i * d + k];
    owen.apply(std::span(column).first(count));
    for (std::size_t i = 0; i < count; ++i) out[i * d + k] = fraction_to_unit(column[i]);
}

/// Columns of the product of each coordinate's random matrix and its generating matrix.
BinaryMatrices scrambled(BinaryMatrices matrices, std::uint64_t seed) {
    const std::size_t d = matrices.dimension;
    for (std::size_t k = 0; k < d; ++k) {
        const auto left = binary_matrix(seed, k);
        for (std::size_t at = k; at < matrices.columns.size(); at += d) {
            std::uint64_t product = 0;
            for (std::uint64_t digits = matrices.columns[at]; digits != 0;) {
                const int digit = std::countl_zero(digits);
                product ^= left[static_cast<std::size_t>(digit)];
                digits &= ~(std::uint64_t{1} << (63 - digit));
            }
            matrices.columns[at] = product;
        }
    }
    return matrices;
}

std::vector<std::uint64_t> shifts(std::size_t dimension, std::uint64_t seed) {
    std::vector<std::uint64_t> shift;
    for (std::size_t k = 0; k < dimension; ++k) shift.push_back(binary_shift(seed, k));
    return shift;
}

}  // namespace

std::unique_ptr<Sequence> binary_sequence(BinaryMatrices matrices, const Plan& plan,
                                          const Values& options) {
    if (options[binary_order] == "gray") matrices = in_gray_order(std::move(matrices));
    const std::string scramble = options[binary_scramble];
    if (scramble == "owen") return owen_sequence(matrices, plan.seed);
    if (scramble == "none") return plain_sequence(BinaryNet(matrices));
    if (scramble == "matrix") matrices = scrambled(std::move(matrices), plan.seed);
    return plain_sequence(BinaryNet(matrices, shifts(plan.dimension, plan.seed)));
}

std::unique_ptr<Sequence> owen_sequence(const BinaryMatrices& matrices, std::uint64_t seed) {
    std::vector<BinaryOwen> owen;
    for (std::size_t k = 0; k < matrices.dimension; ++k) owen.emplace_back(seed, k);
    return sequence_of(
        [net = BinaryNet(matrices), owen](std::uint64_t first, std::span<double> rows) {
            const std::size_t d = net.dimension();
            std::vector<std::uint64_t> words(std::max<std::size_t>(1, block_words / d) * d);
            for (std::size_t at = 0; at < rows.size(); at += words.size()) {
                const auto block = std::span(words).first(std::min(words.size(), rows.size() - at));
                net.fill(first + at / d, block);
                for (std::size_t k = 0; k < d; ++k)
                    scramble_column(owen[k], block, d, k, rows.data() + at);
            }
        });
}

bool binary_uses_seed(const Values& options) { return options[binary_scramble] != "none"; }

std::vector<std::string> binary_notes(const Request& request, const Plan& plan, const Values&) {
    return net_notes(2, request, plan);
}

std::vector<std::string> net_notes(std::uint64_t base, const Request& request, const Plan& plan) {
    const std::uint64_t start = request.start;
    std::uint64_t power = 1;  // the largest of the base that is not above the count
    while (plan.count / power >= base) power *= base;
    const std::uint64_t below = plan.count / power * power;
    if (below == plan.count) {
        const std::uint64_t before = start / power * power;
        if (start == before) return {};
        return {
            fmt::format("{} points from index {} on do not form a net; start at a multiple of {}: "
                        "{} or {}",
                        plan.count, start, power, before, before + power)};
    }
    // What starts elsewhere is a piece of a set that is made in several runs.
    if (start > 0) return {};
    return {fmt::format("{} points do not form a net; take a {}power of {}: {} or {}", plan.count,
                        base == 2 ? "" : "multiple of a ", base == 2 ? "two" : std::to_string(base),
                        below, below + power)};
}

}  // namespace stipple
