// SPDX-License-Identifier: MIT
//
// Fast component-by-component construction. With p_i, the product of the components so far, the
// next component q has the least
//
//     E(q) = sum_i p_i omega((i q mod modulus) / modulus).
//
// The polynomials i and q other than 0 are the powers of one of them, since they are the units of a
// field, so with i = g^a and q = g^b the sum is a correlation in a and b, which a Fourier transform
// gives for all q at once.
//
// Cost     O(d n log n) time, 60 n bytes.
// Promise  the same vector on every machine: transforms, which round differently on different ones,
//          only nominate; what is within their rounding of the best (of more than 64 such, the
//          smallest 64) is compared by plain sums in a fixed order.
// Source   J. Baldeaux, J. Dick, G. Leobacher, D. Nuyens, F. Pillichshammer, Numer. Algorithms 59
//          (2012) 403-431, doi:10.1007/s11075-011-9497-y; D. Nuyens, R. Cools, Math. Comp. 75
//          (2006) 903-920, doi:10.1090/S0025-5718-06-01785-6 (for lattices).
#include "generators/lattices/polynomial_search.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

#include "generators/lattices/search_progress.hpp"
#include "math/digital/gf2.hpp"
#include "math/fourier/fftw.hpp"

namespace stipple {
namespace {

/// omega(f / modulus) for a polynomial f of degree below m: x is in [2^-t, 2^(1-t)), t = m - deg f.
double omega(std::uint64_t f, int m) {
    return digital_shift_kernel(f == 0 ? 0 : std::ldexp(1, gf2::degree(f) - m));
}

class Search {
  public:
    Search(std::uint64_t modulus, const RunContext& run)
        : run_(run),
          units_(gf2::units(static_cast<std::uint32_t>(modulus))),
          exponents_(units_.size() + 1),
          halves_(units_.size() / 2 + 1),
          line_(fftw_reals(units_.size())),
          spectrum_(fftw_reals(2 * halves_)),
          kernel_spectrum_(fftw_reals(2 * halves_)),
          products_(units_.size(), 1.0) {
        plan();
        for (std::size_t a = 0; a < units_.size(); ++a) {
            exponents_[units_[a]] = static_cast<std::uint32_t>(a);
            kernel_.push_back(omega(units_[a], gf2::degree(modulus)));
        }
        kernel_norm_ =
            std::sqrt(std::inner_product(kernel_.begin(), kernel_.end(), kernel_.begin(), 0.0));
        std::ranges::copy(kernel_, line_.get());
        kernel_.insert(kernel_.end(), kernel_.begin(), kernel_.end());
        fftw_execute(forward_);
        std::copy_n(spectrum_.get(), 2 * halves_, kernel_spectrum_.get());
    }
    Search(const Search&) = delete;
    Search& operator=(const Search&) = delete;
    ~Search() {
        const std::lock_guard lock(fftw_planner());
        fftw_destroy_plan(forward_);
        fftw_destroy_plan(backward_);
    }

    void multiply_by(std::uint64_t q, double weight) {
        const double* kernel = kernel_from(q);
        double largest = 0;
        for (std::size_t a = 0; a < products_.size(); ++a) {
            products_[a] *= 1 + weight * kernel[a];
            largest = std::max(largest, std::abs(products_[a]));
        }
        const int exponent = std::ilogb(largest);
        if (exponent > 64)  // a common factor changes no choice
            for (double& p : products_) p = std::ldexp(p, -exponent);
    }

    [[nodiscard]] std::uint64_t next() {
        const double mean = std::accumulate(products_.begin(), products_.end(), 0.0) /
                            static_cast<double>(products_.size());
        double square = 0;
        for (const double p : products_) square += (p - mean) * (p - mean);
        const double rounding = 1e-13 * std::sqrt(square) * kernel_norm_;
        correlate(mean);
        const double bar =
            *std::min_element(line_.get(), line_.get() + units_.size()) + 2 * rounding;
        std::vector<std::uint64_t> nominees;
        for (std::uint64_t q = 1; q <= units_.size() && nominees.size() < most_nominees; ++q)
            if (line_[exponents_[q]] <= bar) nominees.push_back(q);
        return best_of(nominees, mean, 0.1 * rounding);
    }

  private:
    static constexpr std::size_t most_nominees = 64;

