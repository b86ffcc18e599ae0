// SPDX-License-Identifier: MIT
//
// Points of a box as points of the unit cube, for --bounds and --rescale.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "analyzers/analyzer.hpp"
#include "cli/arguments.hpp"
#include "core/domain.hpp"
#include "core/point_set.hpp"
#include "io/point_stream.hpp"
#include "stipple/run.hpp"

namespace stipple::cli {

/// @throws Error(usage) where --bounds stands beside what says the same in another way
void check_bounds(const Arguments& arguments);

/// Looks at points the first of which is point `first`; a row may hold more than the box has
/// coordinates. Makes points of the unit cube of them where the analyzer takes only those.
/// @throws Error(input) for points outside
void take_bounds(std::span<double> rows, std::size_t width, const Box& box, std::uint64_t first,
                 const Analyzer& analyzer);

/// What the points of a file live on, as options or the file say.
DomainPtr domain_of(const io::PointStream& stream, std::size_t dimension, const Analyzer& analyzer,
                    const Arguments& arguments, const RunContext& run);

/// @throws Error(input) for coordinates so large that a box around them is too wide for float64.
/// @param input names them in the message; empty: the caller does
void require_width(const PointSet& points, const std::string& input = {});

/// Points of another domain may lie in the cube and be no sample of it.
/// @throws Error(input) where the set says that it has another domain.
PointSet of_the_cube(PointSet points, const Analyzer& analyzer);

/// --bounds says what box the points live on. Analyzers of the unit cube get them mapped to it; the
/// others measure them where they are, distances and integrals in the box.
PointSet prepared(PointSet points, const Analyzer& analyzer, const Arguments& arguments);

}  // namespace stipple::cli
