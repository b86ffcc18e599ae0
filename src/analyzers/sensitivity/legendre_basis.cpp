// SPDX-License-Identifier: MIT
#include "analyzers/sensitivity/legendre_basis.hpp"

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"

namespace stipple::analyzers::sensitivity {
namespace {

/// Appends the products of `begun` with inputs from `from` on whose degrees add up to `left`.
void append_terms_of_degree(BasisTerm& begun, std::size_t from, std::size_t k, std::size_t left,
                            std::vector<BasisTerm>& terms) {
    if (left == 0) return terms.push_back(begun);
    for (std::size_t i = from; i < k; ++i)
        for (std::size_t degree = left; degree > 0; --degree) {
            begun.emplace_back(i, degree);
            append_terms_of_degree(begun, i + 1, k, left - degree, terms);
            begun.pop_back();
        }
}

/// sqrt(2 m + 1) L_m(2 u - 1) for m = 0, 1, ...
void put_legendre(double u, std::span<double> values) {
    const double x = 2 * u - 1;
    double before = 0;
    double now = 1;
    for (std::size_t m = 0; m < values.size(); ++m) {
        const auto at = static_cast<double>(m);
        values[m] = std::sqrt(2 * at + 1) * now;
        const double next = ((2 * at + 1) * x * now - at * before) / (at + 1);
        before = now;
        now = next;
    }
}

}  // namespace

double term_count(std::size_t k, std::size_t p) {
    double count = 1;
    for (std::size_t i = 1; i <= p; ++i)
        count *= static_cast<double>(k + i) / static_cast<double>(i);
    return count - 1;
}

std::vector<BasisTerm> basis_terms(std::size_t k, std::size_t p) {
    std::vector<BasisTerm> terms;
    BasisTerm begun;
    for (std::size_t degree = 1; degree <= p; ++degree)
        append_terms_of_degree(begun, 0, k, degree, terms);
    return terms;
}

std::vector<double> basis_values(std::span<const double> u, std::size_t k,
                                 std::span<const BasisTerm> terms, const RunContext& run) {
    std::size_t most = 0;
    for (const BasisTerm& term : terms)
        for (const auto& factor : term) most = std::max(most, factor.second);
    std::vector<double> values(u.size() / k * terms.size());
    for_each_block(silent(run), u.size() / k, 256, [&](const Block& block) {
        std::vector<double> legendre(k * (most + 1));
        for (std::uint64_t i = block.first; i < block.last; ++i) {
            for (std::size_t j = 0; j < k; ++j)
                put_legendre(u[i * k + j], std::span(legendre).subspan(j * (most + 1), most + 1));
            for (std::size_t t = 0; t < terms.size(); ++t) {
                double product = 1;
                for (const auto& [j, degree] : terms[t])
                    product *= legendre[j * (most + 1) + degree];
                values[i * terms.size() + t] = product;
            }
        }
    });
    return values;
}

}  // namespace stipple::analyzers::sensitivity
