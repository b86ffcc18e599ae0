// SPDX-License-Identifier: MIT
#include "analyzers/sensitivity/elementary_effects.hpp"

#include <fmt/format.h>

#include <cmath>

#include "analyzers/sensitivity/bootstrap.hpp"
#include "core/error.hpp"

namespace stipple::analyzers::sensitivity {
namespace {

/// The one coordinate in which two rows differ; k where there is none, or more than one.
std::size_t moved(std::span<const double> from, std::span<const double> to) {
    std::size_t found = from.size();
    for (std::size_t j = 0; j < from.size(); ++j) {
        if (from[j] == to[j]) continue;
        if (found < from.size()) return from.size();
        found = j;
    }
    return found;
}

/// EE, |EE| and EE^2 of each input, a trajectory a row.
TermTable effect_table(const Layout& layout, const PointSet& design, std::span<const double> u,
                       std::span<const double> y, std::span<const std::size_t> trajectories) {
    const std::size_t k = design.dimension();
    TermTable table{.terms = std::vector<double>(trajectories.size() * 3 * k), .width = 3 * k};
    for (std::size_t t = 0; t < trajectories.size(); ++t)
        for (std::size_t s = 0; s < k; ++s) {
            const std::size_t row = trajectories[t] * layout.group + s;
            const std::size_t i = moved(design[row], design[row + 1]);
            const double effect = (y[row + 1] - y[row]) / (u[(row + 1) * k + i] - u[row * k + i]);
            double* terms = &table.terms[t * table.width];
            terms[i] = effect;
            terms[k + i] = std::abs(effect);
            terms[2 * k + i] = effect * effect;
        }
    return table;
}

}  // namespace

Layout find_trajectories(const PointSet& design) {
    const std::size_t group = design.dimension() + 1;
    if (design.count() == 0 || design.count() % group != 0)
        return {.trouble = fmt::format("{} rows are no multiple of {}", design.count(), group)};
    std::vector<bool> seen(design.dimension());
    for (std::size_t at = 0; at + 1 < design.count(); ++at) {
        if (at % group == 0) seen.assign(seen.size(), false);
        if (at % group + 1 == group) continue;
        const std::size_t i = moved(design[at], design[at + 1]);
        if (i == seen.size())
            return {.trouble = fmt::format("points {} and {} do not differ in one coordinate", at,
                                           at + 1)};
        if (seen[i])
            return {.trouble = fmt::format("coordinate {} moves twice on the trajectory from "
                                           "point {} on",
                                           i + 1, at - at % group)};
        seen[i] = true;
    }
    return {.group = group};
}

Effects elementary_effects(const Layout& layout, const Inputs& inputs, const Response& response,
                           const Setting& setting, const RunContext& run) {
    const std::size_t k = inputs.size();
    const auto trajectories = complete_groups(response.y, layout.group);
    const auto r = static_cast<double>(trajectories.size());
    if (trajectories.size() < 2)
        fail(ErrorKind::input,
             "the output {} has {} trajectories without failed runs; two are needed", response.name,
             trajectories.size());
    const UnitInputs unit = unit_inputs(inputs, false);
    const TermTable table = effect_table(layout, inputs.values, unit.u, response.y, trajectories);
    constexpr double caution = 20;
    const auto found = bootstrapped(
        table, 3 * k,
        [&](std::span<const double> means, std::span<double> values) {
            for (std::size_t t = 0; t < 2 * k; ++t) values[t] = means[t];
            for (std::size_t i = 0; i < k; ++i) {
                const double square = means[2 * k + i] - means[i] * means[i];
                values[2 * k + i] = std::sqrt(std::max(square, 0.0) * r / (r - 1));
            }
        },
        caution, setting, run);
    Effects effects{
        .used = trajectories.size() * layout.group,
        .samples = trajectories.size(),
        .kinds = {{"mu", part_of(found, 0, k)},
                  {"mu_star", part_of(found, k, k)},
                  {"sigma", part_of(found, 2 * k, k)}},
        .no_intervals = too_few_for_intervals(trajectories.size(), least_rows, "trajectories")};
    effects.details.add("scale", unit.scale);
    return effects;
}

}  // namespace stipple::analyzers::sensitivity
