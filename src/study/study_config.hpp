// SPDX-License-Identifier: MIT
//
// Studies as JSON: an object whose keys are the options of the verb `study`; and lists of counts.
//
//     {"generators": ["random", {"name": "sobol", "options": {"scramble": "owen"}}],
//      "count": "2^4..2^16", "seeds": 32, "analyze": ["star-discrepancy"], "warp": ["disk"]}
//
// data/study.schema.json describes the format for text editors.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace stipple {

/// Settings of a study, as pairs of an option and its text. A list of units is one setting per
/// unit.
using StudySettings = std::vector<std::pair<std::string, std::string>>;

/// Reads the settings from a configuration, as texts that the command line checks.
/// @throws Error(input) naming `source` and the position, such as $.generators[1].options.scramble
StudySettings parse_study_config(std::string_view json, const std::string& source);

/// All keys that a configuration may have.
std::vector<std::string> study_config_keys();

/// Parses a list of numbers: 16,64,256; ranges by a factor, 16..65536*2, or by a step, 10..50+10;
/// or all powers of a base, 2^4..2^16. A range ends at the last number that is not above its end.
/// @throws Error(usage) naming `who` for an empty list or range, a number outside [low, high], and
/// a number given twice
std::vector<std::uint64_t> parse_counts(std::string_view text, std::string_view who,
                                        std::uint64_t low, std::uint64_t high);

}  // namespace stipple
