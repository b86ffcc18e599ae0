// SPDX-License-Identifier: MIT
//
// Points from orthogonal arrays: n = s^t points in d dimensions such that, for any t coordinates,
// each of the s x ... x s = n cells holds exactly one point.
//
//     bose   t = 2,  n = s^2, s prime, d <= s + 1
//     bush   any t,  n = s^t, s prime, d <= s + 1
//     cmj    t = d,  n = s^d, any s: multi-jittered in d dimensions
//
// With --substrata independent or correlated, the points are also a Latin hypercube: each of the n
// strips along each axis holds one (orthogonal_points.hpp).
//
// Cost    O(n d t); point i is found without the others.
// Promise the counts above in exact arithmetic, also after rounding (math/digital/stratum.hpp).
// Source  W. Jarosz, A. Enayet, A. Kensler, C. Kilpatrick, P. Christensen, Comput. Graph. Forum
//         38 (4) (2019) 135-147, doi:10.1111/cgf.13777; R. C. Bose, Sankhya 3 (1938) 323-338;
//         K. A. Bush, Ann. Math. Stat. 23 (1952) 426-434, doi:10.1214/aoms/1177729387.

#include "core/error.hpp"
#include "generators/stratified/orthogonal_points.hpp"

namespace stipple::generators::orthogonal_array {
namespace {

constexpr Param<Choice> construction{.name = "construction",
                                     .fallback = "cmj",
                                     .choices = "bose|bush|cmj",
                                     .help =
                                         "bose: s^2 points, s prime; bush: s^strength points, s "
                                         "prime; cmj: s^dimension points, any s"};
constexpr Param<std::int64_t> strength{
    .name = "strength",
    .low = 1,
    .high = 53,
    .optional = true,
    .unit = "coordinates",
    .help =
        "Number of coordinates that are stratified jointly: 2 for bose, the dimension for cmj, any "
        "for bush (default: 3)"};
constexpr Param<Choice> substrata{
    .name = "substrata",
    .fallback = "correlated",
    .choices = "none|independent|correlated",
    .help =
        "Strata within a level: none; independent: in random order, drawn for each level; "
        "correlated: in the same order in all levels"};

std::size_t strength_of(const Values& options, std::size_t dimension) {
    const std::string name = options[construction];
    const std::size_t natural = name == "bose" ? 2 : name == "bush" ? 3 : dimension;
    if (!options.given(strength)) return natural;
    const auto given = static_cast<std::size_t>(options[strength]);
    if (name != "bush" && given != natural)
        fail(ErrorKind::usage, "--strength: {} contradicts --construction {}, whose strength is {}",
             given, name, natural);
    return given;
}

std::string who(const Values& options) { return "orthogonal-array by " + options[construction]; }

Plan plan(const Request& request, const Values& options) {
    const std::size_t t = strength_of(options, request.dimension.value_or(2));
    if (options[construction] == "cmj") return plan_of_cubes(request, who(options));
    return plan_by_polynomials(request, t, who(options));
}

std::unique_ptr<Sequence> make(const Plan& plan, const Values& options, const RunContext&) {
    const std::size_t t = strength_of(options, plan.dimension);
    const bool grid = options[construction] == "cmj";
    const ArrayShape shape{.levels = grid ? exact_root(plan.count, t, who(options))
                                          : prime_root(plan.count, t, who(options)),
                           .strength = t,
                           .columns = grid ? Columns::digits : Columns::polynomials};
    const std::string finer = options[substrata];
    return orthogonal_points(plan, style_of(options), shape,
                             finer == "none"          ? Substrata::none
                             : finer == "independent" ? Substrata::independent
                                                      : Substrata::shared);
}

}  // namespace

Generator unit() {
    return {.name = "orthogonal-array",
            .summary = "Points from orthogonal arrays: stratified in several coordinates jointly",
            .source =
                "Jarosz et al. 2019, doi:10.1111/cgf.13777; Bose 1938; Bush 1952, "
                "doi:10.1214/aoms/1177729387",
            .related = {"taguchi", "bush", "bose", "oa-lhs"},
            .traits = {.prefix = false},
            .options = Schema(construction, strength, substrata, centered_option, order_option),
            .aliases = {"oa"},
            .plan = plan,
            .sequence = make};
}

}  // namespace stipple::generators::orthogonal_array
