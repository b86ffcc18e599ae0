// SPDX-License-Identifier: MIT
//
// Points of which each coordinate has a stratum of its own: a part of [0, 1) between neighbouring
// whole multiples of 1 / parts. Where in it the point is, is random, or the middle.
//
// Promise as math/digital/stratum.hpp says.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/options.hpp"
#include "core/rng.hpp"
#include "generators/generator.hpp"
#include "math/combinatorics/permutation.hpp"

namespace stipple::generators {

/// Streams of random numbers within a generator's seed.
enum class StratifiedStream : std::uint64_t {
    order,
    first_of_unit,
    first_of_offsets = std::uint64_t{1} << 31  ///< one a coordinate
};

inline constexpr Param<bool> centered_option{
    .name = "centered", .help = "Puts points into the middles of their strata, not anywhere"};

inline constexpr Param<Choice> order_option{.name = "order",
                                            .fallback = "shuffled",
                                            .choices = "shuffled|cells",
                                            .help = "Order of the points: random, or cell by cell"};

class StratifiedSequence : public Sequence {
  public:
    struct Style {
        bool centered;
        bool shuffled;
    };

    /// What the two options above ask for.
    static Style style_of(const Values& options) {
        return {.centered = options[centered_option],
                .shuffled = options[order_option] == "shuffled"};
    }

    void fill(std::uint64_t first, std::span<double> rows) final;

  protected:
    StratifiedSequence(const Plan& plan, Style style);

    /// low[j] = number of the stratum of the `index[j]`-th point, along `coordinate`.
    virtual void strata(std::size_t coordinate, std::span<const double> index,
                        std::span<double> low) const = 0;

    /// Number of strata along a coordinate.
    [[nodiscard]] virtual std::uint64_t parts(std::size_t coordinate) const = 0;

    /// Random numbers for the unit's own use, stream 0, 1, ...
    [[nodiscard]] Rng numbers(std::uint64_t stream) const;

    Plan plan_;

  private:
    /// Coordinates of points first, first + 1, ... in the strata that are `low`.
    void place(std::size_t coordinate, std::uint64_t first, std::span<const double> low,
               std::span<double> x) const;

    bool centered_;
    std::optional<Permutation> order_;
};

}  // namespace stipple::generators
