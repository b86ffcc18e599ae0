// SPDX-License-Identifier: MIT
#include "generators/stratified/latin_destination.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/rng.hpp"
#include "generators/stratified/latin_hypercube_search/annealing.hpp"
#include "generators/stratified/stratified.hpp"

namespace stipple::generators {

namespace search = latin_hypercube_search;

namespace {

/// At least `need` random points of the cube that satisfy the constraints.
std::vector<double> points_with_image(const Plan& plan, std::size_t need, const RunContext& run) {
    constexpr std::uint64_t most = std::uint64_t{1} << 27;
    constexpr std::uint64_t enough = std::uint64_t{1} << 20;  // limit of tries without success
    constexpr std::uint64_t block = 4096;
    constexpr std::size_t at_once = 64;
    const std::size_t d = plan.dimension;
    run.need_memory(8 * static_cast<double>(need) * static_cast<double>(d), "the strata");
    const Rng rng(1, std::uint64_t{1} << 34);  // strata do not depend on the seed
    std::vector<double> found;
    std::uint64_t made = 0;
    while (found.size() < need * d && made < (found.empty() ? enough : most)) {
        std::vector<std::vector<double>> parts(at_once);
        for_each_block(silent(run), at_once * block, block, [&](const Block& b) {
            std::vector<double> rows(block * d);
            rng.fill((made + b.first) * d, rows);
            for (std::size_t i = 0; i < rows.size(); i += d) {
                const std::span<const double> row(&rows[i], d);
                if (plan.destination->has_image(0, row))
                    parts[b.index].insert(parts[b.index].end(), row.begin(), row.end());
            }
        });
        made += at_once * block;
        for (const auto& part : parts) found.insert(found.end(), part.begin(), part.end());
    }
    if (found.size() < need * d)
        fail(ErrorKind::input,
             "latin-hypercube: only {} of {} random points satisfy the constraints; a search needs "
             "{}",
             found.size() / d, made, need);
    return found;
}

/// Edges of strata that hold equal fractions of the points that satisfy the constraints, estimated
/// from at least 16 random points per stratum; the outermost edges are these points' extremes.
std::vector<std::vector<double>> strata_of_images(const Plan& plan, const RunContext& run) {
    const std::size_t d = plan.dimension;
    const auto n = static_cast<std::size_t>(plan.count);
    const auto rows = points_with_image(plan, std::max<std::size_t>(16'384, 16 * n), run);
    const std::size_t count = rows.size() / d;
    std::vector<std::vector<double>> edges(d);
    std::vector<double> column(count);
    for (std::size_t k = 0; k < d; ++k) {
        for (std::size_t i = 0; i < count; ++i) column[i] = rows[i * d + k];
        std::ranges::sort(column);
        edges[k] = {column.front()};
        for (std::size_t l = 1; l < n; ++l) {
            const std::size_t i = l * count / n;
            edges[k].push_back((column[i - 1] + column[i]) / 2);
        }
        edges[k].push_back(column.back());
    }
    return edges;
}

/// On discrete axes, puts points into middles of strata and measures distances between outcomes.
void count_outcomes(const Destination& destination, LatinPlaces& places, search::Search& task) {
    const auto& axes = destination.axes;
    if (std::ranges::none_of(axes, &OutcomeAxis::discrete)) return;
    task.rules.axes.assign(axes.size(), {});
    std::vector<double> outcomes(task.start.points);
    for (std::size_t k = 0; k < axes.size(); ++k) {
        if (!axes[k].discrete()) continue;
        places.put_in_middles(k);
        for (std::size_t l = 0; l < outcomes.size(); ++l)
            outcomes[l] = axes[k].outcome(places.middle(k, static_cast<double>(l)));
        task.rules.axes[k] = search::parts_by(outcomes, axes[k].categories);
    }
}

/// Exchanges levels to satisfy the constraints; returns how many points still violate them.
std::size_t unsatisfied(const Plan& plan, search::Search& task, const RunContext& run) {
    constexpr std::uint64_t stream = 8;  // a stream used nowhere else
    search::Exchanges exchanges(task.start, task.rules);
    SplitMix64 draws(stratified_numbers(plan, stream).bits(0));
    const std::size_t wrong = exchanges.make_feasible(draws, run);
    task.start = exchanges.design();
    return wrong;
}

}  // namespace

double LatinPlaces::inside(std::size_t coordinate, double x, double stratum) const {
    if (edges_.empty()) return x;
    const double* edge = &edges_[coordinate][static_cast<std::size_t>(stratum)];
    const double part = x * static_cast<double>(plan_.count) - stratum;
    return edge[0] + std::clamp(part, 0.0, 1.0) * (edge[1] - edge[0]);
}

double LatinPlaces::at(std::size_t coordinate, std::uint64_t i, double stratum) const {
    const double x =
        place_in_stratum(plan_, in_middle_[coordinate], coordinate, i, stratum, plan_.count);
    return inside(coordinate, x, stratum);
}

double LatinPlaces::middle(std::size_t coordinate, double stratum) const {
    return inside(coordinate, place_in_stratum(plan_, true, coordinate, 0, stratum, plan_.count),
                  stratum);
}

void aim_at_destination(const Plan& plan, const std::shared_ptr<LatinPlaces>& places,
                        search::Search& task, const RunContext& run) {
    const auto destination = plan.destination;
    if (!task.rules.axes.empty() && std::ranges::any_of(destination->axes, &OutcomeAxis::discrete))
        fail(ErrorKind::usage,
             "--levels: the parameters define their own levels; leave --levels out");
    count_outcomes(*destination, *places, task);
    if (!destination->drops) return;
    task.rules.feasible = [places, destination](std::size_t row,
                                                std::span<const search::Level> levels) {
        std::vector<double> point(levels.size());
        for (std::size_t k = 0; k < point.size(); ++k) point[k] = places->at(k, row, levels[k]);
        return destination->has_image(row, point);
    };
    if (unsatisfied(plan, task, run) == 0) return;
    if (task.rules.fixed == 0) {
        places->put_between(strata_of_images(plan, run));
        count_outcomes(*destination, *places, task);
        if (unsatisfied(plan, task, run) == 0)
            return run.notify(
                fmt::format("latin-hypercube: no Latin hypercube of {} points was found that "
                            "satisfies the constraints; instead, the strata of each axis hold "
                            "equal fractions of the points that satisfy them",
                            plan.count));
    }
    fail_with_hint(
        ErrorKind::input, "without --optimize, a larger design is made and reduced",
        "latin-hypercube: no design of {} points was found that satisfies the constraints",
        plan.count);
}

}  // namespace stipple::generators
