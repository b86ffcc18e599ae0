// SPDX-License-Identifier: MIT
//
// Points mapped to the cube of their domain, where points that follow the domain's density are
// uniform.
#pragma once

#include <fmt/format.h>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "analyzers/outside.hpp"
#include "analyzers/uniformity/pearson.hpp"
#include "core/domain.hpp"
#include "core/options.hpp"
#include "stipple/report.hpp"
#include "stipple/run.hpp"

namespace stipple::analyzers {

/// @throws Error(input) if the domain's coordinates do not preserve probability
void require_even(const Domain& domain, std::string_view analyzer);

/// Moves outcomes of discrete distributions from the middles of their cells to random positions in
/// the cells. Points that follow the density are then uniform. The random numbers depend only on
/// the points' indices.
///
/// Source  L. Rueschendorf, J. Statist. Plann. Inference 139 (2009) 3921-3927,
///         doi:10.1016/j.jspi.2009.05.030 (distributional transform).
void spread_outcomes(const Domain& domain, std::span<double> cubes, std::uint64_t first,
                     const RunContext& run);

/// Adds the names of the cube's axes as "axes", unless they are x1, x2, ....
void tell_axes(const Domain& domain, Report& report);

/// Coordinates of points in the cube; the first point has the index `first`. Adds points outside
/// the domain to `outside`; their coordinates are meaningless.
std::vector<double> cube_rows(const Domain& domain, std::span<const double> rows,
                              std::uint64_t first, Outside& outside, const RunContext& run);

// Options and verdicts shared by the tests of uniformity.

inline constexpr Param<double> level_option{
    .name = "level",
    .fallback = 0.001,
    .low = 0,
    .high = 0.5,
    .low_open = true,
    .help = "Significance level: p-values below it are significant for the verdict"};

inline constexpr std::string_view uniformity_verdicts = "uniform|non-uniform|stratified";

inline constexpr Param<Choice> expect_uniformity_option{
    .name = "expect",
    .choices = uniformity_verdicts,
    .help = "Fail (exit code 1) if the verdict differs; stratified points are not 'uniform'"};

/// Verdict from the tails on one or two grids: depends on which tail is smaller, and on whether the
/// p-value is below the level.
inline std::string verdict_of(const Tails& plain, const Tails* second, double level) {
    const auto clumped = [&](const Tails& tails) {
        return tails.upper < tails.lower && p_value_of(tails, second ? &tails : nullptr) < level;
    };
    if (p_value_of(plain, second) >= level) return "uniform";
    return clumped(plain) || (second && clumped(*second)) ? "non-uniform" : "stratified";
}

/// Adds the verdict with its p-value. If it is not `wanted`, marks the report as failed; an empty
/// `wanted` accepts any verdict.
inline void add_verdict(Report& report, const std::string& verdict, double p,
                        const std::string& wanted) {
    report.add("verdict", verdict);
    if (!wanted.empty() && wanted != verdict)
        report.unmet(fmt::format("expected {}, found {} (p = {:.3g})", wanted, verdict, p));
}

}  // namespace stipple::analyzers
