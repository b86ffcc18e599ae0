// SPDX-License-Identifier: MIT
#include "core/point_set.hpp"

#include "core/error.hpp"
#include "core/machine/large_pages.hpp"

namespace stipple {

Rows Rows::unwritten(std::size_t count) {
    Rows rows;
    rows.fresh_ = unwritten_room<double>(count);
    rows.view_ = {rows.fresh_.get(), count};
    return rows;
}

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
