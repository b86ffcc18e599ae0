// SPDX-License-Identifier: MIT
#include "experiments/sensitivity/orthonormal_basis.hpp"

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"

namespace stipple::analyzers::sensitivity {
namespace {

/// Appends all products of `begun` with polynomials of inputs from `from` on, whose degrees sum to
/// `left`.
void append_terms_of_degree(BasisTerm& begun, std::size_t from, std::span<const Polynomials> inputs,
                            std::size_t left, std::vector<BasisTerm>& terms) {
    if (left == 0) return terms.push_back(begun);
    for (std::size_t i = from; i < inputs.size(); ++i)
        for (std::size_t degree = std::min(left, inputs[i].count - 1); degree > 0; --degree) {
            begun.emplace_back(i, degree);
            append_terms_of_degree(begun, i + 1, inputs, left - degree, terms);
            begun.pop_back();
        }
}

/// Distinct values of an input, scaled to [-1, 1], in ascending order; each with its fraction of
/// the runs.
struct Distribution {
    std::vector<double> x;
    std::vector<double> weight;

    [[nodiscard]] double product(std::span<const double> a, std::span<const double> b) const {
        double sum = 0;
        for (std::size_t i = 0; i < x.size(); ++i) sum += weight[i] * a[i] * b[i];
        return sum;
    }
};

Distribution distribution_of(std::span<const double> x, const std::vector<double>& values) {
    Distribution out{.x = {}, .weight = std::vector<double>(values.size())};
    for (const double value : x)
        ++out.weight[static_cast<std::size_t>(std::ranges::lower_bound(values, value) -
                                              values.begin())];
    for (double& weight : out.weight) weight /= static_cast<double>(x.size());
    // Uses halves, because the difference of two doubles may overflow.
    const double middle = values.front() / 2 + values.back() / 2;
    const double extent = values.back() / 2 - values.front() / 2;
    for (const double value : values)
        out.x.push_back(extent > 0 ? std::clamp((value - middle) / extent, -1., 1.) : 0);
    return out;
}

/// Appends x times the last polynomial, made orthonormal to all others; false if nothing remains.
bool append_next(const Distribution& law, std::vector<std::vector<double>>& polynomials) {
    std::vector<double> next = polynomials.back();
    for (std::size_t i = 0; i < next.size(); ++i) next[i] *= law.x[i];
    for (int pass = 0; pass < 2; ++pass)  // a second pass makes it orthogonal despite rounding
        for (const auto& other : polynomials) {
            const double part = law.product(next, other);
            for (std::size_t i = 0; i < next.size(); ++i) next[i] -= part * other[i];
        }
    const double norm = std::sqrt(law.product(next, next));
    constexpr double least = 1e-10;
    if (!(norm > least)) return false;
    for (double& value : next) value /= norm;
    polynomials.push_back(std::move(next));
    return true;
}

}  // namespace

Polynomials legendre_polynomials(std::span<const double> u, std::size_t max_degree) {
    Polynomials out{.count = max_degree + 1};
    out.values.reserve(u.size() * out.count);
    for (const double value : u) {
        const double x = 2 * value - 1;
        double before = 0;
        double now = 1;
        for (std::size_t m = 0; m <= max_degree; ++m) {
            const auto at = static_cast<double>(m);
            out.values.push_back(std::sqrt(2 * at + 1) * now);
            const double next = ((2 * at + 1) * x * now - at * before) / (at + 1);
            before = now;
            now = next;
        }
    }
    return out;
}

Polynomials sample_polynomials(std::span<const double> x, std::size_t max_degree) {
    std::vector<double> values(x.begin(), x.end());
    std::ranges::sort(values);
    values.erase(std::unique(values.begin(), values.end()), values.end());
    const Distribution law = distribution_of(x, values);
    std::vector<std::vector<double>> polynomials = {std::vector<double>(values.size(), 1.0)};
    while (polynomials.size() <= max_degree && polynomials.size() < values.size())
        if (!append_next(law, polynomials)) break;
    Polynomials out{.count = polynomials.size()};
    out.values.reserve(x.size() * out.count);
    for (const double value : x) {
        const auto at =
            static_cast<std::size_t>(std::ranges::lower_bound(values, value) - values.begin());
        for (const auto& polynomial : polynomials) out.values.push_back(polynomial[at]);
    }
    return out;
}

double term_count(std::size_t k, std::size_t p) {
    double count = 1;
    for (std::size_t i = 1; i <= p; ++i)
        count *= static_cast<double>(k + i) / static_cast<double>(i);
    return count - 1;
}

std::vector<BasisTerm> basis_terms(std::span<const Polynomials> inputs, std::size_t p) {
    std::vector<BasisTerm> terms;
    BasisTerm begun;
    for (std::size_t degree = 1; degree <= p; ++degree)
        append_terms_of_degree(begun, 0, inputs, degree, terms);
    return terms;
}

std::vector<double> basis_values(std::span<const Polynomials> inputs, std::size_t n,
                                 std::span<const BasisTerm> terms, const RunContext& run) {
    std::vector<double> values(n * terms.size());
    for_each_block(silent(run), n, 256, [&](const Block& block) {
        for (std::uint64_t i = block.first; i < block.last; ++i)
            for (std::size_t t = 0; t < terms.size(); ++t) {
                double product = 1;
                for (const auto& [j, degree] : terms[t])
                    product *= inputs[j].values[i * inputs[j].count + degree];
                values[i * terms.size() + t] = product;
            }
    });
    return values;
}

}  // namespace stipple::analyzers::sensitivity
