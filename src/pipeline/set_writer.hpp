// SPDX-License-Identifier: MIT
//
// Output of rows to files: formatted block by block on all threads and written in order, while the
// next rows are made. Uses memory for a few blocks per thread, whatever the size of the set.
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

/// Extra columns after the coordinates.
struct Columns {
    bool pdf = false;       ///< the density of each point
    bool weight = false;    ///< 1 / density: the mean of f times weight estimates the integral of f
    bool anywhere = false;  ///< points may be outside the domain, where the density is 0

    [[nodiscard]] bool any() const { return pdf || weight; }
    [[nodiscard]] std::vector<std::string> names() const;
};

/// Destination of points, and the form in which they are written.
struct Target {
    std::string path = "-";          ///< may contain {set} and {seed}: one file per set
    const Format* format = nullptr;  ///< null: format_of() decides
    bool header = true;
    bool meta = false;
    bool single = false;
    std::optional<int> precision = {};
    Columns columns = {};
    /// If set, receives the bytes instead of a file; returns false to end the output.
    std::function<bool(std::string_view bytes)> sink = {};
    /// If set, receives the sets, and nothing is written.
    std::function<void(const SetStream&)> take = {};
};

/// Whether the points are the best of a search that was stopped.
bool was_interrupted(const Provenance& meta);

/// Format of the target: the one it names, or that of its path's extension, or csv for a path
/// without extension. @throws Error(usage) for an unknown extension
const Format& format_of(const Target& target);

/// Adds to the target the density columns (pdf, weight) that the file of the points had.
Target with_own_columns(Target target, const PointSet& points);

/// Returns rows with the extra columns appended to each.
/// @param densities densities stored with the points; empty: computed from the warps or the domain
/// @throws Error(input) if a number is infinite
std::vector<double> with_columns(std::span<const double> rows, std::span<const double> densities,
                                 const Columns& columns, const SetStream& stream);

/// Whether the path holds {set} or {seed}.
bool file_per_set(const std::string& path);

/// The path with {set} and {seed} filled in.
std::string path_of_set(std::string path, std::size_t set, std::uint64_t seed);

/// Writes the sets and their side files to the target. If anything fails, no files remain. Returns
/// early, without an error, if the reader closes the pipe. @throws Error
void write_sets(const SetStream& stream, const Target& target, const RunContext& run);

}  // namespace stipple
