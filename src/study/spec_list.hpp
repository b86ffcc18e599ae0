// SPDX-License-Identifier: MIT
//
// Several counts in one text: what a study sweeps over.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace stipple {

/// Whole numbers: lists 16,64,256; ranges by a factor 16..65536*2 or a step 10..50+10; and
/// 2^4..2^16 or 16..65536, where both ends are powers of one base, all of its powers between. A
/// range ends at the last number that is not above its end.
/// @throws Error(usage) naming `who`: no numbers, outside of [low, high], an empty range, a number
/// that stands twice.
std::vector<std::uint64_t> parse_counts(std::string_view text, std::string_view who,
                                        std::uint64_t low, std::uint64_t high);

}  // namespace stipple
