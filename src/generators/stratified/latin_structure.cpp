// SPDX-License-Identifier: MIT
#include "generators/stratified/latin_structure.hpp"

#include "math/combinatorics/permutation.hpp"

namespace stipple::generators {
namespace {

/// Streams of random numbers; stream 0 belongs to the plain hypercube.
constexpr std::uint64_t first_keys = 1;
constexpr std::uint64_t second_keys = 2;

/// Strata by `stratum`, a function of coordinate and index.
StrataOf strata_by(std::uint64_t parts, auto stratum) {
    return [=](std::size_t coordinate, std::span<const double> index, std::span<double> low) {
        for (std::size_t j = 0; j < index.size(); ++j)
            low[j] = static_cast<double>(stratum(coordinate, static_cast<std::uint64_t>(index[j])));
        return parts;
    };
}

}  // namespace

StrataOf sliced_strata(const Plan& plan, std::uint64_t slices) {
    const std::uint64_t n = plan.count;
    const std::uint64_t m = n / slices;
    const PermutationFamily in_slice(m, plan.dimension * slices,
                                     stratified_numbers(plan, first_keys));
    const PermutationFamily to_slices(slices, plan.dimension * m,
                                      stratified_numbers(plan, second_keys));
    return strata_by(n, [=](std::uint64_t k, std::uint64_t i) {
        const std::uint64_t s = i / m;
        const std::uint64_t coarse = in_slice(k * slices + s, i % m);
        return slices * coarse + to_slices(k * m + coarse, s);
    });
}

StrataOf nested_strata(const Plan& plan, std::uint64_t first) {
    const std::uint64_t n = plan.count;
    const std::uint64_t t = n / first;
    const PermutationFamily of_first(first, plan.dimension, stratified_numbers(plan, first_keys));
    const PermutationFamily of_rest(std::max<std::uint64_t>(1, n - first), plan.dimension,
                                    stratified_numbers(plan, first_keys + 2));
    const Rng offsets = stratified_numbers(plan, second_keys);
    return strata_by(n, [=](std::uint64_t k, std::uint64_t i) {
        const auto offset = [&](std::uint64_t coarse) {
            return offsets.below(k * first + coarse, t);
        };
        if (i < first) {
            const std::uint64_t coarse = of_first(k, i);
            return t * coarse + offset(coarse);
        }
        const std::uint64_t rank = of_rest(k, i - first);
        const std::uint64_t coarse = rank / (t - 1);
        const std::uint64_t fine = rank % (t - 1);
        return t * coarse + fine + (fine >= offset(coarse));
    });
}

}  // namespace stipple::generators
