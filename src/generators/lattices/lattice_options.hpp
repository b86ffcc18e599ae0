// SPDX-License-Identifier: MIT
//
// What the lattices' options have in common: components of a vector, given or from a file, and the
// weights of coordinates in the search for one, which decay like a power, or are given one by one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/options.hpp"
#include "stipple/points.hpp"

namespace stipple {

inline constexpr Param<Numbers> product_weights{
    {.name = "weights",
     .help = "Weights of the coordinates in what the search makes least, a positive number each"}};

inline constexpr Param<std::int64_t> weight_decay{
    .name = "decay",
    .fallback = 2,
    .low = 0,
    .high = 20,
    .help = "Without weights: coordinate j has the weight j^-decay"};

inline constexpr Param<Path> vector_file{
    {.name = "vector-file",
     .help = "File of a generating vector: a line a coordinate, with its value, or its number from "
             "1 and its value; or as LDData or LatNet Builder write lattices"}};

inline constexpr Param<Path> vector_output{
    {.name = "vector-output", .help = "Also writes the generating vector to this file"}};

inline constexpr Param<Choice> vector_format{
    .name = "vector-format",
    .choices = "lddata|latnet-builder",
    .help =
        "Form of --vector-output: that of LDData (the default), or of LatNet Builder; "
        "--vector-file reads both"};

/// What a file says of a lattice.
struct VectorFile {
    std::vector<std::uint64_t> vector;
    std::uint64_t points = 0;    ///< 0: it does not say
    std::size_t interlaced = 1;  ///< components whose digits make a coordinate
    std::uint64_t modulus = 0;   ///< of a polynomial lattice in base 2; 0: it is none
};

/// The file that the options name; nothing where they name none. Reads plain vectors, `# lattice`
/// and `# plattice` of LDData, and LatNet Builder's `# Parameters for a lattice rule` and `... a
/// polynomial lattice rule`, by what they say of themselves before the numbers.
/// @throws Error(input) naming file, line and column, also for a lattice of the other kind
/// Source  github.com/QMCSoftware/LDData, README.md
VectorFile vector_in_file(const Values& options, bool polynomial);

/// The file that --vector-output asks for; none where it does not.
std::vector<SideFile> vector_files(const Values& options, const VectorFile& lattice);

/// Refuses both at once, and either where nothing is searched. @throws Error(usage)
/// @param searching the rules that search, as a message names them
/// @param rule the one at hand
void check_weights(const Values& options, bool searches, std::string_view searching,
                   std::string_view rule);

/// The first components of a vector that an option gives, or a file. @throws Error(usage): too few,
/// or one that is no whole number from `least` to `most`, which messages call `range`.
std::vector<std::uint64_t> given_components(const Values& options, const VectorFile& file,
                                            const Param<Numbers>& vector, std::size_t dimension,
                                            double least, double most, std::string_view range);

/// The weights of the first coordinates. @throws Error(usage): too few, or not in (0, 10^6].
std::vector<double> weights_of(const Values& options, std::size_t dimension);

}  // namespace stipple
