// SPDX-License-Identifier: MIT
//
// Darts of one round on one tile that no older point excludes. They are pending until it is decided
// which of them become points, and sorted into blocks of cells for neighbour queries.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "generators/poisson_disk/grid.hpp"

namespace stipple::poisson_disk {

enum class Status : std::uint8_t { pending, accepted, rejected };

template <std::size_t D>
struct PendingDart {
    std::array<double, D> at;
    std::uint32_t time;   ///< arrival time within the round
    std::uint16_t place;  ///< index of its cell in the tile

    /// Several threads may read and set the status at once: all set the same value.
    [[nodiscard]] Status status() const {
        return std::atomic_ref<Status>(status_).load(std::memory_order_relaxed);
    }
    void set(Status status) const {
        std::atomic_ref<Status>(status_).store(status, std::memory_order_relaxed);
    }

    [[nodiscard]] bool before(const PendingDart& other) const {
        return time < other.time || (time == other.time && at < other.at);
    }

    mutable Status status_ = Status::pending;  // mutable, as atomic_ref takes no constant object
};

/// Darts of a tile of 2^side_bits cells along each direction, in blocks of 2^block_bits.
template <std::size_t D, unsigned side_bits, unsigned block_bits>
class PendingDarts {
  public:
    using Dart = PendingDart<D>;
    using Cell = TileCell<D>;

    static constexpr int side = 1 << side_bits;

    /// Index of a cell in its tile.
    static std::uint16_t place_of(const Cell& cell) {
        std::uint32_t place = 0;
        for (std::size_t k = 0; k < D; ++k)
            place |= static_cast<std::uint32_t>(cell[k]) << (side_bits * k);
        return static_cast<std::uint16_t>(place);
    }
    static Cell cell_at(std::uint16_t place) {
        Cell cell;
        for (std::size_t k = 0; k < D; ++k) cell[k] = place >> (side_bits * k) & (side - 1);
        return cell;
    }

    /// Replaces the darts by those of a round.
    void renew(std::uint64_t round, const std::vector<Dart>& darts) {
        round_ = round;
        first_.fill(0);
        for (const Dart& d : darts) ++first_[block_of(d.place) + 1];
        for (std::size_t i = 0; i < blocks; ++i)
            first_[i + 1] = static_cast<std::uint16_t>(first_[i + 1] + first_[i]);
        auto next = first_;
        all_ = std::vector<Dart>(darts.size());  // without spare capacity
        for (const Dart& d : darts) all_[next[block_of(d.place)]++] = d;
    }

    [[nodiscard]] const std::vector<Dart>& all() const { return all_; }
    /// Whether the darts are those of the given round.
    [[nodiscard]] bool of(std::uint64_t round) const { return round_ == round; }

    /// Calls visit(dart) for the darts of all blocks that overlap the range of cells low..high,
    /// until a call returns true. Returns whether one did. The range may extend beyond the tile.
    template <class Visit>
    bool any(Cell low, Cell high, const Visit& visit) const {
        for (std::size_t k = 0; k < D; ++k) {
            low[k] = std::max(low[k], 0);
            high[k] = std::min(high[k], side - 1);
            if (low[k] > high[k]) return false;
            low[k] >>= block_bits;
            high[k] >>= block_bits;
        }
        Cell at = low;
        while (true) {
            at[0] = 0;
            const std::size_t row = number_of(at);
            const std::size_t last = first_[row + static_cast<std::size_t>(high[0]) + 1];
            for (std::size_t i = first_[row + static_cast<std::size_t>(low[0])]; i < last; ++i)
                if (visit(all_[i])) return true;
            std::size_t k = 1;
            for (; k < D && ++at[k] > high[k]; ++k) at[k] = low[k];
            if (k == D) return false;
        }
    }

  private:
    static constexpr std::size_t along = std::size_t{1} << (side_bits - block_bits);
    static constexpr std::size_t blocks = power(along, D);

    static std::size_t number_of(const Cell& block) {
        std::size_t number = 0;
        for (std::size_t k = D; k-- > 0;)
            number = number * along + static_cast<std::size_t>(block[k]);
        return number;
    }
    static std::size_t block_of(std::uint16_t place) {
        Cell cell = cell_at(place);
        for (int& x : cell) x >>= block_bits;
        return number_of(cell);
    }

    std::uint64_t round_ = ~std::uint64_t{0};
    std::vector<Dart> all_;
    std::array<std::uint16_t, blocks + 1> first_{};  ///< first dart of each block
};

}  // namespace stipple::poisson_disk
