// SPDX-License-Identifier: MIT
//
// Windows: cubes of a cell in which something may be uncovered yet.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "generators/poisson_disk/near_disks.hpp"

namespace stipple {

template <std::size_t D>
struct Window {
    std::array<double, D> corner;  ///< the lowest, in cells from that of the cell
    std::uint16_t place;           ///< the cell's number in its tile
    std::uint8_t level;            ///< the side is 2^-level of the cell's

    [[nodiscard]] double side() const { return 1 / static_cast<double>(std::uint64_t{1} << level); }
    [[nodiscard]] double part() const { return side() / static_cast<double>(parts<D>); }
};

/// Number of ones in a byte; a table, since the instruction is not everywhere.
inline constexpr auto ones = [] {
    std::array<std::uint8_t, 256> table{};
    for (std::size_t i = 1; i < table.size(); ++i)
        table[i] = static_cast<std::uint8_t>(table[i / 2] + i % 2);
    return table;
}();

template <std::size_t D>
std::size_t count_open(const OpenParts<D>& open) {
    std::size_t count = 0;
    for (const std::uint8_t line : open) count += ones[line];
    return count;
}

/// The lowest corner of the n-th open part, in parts.
template <std::size_t D>
std::array<double, D> open_part(const OpenParts<D>& open, std::size_t n) {
    std::size_t line = 0;
    for (; n >= ones[open[line]]; ++line) n -= ones[open[line]];
    unsigned bits = open[line];
    for (; n > 0; --n) bits &= bits - 1;
    std::array<double, D> corner;
    corner[0] = std::countr_zero(bits);
    for (std::size_t k = 1; k < D; ++k, line /= parts<D>)
        corner[k] = static_cast<double>(line % parts<D>);
    return corner;
}

/// The smallest box of parts around the open ones: [low, high), and its longest side.
template <std::size_t D>
struct Extent {
    std::array<std::size_t, D> low;
    std::size_t longest = 0;

    explicit Extent(const OpenParts<D>& open) {
        std::array<std::size_t, D> high{};
        low.fill(parts<D>);
        for (std::size_t line = 0; line < lines<D>; ++line) {
            if (open[line] == 0) continue;
            low[0] = std::min(low[0], static_cast<std::size_t>(std::countr_zero(open[line])));
            high[0] = std::max(high[0], static_cast<std::size_t>(std::bit_width(open[line])));
            for (std::size_t k = 1, rest = line; k < D; ++k, rest /= parts<D>) {
                low[k] = std::min(low[k], rest % parts<D>);
                high[k] = std::max(high[k], rest % parts<D> + 1);
            }
        }
        for (std::size_t k = 0; k < D; ++k) longest = std::max(longest, high[k] - low[k]);
    }
};

/// The halves along every direction in which something is open.
template <std::size_t D>
void split(const Window<D>& window, const OpenParts<D>& open, std::vector<Window<D>>& out) {
    constexpr std::size_t half = parts<D> / 2;
    std::uint64_t found = 0;
    for (std::size_t line = 0; line < lines<D>; ++line) {
        std::size_t child = 0;
        for (std::size_t k = 1, rest = line; k < D; ++k, rest /= parts<D>)
            child |= (rest % parts<D> / half) << k;
        const bool lower = (open[line] & ((1U << half) - 1)) != 0;
        const bool upper = (open[line] >> half) != 0;
        found |= std::uint64_t{lower} << child | std::uint64_t{upper} << (child + 1);
    }
    for (; found != 0; found &= found - 1) {
        const auto child = static_cast<std::size_t>(std::countr_zero(found));
        Window<D> smaller = window;
        ++smaller.level;
        for (std::size_t k = 0; k < D; ++k)
            smaller.corner[k] += smaller.side() * static_cast<double>(child >> k & 1);
        out.push_back(smaller);
    }
}

/// Adds what is left of a window: smaller where its open parts allow that. One that is open from
/// end to end stays whole while it is likely that no dart fell there, and is split otherwise.
/// @param darts expected number of darts that fell
template <std::size_t D>
void narrow(const Window<D>& window, const OpenParts<D>& open, double darts,
            std::vector<Window<D>>& out) {
    constexpr double enough = 2;
    const Extent<D> extent(open);
    if (extent.longest > parts<D> / 2) {
        if (darts < enough) return out.push_back(window);
        return split(window, open, out);
    }
    Window<D> smaller = window;
    std::size_t fit = parts<D>;
    for (; fit / 2 >= extent.longest && fit > 1; fit /= 2) ++smaller.level;
    for (std::size_t k = 0; k < D; ++k)
        smaller.corner[k] +=
            window.part() * static_cast<double>(std::min(extent.low[k], parts<D> - fit));
    out.push_back(smaller);
}

}  // namespace stipple
