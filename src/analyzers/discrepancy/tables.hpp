// SPDX-License-Identifier: MIT
//
// Tables of discrepancies: of the prefixes of a sequence, by length, and of the projections of a
// set to a few of its axes.
#pragma once

#include <functional>

#include "core/options.hpp"
#include "core/peers.hpp"
#include "core/point_set.hpp"
#include "math/discrepancy/search_limits.hpp"
#include "stipple/report.hpp"
#include "stipple/run.hpp"

namespace stipple::discrepancy::star {

inline constexpr Param<Numbers> prefixes{
    {.name = "prefixes",
     .unit = "points",
     .help = "Measure prefixes instead of the whole set: increasing numbers of points, such as "
             "16,32,64; gives a table. Limits of work and time apply to the whole table: work is "
             "divided in proportion to the numbers of points, and each row gets a part of the time "
             "that is left"}};

inline constexpr Param<std::int64_t> every{
    .name = "every",
    .low = 1,
    .optional = true,
    .unit = "points",
    .help = "Like --prefixes, for every multiple of this number up to the size of the set"};

inline constexpr Param<std::int64_t> projections{
    .name = "projections",
    .low = 1,
    .high = 8,
    .optional = true,
    .unit = "coordinates",
    .help =
        "Measure all projections to this many coordinates instead of the whole set; gives a table "
        "in the order 1-2, 1-3, 2-3, 1-4, 2-4, ...: sorted by the last axis, then by the preceding "
        "one"};

/// A set to measure, with its limits.
struct Member {
    const PointSet& points;
    const Limits& limits;
    Peers* peers = nullptr;  ///< processes that share the search; may be null
};

/// Measures one set; reports `lower`, `upper` and, if it is known, `value`.
using Measure = std::function<Report(const Member&, const RunContext&)>;

/// In a table of projections, marks the row with the largest lower bound; the first one if several
/// have it.
void mark_worst(Report& table);

/// Whether tables are requested. @throws Error(usage) for sizes that no prefix can have
bool wants_families(const Values& options);

/// Tables of several sets, measured in parallel. They do not depend on the number of threads unless
/// a time limit ends the search. The limits apply to all sets together: work is divided in
/// proportion to the numbers of points, and so is the remaining time among the sets not yet begun.
/// Bounds of a prefix are also used for its neighbours, widened by the effect of the additional
/// points. Sets not measured because of a stop or the time limit get the bounds 1/(2n) and 1.
/// @throws Error(input) for prefixes and projections that these points do not have
Report families(const PointSet& points, const Values& options, const Limits& limits,
                const Measure& measure, const RunContext& run);

}  // namespace stipple::discrepancy::star
