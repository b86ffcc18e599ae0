// SPDX-License-Identifier: MIT
//
// Regular fractional factorial design 2^(k-p): k factors of two levels in n = 2^(k-p) runs, a
// subset of the full factorial (regular_fraction.hpp). The factors are A, B, ..., H, J, ..., Z, a,
// ..., without I, which denotes the mean. The fraction is given by --generators (D=ABC,E=-AB) or
// taken from a table (fractions.txt): the one with the highest known resolution for a count, or
// with the fewest runs for a resolution. Among several, it is the one with the least known
// aberration.
//
//     III   main effects are aliased with interactions of two factors, but not with each other
//     IV    main effects are aliased with interactions of three factors; interactions of two
//           factors are aliased with each other
//     V     main effects and interactions of two factors are not aliased with each other
//
// Shape   n x k, 2 <= k <= 50; n is a power of two, at most 2^16 for fractions of the table.
//         Runs are in standard order of the basic factors (those without a generator), the first
//         fastest.
// Promise the provenance has the resolution and the number of words of each length; for p <= 6 also
//         the words and the shortest aliases of main effects. For fractions of the table it also
//         has whether a higher resolution or less aberration is impossible in so many runs (search:
//         complete) or not excluded (limited). A note reports the latter.
// Source  G. E. P. Box, J. S. Hunter, Technometrics 3 (1961) 311-351,
//         doi:10.1080/00401706.1961.10489951; A. Fries, W. G. Hunter, Technometrics 22 (1980)
//         601-608, doi:10.1080/00401706.1980.10486210 (aberration).

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "core/error.hpp"
#include "core/text.hpp"
#include "experiments/designs/fraction_notation.hpp"
#include "experiments/designs/levels.hpp"
#include "experiments/designs/regular_fraction.hpp"

