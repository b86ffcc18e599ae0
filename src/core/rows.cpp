// SPDX-License-Identifier: MIT
#include "stipple/points.hpp"

#include "core/machine/large_pages.hpp"

namespace stipple {

Rows Rows::unwritten(std::size_t count) {
    Rows rows;
    rows.fresh_ = unwritten_room<double>(count);
    rows.view_ = {rows.fresh_.get(), count};
    return rows;
}

}  // namespace stipple
