// SPDX-License-Identifier: MIT
//
// Rows of numbers in text, read on all cores: the common part of csv, txt, psa and jsonl.
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

/// How a row is written.
struct Dialect {
    char separator = ' ';        ///< a blank stands for any run of blanks and tabs
    bool brackets = false;       ///< a row is [x,y]; lines that begin with { stand between rows
    bool comma = false;          ///< numbers have a decimal comma: 0,5
    bool gaps = false;           ///< numbers may be missing: NaN
    std::size_t model_line = 0;  ///< that decided what the columns are; 0: none did
};

/// A line between rows at which a new set may begin.
struct Mark {
    std::uint64_t row;  ///< the first row behind it
    const char* at;
    double number;  ///< of the set; NaN for a line `#`, or one that begins with {
};

struct Rows {
    std::vector<double> numbers;  ///< columns.dimension of each row
    std::vector<Mark> marks;
};

/// Reads rows from `body`, the start of a line, to the end of the text. Blank lines and comments are
/// passed over.
/// @throws Error(input), the first in the text whatever the threads; Error(limit),
/// Error(cancelled).
Rows read_rows(const SourceText& text, const char* body, const Columns& columns,
               const Dialect& dialect, const RunContext& run);

/// Where sets begin: at the marks behind the first row.
/// @throws Error(input) for a set without points.
std::vector<std::uint64_t> set_starts(const SourceText& text, const Rows& rows,
                                      std::size_t dimension);

/// What stands above the first row, and what it tells.
struct Top {
    Provenance provenance;  ///< of `# key: value` lines
    const char* first;      ///< the first line that is neither blank nor a comment
    const char* next;       ///< the line below it
};

/// @throws Error(input) when nothing but comments is there.
Top read_top(const SourceText& text);

/// The line that begins there, without what ends it.
std::string_view line_at(const SourceText& text, const char* begin);

/// Where the line below begins, or the end of the text.
const char* next_line(const SourceText& text, const char* at);

/// Reads csv, tsv and txt: whatever separates, with a header or without.
std::vector<PointSet> read_delimited(std::string_view bytes, const ReadOptions& options,
                                     const RunContext& run);

/// The same in blocks; nothing where the front does not show what the columns are. The rows of a
/// set must stand together.
std::unique_ptr<PointStream> stream_delimited(std::unique_ptr<Feed>& feed,
                                              const ReadOptions& options, const RunContext& run);

}  // namespace stipple::io
