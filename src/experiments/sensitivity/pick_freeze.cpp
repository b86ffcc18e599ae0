// SPDX-License-Identifier: MIT
//
// Sobol' indices from pick-freeze designs. Two independent samples A and B of N points are mixed:
// AB_i is A with coordinate i of B, BA_i is B with coordinate i of A. With the outputs f centred at
// their mean and V the variance of f(A) and f(B),
//
//     first   S_i   = mean f(B) (f(AB_i) - f(A)) / V
//     total   ST_i  = mean (f(A) - f(AB_i))^2 / (2 V)
//     second  S_ij  = mean (f(BA_i) f(AB_j) - f(A) f(B)) / V - S_i - S_j.
//
// If half of the outputs are equal, as those of an event, an effect that no row has shown may have
// the probability q = ln(2 / (1 - level)) / N. The intervals of inputs that leave the output
// unchanged in some rows therefore extend by q M / V, M being the largest |f(B)| times the largest
// |f(A) - f(AB_i)| (S), half the square of the latter (ST, upwards) or the largest f^2 (S_ij), unless
// five rows or more have terms of M / 2. An input that changes the output in fewer than 20 rows may
// have the largest change of any.
//
// Shape   n = N (k + 2) rows, for each base row A, AB_1, ..., AB_k, B; or N (2k + 2) rows: A, AB_1,
//         ..., AB_k, BA_1, ..., BA_k, B. Copied coordinates must be equal to the last bit, which is
//         so after any map of single coordinates.
// Cost    O(n k) and the bootstrap over base rows, to which pairs add k (k - 1) / 2 terms.
// Source  A. Saltelli, P. Annoni, I. Azzini, F. Campolongo, M. Ratto, S. Tarantola, Comput. Phys.
//         Commun. 181 (2010) 259-270, doi:10.1016/j.cpc.2009.09.018, table 2 (b) and (f), the
//         latter due to M. J. W. Jansen, Comput. Phys. Commun. 117 (1999) 35-43. Pairs and the
//         order of rows: A. Saltelli, Comput. Phys. Commun. 145 (2002) 280-297.
#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.hpp"
#include "experiments/sensitivity/methods.hpp"

