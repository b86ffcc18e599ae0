// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "core/spec.hpp"
#include "generators/generator.hpp"

namespace stipple {

/// Sets that are asked for.
struct SetsToMake {
    const Generator* generator = nullptr;
    Values options = {};
    /// Its seed is that of the first set; the next ones have seed + 1, ... Bounds may be those of the
    /// coordinates that no warp takes.
    Request request = {};
    std::uint64_t sets = 1;
    std::vector<Spec> warps = {};
};

}  // namespace stipple
