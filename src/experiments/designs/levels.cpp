// SPDX-License-Identifier: MIT
#include "experiments/designs/levels.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/rng.hpp"
#include "core/text.hpp"
#include "math/arithmetic/ratio.hpp"

namespace stipple::generators {

double level_place(std::uint64_t level, std::uint64_t levels, bool ends) {
    if (!ends || levels == 1) return ratio(2 * Wide{level} + 1, 2 * Wide{levels});
    return level + 1 == levels ? one_minus_ulp : ratio(level, levels - 1);
}

std::vector<double> level_places(std::uint64_t levels, bool ends) {
    std::vector<double> places;
    for (std::uint64_t l = 0; l < levels; ++l) places.push_back(level_place(l, levels, ends));
    return places;
}

std::string coded_range(std::uint64_t levels, bool ends) {
    const auto m = static_cast<double>(levels);
    const std::string half = format_number(ends || levels == 1 ? 1 : m / (m - 1));
    return fmt::format("-{}..{}", half, half);
}

Plan plan_of_runs(const Request& request, std::uint64_t runs, std::size_t factors,
                  const std::string& design) {
    if (request.count.value_or(runs) != runs)
        fail(ErrorKind::usage, "--count: {} contradicts {}, which has {} runs; leave --count out",
             *request.count, design, runs);
    return default_plan(request, runs, factors);
}

Plan plan_with_center(const Request& request, const Values& options, std::uint64_t others,
                      std::size_t factors, const std::string& design) {
    const auto center = static_cast<std::uint64_t>(options[center_option]);
    const std::uint64_t asked = request.count.value_or(others + center);
    if (others + center == 0) fail(ErrorKind::usage, "--center: 0 leaves no run");
    if (asked != others + center)
        fail_with_hint(
            ErrorKind::usage,
            asked >= others ? fmt::format("--center {} gives that count", asked - others) : "",
            "--count: {} contradicts {}, which has {} runs and {} at the centre", asked, design,
            others, center);
    return default_plan(request, others + center, factors);
}

void require_whole_blocks(const Plan& plan, std::uint64_t block, const std::string& who) {
    const std::string what = fmt::format("a multiple of {}", block);
    if (plan.count % block != 0)
        refuse_count(plan.count, what, who, plan.count / block * block,
                     (plan.count / block + 1) * block);
    if (plan.start % block != 0)
        fail(ErrorKind::usage, "--start: {} is not {}, as {} needs", plan.start, what, who);
}

LevelPlaces::LevelPlaces(const Plan& plan) {
    if (!plan.destination) return;
    for (const OutcomeAxis& axis : plan.destination->axes) ends_.push_back(level_ends(axis));
}

double LevelPlaces::operator()(std::size_t factor, double x) const {
    const std::size_t count = outcomes(factor);
    if (count == 0) return x;
    const auto outcome =
        std::min(static_cast<std::size_t>(x * static_cast<double>(count)), count - 1);
    return (ends_[factor][outcome] + ends_[factor][outcome + 1]) / 2;
}

std::unique_ptr<Sequence> level_sequence(const Plan& plan, std::span<const double> places,
                                         LevelOf level_of, Findings findings) {
    const std::size_t factors = plan.dimension;
    const LevelPlaces place(plan);
    std::vector<double> at;  // coordinates of all levels, factor after factor
    for (std::size_t k = 0; k < factors; ++k)
        for (const double x : places) at.push_back(place(k, x));
    auto points =
        sequence_of([factors, levels = places.size(), at = std::move(at),
                     level_of = std::move(level_of)](std::uint64_t run, std::span<double> rows) {
            for (; !rows.empty(); rows = rows.subspan(factors), ++run)
                for (std::size_t k = 0; k < factors; ++k)
                    rows[k] = at[k * levels + level_of(run, k)];
        });
    points->set_found([findings = std::move(findings)] { return findings; });
    return points;
}

}  // namespace stipple::generators
