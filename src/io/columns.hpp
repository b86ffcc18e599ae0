// SPDX-License-Identifier: MIT
//
// Selection of coordinate columns in a table, and conversion of a table to point sets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/point_set.hpp"
#include "io/format.hpp"

namespace stipple::io {

/// Role of each column: the index of a coordinate, or one of the constants below.
struct Columns {
    static constexpr std::size_t skipped = std::numeric_limits<std::size_t>::max();  ///< not read
    static constexpr std::size_t checked = skipped - 1;  ///< must hold numbers, which are not used
    static constexpr std::size_t set_number = skipped - 2;  ///< holds the number of the set

    std::vector<std::size_t> role;
    std::size_t dimension = 0;
    std::vector<std::string> names = {};  ///< names of the coordinates, in order; may be empty
    /// Level names of each coordinate; empty for numeric coordinates.
    std::vector<std::vector<std::string>> words = {};
    /// Name of the density column after the coordinates; "pdf,weight" if the file has both: then
    /// pdf is read.
    std::string density = {};

    [[nodiscard]] std::size_t width() const { return role.size(); }
    /// Whether all columns are coordinates, in their original order.
    [[nodiscard]] bool plain() const;
    [[nodiscard]] bool has(std::size_t wanted) const;
};

/// Coordinate names to store in provenance: empty if they are the default names.
std::vector<std::string> kept_names(std::vector<std::string> names);

/// Whether a text can be a level name: not a number, and unchanged by writing and reading.
bool is_word(const std::string& text);

/// Fields of a line of CSV; nullopt if a quote is not closed.
std::optional<std::vector<std::string>> csv_fields(std::string_view line);

/// Parses the names in an option's text, a line of CSV. @throws Error(usage)
std::vector<std::string> parse_names(std::string_view text, std::string_view option);

/// Replaces names that would not be read back from a header; the column's default name is used.
/// Names pdf and weight are replaced only if `table` is false. Returns a sentence for each change.
std::vector<std::string> replace_names(std::vector<std::string>& names, bool table);

/// Index of the column with this name or, failing that, with this number counted from 1. `place`
/// and `option` are for the message. @throws Error(usage) if no column matches
std::size_t find_column(const std::string& wanted, const std::vector<std::string>& names,
                        const std::string& place, const char* option = "column");

/// Assigns roles to columns. Unnamed columns are called x, y, ... (see coordinate_names). Columns
/// pdf and weight are coordinates only if picked in options.columns, or if options.gaps or
/// options.all_columns is set. A first column with an empty name holds row names; it is a
/// coordinate only if picked, or if options.all_columns is set. A first column named `set` holds
/// the set number. Messages begin with `place` ("p.csv:3").
/// @throws Error(usage) for a missing column; Error(input) for a wrong dimension
Columns choose_columns(std::vector<std::string> names, std::size_t width,
                       const ReadOptions& options, const std::string& place);

/// Density columns after the coordinates in a file, from the provenance of its points.
struct DensityColumns {
    bool pdf = false;
    bool weight = false;
};
DensityColumns density_columns(const Provenance& provenance);

/// If the last number of each row is a pdf or a weight = 1 / pdf, moves it from the rows to
/// set.densities. @throws Error(input) naming the first point with an invalid value
void take_densities(PointSet& set);

/// Drops the columns of a table that are not coordinates.
std::vector<double> keep_coordinates(std::vector<double> table, const Columns& columns);

/// Boundary between rows where a new set may begin: a separator line, or another set number.
struct Mark {
    std::uint64_t row;  ///< index of the first row after the mark
    const char* at;
    double number;  ///< the set's number; NaN for lines between rows
};

/// Whether a number can be that of a set: 0, 1, 2, ... up to 2^53.
bool is_set_number(double value);

/// Groups rows by set number, at the marks with one; sets are ordered by their first rows.
std::vector<PointSet> gather_sets(std::vector<double> rows, std::size_t dimension,
                                  std::vector<Mark> marks, const Provenance& provenance);

/// Seed of a set in a file, from the provenance of set 0. Generated sets have consecutive seeds,
/// except if they were scrambled: then only the scrambles' seeds differ.
std::uint64_t seed_of_set(const Provenance& first, std::uint64_t set);

/// Sets the provenance of each set of a file. @param numbers of the sets; empty: 0, 1, 2, ...
void tell_origin(std::vector<PointSet>& sets, const Provenance& provenance,
                 const std::vector<std::uint64_t>& numbers = {});

/// Splits rows into sets; `starts` has the index of each set's first row, ascending from 0.
std::vector<PointSet> cut_sets(std::vector<double> rows, std::size_t dimension,
                               const std::vector<std::uint64_t>& starts,
                               const Provenance& provenance);

}  // namespace stipple::io
