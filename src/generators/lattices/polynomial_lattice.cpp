// SPDX-License-Identifier: MIT
//
// Polynomial lattice in base 2. With polynomials over the field of two elements, the modulus p of
// degree m and the vector q of degrees below m, coordinate k of point i = sum_j i_j 2^j is
//
//     x_k = sum_(r = 1)^m u_r 2^-r    where, up to a polynomial,
//     u_1 x^-1 + u_2 x^-2 + ... = i(x) q_k(x) / p(x),    i(x) = sum_j i_j x^j:
//
// a digital net, whose matrices have u_(r + j + 1) of q_k / p in row r and column j. Polynomials
// are written as their values at x = 2; x^3 + x + 1 is 11. The vector is given, or found component
// by component, each minimising the worst-case error (polynomial_search.hpp).
//
// Shape   n x d; without a modulus, p is the smallest irreducible one with 2^m >= n. n <= 2^52, and
//         n <= 2^22 if the vector is searched.
// Cost    O(n d), half a nanosecond a coordinate. cbc: 6 s at n = 2^20, d = 100, and up to five
//         times as long a point where 2^m - 1 is a prime, as for m = 13, 17, 19.
// Promise unscrambled coordinates are exact multiples of 2^-m. All 2^m points are closed under XOR
//         of their digits; with p irreducible each of their coordinates takes every value once. The
//         search finds the same vector on every machine.
// Source  H. Niederreiter, Random Number Generation and Quasi-Monte Carlo Methods, SIAM 1992,
//         section 4.4, doi:10.1137/1.9781611970081; cbc: J. Baldeaux et al., Numer. Algorithms 59
//         (2012) 403-431, doi:10.1007/s11075-011-9497-y.

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "core/error.hpp"
#include "generators/generator.hpp"
#include "generators/lattices/lattice_options.hpp"
#include "generators/lattices/polynomial_search.hpp"
#include "generators/net_sequence.hpp"
#include "math/digital/gf2.hpp"

