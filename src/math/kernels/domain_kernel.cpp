// SPDX-License-Identifier: MIT
//
// Kernels K(x, y) = prod k(|x_j - y_j|) with their means over a domain of independent coordinates
// Y_j, computed from the distribution functions F_j:
//
//     E k(|x - Y|)  =  integral over t > 0 of -k'(t) (F(x + t) - F(x - t)) dt
//     E E k         =  integral over u of E k(|q(u) - Y|) du,    F(q(u)) = u.
//
// Cost    for one coordinate, about 300 values of F for E k(|x - Y|) and about 10^5 for E E k.
// Promise means have an error of about 1e-11, which rounding() includes.

#include "math/kernels/kernel.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/densities/quadrature.hpp"
#include "math/functions/exponential.hpp"

namespace stipple::kernels {
namespace {

/// Distribution functions F_k of the coordinates of a domain.
class Marginals {
  public:
    /// Scratch space: a point, and its image in the cube.
    struct Place {
        std::vector<double> point;
        std::vector<double> cube;
    };

    explicit Marginals(DomainPtr domain)
        : domain_(std::move(domain)), box_(domain_->bounding_box()) {
        for (std::size_t k = 0; k < box_.dimension(); ++k)
            inside_.push_back(box_.low[k] + 0.5 * box_.extent(k));
        Place place = here();
        for (std::size_t k = 0; k < box_.dimension(); ++k)
            falls_.push_back(of_cube(k, box_.low[k], place) > of_cube(k, box_.high[k], place));
    }

    [[nodiscard]] Place here() const { return {inside_, inside_}; }

    [[nodiscard]] std::size_t count() const { return inside_.size(); }

    /// Returns F_k(x).
    [[nodiscard]] double below(std::size_t k, double x, Place& place) const {
        place.point[k] = x;
        if (!domain_->contains(place.point)) return x < inside_[k] ? 0 : 1;
        const double u = of_cube(k, x, place);
        return falls_[k] ? 1 - u : u;
    }

    /// Returns the x with F_k(x) = u, by bisection.
    [[nodiscard]] double quantile(std::size_t k, double u) const {
        Place place = here();
        double low = box_.low[k];
        double high = box_.high[k];
        for (double step = high - low; below(k, low, place) > u; step *= 2) low -= step;
        for (double step = high - low; below(k, high, place) < u; step *= 2) high += step;
        while (true) {
            const double middle = low + 0.5 * (high - low);
            if (!(low < middle && middle < high)) return low;
            (below(k, middle, place) < u ? low : high) = middle;
        }
    }

    /// Bounds of coordinate k; for an unbounded domain, the bounds that plots use.
    [[nodiscard]] std::array<double, 2> ends(std::size_t k) const {
        return {box_.low[k], box_.high[k]};
    }

  private:
    [[nodiscard]] double of_cube(std::size_t k, double x, Place& place) const {
        place.point[k] = x;
        domain_->to_cube(place.point, place.cube);
        return place.cube[k];
    }

    DomainPtr domain_;
    Box box_;
    std::vector<double> inside_;  ///< a point of the domain; one coordinate at a time is changed
    std::vector<bool> falls_;     ///< true if the cube's coordinate is 1 - F
};

class DomainKernel final : public Kernel {
  public:
    DomainKernel(DomainPtr domain, double bandwidth, std::optional<unsigned> order, RunContext run)
        : kernel_(order ? matern(domain->dimension(), bandwidth, *order)
                        : gaussian(domain->dimension(), bandwidth)),
          marginals_(std::move(domain)),
          order_(order),
          run_(std::move(run)),
          unit_(order ? bandwidth / std::sqrt(2.0 * *order + 1) : bandwidth) {
        for (std::size_t k = 0; k < marginals_.count(); ++k) {
            const Estimate one = total_of(k);
            total_ *= one.value;
            error_ += one.error;
        }
    }

