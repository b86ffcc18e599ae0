// SPDX-License-Identifier: MIT
#include "math/digital/base_net.hpp"

#include <algorithm>
#include <cassert>

#include "math/digital/base_scramble.hpp"
#include "math/functions/powers.hpp"

namespace stipple {
namespace {

constexpr std::uint64_t largest_block = 1 << 14;

/// Mask of the low `bits` of every field of `width` bits.
constexpr std::uint64_t low_bits(unsigned width, unsigned bits) {
    std::uint64_t mask = 0;
    for (unsigned at = 0; at < 64; at += width) mask |= ((std::uint64_t{1} << bits) - 1) << at;
    return mask;
}

/// Arithmetic on digits packed in fields of Width bits; base <= 2^(Width-1).
template <unsigned Width>
class Fields {
  public:
    explicit Fields(std::uint64_t base)
        : base_(base), lift_(((std::uint64_t{1} << (Width - 1)) - base) * low_bits(Width, 1)) {}

    /// Returns a + b modulo the base in every field. Adding `lift_` sets the top bit of each field
    /// whose sum is at least the base; the base is then subtracted from these fields.
    [[nodiscard]] std::uint64_t sum(std::uint64_t a, std::uint64_t b) const {
        const std::uint64_t s = a + b;
        return s - (((s + lift_) >> (Width - 1)) & low_bits(Width, 1)) * base_;
    }

    /// Integer whose digits are the fields of v; the lowest field is the most significant digit.
    [[nodiscard]] std::uint64_t number(std::uint64_t v) const {
        std::uint64_t power = base_;
        if constexpr (Width <= 4) join<4>(v, power);
        if constexpr (Width <= 8) join<8>(v, power);
        if constexpr (Width <= 16) join<16>(v, power);
        return (v & 0xffffffff) * power + (v >> 32);
    }

  private:
    template <unsigned Bits>
    static void join(std::uint64_t& v, std::uint64_t& power) {
        constexpr std::uint64_t even = low_bits(2 * Bits, Bits);
        v = (v & even) * power + ((v >> Bits) & even);
        power *= power;
    }

