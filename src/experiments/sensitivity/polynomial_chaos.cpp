// SPDX-License-Identifier: MIT
//
// Sobol' indices of a sparse polynomial chaos expansion of any sample. The output is approximated
// by p(x) = c_0 + sum_a c_a P_a(x), with products P_a of polynomials of single inputs. These are
// orthonormal for the distribution of their input: a uniform one, or that of its values in the
// sample. In the latter case an input with m values has polynomials of degree 0 to m - 1, which
// represent functions of discrete inputs exactly. Each index belongs to the part p_u of a group u
// of terms: those with input i alone (first), all with input i (total), or those with inputs i and
// j only (second).
//
// Five times, degree, terms and coefficients are chosen from four fifths of the runs alone
// (matching_pursuit.cpp). Let r = f - p be the errors in the other fifth. With means over all runs,
// each predicted by the polynomial that was not fitted to it,
//
//     V   = mean of sum_a c_a^2 + 2 (p - c_0) r + r^2,    Q2 = 1 - mean r^2 / Var f,
//     S_u = (mean of |p_u|^2 + 2 p_u r) / V,  |p_u|^2 the sum of the c_a^2 of u.
//
// Up to random errors, S_u is (||f_u||^2 - ||f_u - p_u||^2) / V, the part of the index that p_u
// explains. Terms fitted to noise do not increase it, because they explain nothing of other runs.
// The interval is from S_u minus its error to S_u + 1 - Q2 plus its error, since the unexplained
// part may belong to u. Errors are Student's quantile times the standard error of the ratio.
//
// If the inputs' distributions are unknown, the runs are also a sample of these distributions. The
// standard error then uses p_u (2 p_v - p_u) instead of |p_u|^2, where v are all terms that contain
// the inputs of u, and (f - mean f)^2 instead of the terms of V.
//
// Shape   eight runs or more, twenty for intervals; independent inputs. An input has Legendre
//         polynomials of its probability F(x), or without known distributions, if all inputs are in
//         [0, 1], of its value; but only if these numbers are distinct and their mean and variance
//         are those of uniform ones, within 5 or 2.6 standard errors. Other inputs have polynomials
//         of their values or of the ranks of these, whichever fit better.
// Cost    for P candidates and t terms O(n P t) time for each degree, n (P + t) numbers of memory.
//         P is at most 600 and 1e7 / n, t at most 0.4 n and 300.
// Beware  indices are fractions of the whole variance, including noise that no input explains.
// Source  G. Blatman, B. Sudret, J. Comput. Phys. 230 (2011) 2345-2367,
//         doi:10.1016/j.jcp.2010.12.021 (sparse polynomials); B. Sudret, Reliab. Eng. Syst. Saf. 93
//         (2008) 964-979, doi:10.1016/j.ress.2007.04.002 (indices); M. Stone, J. R. Stat. Soc. B 36
//         (1974) 111-147 (choice inside of cross-validation).

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>
#include <string_view>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/rng.hpp"
#include "experiments/sensitivity/methods.hpp"

namespace stipple::analyzers::sensitivity {
namespace {

/// Values of one input's polynomials: run after run, by ascending degree.
struct Polynomials {
    std::size_t count = 1;  ///< number of polynomials: largest degree + 1
    std::vector<double> values = {};
};

/// A product of polynomials, as pairs of input and degree: ascending inputs, degrees at least 1.
using BasisTerm = std::vector<std::pair<std::size_t, std::size_t>>;

/// Appends all products of `begun` with terms of degree `left` in the inputs from `from` on.
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

/// Distinct values of an input, ascending in [-1, 1], each with its fraction of the runs.
struct Distribution {
    std::vector<double> x;
    std::vector<double> weight;

