// SPDX-License-Identifier: MIT
//
// Points made a second time, beside those of a file: whether they are the same, number by number,
// in constant memory where they can be made so.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "io/point_stream.hpp"
#include "pipeline/produce.hpp"

namespace stipple {

/// Something that writes sets to a target.
using Making = std::function<void(const Target&)>;

/// The sets of a production after the steps of a provenance's warps that were taken in runs of their
/// own: warps, inverses, scrambles with their seed, cuts.
/// @param sets how many there are in the end, which tells how often a scramble took each
/// @throws Error(usage) for a step that is none of these
Making made_again(SetsToMake job, const std::vector<std::string>& steps, std::uint64_t sets,
                  const RunContext& run);

struct Difference {
    std::size_t set = 0;
    std::uint64_t point = 0;
    std::size_t column = 0;
    double found = 0;  ///< in the file
    double made = 0;   ///< now
};

struct Comparison {
    std::size_t sets = 0;      ///< that were compared
    std::uint64_t points = 0;  ///< of all of these, that are equal
    std::optional<Difference> difference = {};
    std::string mismatch = {};  ///< what is wrong where numbers of points or sets differ
    Provenance made = {};       ///< what would be written down today

    [[nodiscard]] bool identical() const { return !difference && mismatch.empty(); }
};

/// Compares with a file at its front; a file of one set may be the first of many.
/// @param written what writing did to the numbers: single, then precision; and the columns behind
/// @param unmarked the file does not tell where a set ends
Comparison compare(const Making& making, Target written, io::PointStream& file, bool unmarked,
                   const RunContext& run);

/// All bytes that would be written.
std::string bytes_of(const Making& making, Target target);

}  // namespace stipple