    std::uint64_t base_;
    std::uint64_t lift_;
};

template <class Work>
void with_fields(unsigned width, std::uint64_t base, const Work& work) {
    if (width == 4) return work(Fields<4>(base));
    if (width == 8) return work(Fields<8>(base));
    if (width == 16) return work(Fields<16>(base));
    work(Fields<32>(base));
}

struct Walk {
    const BaseNet::Words* steps;
    const std::uint8_t* ruler;
    const BaseNet::Words& scales;
    std::size_t active;  ///< number of words that change within a block
    std::uint64_t rest;  ///< contribution of the other words, constant within a block
    double whole;
};

// The number of active words is a template argument, because loops this short must be unrolled.
template <std::size_t active, class F>
void walk(const F& fields, const Walk& w, BaseNet::Words state, std::size_t count, double* out,
          std::size_t stride) {
    if constexpr (active < BaseNet::most_words)
        if (w.active > active) return walk<active + 1>(fields, w, state, count, out, stride);
    for (std::size_t j = 0; j < count; ++j) {
        std::uint64_t number = w.rest;
        for (std::size_t a = 0; a < active; ++a) number += fields.number(state[a]) * w.scales[a];
        out[j * stride] = static_cast<double>(static_cast<std::int64_t>(number)) / w.whole;
        const BaseNet::Words& step = w.steps[w.ruler[j]];
        for (std::size_t a = 0; a < active; ++a) state[a] = fields.sum(state[a], step[a]);
    }
}

}  // namespace

BaseNet::BaseNet(std::uint32_t base, std::size_t rows, std::size_t columns)
    : base_(base), rows_(std::min(rows, digits_of(base))), columns_(columns) {
    assert(base >= 2 && base <= largest_base && rows >= 1 && columns >= 1);
    while (base > std::uint64_t{1} << (width_ - 1)) width_ *= 2;
    const std::size_t fields = 64 / width_;
    words_ = (rows_ + fields - 1) / fields;
    for (std::size_t word = 0; word < words_; ++word)
        scales_[word] =
            word + 1 == words_ ? 1 : saturating_power(base, rows_ - fields * (word + 1));
    whole_ = static_cast<double>(saturating_power(base, rows_));
    do {
        block_ *= base;
        ++low_digits_;
    } while (block_ * base <= largest_block);
    ruler_.resize(block_);
    for (std::uint64_t power = base; power < block_; power *= base)
        for (std::uint64_t i = power; i < block_; i += power) ++ruler_[i - 1];
}

/// Packs every `stride`-th digit into words. If the last word is not full, its lowest fields are
/// unused.
BaseNet::Words BaseNet::pack(std::span<const std::uint32_t> digits, std::size_t stride) const {
    const std::size_t fields = 64 / width_;
    const std::size_t unused = words_ * fields - rows_;
    Words packed{};
    for (std::size_t row = 0; row < rows_; ++row) {
        const std::size_t word = row / fields;
        const std::size_t field = row % fields + (word + 1 == words_ ? unused : 0);
        packed[word] |= std::uint64_t{digits[row * stride]} << (field * width_);
    }
    return packed;
}

void BaseNet::add(Words& sum, const Words& term) const {
    with_fields(width_, base_, [&](const auto& fields) {
        for (std::size_t word = 0; word < words_; ++word)
            sum[word] = fields.sum(sum[word], term[word]);
    });
}

void BaseNet::append(const DigitMatrix& matrix, std::span<const std::uint32_t> shift) {
    assert(matrix.rows >= rows_ && matrix.columns == columns_);
    assert(shift.empty() || shift.size() >= rows_);
    Coordinate& coordinate = coordinates_.emplace_back();
    if (!shift.empty()) coordinate.origin = pack(shift, 1);
    Words step{};
    for (std::size_t column = 0; column < columns_; ++column) {
        const Words packed = pack(std::span(matrix.digits).subspan(column), columns_);
        add(step, packed);
        coordinate.columns.push_back(packed);
        coordinate.steps.push_back(step);
        if (column < low_digits_)
            for (std::size_t word = 0; word < words_; ++word)
                if (packed[word] != 0) coordinate.active = std::max(coordinate.active, word + 1);
    }
    // walk() also reads the step after the last point, without using it.
    coordinate.steps.resize(std::max(columns_ + 1, low_digits_));
}

BaseNet::Words BaseNet::at(const Coordinate& coordinate, std::uint64_t index) const {
    Words sum = coordinate.origin;
    for (std::size_t column = 0; index > 0; ++column, index /= base_) {
        Words multiple = coordinate.columns[column];
        for (std::uint64_t digit = index % base_; digit > 0; digit /= 2) {
            if (digit % 2 != 0) add(sum, multiple);
            add(multiple, multiple);
        }
    }
    return sum;
}

void BaseNet::stretch(const Coordinate& coordinate, std::uint64_t first, std::size_t count,
                      double* out, std::size_t stride) const {
    const Words state = at(coordinate, first);
    with_fields(width_, base_, [&](const auto& fields) {
        std::uint64_t rest = 0;
        for (std::size_t word = coordinate.active; word < words_; ++word)
            rest += fields.number(state[word]) * scales_[word];
        walk<0>(fields,
                {coordinate.steps.data(), ruler_.data() + first % block_, scales_,
                 coordinate.active, rest, whole_},
                state, count, out, stride);
    });
}

void BaseNet::fill(std::uint64_t first, std::span<double> rows) const {
    const std::size_t d = dimension();
    const std::uint64_t longest = std::max<std::uint64_t>(256, largest_block / d);  // stay in cache
    double* out = rows.data();
    for (std::uint64_t left = rows.size() / d; left > 0;) {
        const std::uint64_t run = std::min({left, block_ - first % block_, longest});
        for (std::size_t k = 0; k < d; ++k)
            stretch(coordinates_[k], first, static_cast<std::size_t>(run), out + k, d);
        first += run;
        left -= run;
        out += run * d;
    }
}

}  // namespace stipple
