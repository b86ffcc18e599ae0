// SPDX-License-Identifier: MIT
//
// Regular fractional factorial design 2^(k-p): k factors of two levels in n = 2^(k-p) runs of the
// full factorial (regular_fraction.hpp). The factors are A, B, ..., Z, a, ..., z, without I and i,
// because I denotes the mean. The fraction is given by --generators (D=ABC,E=-AB, with the defining
// relation I=ABCD=-ABE=-CDE) or taken from a table, fractions.txt: a count selects the highest
// known resolution; a resolution selects the fewest runs. The least aberration breaks ties.
//
//     III   main effects are aliased with interactions of two factors, but not with each other
//     IV    main effects are aliased with interactions of three factors; interactions of two
//           factors are aliased with each other
//     V     main effects and interactions of two factors are not aliased with each other
//
// Shape   n x k, 2 <= k <= 50; n is a power of two, at most 2^16 for fractions of the table.
//         Runs are in standard order of the factors without a generator, the first fastest.
// Promise the provenance has the resolution and the number of words of each length; for p <= 6 also
//         the words and the shortest aliases of main effects; for fractions of the table whether a
//         better one with as many runs is excluded (search: complete) or may exist (limited).
// Source  G. E. P. Box, J. S. Hunter, Technometrics 3 (1961) 311-351,
//         doi:10.1080/00401706.1961.10489951; A. Fries, W. G. Hunter, Technometrics 22 (1980)
//         601-608, doi:10.1080/00401706.1980.10486210 (aberration).

#include <algorithm>
#include <bit>

#include "core/error.hpp"
#include "core/text.hpp"
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

constexpr std::string_view letters = "ABCDEFGHJKLMNOPQRSTUVWXYZabcdefghjklmnopqrstuvwxyz";

std::string name_of(std::uint64_t factors) {
    std::string name;
    for (std::size_t k = 0; k < letters.size(); ++k)
        if ((factors >> k & 1) != 0) name += letters[k];
    return name;
}

/// One generator equation such as D=-ABC.
struct Equation {
    std::size_t factor = 0;
    std::uint64_t product = 0;  ///< factors of the product, one bit each
    bool negative = false;
};

Equation parse_equation(std::string_view text) {
    const auto index = [&](char c) {
        const auto at = letters.find(c);
        if (at == std::string_view::npos)
            fail(ErrorKind::usage,
                 "--generators: '{}' in '{}' is not a factor; expected A to Z, except I, or a to z",
                 c, text);
        return at;
    };
    const bool negative = text.size() > 2 && text[2] == '-';
    if (text.find('=') != 1 || text.size() < (negative ? 4 : 3))
        fail(ErrorKind::usage, "--generators: '{}' is not of the form D=ABC or D=-ABC", text);
    Equation equation{.factor = index(text[0]), .product = 0, .negative = negative};
    for (const char c : text.substr(negative ? 3 : 2))
        equation.product ^= std::uint64_t{1} << index(c);
    return equation;
}

/// Checks that no column is constant, equal to or opposite to another. @throws Error(usage)
void require_different_columns(const RegularFraction& design) {
    for (std::size_t i = 0; i < design.factors(); ++i) {
        if (design.columns[i] == 0)
            fail(ErrorKind::usage, "--generators: {} would be constant", letters[i]);
        for (std::size_t k = 0; k < i; ++k)
            if (design.columns[i] == design.columns[k])
                fail(ErrorKind::usage, "--generators: {} would be {} or -{} in all runs",
                     letters[i], letters[k], letters[k]);
    }
}

/// Sign of a word of the defining relation: "-" if the product of its factors is -1, else "".
const char* sign_of(const RegularFraction& design, std::uint64_t word) {
    bool negative = false;
    for (std::size_t k = 0; k < design.factors(); ++k)
        negative ^= design.reversed(k) && (word >> k & 1) != 0;
    return negative ? "-" : "";
}

/// Parses generators separated by commas or spaces. @throws Error(usage)
std::vector<Equation> parse_equations(std::string_view text) {
    std::vector<Equation> all;
    for (const auto part : split(text, ','))
        for (const auto word : split(part, ' '))
            if (!word.empty()) all.push_back(parse_equation(word));
    return all;
}

