// SPDX-License-Identifier: MIT
#include "analyzers/sensitivity/polynomial_chaos.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "analyzers/sensitivity/legendre_basis.hpp"
#include "analyzers/sensitivity/matching_pursuit.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"

namespace stipple::analyzers::sensitivity {
namespace {

constexpr std::size_t max_degree = 20;

/// A fit, and the terms that its columns are.
struct Expansion {
    std::size_t degree = 0;
    std::vector<BasisTerm> terms = {};
    SparseFit fit = {};
};

/// The fit among all terms of total degree up to p.
Expansion expanded(std::size_t p, std::span<const double> u, std::size_t k,
                   std::span<const double> z, const RunContext& run) {
    const double rows = static_cast<double>(z.size());
    run.need_memory(8 * rows * (term_count(k, p) + most_terms), "polynomial chaos");
    Expansion out{.degree = p, .terms = basis_terms(k, p)};
    const auto values = basis_values(u, k, out.terms, run);
    out.fit = sparse_fit({values, out.terms.size()}, z, run);
    std::vector<BasisTerm> chosen;
    for (const std::size_t t : out.fit.chosen) chosen.push_back(std::move(out.terms[t]));
    out.terms = std::move(chosen);
    return out;
}

/// The expansion of the degree that is given or, up to what is bearable, of the best one.
Expansion best_expansion(std::span<const double> u, std::size_t k, std::span<const double> z,
                         const std::optional<std::size_t>& degree, const RunContext& run) {
    if (degree) return expanded(*degree, u, k, z, run);
    constexpr double enough = 1e-6;
    constexpr std::size_t patience = 3;  // even and odd terms come by turns
    const double most = std::min(2000.0, 1e7 / static_cast<double>(z.size()));
    Expansion best;
    for (std::size_t p = 1; p <= max_degree; ++p) {
        run.tick(p - 1, max_degree);
        if (p > 1 && term_count(k, p) > most) break;
        Expansion next = expanded(p, u, k, z, run);
        if (p == 1 || next.fit.error < best.fit.error) best = std::move(next);
        if (best.fit.error < enough || p >= best.degree + patience) break;
    }
    return best;
}

/// Where the squares of coefficients add up to indices: first, total, then pairs that have a term.
class Shares {
  public:
    Shares(std::span<const BasisTerm> terms, std::size_t k) : terms_(terms), k_(k) {
        for (const BasisTerm& term : terms)
            if (term.size() == 2) pairs_.try_emplace({term[0].first, term[1].first}, 0);
        std::size_t at = 2 * k;
        for (auto& pair : pairs_) pair.second = at++;
        for (const BasisTerm& term : terms)  // alone, as a pair, or nowhere
            places_.push_back(term.size() == 1   ? term[0].first
                              : term.size() == 2 ? pairs_.at({term[0].first, term[1].first})
                                                 : at);
    }

    [[nodiscard]] std::size_t size() const { return 2 * k_ + pairs_.size(); }
    [[nodiscard]] const auto& pairs() const { return pairs_; }

    void put(std::span<const double> coefficients, std::span<double> indices) const {
        std::ranges::fill(indices, 0.0);
        double all = 0;
        for (std::size_t t = 0; t < terms_.size(); ++t) {
            const double square = coefficients[t] * coefficients[t];
            all += square;
            if (places_[t] < indices.size()) indices[places_[t]] += square;
            for (const auto& factor : terms_[t]) indices[k_ + factor.first] += square;
        }
        for (double& index : indices) index /= all;
    }

