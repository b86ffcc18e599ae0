// SPDX-License-Identifier: MIT
//
// Rank-1 lattice of n points with generating vector z: point i = 0, ..., n - 1 is
//
//     x_k = (i z_k mod n) / n.
//
// The vector is found by one of four rules:
//
//     cbc        component by component, each minimising the worst-case error in the weighted
//                Korobov space of smoothness 2 (component_by_component.hpp); no component repeats
//                until all candidates are used;
//     korobov    (1, a, a^2, ...) mod n with a given multiplier a, or the best one by that error;
//     fibonacci  (1, F_(k-1)) for n = F_k, the best vector in two dimensions;
//     vector     given.
//
// The weights of the coordinates j = 1, 2, ... are given, or are j^-decay.
//
// Shape   n x d; n <= 2^53, and n <= 2^24 if a rule searches. fibonacci: d <= 2.
// Cost    O(n d): a division each. cbc at d = 100: 3 s for n = 2^20, 7 s for the next lower prime.
// Promise every coordinate is correctly rounded, and below 1. The points are closed under addition
//         modulo 1. A rule gives the same vector on every machine.
// Source  I. H. Sloan, S. Joe, Lattice Methods for Multiple Integration, Oxford 1994; cbc:
//         D. Nuyens, R. Cools, Math. Comp. 75 (2006) 903-920, doi:10.1090/S0025-5718-06-01785-6;
//         korobov: N. M. Korobov, Dokl. Akad. Nauk SSSR 124 (1959) 1207-1210.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <unordered_map>
#include <utility>

#include "core/error.hpp"
#include "core/machine/wide.hpp"
#include "generators/generator.hpp"
#include "generators/lattices/component_by_component.hpp"
#include "generators/lattices/lattice_options.hpp"
#include "math/arithmetic/ratio.hpp"

