// SPDX-License-Identifier: MIT
#include "generators/given_points.hpp"

#include "core/error.hpp"
#include "core/text.hpp"

namespace stipple {

void require_dimension(const Request& request, std::size_t dimension, const std::string& file) {
    if (request.dimension.value_or(dimension) != dimension)
        fail(ErrorKind::usage, "--dimension: {}, but {} has points of {} coordinates",
             *request.dimension, file, dimension);
}

std::uint64_t chosen_count(std::uint64_t asked, std::uint64_t usual, std::uint64_t all,
                           const std::string& file) {
    const std::uint64_t count = asked > 0 ? asked : usual;
    if (count > all)
        fail(ErrorKind::usage, "--count: {} points cannot be chosen from the {} in {}", count, all,
             file);
    return count;
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
