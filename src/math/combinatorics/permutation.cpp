// SPDX-License-Identifier: MIT
#include "math/combinatorics/permutation.hpp"

#include <algorithm>
#include <bit>

#include "core/machine/wide.hpp"
#include "math/combinatorics/splitmix64.hpp"

namespace stipple {
namespace {

using Cipher = Permutation::Cipher;

constexpr std::size_t indices_at_once = 256;
/// Maximum number of images in the table of a PermutationFamily.
constexpr std::uint64_t most_entries = std::uint64_t{1} << 20;

/// Cipher keys converted to the word type that the cipher works in.
template <class Word>
struct Keys {
    explicit Keys(const Cipher& cipher)
        : mask(static_cast<Word>((std::uint64_t{1} << cipher.width) - 1)),
          shift((cipher.width + 1) / 2) {
        for (std::size_t t = 0; t < Permutation::rounds; ++t) {
            flips[t] = static_cast<Word>(cipher.flips[t]);
            factors[t] = static_cast<Word>(cipher.factors[t]);
        }
    }

    /// Applies the cipher, a bijection of the words of cipher.width bits.
    [[nodiscard]] Word operator()(Word x) const {
#pragma GCC unroll 12
        for (std::size_t t = 0; t < Permutation::rounds; ++t) {
            x = ((x ^ flips[t]) * factors[t]) & mask;
            x ^= x >> shift;
        }
        return x;
    }

    Word mask;
    int shift;
    std::array<Word, Permutation::rounds> flips;
    std::array<Word, Permutation::rounds> factors;
};

// The keys are passed by value so that the compiler knows that they do not overlap x.
template <class Word>
STIPPLE_WIDE void encipher(Keys<Word> keys, Word* x, std::size_t count) {
    for (std::size_t j = 0; j < count; ++j) x[j] = keys(x[j]);
}

/// Computes the images of `count` indices from `first` on. Images that are not below `size` are
/// gathered and enciphered again, all together.
template <class Word>
void images(const Cipher& cipher, std::uint64_t size, std::uint64_t first, std::size_t count,
            double* out) {
    Word x[indices_at_once];
    std::uint8_t place[indices_at_once];
    for (std::size_t j = 0; j < count; ++j) x[j] = static_cast<Word>(first + j);
    const Keys<Word> keys(cipher);
    encipher(keys, x, count);
    for (std::size_t j = 0; j < count; ++j) out[j] = static_cast<double>(x[j]);
    const std::uint64_t words = std::uint64_t{1} << cipher.width;
    if (size == words) return;
    std::size_t outside = 0;
    for (std::size_t j = 0; j < count; ++j) {
        place[outside] = static_cast<std::uint8_t>(j);
        x[outside] = x[j];
        outside += x[j] >= size;
    }
    while (outside > 0) {
        encipher(keys, x, outside);
        std::size_t left = 0;
        for (std::size_t j = 0; j < outside; ++j) {
            out[place[j]] = static_cast<double>(x[j]);
            place[left] = place[j];
            x[left] = x[j];
            left += x[j] >= size;
        }
        outside = left;
    }
}

}  // namespace

Permutation::Permutation(std::uint64_t size, std::uint64_t key) : size_(size) {
    SplitMix64 stream(key);
    if (size <= small) {
        for (std::uint64_t i = 0; i < size; ++i) {
            const std::uint64_t j = stream.below(i + 1);
            table_[i] = table_[j];
            table_[j] = static_cast<std::uint8_t>(i);
        }
        return;
    }
    cipher_.width = static_cast<int>(std::bit_width(size - 1));
    for (std::size_t t = 0; t < rounds; ++t) {
        cipher_.flips[t] = stream.next() >> (64 - cipher_.width);
        cipher_.factors[t] = stream.next() >> (64 - cipher_.width) | 1;
    }
}

std::uint64_t Permutation::operator()(std::uint64_t i) const {
    if (size_ <= small) return table_[i];
    const Keys<std::uint64_t> keys(cipher_);
    do i = keys(i);
    while (i >= size_);
    return i;
}

void Permutation::fill(std::uint64_t first, std::span<double> out) const {
    if (size_ <= small) {
        for (std::size_t j = 0; j < out.size(); ++j) out[j] = table_[first + j];
        return;
    }
    for (std::size_t i = 0; i < out.size(); i += indices_at_once) {
        const std::size_t count = std::min(indices_at_once, out.size() - i);
        if (cipher_.width <= 32)
            images<std::uint32_t>(cipher_, size_, first + i, count, out.data() + i);
        else
            images<std::uint64_t>(cipher_, size_, first + i, count, out.data() + i);
    }
}

PermutationFamily::PermutationFamily(std::uint64_t size, std::uint64_t members, const Rng& keys)
    : size_(size), keys_(keys) {
    if (members == 0 || size > most_entries / members) return;
    std::vector<double> images(size);
    table_.reserve(size * members);
    for (std::uint64_t member = 0; member < members; ++member) {
        Permutation(size, keys.bits(member)).fill(0, images);
        for (const double image : images) table_.push_back(static_cast<std::uint32_t>(image));
    }
}

std::uint64_t PermutationFamily::operator()(std::uint64_t member, std::uint64_t i) const {
    if (!table_.empty()) return table_[member * size_ + i];
    return Permutation(size_, keys_.bits(member))(i);
}

}  // namespace stipple
