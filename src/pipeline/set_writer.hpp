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
#include "io/output.hpp"
#include "pipeline/generated.hpp"

namespace stipple {

/// Columns that are written behind the coordinates.
struct Columns {
    bool pdf = false;       ///< the density of each point
    bool weight = false;    ///< 1 / density: the mean of f times weight estimates the integral of f
    bool anywhere = false;  ///< points may be off the domain, with a density of 0

    [[nodiscard]] bool any() const { return pdf || weight; }
    [[nodiscard]] std::vector<std::string> names() const;
};

struct SetsToWrite;

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
    std::function<void(const SetsToWrite&)> take = {};
};

/// Sets with everything that is needed to write them one after the other.
struct SetsToWrite {
    std::size_t sets = 1;
    std::size_t first_set = 0;         ///< number of the first one among all
    DomainPtr domain;                  ///< what the points are on; the box of a picture of them
    const WarpChain* chain = nullptr;  ///< what gave the rows, for columns of their density
    /// Gives the rows, warped; called for each set once and in order.
    std::function<NextRows(std::size_t set, const RunContext&)> source = {};
    std::function<Provenance(std::size_t set)> provenance = {};
    std::optional<std::uint64_t> first_seed = {};  ///< of {seed} in names; else the provenance says
    std::function<Box(std::size_t set)> extent = {};  ///< a larger box, for a picture of the set
    Counts counts = {};                               ///< of points; 0: known only in the end
    std::uint64_t expected = 0;  ///< about so many, where that is known only in the end
    bool starts = false;         ///< a set's first point can be left out by --start
    bool densities = false;      ///< a row of the source ends with the density of its point

    /// Coordinates of a point.
    [[nodiscard]] std::size_t dimension() const { return domain->dimension(); }
    /// Numbers that the source gives of it.
    [[nodiscard]] std::size_t width() const { return dimension() + (densities ? 1 : 0); }
};

/// As the target names it or its path ends; else csv.
const Format& format_of(const Target& target);

/// Each row with the columns behind it. @throws Error(input) where a number is infinite
std::vector<double> with_columns(std::span<const double> rows, const Columns& columns,
                                 const SetsToWrite& job);

/// Whether the path holds {set} or {seed}.
bool file_per_set(const std::string& path);

/// The path with {set} and {seed} filled in.
std::string path_of_set(std::string path, std::size_t set, std::uint64_t seed);

/// Writes the sets to the target's file or files, and what comes with them: all of these or, when
/// something fails, none. A closed pipe ends it early, without error.
/// @throws Error
void write_files(const SetsToWrite& job, const Target& target, const RunContext& run);

/// The same, but leaves the files to be put in place with others.
void write_files(const SetsToWrite& job, const Target& target, io::Outputs& outputs,
                 const RunContext& run);

/// The part of a run's progress that one of several sets is.
RunContext part_of_run(const RunContext& run, std::size_t set, std::size_t sets);

}  // namespace stipple
