// SPDX-License-Identifier: MIT
//
// Sequences from given generating matrices, by the fastest method for their base, and optionally
// scrambled. Scrambled points equal those that the scramble of the same name makes of the
// unscrambled ones.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "generators/generator.hpp"
#include "math/digital/base_net.hpp"
#include "math/digital/binary_net.hpp"

namespace stipple {

/// Number of digits of indices in a prime base; coordinates have at least as many.
std::size_t net_digits(std::uint32_t base);

/// Value of an option --base. @throws Error(usage) if it is not prime
std::uint32_t prime_base(std::int64_t base);

/// Checks that the request ends within the sequence, which has base^net_digits(base) points. `who`
/// names the generator in the message. @throws Error(usage)
void check_net_end(const Request& request, const Plan& plan, std::uint32_t base,
                   std::string_view who);

/// @param matrices one per coordinate, all of the same size, with at most 64 columns
/// @param options must include binary_scramble
std::unique_ptr<Sequence> net_sequence(std::uint32_t base, std::vector<DigitMatrix> matrices,
                                       const Plan& plan, const Values& options);

/// Generating matrices of higher order: row r of the k-th result is row r / alpha of the given
/// matrix alpha k + r mod alpha. Ignores the last matrices if alpha does not divide their number.
std::vector<DigitMatrix> interlace(std::vector<DigitMatrix> matrices, std::size_t alpha);

/// Comment in LatNet Builder's files on the line with the interlacing factor. The next line holds
/// the number of components, factor times dimension.
inline constexpr std::string_view interlacing_comment = "Interlacing factor";

// Common parts of the digital sequences in base 2: the order of their points, their scrambles, and
// the counts at which they are nets.

/// Number of columns of a sequence's generating matrices, and of digits of its indices.
inline constexpr int binary_digits = 52;

inline constexpr Param<Choice> binary_order{
    .name = "order",
    .fallback = "natural",
    .choices = "natural|gray",
    .help =
        "Index of point i: natural, i; gray, i XOR i/2 (Gray code), as in SciPy and most others. "
        "Both give the same 2^k points from a multiple of 2^k on"};

inline constexpr Param<Choice> binary_scramble{
    .name = "scramble",
    .fallback = "none",
    .choices = "none|digital-shift|matrix|owen",
    .help =
        "Randomize the digits by the seed: add the same random digits to all points, multiply by a "
        "random triangular matrix, or use nested uniform scrambling (owen)"};

/// Sequence of the given generating matrices, with the order and the scramble of the options.
std::unique_ptr<Sequence> binary_sequence(BinaryMatrices matrices, const Plan& plan,
                                          const Values& options);

/// Sequence of the given generating matrices, with nested uniform scrambling.
std::unique_ptr<Sequence> owen_sequence(const BinaryMatrices& matrices, std::uint64_t seed);

/// Whether the points are scrambled; for Generator::uses_seed.
bool binary_uses_seed(const Values& options);

/// For Generator::notes: returns a sentence if start and count do not select a net.
std::vector<std::string> binary_notes(const Request& request, const Plan& plan, const Values&);

/// binary_notes() for any base b; k b^m points with k < b, a union of nets, also count as a net.
std::vector<std::string> net_notes(std::uint64_t base, const Request& request, const Plan& plan);

}  // namespace stipple
