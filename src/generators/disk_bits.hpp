// SPDX-License-Identifier: MIT
//
// A bit for each cell of a grid, kept so that the bits of the 5^D cells about one are a few words:
// for every fourth cell along the first direction a strip along the second has, byte after byte,
// the eight cells from there on. Five bytes have the 5 x 5 cells about one, and each cell is in two
// strips.
//
// Cells are counted from two before the first: what is there and behind the last is set as well,
// where the box is periodic, and no cell is a special case.
//
// Shape   D = 2 or 3. Of a word that layer() gives, bit x + 8 y is of the cell at (x, y) - (2, 2)
//         from the one asked for, for x, y < 5; layer z is that at z - 2.
// Cost    a quarter of a byte a cell; one load for 25 cells.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstring>
#include <vector>

#include "generators/disk_grid.hpp"

namespace stipple {

template <std::size_t D>
class CellBits {
  public:
    using Index = typename DiskGrid<D>::Index;
    using Word = std::uint64_t;

    static constexpr std::size_t layers = D == 2 ? 1 : 5;
    static constexpr std::size_t layer_bits = 40;  ///< from which on a layer has none
    static constexpr Word five_by_five = 0x1f1f1f1f1fU;

    explicit CellBits(const DiskGrid<D>& grid)
        : strip_(grid.cells[1] + 4), layer_(strip_ * (grid.cells[0] / 4 + 3)) {
        bytes_.resize(layer_ * (D == 2 ? 1 : grid.cells[D - 1] + 4) + sizeof(Word));
    }

    void clear() { std::fill(bytes_.begin(), bytes_.end(), std::uint8_t{0}); }
    /// Gives back the memory.
    void drop() { bytes_ = {}; }

    /// Where the cells about a cell begin, and by how much to shift them.
    struct About {
        const std::uint8_t* bytes;
        unsigned shift;
    };
    [[nodiscard]] About about(const Index& cell) const {
        std::size_t first = (cell[0] / 4 + 1) * strip_ + cell[1];
        if constexpr (D == 3) first += cell[2] * layer_;
        return {bytes_.data() + first, cell[0] % 4};
    }

    [[nodiscard]] Word layer(const About& about, std::size_t z) const {
        Word word;
        std::memcpy(&word, about.bytes + z * layer_, sizeof word);
        return word >> about.shift & five_by_five;
    }

    /// The bit of a cell itself.
    [[nodiscard]] bool has(const Index& cell) const {
        return (bytes_[byte_of(cell)] >> (cell[0] % 4 + 2) & 1) != 0;
    }

    /// The same, while others may set bits.
    [[nodiscard]] bool has_meanwhile(const Index& cell) {
        const std::atomic_ref<std::uint8_t> byte(bytes_[byte_of(cell)]);
        return (byte.load(std::memory_order_relaxed) >> (cell[0] % 4 + 2) & 1) != 0;
    }

    /// Sets the bit of a cell, counted from two before the first.
    /// @param shared whether other threads may set bits as well
    void set(const Index& counted, bool shared) {
        std::size_t first = counted[0] / 4 * strip_ + counted[1];
        if constexpr (D == 3) first += counted[2] * layer_;
        set(first + strip_, 1U << (counted[0] % 4), shared);
        set(first, 16U << (counted[0] % 4), shared);
    }

  private:
    /// The byte with a cell's bit, in the strip that begins with the cells about it.
    [[nodiscard]] std::size_t byte_of(const Index& cell) const {
        std::size_t byte = (cell[0] / 4 + 1) * strip_ + cell[1] + 2;
        if constexpr (D == 3) byte += (cell[2] + 2) * layer_;
        return byte;
    }

    void set(std::size_t byte, unsigned bits, bool shared) {
        const auto one = static_cast<std::uint8_t>(bits);
        if (shared)
            std::atomic_ref<std::uint8_t>(bytes_[byte]).fetch_or(one, std::memory_order_relaxed);
        else
            bytes_[byte] |= one;
    }

    std::size_t strip_;  ///< bytes to a strip
    std::size_t layer_;  ///< bytes to a layer: a strip before those asked for, and one behind
    std::vector<std::uint8_t> bytes_;
};

}  // namespace stipple
