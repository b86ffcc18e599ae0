// SPDX-License-Identifier: MIT
//
// Units (generators, warps, scrambles and analyzers) by name.
#pragma once

#include <string>
#include <string_view>

#include "analyzers/analyzer.hpp"
#include "core/spec.hpp"
#include "generators/generator.hpp"
#include "scrambles/scramble.hpp"
#include "warps/warp.hpp"

namespace stipple {

/// Returns the unit with this name or alias. @throws Error(usage) that suggests the nearest name
const Generator& find_generator(std::string_view name);
const Warp& find_warp(std::string_view name);
const Analyzer& find_analyzer(std::string_view name);

/// Reports that there is no unit of this name, and suggests related units or the nearest names.
/// @param kind "generator", "warp" (or scramble) or "analyzer"
/// @throws Error(usage)
[[noreturn]] void refuse_unit(std::string_view kind, std::string_view name);

/// Returns the unit with this name or alias; nullptr if there is none.
const Generator* generator_named(std::string_view name);
const Scramble* scramble_named(std::string_view name);

/// Domain that a parameter file describes. Its spec contains the contents of the file, and is also
/// the spec of the warp onto it. @throws Error(input) naming the position in the file; Error(io);
/// Error(usage) if this program has no warp for parameters
DomainPtr read_parameters(const std::string& path, const RunContext& run = {});

/// The same warp, but with images in the unit cube.
Spec in_unit_cube(Spec parameters);

/// Warning that prefixes of the points differ from sets of fewer points; empty if they do not,
/// or if the generator is unknown.
std::string unlike_prefixes(const Provenance& made);

/// Sets `independent`, which files do not store, from the traits of the provenance's generator.
void complete(Provenance& provenance);

/// A generator with its options and its own warps, as one text:
///     SPEC [-w WARP] [--OPTION VALUE] [--FLAG] ...        rank1-lattice -w cranley-patterson
struct GeneratorSpec {
    Spec unit;
    std::vector<std::string> warps = {};  ///< specs, in order
};

/// @throws Error(usage) naming the text
GeneratorSpec parse_generator(std::string_view text);

/// " -w WARP" for each warp, as parse_generator() reads it.
std::string format_own_warps(const std::vector<std::string>& warps);

}  // namespace stipple
