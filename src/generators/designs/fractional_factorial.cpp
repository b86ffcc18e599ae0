// SPDX-License-Identifier: MIT
//
// Regular fractional factorial design 2^(k-p): k factors of two levels in n = 2^(k-p) runs, a part
// of the full factorial (regular_fraction.hpp). The factors are A, B, ..., H, J, ..., Z, a, ...,
// without I, which stands for the mean. The fraction is given by --generators (D=ABC,E=-AB), or is
// the one of least aberration for a count, or with the fewest runs for a resolution:
//
//     III   main effects are aliased with interactions of two factors, but not with each other
//     IV    with those of three; interactions of two factors with each other
//     V     neither with those of two
//
// Shape   n x k, 2 <= k <= 50; n is a power of two, at most 2^16 where a fraction is looked for.
//         Runs in standard order of the factors that are not generated, the first fastest.
// Promise the provenance has the resolution and the number of words of each length, for p <= 6 the
//         words and the shortest aliases of main effects, too; and whether the search left nothing
//         out (complete), as with up to 16 runs, or gave up after a fixed number of steps with the
//         best that it had (limited).
// Source  G. E. P. Box, J. S. Hunter, Technometrics 3 (1961) 311-351,
//         doi:10.1080/00401706.1961.10489951; A. Fries, W. G. Hunter, Technometrics 22 (1980)
//         601-608, doi:10.1080/00401706.1980.10486210 (aberration).

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "core/error.hpp"
#include "core/text.hpp"
#include "generators/designs/fraction_notation.hpp"
#include "generators/designs/levels.hpp"
#include "generators/designs/regular_fraction.hpp"

namespace stipple::generators::fractional_factorial {
namespace {

constexpr Param<Text> equations{
    {.name = "generators",
     .help = "Factors that are products of others, such as D=ABC,E=-AB; gives the count"}};

constexpr Param<std::int64_t> resolution{
    .name = "resolution",
    .low = 3,
    .high = 8,
    .optional = true,
    .help =
        "The fewest runs with it or a higher one, and of these the least aberration; default: "
        "3, or the highest that the count allows"};

std::size_t asked_resolution(const Values& options) {
    return options.given(resolution) ? static_cast<std::size_t>(options[resolution]) : 3;
}

/// @throws Error(usage) for counts that are not the runs of a fraction
FoundFraction for_count(std::uint64_t count, std::size_t factors, const Values& options,
                        const RunContext& run) {
    const std::uint64_t all = std::uint64_t{1} << factors;
    if (!std::has_single_bit(count) || count > all) {
        const std::uint64_t below = std::min(std::bit_floor(count), all);
        const bool largest = below == all;
        refuse_count(count, largest ? "a part of the 2^k runs" : "a power of two",
                     fmt::format("fractional-factorial of {} factors", factors), below,
                     largest ? ~std::uint64_t{0} : std::bit_ceil(count));
    }
    const auto basic = static_cast<std::size_t>(std::countr_zero(count));
    if (basic < factors && basic > most_basic_factors)
        fail(ErrorKind::usage,
             "--count: {} runs are more than 2^{}, up to which a fraction is looked for; "
             "--generators gives larger ones",
             count, most_basic_factors);
    FoundFraction found = least_aberration(factors, basic, asked_resolution(options), run);
    if (found.design) return found;
    const auto fewest = fewest_runs(factors, asked_resolution(options), run);
    fail(ErrorKind::usage, "--count: {} runs are too few for {} factors at resolution {}{}", count,
         factors, roman_numeral(asked_resolution(options)),
         fewest.design ? fmt::format("; {} do", fewest.design->runs()) : "");
}

FoundFraction decide(std::optional<std::uint64_t> count, std::size_t factors, const Values& options,
                     const RunContext& run) {
    if (options.given(equations))
        return {fraction_of(parse_equations(options[equations]), factors)};
    if (count) return for_count(*count, factors, options, run);
    FoundFraction found = fewest_runs(factors, asked_resolution(options), run);
    if (!found.design)
        fail(ErrorKind::usage,
             "--resolution: {} factors at resolution {} take more than 2^{} runs, up to which a "
             "fraction is looked for; --generators gives larger ones",
             factors, roman_numeral(asked_resolution(options)), most_basic_factors);
    return found;
}

/// As many factors as the equations name. @throws Error(usage)
std::size_t factors_of(const Request& request, const Values& options) {
    if (!options.given(equations)) return request.dimension.value_or(3);
    std::uint64_t named = 0;
    for (const Equation& e : parse_equations(options[equations]))
        named |= e.product | std::uint64_t{1} << e.factor;
    const auto least = static_cast<std::size_t>(std::bit_width(named));
    if (request.dimension.value_or(least) < least)
        fail(ErrorKind::usage, "--dimension: {} factors, but --generators names {}",
             *request.dimension, factor_letters[least - 1]);
    return request.dimension.value_or(least);
}

Plan plan(const Request& request, const Values& options) {
    if (options.given(equations) && options.given(resolution))
        fail(ErrorKind::usage, "--generators and --resolution are two ways to choose; give one");
    const std::size_t k = factors_of(request, options);
    const RegularFraction design = *decide(request.count, k, options, {}).design;
    return plan_of_runs(request, design.runs(), k,
                        fmt::format("the fraction 2^({}-{})", k, k - design.basic.size()));
}

Findings findings_of(const FoundFraction& found, bool searched, bool ends) {
    const RegularFraction& design = *found.design;
    Findings findings{{"coded_bounds", coded_range(2, ends)}};
    const WordLengths lengths = word_lengths(design);
    const std::size_t least = resolution_of(lengths);
    findings.emplace_back("resolution", least == 0 ? "full" : roman_numeral(least));
    if (least == 0) return findings;
    findings.emplace_back("generators", equations_of(design));
    findings.emplace_back("word_lengths", lengths_text(lengths));
    if (design.factors() - design.basic.size() <= 6) {
        const auto words = defining_words(design);
        findings.emplace_back("defining_relation", relation_of(design, words));
        findings.emplace_back("aliases", aliases_of(design, words));
    }
    if (searched) findings.emplace_back("search", found.complete ? "complete" : "limited");
    return findings;
}

std::unique_ptr<Sequence> make(const Plan& plan, const Values& options, const RunContext& run) {
    const FoundFraction found = decide(plan.count, plan.dimension, options, run);
    const bool ends = options[ends_option];
    return level_sequence(
        plan, level_places(2, ends),
        [design = *found.design](std::uint64_t i, std::size_t k) { return design.level(i, k); },
        findings_of(found, !options.given(equations), ends));
}

}  // namespace

Generator unit() {
    return {.name = "fractional-factorial",
            .summary = "Regular two-level fraction 2^(k-p) by generators, count or resolution",
            .source =
                "Box, Hunter 1961, doi:10.1080/00401706.1961.10489951; Fries, Hunter 1980, "
                "doi:10.1080/00401706.1980.10486210",
            .related = {"doe", "experiment", "fraction", "screening", "resolution",
                        "minimum-aberration", "alias", "confounding"},
            .traits = {.min_dimension = 2,
                       .max_dimension = factor_letters.size(),
                       .prefix = false,
                       .seeded = false},
            .options = Schema(equations, resolution, ends_option),
            .aliases = {"fracfact"},
            .plan = plan,
            .sequence = make};
}

}  // namespace stipple::generators::fractional_factorial
