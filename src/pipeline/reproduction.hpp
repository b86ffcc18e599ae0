// SPDX-License-Identifier: MIT
//
// Reproduction of the points of a file: makes them again and compares them number by number, in
// constant memory if they can be made in blocks.
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

/// Makes sets and writes them to a target.
using Making = std::function<void(const Target&)>;

/// Combines a generation job with the later steps of the points' provenance, each of which was a
/// separate run of the program: warps, inverses, scrambles with their seed, truncations.
/// @param sets number of sets after all steps; determines the copies that a scramble made of each
/// @throws Error(usage) for any other step
Making made_again(SetsToMake job, const std::vector<std::string>& steps, std::uint64_t sets,
                  const RunContext& run);

/// First number that differs.
struct Difference {
    std::size_t set = 0;
    std::uint64_t point = 0;
    std::size_t column = 0;
    double found = 0;  ///< number in the file
    double made = 0;   ///< reproduced number
};

struct Comparison {
    std::size_t sets = 0;
    std::uint64_t points = 0;  ///< number of equal points in all compared sets
    std::optional<Difference> difference = {};
    std::string mismatch = {};  ///< message if there are more or fewer numbers, points or sets
    Provenance made = {};       ///< provenance of the reproduced points

    [[nodiscard]] bool identical() const { return !difference && mismatch.empty(); }
};

/// Compares the reproduced sets with a file, which must be at its start. A file of one set may hold
/// the first of several sets that were made together.
/// @param written how the file's numbers were written: in single precision, with how many digits,
/// and with which extra columns
/// @param unmarked the file does not mark where a set ends
Comparison compare(const Making& making, Target written, io::PointStream& file, bool unmarked,
                   const RunContext& run);

/// Returns the bytes that `making` would write to `target`.
std::string bytes_of(const Making& making, Target target);

}  // namespace stipple