namespace stipple::generators::rank1_lattice {
namespace {

constexpr Param<Choice> rule{
    .name = "rule",
    .fallback = "cbc",
    .choices = "cbc|korobov|fibonacci|vector",
    .help = "Source of the generating vector; a given vector or multiplier implies its rule"};
constexpr Param<std::int64_t> multiplier{.name = "multiplier",
                                         .low = 1,
                                         .high = std::int64_t{1} << 53,
                                         .optional = true,
                                         .help =
                                             "Multiplier a of the rule korobov, z_k = a^k; "
                                             "default: the best of those that --effort tries"};
constexpr Param<double> effort{.name = "effort",
                               .fallback = 1,
                               .low = 1e-3,
                               .high = 1e9,
                               .help =
                                   "Multipliers that the rule korobov tries, as a multiple of the "
                                   "default: about a second's work"};
constexpr Param<Numbers> vector{{.name = "vector",
                                 .help = "Generating vector, such as 1,182667,469891; gives the "
                                         "dimension, or has more numbers than --dimension"}};
/// Number of coordinates updated together, so that no update waits for the one before.
constexpr std::size_t some_numbers = 64;

/// Sets x = residues / n, and adds the step to the residues, modulo n. All numbers are integers up
/// to 2^53, so only the division rounds.
/// @param back n - step
STIPPLE_WIDE void advance(const double* back, double n, std::size_t count, double* residues,
                          double* x) {
    for (std::size_t k = 0; k < count; ++k) {
        x[k] = residues[k] / n;
        const double next = residues[k] - back[k];
        residues[k] = next < 0 ? next + n : next;
    }
}

/// i z mod n.
double multiple(std::uint64_t i, std::uint64_t z, std::uint64_t n) {
    return static_cast<double>(static_cast<std::uint64_t>(Wide{i} * z % n));
}

/// Whether the rule korobov has to search for a multiplier.
bool searches_multiplier(const std::string& chosen, const Values& options) {
    return chosen == "korobov" && !options.given(multiplier);
}

/// Number of multipliers to try, at least one.
std::uint64_t tries_of(const Plan& plan, const Values& options) {
    constexpr double coordinates_a_second = 0x1p29;
    const double size = static_cast<double>(plan.count) * static_cast<double>(plan.dimension);
    const double tries = std::min(options[effort] * coordinates_a_second / size, 0x1p53);
    return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(tries));
}

/// Rule in use: --rule, or the rule implied by a given vector or multiplier.
std::string rule_of(const Values& options) {
    if (options.given(rule)) return options[rule];
    if (options.given(vector) || options.given(vector_file)) return "vector";
    return options.given(multiplier) ? "korobov" : options[rule];
}

void refuse_contradictions(const Values& options, const std::string& chosen) {
    const bool searches = chosen == "cbc" || searches_multiplier(chosen, options);
    const auto only_for = [&](std::string_view name, bool given, bool fits, std::string_view what) {
        if (given && !fits)
            fail(ErrorKind::usage, "--{} applies to {} only; the rule here is {}", name, what,
                 chosen);
    };
    only_for("multiplier", options.given(multiplier), chosen == "korobov", "the rule korobov");
    only_for("effort", options.given(effort), searches_multiplier(chosen, options),
             "korobov's search for a multiplier");
    only_for("vector", options.given(vector), chosen == "vector", "the rule vector");
    only_for("vector-file", options.given(vector_file), chosen == "vector", "the rule vector");
    check_weights(options, searches, "the searches cbc and korobov", chosen);
    if (chosen == "vector" && options.given(vector) == options.given(vector_file))
        fail(ErrorKind::usage,
             "--rule: vector needs one vector; give either --vector or --vector-file");
}

/// F_(k-1) for n = F_k. @throws Error(usage) if n is not a Fibonacci number
std::uint64_t fibonacci_before(std::uint64_t n) {
    std::uint64_t below = 1;
    std::uint64_t above = 1;
    while (above < n) below = std::exchange(above, above + below);
    if (above == n) return below;
    refuse_count(n, "a Fibonacci number", "the rule fibonacci", below, above);
}

Plan plan(const Request& request, const Values& options) {
    const std::string chosen = rule_of(options);
    refuse_contradictions(options, chosen);
    const VectorFile file = vector_in_file(options, false);
    const std::size_t numbers = std::max(file.vector.size(), options[vector].size());
    const std::uint64_t count = chosen == "fibonacci" ? 987 : 1024;
    const Plan plan =
        default_plan(request, file.points > 0 ? file.points : count, numbers > 0 ? numbers : 2);
    if (chosen == "fibonacci") {
        fibonacci_before(plan.count);
        if (plan.dimension > 2)
            fail(ErrorKind::usage, "--dimension: {} is outside [1, 2], the range of fibonacci",
                 plan.dimension);
    }
    if (file.points % plan.count != 0)
        fail_with_hint(ErrorKind::usage, "--vector takes a vector for any count",
                       "--count: {} holds a lattice of {} points; {} does not divide this number",
                       options[vector_file], file.points, plan.count);
    const bool searches = chosen == "cbc" || searches_multiplier(chosen, options);
    if (searches && plan.count > largest_searched_lattice)
        fail_with_hint(ErrorKind::usage, "give a vector, or a multiplier for korobov",
                       "--count: {} is outside [1, {}], the range of the search for a vector",
                       plan.count, largest_searched_lattice);
    return plan;
}

std::vector<std::uint64_t> given_vector(const Values& options, std::size_t dimension) {
    return given_components(options, vector_in_file(options, false), vector, dimension, 0, 0x1p53,
                            "a whole number in [0, 2^53]");
}

std::vector<std::uint64_t> vector_of(const Plan& plan, const Values& options,
                                     const RunContext& run) {
    const std::string chosen = rule_of(options);
    const std::size_t d = plan.dimension;
    if (chosen == "vector") return given_vector(options, d);
    if (chosen == "fibonacci") {
        std::vector<std::uint64_t> pair{1, fibonacci_before(plan.count)};
        pair.resize(d);
        return pair;
    }
    if (chosen == "korobov" && options.given(multiplier))
        return powers_modulo(static_cast<std::uint64_t>(options[multiplier]), d, plan.count);
    const std::vector<double> weight = weights_of(options, d);
    if (chosen == "korobov")
        return powers_modulo(korobov_multiplier(plan.count, weight, tries_of(plan, options), run),
                             d, plan.count);
    return component_by_component(plan.count, weight, run);
}

/// Points i z / n modulo 1.
Sequence::Fill multiples(std::uint64_t n, const std::vector<std::uint64_t>& z) {
    const std::size_t d = z.size();
    const std::size_t points = (some_numbers + d - 1) / d;  // number of points made at a time
    std::vector<double> back;  // n - (points * z mod n) for each coordinate of these points
    for (std::size_t m = 0; m < points * d; ++m)
        back.push_back(static_cast<double>(n) - multiple(points, z[m % d], n));
    return [=](std::uint64_t first, std::span<double> rows) {
        std::vector<double> residues;
        for (std::size_t m = 0; m < std::min(back.size(), rows.size()); ++m)
            residues.push_back(multiple(first + m / d, z[m % d], n));
        for (std::size_t at = 0; at < rows.size(); at += back.size())
            advance(back.data(), static_cast<double>(n), std::min(back.size(), rows.size() - at),
                    residues.data(), rows.data() + at);
    };
}

/// Adds a note that names coordinates which are equal to each other in every point.
void note_repeated(std::span<const std::uint64_t> z, std::uint64_t n, const RunContext& run) {
    std::unordered_map<std::uint64_t, std::size_t> seen;
    std::string first;
    std::size_t repeated = 0;
    for (std::size_t k = 0; k < z.size() && n > 1; ++k) {
        const auto [there, is_new] = seen.try_emplace(z[k] % n, k);
        if (!is_new && repeated++ == 0)
            first = fmt::format("coordinate {} equals coordinate {}", k + 1, there->second + 1);
    }
    if (repeated == 0) return;
    const std::string others =
        repeated > 1 ? fmt::format(", and {} more are repeated", repeated - 1) : "";
    run.notify(
        fmt::format("rank1-lattice: {}{}: the {} numbers of the vector have {} different values",
                    first, others, z.size(), seen.size()));
}

std::unique_ptr<Sequence> make(const Plan& plan, const Values& options, const RunContext& run) {
    const auto z = vector_of(plan, options, run);
    note_repeated(z, plan.count, run);
    const std::string chosen = rule_of(options);
    Sequence::Found found;
    if (chosen == "cbc" || searches_multiplier(chosen, options))
        found = [n = plan.count, z, weight = weights_of(options, plan.dimension)] {
            return found_vector(z, squared_lattice_error(n, z, weight));
        };
    auto points = std::make_unique<Sequence>(multiples(plan.count, z), true, std::move(found));
    points->side_files = vector_files(options, {.vector = z, .points = plan.count});
    return points;
}

/// The generating vector, modulo the number of points.
std::vector<Constants> constants(const Plan& plan, const Values& options, const RunContext& run) {
    Constants z{"z", vector_of(plan, options, run)};
    for (std::uint64_t& number : z.numbers) number %= plan.count;
    z.numbers.resize(plan.dimension);
    return {z};
}

std::vector<std::string> notes(const Request& /*request*/, const Plan& plan,
                               const Values& options) {
    const std::string chosen = rule_of(options);
    if (chosen == "vector") {
        std::uint64_t divisor = plan.count;
        for (const std::uint64_t z : given_vector(options, plan.dimension))
            divisor = std::gcd(divisor, z);
        if (divisor == 1) return {};
        return {
            fmt::format("rank1-lattice: {0} divides the number of points and all numbers of the "
                        "vector: every point occurs {0} times",
                        divisor)};
    }
    const std::uint64_t tries = tries_of(plan, options);
    const std::uint64_t range = korobov_range(plan.count);
    if (!searches_multiplier(chosen, options) || tries >= range) return {};
    const double all = static_cast<double>(range) / static_cast<double>(tries);
    return {fmt::format(
        "rank1-lattice: {} of the multipliers up to {} are tried; --effort {:.0f} tries all", tries,
        range, std::ceil(options[effort] * all))};
}

}  // namespace

Generator unit() {
    return {.name = "rank1-lattice",
            .summary =
                "Rank-1 lattice: multiples of one vector modulo 1; Fibonacci, Korobov, "
                "component by component, or given",
            .source = "Nuyens & Cools 2006, doi:10.1090/S0025-5718-06-01785-6; Sloan & Joe 1994",
            .related = {"korobov", "fibonacci", "good-lattice-points", "cbc", "lattice-rule"},
            .traits = {.prefix = false, .seeded = false},
            .options = Schema(rule, multiplier, effort, vector, vector_file, product_weights,
                              weight_decay, vector_output, vector_format),
            .aliases = {"lattice", "rank-1-lattice"},
            .writes = {std::string(vector_output.name), std::string(vector_format.name)},
            .stream_version = 3,
            .plan = plan,
            .sequence = make,
            .settle = [](Values& options) { options.put(rule.name, rule_of(options), false); },
            .notes = notes,
            .constants = constants};
}

}  // namespace stipple::generators::rank1_lattice
