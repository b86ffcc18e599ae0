// SPDX-License-Identifier: MIT
#include "generators/given_points.hpp"

#include "core/error.hpp"
#include "core/text.hpp"

namespace stipple {

void require_dimension(const Request& request, const PointSet& points, const std::string& file) {
    if (request.dimension.value_or(points.dimension()) != points.dimension())
        fail(ErrorKind::usage, "--dimension: {}, but {} has points of {} coordinates",
             *request.dimension, file, points.dimension());
}

void require_in_cube(const PointSet& points, const std::string& file, const std::string& hint) {
    for (std::size_t i = 0; i < points.count(); ++i)
        for (const double x : points[i])
            if (!(x >= 0 && x <= 1))
                fail_with_hint(ErrorKind::input, hint,
                               "{}: point {} is outside the unit cube; it has a coordinate {}",
                               file, i, format_number(x));
}

}  // namespace stipple
