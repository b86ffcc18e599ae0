// SPDX-License-Identifier: MIT
//
// Halton sequence. Coordinate k of point i is the radical inverse of i in the k-th prime b:
//
//     phi_b(i) = sum_j a_j b^(-j-1)    where    i = sum_j a_j b^j,  0 <= a_j < b.
//
// Permutations of the digits break the correlation of the coordinates: Faure's, or the reversal of
// all digits except 0, which are the same for all positions j of one base; random ones, one for
// each position; or Owen's nested ones, one for each position and choice of the digits before it.
//
// Shape   n x d for d <= 1000; indices below 2^53.
// Cost    O(n d): a table of reversed low digits makes it one division a coordinate. Owen's takes
//         O(b) for every digit beyond the table. With a leap, O(log_b i) a coordinate.
// Promise without or with fixed permutations, every coordinate is correctly rounded; with random
//         ones, within 2^-52. All are below 1. Any b_1^m_1 * ... * b_d^m_d consecutive points, also
//         of a leaped sequence, meet every box with sides b_k^-m_k exactly once. Under random and
//         nested permutations each point is uniformly distributed.
// Beware  dimensions above 10 are strongly correlated at small counts, unless permuted.
// Source  J. H. Halton, Numer. Math. 2 (1960) 84-90, doi:10.1007/BF01386213; leap: L. Kocis,
//         W. J. Whiten, ACM Trans. Math. Softw. 23 (1997) 266-294, doi:10.1145/264029.264064;
//         reverse: B. Vandewoestyne, R. Cools, J. Comput. Appl. Math. 189 (2006) 341-361; other
//         permutations: math/digital/digit_permutations.hpp, math/digital/base_scramble.hpp.

#include <string_view>
#include <variant>

#include "core/error.hpp"
#include "generators/generator.hpp"
#include "math/combinatorics/primes.hpp"
#include "math/digital/base_scramble.hpp"
#include "math/digital/digit_permutations.hpp"
#include "math/digital/radical_inverse.hpp"

namespace stipple::generators::halton {
namespace {

constexpr Param<Choice> scramble{
    .name = "scramble",
    .fallback = "none",
    .choices = "none|faure|reverse|permutation|owen",
    .help =
        "Permutations of the digits. faure: Faure's fixed ones; reverse: a becomes b - a, except "
        "0; permutation: a random one per base and position; owen: a random one per prefix of "
        "digits (nested)"};
constexpr Param<std::int64_t> leap{
    .name = "leap",
    .fallback = 1,
    .low = 1,
    .high = std::int64_t{1} << 53,
    .help =
        "Take every leap-th point of the sequence, from the first on (Kocis and Whiten's L; "
        "MATLAB's Leap is one less); must not share a factor with a base"};

/// One coordinate of the sequence.
using Inverse = std::variant<RadicalInverse, PermutedInverse, BaseOwen>;

Inverse inverse(std::size_t k, std::string_view how, std::uint64_t seed) {
    const std::uint32_t b = primes[k];
    if (how == "faure") return RadicalInverse(b, faure_permutation(b));
    if (how == "reverse") {
        std::vector<std::uint32_t> digits(b);
        for (std::uint32_t a = 1; a < b; ++a) digits[a] = b - a;
        return RadicalInverse(b, digits);
    }
    if (how == "permutation") return PermutedInverse(b, Rng(seed, k));
    if (how == "owen") return BaseOwen(seed, k, b);
    return RadicalInverse(b);
}

Plan plan(const Request& request, const Values& options) {
    const Plan plan = default_plan(request);
    const auto step = static_cast<std::uint64_t>(options[leap]);
    for (std::size_t k = 0; k < std::min(plan.dimension, primes.size()); ++k)
        if (step % primes[k] == 0)
            fail_with_hint(ErrorKind::usage, "choose a prime that is not among the bases",
                           "--leap: {} is a multiple of {}, the base of coordinate {}, which would "
                           "not fill [0, 1)",
                           step, primes[k], k + 1);
    constexpr std::uint64_t end = std::uint64_t{1} << 53;
    const bool there = request.start < end && plan.count > 0 && plan.count <= end - request.start;
    if (there && request.start + plan.count - 1 > (end - 1) / step)
        fail(ErrorKind::usage, "--leap: {} points from {} on, at steps of {}, go beyond index {}",
             plan.count, request.start, step, end - 1);
    return plan;
}

std::unique_ptr<Sequence> make(const Plan& plan, const Values& options, const RunContext&) {
    std::vector<Inverse> inverses;
    for (std::size_t k = 0; k < plan.dimension; ++k)
        inverses.push_back(inverse(k, options[scramble], plan.seed));
    const auto step = static_cast<std::uint64_t>(options[leap]);
    return sequence_of(
        [inverses = std::move(inverses), step](std::uint64_t first, std::span<double> rows) {
            const std::size_t d = inverses.size();
            const std::size_t count = rows.size() / d;
            const auto fill = [&](std::size_t k, const auto& one) {
                if (step == 1) return one.fill(first, count, rows.data() + k, d);
                for (std::size_t j = 0; j < count; ++j)
                    rows[j * d + k] = one.of((first + j) * step);
            };
            for (std::size_t k = 0; k < d; ++k)
                std::visit([&](const auto& one) { fill(k, one); }, inverses[k]);
        });
}

/// Faure's permutations of all bases, one after the other, and the index at which each begins.
std::vector<Constants> constants(const Plan& plan, const Values&, const RunContext&) {
    Constants images{"images", {}, true};
    Constants begins{"begins", {}, true};
    for (std::size_t k = 0; k < plan.dimension; ++k) {
        begins.numbers.push_back(images.numbers.size());
        for (const std::uint32_t image : faure_permutation(primes[k]))
            images.numbers.push_back(image);
    }
    return {images, begins};
}

bool random_digits(const Values& options) {
    return options[scramble] == "permutation" || options[scramble] == "owen";
}

}  // namespace

Generator unit() {
    return {
        .name = "halton",
        .summary = "Halton sequence: radical inverses in the first primes, optionally scrambled",
        .source = "Halton 1960, doi:10.1007/BF01386213",
        .related = {"generalized-halton", "leaped-halton", "quasi-random", "low-discrepancy"},
        .traits = {.max_dimension = primes.size()},
        .options = Schema(scramble, leap),
        .stream_version = 2,
        .plan = plan,
        .sequence = make,
        .uses_seed = random_digits,
        .bases =
            [](const Plan& plan, const Values&) {
                const auto end = primes.begin() + static_cast<std::ptrdiff_t>(plan.dimension);
                return std::vector<std::uint32_t>(primes.begin(), end);
            },
        .constants = constants};
}

}  // namespace stipple::generators::halton
