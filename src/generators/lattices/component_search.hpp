// SPDX-License-Identifier: MIT
//
// Common parts of the searches for a generating vector, component by component. Let p be the
// product of the factors of all components so far. The next component z minimises
//
//     E(z) = sum_a p_a kernel[a + b],    a and b exponents of a point's index and of z
//
// in a product of cyclic groups: a correlation, which Fourier transforms give for all z at once.
// Transforms round differently on different machines, so they only nominate candidates. All
// components that may be the best, given the rounding errors, are compared by plain sums in a fixed
// order.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "math/arithmetic/double_double.hpp"
#include "math/fourier/fft.hpp"
#include "math/fourier/grid_cells.hpp"
#include "stipple/run.hpp"

namespace stipple {

/// Checks for a stop, and reports progress up to 0.99: making the points takes the rest.
void search_tick(const RunContext& run, std::uint64_t done, std::uint64_t total);

/// Correlation with a fixed kernel, by transforms in place.
class CyclicCorrelation {
  public:
    /// @param shape orders of the groups; values whose exponents differ by 1 in the last group are
    /// adjacent
    explicit CyclicCorrelation(const std::vector<int>& shape);

    [[nodiscard]] std::span<double> values() { return {values_.get(), size_}; }

    /// Makes the current values the kernel.
    void take_kernel();

    /// values[b] = sum over a of values[a] kernel[a + b], up to rounding.
    void correlate();

  private:
    std::size_t size_ = 1;
    std::size_t halves_ = 1;  ///< number of complex values in a spectrum
    GridCells values_;
    GridCells spectrum_;
    GridCells kernel_;
    std::optional<GroupTransform> transform_;
};

/// Products p over the components so far, up to a common factor and term, which do not affect
/// choices: p - 1 while all are near 1, so that tiny weights do not vanish beside 1, then p.
class Products {
  public:
    explicit Products(std::size_t count) : p_(count, 0.0) {}

    [[nodiscard]] std::span<double> all() { return p_; }
    [[nodiscard]] std::span<const double> all() const { return p_; }

    /// To multiply product i by 1 + t, replace all()[i] by all()[i] (1 + t) + one() t.
    [[nodiscard]] double one() const { return one_; }

    /// Divides the products by a power of two before they overflow or underflow.
    void keep_in_range();

    [[nodiscard]] double mean() const;

    /// Bound on the rounding errors of E, computed from p - mean by transforms or by plain sums:
    /// 10^-13 times the norm of p - mean times the norm of the kernel.
    [[nodiscard]] double rounding(double kernel_norm) const;

  private:
    std::vector<double> p_;
    double one_ = 1;  ///< what was subtracted from the products
};

/// terms(k, i, high, low) sets high + low to the t_k of points i, i + 1, ...
using LatticeTerms =
    std::function<void(std::size_t, std::uint64_t, std::span<double>, std::span<double>)>;

/// Sum over points first, ..., last - 1 of prod_k (1 + t_k) - 1, in twice the precision of a double,
/// since the terms of good lattices cancel to a part of about n^-2.
DoubleDouble sum_of_excess(std::uint64_t first, std::uint64_t last, std::size_t dimension,
                           const LatticeTerms& terms);

/// First of the components that are best up to rounding.
/// @param end number of candidates, 0 to end - 1
/// @param nearly E of a candidate, with an error below margin / 2; infinite to exclude it
/// @param exact E by a plain sum, with an error below tie / 2
template <class Nearly, class Exact>
std::uint64_t best_component(std::uint64_t end, const Nearly& nearly, double margin,
                             const Exact& exact, double tie) {
    constexpr std::size_t most_nominees = 64;
    double least = std::numeric_limits<double>::infinity();
    for (std::uint64_t z = 0; z < end; ++z) least = std::min(least, nearly(z));
    std::vector<std::uint64_t> nominees;
    for (std::uint64_t z = 0; z < end && nominees.size() < most_nominees; ++z)
        if (nearly(z) <= least + margin) nominees.push_back(z);
    if (nominees.size() == 1) return nominees.front();
    std::vector<double> errors;
    for (const std::uint64_t z : nominees) errors.push_back(exact(z));
    const double bar = std::ranges::min(errors) + tie;
    const auto first = std::ranges::find_if(errors, [&](double error) { return error <= bar; });
    return nominees[static_cast<std::size_t>(first - errors.begin())];
}

/// Gives an infinite E to candidates that occur more often in the vector than others, because equal
/// components make equal coordinates.
inline void leave_out(std::span<const std::uint64_t> vector, std::vector<double>& error) {
    constexpr double never = std::numeric_limits<double>::infinity();
    std::vector<std::size_t> uses(error.size());
    for (const std::uint64_t z : vector)
        if (z < uses.size()) ++uses[z];
    std::size_t least = vector.size();
    for (std::size_t z = 0; z < error.size(); ++z)
        if (error[z] < never) least = std::min(least, uses[z]);
    for (std::size_t z = 0; z < error.size(); ++z)
        if (uses[z] > least) error[z] = never;
}

/// Generating vector with one component per weight: starts with the component 1, and appends the
/// best next component each time.
/// @param search has multiply_by(component, weight) and next(vector so far)
template <class Search>
std::vector<std::uint64_t> grow_vector(Search&& search, std::span<const double> weights,
                                       const RunContext& run) {
    std::vector<std::uint64_t> vector{1};
    for (std::size_t k = 1; k < weights.size(); ++k) {
        search_tick(run, k, weights.size());
        search.multiply_by(vector.back(), weights[k - 1]);
        vector.push_back(search.next(vector));
    }
    return vector;
}

}  // namespace stipple
