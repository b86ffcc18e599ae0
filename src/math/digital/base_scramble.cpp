// SPDX-License-Identifier: MIT
#include "math/digital/base_scramble.hpp"

#include <algorithm>
#include <cmath>

#include "core/machine/wide.hpp"
#include "math/arithmetic/bits.hpp"
#include "math/arithmetic/ratio.hpp"
#include "math/digital/radical_inverse.hpp"
#include "math/digital/scramble_stream.hpp"

namespace stipple {
namespace {

constexpr std::size_t lanes = 256;

/// Upper limit of b^K for which K digits can be recovered from a double: up to it, the rounding
/// errors of x and of x b^K together stay below 1/2.
constexpr std::uint64_t digits_limit = std::uint64_t{1} << 50;

/// A bijective 64-bit hash with two keys (constants: splitmix64, S. Vigna).
inline std::uint64_t mixed(std::uint64_t x, const BaseOwen::Keys& keys) {
    x = (x ^ keys.before) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 32)) + keys.between;
    x *= 0x94d049bb133111ebU;
    x = (x ^ (x >> 29)) * 0xbf58476d1ce4e5b9U;
    return x ^ (x >> 32);
}

/// Hash of a digit that follows a prefix; `low` and `high` encode the prefix and its length.
inline std::uint32_t digit_hash(std::uint32_t digit, std::uint32_t low, std::uint32_t high) {
    std::uint32_t x = low + digit * 0x9e3779b9U;
    x ^= x >> 16;
    x *= 0x7feb352dU;
    x ^= x >> 15;
    x = (x + high) * 0x846ca68bU;
    return x ^ (x >> 16);
}

/// Prefixes of one length, encoded for digit_hash().
struct Prefixes {
    std::uint32_t low[lanes];
    std::uint32_t high[lanes];
};

/// Sets rank[i] to the number of nonzero digits whose hash after prefix i precedes that of `digit`.
STIPPLE_WIDE void rank_digits(const Prefixes& at, std::size_t count, std::uint32_t base,
                              std::uint32_t digit, std::uint32_t* rank) {
    std::uint32_t own[lanes];
    for (std::size_t i = 0; i < count; ++i) {
        own[i] = digit_hash(digit, at.low[i], at.high[i]);
        rank[i] = 0;
    }
    for (std::uint32_t other = 1; other < digit; ++other)
        for (std::size_t i = 0; i < count; ++i)
            rank[i] += digit_hash(other, at.low[i], at.high[i]) <= own[i] ? 1U : 0U;
    for (std::uint32_t other = digit + 1; other < base; ++other)
        for (std::size_t i = 0; i < count; ++i)
            rank[i] += digit_hash(other, at.low[i], at.high[i]) < own[i] ? 1U : 0U;
}

/// Digit k, from 0, of the number `random` 2^-64 in base b, given `power` = b^k modulo 2^64.
inline std::uint64_t uniform_digit(std::uint64_t random, std::uint64_t power, std::uint64_t base) {
    return static_cast<std::uint64_t>((Wide{random * power} * base) >> 64);
}

std::size_t length(std::uint64_t q, std::uint64_t base) {
    std::size_t digits = 0;
    for (; q > 0; q /= base) ++digits;
    return digits;
}

/// Encodes a prefix for digit_hash(), from its hash `random` and its length `depth`.
inline void split(std::uint64_t random, std::size_t depth, std::uint64_t key, std::uint32_t& low,
                  std::uint32_t& high) {
    const std::uint64_t x = random ^ (key * (2 * depth + 1));
    low = static_cast<std::uint32_t>(x);
    high = static_cast<std::uint32_t>(x >> 32);
}

/// Returns (whole + u) / power for a u in (0, 1) taken from `random`. The result is in the interior
/// of the interval from whole / power to (whole + 1) / power, by more than its rounding error.
inline double inside(Wide whole, std::uint64_t random, Wide power) {
    if (power > digits_limit) return ratio(2 * whole + 1, 2 * power);
    const auto length = static_cast<double>(static_cast<std::uint64_t>(power));
    const double margin = length * 0x1p-51;
    const double offset = margin + (1 - 2 * margin) * to_unit(random);
    return (static_cast<double>(static_cast<std::uint64_t>(whole)) + offset) / length;
}

std::vector<std::uint32_t> random_digits(const Rng& rng, std::uint64_t first, std::size_t count,
                                         std::uint32_t base) {
    std::vector<std::uint32_t> digits;
    for (std::size_t j = 0; j < count; ++j)
        digits.push_back(static_cast<std::uint32_t>(rng.below(first + j, base)));
    return digits;
}

/// Returns digits[0] / base + digits[1] / base^2 + ...
double fraction(std::span<const std::uint64_t> digits, std::uint64_t base) {
    Wide numerator = 0;
    Wide power = 1;
    for (const std::uint64_t digit : digits) {
        numerator = numerator * base + digit;
        power *= base;
    }
    return ratio(numerator, power);
}

