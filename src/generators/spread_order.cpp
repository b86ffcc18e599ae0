// SPDX-License-Identifier: MIT
#include "generators/spread_order.hpp"

#include <vector>

#include "math/neighbors/point_grid.hpp"

namespace stipple {
namespace {

template <std::size_t D>
Rows in_order(std::span<const double> rows, const BoxSpace& space, double radius,
              const RunContext& run) {
    constexpr double step = 0.8408964152537145;  // 2^(-1/4)
    constexpr std::size_t often = 4096;
    GrowingPoints<D> chosen(space.box, space.torus);
    std::vector<const double*> left;
    for (std::size_t i = 0; i < rows.size(); i += D) left.push_back(rows.data() + i);
    const std::size_t count = left.size();
    std::size_t asked = 0;
    for (double r = space.largest_distance(); !left.empty(); r *= step)
        std::erase_if(left, [&](const double* p) {
            if (asked++ % often == 0) run.tick(chosen.count(), count);
            // If r <= radius, no two points are nearer than r, so the search is skipped.
            if (r > radius && chosen.any_nearer(p, r)) return false;
            chosen.add(p);
            return true;
        });
    return Rows(chosen.rows());
}

}  // namespace

Rows spread_out(std::span<const double> rows, const BoxSpace& space, double radius,
                const RunContext& run) {
    return with_dimension<most_directions>(space.box.dimension(), [&]<std::size_t D>() {
        return in_order<D>(rows, space, radius, run);
    });
}

}  // namespace stipple