    [[nodiscard]] double product(std::span<const double> a, std::span<const double> b) const {
        double sum = 0;
        for (std::size_t i = 0; i < x.size(); ++i) sum += weight[i] * a[i] * b[i];
        return sum;
    }
};

/// @param runs index of each run's value in `values`
Distribution distribution_of(const std::vector<double>& values, std::span<const std::size_t> runs) {
    Distribution out{.x = {}, .weight = std::vector<double>(values.size())};
    for (const std::size_t i : runs) ++out.weight[i];
    for (double& weight : out.weight) weight /= static_cast<double>(runs.size());
    // Uses halves, because the difference of two doubles may overflow.
    const double middle = values.front() / 2 + values.back() / 2;
    const double extent = values.back() / 2 - values.front() / 2;
    for (const double value : values)
        out.x.push_back(extent > 0 ? std::clamp((value - middle) / extent, -1., 1.) : 0);
    return out;
}

/// Appends x times the last polynomial, orthonormalized; false if only rounding errors remain.
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

/// Values of sqrt(2 m + 1) L_m(2 u - 1), with Legendre's L_m, for m from 0 to max_degree.
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

/// Orthonormal polynomials for the distribution of the values x, up to max_degree if there are
/// enough distinct values.
Polynomials sample_polynomials(std::span<const double> x, std::size_t max_degree) {
    std::vector<double> values(x.begin(), x.end());
    std::ranges::sort(values);
    values.erase(std::unique(values.begin(), values.end()), values.end());
    std::vector<std::size_t> runs;  // index of each run's value
    for (const double value : x)
        runs.push_back(
            static_cast<std::size_t>(std::ranges::lower_bound(values, value) - values.begin()));
    const Distribution law = distribution_of(values, runs);
    std::vector<std::vector<double>> polynomials = {std::vector<double>(values.size(), 1.0)};
    while (polynomials.size() <= max_degree && polynomials.size() < values.size())
        if (!append_next(law, polynomials)) break;
    Polynomials out{.count = polynomials.size()};
    out.values.reserve(x.size() * out.count);
    for (const std::size_t i : runs)
        for (const auto& polynomial : polynomials) out.values.push_back(polynomial[i]);
    return out;
}

/// Number of terms of k inputs with total degrees from 1 to p, if every input has enough values.
double term_count(std::size_t k, std::size_t p) {
    double count = 1;
    for (std::size_t i = 1; i <= p; ++i)
        count *= static_cast<double>(k + i) / static_cast<double>(i);
    return count - 1;
}

/// All products of the inputs' polynomials with total degrees from 1 to p, by ascending degree.
std::vector<BasisTerm> basis_terms(std::span<const Polynomials> inputs, std::size_t p) {
    std::vector<BasisTerm> terms;
    BasisTerm begun;
    for (std::size_t degree = 1; degree <= p; ++degree)
        append_terms_of_degree(begun, 0, inputs, degree, terms);
    return terms;
}

/// Values of the terms in n runs; one row per run, one column per term.
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

constexpr std::size_t max_degree = 20;
constexpr std::size_t fold_count = 5;

/// Polynomials of the inputs in the runs that did not fail.
struct Basis {
    std::string scale;
    std::vector<Polynomials> inputs = {};
    /// Whether the polynomials are for known distributions, not for those of the sample.
    bool known = false;
};

/// Terms with their values in all runs: one row per run, one column per term.
struct Table {
    std::size_t degree;
    std::vector<BasisTerm> terms;
    std::vector<double> values;
};

/// A polynomial, with the runs to which it was fitted (seen) and the other runs.
struct Fold {
    std::vector<std::size_t> seen = {};
    std::vector<std::size_t> unseen = {};
    std::string scale = {};
    std::size_t degree = 0;  ///< largest degree of candidates; 0 before the first fit
    SparseFit fit = {};
    std::vector<BasisTerm> terms = {};
    /// Products of coefficients and terms: one row per unseen run.
    std::vector<double> products = {};

