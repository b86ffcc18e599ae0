// SPDX-License-Identifier: MIT
//
// Radial designs: for each i, runs in which coordinates of a point A_i of the cube are replaced by
// those of a point B_i. A_i is the first half of point i of a sequence in twice as many
// dimensions, B_i the second half of its point i + ahead. A larger design extends a smaller one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "generators/generator.hpp"

namespace stipple::generators {

/// Default sequence for both halves. It is scrambled, since otherwise both halves of the first
/// point would be the origin, and the seed would have no effect.
inline constexpr const char* usual_base = "sobol:scramble=owen";

struct RadialShape {
    std::size_t dimension;
    std::size_t runs;       ///< number of runs for each i
    std::size_t ahead = 0;  ///< index of B's point in the sequence minus that of A's
};

/// Writes run j of the block for one i; `row` holds A_i on entry, `b` is B_i.
using RadialRun =
    std::function<void(std::size_t j, std::span<const double> b, std::span<double> row)>;

/// @param base spec of a generator
/// @throws Error(usage) if the base's points depend on their number
std::unique_ptr<Sequence> radial_sequence(const RadialShape& shape, const std::string& base,
                                          std::uint64_t seed, RadialRun write_run);

}  // namespace stipple::generators
