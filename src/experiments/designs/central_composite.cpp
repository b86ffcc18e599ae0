// SPDX-License-Identifier: MIT
//
// Central composite design of k factors: F = 2^k corners at (+-1, ..., +-1), or a fraction of
// resolution V of them; 2k axial runs at distance alpha from the centre, along each axis; and runs
// at the centre. The design is scaled about the cube's centre so that its outermost levels are
// those of a three-level design (levels.hpp).
//
//     --alpha rotatable    F^(1/4): equal variance of prediction at equal distance from the centre
//             orthogonal   sqrt((sqrt(F N) - F) / 2) for N runs: quadratic effects are uncorrelated
//
//     --type circumscribed corners at -1 and 1, axial runs at -alpha and alpha
//            inscribed     axial runs at -1 and 1, corners at -1/alpha and 1/alpha
//            faced         alpha = 1
//
// Circumscribed and inscribed designs have equal points in the cube, but the box with these coded
// values (coded_bounds of the provenance, for --bounds) is alpha times as wide for the former.
//
// Shape   n = F + 2 k + --center, k from 2 to 20.
// Promise square roots are the only operations that round; the centre is 1/2 exactly.
// Source  G. E. P. Box, K. B. Wilson, J. R. Stat. Soc. B 13 (1951) 1-45,
//         doi:10.1111/j.2517-6161.1951.tb00067.x; G. E. P. Box, J. S. Hunter, Ann. Math. Stat. 28
//         (1957) 195-241, doi:10.1214/aoms/1177707047 (rotatability).

#include <cmath>

#include "core/error.hpp"
#include "core/text.hpp"
#include "experiments/designs/levels.hpp"
#include "experiments/designs/regular_fraction.hpp"

namespace stipple::generators::central_composite {
namespace {

constexpr Param<Choice> type{
    .name = "type",
    .fallback = "circumscribed",
    .choices = "circumscribed|inscribed|faced",
    .help =
        "Runs at the coded values -1 and 1: the corners, with axial runs outside (circumscribed); "
        "the axial runs, with corners inside (inscribed); or both (faced)"};

constexpr Param<Text> alpha{
    {.name = "alpha",
     .fallback = "rotatable",
     .help = "Distance of the axial runs from the centre, divided by the corners' coordinate: "
             "rotatable, orthogonal or a number of at least 1"}};

constexpr Param<bool> fraction{.name = "fraction",
                               .help =
                                   "Use only the smallest fraction of the corners that has "
                                   "resolution V or more; for 5 factors and more"};

RegularFraction corners_for(std::size_t factors, const Values& options) {
    if (!options[fraction]) return full_fraction(factors);
    const auto found = fewest_runs(factors, 5);
    return found ? found->design : full_fraction(factors);
}

/// Axial distance alpha. @throws Error(usage)
double alpha_of(const Values& options, double corners, double runs) {
    const std::string text = options[alpha];
    if (options[type] == "faced") {
        if (options.given(alpha) && parse_formula(alpha.name, text) != 1.0)
            fail(ErrorKind::usage, "--alpha: {} contradicts --type faced, whose alpha is 1", text);
        return 1;
    }
    if (text == "rotatable") return std::sqrt(std::sqrt(corners));
    if (text == "orthogonal") return std::sqrt((std::sqrt(corners * runs) - corners) / 2);
    const auto value = parse_formula(alpha.name, text);
    if (!value || !(*value >= 1 && *value <= 1e6))
        fail(ErrorKind::usage, "--alpha: '{}' is not rotatable, orthogonal or a number in [1, 1e6]",
             text);
    return *value;
}

Plan plan(const Request& request, const Values& options) {
    const std::size_t k = request.dimension.value_or(2);
    const std::uint64_t corners = corners_for(k, options).runs();
    const Plan plan =
        plan_with_center(request, options, corners + 2 * k, k,
                         fmt::format("the central composite design of {} corners and {} axial runs",
                                     corners, 2 * k));
    alpha_of(options, static_cast<double>(corners), static_cast<double>(plan.count));
    return plan;
}

/// Unit coordinates of the coded values -alpha, -1, 0, 1 and alpha.
std::vector<double> places_of(double a, bool ends) {
    const double outer = std::max(a, 1.0);
    std::vector<double> places{-a, -1, 0, 1, a};
    for (double& x : places) {
        const bool outermost = std::abs(x) == outer;
        x = outermost ? level_place(x > 0 ? 2 : 0, 3, ends) : 0.5 + x / outer / (ends ? 2 : 3);
    }
    return places;
}

std::unique_ptr<Sequence> make(const Plan& plan, const Values& options, const RunContext&) {
    const RegularFraction corners = corners_for(plan.dimension, options);
    const double a =
        alpha_of(options, static_cast<double>(corners.runs()), static_cast<double>(plan.count));
    const bool ends = options[ends_option];
    const double unit = std::max(a, 1.0) / (options[type] == "inscribed" ? a : 1);
    const std::string reach = format_number(unit * (ends ? 1 : 1.5));
    return level_sequence(plan, places_of(a, ends),
                          [corners](std::uint64_t i, std::size_t k) -> std::size_t {
                              if (i < corners.runs()) return corners.level(i, k) == 1 ? 3 : 1;
                              const std::uint64_t axial = i - corners.runs();
                              return axial / 2 != k ? 2 : axial % 2 == 0 ? 0 : 4;
                          },
                          {{"coded_bounds", fmt::format("-{}..{}", reach, reach)},
                           {"alpha", format_number(a)},
                           {"corners", std::to_string(corners.runs())}});
}

}  // namespace

Generator unit() {
    return {.name = "central-composite",
            .summary = "Central composite design: corners, axial runs and centre, for quadratics",
            .source =
                "Box, Wilson 1951, doi:10.1111/j.2517-6161.1951.tb00067.x; Box, Hunter 1957, "
                "doi:10.1214/aoms/1177707047",
            .related = {"doe", "experiment", "response-surface", "rsm", "ccdesign", "rotatable",
                        "axial", "star-points"},
            .traits = level_traits(2, 20),
            .options = Schema(type, alpha, fraction, center_option, ends_option),
            .aliases = {"ccd"},
            .stream_version = 2,
            .plan = plan,
            .sequence = make};
}

}  // namespace stipple::generators::central_composite