    [[nodiscard]] bool is_settled(std::size_t next_degree) const {
        constexpr double enough = 1e-6;
        constexpr std::size_t patience = 3;  // since only even, or only odd, degrees may help
        return degree > 0 && (fit.error < enough || next_degree > degree + patience);
    }
};

std::vector<Fold> folds_of(std::size_t n) {
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    const Rng rng(1);
    for (std::size_t i = n; i > 1; --i) std::swap(order[i - 1], order[rng.below(i, i)]);
    std::vector<Fold> folds(fold_count);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t f = 0; f < fold_count; ++f)
            (i % fold_count == f ? folds[f].unseen : folds[f].seen).push_back(order[i]);
    return folds;
}

/// Replaces the fold's polynomial by the best one with terms of the table if its error is smaller.
void improve(Fold& fold, const Table& table, const Basis& basis, std::span<const double> z,
             const RunContext& run) {
    const std::size_t columns = table.terms.size();
    SparseFit fit = matching_pursuit({table.values, columns, fold.seen}, z, run);
    if (fold.degree > 0 && !(fit.error < fold.fit.error)) return;
    fold.scale = basis.scale;
    fold.degree = table.degree;
    fold.terms.clear();
    for (const std::size_t t : fit.chosen) fold.terms.push_back(table.terms[t]);
    fold.products.clear();
    for (const std::size_t i : fold.unseen)
        for (std::size_t t = 0; t < fit.chosen.size(); ++t)
            fold.products.push_back(fit.coefficients[t] *
                                    table.values[i * columns + fit.chosen[t]]);
    fold.fit = std::move(fit);
}

/// Largest degree with an acceptable number of candidates; at least 1.
std::size_t bearable_degree(std::size_t k, std::size_t n) {
    const double most = std::min(600.0, 1e7 / static_cast<double>(n));
    std::size_t degree = 1;
    while (degree < max_degree && term_count(k, degree + 1) <= most) ++degree;
    return degree;
}

/// Folds with their best polynomials over all acceptable degrees, or of the given degree.
std::vector<Fold> fitted_folds(const Basis& basis, std::span<const double> z,
                               const std::optional<std::size_t>& degree, const RunContext& run) {
    std::vector<Fold> folds = folds_of(z.size());
    const std::size_t k = basis.inputs.size();
    const auto rows = static_cast<double>(z.size());
    const std::size_t last = degree.value_or(bearable_degree(k, z.size()));
    for (std::size_t p = degree.value_or(1); p <= last; ++p) {
        run.tick(p - 1, max_degree);
        if (std::ranges::all_of(folds, [p](const Fold& fold) { return fold.is_settled(p); })) break;
        const double terms = term_count(k, p);
        const double picked = std::min(terms, static_cast<double>(most_terms));
        run.need_memory(8 * rows * (terms + picked * fold_count), "polynomial chaos");
        Table table{.degree = p, .terms = basis_terms(basis.inputs, p), .values = {}};
        table.values = basis_values(basis.inputs, z.size(), table.terms, run);
        for_each_block(silent(run), folds.size(), 1, [&](const Block& block) {
            Fold& fold = folds[block.index];
            if (!fold.is_settled(p)) improve(fold, table, basis, z, run);
        });
    }
    return folds;
}

/// Group of terms: those that contain the given inputs.
struct Part {
    std::vector<std::size_t> inputs = {};
    bool alone = false;  ///< excludes terms that contain other inputs

