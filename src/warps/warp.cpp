// SPDX-License-Identifier: MIT
#include "warps/warp.hpp"

#include "core/error.hpp"

namespace stipple {

void Mapping::inverse(std::span<const double>, std::span<double>) const {
    fail(ErrorKind::usage, "--inverse: this warp has no inverse");
}

}  // namespace stipple
