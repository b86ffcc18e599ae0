// SPDX-License-Identifier: MIT
//
// The head: JSON before the points, common to json and jsonl:
//
//     {"format":"stipple.points","version":1,"meta":{...},"dimension":2,"count":1024
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/point_set.hpp"
#include "io/columns.hpp"
#include "io/format.hpp"
#include "io/source_text.hpp"

namespace stipple::io {

/// Returns the head as text, without a closing brace. Extras add "columns":["x","y","pdf"].
/// @param number index in the file of the first set after the head
std::string json_head(const Layout& layout, const Counts& counts, std::uint64_t number = 0);

struct JsonHead {
    Provenance provenance = {};
    std::vector<std::string> columns = {};  ///< empty: not given
    std::optional<std::uint64_t> dimension = {};
    std::vector<std::uint64_t> counts = {};  ///< per set, or one for all sets; empty: not given
    const char* dimension_at = nullptr;      ///< where the text states it, for messages
    const char* counts_at = nullptr;
};

/// Stores the value of one key. @throws Error(input) for an invalid value or an unsupported format
void take_key(const SourceText& text, const char* at, std::string_view key,
              const nlohmann::ordered_json& value, JsonHead& head);

/// Parses a JSON value within the text. @throws Error(input) at the first byte that is invalid or
/// nested too deep
nlohmann::ordered_json parse_piece(const SourceText& text, std::string_view piece);

/// Assigns roles to the `width` columns of the points, and records density and coordinate names in
/// the provenance. Notifies of names that are replaced.
/// @throws Error(input) if columns or dimension in the head contradict `width`
Columns json_columns(const SourceText& text, JsonHead& head, std::size_t width,
                     const ReadOptions& options, const RunContext& run);

/// Compares the counts in the head, if given, with those found. @throws Error(input) if they differ
void check_counts(const SourceText& text, const JsonHead& head,
                  const std::vector<std::uint64_t>& found);

}  // namespace stipple::io
