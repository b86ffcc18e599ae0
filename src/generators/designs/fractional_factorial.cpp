// SPDX-License-Identifier: MIT
//
// Regular fractional factorial design 2^(k-p): k factors of two levels in n = 2^(k-p) runs, a part of
// the full factorial (regular_fraction.hpp). The factors are A, B, ..., H, J, ..., Z, a, ..., without
// I, which stands for the mean. Each p-th part is given by --generators (D=ABC,E=-AB), or is the one
// of least aberration for a count, or with the fewest runs for a resolution:
//
//     III   main effects are aliased with interactions of two factors, but not with each other
//     IV    with those of three; interactions of two factors with each other
//     V     neither with those of two
//
// Shape   n x k, k <= 50; n is a power of two, at most 2^16 where a fraction is looked for. Runs in
//         standard order of the factors that are not generated, the first fastest.
// Promise the words, lengths and aliases in the provenance are complete, for at most 63 words. The
//         search tells whether it left nothing out (search: complete), as up to 16 runs, or gave up
//         after a fixed number of steps with the best that it had.
// Source  G. E. P. Box, J. S. Hunter, Technometrics 3 (1961) 311-351,
//         doi:10.1080/00401706.1961.10489951; A. Fries, W. G. Hunter, Technometrics 22 (1980)
//         601-608, doi:10.1080/00401706.1980.10486210 (aberration).

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/text.hpp"
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

constexpr std::string_view letters = "ABCDEFGHJKLMNOPQRSTUVWXYZabcdefghjklmnopqrstuvwxyz";

std::string name_of(std::uint64_t factors) {
    std::string name;
    for (std::size_t k = 0; k < letters.size(); ++k)
        if ((factors >> k & 1) != 0) name += letters[k];
    return name;
}

std::string roman(std::size_t number) {
    constexpr const char* numerals[] = {"0",  "I",   "II",   "III", "IV", "V",
                                        "VI", "VII", "VIII", "IX",  "X"};
    return number <= 10 ? numerals[number] : std::to_string(number);
}

/// One generator, D=-ABC.
struct Equation {
    std::size_t factor = 0;
    std::uint64_t product = 0;  ///< set of factors
    bool negative = false;
};

Equation parse_equation(std::string_view text) {
    const auto index = [&](char c) {
        const auto at = letters.find(c);
        if (at == std::string_view::npos)
            fail(ErrorKind::usage,
                 "--generators: '{}' in '{}' is no factor; these are A to Z and a to z without I",
                 c, text);
        return at;
    };
    const auto at = text.find('=');
    if (at != 1 || text.size() < 4)
        fail(ErrorKind::usage, "--generators: '{}' is not of the form D=ABC or D=-ABC", text);
    Equation equation{.factor = index(text[0])};
    equation.negative = text[2] == '-';
    for (const char c : text.substr(equation.negative ? 3 : 2))
        equation.product ^= std::uint64_t{1} << index(c);
    return equation;
}

std::vector<Equation> parse_equations(std::string_view text) {
    std::vector<Equation> all;
    for (const auto part : split(text, ','))
        for (const auto word : split(part, ' '))
            if (!word.empty()) all.push_back(parse_equation(word));
    return all;
}

/// The fraction that equations give. @throws Error(usage)
RegularFraction fraction_of(const std::vector<Equation>& equations_given, std::size_t factors) {
    RegularFraction design = full_fraction(factors);
    design.negative.resize(factors);
    for (const Equation& e : equations_given) {
        if (std::erase(design.basic, e.factor) == 0)
            fail(ErrorKind::usage, "--generators: {} is given twice", letters[e.factor]);
        design.negative[e.factor] = e.negative;
    }
    for (std::size_t j = 0; j < design.basic.size(); ++j)
        design.columns[design.basic[j]] = std::uint64_t{1} << j;
    for (const Equation& e : equations_given) {
        std::uint64_t left = e.product;
        std::uint64_t& column = design.columns[e.factor] = 0;
        for (std::size_t j = 0; j < design.basic.size(); ++j)
            if ((e.product >> design.basic[j] & 1) != 0) {
                column |= std::uint64_t{1} << j;
                left &= ~(std::uint64_t{1} << design.basic[j]);
            }
        if (left != 0)
            fail(ErrorKind::usage, "--generators: {}={} has {}, itself a product or no factor",
                 letters[e.factor], name_of(e.product), name_of(left));
    }
    for (std::size_t i = 0; i < factors; ++i) {
        if (design.columns[i] == 0)
            fail(ErrorKind::usage, "--generators: {} would be constant", letters[i]);
        for (std::size_t k = 0; k < i; ++k)
            if (design.columns[i] == design.columns[k])
                fail(ErrorKind::usage, "--generators: {} would be {} or -{} in all runs",
                     letters[i], letters[k], letters[k]);
    }
    return design;
}

