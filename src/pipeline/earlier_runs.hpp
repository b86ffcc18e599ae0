// SPDX-License-Identifier: MIT
//
// Inputs that experimental designs take from named parameters: their levels, and earlier runs,
// which a file holds in the units of the parameters.
#pragma once

#include <cstdint>
#include <span>

#include "core/point_set.hpp"
#include "generators/generator.hpp"
#include "pipeline/chain.hpp"

namespace stipple {

/// Runs from a file, and their preimages in the unit cube.
struct EarlierRuns {
    PointSet runs;
    PointSet cube;
};

/// Whether the options extend a design whose file has points in the units of named parameters.
bool goes_on_from_runs(const Values& options, const WarpChain& chain);

/// Reads the runs to extend. Runs with the same discrete outcome get different preimages, spread
/// evenly over the interval of the outcome.
/// @throws Error(input) for missing columns, and for points outside the parameters' domain
EarlierRuns earlier_runs(const Values& options, const WarpChain& chain, const RunContext& run);

/// Completes a request from the parameters: sets the number of points, earlier runs included, and
/// the levels of a factorial design if the options give none.
void take_parameters(const Generator& generator, std::span<const Spec> warps, Request& request,
                     Values& options, const RunContext& run);

/// Warns of categories, and of levels of a design, that none of the points has.
void tell_absent_levels(std::span<const double> rows, const Generator& generator,
                        const WarpChain& chain, const RunContext& run);

}  // namespace stipple
