// SPDX-License-Identifier: MIT
//
// A bit for each cell of a grid, kept so that the bits of the 5^D cells about one are a few words:
// for every fourth cell along the first two directions a word has the 8 x 8 cells from there on,
// so that the 5 x 5 about a cell are in one word, and each cell in up to four.
//
// Cells are counted from two before the first: what is there and behind the last is set as well,
// where the box is periodic, and no cell is a special case.
//
// Shape   D = 2 or 3. Of a word that layer() gives, bit x + 8 y is of the cell at (x, y) - (2, 2)
//         from the one asked for, for x, y < 5; layer z is that at z - 2.
// Cost    half a byte a cell; one load for 25 cells.
#pragma once

#include <algorithm>
#include <atomic>
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
        : along_(grid.cells[0] / 4 + 3), layer_(along_ * (grid.cells[1] / 4 + 3)) {
        words_.resize(layer_ * (D == 2 ? 1 : grid.cells[D - 1] + 4));
    }

    void clear() { std::fill(words_.begin(), words_.end(), Word{0}); }

    /// Where the words about a cell begin, and by how much to shift them.
    struct About {
        const Word* words;
        unsigned shift;
    };
    [[nodiscard]] About about(const Index& cell) const {
        std::size_t word = (cell[1] / 4 + 1) * along_ + cell[0] / 4 + 1;
        if constexpr (D == 3) word += cell[2] * layer_;
        return {words_.data() + word, cell[1] % 4 * 8 + cell[0] % 4};
    }

    [[nodiscard]] Word layer(const About& about, std::size_t z) const {
        return about.words[z * layer_] >> about.shift & five_by_five;
    }

    /// The bit of a cell itself.
    [[nodiscard]] bool has(const Index& cell) const {
        constexpr unsigned itself = 2 * 8 + 2;
        const About here = about(cell);
        Word word = here.words[D == 2 ? 0 : 2 * layer_];
        return (word >> (here.shift + itself) & 1) != 0;
    }

    /// The same, while others may set bits.
    [[nodiscard]] bool has_meanwhile(const Index& cell) {
        constexpr unsigned itself = 2 * 8 + 2;
        const About here = about(cell);
        const std::ptrdiff_t first = here.words - words_.data();
        Word& word = words_[static_cast<std::size_t>(first) + (D == 2 ? 0 : 2 * layer_)];
        const std::atomic_ref<Word> read(word);
        return (read.load(std::memory_order_relaxed) >> (here.shift + itself) & 1) != 0;
    }

    /// Sets the bit of a cell, counted from two before the first.
    /// @param shared whether other threads may set bits as well
    void set(const Index& counted, bool shared) {
        std::size_t first = counted[1] / 4 * along_ + counted[0] / 4;
        if constexpr (D == 3) first += counted[2] * layer_;
        const Word bit = Word{1} << (counted[1] % 4 * 8 + counted[0] % 4);
        set(first + along_ + 1, bit, shared);
        set(first + along_, bit << 4, shared);
        set(first + 1, bit << 32, shared);
        set(first, bit << 36, shared);
    }

  private:
    void set(std::size_t word, Word bits, bool shared) {
        if (shared)
            std::atomic_ref<Word>(words_[word]).fetch_or(bits, std::memory_order_relaxed);
        else
            words_[word] |= bits;
    }

    std::size_t along_;  ///< words to a row: one before those asked for, and one behind
    std::size_t layer_;  ///< words to a layer
    std::vector<Word> words_;
};

}  // namespace stipple
