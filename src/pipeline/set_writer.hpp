// SPDX-License-Identifier: MIT
//
// The way of rows to a file: formatted block by block on all threads and written in order, while the
// next ones are made. Memory is a few blocks a thread, whatever the size of the set.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/format.hpp"
#include "pipeline/stream.hpp"

namespace stipple {

/// Columns that are written behind the coordinates.
struct Columns {
    bool pdf = false;       ///< the density of each point
    bool weight = false;    ///< 1 / density: the mean of f times weight estimates the integral of f
    bool anywhere = false;  ///< points may be off the domain, with a density of 0

    [[nodiscard]] bool any() const { return pdf || weight; }
    [[nodiscard]] std::vector<std::string> names() const;
};

/// Where points go, and how they are written.
struct Target {
    std::string path = "-";          ///< may hold {set} and {seed}: a file for each set
    const Format* format = nullptr;  ///< none: format_of() the target
    bool header = true;
    bool meta = false;
    bool single = false;
    std::optional<int> precision = {};
    Columns columns = {};
    /// Takes the bytes in place of a file; false: it wants no more.
    std::function<bool(std::string_view bytes)> sink = {};
    /// Takes the sets, in place of all writing.
    std::function<void(const SetStream&)> take = {};
};

/// As the target names it or its path ends; else csv.
const Format& format_of(const Target& target);

/// The target with the density columns that the file of these points had.
Target with_own_columns(Target target, const PointSet& points);

/// Each row with the columns behind it. @throws Error(input) where a number is infinite
/// @param densities of the points, where these have their own
std::vector<double> with_columns(std::span<const double> rows, std::span<const double> densities,
                                 const Columns& columns, const SetStream& stream);

/// Whether the path holds {set} or {seed}.
bool file_per_set(const std::string& path);

/// The path with {set} and {seed} filled in.
std::string path_of_set(std::string path, std::size_t set, std::uint64_t seed);

/// Writes the sets to the target's file or files, and what comes with them: all of these or, when
/// something fails, none. A closed pipe ends it early, without error.
/// @throws Error
void write_sets(const SetStream& stream, const Target& target, const RunContext& run);

}  // namespace stipple
