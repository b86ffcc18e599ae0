// SPDX-License-Identifier: MIT
//
// Coordinates as whole multiples of 2^-63, and long sums of products of whole numbers.
#pragma once

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cstddef>
#include <cstdint>

namespace stipple::analyzers::l2 {

__extension__ using Wide = unsigned __int128;
inline constexpr unsigned place = 63;  ///< bits of a coordinate behind the point

inline std::uint64_t low(Wide value) { return static_cast<std::uint64_t>(value); }
inline std::uint64_t high(Wide value) { return static_cast<std::uint64_t>(value >> 64); }
inline Wide product(std::uint64_t a, std::uint64_t b) { return static_cast<Wide>(a) * b; }

/// The multiple of 2^-63 nearest to x in [0, 1].
inline std::uint64_t fixed(double x) {
    const double scaled = x * 0x1p63;
    const auto whole = static_cast<std::uint64_t>(scaled);
    return scaled < 0x1p52 ? static_cast<std::uint64_t>(scaled + 0.5) : whole;
}

/// Sum of whole numbers below 2^256, its carries left for the end.
class LongSum {
  public:
    void add(Wide value) {
        parts_[0] += low(value);
        parts_[1] += high(value);
    }
    void add_product(Wide a, std::uint64_t b) { add_product(a, b, 0); }
    void add_product(Wide a, Wide b) {
        add_product(a, low(b), 0);
        add_product(a, high(b), 1);
    }
    void add(const LongSum& other) {
        for (std::size_t i = 0; i < parts_.size(); ++i) parts_[i] += other.parts_[i];
    }
    [[nodiscard]] boost::multiprecision::cpp_int value() const {
        boost::multiprecision::cpp_int sum = 0;
        for (std::size_t i = parts_.size(); i-- > 0;)
            sum = (sum << 64) + (boost::multiprecision::cpp_int(high(parts_[i])) << 64) +
                  low(parts_[i]);
        return sum;
    }

  private:
    void add_product(Wide a, std::uint64_t b, std::size_t at) {
        const Wide lower = product(low(a), b);
        const Wide upper = product(high(a), b);
        parts_[at] += low(lower);
        parts_[at + 1] += high(lower);
        parts_[at + 1] += low(upper);
        parts_[at + 2] += high(upper);
    }
    std::array<Wide, 4> parts_{};
};

}  // namespace stipple::analyzers::l2
