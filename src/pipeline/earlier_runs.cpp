// SPDX-License-Identifier: MIT
#include "pipeline/earlier_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "io/files.hpp"

namespace stipple {
namespace {

constexpr const char* extend_option = "extend";
constexpr const char* add_option = "add";
constexpr const char* levels_of_factors = "levels";

bool given(const Values& options, const char* option) {
    const auto* item = options.try_find(option);
    return item != nullptr && item->given;
}

/// Spreads points with the same discrete outcome evenly over its interval in the unit cube; the
/// inverse of a warp puts all of them in the middle.
void spread(PointSet& cube, const std::vector<OutcomeAxis>& axes) {
    for (std::size_t k = 0; k < axes.size(); ++k) {
        const auto ends = outcome_ends(axes[k], 100'000);
        std::map<double, std::vector<std::size_t>> together;
        for (std::size_t i = 0; i < cube.count() && !ends.empty(); ++i)
            together[cube[i][k]].push_back(i);
        for (const auto& [x, points] : together) {
            const auto end = std::ranges::upper_bound(ends, x);
            if (points.size() == 1 || end == ends.begin() || end == ends.end()) continue;
            const double low = *(end - 1);
            const auto count = static_cast<double>(points.size());
            for (std::size_t j = 0; j < points.size(); ++j)
                cube[points[j]][k] = low + (*end - low) * (static_cast<double>(j) + 0.5) / count;
        }
    }
}

std::string file_of_runs(const Values& options) {
    return std::get<std::string>(options.find(extend_option).value);
}

PointSet read_runs(const Values& options, const WarpChain& chain, const RunContext& run) {
    const std::string path = file_of_runs(options);
    PointSet runs = io::read_given(extend_option, path,
                                   {.expected = chain.names(), .levels = levels_of(chain)}, run);
    if (runs.dimension() != chain.dimension_out())
        fail(ErrorKind::input, "{}: {} columns; the parameters are {}", path, runs.dimension(),
             chain.dimension_out());
    return runs;
}

void count_with_runs(const WarpChain& chain, Request& request, Values& options,
                     const RunContext& run) {
    if (!goes_on_from_runs(options, chain)) return;
    if (chain.traits().needs_whole_set)
        fail(
            ErrorKind::usage,
            "--extend: the parameters of a whole set are reordered; earlier points would not stay");
    request.dimension = chain.dimension_in();
    if (!given(options, add_option)) return;
    const auto more =
        static_cast<std::uint64_t>(std::get<std::int64_t>(options.find(add_option).value));
    const std::uint64_t before = read_runs(options, chain, run).count();
    if (request.count.value_or(before + more) != before + more)
        fail(ErrorKind::usage, "--count: {} is not {}, the {} points of {} and those of --add",
             *request.count, before + more, before, file_of_runs(options));
    request.count = before + more;
    options.put(add_option, std::int64_t{0}, false);
}

void take_levels(const WarpChain& chain, Values& options) {
    std::vector<double> levels;
    for (const OutcomeAxis& axis : chain.outcome_axes()) {
        const auto ends = level_ends(axis);
        levels.push_back(ends.empty() ? 2 : static_cast<double>(ends.size() - 1));
    }
    if (std::ranges::any_of(levels, [](double m) { return m != 2; }))
        options.put(levels_of_factors, std::move(levels));
}

}  // namespace

bool goes_on_from_runs(const Values& options, const WarpChain& chain) {
    return given(options, extend_option) && !chain.empty() && !chain.names().empty();
}

EarlierRuns earlier_runs(const Values& options, const WarpChain& chain, const RunContext& run) {
    const RunContext quiet = silent(run);
    PointSet runs = read_runs(options, chain, quiet);
    try {
        PointSet cube(chain.mapped(runs.flat(), true, 0, quiet), chain.dimension_in());
        spread(cube, chain.outcome_axes());
        if (chain.mapped(cube.flat(), false, 0, quiet).size() != runs.flat().size())
            fail(ErrorKind::input, "a point breaks the constraints");
        return {std::move(runs), std::move(cube)};
    } catch (const Error& e) {
        throw Error(ErrorKind::input, fmt::format("{}: {}", file_of_runs(options), e.what()),
                    e.hint());
    }
}

void take_parameters(const Generator& generator, std::span<const Spec> warps, Request& request,
                     Values& options, const RunContext& run) {
    const auto* levels = options.try_find(levels_of_factors);
    const bool extends = given(options, extend_option);
    const bool takes_levels = generator.traits.levels && levels != nullptr &&
                              std::holds_alternative<std::vector<double>>(levels->value) &&
                              !levels->given && !request.count;
    if (!extends && !takes_levels) return;
    const std::size_t d =
        request.dimension ? *request.dimension : plan_for(generator, request, options).dimension;
    const WarpChain chain(warps, d, {}, run);
    if (extends)
        count_with_runs(chain, request, options, run);
    else
        take_levels(chain, options);
}

void tell_absent_levels(std::span<const double> rows, const Generator& generator,
                        const WarpChain& chain, const RunContext& run) {
    const auto axes = chain.outcome_axes();
    const auto names = chain.names();
    const Levels words = levels_of(chain);
    if (names.size() != axes.size()) return;
    for (std::size_t k = 0; k < axes.size(); ++k) {
        if (!axes[k].categories && !generator.traits.levels) continue;
        const auto ends = level_ends(axes[k]);
        std::set<double> outcomes;
        for (std::size_t l = 0; l + 1 < ends.size(); ++l) outcomes.insert(axes[k].outcome(ends[l]));
        std::set<double> absent = outcomes;
        bool known = true;  // false: the column has other numbers, such as those of the cube
        for (std::size_t at = k; at < rows.size() && known; at += axes.size()) {
            known = outcomes.contains(rows[at]);
            absent.erase(rows[at]);
        }
        if (!known || absent.empty()) continue;
        const auto own = std::ranges::find(words, names[k], &Levels::value_type::first);
        std::vector<std::string> told;
        for (const double x : absent)
            told.push_back(own == words.end() ? format_number(x)
                                              : own->second[static_cast<std::size_t>(x)]);
        run.notify(fmt::format("{}: {} {} in none of the {} points", names[k], join(told, ", "),
                               told.size() == 1 ? "is" : "are", rows.size() / axes.size()));
    }
}

}  // namespace stipple