    void plan() {
        const std::lock_guard lock(fftw_planner());
        const int n = static_cast<int>(units_.size());
        forward_ = fftw_plan_dft_r2c_1d(n, line_.get(), as_fftw(spectrum_.get()), FFTW_ESTIMATE);
        backward_ = fftw_plan_dft_c2r_1d(n, as_fftw(spectrum_.get()), line_.get(), FFTW_ESTIMATE);
        if (forward_ == nullptr || backward_ == nullptr) throw std::bad_alloc();
    }

    /// line[b] = sum_a (p_a - mean) kernel[a + b], but for rounding.
    void correlate(double mean) {
        const auto n = static_cast<double>(units_.size());
        for (std::size_t a = 0; a < units_.size(); ++a) line_[a] = (products_[a] - mean) / n;
        fftw_execute(forward_);
        for (std::size_t k = 0; k < halves_; ++k) {  // the conjugate, times the kernel's
            const double re = spectrum_[2 * k];
            const double im = spectrum_[2 * k + 1];
            const double kernel_re = kernel_spectrum_[2 * k];
            const double kernel_im = kernel_spectrum_[2 * k + 1];
            spectrum_[2 * k] = re * kernel_re + im * kernel_im;
            spectrum_[2 * k + 1] = re * kernel_im - im * kernel_re;
        }
        fftw_execute(backward_);
    }

    /// omega of unit a times q for a = 0, 1, ...
    [[nodiscard]] const double* kernel_from(std::uint64_t q) const {
        return kernel_.data() + exponents_[q];
    }

    [[nodiscard]] std::uint64_t best_of(const std::vector<std::uint64_t>& nominees, double mean,
                                        double tie) const {
        if (nominees.size() == 1) return nominees.front();
        std::vector<double> errors;
        for (const std::uint64_t q : nominees) {
            run_.check_stop();
            const double* kernel = kernel_from(q);
            double sum = 0;
            for (std::size_t a = 0; a < products_.size(); ++a)
                sum += (products_[a] - mean) * kernel[a];
            errors.push_back(sum);
        }
        const double bar = *std::ranges::min_element(errors) + tie;
        const auto first = std::ranges::find_if(errors, [&](double e) { return e <= bar; });
        return nominees[static_cast<std::size_t>(first - errors.begin())];
    }

    const RunContext& run_;
    std::vector<std::uint32_t> units_;      ///< powers of a generator
    std::vector<std::uint32_t> exponents_;  ///< of every unit
    std::size_t halves_;                    ///< complex numbers of a real function's spectrum
    FftwReals line_;
    FftwReals spectrum_;
    FftwReals kernel_spectrum_;
    std::vector<double> kernel_;    ///< omega of every power, twice around
    std::vector<double> products_;  ///< p of every power
    double kernel_norm_ = 0;
    fftw_plan forward_ = nullptr;
    fftw_plan backward_ = nullptr;
};

}  // namespace

double digital_shift_kernel(double x) {
    return x == 0 ? 1. / 6 : 1. / 6 - std::ldexp(0.5, std::ilogb(x));
}

double squared_shift_error(std::uint64_t modulus, std::span<const std::uint64_t> vector,
                           std::span<const double> weights) {
    const int m = gf2::degree(modulus);
    const std::uint64_t n = std::uint64_t{1} << m;
    double sum = 0;
    for (std::uint64_t i = 0; i < n; ++i) {
        double product = 1;
        for (std::size_t k = 0; k < vector.size(); ++k)
            product *= 1 + weights[k] * omega(gf2::product(i, vector[k], modulus), m);
        sum += product - 1;
    }
    return sum / static_cast<double>(n);
}

std::vector<std::uint64_t> polynomial_components(std::uint64_t modulus,
                                                 std::span<const double> weights,
                                                 const RunContext& run) {
    assert(gf2::is_irreducible(modulus) && gf2::degree(modulus) <= largest_searched_degree);
    std::vector<std::uint64_t> vector{1};
    if (weights.size() == 1) return vector;
    run.need_memory(60 * std::ldexp(1, gf2::degree(modulus)), "the search for a vector");
    Search search(modulus, run);
    for (std::size_t k = 1; k < weights.size(); ++k) {
        search_tick(run, k, weights.size());
        search.multiply_by(vector.back(), weights[k - 1]);
        vector.push_back(search.next());
    }
    return vector;
}

}  // namespace stipple
