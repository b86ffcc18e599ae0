// SPDX-License-Identifier: MIT
#include "generators/designs/levels.hpp"

#include <fmt/format.h>

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
            asked >= others ? fmt::format("--center {} gives so many", asked - others) : "",
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

std::unique_ptr<Sequence> level_sequence(std::size_t factors, std::vector<double> places,
                                         LevelOf level_of, Findings findings) {
    auto points = sequence_of([factors, places = std::move(places), level_of = std::move(level_of)](
                                  std::uint64_t run, std::span<double> rows) {
        for (; !rows.empty(); rows = rows.subspan(factors), ++run)
            for (std::size_t k = 0; k < factors; ++k) rows[k] = places[level_of(run, k)];
    });
    points->set_found([findings = std::move(findings)] { return findings; });
    return points;
}

}  // namespace stipple::generators
