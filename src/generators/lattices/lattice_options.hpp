// SPDX-License-Identifier: MIT
//
// Common options of the lattices: the vector, given or from a file; and the weights of coordinates
// in the search for a vector. Weights decay like a power or are given one by one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/options.hpp"
#include "stipple/points.hpp"

namespace stipple {

inline constexpr Param<Numbers> product_weights{
    {.name = "weights",
     .help = "Weight of each coordinate in the error that the search minimizes, above 0"}};

inline constexpr Param<std::int64_t> weight_decay{
    .name = "decay",
    .fallback = 2,
    .low = 0,
    .high = 20,
    .help = "Without --weights, coordinate j has the weight j^-decay"};

inline constexpr Param<Path> vector_file{
    {.name = "vector-file",
     .help = "File of a generating vector: one line per coordinate, with its value, or its number "
             "(from 1) and its value; or a lattice file of LDData or LatNet Builder"}};

inline constexpr Param<Path> vector_output{
    {.name = "vector-output", .help = "Also write the generating vector to this file"}};

inline constexpr Param<Choice> vector_format{
    .name = "vector-format",
    .choices = "lddata|latnet-builder",
    .help =
        "Format of --vector-output: LDData's (the default) or LatNet Builder's; --vector-file "
        "reads both"};

/// Contents of a lattice file.
struct VectorFile {
    std::vector<std::uint64_t> vector;
    std::uint64_t points = 0;    ///< 0: not in the file
    std::size_t interlaced = 1;  ///< number of components interlaced into one coordinate
    std::uint64_t modulus = 0;   ///< polynomial in base 2; 0: not a polynomial lattice
};

/// Contents of the file in --vector-file; empty without this option. Reads plain vectors,
/// `# lattice` and `# plattice` of LDData, and LatNet Builder's `# Parameters for a lattice rule`
/// and `... a polynomial lattice rule`. The first line tells these formats apart.
/// @throws Error(input) naming file, line and column, also for a lattice of the other kind
/// Source  github.com/QMCSoftware/LDData, README.md
VectorFile vector_in_file(const Values& options, bool polynomial);

/// Results of a search: the vector and, unless it overflows, the squared error under this name.
std::vector<std::pair<std::string, std::string>> found_vector(
    const std::vector<std::uint64_t>& vector, double squared_error,
    const char* name = "squared_error");

/// The file to write for --vector-output; empty without this option.
std::vector<SideFile> vector_files(const Values& options, const VectorFile& lattice);

/// Rejects --weights together with --decay, and either of them unless `searches`.
/// @param searching the rules that search, as named in messages
/// @param rule the rule in use
/// @throws Error(usage)
void check_weights(const Values& options, bool searches, std::string_view searching,
                   std::string_view rule);

/// The first `dimension` components of the vector from an option or a file.
/// @param range name of the allowed range in messages
/// @throws Error(usage) if there are too few, or one is not an integer from `least` to `most`
std::vector<std::uint64_t> given_components(const Values& options, const VectorFile& file,
                                            const Param<Numbers>& vector, std::size_t dimension,
                                            double least, double most, std::string_view range);

/// Weights of all coordinates. @throws Error(usage) if some are missing or outside (0, 10^6]
std::vector<double> weights_of(const Values& options, std::size_t dimension);

}  // namespace stipple
