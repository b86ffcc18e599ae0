// SPDX-License-Identifier: MIT
#include "generators/binary_sequence.hpp"

#include <fmt/format.h>

#include <bit>

#include "math/digital/binary_scramble.hpp"

namespace stipple {
namespace {

std::unique_ptr<Sequence> plain_sequence(BinaryNet net) {
    return sequence_of([net = std::move(net)](std::uint64_t first, std::span<double> rows) {
        net.fill(first, rows);
    });
}

/// Nested uniform scrambling is no linear map: it takes fractions, coordinate by coordinate.
class OwenBinarySequence final : public Sequence {
  public:
    OwenBinarySequence(BinaryNet net, std::uint64_t seed) : net_(std::move(net)) {
        for (std::size_t k = 0; k < net_.dimension(); ++k) scrambles_.emplace_back(seed, k);
    }

    void fill(std::uint64_t first, std::span<double> rows) override {
        const std::size_t d = net_.dimension();
        const std::size_t step = std::max<std::size_t>(1, block_words / d);
        std::vector<std::uint64_t> block(std::min(rows.size(), step * d));
        std::vector<std::uint64_t> column(block.size() / d);
        for (std::size_t at = 0; at < rows.size(); at += block.size()) {
            const std::size_t words = std::min(block.size(), rows.size() - at);
            net_.fill(first + at / d, std::span(block).first(words));
            for (std::size_t k = 0; k < d; ++k)
                scramble(block, k, std::span(column).first(words / d), rows.data() + at + k);
        }
    }

  private:
    static constexpr std::size_t block_words = 2048;

    void scramble(const std::vector<std::uint64_t>& block, std::size_t k,
                  std::span<std::uint64_t> column, double* out) const {
        const std::size_t d = net_.dimension();
        for (std::size_t i = 0; i < column.size(); ++i) column[i] = block[i * d + k];
        scrambles_[k].apply(column);
        for (std::size_t i = 0; i < column.size(); ++i) out[i * d] = fraction_to_unit(column[i]);
    }

    BinaryNet net_;
    std::vector<BinaryOwen> scrambles_;
};

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
    return std::make_unique<OwenBinarySequence>(BinaryNet(matrices), seed);
}

bool binary_uses_seed(const Values& options) { return options[binary_scramble] != "none"; }

std::vector<std::string> binary_notes(const Request& request, const Plan& plan, const Values&) {
    const std::uint64_t start = request.start;
    if (std::has_single_bit(plan.count)) {
        const std::uint64_t before = start / plan.count * plan.count;
        if (start == before) return {};
        return {
            fmt::format("{0} points from index {1} on do not form a net; start at a multiple "
                        "of {0}: {2} or {3}",
                        plan.count, start, before, before + plan.count)};
    }
    // What starts elsewhere is a piece of a set that is made in several runs.
    if (start > 0) return {};
    const std::uint64_t below = std::bit_floor(plan.count);
    return {fmt::format("{} points do not form a net; take a power of two: {} or {}", plan.count,
                        below, 2 * below)};
}

}  // namespace stipple