namespace stipple::generators::polynomial_lattice {
namespace {

constexpr int largest_degree = 52;

constexpr Param<Choice> rule{
    .name = "rule",
    .fallback = "cbc",
    .choices = "cbc|vector",
    .help = "Source of the generating vector; a given vector implies the rule vector"};
constexpr Param<std::int64_t> modulus_option{
    .name = "modulus",
    .low = 2,
    .high = (std::int64_t{1} << (largest_degree + 1)) - 1,
    .optional = true,
    .help =
        "Modulus, as the polynomial's value at x = 2: 11 is x^3 + x + 1; default: the smallest "
        "irreducible one for the count"};
constexpr Param<Numbers> vector_option{
    {.name = "vector",
     .help = "Generating vector of polynomials, written like the modulus; gives the dimension, or "
             "has more of them than --dimension"}};

bool gives_vector(const Values& options) {
    return options.given(vector_option) || options.given(vector_file);
}

bool searches(const Values& options) { return options[rule] == "cbc" && !gives_vector(options); }

void refuse_contradictions(const Values& options) {
    if (options[rule] == "vector" && !gives_vector(options))
        fail(ErrorKind::usage, "--rule: vector needs a vector; give --vector or --vector-file");
    if (options.given(vector_option) && options.given(vector_file))
        fail(ErrorKind::usage, "--vector contradicts --vector-file; give one of them");
    if (options.given(rule) && options[rule] == "cbc" && gives_vector(options))
        fail(ErrorKind::usage, "--{} applies to the rule vector only; the rule here is cbc",
             options.given(vector_file) ? vector_file.name : vector_option.name);
    check_weights(options, searches(options), "the rule cbc", "vector");
}

std::uint64_t modulus_for(std::uint64_t count, const Values& options) {
    const std::uint64_t modulus = vector_in_file(options, true).modulus;
    if (modulus > 0 && options.given(modulus_option))
        fail(ErrorKind::usage, "--modulus: {} contains its own, {}", options[vector_file], modulus);
    if (modulus > 0) return modulus;
    if (options.given(modulus_option)) return static_cast<std::uint64_t>(options[modulus_option]);
    const int m = std::max(1, static_cast<int>(std::bit_width(count - 1)));
    if (m > largest_degree)
        fail(ErrorKind::usage, "--count: {} is outside [1, 2^{}], the range of polynomial-lattice",
             count, largest_degree);
    return gf2::smallest_irreducible(m);
}

void check_search(std::uint64_t count, std::uint64_t modulus) {
    if (gf2::degree(modulus) > largest_searched_degree)
        fail_with_hint(ErrorKind::usage, "give a --vector",
                       "--count: cbc searches lattices of up to 2^{} points; {} points with "
                       "modulus {} belong to one of 2^{}",
                       largest_searched_degree, count, modulus, gf2::degree(modulus));
    if (!gf2::is_irreducible(modulus))
        fail_with_hint(ErrorKind::usage, "give a --vector, which takes any modulus",
                       "--modulus: {} is not irreducible, as cbc needs; {} is the smallest of "
                       "degree {} that is",
                       modulus, gf2::smallest_irreducible(gf2::degree(modulus)),
                       gf2::degree(modulus));
}

Plan plan(const Request& request, const Values& options) {
    refuse_contradictions(options);
    const VectorFile file = vector_in_file(options, true);
    const std::size_t numbers =
        std::max(file.vector.size() / file.interlaced, options[vector_option].size());
    const Plan decided =
        default_plan(request, file.points > 0 ? file.points : 1024, numbers > 0 ? numbers : 2);
    if (file.interlaced > 1 && decided.dimension > numbers)
        fail(ErrorKind::usage, "--dimension: {} is outside [1, {}], the dimensions in {}",
             decided.dimension, numbers, options[vector_file]);
    const std::uint64_t modulus = modulus_for(decided.count, options);
    const int m = gf2::degree(modulus);
    if (decided.count > std::uint64_t{1} << m)
        fail(ErrorKind::usage, "--count: {} is above {} = 2^{}, the number of points of modulus {}",
             decided.count, std::uint64_t{1} << m, m, modulus);
    if (searches(options)) check_search(decided.count, modulus);
    return decided;
}

std::vector<std::uint64_t> given_vector(const Values& options, const VectorFile& file,
                                        std::size_t components, int m) {
    const std::uint64_t most = (std::uint64_t{1} << m) - 1;
    return given_components(options, file, vector_option, components, 1, static_cast<double>(most),
                            fmt::format("a polynomial in [1, {}]", most));
}

/// Entry (r, c) is digit r + c + 1 of q / modulus.
DigitMatrix hankel(std::uint64_t q, std::uint64_t modulus) {
    const auto m = static_cast<std::size_t>(gf2::degree(modulus));
    DigitMatrix matrix(m, m);
    for (std::size_t at = 0; at + 1 < 2 * m; ++at) {
        q <<= 1;
        const auto digit = static_cast<std::uint32_t>(q >> m);
        if (digit != 0) q ^= modulus;
        for (std::size_t r = at < m ? 0 : at - m + 1; r <= std::min(at, m - 1); ++r)
            matrix.at(r, at - r) = digit;
    }
    return matrix;
}

std::unique_ptr<Sequence> make(const Plan& decided, const Values& options, const RunContext& run) {
    const std::uint64_t modulus = modulus_for(decided.count, options);
    const VectorFile file = vector_in_file(options, true);
    const std::vector<std::uint64_t> vector =
        searches(options)
            ? polynomial_components(modulus, weights_of(options, decided.dimension), run)
            : given_vector(options, file, decided.dimension * file.interlaced,
                           gf2::degree(modulus));
    std::vector<DigitMatrix> matrices;
    for (const std::uint64_t q : vector) matrices.push_back(hankel(q, modulus));
    auto points =
        net_sequence(2, interlace(std::move(matrices), file.interlaced), decided, options);
    points->side_files = vector_files(
        options, {.vector = vector, .interlaced = file.interlaced, .modulus = modulus});
    if (searches(options))
        points->set_found([=, weights = weights_of(options, decided.dimension)] {
            const bool all = decided.count == std::uint64_t{1} << gf2::degree(modulus);
            return found_vector(vector, squared_polynomial_error(modulus, vector, weights),
                                all ? "squared_error" : "squared_error_of_all_points");
        });
    return points;
}

}  // namespace

Generator unit() {
    return {.name = "polynomial-lattice",
            .summary = "Polynomial lattice in base 2, with a given or a searched vector",
            .source =
                "Niederreiter 1992, doi:10.1137/1.9781611970081; "
                "Baldeaux et al. 2012, doi:10.1007/s11075-011-9497-y",
            .related = {"cbc"},
            .traits = {.prefix = false},
            .options = Schema(rule, modulus_option, vector_option, vector_file, product_weights,
                              weight_decay, vector_output, vector_format, binary_scramble),
            .writes = {std::string(vector_output.name), std::string(vector_format.name)},
            .stream_version = 3,
            .plan = plan,
            .sequence = make,
            .settle =
                [](Values& options) {
                    if (!searches(options)) options.put(rule.name, std::string("vector"), false);
                },
            .uses_seed = binary_uses_seed,
            .notes = binary_notes};
}

}  // namespace stipple::generators::polynomial_lattice
