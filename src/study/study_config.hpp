// SPDX-License-Identifier: MIT
//
// A study in a file: a JSON object whose keys are the verb's options.
//
//     {"generators": ["random", {"name": "sobol", "options": {"scramble": "owen"}}],
//      "count": "2^4..2^16", "seeds": 32, "analyze": ["star-discrepancy"], "warp": ["disk"]}
//
// data/study.schema.json says the same for editors.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace stipple {

/// A setting of the study: option, text. Lists of units come as one setting for each.
using StudySettings = std::vector<std::pair<std::string, std::string>>;

/// The settings in a configuration, as texts that the command line checks. @throws Error(input)
/// naming `source` and the place in it, such as $.generators[1].options.scramble
StudySettings parse_study_config(std::string_view json, const std::string& source);

/// All keys that a configuration may have.
std::vector<std::string> study_config_keys();

// Several counts in one text: what a study sweeps over.

/// Whole numbers: lists 16,64,256; ranges by a factor 16..65536*2 or a step 10..50+10; and
/// 2^4..2^16 or 16..65536, where both ends are powers of one base, all of its powers between. A
/// range ends at the last number that is not above its end.
/// @throws Error(usage) naming `who`: no numbers, outside of [low, high], an empty range, a number
/// that stands twice.
std::vector<std::uint64_t> parse_counts(std::string_view text, std::string_view who,
                                        std::uint64_t low, std::uint64_t high);

}  // namespace stipple
