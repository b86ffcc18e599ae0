// SPDX-License-Identifier: MIT
#include "generators/net_sequence.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <bit>

#include "core/error.hpp"
#include "math/combinatorics/primes.hpp"
#include "math/digital/base_scramble.hpp"
#include "math/digital/binary_scramble.hpp"
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

/// Blocks of b^t indices that differ only in their t lowest digits; b^t <= 1024 unless t = 1.
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
    /// True if the t lowest digits of the index affect only the first t digits of the coordinate.
    [[nodiscard]] bool stay_on_top_of(const DigitMatrix& matrix) const {
        for (std::size_t r = count; r < matrix.rows; ++r)
            for (std::size_t c = 0; c < std::min(count, matrix.columns); ++c)
                if (matrix.at(r, c) != 0) return false;
        return true;
    }

    std::size_t block;
    std::size_t count;
    std::vector<std::uint32_t> reversed;  ///< for each m < block: m with its t digits reversed
};

/// Nested scrambling in an odd base. If the matrices are triangular, points of a block share all
/// digits except the first t, so their b^t possible images are computed at once and looked up.
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
    /// Scrambles coordinate k of points that are in one block.
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
        // Coordinates differ by at least 2^-50 and have rounding errors of 2^-54, so that adding
        // 2^-51 before truncation gives the right digits.
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

/// Pads the matrix with zero rows at its end, or drops its last rows, so that `rows` remain.
DigitMatrix resized(DigitMatrix matrix, std::size_t rows) {
    matrix.rows = rows;
    matrix.digits.resize(rows * matrix.columns);
    return matrix;
}

/// Product of the scramble's and the coordinate's matrix, modulo the base.
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

std::vector<DigitMatrix> interlace(std::vector<DigitMatrix> matrices, std::size_t alpha) {
    if (alpha == 1) return matrices;
    std::vector<DigitMatrix> woven;
    for (std::size_t first = 0; first + alpha <= matrices.size(); first += alpha) {
        DigitMatrix& matrix =
            woven.emplace_back(alpha * matrices[first].rows, matrices[first].columns);
        for (std::size_t r = 0; r < matrix.rows; ++r)
            for (std::size_t c = 0; c < matrix.columns; ++c)
                matrix.at(r, c) = matrices[first + r % alpha].at(r / alpha, c);
    }
    return woven;
}

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
        Values all = options;  // in natural order if the generator has no --order
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

namespace {

std::unique_ptr<Sequence> plain_sequence(BinaryNet net) {
    return sequence_of([net = std::move(net)](std::uint64_t first, std::span<double> rows) {
        net.fill(first, rows);
    });
}

/// Number of coordinates in a block of points; Owen's scrambling treats a block axis by axis.
constexpr std::size_t block_words = 2048;

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
            if (rows.size() == d) {
                for (std::size_t k = 0; k < d; ++k)
                    rows[k] = fraction_to_unit(owen[k].of(net.word(first, k)));
                return;
            }
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
    std::uint64_t power = 1;  // largest power of the base not above the count
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
    // No note: a later start usually continues a set that is made in several runs.
    if (start > 0) return {};
    return {fmt::format("{} points do not form a net; take a {}power of {}: {} or {}", plan.count,
                        base == 2 ? "" : "multiple of a ", base == 2 ? "two" : std::to_string(base),
                        below, below + power)};
}

}  // namespace stipple
