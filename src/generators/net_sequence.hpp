// SPDX-License-Identifier: MIT
//
// The sequence that generating matrices stand for, by the fastest way that their base allows, and
// scrambled if wished: to the same numbers that the scramble of that name makes of its points.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "generators/binary_sequence.hpp"
#include "generators/generator.hpp"
#include "math/base_net.hpp"

namespace stipple {

/// Digits of the indices and behind the point in a prime base.
std::size_t net_digits(std::uint32_t base);

/// @param matrices a coordinate each, of one shape, of at most 64 columns.
/// @param options have binary_scramble among them.
std::unique_ptr<Sequence> net_sequence(std::uint32_t base, std::vector<DigitMatrix> matrices,
                                       const Plan& plan, const Values& options);

}  // namespace stipple
