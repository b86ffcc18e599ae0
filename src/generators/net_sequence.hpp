// SPDX-License-Identifier: MIT
//
// The sequence that generating matrices stand for, by the fastest way that their base allows.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "generators/generator.hpp"
#include "math/base_net.hpp"

namespace stipple {

/// @param matrices a coordinate each, of one shape; in base 2 at most 64 columns.
std::unique_ptr<Sequence> net_sequence(std::uint32_t base,
                                       const std::vector<DigitMatrix>& matrices);

}  // namespace stipple
