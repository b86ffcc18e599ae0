// SPDX-License-Identifier: MIT
//
// Elementary effects, or Morris screening: on trajectories, one input moves in each step; on stars,
// each input moves from the centre,
//
//     EE_i = (f(x + step along i) - f(x)) / step,    mu = mean EE, mu* = mean |EE|,
//
// and sigma is the standard deviation of EE over the trajectories. Steps are differences of
// probabilities F_i(x_i) if the distributions of the inputs are known (unit_inputs).
//
// If half of the outputs are equal, as those of an event, an effect that fewer than five of r
// trajectories have shown may have the probability q = ln(2 / (1 - level)) / r more. With M the
// largest effect of all inputs, the intervals of mu and mu* extend by q M, and that of sigma upwards
// to sqrt(sigma^2 + q M^2).
//
// Shape   n = r (k + 1) rows: trajectories of k + 1 consecutive rows, in which each input moves
//         once. A discrete input has no effect in trajectories in which it stays the same.
// Units   mu, mu* and sigma have the unit of the output, since inputs are scaled to [0, 1].
// Cost    O(n k), and the bootstrap over trajectories.
// Source  M. D. Morris, Technometrics 33 (1991) 161-174, doi:10.1080/00401706.1991.10484804; mu*:
//         F. Campolongo, J. Cariboni, A. Saltelli, Environ. Model. Softw. 22 (2007) 1509-1518,
//         doi:10.1016/j.envsoft.2006.10.004; stars: F. Campolongo, A. Saltelli, J. Cariboni,
//         Comput. Phys. Commun. 182 (2011) 978-988, doi:10.1016/j.cpc.2010.12.039.
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "experiments/sensitivity/methods.hpp"
#include "math/functions/powers.hpp"

