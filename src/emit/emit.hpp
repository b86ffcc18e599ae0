// SPDX-License-Identifier: MIT
//
// Code in other languages that makes the points of a generator, one coordinate at a time:
//
//     coordinate(index, dimension, seed)
//
// It is assembled from a library for each language (library.c, library.py, library.glsl; HLSL is
// GLSL with other words), whose parts are named like the units that they make.
//
// Promise the numbers of generate(): to the last bit in C and Python, cut to float32 in GLSL and
//         HLSL, where numbers from warps have rounding errors.
#pragma once

#include <cstddef>
#include <string>

#include "pipeline/generated.hpp"

namespace stipple::emit {

constexpr std::size_t most_dimensions = 16;

enum class Language { c, glsl, hlsl, python };

/// Whether code can be emitted for a generator or warp of this name.
bool can_emit(std::string_view unit);

/// The code, as the text of a file.
/// @param job generator, options, request, warps and command; the seeds of the examples are 1 to 3
/// @param name name of the function, and the beginning of all other names; empty: the generator's
/// @throws Error(usage) naming the unit, option or value that cannot be emitted
std::string emitted(SetsToMake job, Language language, std::string name, const RunContext& run);

}  // namespace stipple::emit
