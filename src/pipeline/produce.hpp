// SPDX-License-Identifier: MIT
//
// Output of sets from a generator, or from memory, to files and pipes: made, warped and formatted
// block by block on all threads, written in order, in constant memory if the generator allows it.
#pragma once

#include <vector>

#include "pipeline/generated.hpp"
#include "pipeline/set_writer.hpp"

namespace stipple {

/// Makes the sets and writes them. Returns early, without an error, if the reader closes the pipe.
/// Returns whether the points are the best of a search that was stopped.
/// @throws Error, without leaving output at the target
bool produce(const SetsToMake& job, const Target& target, const RunContext& run);

/// Writes sets that are in memory.
/// @throws Error(input) if there are no sets, if one has no points, or if their dimensions differ
void write_sets(std::vector<PointSet> sets, const Target& target, const RunContext& run);

}  // namespace stipple
