// SPDX-License-Identifier: MIT
//
// Positive definite kernels K(x, y), points stored by column so that loops vectorise, and the
// squared discrepancies that kernels define.
//
// Promise the same bits on every machine with IEEE 754 arithmetic, because subsets of points are
//         chosen by kernel values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/domain.hpp"
#include "math/l2/kinds.hpp"
#include "stipple/run.hpp"

namespace stipple::kernels {

/// Points stored by column: all first coordinates, then all second ones, and so on.
class Columns {
  public:
    Columns(std::span<const double> rows, std::size_t width);

    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] std::size_t width() const { return width_; }
    [[nodiscard]] const double* axis(std::size_t k) const { return numbers_.data() + k * count_; }

    /// Copies point i to to[0 .. width - 1].
    void row(std::size_t i, double* to) const {
        for (std::size_t k = 0; k < width_; ++k) to[k] = axis(k)[i];
    }

  private:
    std::size_t count_;
    std::size_t width_;
    std::vector<double> numbers_;
};

/// Maximum number of points in one call of Kernel::fill.
inline constexpr std::size_t tile = 512;

class Kernel {
  public:
    Kernel() = default;
    Kernel(const Kernel&) = delete;
    Kernel& operator=(const Kernel&) = delete;
    virtual ~Kernel() = default;

    /// Sets values[j] = K(y, x_(first + j)) for j < count <= tile.
    virtual void fill(const double* y, const Columns& x, std::size_t first, std::size_t count,
                      double* values) const = 0;

    /// Returns K(x, x).
    [[nodiscard]] virtual double diagonal(const double* x) const = 0;

    /// Mean of K(x, y) for random y of the target: the cube, a domain, or the scores' density.
    [[nodiscard]] virtual double mean(const double* x) const = 0;

    /// Mean of K over both arguments in the target.
    [[nodiscard]] virtual double total() const = 0;

    /// Mean of K(x, x) over the target; 0 if unknown.
    [[nodiscard]] virtual double mean_diagonal() const = 0;

    /// Maximum error of a value, relative to the largest K(x, x).
    [[nodiscard]] virtual double rounding() const = 0;
};

using KernelPtr = std::unique_ptr<const Kernel>;

/// Kernel of the diaphony on the unit cube: prod (1 + 2 pi^2 (1/6 - t + t^2)), t = |x - y|.
KernelPtr periodic(std::size_t dimension);

/// Gaussian kernel exp(-|x - y|^2 / (2 h^2)).
KernelPtr gaussian(std::size_t dimension, double bandwidth);

/// Matern kernel prod p(a) exp(-a), a = sqrt(2 nu) |x - y| / h. Orders 0, 1, 2 have nu = 1/2, 3/2,
/// 5/2 and p(a) = 1, 1 + a, 1 + a + a^2 / 3.
KernelPtr matern(std::size_t dimension, double bandwidth, unsigned order);

/// Kernel of an L2 discrepancy on the unit cube.
KernelPtr of_l2(std::size_t dimension, l2::Kind kind);

/// Langevin Stein kernel; points have d coordinates followed by d scores. See stein.cpp.
KernelPtr stein(std::size_t dimension, double bandwidth);

/// @throws Error(input) if terms of the Stein kernel between the points overflow float64
void require_stein(const Columns& points, std::size_t dimension, double bandwidth);

// Defined in domain_kernel.cpp.

/// True if the domain's coordinates are independent, and each cube coordinate is the distribution
/// function of one of them. Tested by moving the given points along single coordinates.
bool has_independent_axes(const Domain& domain, std::span<const double> points);

/// Gaussian or Matern kernel whose target is a domain with independent axes.
/// @param order nullopt for the Gaussian kernel, otherwise the order of Matern's
KernelPtr of_domain(DomainPtr domain, double bandwidth, std::optional<unsigned> order,
                    const RunContext& run);

// Defined in pair_sums.cpp.

struct SquaredDiscrepancy {
    double squared;
    double error;     ///< bound on the error of `squared` from the rounding of K
    double expected;  ///< for n random points of the target: (mean of K(x,x) - total) / n
};

/// Squared discrepancy of the points from the kernel's target, by mean() and total(). If
/// mean_diagonal() is unknown, `expected` uses the mean K(x, x) of the points.
/// @throws Error(limit) if values are too large for a double
SquaredDiscrepancy squared_from_mean(const Kernel& kernel, const Columns& points,
                                     const RunContext& run);

/// Squared discrepancy of the points from target points. @throws Error(limit) as above
SquaredDiscrepancy squared_from_points(const Kernel& kernel, const Columns& points,
                                       const Columns& target, const RunContext& run);

// Defined in bandwidth.cpp.

struct MedianDistance {
    double value = 0;         ///< mean of the two middle distances if `pairs` is even
    std::uint64_t pairs = 0;  ///< number of pairs used
    bool of_all = true;       ///< false if the pairs are a random sample, always the same
};

/// Median distance between two points of the union of `points` and `others`, from the first
/// `dimension` coordinates. Uses all pairs, or a sample of 2^22 if there are more.
MedianDistance median_distance(const Columns& points, const Columns& others, std::size_t dimension,
                               const RunContext& run = {});

/// Root mean square distance of two uniform points in the unit cube, sqrt(d / 6).
double uniform_distance(std::size_t dimension);

}  // namespace stipple::kernels