    /// Whether a term contains the inputs, and whether it belongs to the group.
    [[nodiscard]] std::pair<bool, bool> holds(const BasisTerm& term) const {
        const bool with = std::ranges::all_of(inputs, [&](std::size_t i) {
            return std::ranges::find(term, i, &BasisTerm::value_type::first) != term.end();
        });
        return {with, with && (!alone || term.size() == inputs.size())};
    }
};

/// Sums over terms for each run, from the polynomial that was not fitted to the run.
struct Sums {
    std::vector<double> norm;    ///< sums of squared coefficients
    std::vector<double> own;     ///< sums of the group's terms
    std::vector<double> around;  ///< sums of all terms that contain the group's inputs
};

Sums sums_of(std::span<const Fold> folds, std::size_t n, const Part& part) {
    Sums sums{std::vector(n, 0.0), std::vector(n, 0.0), std::vector(n, 0.0)};
    for (const Fold& fold : folds)
        for (std::size_t t = 0; t < fold.terms.size(); ++t) {
            const auto [with, inside] = part.holds(fold.terms[t]);
            if (!with) continue;
            const double square = fold.fit.coefficients[t] * fold.fit.coefficients[t];
            for (std::size_t r = 0; r < fold.unseen.size(); ++r) {
                const std::size_t i = fold.unseen[r];
                const double value = fold.products[r * fold.terms.size() + t];
                sums.around[i] += value;
                if (!inside) continue;
                sums.own[i] += value;
                sums.norm[i] += square;
            }
        }
    return sums;
}

double mean_of(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Errors of the polynomials in runs to which they were not fitted, and the variance of the output.
struct Judgement {
    bool known = false;  ///< whether the inputs' distributions are known
    std::vector<double> error;
    /// Per run the term of V or, if the distributions are unknown, the squared centred output.
    std::vector<double> moving = {};
    double variance = 0;  ///< V, the variance of the output
    double q2 = 0;
};

Judgement judged(std::span<const Fold> folds, std::span<const double> z, bool known) {
    const Sums all = sums_of(folds, z.size(), {});
    Judgement out{.known = known, .error = {z.begin(), z.end()}};
    for (const Fold& fold : folds)
        for (const std::size_t i : fold.unseen) out.error[i] -= fold.fit.constant + all.own[i];
    for (std::size_t i = 0; i < z.size(); ++i) {
        const double r = out.error[i];
        const double term = all.norm[i] + 2 * all.own[i] * r + r * r;
        out.variance += term;
        out.moving.push_back(known ? term : z[i] * z[i]);
    }
    const double whole = dot(z, z);
    // A few wild predictions must not make the variance vanish.
    out.variance = std::max(out.variance, whole / 2) / static_cast<double>(z.size());
    out.q2 = 1 - dot(out.error, out.error) / whole;
    return out;
}

/// Standard error of `ratio`, which is mean(values) / V.
double error_of_ratio(std::span<const double> values, double ratio, const Judgement& judgement) {
    std::vector<double> rest(values.begin(), values.end());
    for (std::size_t i = 0; i < rest.size(); ++i) rest[i] -= ratio * judgement.moving[i];
    const double mean = mean_of(rest);
    for (double& value : rest) value -= mean;
    const auto n = static_cast<double>(rest.size());
    return std::sqrt(dot(rest, rest) / (n - 1) / n) / judgement.variance;
}

Index index_of(const Sums& sums, const Judgement& judgement, double level) {
    const std::size_t n = judgement.error.size();
    std::vector<double> explained(n);
    std::vector<double> moving(n);
    double unexplained = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const double r = judgement.error[i];
        const double own = sums.own[i];
        explained[i] = sums.norm[i] + 2 * own * r;
        const double square = judgement.known ? sums.norm[i] : own * (2 * sums.around[i] - own);
        moving[i] = square + 2 * own * r;
        unexplained += r * r / static_cast<double>(n);
    }
    Index index{.value = mean_of(explained) / judgement.variance};
    if (n < least_for_intervals) return index;
    const double high = index.value + unexplained / judgement.variance;
    const double t = interval_quantile(level, n - 1);
    index.low = index.value - t * error_of_ratio(moving, index.value, judgement);
    for (std::size_t i = 0; i < n; ++i) moving[i] += judgement.error[i] * judgement.error[i];
    index.high = high + t * error_of_ratio(moving, high, judgement);
    return index;
}

/// Whether values differ from their scaled ranks by at most a tenth of their range.
bool is_even(std::span<const double> x, std::span<const double> ranks) {
    const auto [low, high] = std::ranges::minmax(x);
    constexpr double most = 0.1;
    const double extent = high / 2 - low / 2;
    for (std::size_t i = 0; i < x.size(); ++i)
        if (std::abs(x[i] / 2 - low / 2 - ranks[i] * extent) > most * extent) return false;
    return true;
}

/// Whether numbers in [0, 1] are distinct and have the mean and variance of uniform ones, within
/// `errors` standard errors.
bool looks_uniform(std::span<const double> u, double errors) {
    std::vector<double> sorted(u.begin(), u.end());
    std::ranges::sort(sorted);
    if (std::ranges::adjacent_find(sorted) != sorted.end()) return false;
    const Polynomials legendre = legendre_polynomials(u, 2);
    std::array<double, 3> sums = {};
    for (std::size_t i = 0; i < legendre.values.size(); ++i) sums[i % 3] += legendre.values[i];
    const double most = errors * std::sqrt(static_cast<double>(u.size()));
    return std::abs(sums[1]) <= most && std::abs(sums[2]) <= most;
}

/// Legendre polynomials for inputs that look uniform, otherwise polynomials of the values; and a
/// second basis, of the ranks, if values and ranks differ enough.
std::vector<Basis> bases_of(const Inputs& inputs, std::span<const std::size_t> runs,
                            std::size_t degree) {
    const UnitInputs unit = unit_inputs(inputs);
    const bool told = inputs.domain != nullptr;
    const bool cube = told || std::string_view(unit.scale) == "cube";
    Basis values{.scale = unit.scale, .known = told};
    Basis ranks{.scale = "ranks"};
    bool even = true;
    for (std::size_t j = 0; j < inputs.size(); ++j) {
        const auto u = picked(column_of(unit.u, j), runs);
        if (cube && looks_uniform(u, told ? 5 : 2.6)) {
            values.inputs.push_back(legendre_polynomials(u, degree));
            ranks.inputs.push_back(values.inputs.back());
            continue;
        }
        const auto x = picked(column_of(inputs.values, j), runs);
        const auto rank = ranks_of(x);
        values.scale = "values";
        values.known = false;
        even = even && is_even(x, rank);
        values.inputs.push_back(sample_polynomials(x, degree));
        ranks.inputs.push_back(sample_polynomials(rank, degree));
    }
    std::vector<Basis> bases = {std::move(values)};
    if (!even) bases.push_back(std::move(ranks));
    return bases;
}

/// Pairs of inputs that occur together in a term without other inputs.
std::set<std::pair<std::size_t, std::size_t>> pairs_in(std::span<const Fold> folds) {
    std::set<std::pair<std::size_t, std::size_t>> pairs;
    for (const Fold& fold : folds)
        for (const BasisTerm& term : fold.terms)
            if (term.size() == 2) pairs.emplace(term[0].first, term[1].first);
    return pairs;
}

void add_details(Report& details, std::span<const Fold> folds, double q2,
                 const std::string& scale) {
    const auto size = [](const Fold& fold) { return fold.terms.size(); };
    const auto by_ranks = std::ranges::count(folds, "ranks", &Fold::scale);
    details.add("q2", q2);
    details.add("degree", std::ranges::max_element(folds, {}, &Fold::degree)->degree);
    details.add("terms", size(*std::ranges::max_element(folds, {}, size)));
    details.add("scale", 2 * by_ranks > std::ssize(folds) ? "ranks" : scale);
}

}  // namespace

