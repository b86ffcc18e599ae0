// SPDX-License-Identifier: MIT
//
// One set measured by several ranks. Each takes a stretch of it, in whole grains of the analyzer;
// then rank r + 1 tells rank r what it has found, those two ranks on tell the even ones among
// these, and so on, until rank 0 knows all.
//
// Cost     every rank sends what it has found once, and rank 0 takes in log2(ranks) of these. Files
//          whose head does not tell where each point stands (text) are read once more before, to
//          count their points, each by one rank.
// Promise  the report is to the last bit that of one process, for any number of ranks.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analyzers/analyzer.hpp"
#include "io/point_stream.hpp"
#include "pipeline/pipeline.hpp"
#include "pipeline/ranks.hpp"

namespace stipple {

/// A set of which each rank can take any stretch.
struct SharedSet {
    Arrival points;                                     ///< with their count
    std::function<NextRows(std::uint64_t first)> from;  ///< gives its points from this one on
};

/// A set that every rank has in memory.
SharedSet shared_in_memory(PointSet points);

/// Files of one set each, one after the other, that all ranks can read; said to be on the unit cube.
/// Counts their points; the ranks share the files, which must hold the same bytes everywhere.
/// @throws Error(input), on all ranks, as io::join_points does
SharedSet shared_in_files(const std::vector<std::string>& paths, const io::Opener& open,
                          Peers& peers, const RunContext& run);

/// Measures the set by an analyzer that takes parts of it; rank 0 gets what was found.
/// @throws Error, the same on all ranks unless rank 0's report is at fault
std::optional<Found> analyze_shared(const Analyzer& analyzer, const SharedSet& set,
                                    const Values& options, Ranks& ranks, const RunContext& run);

/// Does a part of what all do together: where that fails for some, all fail as the first of them.
void agreed(Peers& peers, const std::function<void()>& work);

}  // namespace stipple
