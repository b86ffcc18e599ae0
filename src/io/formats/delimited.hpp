// SPDX-License-Identifier: MIT
//
// Parallel reader of rows of numbers in text, shared by csv, txt, psa and jsonl.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/point_set.hpp"
#include "io/columns.hpp"
#include "io/format.hpp"
#include "io/point_stream.hpp"
#include "io/source_text.hpp"
#include "stipple/run.hpp"

namespace stipple::io {

/// Syntax of a row.
struct Dialect {
    char separator = ' ';        ///< ' ' matches any run of blanks and tabs
    bool brackets = false;       ///< rows are [x,y]; lines starting with { separate sets
    bool comma = false;          ///< numbers have a decimal comma: 0,5
    bool gaps = false;           ///< missing numbers are allowed, and read as NaN
    std::size_t model_line = 0;  ///< line that defined the columns, for messages; 0: none
};

struct Rows {
    std::vector<double> numbers;  ///< columns.dimension numbers per row
    std::vector<Mark> marks;
};

/// Reads the rows from `body`, the start of a line, to the end of the text. Blank lines and
/// comments are skipped.
/// @throws Error(input) for the first error in the text, whatever the number of threads;
/// Error(limit), Error(cancelled)
Rows read_rows(const SourceText& text, const char* body, const Columns& columns,
               const Dialect& dialect, const RunContext& run);

/// Index of the first row of each set: 0, and each row that follows a mark.
/// @throws Error(input) for a set without points
std::vector<std::uint64_t> set_starts(const SourceText& text, const Rows& rows,
                                      std::size_t dimension);

/// Everything above the first row.
struct Top {
    Provenance provenance;  ///< from `# key: value` lines
    const char* first;      ///< first line that is neither blank nor a comment
    const char* next;       ///< the line after `first`
};

/// Reads all lines above the first row. @throws Error(input) if the text has only comments and
/// blank lines
Top read_top(const SourceText& text);

/// The line that starts at `begin`, without its line end.
std::string_view line_at(const SourceText& text, const char* begin);

/// Start of the next line, or the end of the text.
const char* next_line(const SourceText& text, const char* at);

/// Reads csv, tsv and txt with any separator, with or without a header.
std::vector<PointSet> read_delimited(std::string_view bytes, const ReadOptions& options,
                                     const RunContext& run);

/// As read_delimited(), in blocks; rows of one set must be adjacent. Returns null, without touching
/// the feed, if the front of the file does not determine the columns.
std::unique_ptr<PointStream> stream_delimited(std::unique_ptr<Feed>& feed,
                                              const ReadOptions& options, const RunContext& run);

}  // namespace stipple::io
