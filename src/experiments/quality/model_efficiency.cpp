// SPDX-License-Identifier: MIT
#include "experiments/quality/model_efficiency.hpp"

#include <algorithm>
#include <vector>

#include "core/parallel.hpp"
#include "math/functions/cholesky.hpp"
#include "math/functions/exponential.hpp"
#include "math/functions/logarithm.hpp"
#include "math/functions/powers.hpp"

namespace stipple::analyzers {
namespace {

void terms_of(std::span<const double> x, Model model, std::vector<double>& f) {
    f.assign(1, 1);
    f.insert(f.end(), x.begin(), x.end());
    if (model == Model::linear) return;
    for (std::size_t i = 0; i < x.size(); ++i)
        for (std::size_t j = model == Model::quadratic ? i : i + 1; j < x.size(); ++j)
            f.push_back(x[i] * x[j]);
}

/// Lower triangle of the matrix M of model_efficiency.hpp.
std::vector<double> information(std::span<const double> coded, std::size_t dimension, Model model,
                                const RunContext& run) {
    const std::size_t p = model_terms(model, dimension);
    const std::size_t n = coded.size() / dimension;
    std::vector<double> m(p * p);
    std::vector<double> f;
    for (std::size_t i = 0; i < n; ++i) {
        terms_of(coded.subspan(i * dimension, dimension), model, f);
        for (std::size_t a = 0; a < p; ++a)
            for (std::size_t b = 0; b <= a; ++b) m[a * p + b] += f[a] * f[b];
        if (i % 256 == 0) run.check_stop();
    }
    return m;
}

/// Replaces f by L^-1 f, where the elements of f before index `first` are 0; returns the squared
/// length of the result.
double solve(std::span<const double> factor, std::size_t first, std::vector<double>& f) {
    const std::size_t p = f.size();
    double squares = 0;
    for (std::size_t i = first; i < p; ++i) {
        double rest = f[i];
        for (std::size_t j = first; j < i; ++j) rest -= factor[i * p + j] * f[j];
        f[i] = rest / factor[i * p + i];
        squares += f[i] * f[i];
    }
    return squares;
}

double trace_of_inverse(std::span<const double> factor, std::size_t p, const RunContext& run) {
    double trace = 0;
    std::vector<double> column(p);
    for (std::size_t k = 0; k < p; ++k) {
        std::ranges::fill(column, 0.0);
        column[k] = 1;
        trace += solve(factor, k, column);
        run.check_stop();
    }
    return trace;
}

/// Largest f^T M^-1 f over `count` points x; place(i, x) writes the i-th to x.
template <class Place>
double largest_variance(std::span<const double> factor, std::size_t dimension, Model model,
                        std::uint64_t count, const Place& place, const RunContext& run) {
    constexpr std::uint64_t size = 64;
    std::vector<double> largest(block_count(count, size));
    for_each_block(run, count, size, [&](const Block& block) {
        std::vector<double> x(dimension);
        std::vector<double> f;
        for (std::uint64_t i = block.first; i < block.last; ++i) {
            place(i, x);
            terms_of(x, model, f);
            largest[block.index] = std::max(largest[block.index], solve(factor, 0, f));
        }
    });
    return std::ranges::max(largest);
}

}  // namespace

std::size_t model_terms(Model model, std::size_t d) {
    if (model == Model::linear) return 1 + d;
    return 1 + d + d * (d - 1) / 2 + (model == Model::quadratic ? d : 0);
}

Efficiency model_efficiency(std::span<const double> coded, std::size_t dimension, Model model,
                            const RunContext& run) {
    constexpr double most_steps = 2e9;
    const std::size_t d = dimension;
    const std::size_t p = model_terms(model, d);
    const std::uint64_t levels = model == Model::quadratic ? 3 : 2;
    const std::uint64_t grid = saturating_power(levels, d);
    const bool all = static_cast<double>(grid) * static_cast<double>(p * p) < most_steps;
    const char* const places = !all ? "points" : levels == 2 ? "corners" : "grid";
    const Cholesky root = cholesky(information(coded, d, model, run), p);
    if (root.failed != 0) return {.places = places};
    const auto n = static_cast<double>(coded.size() / d);
    const auto terms = static_cast<double>(p);
    double log_determinant = 0;
    for (std::size_t i = 0; i < p; ++i) log_determinant += 2 * logarithm(root.factor[i * p + i]);
    const auto grid_place = [&](std::uint64_t i, std::vector<double>& x) {
        for (double& c : x) {
            c = 2 * static_cast<double>(i % levels) / static_cast<double>(levels - 1) - 1;
            i /= levels;
        }
    };
    const auto own_place = [&](std::uint64_t i, std::vector<double>& x) {
        std::ranges::copy(coded.subspan(i * d, d), x.begin());
    };
    const double variance =
        all ? largest_variance(root.factor, d, model, grid, grid_place, run)
            : largest_variance(root.factor, d, model, coded.size() / d, own_place, run);
    return {.d = exponential(log_determinant / terms) / n,
            .a = terms / (n * trace_of_inverse(root.factor, p, run)),
            .g = terms / (n * variance),
            .places = places};
}

}  // namespace stipple::analyzers
