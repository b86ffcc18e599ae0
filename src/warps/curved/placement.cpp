// SPDX-License-Identifier: MIT
#include "warps/curved/placement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace stipple::warps {

Vector3 vector_of(const Param<Numbers>& option, const std::vector<double>& numbers) {
    if (numbers.size() != 3)
        fail(ErrorKind::usage, "--{}: expected 3 numbers, x,y,z; {} given", option.name,
             numbers.size());
    return {numbers[0] + 0.0, numbers[1] + 0.0, numbers[2] + 0.0};  // + 0.0 avoids -0 in the points
}

Vector3 center_of(const Values& options, double reach) {
    const Vector3 at = vector_of(center_option, options[center_option]);
    for (const double x : at) refuse_far(x, reach);
    return at;
}

Frame frame_of(const Values& options) {
    const Vector3 along = vector_of(axis_option, options[axis_option]);
    if (largest(along) == 0)
        fail(ErrorKind::usage, "--{}: 0,0,0 has no direction", axis_option.name);
    return frame_about(normalized(along));
}

Box box_about(const Vector3& middle, const Vector3& direction, double beyond, double along,
              double across) {
    Box box;
    for (std::size_t k = 0; k < 3; ++k) {
        const double z = direction[k];
        const double reach =
            beyond + along * std::abs(z) + across * std::sqrt(std::max(0.0, 1 - z * z));
        box.low.push_back(middle[k] - reach);
        box.high.push_back(middle[k] + reach);
    }
    return box;
}

double Sphere::rounding() const {
    return 8 * std::numeric_limits<double>::epsilon() * (1 + largest(center) / radius);
}

}  // namespace stipple::warps