std::size_t asked_resolution(const Values& options) {
    return options.given(resolution) ? static_cast<std::size_t>(options[resolution]) : 3;
}

/// @throws Error(usage) for counts that are not the runs of a fraction
FoundFraction for_count(std::uint64_t count, std::size_t factors, const Values& options,
                        const RunContext& run) {
    const std::uint64_t all = factors < 53 ? std::uint64_t{1} << factors : 0;
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
         factors, roman(asked_resolution(options)),
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
             factors, roman(asked_resolution(options)), most_basic_factors);
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
             *request.dimension, letters[least - 1]);
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

/// What a word of the defining relation is equal to: 1 or -1.
const char* sign_of(const RegularFraction& design, std::uint64_t word) {
    bool negative = false;
    for (std::size_t k = 0; k < design.negative.size(); ++k)
        negative ^= design.negative[k] && (word >> k & 1) != 0;
    return negative ? "-" : "";
}

/// D=ABC E=-AB
std::string equations_of(const RegularFraction& design) {
    std::string text;
    for (std::size_t k = 0; k < design.factors(); ++k) {
        if (std::ranges::count(design.basic, k) > 0) continue;
        std::uint64_t product = 0;
        for (std::size_t j = 0; j < design.basic.size(); ++j)
            product |= (design.columns[k] >> j & 1) << design.basic[j];
        const bool negative = !design.negative.empty() && design.negative[k];
        text += fmt::format("{}{}={}{}", text.empty() ? "" : ",", letters[k], negative ? "-" : "",
                            name_of(product));
    }
    return text;
}

/// A=BD=CE; B=AD: with each main effect the shortest that it cannot be told from.
std::string aliases_of(const RegularFraction& design, const std::vector<std::uint64_t>& words) {
    std::vector<std::string> all;
    for (std::size_t k = 0; k < design.factors(); ++k) {
        const std::uint64_t factor = std::uint64_t{1} << k;
        const auto length = [&](std::uint64_t word) { return std::popcount(word ^ factor); };
        const int shortest = length(std::ranges::min(words, {}, length));
        std::string text(1, letters[k]);
        for (const std::uint64_t word : words)
            if (length(word) == shortest)
                text += fmt::format("={}{}", sign_of(design, word), name_of(word ^ factor));
        all.push_back(text);
    }
    return join(all, "; ");
}

Findings findings_of(const FoundFraction& found, bool searched, bool ends) {
    const RegularFraction& design = *found.design;
    Findings findings{{"coded_bounds", coded_range(2, ends)}};
    const WordLengths lengths = word_lengths(design);
    const std::size_t least = resolution_of(lengths);
    findings.emplace_back("resolution", least == 0 ? "full" : roman(least));
    if (least == 0) return findings;
    findings.emplace_back("generators", equations_of(design));
    std::string pattern;
    for (std::size_t t = least; t < lengths.size(); ++t)
        if (lengths[t] > 0)
            pattern += fmt::format("{}{} of {}", pattern.empty() ? "" : ", ", lengths[t], t);
    findings.emplace_back("word_lengths", pattern);
    if (design.factors() - design.basic.size() <= 6) {
        const auto words = defining_words(design);
        std::string relation = "I";
        for (const std::uint64_t word : words)
            relation += fmt::format("={}{}", sign_of(design, word), name_of(word));
        findings.emplace_back("defining_relation", relation);
        findings.emplace_back("aliases", aliases_of(design, words));
    }
    if (searched) findings.emplace_back("search", found.complete ? "complete" : "limited");
    return findings;
}

std::unique_ptr<Sequence> make(const Plan& plan, const Values& options, const RunContext& run) {
    const FoundFraction found = decide(plan.count, plan.dimension, options, run);
    const bool ends = options[ends_option];
    return level_sequence(
        plan.dimension, level_places(2, ends),
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
            .related = {"doe", "experiment", "fraction", "screening", "fracfact", "resolution",
                        "minimum-aberration", "alias", "confounding"},
            .traits = {.max_dimension = letters.size(), .prefix = false, .seeded = false},
            .options = Schema(equations, resolution, ends_option),
            .aliases = {"fracfact"},
            .plan = plan,
            .sequence = make};
}

}  // namespace stipple::generators::fractional_factorial
