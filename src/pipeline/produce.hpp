// SPDX-License-Identifier: MIT
//
// Point sets to files and pipes: made, warped and formatted block by block on all threads, written
// in order, in constant memory where the generator allows it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/spec.hpp"
#include "generators/generator.hpp"
#include "io/point_stream.hpp"
#include "pipeline/set_writer.hpp"

namespace stipple {

/// Part `index` of `of` contiguous parts.
struct Shard {
    std::uint64_t index = 0;
    std::uint64_t of = 1;
};

/// Steps of a provenance's warps that are none: numbers cut toward zero when they were written.
inline constexpr std::string_view cut_to_single = "cut:dtype=f32";
inline constexpr std::string_view cut_to_digits = "cut:precision=";

/// Sets to make, or a part of one.
struct Production : SetsToMake {
    Shard shard = {};
    std::string command = {};  ///< for the provenance
};

/// Makes the sets and writes them. A closed pipe ends it early, without error.
/// @throws Error; nothing is left at the target then.
void produce(const Production& production, const Target& target, const RunContext& run);

/// Writes sets that are there already. @throws Error(input) where there are none, where one has no
/// points, or where they differ in dimension
void write_sets(std::vector<PointSet> sets, const Target& target, const RunContext& run);

/// The image of a set under a warp or, with `inverse`, what it is made from; with its provenance.
/// @throws as write_warped does
PointSet warped_set(const PointSet& set, const Spec& warp, bool inverse, const RunContext& run);

/// Writes the images of sets under a warp or, with `inverse`, what it makes them from.
/// @throws Error(input) where coordinates that the warp takes are outside the unit cube, or points
/// off its domain; Error(usage) where they are on another domain already
void write_warped(std::vector<PointSet> sets, const Spec& warp, bool inverse, const Target& target,
                  const RunContext& run);

/// Whether the images of points of such a dimension depend on all points of their set.
bool takes_whole_sets(const Spec& warp, std::size_t dimension, const RunContext& run);

/// Whether points can be written to the target as they come, before their number is known.
bool can_stream(const io::PointStream& stream, const Target& target);

/// The same for points that come in blocks, in constant memory. What is wrong with a point ends it
/// when it comes; a file is not left then, but a pipe had the points before.
/// @param on what they live on
/// @throws Error(input) also for a text of several sets
void write_warped(io::PointStream& stream, const DomainPtr& on, const Spec& warp, bool inverse,
                  const Target& target, const RunContext& run);

/// Writes sets as they are, each point with the density that images of uniform points have there: 0
/// off the warp's domain.
/// @throws Error(input) where points have another number of coordinates, or the density is infinite
void write_density_at(std::vector<PointSet> sets, const Spec& warp, const Target& target,
                      const RunContext& run);
void write_density_at(io::PointStream& stream, const DomainPtr& on, const Spec& warp,
                      const Target& target, const RunContext& run);

/// Writes `replications` of each set, independently scrambled with the seeds seed, seed + 1, ...
/// @throws Error(input) for points outside the unit cube
void write_scrambled(const std::vector<PointSet>& sets, const Spec& scramble, std::uint64_t seed,
                     std::uint64_t replications, const Target& target, const RunContext& run);

}  // namespace stipple
