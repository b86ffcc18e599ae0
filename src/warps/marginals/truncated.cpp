// SPDX-License-Identifier: MIT
//
// Any other distribution on the line, restricted to the interval between two ends a and b, each
// coordinate independently, by inversion of
//
//     (F(x) - F(a)) / (F(b) - F(a)) = xi,
//
// computed from the tail with the smaller probabilities (math/distributions/truncated.cpp), so that
// a normal distribution loses no digits even beyond 30 standard deviations.
//
// Shape   any number of coordinates; one end or both; each end is one number for all coordinates,
//         or one for each.
// Strata  xi is used directly, not as 1 - xi: strata become equally probable intervals, in order.
// Cost    that of the distribution, plus about 15 ns a coordinate on one core.
// Promise x in [a, b]. For continuous distributions the interval must have a probability above
//         1e-290; discrete ones are cut exactly. The same bits on every machine.
// Beware  errors of x are relative to the interval's width, not to x: up to 1e-15 of the width or,
//         if s is the ratio of the probability in the interval to that beyond it, up to 1e-16 / s
//         of the width.

#include <algorithm>
#include <limits>

#include "core/error.hpp"
#include "core/spec.hpp"
#include "warps/marginal_mapping.hpp"

namespace stipple::warps::truncated {
namespace {

constexpr Param<Text> of{
    {.name = "of",
     .fallback = "normal",
     .help = "Distribution to truncate, as a spec: normal:deviation=2, gamma:shape=3"}};
constexpr Param<Numbers> low{
    {.name = "low",
     .help = "Lower end: one number for all coordinates, or one for each; default: none"}};
constexpr Param<Numbers> high{
    {.name = "high",
     .help = "Upper end: one number for all coordinates, or one for each; default: none"}};

/// Members of the family named by --of. @throws Error(usage)
std::vector<MarginalPtr> members_of(const std::string& text) {
    const Spec spec = parse_spec(text);
    if (!spec.coordinates.empty())
        fail(ErrorKind::usage, "--of: '{}' has coordinates; expected a name and its options", text);
    ParameterLists lists;
    for (const auto& [name, numbers] : spec.settings)
        lists.emplace_back(name, parse_numbers(name, numbers));
    return family_members(spec.name, lists);
}

std::unique_ptr<Mapping> make(const WarpRequest& want) {
    const std::vector<MarginalPtr> laws = members_of(want.options[of]);
    const std::vector<double> lows = want.options[low];
    const std::vector<double> highs = want.options[high];
    if (lows.empty() && highs.empty())
        fail(ErrorKind::usage, "--low: neither --low nor --high is given; expected one or both");
    const std::size_t members = std::max({laws.size(), lows.size(), highs.size()});
    const auto at = [&](const auto& list, std::size_t k, auto none) {
        if (list.size() > 1 && list.size() != members)
            fail(ErrorKind::usage,
                 "--low: {} lower and {} upper ends for {} coordinates; expected one for all, or "
                 "one for each",
                 lows.size(), highs.size(), members);
        return list.empty() ? none : list[list.size() > 1 ? k : 0];
    };
    constexpr double endless = std::numeric_limits<double>::infinity();
    std::vector<MarginalPtr> parts;
    for (std::size_t k = 0; k < members; ++k)
        parts.push_back(stipple::truncated(at(laws, k, MarginalPtr()), at(lows, k, -endless) + 0.0,
                                           at(highs, k, endless) + 0.0, "--"));
    return marginal_mapping(parts, want.given, want.spec());
}

}  // namespace

Warp unit() {
    return {
        .name = "truncated",
        .summary =
            "Any other one-dimensional distribution, truncated to an interval, on each coordinate",
        .source = "Inverse of the distribution function, from the nearer tail",
        .related = {"truncated-normal", "clipped", "bounded"},
        .strata = "xi is the probability below x, used directly: xi = 0 is the lower end",
        .options = Schema(of, low, high),
        .stream_version = 2,
        .mapping = make};
}

}  // namespace stipple::warps::truncated
