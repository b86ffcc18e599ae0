// SPDX-License-Identifier: MIT
//
// Conversion of provenance to and from the `meta` object of JSON and the `# ` lines of text
// formats.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "core/point_set.hpp"
#include "stipple/run.hpp"

namespace stipple {
struct ReadOptions;
}

namespace stipple::io {

struct Columns;

/// Always has the keys tool, version, generator, options, seed, count, dimension, start, warps,
/// domain and command; seed, start and domain are null if unknown. Has columns, levels, bounds and
/// shard if set; efficiency if points were dropped; precision and dtype if numbers were rounded;
/// inputs if files were read; `found` if a search was made; stream_versions if above 1.
nlohmann::ordered_json to_json(const Provenance& provenance);

/// Parses the known keys and ignores the others.
Provenance provenance_from(const nlohmann::ordered_json& meta);

/// Formats provenance as lines "# key: value" with the value as JSON; other formats replace "# " by
/// `begin`.
std::string to_comment_lines(const Provenance& provenance, std::string_view begin = "# ");

/// Parses a line "key: value" of to_comment_lines(), without "# ". Returns false for other lines.
bool take_comment_line(std::string_view line, Provenance& provenance);

/// Warns if a file's first set has another number of points than its provenance states. The file
/// may have been cut off, but also edited, so this is no error.
void note_count(const std::string& source, const Provenance& stated, std::uint64_t found,
                const RunContext& run);

/// Stores names and density column of the chosen columns in the provenance of a file. Drops the
/// recipe, which `flaw` then describes, if --column picks other coordinates or another order.
void tell_columns(Provenance& provenance, const Columns& columns, const ReadOptions& options);

/// Entries in a provenance's list of warps for numbers that were truncated when written.
inline constexpr std::string_view cut_to_single = "cut:dtype=f32";
inline constexpr std::string_view cut_to_digits = "cut:precision=";

/// Whether a step of a provenance says that numbers were truncated.
inline bool is_cut(std::string_view step) {
    return step == cut_to_single || step.starts_with(cut_to_digits);
}

/// Turns the truncation of a file's numbers into a step, after which others follow.
void record_cuts(Provenance& meta);

/// A provenance without the recipe: only names, levels, size and domain of the points.
Provenance without_making(const Provenance& meta);

}  // namespace stipple::io
