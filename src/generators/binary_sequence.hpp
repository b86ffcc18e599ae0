// SPDX-License-Identifier: MIT
//
// What the digital sequences in base 2 have in common: the order of their points, their
// scramblings, and the counts at which they are nets.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "generators/generator.hpp"
#include "math/digital/binary_net.hpp"

namespace stipple {

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