namespace stipple::analyzers::sensitivity {
namespace {

/// Index of the coordinate in which two rows differ; k if they are equal, k + 1 if several differ.
std::size_t moved(std::span<const double> from, std::span<const double> to) {
    const std::size_t k = from.size();
    std::size_t found = k;
    for (std::size_t j = 0; j < k; ++j)
        if (from[j] != to[j]) found = found == k ? j : k + 1;
    return found;
}

/// Index of the row from which the move to `row` begins.
std::size_t origin_of(std::size_t row, std::size_t group, bool star) {
    return star ? row - row % group : row - 1;
}

/// Checks that in groups of k + 1 rows each row moves in one coordinate, from the previous row or,
/// in a star, from the first row of its group. With discrete inputs, rows may also not move.
Layout find_moves(const PointSet& design, bool star) {
    const std::size_t k = design.dimension();
    const std::size_t group = k + 1;
    std::size_t moves = 0;
    std::vector<bool> seen(k);
    for (std::size_t row = 0; row < design.count(); ++row) {
        if (row % group == 0) seen.assign(k, false);
        if (row % group == 0) continue;
        const std::size_t from = origin_of(row, group, star);
        const std::size_t i = moved(design[from], design[row]);
        if (i == k) continue;
        if (i > k)
            return {.trouble = fmt::format(
                        "points {} and {} do not differ in exactly one coordinate", from, row)};
        if (seen[i])
            return {.trouble = fmt::format(
                        "coordinate {} changes twice on the trajectory that starts at point {}",
                        i + 1, row - row % group)};
        seen[i] = true;
        ++moves;
    }
    const std::size_t steps = design.count() / group * k;
    if (2 * moves < steps)
        return {.trouble = fmt::format("only {} of {} steps change a coordinate", moves, steps)};
    return {.group = group, .star = star};
}

/// Terms z, |EE|, z^2 and 1 for each input, with z = (EE - centre) / unit, one row per trajectory;
/// all 0 if the input did not move. `centre` is an input's mean effect, `unit` the size of EE - centre.
struct EffectTable {
    TermTable terms;
    std::vector<double> centre;
    std::vector<double> unit;
};

EffectTable effect_table(const Layout& layout, const PointSet& design, const PointSet& u,
                         std::span<const double> y, std::span<const std::size_t> trajectories) {
    const std::size_t k = design.dimension();
    EffectTable table{{std::vector<double>(trajectories.size() * 4 * k), 4 * k},
                      std::vector<double>(k),
                      std::vector<double>(k)};
    const auto terms_of = [&](std::size_t t) { return &table.terms.terms[t * 4 * k]; };
    std::vector<double> counts(k);
    for (std::size_t t = 0; t < trajectories.size(); ++t)
        for (std::size_t s = 1; s <= k; ++s) {
            const std::size_t row = trajectories[t] * layout.group + s;
            const std::size_t from = origin_of(row, layout.group, layout.star);
            const std::size_t i = moved(design[from], design[row]);
            const double step = i < k ? u[row][i] - u[from][i] : 0;
            if (step == 0) continue;
            terms_of(t)[i] = (y[row] - y[from]) / step;
            terms_of(t)[3 * k + i] = 1;
            table.centre[i] += terms_of(t)[i];
            ++counts[i];
        }
    for (std::size_t i = 0; i < k; ++i) table.centre[i] /= std::max(counts[i], 1.0);
    for (std::size_t t = 0; t < trajectories.size(); ++t)
        for (std::size_t i = 0; i < k; ++i) {
            double* terms = terms_of(t);
            if (terms[3 * k + i] == 0) continue;
            terms[k + i] = std::abs(terms[i]);
            terms[i] -= table.centre[i];
            table.unit[i] = std::max(table.unit[i], std::abs(terms[i]));
        }
    for (double& unit : table.unit) unit = unit_for(unit);
    for (std::size_t t = 0; t < trajectories.size(); ++t)
        for (std::size_t i = 0; i < k; ++i) {
            double& z = terms_of(t)[i];
            z /= table.unit[i];
            terms_of(t)[2 * k + i] = z * z;
        }
    return table;
}

/// Extends intervals for effects that few trajectories have shown, if any.
void allow_for_unseen(std::vector<Index>& found, const TermTable& table, double level) {
    const std::size_t k = table.width / 4;
    const auto term = [&](std::size_t t, std::size_t i) {
        return table.terms[t * table.width + i];
    };
    double most = 0;
    for (std::size_t t = 0; t < table.rows(); ++t)
        for (std::size_t i = k; i < 2 * k; ++i) most = std::max(most, term(t, i));
    for (std::size_t i = 0; i < k; ++i) {
        std::size_t moves = 0;
        std::size_t shown = 0;
        for (std::size_t t = 0; t < table.rows(); ++t) {
            moves += term(t, 3 * k + i) > 0 ? 1 : 0;
            shown += term(t, k + i) > 0 ? 1 : 0;
        }
        const double chance = shown < moves ? unseen_chance(moves, shown, level) : 0;
        if (chance == 0) continue;
        found[i].low -= chance * most;
        found[i].high += chance * most;
        found[k + i].high += chance * most;
        double& sigma = found[2 * k + i].high;
        sigma = std::sqrt(sigma * sigma + chance * most * most);
    }
}

}  // namespace

Layout find_trajectories(const PointSet& design) {
    const std::size_t group = design.dimension() + 1;
    if (design.count() == 0 || design.count() % group != 0)
        return {.trouble = fmt::format("{} rows are not a multiple of {}", design.count(), group)};
    Layout trajectories = find_moves(design, false);
    if (trajectories) return trajectories;
    Layout stars = find_moves(design, true);
    return stars ? stars : trajectories;
}

Effects elementary_effects(const Layout& layout, const Inputs& inputs, const Response& response,
                           const Setting& setting, const RunContext& run) {
    const std::size_t k = inputs.size();
    const auto trajectories = complete_groups(response, layout.group, "trajectories");
    const auto r = static_cast<double>(trajectories.size());
    const UnitInputs unit = unit_inputs(inputs);
    const std::vector<double> used = joined(response.y, layout.group, trajectories);
    const double size = unit_for(used);
    std::vector<double> y = response.y;
    for (double& value : y) value /= size;
    const EffectTable table = effect_table(layout, inputs.values, unit.u, y, trajectories);
    constexpr double caution = 20;
    auto found = bootstrapped(
        table.terms, 3 * k,
        [&](std::span<const double> means, std::span<double> values) {
            for (std::size_t i = 0; i < k; ++i) {
                const double moves = means[3 * k + i];
                const double count = std::round(r * moves);
                const double off = means[i] / moves;
                const double square = means[2 * k + i] / moves - off * off;
                values[i] = table.centre[i] + table.unit[i] * off;
                values[k + i] = means[k + i] / moves;
                values[2 * k + i] =
                    table.unit[i] * std::sqrt(std::max(square, 0.0) * count / (count - 1));
            }
        },
        caution, setting, run);
    if (mostly_equal(used)) allow_for_unseen(found, table.terms, setting.level);
    for (Index& index : found) index = {index.value * size, index.low * size, index.high * size};
    for (std::size_t v = k; v < 3 * k; ++v) found[v].low = std::max(found[v].low, 0.0);
    Effects effects{.used = trajectories.size() * layout.group,
                    .samples = trajectories.size(),
                    .kinds = {{"mu", part_of(found, 0, k)},
                              {"mu_star", part_of(found, k, k)},
                              {"sigma", part_of(found, 2 * k, k)}},
                    .no_intervals = no_bootstrap(trajectories.size(), "trajectories", setting)};
    effects.missing.assign(
        k, "it changes in too few trajectories, or the index is too large for float64");
    effects.details.add("scale", unit.scale);
    return effects;
}

}  // namespace stipple::analyzers::sensitivity
