// SPDX-License-Identifier: MIT
//
// Radial designs: for each i the runs in which coordinates of one point A_i of the unit cube are
// replaced by those of another one, B_i. Both are halves of points of one sequence in twice as many
// dimensions: A_i of point i, B_i of point i + ahead. As of every sequence that is allowed there,
// any beginning may be taken, so that more runs reuse all there were.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "generators/generator.hpp"

namespace stipple::generators {

/// What both halves come from unless asked otherwise: scrambled, since both halves of the first
/// point would else be the origin, and random by the seed.
inline constexpr const char* usual_base = "sobol:scramble=owen";

struct RadialShape {
    std::size_t dimension;
    std::size_t runs;       ///< for each i
    std::size_t ahead = 0;  ///< points by which B is ahead of A
};

/// Writes run j of those for one i: its row is A_i before.
using RadialRun =
    std::function<void(std::size_t j, std::span<const double> b, std::span<double> row)>;

/// @param base spec of a generator
/// @throws Error(usage) for one whose points depend on their number
std::unique_ptr<Sequence> radial_sequence(const RadialShape& shape, const std::string& base,
                                          std::uint64_t seed, RadialRun write_run);

}  // namespace stipple::generators
