// SPDX-License-Identifier: MIT
#include "analyzers/uniformity/cube_rows.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/rng.hpp"
#include "core/text.hpp"

namespace stipple::analyzers {

void require_even(const Domain& domain, std::string_view analyzer) {
    if (domain.even()) return;
    fail_with_hint(ErrorKind::input, "chi-square accepts every domain",
                   "{} needs coordinates that preserve probability; {} does not have them",
                   analyzer, split(domain.title(), ':').front());
}

void spread_outcomes(const Domain& domain, std::span<double> cubes, std::uint64_t first,
                     const RunContext& run) {
    if (!domain.has_outcomes()) return;
    const std::size_t axes = domain.cube_dimension();
    constexpr std::uint64_t stream = std::uint64_t{1} << 35;  // of axis 0; not used by generators
    for_each_block(silent(run), cubes.size() / axes, 4096, [&](const Block& block) {
        Box cell{std::vector<double>(axes, 0), std::vector<double>(axes, 1)};
        for (std::uint64_t i = block.first; i < block.last; ++i)
            for (std::size_t k = 0; k < axes; ++k) {
                double& u = cubes[i * axes + k];
                cell.low[k] = u;
                cell.high[k] = std::nextafter(u, 2);
                const double mass = domain.probability(cell).value;
                cell.low[k] = 0;
                cell.high[k] = 1;
                if (mass > 1e-9)
                    u = std::clamp(u + mass * (Rng(1, stream + k).uniform(first + i) - 0.5), 0.0,
                                   1.0);
            }
    });
}

void tell_axes(const Domain& domain, Report& report) {
    const auto axes = domain.cube_axes();
    if (axes != unit_cube(axes.size())->cube_axes()) report.add("axes", join(axes, "; "));
}

std::vector<double> cube_rows(const Domain& domain, std::span<const double> rows,
                              std::uint64_t first, Outside& outside, const RunContext& run) {
    const std::size_t d = domain.dimension();
    const std::size_t axes = domain.cube_dimension();
    std::vector<double> cubes(rows.size() / d * axes);
    std::mutex adding;
    for_each_block(silent(run), rows.size() / d, std::max<std::size_t>(1, 16384 / d),
                   [&](const Block& block) {
                       Outside found;
                       for (std::uint64_t i = block.first; i < block.last; ++i) {
                           const auto point = rows.subspan(i * d, d);
                           if (domain.contains(point))
                               domain.to_cube(point, std::span(cubes).subspan(i * axes, axes));
                           else
                               found.add(first + i, point);
                       }
                       if (found.count == 0) return;
                       const std::lock_guard lock(adding);
                       outside.add(found);
                   });
    return cubes;
}

}  // namespace stipple::analyzers
