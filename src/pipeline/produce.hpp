// SPDX-License-Identifier: MIT
//
// Sets from a generator, or from memory, to files and pipes: made, warped and formatted block by
// block on all threads, written in order, in constant memory where the generator allows it.
#pragma once

#include <vector>

#include "pipeline/generated.hpp"
#include "pipeline/set_writer.hpp"

namespace stipple {

/// Makes the sets and writes them. A closed pipe ends it early, without error.
/// @throws Error; nothing is left at the target then.
void produce(const SetsToMake& job, const Target& target, const RunContext& run);

/// Writes sets in memory. @throws Error(input) where there are none, where one has no points, or
/// where they differ in dimension
void write_sets(std::vector<PointSet> sets, const Target& target, const RunContext& run);

}  // namespace stipple