namespace stipple::generators::fractional_factorial {
namespace {

constexpr Param<Text> equations{
    {.name = "generators",
     .help = "Factors defined as products of others, such as D=ABC,E=-AB; gives the count"}};

constexpr Param<std::int64_t> resolution{
    .name = "resolution",
    .low = 3,
    .high = 8,
    .optional = true,
    .help =
        "Minimum resolution, with the fewest runs that are known to reach it, and of these the "
        "smallest known aberration; default: 3, or the highest known for the count"};

std::size_t asked_resolution(const Values& options) {
    return options.given(resolution) ? static_cast<std::size_t>(options[resolution]) : 3;
}

/// Fraction with `count` runs. @throws Error(usage) if there is no such fraction
KnownFraction for_count(std::uint64_t count, std::size_t factors, const Values& options) {
    const std::uint64_t all = std::uint64_t{1} << factors;
    if (!std::has_single_bit(count) || count > all) {
        const std::uint64_t below = std::min(std::bit_floor(count), all);
        const bool largest = below == all;
        refuse_count(count, largest ? "a fraction of the 2^k runs" : "a power of two",
                     fmt::format("fractional-factorial of {} factors", factors), below,
                     largest ? ~std::uint64_t{0} : std::bit_ceil(count));
    }
    const auto basic = static_cast<std::size_t>(std::countr_zero(count));
    if (basic < factors && basic > most_basic_factors)
        fail(ErrorKind::usage,
             "--count: {} runs are more than 2^{}, the largest known fraction; --generators gives "
             "larger ones",
             count, most_basic_factors);
    const std::size_t asked = asked_resolution(options);
    const auto known = known_fraction(factors, basic);
    if (known && known->has(asked)) return *known;
    const auto fewest = fewest_runs(factors, asked);
    const std::string others = fewest ? fmt::format("; {} suffice", fewest->design.runs()) : "";
    if (known && known->bound >= asked)
        fail(ErrorKind::usage,
             "--count: {} runs are not known to suffice for {} factors at resolution {}{}", count,
             factors, roman_numeral(asked), others);
    fail(ErrorKind::usage, "--count: {} runs are too few for {} factors at resolution {}{}", count,
         factors, roman_numeral(asked), others);
}

/// Fraction selected by the options. @throws Error(usage)
KnownFraction decide(std::optional<std::uint64_t> count, std::size_t factors,
                     const Values& options) {
    if (options.given(equations))
        return {.design = fraction_of(parse_equations(options[equations]), factors)};
    if (count) return for_count(*count, factors, options);
    const auto known = fewest_runs(factors, asked_resolution(options));
    if (!known)
        fail(ErrorKind::usage,
             "--resolution: no fraction of up to 2^{} runs is known for {} factors at resolution "
             "{}; --generators gives larger ones",
             most_basic_factors, factors, roman_numeral(asked_resolution(options)));
    return *known;
}

/// Number of factors: the dimension, or the number of factors in the equations. @throws
/// Error(usage)
std::size_t factors_of(const Request& request, const Values& options) {
    if (!options.given(equations)) return request.dimension.value_or(3);
    std::uint64_t named = 0;
    for (const Equation& e : parse_equations(options[equations]))
        named |= e.product | std::uint64_t{1} << e.factor;
    const auto least = static_cast<std::size_t>(std::bit_width(named));
    if (request.dimension.value_or(least) < least)
        fail(ErrorKind::usage, "--dimension: {} factors are too few; --generators names factor {}",
             *request.dimension, factor_letters[least - 1]);
    return request.dimension.value_or(least);
}

Plan plan(const Request& request, const Values& options) {
    if (options.given(equations) && options.given(resolution))
        fail(ErrorKind::usage, "--generators contradicts --resolution; give one of them");
    const std::size_t k = factors_of(request, options);
    const RegularFraction design = decide(request.count, k, options).design;
    return plan_of_runs(request, design.runs(), k,
                        fmt::format("the fraction 2^({}-{})", k, k - design.basic.size()));
}

Findings findings_of(const KnownFraction& known, bool by_equations, bool ends) {
    const RegularFraction& design = known.design;
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
    const bool complete = known.least && known.bound == known.resolution;
    if (!by_equations) findings.emplace_back("search", complete ? "complete" : "limited");
    return findings;
}

std::unique_ptr<Sequence> make(const Plan& plan, const Values& options, const RunContext&) {
    const KnownFraction known = decide(plan.count, plan.dimension, options);
    const bool ends = options[ends_option];
    return level_sequence(
        plan, level_places(2, ends),
        [design = known.design](std::uint64_t i, std::size_t k) { return design.level(i, k); },
        findings_of(known, options.given(equations), ends));
}

/// Smallest number of runs for which a fraction of this resolution is neither known nor excluded; 0
/// if there is no such number below that of the known fraction.
std::uint64_t fewer_in_doubt(std::size_t factors, const KnownFraction& known, std::size_t asked) {
    for (std::size_t basic = 1; basic < known.design.basic.size(); ++basic)
        if (const auto smaller = known_fraction(factors, basic); smaller && smaller->bound >= asked)
            return smaller->design.runs();
    return 0;
}

std::vector<std::string> notes(const Request& request, const Plan& plan, const Values& options) {
    if (options.given(equations)) return {};
    const std::size_t k = plan.dimension;
    const KnownFraction known = decide(plan.count, k, options);
    const std::string reached = roman_numeral(known.resolution);
    std::vector<std::string> notes;
    if (request.count && known.bound > known.resolution)
        notes.push_back(
            fmt::format("fractional-factorial: resolution {} is the highest that is known for {} "
                        "factors in {} runs; it is open whether {} can be reached",
                        reached, k, plan.count, roman_numeral(known.resolution + 1)));
    const std::size_t asked = asked_resolution(options);
    if (const std::uint64_t fewer = request.count ? 0 : fewer_in_doubt(k, known, asked); fewer > 0)
        notes.push_back(
            fmt::format("fractional-factorial: {} runs are the fewest that are known for {} "
                        "factors at resolution {}; it is open whether {} suffice",
                        plan.count, k, roman_numeral(asked), fewer));
    if (!known.least)
        notes.push_back(
            fmt::format("fractional-factorial: not all fractions of {} factors in {} runs have "
                        "been searched; one of resolution {} with fewer words of {} letters than "
                        "this one may exist",
                        k, plan.count, reached, known.resolution));
    return notes;
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
                       .seeded = false,
                       .levels = true},
            .options = Schema(equations, resolution, ends_option),
            .aliases = {"fracfact"},
            .stream_version = 2,
            .plan = plan,
            .sequence = make,
            .notes = notes};
}

}  // namespace stipple::generators::fractional_factorial