namespace stipple::analyzers::sensitivity {
namespace {

/// Whether a row equals `whole`, except for coordinate i, which must be that of `other`.
bool is_mixed(std::span<const double> row, std::span<const double> whole,
              std::span<const double> other, std::size_t i) {
    for (std::size_t j = 0; j < row.size(); ++j)
        if (row[j] != (j == i ? other[j] : whole[j])) return false;
    return true;
}

/// Index of the first row that does not fit groups of this size; the number of rows if all fit; 0
/// if the first and last rows of all groups are equal.
std::size_t first_unfit(const PointSet& design, std::size_t group) {
    const std::size_t k = design.dimension();
    bool moves = false;
    for (std::size_t at = 0; at < design.count(); at += group) {
        const auto a = design[at];
        const auto b = design[at + group - 1];
        moves = moves || !std::ranges::equal(a, b);
        for (std::size_t r = 1; r + 1 < group; ++r)
            if (!(r <= k ? is_mixed(design[at + r], a, b, r - 1)
                         : is_mixed(design[at + r], b, a, r - 1 - k)))
                return at + r;
    }
    return moves ? design.count() : 0;
}

/// Whether the first and last rows of all groups differ in every coordinate, as in a factorial
/// design, although coordinates have so few values that independent rows would differ with a
/// probability below exp(-2).
bool is_factorial(const PointSet& design, std::size_t group) {
    constexpr double most = 2;
    const auto groups = design.count() / group;
    double expected = 0;
    for (std::size_t j = 0; j < design.dimension(); ++j) {
        std::map<double, double> times;
        for (std::size_t at = 0; at < design.count(); at += group) {
            const double a = design[at][j];
            const double b = design[at + group - 1][j];
            if (a == b) return false;
            ++times[a];
            ++times[b];
        }
        if (times.size() > groups) return false;  // too many levels for a factorial
        for (const auto& [value, count] : times)
            expected += count * count / static_cast<double>(4 * groups);
    }
    return expected >= most;
}

/// Appends the terms of a base row with the outputs f: those of the mean and of V, then those of
/// first, total and second order indices.
void append_terms(std::span<const double> f, std::size_t k, std::vector<double>& terms) {
    const double a = f.front();
    const double b = f.back();
    const auto ab = f.subspan(1, k);
    terms.push_back((a + b) / 2);
    terms.push_back((a * a + b * b) / 2);
    for (const double mixed : ab) terms.push_back(b * (mixed - a));
    for (const double mixed : ab) terms.push_back((a - mixed) * (a - mixed) / 2);
    if (f.size() == k + 2) return;
    const auto ba = f.subspan(k + 1, k);
    for (std::size_t i = 0; i < k; ++i)
        for (std::size_t j = i + 1; j < k; ++j) terms.push_back(ba[i] * ab[j] - a * b);
}

/// Mean, variance and indices, from the means of the terms of append_terms(); NaN if the outputs in
/// the first and last rows of groups differ only by rounding errors.
void indices_of(std::span<const double> means, std::size_t k, std::span<double> values) {
    constexpr double rounding = 1e-12;  // variance from rounding, for outputs scaled to 1
    const double variance = means[1] - means[0] * means[0];
    if (!(variance > rounding)) {
        std::ranges::fill(values, none);
        return;
    }
    values[0] = means[0];
    values[1] = variance;
    for (std::size_t t = 2; t < values.size(); ++t) values[t] = means[t] / variance;
    std::size_t pair = 2 + 2 * k;
    for (std::size_t i = 0; pair < values.size(); ++i)
        for (std::size_t j = i + 1; j < k; ++j) values[pair++] -= values[2 + i] + values[2 + j];
}

/// Drops the indices of inputs whose mixed rows vary far more than A and B, although all should be
/// samples of the same distribution.
void drop_unlike(Effects& effects, std::span<const double> f, std::size_t k, double variance) {
    constexpr double most = 10;
    const std::size_t group = f.size() / effects.samples;
    effects.missing.resize(k);
    for (std::size_t i = 0; i < k; ++i) {
        double square = 0;
        for (std::size_t at = 1 + i; at < f.size(); at += group) square += f[at] * f[at];
        if (square <= most * variance * static_cast<double>(effects.samples)) continue;
        for (IndexKind& kind : effects.kinds) kind.of[i] = {.value = none};
        for (PairIndex& pair : effects.pairs)
            if (pair.first == i || pair.second == i) pair.index = {.value = none};
        effects.missing[i] =
            "the rows that mix in this input vary far more than the first and last rows of groups, "
            "although all should have the same distribution";
    }
}

/// Reason for no intervals if one base row has most of the variance: resamples cannot show how much
/// such a row varies. Empty if none has.
std::string rare_row(const TermTable& table, std::span<const std::size_t> groups,
                     std::size_t group) {
    constexpr double most = 0.8;
    double whole = 0;
    std::size_t largest = 0;
    const auto square = [&](std::size_t row) { return table.terms[row * table.width + 1]; };
    for (std::size_t row = 0; row < table.rows(); ++row) {
        whole += square(row);
        if (square(row) > square(largest)) largest = row;
    }
    if (!(square(largest) > most * whole)) return {};
    const std::size_t first = groups[largest] * group;
    return fmt::format(
        "{:.3g} % of the variance is in the points {} to {}; resamples do not show how much such "
        "points vary",
        100 * square(largest) / whole, first, first + group - 1);
}

/// Extends intervals for effects that no row has shown. @param f centred outputs
void allow_for_unseen(std::vector<Index>& found, const TermTable& table, std::span<const double> f,
                      std::size_t k, double level) {
    const std::size_t rows = table.rows();
    const auto term = [&](std::size_t row, std::size_t t) {
        return std::abs(table.terms[row * table.width + t]);
    };
    double largest = 0;                 // |f|
    double of_last = 0;                 // |f(B)|
    std::vector<double> half_steps(k);  // (f(A) - f(AB_i))^2 / 2
    std::vector<std::size_t> steps(k);
    for (const double z : f) largest = std::max(largest, std::abs(z));
    for (std::size_t row = 0; row < rows; ++row) {
        of_last = std::max(of_last, std::abs(f[(row + 1) * (f.size() / rows) - 1]));
        for (std::size_t i = 0; i < k; ++i) {
            half_steps[i] = std::max(half_steps[i], term(row, 2 + k + i));
            steps[i] += term(row, 2 + k + i) > 0 ? 1 : 0;
        }
    }
    const auto widen = [&](std::size_t t, double most) {
        std::size_t seen = 0;
        for (std::size_t row = 0; row < rows; ++row) seen += term(row, t) >= most / 2 ? 1 : 0;
        const double room = unseen_chance(rows, seen, level) * most / found[1].value;
        found[t].high += room;
        if (t < 2 + k || t >= 2 + 2 * k) found[t].low -= room;  // a total index only grows
    };
    constexpr std::size_t usual_changes = 20;  // enough to show how large an input's changes are
    const double any = std::ranges::max(half_steps);
    std::size_t pair = 2 + 2 * k;
    for (std::size_t i = 0; i < k; ++i) {
        const double half_step = steps[i] < usual_changes ? any : half_steps[i];
        if (steps[i] < rows) widen(2 + i, of_last * std::sqrt(2 * half_step));
        if (steps[i] < rows) widen(2 + k + i, half_step);
        for (std::size_t j = i + 1; pair < table.width && j < k; ++j, ++pair)
            if (steps[i] < rows || steps[j] < rows) widen(pair, largest * largest);
    }
}

}  // namespace

Layout find_pick_freeze(const PointSet& design) {
    const std::size_t k = design.dimension();
    const std::size_t n = design.count();
    Layout layout{.trouble =
                      fmt::format("{} rows are not a multiple of {} or {}", n, k + 2, 2 * k + 2)};
    for (const std::size_t group : {k + 2, 2 * k + 2}) {
        if (n == 0 || n % group != 0) continue;
        const std::size_t unfit = first_unfit(design, group);
        if (unfit == n && is_factorial(design, group))
            return {.trouble =
                        "the first and last rows of groups differ in every coordinate, like "
                        "corners of a factorial design; they are not independent samples"};
        if (unfit == n) return {.group = group};
        layout.trouble = fmt::format(
            "in groups of {}, point {} is not the expected mix of the first and last points of its "
            "group",
            group, unfit);
    }
    return layout;
}

Effects pick_freeze(const Layout& layout, const Inputs& inputs, const Response& response,
                    const Setting& setting, const RunContext& run) {
    const std::size_t k = inputs.size();
    const std::size_t group = layout.group;
    const auto complete = complete_groups(response, group, "base rows");
    const auto y = joined(response.y, group, complete);
    if (is_constant(y))
        fail(ErrorKind::input, "the output {} is constant in the {} base rows without failed runs",
             response.name, complete.size());
    const Centred f = centred(y);

    const std::size_t pairs = group == k + 2 ? 0 : k * (k - 1) / 2;
    TermTable table{.terms = {}, .width = 2 + 2 * k + pairs};
    run.need_memory(8.0 * static_cast<double>(complete.size() * table.width), "the bootstrap");
    for (std::size_t at = 0; at < f.z.size(); at += group)
        append_terms(std::span(f.z).subspan(at, group), k, table.terms);
    Setting how = setting;
    std::string no_intervals = no_bootstrap(complete.size(), "base rows", setting);
    if (no_intervals.empty()) no_intervals = rare_row(table, complete, group);
    if (!no_intervals.empty()) how.bootstrap = 0;
    constexpr double caution = 50;
    auto found = bootstrapped(
        table, table.width, [k](auto means, auto values) { indices_of(means, k, values); }, caution,
        how, run);
    if (mostly_equal(y)) allow_for_unseen(found, table, f.z, k, setting.level);
    for (std::size_t i = 0; i < k; ++i)  // a total index is not negative
        found[2 + k + i].low = std::max(found[2 + k + i].low, 0.0);
    Effects effects{.used = f.z.size(),
                    .samples = complete.size(),
                    .mean = f.mean + f.unit * found[0].value,
                    .variance = held(found[1].value * f.unit * f.unit),
                    .kinds = {{"first", part_of(found, 2, k)}, {"total", part_of(found, 2 + k, k)}},
                    .no_intervals = no_intervals};
    std::size_t at = 2 + 2 * k;
    for (std::size_t i = 0; at < found.size(); ++i)
        for (std::size_t j = i + 1; j < k; ++j) effects.pairs.push_back({i, j, found[at++]});
    drop_unlike(effects, f.z, k, found[1].value);
    return effects;
}

}  // namespace stipple::analyzers::sensitivity
