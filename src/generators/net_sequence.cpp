// SPDX-License-Identifier: MIT
#include "generators/net_sequence.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "math/combinatorics/primes.hpp"
#include "math/digital/base_scramble.hpp"
#include "math/digital/radical_inverse.hpp"
#include "math/functions/powers.hpp"

namespace stipple {
namespace {

BinaryMatrices binary(const std::vector<DigitMatrix>& matrices) {
    const std::size_t d = matrices.size();
    const std::size_t rows = std::min<std::size_t>(matrices.front().rows, 64);
    BinaryMatrices packed{d, std::vector<std::uint64_t>(d * matrices.front().columns)};
    for (std::size_t k = 0; k < d; ++k)
        for (std::size_t c = 0; c < matrices[k].columns; ++c)
            for (std::size_t r = 0; r < rows; ++r)
                packed.columns[c * d + k] |= std::uint64_t{matrices[k].at(r, c)} << (63 - r);
    return packed;
}

/// Indices that differ in their t low digits only, t being the most with b^t <= 1024.
struct LowDigits {
    explicit LowDigits(std::uint32_t base) : block(base), count(1) {
        for (; block * base <= largest_digit_table; block *= base) ++count;
        for (std::size_t m = 0; m < block; ++m) {
            std::size_t turned = 0;
            for (std::size_t rest = m, j = 0; j < count; ++j, rest /= base)
                turned = turned * base + rest % base;
            reversed.push_back(static_cast<std::uint32_t>(turned));
        }
    }
    /// Whether these digits meet the first t rows of the matrix only.
    [[nodiscard]] bool stay_on_top_of(const DigitMatrix& matrix) const {
        for (std::size_t r = count; r < matrix.rows; ++r)
            for (std::size_t c = 0; c < std::min(count, matrix.columns); ++c)
                if (matrix.at(r, c) != 0) return false;
        return true;
    }

    std::size_t block;
    std::size_t count;
    std::vector<std::uint32_t> reversed;  ///< of m < block: its t digits from last to first
};

/// Nested scrambling in an odd base. Where the matrices are triangular, points of a block share all
/// digits but the first t, so the images of all that these can be are made at once, and picked.
class OwenNet {
  public:
    OwenNet(BaseNet net, const std::vector<DigitMatrix>& matrices, std::uint32_t base,
            std::uint64_t seed)
        : net_(std::move(net)), base_(base), low_(base) {
        for (std::size_t k = 0; k < net_.dimension(); ++k) {
            scrambles_.emplace_back(seed, k, base);
            by_block_.push_back(low_.stay_on_top_of(matrices[k]));
        }
    }
    void operator()(std::uint64_t first, std::span<double> rows) const {
        net_.fill(first, rows);
        const std::size_t d = scrambles_.size();
        while (!rows.empty()) {
            const std::uint64_t left = low_.block - first % low_.block;
            const auto count =
                static_cast<std::size_t>(std::min<std::uint64_t>(rows.size() / d, left));
            for (std::size_t k = 0; k < d; ++k) scramble(k, count, rows.data() + k);
            first += count;
            rows = rows.subspan(count * d);
        }
    }

  private:
    /// The k-th coordinate of points of one block.
    void scramble(std::size_t k, std::size_t count, double* out) const {
        const std::size_t d = scrambles_.size();
        if (!by_block_[k] || count < low_.block / 8) {
            for (std::size_t i = 0; i < count; ++i)
                out[i * d] = scrambles_[k].of(reversed_digits(out[i * d], base_));
            return;
        }
        std::vector<double> images(low_.block);
        const std::uint64_t shared = reversed_digits(*out, base_) / low_.block;
        scrambles_[k].fill(shared * low_.block, low_.block, images.data(), 1);
        // Coordinates are 2^-50 apart at least, and rounded by 2^-54.
        const auto block = static_cast<double>(low_.block);
        for (std::size_t i = 0; i < count; ++i)
            out[i * d] =
                images[low_.reversed[static_cast<std::size_t>((out[i * d] + 0x1p-51) * block)]];
    }

    BaseNet net_;
    std::uint32_t base_;
    LowDigits low_;
    std::vector<BaseOwen> scrambles_;
    std::vector<bool> by_block_;
};

/// With zeros below, or without the rows below.
DigitMatrix resized(DigitMatrix matrix, std::size_t rows) {
    matrix.rows = rows;
    matrix.digits.resize(rows * matrix.columns);
    return matrix;
}

/// The scramble's matrix times the coordinate's, modulo the base.
DigitMatrix product(const BaseMatrix& left, const DigitMatrix& right, std::uint32_t base) {
    DigitMatrix result(right.rows, right.columns);
    for (std::size_t r = 0; r < right.rows; ++r)
        for (std::size_t c = 0; c < right.columns; ++c) {
            std::uint64_t sum = 0;
            for (std::size_t j = 0; j <= r; ++j)
                sum = (sum + std::uint64_t{left.entry(r, j)} * right.at(j, c)) % base;
            result.at(r, c) = static_cast<std::uint32_t>(sum);
        }
    return result;
}

}  // namespace

std::size_t net_digits(std::uint32_t base) { return base == 2 ? binary_digits : digits_of(base); }

std::uint32_t prime_base(std::int64_t base) {
    const auto number = static_cast<std::uint32_t>(base);
    if (!is_prime(number))
        fail(ErrorKind::usage, "--base: {} is not a prime, {} divides it", number,
             smallest_factor(number));
    return number;
}

void check_net_end(const Request& request, const Plan& plan, std::uint32_t base,
                   std::string_view who) {
    const std::uint64_t end = saturating_power(base, net_digits(base));
    if (request.start > end || plan.count > end - request.start)
        fail(ErrorKind::usage,
             "--start {} and {} points go beyond index {}, the last of {} in base {}",
             request.start, plan.count, end - 1, who, base);
}

std::unique_ptr<Sequence> net_sequence(std::uint32_t base, std::vector<DigitMatrix> matrices,
                                       const Plan& plan, const Values& options) {
    if (base == 2) {
        Values all = options;  // in the order of the indices, unless the unit has that option
        if (all.try_find(binary_order.name) == nullptr)
            all.put(binary_order.name, std::string(binary_order.fallback), false);
        return binary_sequence(binary(matrices), plan, all);
    }
    const std::string scramble = options[binary_scramble];
    const bool linear = scramble == "digital-shift" || scramble == "matrix";
    const std::size_t rows = linear ? digits_of(base) : matrices.front().rows;
    BaseNet net(base, rows, matrices.front().columns);
    for (std::size_t k = 0; k < matrices.size(); ++k) {
        if (linear) matrices[k] = resized(std::move(matrices[k]), rows);
        if (scramble == "matrix") {
            const BaseMatrix matrix(plan.seed, k, base);
            net.append(product(matrix, matrices[k], base), matrix.shift());
        } else if (linear) {
            net.append(matrices[k], BaseShift(plan.seed, k, base).shift());
        } else {
            net.append(matrices[k]);
        }
    }
    if (scramble == "owen") return sequence_of(OwenNet(std::move(net), matrices, base, plan.seed));
    return sequence_of([net = std::move(net)](std::uint64_t first, std::span<double> points) {
        net.fill(first, points);
    });
}

}  // namespace stipple
