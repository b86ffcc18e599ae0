// SPDX-License-Identifier: MIT
//
// Make points and measure them: what the command line does with files, another program does with
// these.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "pipeline/generated.hpp"
#include "pipeline/units.hpp"
#include "stipple/analyze.hpp"
#include "stipple/generate.hpp"

namespace stipple {

/// All points of a request, in memory, with their provenance.
PointSet generate(const Generator& generator, const Request& request, const Values& options,
                  const RunContext& run);

/// What measures points as they come. @throws Error(input) where the analyzer does not take them,
/// Error(usage)
std::unique_ptr<Accumulator> accumulator_for(const Analyzer& analyzer, const Arrival& arrival,
                                             const Values& options, const RunContext& run);

/// A sentence on how points that are on another domain get into the unit cube.
std::string way_to_cube(const PointSet& points);

/// Whether these coordinates of a row are in [0, 1].
bool in_cube(std::span<const double> row, std::span<const std::size_t> coordinates);

/// @throws Error(input) counting the points of which some of the coordinates are not in [0, 1], and
/// naming the first
/// @param cube what the message calls the place where they should be
void require_in_cube(const PointSet& points, std::span<const std::size_t> coordinates,
                     const std::string& cube, const std::string& hint = {});

/// The same for all coordinates and, as a hint, way_to_cube().
void require_unit_cube(const PointSet& points);

/// Measures a set after checking that the analyzer takes it: its dimension and, where the analyzer
/// needs it, that all points are in the closed unit cube.
/// @throws Error(input)
Report analyze(const Analyzer& analyzer, const PointSet& points, const Values& options,
               const RunContext& run);

/// Gives all that comes to an accumulator, the next block being fetched while one is looked at.
/// Returns how many points these were.
std::uint64_t add_all(Accumulator& measure, const Arrival& arrival, const NextRows& next,
                      const RunContext& run);

/// What was found of points that came in blocks, and how many they were.
struct Found {
    Report report;
    std::uint64_t count = 0;
};

/// Measures a set that comes in blocks, by an analyzer that has `accumulate`: the same result as
/// for the set in memory.
/// @throws Error(input)
Found analyze(const Analyzer& analyzer, const Arrival& arrival, const NextRows& next,
              const Values& options, const RunContext& run);

}  // namespace stipple
