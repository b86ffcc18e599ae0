// SPDX-License-Identifier: MIT
//
// Record of a scramble, and the randomization that it makes for given options. A scramble moves
// points at random within the unit cube and keeps the kind of evenness that its file promises, such
// as the net property. A scrambled point is uniform, except with micro-jitter or given shifts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/options.hpp"

namespace stipple {

/// Option of every scramble; its default is filled in before Scramble::make is called.
inline constexpr Param<Text> scramble_seed{
    {.name = "seed", .help = "64-bit seed of this scramble; default: the set's"}};

struct ScrambleRequest {
    /// Indices of the coordinates to scramble, from 0.
    std::vector<std::size_t> coordinates = {};
    std::uint64_t seed = 1;
    std::uint64_t count = 1;  ///< points in the whole set; 0: not known
};

/// Map of points, drawn at random by a scramble; safe to call from several threads. `rows` holds
/// the scrambled coordinates of points first, first + 1, ... of the set, in [0, 1] on entry and in
/// [0, 1) on return.
using Randomization = std::function<void(std::uint64_t first, std::span<double> rows)>;

struct Scramble {
    std::string name;
    std::string summary;
    std::string source;
    std::string family = {};  ///< family name such as "blue noise", set by the registry
    /// Search words: kind, parts, uses; no names of components (tests: layering_test.cpp).
    std::vector<std::string> related = {};
    Schema options;
    std::vector<std::string> aliases = {};  ///< other names that users may type

    /// Increased whenever the same options and seed give other points (tests/contract/golden.txt).
    std::uint64_t stream_version = 1;

    /// @throws Error(usage)
    std::function<Randomization(const Values&, const ScrambleRequest&)> make;
};

/// Bases of the coordinates given by `--base`: one number for all, or one for each.
/// @throws Error(usage) for invalid bases and, if `prime` is true, for bases that are not prime
std::vector<std::uint32_t> bases_for(const std::vector<double>& given, std::size_t coordinates,
                                     bool prime);

/// Largest number of points that a coordinate-wise randomization moves at a time.
inline constexpr std::size_t most_moved = 512;

/// Randomization that calls move(k, x) with the k-th coordinates x of up to most_moved points.
Randomization coordinate_wise(std::size_t dimension,
                              std::function<void(std::size_t k, std::span<double>)> move);

namespace scrambles {
/// All scrambles, in alphabetical order.
const std::vector<Scramble>& all();
}  // namespace scrambles

}  // namespace stipple