Wide power(std::uint64_t base, std::size_t exponent) {
    Wide out = 1;
    for (; exponent > 0; --exponent) out *= base;
    return out;
}

using Digits = std::array<std::uint64_t, 64>;

/// The lowest `count` digits of q, the least significant first.
Digits first_digits(std::uint64_t q, std::uint64_t base, std::size_t count) {
    Digits digits{};
    for (std::size_t j = 0; j < count; ++j, q /= base) digits[j] = q % base;
    return digits;
}

}  // namespace

std::size_t digits_of(std::uint32_t base) { return length(digits_limit, base) - 1; }

std::uint64_t reversed_digits(double x, std::uint32_t base) {
    const std::size_t count = digits_of(base);
    std::uint64_t power = 1;
    for (std::size_t j = 0; j < count; ++j) power *= base;
    auto m = static_cast<std::uint64_t>(std::floor(x * static_cast<double>(power) + 0.5));
    m = std::min(m, power - 1);
    std::uint64_t reversed = 0;
    for (std::size_t j = 0; j < count; ++j, m /= base) reversed = reversed * base + m % base;
    return reversed;
}

BaseShift::BaseShift(std::uint64_t seed, std::size_t coordinate, std::uint32_t base)
    : base_(base),
      shift_(random_digits(scramble_numbers(seed, ScrambleStream::base_shift), 64 * coordinate,
                           digits_of(base), base)) {}

double BaseShift::of(std::uint64_t reversed) const {
    const std::size_t count = shift_.size();
    Digits digits = first_digits(reversed, base_, count);
    for (std::size_t j = 0; j < count; ++j) digits[j] = (digits[j] + shift_[j]) % base_;
    return fraction(std::span(digits).first(count), base_);
}

BaseMatrix::BaseMatrix(std::uint64_t seed, std::size_t coordinate, std::uint32_t base)
    : base_(base) {
    const Rng rng = scramble_numbers(seed, ScrambleStream::base_matrix);
    const std::size_t count = digits_of(base);
    constexpr std::uint64_t room = 64 * 65;  // random numbers reserved per coordinate
    rows_ = random_digits(rng, room * coordinate, count * count, base);
    for (std::size_t j = 0; j < count; ++j) {
        for (std::size_t i = j + 1; i < count; ++i) rows_[j * count + i] = 0;
        rows_[j * count + j] =
            1 + static_cast<std::uint32_t>(rng.below(room * coordinate + j * count + j, base - 1));
    }
    shift_ = random_digits(rng, room * coordinate + 64 * 64, count, base);
}

double BaseMatrix::of(std::uint64_t reversed) const {
    const std::size_t count = shift_.size();
    const Digits digits = first_digits(reversed, base_, count);
    Digits image{};
    for (std::size_t j = 0; j < count; ++j) {
        std::uint64_t sum = shift_[j];
        for (std::size_t i = 0; i <= j; ++i) sum += entry(j, i) * digits[i];
        image[j] = sum % base_;
    }
    return fraction(std::span(image).first(count), base_);
}

BaseOwen::BaseOwen(std::uint64_t seed, std::size_t coordinate, std::uint32_t base)
    : base_(base), binary_(seed, coordinate), keys_{} {
    const Rng rng = scramble_numbers(seed, ScrambleStream::base_owen);
    keys_ = {rng.bits(3 * coordinate), rng.bits(3 * coordinate + 1), rng.bits(3 * coordinate + 2)};
    powers_[0] = 1;
    for (std::size_t k = 1; k < powers_.size(); ++k) powers_[k] = powers_[k - 1] * base;
    if (base == 2) return;
    do {
        block_ *= base_;
        ++low_digits_;
    } while (block_ * base_ <= largest_digit_table);
    for (std::uint64_t q = 0; q < block_; ++q) lengths_.push_back(length(q, base_));
    images_ = first_images();
    for (std::size_t depth = 1; depth < low_digits_; ++depth) append_digits(depth);
    for (std::uint64_t q = 0; q < block_; ++q) {
        // If q has L digits, its image is random within an interval of length b^-L.
        const std::uint64_t image = images_[q] / powers_[low_digits_ - lengths_[q]];
        short_.push_back(inside(image, mixed(q, keys_), power(base_, lengths_[q])));
    }
}

/// Images of all values of the first digit. Sorts the whole permutation, because computing it digit
/// by digit would be quadratic in the base.
std::vector<std::uint64_t> BaseOwen::first_images() const {
    std::uint32_t low = 0;
    std::uint32_t high = 0;
    const std::uint64_t random = mixed(0, keys_);
    split(random, 0, keys_.digit, low, high);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> order;
    for (std::uint32_t digit = 1; digit < base_; ++digit)
        order.emplace_back(digit_hash(digit, low, high), digit);
    std::ranges::sort(order);
    std::vector<std::uint64_t> images(base_, uniform_digit(random, 1, base_));
    for (std::uint32_t rank = 0; rank < order.size(); ++rank)
        images[order[rank].second] = (images[0] + 1 + rank) % base_;
    return images;
}

