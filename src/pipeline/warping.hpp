// SPDX-License-Identifier: MIT
//
// Points that exist already, from files or memory, through a warp or a scramble.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/spec.hpp"
#include "io/point_stream.hpp"
#include "pipeline/set_writer.hpp"

namespace stipple {

/// Entries among the warps of a provenance for numbers that were truncated in writing.
inline constexpr std::string_view cut_to_single = "cut:dtype=f32";
inline constexpr std::string_view cut_to_digits = "cut:precision=";

/// Points to warp: sets in memory or, where they are many, as they are read.
struct Unwarped {
    std::vector<PointSet> sets = {};
    io::PointStream* stream = nullptr;
    DomainPtr on = {};  ///< of the points of a stream

    [[nodiscard]] const DomainPtr& domain() const { return stream ? on : sets.front().domain; }
};

/// Bases of the digits of each coordinate, from the provenance of points that a generator made and
/// that at most scrambles changed; empty: 2, or unknown.
std::vector<std::uint32_t> digit_bases(const Provenance& meta);

/// Whether the images of points of such a dimension depend on all points of their set.
bool takes_whole_sets(const Spec& warp, std::size_t dimension, const RunContext& run);

/// Whether points can be written to the target as they come, before their number is known.
bool can_stream(const io::PointStream& stream, const Target& target);

/// The image of a set under a warp or, with `inverse`, what it is made from; with its provenance.
/// @throws as write_warped does
PointSet warped_set(const PointSet& set, const Spec& warp, bool inverse, const RunContext& run);

/// Writes the images of points under a warp or, with `inverse`, what it makes them from; those of a
/// stream in constant memory. An invalid point of a stream ends it when it comes; a file is not left
/// then, but a pipe had the points before.
/// @throws Error(input) where coordinates that the warp takes are outside the unit cube, or points
/// off its domain, and for a streamed text of several sets; Error(usage) where they are on another
/// domain already
void write_warped(Unwarped from, const Spec& warp, bool inverse, const Target& target,
                  const RunContext& run);

/// Writes points as they are, each with the density that images of uniform points have there: 0 off
/// the warp's domain.
/// @throws Error(input) where points have another number of coordinates, or the density is infinite
void write_density_at(const Unwarped& at, const Spec& warp, Target target, const RunContext& run);

/// Writes `replications` of each set, independently scrambled with the seeds seed, seed + 1, ...
/// @throws Error(input) for points outside the unit cube
void write_scrambled(const std::vector<PointSet>& sets, const Spec& scramble, std::uint64_t seed,
                     std::uint64_t replications, const Target& target, const RunContext& run);

}  // namespace stipple
