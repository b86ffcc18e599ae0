// SPDX-License-Identifier: MIT
//
// Tiles of cells in space, with all that is needed to throw darts at them: a tile's points and
// their coverage, and those of two layers of cells around it.
//
// Shape   cells hold at most one point, and a radius spans two cells; at least five cells along
//         each direction. Up to 32 cells along each side of a tile; a tile may be its own neighbour
//         on a torus.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <span>
#include <vector>

#include "core/machine/memory.hpp"
#include "generators/poisson_disk/space/ball_kernels.hpp"
#include "generators/poisson_disk/space/ball_lines.hpp"
#include "generators/poisson_disk/tile_rounds.hpp"

namespace stipple::poisson_disk {

/// Number of cells along a tile with its halo.
inline constexpr int space_across = space_side + 4;

/// One bit for each cell of a tile and its halo. A byte has eight cells in a row along the first
/// direction and begins at a multiple of four; bytes with the same beginning are ordered by the
/// other coordinates. So the bits of any 5 x 5 x 5 cells are in five words.
class SpaceBits {
  public:
    static constexpr std::size_t layers = 5;
    static constexpr std::size_t layer_bits = 40;  ///< number of bits in a layer
    using Layers = std::array<std::uint64_t, layers>;

    void set(const TileCell<3>& halo_cell) {
        const auto x = static_cast<std::size_t>(halo_cell[0]);
        const auto byte = static_cast<std::size_t>(halo_cell[2] * space_across + halo_cell[1]);
        const auto bit = static_cast<std::uint8_t>(1U << (x % 4));
        if (x < space_side) bytes_[x / 4 * strip + byte] |= bit;
        if (x >= 4) bytes_[(x / 4 - 1) * strip + byte] |= static_cast<std::uint8_t>(bit << 4);
    }

    /// Bits x + 8 y of layer z in the 5 x 5 x 5 cells around a cell, which is at x = y = z = 2.
    [[nodiscard]] std::uint64_t layer(const TileCell<3>& cell, std::size_t z) const {
        std::uint64_t word;
        const auto x = static_cast<std::size_t>(cell[0]);
        const auto byte = static_cast<std::size_t>(cell[2] * space_across + cell[1]);
        std::memcpy(&word, &bytes_[x / 4 * strip + byte + across * z], sizeof word);
        return word >> (x % 4) & 0x1f1f1f1f1fU;
    }

    [[nodiscard]] bool has(const TileCell<3>& cell) const {
        return (layer(cell, 2) >> 18 & 1) != 0;
    }

  private:
    static constexpr std::size_t across = space_across;
    static constexpr std::size_t strip = across * across;
    std::array<std::uint8_t, space_side / 4 * strip + 8> bytes_{};
};

/// Data that all tiles share.
struct SpaceRules {
    using Quad [[gnu::vector_size(16)]] = float;

    static constexpr double digit = 0x1p-23;  ///< resolution of darts on sub-cells, in cells

    explicit SpaceRules(const Grid<3>& box_grid)
        : grid(box_grid), slack(float_slack_beside(box_grid.slack)) {
        for (std::size_t b = 0; b < about.size(); ++b) {
            const std::array<std::size_t, 3> along{b % 8, b % 40 / 8, b / 40};
            for (std::size_t k = 0; k < 3; ++k) {
                steps[b][k] = static_cast<int>(along[k]) - 2;
                about[b][k] = static_cast<float>(steps[b][k] * grid.scales[k]);
            }
            about[b][3] = 0;
            cells[b] = steps[b][0] + (steps[b][1] + steps[b][2] * space_across) * space_across;
        }
        for (std::size_t i = 0; i < all_subcells<3>; ++i)
            for (std::size_t b = 0; b < about.size(); ++b)
                if (reaches(b, i)) masks[i][b / 40] |= std::uint64_t{1} << (b % 40);
        for (std::size_t k = 0; k < 3; ++k) {
            scales[k] = static_cast<float>(grid.scales[k]);
        }
    }

