// SPDX-License-Identifier: MIT
//
// Generation and analysis of point sets by function calls, with the checks, defaults and provenance
// of the command line.
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

/// Generates all points of a request in memory, with their provenance.
PointSet generate(const Generator& generator, const Request& request, const Values& options,
                  const RunContext& run);

/// Makes an accumulator of the analyzer, for a set that arrives in blocks.
/// @throws Error(input) if the analyzer does not accept such points; Error(usage)
std::unique_ptr<Accumulator> accumulator_for(const Analyzer& analyzer, const Arrival& arrival,
                                             const Values& options, const RunContext& run);

/// Hint for the user: how to bring points of another domain into the unit cube.
std::string way_to_cube(const PointSet& points);

/// Whether these coordinates of a row are in [0, 1].
bool in_cube(std::span<const double> row, std::span<const std::size_t> coordinates);

/// Checks that these coordinates of all points are in [0, 1].
/// @throws Error(input) with the number of points outside and the first of them
/// @param cube name of the region in the message
void require_in_cube(const PointSet& points, std::span<const std::size_t> coordinates,
                     const std::string& cube, const std::string& hint = {});

/// Calls require_in_cube() for all coordinates, with way_to_cube() as the hint.
void require_unit_cube(const PointSet& points);

/// Checks the densities of a set: each point has a density above 0, or no point has one.
/// @throws Error(usage), Error(input)
void check_densities(const PointSet& points);

/// Checks what a caller may have put into a set: its domain, densities and numbers.
/// @throws Error(usage), Error(input)
void check_set(const PointSet& points);

/// For an analyzer of the unit cube, rejects points of another domain, even if all are in the cube.
/// Accepts sets with points outside the cube: a later check rejects them. @throws Error(input)
void require_cube_domain(const PointSet& points, const Analyzer& analyzer);

/// Analyzes a set. First checks that the analyzer accepts the dimension. For an analyzer of the
/// unit cube, also checks that this is the domain, and that all points are in the closed cube.
/// @throws Error(input)
Report analyze(const Analyzer& analyzer, const PointSet& points, const Values& options,
               const RunContext& run);

/// Passes all blocks of a set to an accumulator; fetches the next block while one is processed.
/// Returns the number of points.
std::uint64_t add_all(Accumulator& measure, const Arrival& arrival, const NextRows& next,
                      const RunContext& run);

/// Report on a set that arrived in blocks, and its number of points.
struct Found {
    Report report;
    std::uint64_t count = 0;
};

/// Analyzes a set that arrives in blocks, with an analyzer that has `accumulate`. The report is the
/// same as for the set in memory. @throws Error(input)
Found analyze(const Analyzer& analyzer, const Arrival& arrival, const NextRows& next,
              const Values& options, const RunContext& run);

}  // namespace stipple
