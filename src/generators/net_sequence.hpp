// SPDX-License-Identifier: MIT
//
// The sequence that generating matrices stand for, by the fastest way that their base allows, and
// scrambled if wished: to the same numbers that the scramble of that name makes of its points.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "generators/binary_sequence.hpp"
#include "generators/generator.hpp"
#include "math/digital/base_net.hpp"

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

}  // namespace stipple