    /// Whether a ball with its centre in neighbour cell b can reach into a sub-cell.
    [[nodiscard]] bool reaches(std::size_t b, std::size_t subcell) const {
        double squared = 0;
        for (std::size_t k = 0; k < 3; ++k, subcell /= 4) {
            const double low = static_cast<double>(subcell % 4) / 4;
            const double step = steps[b][k];
            const double apart = std::max({step - low - 0.25, low - step - 1, 0.0});
            squared += apart * apart * grid.scales[k] * grid.scales[k];
        }
        return squared < 1 + slack;
    }

    const Grid<3>& grid;
    float slack;  ///< bound on rounding errors of distances to darts
    std::array<float, 3> scales{};
    std::array<Quad, 200> about;  ///< corners of the 5 x 5 x 5 cells around one, in radii
    std::array<int, 200> cells{};
    std::array<std::array<int, 3>, 200> steps{};
    /// For each sub-cell, the neighbours from which a ball can reach into it.
    std::array<SpaceBits::Layers, all_subcells<3>> masks{};
};

class SpaceTile : public Tile<3, space_tile_bits, 2> {
  public:
    static constexpr int halo = 2;
    static constexpr std::size_t halo_cells = power(std::size_t{space_across}, 3);

    SpaceTile() = default;
    SpaceTile(const SpaceRules& rules, std::size_t number)
        : Tile(rules.grid, number),
          rules_(&rules),
          lines_(BallLines::room, ~std::uint32_t{0}),
          numbers_(halo_cells) {
        open_cells();
        const std::size_t own = typical_points(rules.grid);
        places_.reserve(typical_points(rules.grid, halo));
        exact_.reserve(3 * (places_.capacity() - own));
        points_.reserve(3 * own);
    }

    /// Coverage of sub-cells by single balls.
    [[nodiscard]] const std::uint32_t* lines() const { return lines_.data(); }
    [[nodiscard]] bool taken(const Cell& cell) const { return taken_.has(cell); }

    void take(std::span<const Addition<3>> additions) {
        thread_local std::vector<PlacedBall> balls;
        balls.clear();
        for (const Addition<3>& a : additions) balls.push_back(add(a));
        cover_lines(rules_->scales, balls, lines_.data());
    }

    /// Collects the points that reach into the sub-cells `some` of a cell, and maybe others.
    void gather(const TileCell<3>& cell, SubcellBits some, NearDisks<3, float>& near) const {
        const std::uint16_t* numbers = &numbers_[number_of(cell)];
        const SpaceBits::Layers masks = reaching(some);
        near.clear();
        for (std::size_t z = 0; z < SpaceBits::layers; ++z) {
            std::uint64_t found = taken_.layer(cell, z) & masks[z];
            for (; found != 0; found &= found - 1) {
                const std::size_t b = 40 * z + static_cast<std::size_t>(std::countr_zero(found));
                const SpaceRules::Quad at = places_[numbers[rules_->cells[b]]] + rules_->about[b];
                near.add({at[0], at[1], at[2]});
            }
        }
        near.close();
    }

    /// Whether a point of the tile or its halo covers `place`, in a sub-cell of a cell.
    /// @param place from the cell's corner, in radii
    [[nodiscard, gnu::always_inline]] Hit hit(const TileCell<3>& cell, std::size_t subcell,
                                              SpaceRules::Quad place) const {
        const std::uint16_t* const numbers = &numbers_[number_of(cell)];
        const SpaceBits::Layers& masks = rules_->masks[subcell];
        float least = 2;
        const auto layer = [&](std::size_t z) __attribute__((always_inline)) {
            const SpaceRules::Quad* const about = &rules_->about[40 * z];
            const int* const cells = &rules_->cells[40 * z];
            for (std::uint64_t found = taken_.layer(cell, z) & masks[z]; found != 0;
                 found &= found - 1) {
                const int b = std::countr_zero(found);
                const SpaceRules::Quad off = places_[numbers[cells[b]]] + (about[b] - place);
                const SpaceRules::Quad squares = off * off;
                least = std::min(least, squares[0] + squares[1] + squares[2]);
                if (least < 1 - rules_->slack) return true;
            }
            return false;
        };
        if (layer(2) || layer(1) || layer(3) || layer(0) || layer(4)) return Hit::yes;
        return least < 1 + rules_->slack ? Hit::unsure : Hit::no;
    }

