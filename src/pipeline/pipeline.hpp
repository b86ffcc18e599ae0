// SPDX-License-Identifier: MIT
//
// Units by name, and the line they stand on: make points, warp them, measure them. What the command
// line does with files, another program does with these.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "analyzers/analyzer.hpp"
#include "generators/generator.hpp"
#include "io/format.hpp"
#include "scrambles/scramble.hpp"
#include "warps/warp.hpp"

namespace stipple {

/// The unit of that name. @throws Error(usage) naming the nearest one.
const Generator& find_generator(std::string_view name);
const Warp& find_warp(std::string_view name);  ///< suggests scrambles, too
const Analyzer& find_analyzer(std::string_view name);

/// The scramble of that name or alias; nullptr if there is none.
const Scramble* scramble_named(std::string_view name);

/// Options as text: {{"base", "3"}}.
using Settings = std::vector<std::pair<std::string, std::string>>;

/// Takes a sequential engine to point `start`, in steps between which it may be told to stop; a
/// sequence with random access needs no walk.
void walk_to(Sequence& sequence, std::uint64_t start, std::size_t dimension, const RunContext& run);

/// Tells the user what the generator has to say about the request.
void tell_notes(const Generator& generator, const Request& request, const Values& options,
                const RunContext& run);

/// All points of a request, in memory, without notes. The seed is the request's.
PointSet make_points(const Generator& generator, const Request& request, const Values& options,
                     const RunContext& run);

/// The same, with notes.
PointSet generate(const Generator& generator, const Request& request, const Values& options,
                  const RunContext& run);
PointSet generate(std::string_view generator, const Request& request, const Settings& settings = {},
                  const RunContext& run = {});

/// What measures points of `dimension` numbers as they come. @throws Error(input) where the
/// analyzer or the domain does not take them, Error(usage)
std::unique_ptr<Accumulator> accumulator_for(const Analyzer& analyzer, const Arrival& arrival,
                                             std::size_t dimension, const Values& options,
                                             const RunContext& run);

/// @throws Error(input) counting the points outside the closed unit cube and naming the first
void require_unit_cube(const PointSet& points);

/// Measures a set after checking that the analyzer takes it: its dimension and, where the analyzer
/// needs it, that all points are in the closed unit cube.
/// @throws Error(input)
Report analyze(const Analyzer& analyzer, const PointSet& points, const Values& options,
               const RunContext& run);

/// Gives a set's next points, as many as fit; fewer only at its end.
using NextRows = std::function<std::size_t(std::span<double> rows)>;

/// What was found of points that came in blocks, and how many they were.
struct Found {
    Report report;
    std::uint64_t count = 0;
};

/// Measures a set that comes in blocks, by an analyzer that has `accumulate`: the same result as
/// for the set in memory. The next block is fetched while one is looked at.
/// @throws Error(input)
Found analyze(const Analyzer& analyzer, const Arrival& arrival, std::size_t dimension,
              const NextRows& next, const Values& options, const RunContext& run);
Report analyze(std::string_view analyzer, const PointSet& points, const Settings& settings = {},
               const RunContext& run = {});

}  // namespace stipple
