// SPDX-License-Identifier: MIT
//
// The sequence that generating matrices stand for, by the fastest way that their base allows, and
// scrambled if wished: to the same numbers that the scramble of that name makes of its points.
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

/// Digits of the indices and behind the point in a prime base.
std::size_t net_digits(std::uint32_t base);

/// The value of an option --base. @throws Error(usage) if it is not a prime.
std::uint32_t prime_base(std::int64_t base);

/// Holds that the points are among the base^net_digits(base) that `who` has. @throws Error(usage)
void check_net_end(const Request& request, const Plan& plan, std::uint32_t base,
                   std::string_view who);

/// @param matrices a coordinate each, of one shape, of at most 64 columns.
/// @param options have binary_scramble among them.
std::unique_ptr<Sequence> net_sequence(std::uint32_t base, std::vector<DigitMatrix> matrices,
                                       const Plan& plan, const Values& options);

/// Coordinates of higher order: row r of the k-th is row r / alpha of matrix alpha k + r mod alpha.
/// What is left over of the matrices when alpha does not divide their number is left out.
std::vector<DigitMatrix> interlace(std::vector<DigitMatrix> matrices, std::size_t alpha);

/// What LatNet Builder says on the line of the interlacing factor; the next one has the number of
/// components, factor times dimension.
inline constexpr std::string_view interlacing_comment = "Interlacing factor";

// What the digital sequences in base 2 have in common: the order of their points, their
// scramblings, and the counts at which they are nets.

/// Columns of a sequence's generating matrices, and digits of its indices.
inline constexpr int binary_digits = 52;

inline constexpr Param<Choice> binary_order{
    .name = "order",
    .fallback = "natural",
    .choices = "natural|gray",
    .help =
        "Point i is that of index i, or of i XOR i/2 (Gray code), as SciPy and most others "
        "give it; 2^k points from a multiple of 2^k on are the same in both"};

inline constexpr Param<Choice> binary_scramble{
    .name = "scramble",
    .fallback = "none",
    .choices = "none|digital-shift|matrix|owen",
    .help =
        "Randomize digits by the seed: add random ones to all points alike, multiply by a "
        "random triangular matrix, or scramble nested and uniformly (Owen)"};

/// The sequence of these matrices, ordered and scrambled as the options say.
std::unique_ptr<Sequence> binary_sequence(BinaryMatrices matrices, const Plan& plan,
                                          const Values& options);

/// The sequence of these matrices with nested uniform scrambling.
std::unique_ptr<Sequence> owen_sequence(const BinaryMatrices& matrices, std::uint64_t seed);

/// For Generator::uses_seed.
bool binary_uses_seed(const Values& options);

/// For Generator::notes: a sentence where the request misses the nets that the sequence is made of.
std::vector<std::string> binary_notes(const Request& request, const Plan& plan, const Values&);

/// The same in another base, where a few nets together are as good as one.
std::vector<std::string> net_notes(std::uint64_t base, const Request& request, const Plan& plan);

}  // namespace stipple
