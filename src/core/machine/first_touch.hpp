// SPDX-License-Identifier: MIT
//
// Allocation of much memory in steps, so that the run can be stopped between them: some systems
// take a second to provide 400 MB of memory at its first use.
#pragma once

#include <algorithm>
#include <cstddef>

#include "stipple/run.hpp"

namespace stipple {

/// Grows a container to n values, adding zeros in steps between which the run can be stopped.
/// @throws Error(cancelled)
template <class Container>
void grow(Container& values, std::size_t n, const RunContext& run) {
    constexpr std::size_t step = (std::size_t{4} << 20) / sizeof(typename Container::value_type);
    values.reserve(n);
    while (values.size() < n) {
        run.check_stop();
        values.resize(std::min(n, values.size() + step));
    }
}

}  // namespace stipple
