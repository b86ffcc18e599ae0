// SPDX-License-Identifier: MIT
//
// Which columns of a table are coordinates, and how a table becomes point sets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/point_set.hpp"
#include "io/format.hpp"

namespace stipple::io {

/// What each column is: the number of a coordinate, or one of the named values.
struct Columns {
    static constexpr std::size_t skipped = std::numeric_limits<std::size_t>::max();  ///< not read
    static constexpr std::size_t checked = skipped - 1;     ///< a number that nobody wants
    static constexpr std::size_t set_number = skipped - 2;  ///< tells the set

    std::vector<std::size_t> role;
    std::size_t dimension = 0;
    std::vector<std::string> names =
        {};  ///< of the coordinates, in their order, where there are any
    /// Of coordinates whose numbers 0, 1, ... stand for words: the words; of others none.
    std::vector<std::vector<std::string>> words = {};
    /// Name of the column behind the coordinates that tells the density; "pdf,weight" where there
    /// are both, of which the first is read.
    std::string density = {};

    [[nodiscard]] std::size_t width() const { return role.size(); }
    /// Whether all columns are coordinates, in order.
    [[nodiscard]] bool plain() const;
    [[nodiscard]] bool has(std::size_t wanted) const;
};

/// Names of coordinates as a provenance keeps them: none where they are x, y, ..., or where a header
/// with them would not be read as one. Columns of a `table` may be called pdf and weight.
std::vector<std::string> kept_names(std::vector<std::string> names, bool table = false);

/// Whether a text may be a word of a column: the same when it was written and read back, and no
/// number.
bool is_word(const std::string& text);

/// The column of that name or, where there is none, of that number from 1. `place` and the name of
/// the option that has it are for the message. @throws Error(usage)
std::size_t find_column(const std::string& wanted, const std::vector<std::string>& names,
                        const std::string& place, const char* option = "column");

/// Decides what the columns are. Without names they are called x, y, ... (see coordinate_names).
/// Columns called pdf or weight are coordinates only when picked, in tables (gaps), or where all are; so
/// is, but for tables, a first one whose name is empty, which holds row names. A first column `set` tells the set. `place` begins
/// the messages ("p.csv:3").
/// @throws Error(usage) for a column that is not there; Error(input) for a wrong dimension.
Columns choose_columns(std::vector<std::string> names, std::size_t width,
                       const ReadOptions& options, const std::string& place);

/// Where the last number of a row tells the density of its point, by pdf or by weight = 1 / pdf,
/// takes it out of the rows.
/// @throws Error(input) naming the first point whose number is none
void take_densities(PointSet& set);

/// Keeps the coordinates of a table that holds all columns.
std::vector<double> keep_coordinates(std::vector<double> table, const Columns& columns);

/// Tells each of the sets of a file where it is from: those of a generator have one seed after the
/// other, unless it is the scrambles that differ.
void tell_origin(std::vector<PointSet>& sets, const Provenance& provenance);

/// Cuts rows into sets that begin at the rows `starts` (rising, the first is 0).
std::vector<PointSet> cut_sets(std::vector<double> rows, std::size_t dimension,
                               const std::vector<std::uint64_t>& starts,
                               const Provenance& provenance);

}  // namespace stipple::io
