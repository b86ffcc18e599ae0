// SPDX-License-Identifier: MIT
//
// Fast component-by-component construction. Let p_i be the product of the factors of all components
// so far, 1 + weight_k omega(...). The next component q minimises
//
//     E(q) = sum_i p_i omega((i q mod modulus) / modulus).
//
// All polynomials i and q except 0 are powers of one of them, as they are the units of a field.
// With i = g^a and q = g^b the sum is a correlation in a and b, which a Fourier transform gives for
// all q at once.
//
// Cost     O(d n log n) time; 70 to 130 n bytes.
// Promise  the same vector on every machine (component_search.hpp).
// Source   J. Baldeaux, J. Dick, G. Leobacher, D. Nuyens, F. Pillichshammer, Numer. Algorithms 59
//          (2012) 403-431, doi:10.1007/s11075-011-9497-y; D. Nuyens, R. Cools, Math. Comp. 75
//          (2006) 903-920, doi:10.1090/S0025-5718-06-01785-6 (for lattices).
#include "generators/lattices/polynomial_search.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

#include "generators/lattices/component_search.hpp"
#include "math/digital/gf2.hpp"

namespace stipple {
namespace {

/// omega(f / modulus) for a polynomial f of degree below m. The point f / modulus is in [2^-t,
/// 2^(1-t)), t = m - deg f.
double omega(std::uint64_t f, int m) {
    return digital_shift_kernel(f == 0 ? 0 : std::ldexp(1, gf2::degree(f) - m));
}

class Search {
  public:
    Search(std::uint64_t modulus, const RunContext& run)
        : run_(run),
          units_(gf2::units(static_cast<std::uint32_t>(modulus))),
          exponents_(units_.size() + 1),
          correlation_({static_cast<int>(units_.size())}),
          products_(units_.size()) {
        for (std::size_t a = 0; a < units_.size(); ++a) {
            exponents_[units_[a]] = static_cast<std::uint32_t>(a);
            kernel_.push_back(omega(units_[a], gf2::degree(modulus)));
        }
        kernel_norm_ =
            std::sqrt(std::inner_product(kernel_.begin(), kernel_.end(), kernel_.begin(), 0.0));
        std::ranges::copy(kernel_, correlation_.values().begin());
        correlation_.take_kernel();
        kernel_.insert(kernel_.end(), kernel_.begin(), kernel_.end());
    }

    void multiply_by(std::uint64_t q, double weight) {
        const double* kernel = kernel_from(q);
        const double one = products_.one();
        for (double& p : products_.all()) {
            const double t = weight * *kernel++;
            p = p * (1 + t) + one * t;
        }
        products_.keep_in_range();
    }

    [[nodiscard]] std::uint64_t next(std::span<const std::uint64_t> vector) {
        const double mean = products_.mean();
        const double rounding = products_.rounding(kernel_norm_);
        std::ranges::transform(products_.all(), correlation_.values().begin(),
                               [&](double p) { return p - mean; });
        correlation_.correlate();
        std::vector<double> error(units_.size() + 1, std::numeric_limits<double>::infinity());
        for (std::uint64_t q = 1; q < error.size(); ++q)
            error[q] = correlation_.values()[exponents_[q]];
        leave_out(vector, error);
        return best_component(
            error.size(), [&](std::uint64_t q) { return error[q]; }, 2 * rounding,
            [&](std::uint64_t q) { return error_by_sum(q, mean); }, 0.1 * rounding);
    }

  private:
    /// omega(g^a q mod modulus) for a = 0, 1, ..., where g generates the units.
    [[nodiscard]] const double* kernel_from(std::uint64_t q) const {
        return kernel_.data() + exponents_[q];
    }

    [[nodiscard]] double error_by_sum(std::uint64_t q, double mean) const {
        run_.check_stop();
        const double* kernel = kernel_from(q);
        double sum = 0;
        for (std::size_t a = 0; a < units_.size(); ++a)
            sum += (products_.all()[a] - mean) * kernel[a];
        return sum;
    }

    const RunContext& run_;
    std::vector<std::uint32_t> units_;      ///< powers of a generator of the units
    std::vector<std::uint32_t> exponents_;  ///< exponent of each unit
    CyclicCorrelation correlation_;
    Products products_;           ///< products p_i, indexed by the exponent of i
    std::vector<double> kernel_;  ///< omega(g^a), for two periods of the exponent a
    double kernel_norm_ = 0;
};

}  // namespace

double digital_shift_kernel(double x) {
    return x == 0 ? 1. / 6 : 1. / 6 - std::ldexp(0.5, std::ilogb(x));
}

double squared_polynomial_error(std::uint64_t modulus, std::span<const std::uint64_t> vector,
                                std::span<const double> weights) {
    const int m = gf2::degree(modulus);
    const auto digits = static_cast<std::size_t>(m);
    constexpr DoubleDouble sixth{1. / 6, 0x1.5555555555555p-57};
    std::vector<DoubleDouble> kernel{sixth};  // omega of 0, then of polynomials of degree 0, 1, ...
    for (int j = 0; j < m; ++j) kernel.push_back(sixth + DoubleDouble{-std::ldexp(0.5, j - m), 0});
    std::vector<DoubleDouble> factors;  // kernel times the weight of each component
    for (const double weight : weights.first(vector.size()))
        for (const DoubleDouble& value : kernel) factors.push_back(value * DoubleDouble{weight, 0});
    std::vector<std::uint64_t> shifted;  // q x^t mod modulus for each component
    for (std::uint64_t q : vector)
        for (int t = 0; t < m; ++t) {
            shifted.push_back(q);
            q = q << 1 ^ ((q >> (m - 1) & 1) != 0 ? modulus : 0);
        }
    std::vector<std::uint64_t> at(vector.size());  // i q mod modulus, by q; i in Gray code order
    const auto terms = [&](std::size_t k, std::uint64_t i, auto high, auto low) {
        for (std::size_t j = 0; j < high.size(); ++j, ++i) {
            if (i > 0) at[k] ^= shifted[k * digits + static_cast<std::size_t>(std::countr_zero(i))];
            const auto width = static_cast<std::size_t>(std::bit_width(at[k]));
            const DoubleDouble& term = factors[k * kernel.size() + width];
            high[j] = term.high;
            low[j] = term.low;
        }
    };
    const DoubleDouble sum = sum_of_excess(0, std::uint64_t{1} << m, vector.size(), terms);
    const double error = std::ldexp(sum.high, -m);
    return std::isfinite(error) ? error : std::numeric_limits<double>::infinity();
}

std::vector<std::uint64_t> polynomial_components(std::uint64_t modulus,
                                                 std::span<const double> weights,
                                                 const RunContext& run) {
    assert(gf2::is_irreducible(modulus) && gf2::degree(modulus) <= largest_searched_degree);
    if (weights.size() == 1) return {1};
    // Bytes a point: 71 to 87 were measured; 127 for transforms of prime length 2^19 - 1.
    run.need_memory(130 * std::ldexp(1, gf2::degree(modulus)), "the search for a vector");
    return grow_vector(Search(modulus, run), weights, run);
}

}  // namespace stipple
