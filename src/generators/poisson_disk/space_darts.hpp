// SPDX-License-Identifier: MIT
//
// Darts that may stay, of a tile of cells in space, and how to find those near a place: they are
// sorted into cubes of 4 x 4 x 4 cells, of which a radius leads to eight at most.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "generators/poisson_disk/dart_fate.hpp"
#include "generators/poisson_disk/disk_grid.hpp"

namespace stipple {

using SpaceCell = std::array<int, 3>;  ///< of a tile, from its first one on

/// Cells along each side of a tile.
inline constexpr int space_bits = static_cast<int>(DiskGrid<3>::tile_bits);
inline constexpr int space_side = 1 << space_bits;

/// A cell's number in its tile.
inline std::uint16_t space_place(const SpaceCell& cell) {
    return static_cast<std::uint16_t>(cell[0] | cell[1] << space_bits | cell[2] << 2 * space_bits);
}
inline SpaceCell space_cell(std::uint16_t place) {
    constexpr int low = space_side - 1;
    return {place & low, place >> space_bits & low, place >> 2 * space_bits};
}

/// A dart that is far enough from all older points.
struct SpaceDart {
    std::array<double, 3> at;
    std::array<float, 3> off;  ///< from the tile's corner, in radii
    std::uint32_t time;        ///< within its shower
    std::uint16_t place;       ///< of its cell

    [[nodiscard]] SpaceCell cell() const { return space_cell(place); }
    [[nodiscard]] bool before(const SpaceDart& other) const {
        return time < other.time || (time == other.time && at < other.at);
    }
};

/// The darts of a shower on a tile that may stay, sorted into cubes of 4 x 4 x 4 cells.
class SpaceDarts {
  public:
    /// @param shower its number
    void renew(std::uint64_t shower, const std::vector<SpaceDart>& darts) {
        shower_ = shower;
        first_.fill(0);
        for (const SpaceDart& d : darts) ++first_[cube_of(d.place) + 1U];
        for (std::size_t i = 0; i < cubes; ++i)
            first_[i + 1] = static_cast<std::uint16_t>(first_[i + 1] + first_[i]);
        auto next = first_;
        all_ = std::vector<SpaceDart>(darts.size());  // no more room than that
        fates_ = std::vector<SharedFate>(darts.size());
        for (auto& along : along_) along = std::vector<float>(darts.size() + 16, 1e9F);
        for (const SpaceDart& d : darts) {
            const std::size_t i = next[cube_of(d.place)]++;
            all_[i] = d;
            for (std::size_t k = 0; k < 3; ++k) along_[k][i] = d.off[k];
        }
    }

    [[nodiscard]] const std::vector<SpaceDart>& all() const { return all_; }
    /// Whether they are those of that shower.
    [[nodiscard]] bool of(std::uint64_t shower) const { return shower_ == shower; }
    void drop() {
        all_ = {};
        fates_ = {};
        along_ = {};
    }

    /// Calls visit(first, last) for the runs of darts in the cubes with cells from low to high
    /// along each direction.
    template <class Visit>
    [[gnu::always_inline]] void for_runs(SpaceCell low, SpaceCell high, const Visit& visit) const {
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = std::max(low[k], 0);
            high[k] = std::min(high[k], space_side - 1);
            if (low[k] > high[k]) return;
        }
        for (int z = low[2] / 4; z <= high[2] / 4; ++z)
            for (int y = low[1] / 4; y <= high[1] / 4; ++y) {
                const auto row = static_cast<std::size_t>((z * along_side + y) * along_side);
                const std::size_t first = first_[row + static_cast<std::size_t>(low[0] / 4)];
                const std::size_t last = first_[row + static_cast<std::size_t>(high[0] / 4) + 1];
                if (first < last) visit(first, last);
            }
    }

    [[nodiscard]] SharedFate& fate(std::size_t i) { return fates_[i]; }

    [[nodiscard]] const float* along(std::size_t k) const { return along_[k].data(); }

  private:
    static constexpr int along_side = space_side / 4;
    static constexpr std::size_t cubes = power(std::size_t{along_side}, 3);
    static std::size_t cube_of(std::uint16_t place) {
        const SpaceCell cell = space_cell(place);
        return static_cast<std::size_t>((cell[2] / 4 * along_side + cell[1] / 4) * along_side +
                                        cell[0] / 4);
    }

    std::uint64_t shower_ = 0;
    std::vector<SpaceDart> all_;
    std::vector<SharedFate> fates_;
    std::array<std::vector<float>, 3> along_;  ///< from the tile's corner, in radii
    std::array<std::uint16_t, cubes + 1> first_{};
};

}  // namespace stipple