  private:
    std::span<const BasisTerm> terms_;
    std::size_t k_;
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> pairs_;
    std::vector<std::size_t> places_;
};

/// The coefficients c of the fit without run i: c - (Gram matrix)^-1 psi_i e_i / (1 - h_i).
void put_without(std::size_t i, const SparseFit& fit, double residual, std::vector<double>& c) {
    double leverage = 0;
    for (const auto& q : fit.q) leverage += q[i] * q[i];
    const double error = residual / std::max(1 - leverage, 1e-12);
    for (std::size_t s = 1; s < fit.q.size(); ++s)
        for (std::size_t row = 1; row <= s; ++row)
            c[row - 1] -= fit.back[s][row] * fit.q[s][i] * error;
}

/// The jackknife's standard errors.
std::vector<double> jackknife(const SparseFit& fit, const Shares& shares,
                              std::span<const double> indices, std::span<const double> z,
                              const RunContext& run) {
    const auto all = fit.coefficients();
    const auto residual = fit.residual(z);
    const std::size_t size = indices.size();
    constexpr std::size_t rows = 256;
    std::vector<std::vector<double>> sums(block_count(z.size(), rows));
    for_each_block(silent(run), z.size(), rows, [&](const Block& block) {
        auto& sum = sums[block.index];  // of differences, then of their squares
        sum.assign(2 * size, 0.0);
        std::vector<double> without(size);
        for (std::uint64_t i = block.first; i < block.last; ++i) {
            std::vector<double> c = all;
            put_without(i, fit, residual[i], c);
            shares.put(c, without);
            for (std::size_t v = 0; v < size; ++v) {
                const double difference = without[v] - indices[v];
                sum[v] += difference;
                sum[size + v] += difference * difference;
            }
        }
    });
    std::vector<double> total(2 * size, 0.0);
    for (const auto& sum : sums)
        for (std::size_t v = 0; v < total.size(); ++v) total[v] += sum[v];
    const auto n = static_cast<double>(z.size());
    std::vector<double> errors(size);
    for (std::size_t v = 0; v < size; ++v)
        errors[v] =
            std::sqrt(std::max(total[size + v] - total[v] * total[v] / n, 0.0) * (n - 1) / n);
    return errors;
}

/// The inputs of those runs in [0, 1], run after run, and where they are from.
UnitInputs unit_inputs_of(const Inputs& inputs, std::span<const std::size_t> runs) {
    const UnitInputs all = unit_inputs(inputs, true);
    UnitInputs some{.u = {}, .scale = all.scale};
    const std::size_t k = inputs.size();
    some.u.reserve(runs.size() * k);
    for (const std::size_t i : runs)
        std::ranges::copy(std::span(all.u).subspan(i * k, k), std::back_inserter(some.u));
    return some;
}

}  // namespace

std::optional<Effects> polynomial_chaos(const Inputs& inputs, const Response& response,
                                        const Setting& setting, const RunContext& run) {
    const std::size_t k = inputs.size();
    const auto runs = succeeded(response.y);
    constexpr std::size_t least = 8;
    if (runs.size() < least)
        fail(ErrorKind::input, "the output {} has {} runs; polynomial chaos needs {}",
             response.name, runs.size(), least);
    const Centred f = centred(picked(response.y, runs), response.name);
    const UnitInputs unit = unit_inputs_of(inputs, runs);
    const Expansion best = best_expansion(unit.u, k, f.z, setting.degree, run.stage(0, 0.9));
    if (best.terms.empty()) return std::nullopt;

    const Shares shares(best.terms, k);
    std::vector<double> indices(shares.size());
    shares.put(best.fit.coefficients(), indices);
    const auto errors = jackknife(best.fit, shares, indices, f.z, run);
    const auto index = [&](std::size_t v) {
        return normal_interval(indices[v], errors[v], setting.level);
    };
    Effects effects{.used = runs.size(),
                    .samples = runs.size(),
                    .mean = f.mean,
                    .variance = f.variance() * f.unit * f.unit,
                    .kinds = {{"first", std::vector<Index>(k)}, {"total", std::vector<Index>(k)}}};
    for (std::size_t i = 0; i < k; ++i) {
        effects.kinds[0].of[i] = index(i);
        effects.kinds[1].of[i] = index(k + i);
    }
    for (const auto& [pair, at] : shares.pairs())
        effects.pairs.push_back({pair.first, pair.second, index(at)});
    effects.details.add("q2", 1 - best.fit.error);
    effects.details.add("degree", best.degree);
    effects.details.add("terms", best.terms.size());
    effects.details.add("scale", unit.scale);
    return effects;
}

}  // namespace stipple::analyzers::sensitivity
