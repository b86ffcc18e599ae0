// SPDX-License-Identifier: MIT
#include "generators/lattices/component_search.hpp"

#include <cmath>
#include <numeric>

namespace stipple {

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
    const int exponent = std::ilogb(largest);
    if (largest == 0 || std::abs(exponent) < 64) return;
    for (double& p : p_) p = std::ldexp(p, -exponent);
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
