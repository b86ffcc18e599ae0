// SPDX-License-Identifier: MIT
//
// Memory that a run can be stopped from filling: some systems take a second to provide 400 MB when
// they are touched first.
#pragma once

#include <algorithm>
#include <cstddef>

#include "stipple/run.hpp"

namespace stipple {

/// Appends to an empty container until it has n values of zero. @throws Error(cancelled)
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
