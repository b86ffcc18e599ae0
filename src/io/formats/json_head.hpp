// SPDX-License-Identifier: MIT
//
// What json and jsonl say about points besides the points:
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

/// The text above, up to the points: without a closing brace. Extras add "columns":["x","y","pdf"].
std::string json_head(const Layout& layout, const Counts& counts);

/// What a reader found.
struct JsonHead {
    Provenance provenance = {};
    std::vector<std::string> columns = {};  ///< empty: not named
    std::optional<std::uint64_t> dimension = {};
    std::vector<std::uint64_t> counts = {};  ///< empty: not said; one: of each set
    const char* dimension_at = nullptr;      ///< where they are said
    const char* counts_at = nullptr;
};

/// Takes one key. @throws Error(input) when it says that these are no points that we know.
void take_key(const SourceText& text, const char* at, std::string_view key,
              const nlohmann::ordered_json& value, JsonHead& head);

/// The JSON value of a piece of the text. @throws Error(input) at the byte where it stops being
/// one, or is too deep.
nlohmann::ordered_json parse_piece(const SourceText& text, std::string_view piece);

/// Decides what the columns of rows of `width` numbers are, and notes the one of densities.
/// @throws Error(input) when the head says otherwise.
Columns json_columns(const SourceText& text, JsonHead& head, std::size_t width,
                     const ReadOptions& options);

/// @throws Error(input) when the head counts otherwise.
void check_counts(const SourceText& text, const JsonHead& head,
                  const std::vector<std::uint64_t>& found);

}  // namespace stipple::io
