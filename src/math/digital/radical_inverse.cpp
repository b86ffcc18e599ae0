// SPDX-License-Identifier: MIT
#include "math/digital/radical_inverse.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "math/arithmetic/ratio.hpp"

namespace stipple {
namespace {

/// The integer with the digits of an index reversed, and base^k for an index of k digits.
struct Reversed {
    Wide digits = 0;
    Wide power = 1;
};

Reversed reversed(std::uint64_t index, std::uint64_t base,
                  std::span<const std::uint32_t> permutation) {
    Reversed out;
    for (; index > 0; index /= base) {
        const std::uint64_t digit = index % base;
        out.digits = out.digits * base + (permutation.empty() ? digit : permutation[digit]);
        out.power *= base;
    }
    return out;
}

/// Combines reversed low digits with reversed high digits that all indices share: sets out[j *
/// stride] to (low[j] * high.power + high.digits) / (block * high.power).
void join(std::span<const double> low, const Reversed& high, std::uint64_t block, double* out,
          std::size_t stride) {
    const Wide denominator = high.power * block;
    if (denominator > exact_limit) {
        for (std::size_t j = 0; j < low.size(); ++j) {
            const Wide turned = static_cast<std::uint64_t>(low[j]);
            out[j * stride] = ratio(turned * high.power + high.digits, denominator);
        }
        return;
    }
    // Numerators and denominator are integers of at most 2^53: only the division rounds.
    const auto number = [](Wide x) { return static_cast<double>(static_cast<std::uint64_t>(x)); };
    fill_quotients(low, number(high.power), number(high.digits), number(denominator), out, stride);
}

}  // namespace

RadicalInverse::RadicalInverse(std::uint32_t base) : RadicalInverse(base, {}) {}

RadicalInverse::RadicalInverse(std::uint32_t base, std::vector<std::uint32_t> permutation)
    : base_(base), block_(base), permutation_(std::move(permutation)) {
    while (block_ * base <= largest_digit_table) block_ *= base;
    last_power_ = exact_limit / block_;
    if (block_ == base && permutation_.empty()) return;
    for (std::uint64_t i = 0; i < block_; ++i) {
        // Adding block_ puts a digit before the leading zeros of i, so that these are reversed,
        // too; the division removes this digit.
        const Reversed low = reversed(i + block_, base, permutation_);
        reversed_.push_back(static_cast<double>(static_cast<std::uint64_t>(low.digits / base)));
    }
}

double RadicalInverse::of(std::uint64_t index) const {
    std::uint64_t digits = 0;  // as in reversed(), but several digits at a time
    std::uint64_t power = 1;
    std::uint64_t rest = index;
    for (; rest > 0 && power <= last_power_; rest /= block_, power *= block_) {
        const std::uint64_t low = rest % block_;
        digits = digits * block_ +
                 (reversed_.empty() ? low : static_cast<std::uint64_t>(reversed_[low]));
    }
    if (rest == 0) return ratio(digits, power);
    const Reversed all = reversed(index, base_, permutation_);
    return ratio(all.digits, all.power);
}

void RadicalInverse::fill(std::uint64_t first, std::size_t count, double* out,
                          std::size_t stride) const {
    if (count == 1) {
        *out = of(first);
        return;
    }
    while (count > 0) {
        const std::uint64_t start = first % block_;
        const auto run = std::min<std::size_t>(count, block_ - start);
        const Reversed high = reversed(first / block_, base_, permutation_);
        if (reversed_.empty())
            fill_ratios(start * high.power + high.digits, high.power, high.power * block_, run, out,
                        stride);
        else
            join(std::span(reversed_).subspan(start, run), high, block_, out, stride);
        first += run;
        count -= run;
        out += run * stride;
    }
}

}  // namespace stipple