std::optional<Effects> polynomial_chaos(const Inputs& inputs, const Response& response,
                                        const Setting& setting, const RunContext& run) {
    const auto runs = succeeded(response.y);
    constexpr std::size_t least = 8;
    if (runs.size() < least)
        fail(ErrorKind::input, "the output {} has {} successful runs; polynomial chaos needs {}",
             response.name, runs.size(), least);
    const Centred f = centred(picked(response.y, runs));
    const std::size_t degree = setting.degree.value_or(bearable_degree(inputs.size(), runs.size()));
    run.need_memory(16.0 * static_cast<double>(runs.size() * inputs.size() * (degree + 1)),
                    "polynomial chaos");
    std::vector<Fold> folds;
    const auto bases = bases_of(inputs, runs, degree);
    for (std::size_t b = 0; b < bases.size(); ++b) {
        const auto share = 0.9 / static_cast<double>(bases.size());
        auto next = fitted_folds(
            bases[b], f.z, setting.degree,
            run.stage(share * static_cast<double>(b), share * static_cast<double>(b + 1)));
        if (b == 0) folds = next;
        for (std::size_t i = 0; i < next.size(); ++i)
            if (next[i].fit.error < folds[i].fit.error) folds[i] = std::move(next[i]);
    }
    if (std::ranges::all_of(folds, [](const Fold& fold) { return fold.terms.empty(); }))
        return std::nullopt;

    const Judgement judgement = judged(folds, f.z, bases[0].known);
    const auto index = [&](const Part& part) {
        run.check_stop();
        return index_of(sums_of(folds, f.z.size(), part), judgement, setting.level);
    };
    Effects effects{
        .used = runs.size(),
        .samples = runs.size(),
        .mean = f.mean,
        .variance = held(f.variance() * f.unit * f.unit),
        .kinds = {{"first", {}}, {"total", {}}},
        .no_intervals = too_few_for_intervals(runs.size(), least_for_intervals, "runs")};
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        effects.kinds[0].of.push_back(index({{i}, true}));
        effects.kinds[1].of.push_back(index({{i}, false}));
    }
    for (const auto& [i, j] : pairs_in(folds))
        effects.pairs.push_back({i, j, index({{i, j}, true})});
    add_details(effects.details, folds, judgement.q2, bases[0].scale);
    return effects;
}

}  // namespace stipple::analyzers::sensitivity
