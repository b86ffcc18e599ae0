// SPDX-License-Identifier: MIT
//
// What a scramble is: its record, and the randomization it makes for given options. A scramble
// moves points within the unit cube, at random, so that each is uniform and together they stay as
// even.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/options.hpp"

namespace stipple {

/// An option of every scramble, which is resolved before it is made.
inline constexpr Param<Text> scramble_seed{
    {.name = "seed", .help = "64-bit seed of its own; else the set's"}};

/// What is to be scrambled.
struct ScrambleRequest {
    std::vector<std::size_t> coordinates = {};  ///< numbers of a row that it moves, from 0
    std::uint64_t seed = 1;
    std::uint64_t count = 1;  ///< points of the whole set
};

/// One random choice of a scramble; safe to call from several threads. Moves points first,
/// first + 1, ... of the set: `rows` holds their coordinates that are scrambled, in [0, 1] before
/// and in [0, 1) after.
using Randomization = std::function<void(std::uint64_t first, std::span<double> rows)>;

struct Scramble {
    std::string name;
    std::string summary;
    std::string source;
    std::string family = {};  ///< "blue noise"; the registry gives it, by the folder
    /// Words that lead to it and are no names of it: what it is a kind, a part or a use of.
    std::vector<std::string> related = {};
    Schema options;
    std::vector<std::string> aliases = {};  ///< other names that users of the field would type

    /// Raised with every change of the results that the same options and seed give (see
    /// tests/contract/golden.txt).
    std::uint64_t stream_version = 1;

    /// @throws Error(usage)
    std::function<Randomization(const Values&, const ScrambleRequest&)> make;
};

/// The bases that `--base` gives to the coordinates: one number for all, or one for each.
/// @throws Error(usage) for numbers that are no bases, or no primes where they must be
std::vector<std::uint32_t> bases_for(const std::vector<double>& given, std::size_t coordinates,
                                     bool prime);

/// Numbers that a coordinate-wise randomization moves at a time, at most.
inline constexpr std::size_t most_moved = 512;

/// The randomization that moves the k-th coordinate of consecutive points by move(k, numbers).
Randomization coordinate_wise(std::size_t dimension,
                              std::function<void(std::size_t k, std::span<double>)> move);

namespace scrambles {
/// All scrambles, in alphabetical order.
const std::vector<Scramble>& all();
}  // namespace scrambles

}  // namespace stipple
