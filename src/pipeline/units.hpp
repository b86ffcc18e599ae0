// SPDX-License-Identifier: MIT
//
// Units by name.
#pragma once

#include <string>
#include <string_view>

#include "analyzers/analyzer.hpp"
#include "core/spec.hpp"
#include "generators/generator.hpp"
#include "scrambles/scramble.hpp"
#include "warps/warp.hpp"

namespace stipple {

/// The unit of that name. @throws Error(usage) naming the nearest one.
const Generator& find_generator(std::string_view name);
const Warp& find_warp(std::string_view name);
const Analyzer& find_analyzer(std::string_view name);

/// Refuses the name of a "generator", "warp" (or scramble) or "analyzer" that there is not, with what
/// may be meant: units that it is related to, or the nearest names. @throws Error(usage)
[[noreturn]] void refuse_unit(std::string_view kind, std::string_view name);

/// The unit of that name or alias; nullptr if there is none.
const Generator* generator_named(std::string_view name);
const Scramble* scramble_named(std::string_view name);

/// Domain that a parameter file describes; its spec is also that of the warp, and holds the contents
/// of the file. @throws Error(input) naming the place in the file; Error(io); Error(usage) if this
/// program has no such warp
DomainPtr read_parameters(const std::string& path, const RunContext& run = {});

/// The same warp, but with images in the unit cube.
Spec in_unit_cube(Spec parameters);

/// A sentence on why prefixes of points that were made so tell little: they come in no order, or in
/// that of their places; empty where they do, or where nobody knows.
std::string unlike_prefixes(const Provenance& made);

/// Adds to the provenance that a file holds what the record of its generator knows.
void complete(Provenance& provenance);

}  // namespace stipple
