// SPDX-License-Identifier: MIT
#include "math/functions/normal_quantile.hpp"

#include "core/wide.hpp"

namespace stipple {
STIPPLE_WIDE [[gnu::flatten]] void bounded_normal_quantiles(std::span<double> p) {
    for (double& x : p) x = bounded_normal_quantile(x);
}

}  // namespace stipple
