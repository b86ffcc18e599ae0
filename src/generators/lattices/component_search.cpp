// SPDX-License-Identifier: MIT
#include "generators/lattices/component_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/machine/wide.hpp"

namespace stipple {
namespace {

/// Multiplies each 1 + p by 1 + t.
STIPPLE_WIDE void grow(const double* t_high, const double* t_low, std::size_t count, double* p_high,
                       double* p_low) {
    for (std::size_t j = 0; j < count; ++j) {
        const DoubleDouble both = split_product(p_high[j], t_high[j]);
        const DoubleDouble sum = exact_sum(p_high[j], t_high[j]);
        const DoubleDouble all = exact_sum(sum.high, both.high);
        const double low = (sum.low + all.low) + (p_low[j] + t_low[j]) +
                           (both.low + (p_high[j] * t_low[j] + p_low[j] * t_high[j]));
        const DoubleDouble result = exact_sum(all.high, low);
        p_high[j] = result.high;
        p_low[j] = result.low;
    }
}

}  // namespace

DoubleDouble sum_of_excess(std::uint64_t first, std::uint64_t last, std::size_t dimension,
                           const LatticeTerms& terms) {
    constexpr std::size_t at_once = 1024;
    std::array<std::array<double, at_once>, 4> rows;
    DoubleDouble sum;
    for (; first < last; first += at_once) {
        const std::size_t count = std::min<std::uint64_t>(at_once, last - first);
        rows[0] = rows[1] = {};
        for (std::size_t k = 0; k < dimension; ++k) {
            terms(k, first, std::span(rows[2]).first(count), std::span(rows[3]).first(count));
            grow(rows[2].data(), rows[3].data(), count, rows[0].data(), rows[1].data());
        }
        for (std::size_t j = 0; j < count; ++j) sum = sum + DoubleDouble{rows[0][j], rows[1][j]};
    }
    return sum;
}

void search_tick(const RunContext& run, std::uint64_t done, std::uint64_t total) {
    run.check_stop();
    if (run.progress) run.progress(0.99 * static_cast<double>(done) / static_cast<double>(total));
}

CyclicCorrelation::CyclicCorrelation(const std::vector<int>& shape) {
    for (const int order : shape) size_ *= static_cast<std::size_t>(order);
    const auto last = static_cast<std::size_t>(shape.back());
    halves_ = size_ / last * (last / 2 + 1);
    values_ = GridCells(size_);
    spectrum_ = GridCells(2 * halves_);
    kernel_ = GridCells(2 * halves_);
    transform_.emplace(shape, values_.get(), spectrum_.get());
}

void CyclicCorrelation::take_kernel() {
    transform_->forward();
    for (std::size_t k = 0; k < 2 * halves_; ++k)
        kernel_[k] = spectrum_[k] / static_cast<double>(size_);
}

void CyclicCorrelation::correlate() {
    transform_->forward();
    // Product of the conjugate spectrum and that of the kernel.
    for (std::size_t k = 0; k < halves_; ++k) {
        const double re = spectrum_[2 * k];
        const double im = spectrum_[2 * k + 1];
        const double kernel_re = kernel_[2 * k];
        const double kernel_im = kernel_[2 * k + 1];
        spectrum_[2 * k] = re * kernel_re + im * kernel_im;
        spectrum_[2 * k + 1] = re * kernel_im - im * kernel_re;
    }
    transform_->backward();
}

void Products::keep_in_range() {
    double largest = 0;
    for (const double p : p_) largest = std::max(largest, std::abs(p));
    if (one_ > 0 && 4 * largest > one_) {
        for (double& p : p_) p += one_;
        largest += one_;
        one_ = 0;
    }
    const int exponent = std::max(std::ilogb(largest), std::ilogb(std::max(one_, 1.0)) - 1000);
    if (largest == 0 || std::abs(exponent) < 64) return;
    for (double& p : p_) p = std::ldexp(p, -exponent);
    one_ = std::ldexp(one_, -exponent);
}

double Products::mean() const {
    return std::accumulate(p_.begin(), p_.end(), 0.0) / static_cast<double>(p_.size());
}

double Products::rounding(double kernel_norm) const {
    const double center = mean();
    double square = 0;
    for (const double p : p_) square += (p - center) * (p - center);
    return 1e-13 * std::sqrt(square) * kernel_norm;
}

}  // namespace stipple
