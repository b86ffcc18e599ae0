// SPDX-License-Identifier: MIT
#include "core/point_set.hpp"

#include <limits>
#include <new>

#include "core/error.hpp"
#include "core/machine/large_pages.hpp"

namespace stipple {
namespace {

/// Returns make(count * width), the coordinates of `count` points. Throws Error(limit) if memory is
/// lacking.
template <class Make>
auto room_for(std::size_t count, std::size_t width, const Make& make) {
    constexpr auto most = std::numeric_limits<std::ptrdiff_t>::max() / sizeof(double);
    if (width == 0 || count <= most / width) {
        try {
            return make(count * width);
        } catch (const std::bad_alloc&) {
        }
    }
    fail(ErrorKind::limit, "out of memory for {} points of {} coordinates, which take {:.3g} GB",
         count, width, 8e-9 * static_cast<double>(count) * static_cast<double>(width));
}

}  // namespace

Rows Rows::unwritten(std::size_t count, std::size_t width) {
    Rows rows;
    rows.fresh_ = room_for(count, width, unwritten_room<double>);
    rows.view_ = {rows.fresh_.get(), count * width};
    return rows;
}

PointSet::PointSet(std::size_t count, std::size_t dimension)
    : PointSet(room_for(count, dimension, [](std::size_t n) { return std::vector<double>(n); }),
               dimension) {}

PointSet::PointSet(Rows rows, std::size_t dimension)
    : domain(unit_cube(dimension)), rows_(std::move(rows)), dimension_(dimension) {
    const std::size_t numbers = flat().size();
    if (dimension == 0 ? numbers > 0 : numbers % dimension != 0)
        fail(ErrorKind::usage, "{} numbers cannot be divided into points of {} coordinates",
             numbers, dimension);
    count_ = dimension == 0 ? 0 : numbers / dimension;
}

void PointSet::refuse(std::size_t i) const {
    fail(ErrorKind::usage, "there is no point {} (from 0); the set has {} points", i, count());
}

}  // namespace stipple