/// Fraction defined by generators. @throws Error(usage) if these contradict each other or make two
/// columns equal
RegularFraction fraction_of(const std::vector<Equation>& given, std::size_t factors) {
    RegularFraction design = full_fraction(factors);
    design.negative.resize(factors);
    for (const Equation& e : given) {
        if (std::erase(design.basic, e.factor) == 0)
            fail(ErrorKind::usage, "--generators: {} is given twice", letters[e.factor]);
        design.negative[e.factor] = e.negative;
    }
    for (std::size_t j = 0; j < design.basic.size(); ++j)
        design.columns[design.basic[j]] = std::uint64_t{1} << j;
    for (const Equation& e : given) {
        design.columns[e.factor] = 0;
        for (std::size_t j = 0; j < design.basic.size(); ++j)
            design.columns[e.factor] |= (e.product >> design.basic[j] & 1) << j;
        if (const auto left = e.product & ~design.product(e.factor); left != 0)
            fail(ErrorKind::usage,
                 "--generators: {}={} contains {}, which is a product itself or not a factor",
                 letters[e.factor], name_of(e.product), name_of(left));
    }
    require_different_columns(design);
    return design;
}

/// Generators as text: "D=ABC,E=-AB".
std::string equations_of(const RegularFraction& design) {
    std::string text;
    for (std::size_t k = 0; k < design.factors(); ++k) {
        if (std::ranges::count(design.basic, k) > 0) continue;
        text += fmt::format("{}{}={}{}", text.empty() ? "" : ",", letters[k],
                            design.reversed(k) ? "-" : "", name_of(design.product(k)));
    }
    return text;
}

/// Defining relation as text: "I=ABCD=-ABE=-CDE".
std::string relation_of(const RegularFraction& design, const std::vector<std::uint64_t>& words) {
    std::string relation = "I";
    for (const std::uint64_t word : words)
        relation += fmt::format("={}{}", sign_of(design, word), name_of(word));
    return relation;
}

/// Each main effect with its shortest aliases: "A=BD=CE; B=AD".
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

/// Numbers of words by length: "7 of 3, 7 of 4, 1 of 7".
std::string lengths_text(const WordLengths& lengths) {
    std::vector<std::string> parts;
    for (std::size_t t = 1; t < lengths.size(); ++t)
        if (lengths[t] > 0) parts.push_back(fmt::format("{} of {}", lengths[t], t));
    return join(parts, ", ");
}

/// Roman numeral up to ten (III for 3), Arabic digits beyond.
std::string roman_numeral(std::size_t number) {
    constexpr const char* numerals[] = {"0",  "I",   "II",   "III", "IV", "V",
                                        "VI", "VII", "VIII", "IX",  "X"};
    return number <= 10 ? numerals[number] : std::to_string(number);
}

std::size_t asked_resolution(const Values& options) {
    return options.given(resolution) ? static_cast<std::size_t>(options[resolution]) : 3;
}

/// Fraction with `count` runs. @throws Error(usage) if no fraction has this count
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
    fail(ErrorKind::usage, "--count: {} runs are {} for {} factors at resolution {}{}", count,
         known && known->bound >= asked ? "not known to suffice" : "too few", factors,
         roman_numeral(asked), others);
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

/// Dimension; by default up to the last factor in the equations, or 3. @throws Error(usage)
std::size_t factors_of(const Request& request, const Values& options) {
    if (!options.given(equations)) return request.dimension.value_or(3);
    std::uint64_t named = 0;
    for (const Equation& e : parse_equations(options[equations]))
        named |= e.product | std::uint64_t{1} << e.factor;
    const auto least = static_cast<std::size_t>(std::bit_width(named));
    if (request.dimension.value_or(least) < least)
        fail(ErrorKind::usage, "--dimension: {} factors are too few; --generators names factor {}",
             *request.dimension, letters[least - 1]);
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

/// Smallest number of runs below that of `known` for which a fraction of resolution `asked` has not
/// been excluded; 0 if all are excluded.
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
            .traits = level_traits(2, letters.size()),
            .options = Schema(equations, resolution, ends_option),
            .aliases = {"fracfact"},
            .stream_version = 2,
            .plan = plan,
            .sequence = make,
            .notes = notes};
}

}  // namespace stipple::generators::fractional_factorial
