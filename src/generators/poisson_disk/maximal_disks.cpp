// SPDX-License-Identifier: MIT
#include "generators/poisson_disk/maximal_disks.hpp"

#include <cmath>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "generators/poisson_disk/grid.hpp"

namespace stipple::poisson_disk {
namespace {

/// Whether the samplers of plane/ and space/ apply: in 2-D and 3-D, for five cells or more along
/// each direction, if a radius spans two of them.
bool is_fine(const BoxSpace& space, const std::vector<double>& cells, double radius) {
    const double wider = reach_factor(distance_slack(space, radius));
    bool fine = cells.size() <= 3;
    for (std::size_t k = 0; k < cells.size(); ++k) {
        const double across = radius / (space.box.extent(k) / cells[k]) * wider;
        fine = fine && cells[k] > 4 && across >= 1 && across < 2;
    }
    return fine;
}

template <std::size_t D>
Rows sample(const BoxSpace& space, double radius, double cell_radius, std::uint64_t seed,
            const RunContext& run) {
    const bool fine = is_fine(space, cells_along(space.box, cell_radius), radius);
    const unsigned bits = !fine ? box_tile_bits<D> : D == 2 ? plane_tile_bits : space_tile_bits;
    const double seconds_a_point = !fine ? 1e-5 : D == 2 ? 6e-7 : 2.5e-6;  // far more for D > 3
    const double expected = expected_disks(space, radius);
    const RunContext on = worth_threads(run, expected * seconds_a_point);
    const Grid<D> grid(space, radius, cell_radius, 1U << bits);
    const Task<D> task{grid, static_cast<std::uint64_t>(expected), seed};
    if constexpr (D == 2)
        if (fine) return plane_sample(task, on);
    if constexpr (D == 3)
        if (fine) return space_sample(task, on);
    return box_sample(task, on);
}

/// Bytes for `points` points in a grid with `along` cells in each direction.
double memory_for(const std::vector<double>& along, bool fine, double points) {
    const auto d = static_cast<double>(along.size());
    const unsigned bits = along.size() == 2 ? plane_tile_bits : space_tile_bits;
    double cells = 1;
    double tiles = 1;
    for (const double count : along) {
        cells *= count;
        tiles *= std::ceil(count / (1U << bits));
    }
    // Memory of points and their copies, and of gaps, at first one per cell.
    if (!fine) return points * (5 * 8 * d) + 2 * cells * (8 * d + 8);
    // Memory of tables, of points with copies in other tiles and pending darts, and of gaps.
    return along.size() == 2 ? tiles * plane_tile_bytes + 45 * points + 4 * cells
                             : tiles * space_tile_bytes + 140 * points;
}

/// @throws Error(limit) if the points for this radius exceed the memory limit or 32-bit indices
void check_size(const BoxSpace& space, double radius, double cell_radius, const RunContext& run) {
    const std::vector<double> along = cells_along(space.box, cell_radius);
    double cells = 1;
    for (const double count : along) cells *= count;
    const double points = expected_disks(space, radius);
    run.need_memory(
        memory_for(along, is_fine(space, along, radius), points),
        fmt::format("a radius of {}, with about {:.3g} points,", format_number(radius), points));
    if (cells >= 0xffff'fffe)
        fail(ErrorKind::limit,
             "a radius of {:.3g}, with about {:.3g} points, needs {:.3g} search cells; at most "
             "2^32 are possible, for about {:.2g} points",
             radius, points, cells, points / cells * 0x1p32);
}

}  // namespace

double expected_disks(const BoxSpace& space, double radius) {
    return space.expected_points(saturated_density[space.box.dimension()], radius);
}

Rows maximal_disks(const BoxSpace& space, double radius, double cell_radius, std::uint64_t seed,
                   const RunContext& run) {
    space.check_resolution(radius, "a radius");
    check_size(space, radius, cell_radius, run);
    return with_dimension<most_directions, 2>(space.box.dimension(), [&]<std::size_t D>() {
        return sample<D>(space, radius, cell_radius, seed, run);
    });
}

}  // namespace stipple::poisson_disk
