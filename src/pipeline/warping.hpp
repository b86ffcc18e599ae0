// SPDX-License-Identifier: MIT
//
// Warps and scrambles of existing points, from files or memory.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/spec.hpp"
#include "io/point_stream.hpp"
#include "pipeline/set_writer.hpp"

namespace stipple {

/// Points to warp: either sets in memory or, if there may be too many points, a stream.
struct Unwarped {
    std::vector<PointSet> sets = {};
    io::PointStream* stream = nullptr;
    DomainPtr on = {};  ///< domain of the stream's points

    [[nodiscard]] const DomainPtr& domain() const { return stream ? on : sets.front().domain; }
};

/// Base of the digits of each coordinate, for points that a generator made and that only scrambles
/// and truncation have changed, according to their provenance. Empty if all bases are 2, or
/// unknown.
std::vector<std::uint32_t> digit_bases(const Provenance& meta);

/// Numbers per row before a step of a provenance: a warp, an inverse or a truncation.
/// @param after numbers per row of its results
std::size_t dimension_before_step(std::string_view step, std::size_t after, const RunContext& run);

/// Whether the warp needs all points of a set at once, if they have this dimension.
bool takes_whole_sets(const Spec& warp, std::size_t dimension, const RunContext& run);

/// Whether points can be written to the target as they arrive, before their number is known.
bool can_stream(const io::PointStream& stream, const Target& target);

/// Image of a set under a warp or, with `inverse`, its preimage; with updated provenance.
/// @throws as write_warped()
PointSet warped_set(const PointSet& set, const Spec& warp, bool inverse, const RunContext& run);

/// Writes the images of points under a warp or, with `inverse`, their preimages. A stream is
/// processed in constant memory. An invalid point in it ends the output: a file is then discarded,
/// but a pipe has already received the points before.
/// @throws Error(input) if coordinates that the warp takes are outside the unit cube, if points to
/// invert are outside the warp's domain, or if a streamed text has several sets; Error(usage) if
/// coordinates that the warp takes are already on another domain
void write_warped(Unwarped from, const Spec& warp, bool inverse, const Target& target,
                  const RunContext& run);

/// Writes the points unchanged, each with the density that images of uniform points have at its
/// position: 0 outside the warp's domain.
/// @throws Error(input) if the points and the warp's images differ in dimension, or the density is
/// infinite
void write_density_at(const Unwarped& at, const Spec& warp, Target target, const RunContext& run);

/// Writes `replications` independently scrambled copies of each set, with the seeds seed, seed + 1,
/// ... @throws Error(input) for points outside the unit cube
void write_scrambled(const std::vector<PointSet>& sets, const Spec& scramble, std::uint64_t seed,
                     std::uint64_t replications, const Target& target, const RunContext& run);

}  // namespace stipple