    /// Calls visit(point, cell) for points of the 125 cells around one until a call returns false.
    template <class Visit>
    void for_about(const TileCell<3>& cell, const Visit& visit) const {
        for (std::size_t z = 0; z < SpaceBits::layers; ++z) {
            std::uint64_t found = taken_.layer(cell, z);
            for (; found != 0; found &= found - 1) {
                const std::size_t b = 40 * z + static_cast<std::size_t>(std::countr_zero(found));
                const std::size_t number = numbers_[static_cast<std::size_t>(
                    static_cast<int>(number_of(cell)) + rules_->cells[b])];
                const auto& steps = rules_->steps[b];
                const Cell there{cell[0] + steps[0], cell[1] + steps[1], cell[2] + steps[2]};
                if (!visit(exact(places_[number][3]), there)) return;
            }
        }
    }

    void drop() {
        release(lines_);
        release(numbers_);
        release(places_);
        release(exact_);
        pending = {};
    }

  private:
    /// Exact coordinates of a point, by the last component of its entry in places_.
    [[nodiscard]] Point exact(float known) const {
        const double* p = known < 0 ? &exact_[3 * static_cast<std::size_t>(-1 - known)]
                                    : &points_[3 * static_cast<std::size_t>(known)];
        return {p[0], p[1], p[2]};
    }

    /// Adds a point; the caller adds its coverage.
    PlacedBall add(const Addition<3>& a) {
        PlacedBall added{a.cell, {}};
        const Point place = in_cell(rules_->grid, a.at, a.cell);
        for (std::size_t k = 0; k < 3; ++k)
            added.off[k] = static_cast<float>(std::max(place[k], 0.0) * rules_->grid.scales[k]);
        taken_.set({a.cell[0] + halo, a.cell[1] + halo, a.cell[2] + halo});
        numbers_[number_of(a.cell)] = static_cast<std::uint16_t>(places_.size());
        const auto known = a.own ? static_cast<float>(own_++) : -1 - static_cast<float>(beyond_++);
        places_.push_back(SpaceRules::Quad{added.off[0], added.off[1], added.off[2], known});
        if (!a.own) exact_.insert(exact_.end(), a.at.begin(), a.at.end());
        return added;
    }

    /// Marks the sub-cells of the tile as open, and those beyond its last cells as covered.
    void open_cells() {
        for (int z = 0; z < 4 * size_[2]; ++z)
            for (std::size_t word = 0; word < BallLines::words; ++word) {
                const int cells = std::clamp(size_[0] - 8 * static_cast<int>(word), 0, 8);
                const auto open = static_cast<std::uint32_t>((std::uint64_t{1} << (4 * cells)) - 1);
                std::fill_n(lines_.data() + BallLines::at(word, 0, static_cast<std::size_t>(z)),
                            4 * size_[1], ~open);
            }
    }

    static std::size_t number_of(const TileCell<3>& cell) {
        return static_cast<std::size_t>(
            cell[0] + halo + (cell[1] + halo + (cell[2] + halo) * space_across) * space_across);
    }

    [[nodiscard]] SpaceBits::Layers reaching(SubcellBits some) const {
        SpaceBits::Layers all{};
        for (; some != 0; some &= some - 1) {
            const auto& one = rules_->masks[static_cast<std::size_t>(std::countr_zero(some))];
            for (std::size_t z = 0; z < SpaceBits::layers; ++z) all[z] |= one[z];
        }
        return all;
    }

    const SpaceRules* rules_ = nullptr;
    std::vector<std::uint32_t> lines_;
    SpaceBits taken_;
    std::vector<std::uint16_t> numbers_;  ///< by cell: index in places_ of its point, if taken
    /// Points from the corners of their cells, in radii; the last component is the index i among
    /// the tile's points, or -1 - i for the index in exact_. Floats hold such integers exactly.
    std::vector<SpaceRules::Quad> places_;
    std::vector<double> exact_;  ///< x, y, z of the points of other tiles
    std::size_t own_ = 0;
    std::size_t beyond_ = 0;
};

}  // namespace stipple::poisson_disk
