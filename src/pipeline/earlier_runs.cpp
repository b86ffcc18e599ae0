// SPDX-License-Identifier: MIT
#include "pipeline/earlier_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "generators/designs/levels.hpp"
#include "io/files.hpp"

namespace stipple {
namespace {

constexpr const char* extend = "extend";
constexpr const char* add = "add";
constexpr const char* levels_of_factors = "levels";

bool given(const SetsToMake& asked, const char* option) {
    const auto* item = asked.options.try_find(option);
    return item != nullptr && item->given;
}

/// Whether the points of a generator have levels.
bool has_levels(const Generator& generator) {
    return std::ranges::find(generator.options.options(), generators::ends_option.name,
                             &Option::name) != generator.options.options().end();
}

/// Points in the middle of an outcome's interval are spread evenly over it.
void spread(PointSet& cube, const std::vector<OutcomeAxis>& axes) {
    for (std::size_t k = 0; k < axes.size(); ++k) {
        const auto ends = generators::outcome_ends(axes[k], 100'000);
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

std::string file_of_runs(const SetsToMake& asked) {
    return std::get<std::string>(asked.options.find(extend).value);
}

PointSet read_runs(const SetsToMake& asked, const WarpChain& chain, const RunContext& run) {
    const std::string path = file_of_runs(asked);
    PointSet runs = io::read_given(
        extend, path, {.expected = chain.names({}, false), .levels = chain.levels()}, run);
    if (runs.dimension() != chain.dimension_out())
        fail(ErrorKind::input, "{}: {} columns; the parameters are {}", path, runs.dimension(),
             chain.dimension_out());
    return runs;
}

/// The chain of a request whose dimension is known without its points.
WarpChain chain_of(const SetsToMake& asked, const RunContext& run) {
    const std::size_t d = asked.request.dimension
                              ? *asked.request.dimension
                              : plan_for(*asked.generator, asked.request, asked.options).dimension;
    return WarpChain(asked.warps, d, {}, run);
}

SetsToMake with_count_of_runs(SetsToMake asked, const RunContext& run) {
    const WarpChain chain = chain_of(asked, run);
    if (!goes_on_from_runs(asked, chain)) return asked;
    if (chain.reorders())
        fail(
            ErrorKind::usage,
            "--extend: the parameters of a whole set are reordered; earlier points would not stay");
    asked.request.dimension = chain.dimension_in();
    if (!given(asked, add)) return asked;
    const auto more =
        static_cast<std::uint64_t>(std::get<std::int64_t>(asked.options.find(add).value));
    const std::uint64_t before = read_runs(asked, chain, run).count();
    if (asked.request.count.value_or(before + more) != before + more)
        fail(ErrorKind::usage, "--count: {} is not {}, the {} points of {} and those of --add",
             *asked.request.count, before + more, before, file_of_runs(asked));
    asked.request.count = before + more;
    asked.options.put(add, std::int64_t{0}, false);
    return asked;
}

SetsToMake with_levels(SetsToMake asked, const RunContext& run) {
    const WarpChain chain = chain_of(asked, run);
    std::vector<double> levels;
    for (const OutcomeAxis& axis : chain.outcome_axes()) {
        const auto ends = generators::level_ends(axis);
        levels.push_back(ends.empty() ? 2 : static_cast<double>(ends.size() - 1));
    }
    if (std::ranges::any_of(levels, [](double m) { return m != 2; }))
        asked.options.put(levels_of_factors, std::move(levels));
    return asked;
}

}  // namespace

bool goes_on_from_runs(const SetsToMake& asked, const WarpChain& chain) {
    return given(asked, extend) && !chain.empty() && !chain.names({}, false).empty();
}

EarlierRuns earlier_runs(const SetsToMake& asked, const WarpChain& chain, const RunContext& run) {
    const RunContext quiet = silent(run);
    PointSet runs = read_runs(asked, chain, quiet);
    try {
        PointSet cube(chain.mapped(runs.flat(), true, 0, quiet), chain.dimension_in());
        spread(cube, chain.outcome_axes());
        if (chain.mapped(cube.flat(), false, 0, quiet).size() != runs.flat().size())
            fail(ErrorKind::input, "a point breaks the constraints");
        return {std::move(runs), std::move(cube)};
    } catch (const Error& e) {
        throw Error(ErrorKind::input, fmt::format("{}: {}", file_of_runs(asked), e.what()),
                    e.hint());
    }
}

SetsToMake for_parameters(SetsToMake asked, const RunContext& run) {
    if (asked.warps.empty()) return asked;
    if (given(asked, extend)) return with_count_of_runs(std::move(asked), run);
    const auto* levels = asked.options.try_find(levels_of_factors);
    const bool takes_levels = has_levels(*asked.generator) && levels != nullptr &&
                              std::holds_alternative<std::vector<double>>(levels->value);
    if (takes_levels && !levels->given && !asked.request.count)
        return with_levels(std::move(asked), run);
    return asked;
}

void tell_absent_levels(std::span<const double> rows, const SetsToMake& asked,
                        const WarpChain& chain, const RunContext& run) {
    const auto axes = chain.outcome_axes();
    const auto names = chain.names({}, false);
    const Levels words = chain.levels();
    if (names.size() != axes.size()) return;
    for (std::size_t k = 0; k < axes.size(); ++k) {
        if (!axes[k].categories && !has_levels(*asked.generator)) continue;
        const auto ends = generators::level_ends(axes[k]);
        std::set<double> outcomes;
        for (std::size_t l = 0; l + 1 < ends.size(); ++l) outcomes.insert(axes[k].outcome(ends[l]));
        std::set<double> absent = outcomes;
        bool known = true;  // and not the numbers of the cube that they are made of
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
