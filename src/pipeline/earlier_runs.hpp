// SPDX-License-Identifier: MIT
//
// What designs of named parameters take from these: the levels that they have, and the runs that were
// made before, which stand in a file in their own units.
#pragma once

#include <cstdint>
#include <span>

#include "core/point_set.hpp"
#include "generators/generator.hpp"
#include "pipeline/chain.hpp"

namespace stipple {

/// Runs of a file, and what they are the images of.
struct EarlierRuns {
    PointSet runs;
    PointSet cube;
};

/// Whether a generator continues a design from a file whose points are in the units of named
/// parameters.
bool goes_on_from_runs(const Values& options, const WarpChain& chain);

/// Those points. Of parameters with outcomes, points of one are spread over its interval.
/// @throws Error(input) for columns that are missing, and for points that are none of the parameters
EarlierRuns earlier_runs(const Values& options, const WarpChain& chain, const RunContext& run);

/// Puts what the parameters decide into a request: how many points there will be behind earlier ones,
/// and the levels of a factorial design that names none.
void take_parameters(const Generator& generator, std::span<const Spec> warps, Request& request,
                     Values& options, const RunContext& run);

/// Tells the user which words, and of a design of levels which outcomes, none of some points has.
void tell_absent_levels(std::span<const double> rows, const Generator& generator,
                        const WarpChain& chain, const RunContext& run);

}  // namespace stipple