double BaseOwen::of(std::uint64_t reversed) const {
    double x = 0;
    fill(reversed, 1, &x, 1);
    return x;
}

void BaseOwen::fill_binary(std::uint64_t first, std::size_t count, double* out,
                           std::size_t stride) const {
    std::array<std::uint64_t, lanes> fractions;
    for (std::size_t done = 0; done < count; done += lanes) {
        const auto part = std::span(fractions).first(std::min(lanes, count - done));
        for (std::size_t i = 0; i < part.size(); ++i) part[i] = reversed_bits(first + done + i);
        binary_.apply(part);
        for (std::size_t i = 0; i < part.size(); ++i)
            out[(done + i) * stride] = fraction_to_unit(part[i]);
    }
}

/// Consecutive integers that differ only in their low_digits_ lowest digits.
struct BaseOwen::Stretch {
    std::uint64_t low;  ///< low digits of the first integer
    std::uint64_t high;
    std::size_t count;  ///< number of integers, at most `lanes`
};

/// Appends to each image of a stretch the image of `digit` at position `depth`. The prefix of
/// `digit` consists of the low digits of the integer, followed by the digits of `above`.
void BaseOwen::append_digit(const Stretch& stretch, std::uint64_t above, std::size_t depth,
                            std::uint32_t digit, std::uint64_t* image) const {
    if (stretch.count == 0) return;
    Prefixes at;
    std::uint32_t rank[lanes];
    std::uint32_t leading[lanes];
    const std::size_t above_length = above > 0 ? low_digits_ + length(above, base_) : 0;
    for (std::size_t i = 0; i < stretch.count; ++i) {
        const std::uint64_t low = stretch.low + i;
        const std::uint64_t random = mixed(above * block_ + low, keys_);
        const std::size_t digits = above > 0 ? above_length : lengths_[low];
        leading[i] =
            static_cast<std::uint32_t>(uniform_digit(random, powers_[depth - digits], base_));
        split(random, depth, keys_.digit, at.low[i], at.high[i]);
    }
    if (digit > 0) rank_digits(at, stretch.count, static_cast<std::uint32_t>(base_), digit, rank);
    for (std::size_t i = 0; i < stretch.count; ++i) {
        std::uint64_t turned = leading[i];
        if (digit > 0) turned += 1 + rank[i];
        image[i] = image[i] * base_ + (turned < base_ ? turned : turned - base_);
    }
}

/// Extends the table images_ from all prefixes of `depth` digits to those of depth + 1 digits.
void BaseOwen::append_digits(std::size_t depth) {
    const std::size_t prefixes = images_.size();
    std::vector<std::uint64_t> longer;
    for (std::uint32_t digit = 0; digit < base_; ++digit) {
        longer.insert(longer.end(), images_.begin(), images_.end());
        for (std::size_t low = 0; low < prefixes; low += lanes)
            append_digit({.low = low, .high = 0, .count = std::min(lanes, prefixes - low)}, 0,
                         depth, digit, &longer[digit * prefixes + low]);
    }
    images_ = std::move(longer);
}

void BaseOwen::join(const Stretch& stretch, double* out, std::size_t stride) const {
    std::uint64_t image[lanes];
    std::copy_n(images_.begin() + static_cast<std::ptrdiff_t>(stretch.low), stretch.count, image);
    std::size_t depth = low_digits_;
    std::uint64_t place = 1;
    std::uint64_t upper[lanes];  // images without the last digit, as those with it may exceed 2^64
    for (std::uint64_t rest = stretch.high; rest > 0; rest /= base_, place *= base_) {
        std::copy_n(image, stretch.count, upper);
        if (rest < base_) std::fill_n(image, stretch.count, 0);
        append_digit(stretch, stretch.high % place, depth++,
                     static_cast<std::uint32_t>(rest % base_), image);
    }
    const Wide whole = power(base_, depth);
    const std::uint64_t first = stretch.high * block_ + stretch.low;
    for (std::size_t i = 0; i < stretch.count; ++i)
        out[i * stride] = inside(Wide{upper[i]} * base_ + image[i], mixed(first + i, keys_), whole);
}

void BaseOwen::fill(std::uint64_t first, std::size_t count, double* out, std::size_t stride) const {
    if (base_ == 2) return fill_binary(first, count, out, stride);
    while (count > 0) {
        Stretch part{.low = first % block_, .high = first / block_, .count = 0};
        part.count = std::min({count, static_cast<std::size_t>(block_ - part.low), lanes});
        if (part.high > 0)
            join(part, out, stride);
        else
            for (std::size_t i = 0; i < part.count; ++i) out[i * stride] = short_[part.low + i];
        first += part.count;
        count -= part.count;
        out += part.count * stride;
    }
}

}  // namespace stipple
