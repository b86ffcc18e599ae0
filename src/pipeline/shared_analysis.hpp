// SPDX-License-Identifier: MIT
//
// One set analyzed by several ranks. Each processes a contiguous part of it, in whole grains of the
// analyzer. The results are then merged in a tree: rank r + 1 sends its state to each even rank r,
// then r + 2 to each r divisible by 4, and so on, until rank 0 has everything.
//
// Cost     every rank sends its state once, and rank 0 merges log2(ranks) states. Before that,
//          every rank reads all files for their fingerprints. Files whose head does not give the
//          position of each point (text) are read once more, each by one rank, to count their
//          points.
// Promise  the report is to the last bit that of one process, for any number of ranks.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analyzers/analyzer.hpp"
#include "io/point_stream.hpp"
#include "pipeline/pipeline.hpp"
#include "pipeline/ranks.hpp"

namespace stipple {

/// A set of which every rank can read any part.
struct SharedSet {
    Arrival points;                                     ///< includes the count
    std::function<NextRows(std::uint64_t first)> from;  ///< reader of the points from `first` on
};

/// A set that is in the memory of every rank.
SharedSet shared_in_memory(PointSet points);

/// The set formed by joining files of one set each; it is taken to be on the unit cube. The ranks
/// count the points together. All ranks must be able to read all files, and find the same bytes.
/// @throws Error(input), on all ranks, as io::join_points()
SharedSet shared_in_files(const std::vector<std::string>& paths, const io::Opener& open,
                          Peers& peers, const RunContext& run);

/// Checks that all ranks read the same bytes: a name may mean different files on different
/// machines. All ranks must name the same number of files.
/// @throws Error, on all ranks: of kind input for files that differ; usage for pipes and devices
void require_same_files(const std::vector<std::string>& paths, Peers& peers, const RunContext& run);

/// The first rank whose text is not that of rank 0; nullopt if all are the same. If there is one,
/// all ranks must fail.
std::optional<std::size_t> unlike_rank(std::string_view text, Peers& peers);

/// Analyzes the set with an analyzer that can merge parts. Returns the result on rank 0, and
/// nullopt on the others.
/// @throws Error, the same on all ranks unless rank 0 fails to make its report
std::optional<Found> analyze_shared(const Analyzer& analyzer, const SharedSet& set,
                                    const Values& options, Ranks& ranks, const RunContext& run);

/// Runs this rank's part of a task. If it fails on some ranks, all throw the error of the first of
/// them.
void agreed(Peers& peers, const std::function<void()>& work);

}  // namespace stipple