    void fill(const double* y, const Columns& x, std::size_t first, std::size_t count,
              double* values) const override {
        kernel_->fill(y, x, first, count, values);
    }
    double diagonal(const double* x) const override { return kernel_->diagonal(x); }
    double mean(const double* x) const override {
        double product = 1;
        for (std::size_t k = 0; k < marginals_.count(); ++k) product *= mean_of(k, x[k]).value;
        return product;
    }
    double total() const override { return total_; }
    double mean_diagonal() const override { return kernel_->mean_diagonal(); }
    double rounding() const override { return kernel_->rounding() + error_; }

  private:
    static constexpr double fine = 1e-11;

    /// -k'(a) for a distance a in multiples of unit_.
    [[nodiscard]] double falling(double a) const {
        if (!order_) return a * exponential(-0.5 * a * a);
        const double part = *order_ == 0 ? 1 : *order_ == 1 ? a : a * (1 + a) / 3;
        return part * exponential(-a);
    }

    /// E k(|x - Y|) on axis k. Integrates over panels on which the kernel, and usually F, is
    /// smooth; bisects panels with too large an error.
    [[nodiscard]] Estimate mean_of(std::size_t k, double x) const {
        run_.check_stop();
        Marginals::Place place = marginals_.here();
        const auto f = [&](double a) {
            const double t = a * unit_;
            return falling(a) *
                   (marginals_.below(k, x + t, place) - marginals_.below(k, x - t, place));
        };
        std::vector<double> cuts = {1, 2.5, 5, 9, 17, 30};
        for (const double end : marginals_.ends(k)) cuts.push_back(std::abs(end - x) / unit_);
        cuts = ends_of(cuts, 0, order_ ? 48 : 9);
        Estimate sum;
        for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
            Estimate part = gauss_kronrod(f, cuts[i], cuts[i + 1]);
            if (part.error * (cuts[i + 1] - cuts[i]) > fine)
                part = integrate_interval(f, cuts[i], cuts[i + 1], {fine, 100, 3});
            sum += part;
        }
        return sum;
    }

    [[nodiscard]] Estimate total_of(std::size_t k) const {
        double worst = 0;
        Estimate sum = integrate_interval(
            [&](double u) {
                const Estimate mean = mean_of(k, marginals_.quantile(k, u));
                worst = std::max(worst, mean.error);
                return mean.value;
            },
            0, 1, {fine, 100, 3});
        sum.error += worst;
        return sum;
    }

    KernelPtr kernel_;
    Marginals marginals_;
    std::optional<unsigned> order_;
    RunContext run_;
    double unit_;  ///< unit of the distances a in falling()
    double total_ = 1;
    double error_ = 0;  ///< relative error of the means, without rounding errors
};

}  // namespace

bool has_independent_axes(const Domain& domain, std::span<const double> points) {
    const std::size_t d = domain.dimension();
    if (!domain.even() || domain.cube_dimension() != d) return false;
    constexpr std::size_t places = 256;
    constexpr std::size_t most = 65536;
    const Box box = domain.bounding_box();
    const std::size_t count = points.size() / d;
    std::vector<double> moved(d);
    std::vector<double> cube(d);
    std::vector<double> other(d);
    // Moves points along one coordinate at a time: the first 256 to positions spread over the box,
    // the others to the coordinate of the next point.
    for (std::size_t i = 0; i < std::max(places, std::min(count, most)); ++i) {
        const auto point = points.subspan(i % count * d, d);
        domain.to_cube(point, cube);
        for (std::size_t k = 0; k < d; ++k) {
            std::ranges::copy(point, moved.begin());
            const double part = (static_cast<double>(i) + 0.5) / double{places};
            moved[k] =
                i < places ? box.low[k] + part * box.extent(k) : points[(i + 1) % count * d + k];
            if (!domain.contains(moved)) return false;
            domain.to_cube(moved, other);
            for (std::size_t j = 0; j < d; ++j)
                if (j != k && std::abs(cube[j] - other[j]) > 1e-12) return false;
        }
    }
    return true;
}

KernelPtr of_domain(DomainPtr domain, double bandwidth, std::optional<unsigned> order,
                    const RunContext& run) {
    return std::make_unique<DomainKernel>(std::move(domain), bandwidth, order, run);
}

}  // namespace stipple::kernels
