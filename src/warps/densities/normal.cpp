// SPDX-License-Identifier: MIT
//
// Unit cube onto the whole line, plane or space with a normal distribution of mean m and covariance
// C = L L^T, where L is the lower Cholesky factor:
//
//     x = m + L z,    z_k = Phi^-1(xi_k),    density exp(-|z|^2 / 2) / ((2 pi)^(d/2) det L),
//
// so that x_k depends only on xi_1 ... xi_k. The inverse is z = L^-1 (x - m), xi_k = Phi(z_k). This
// is Rosenblatt's transformation.
//
// Shape   any number of coordinates: those available, or as many as the mean or the covariance has.
// Strata  xi is used directly, not as 1 - xi: small xi is far below the mean. The first and the
//         last stratum are unbounded. 0 is replaced by 2^-54, the middle of the random numbers'
//         step at 0, and 1 by 1 - 2^-55: 8.2924 standard deviations below and 8.3744 above the
//         mean, instead of infinity; a note reports it. Other values below 1e-300 are replaced by
//         1e-300.
// Cost    O(1) a coordinate without a covariance, about 6 ns on one core; O(d) with one.
// Promise a round trip returns the same xi within 1e-14, in the lower tail within a relative 1e-13,
//         or 2e-15 z^2 if z < -7; with a covariance, times the square root of its condition
//         number. Forward map, inverse and density give the same bits on every machine.
// Source  M. Rosenblatt, Annals of Mathematical Statistics 23 (1952) 470-472,
//         doi:10.1214/aoms/1177729394. Phi^-1: Wichura 1988, see
//         math/functions/normal_distribution.hpp.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/domain.hpp"
#include "core/error.hpp"
#include "core/machine/wide.hpp"
#include "math/densities/quadrature.hpp"
#include "math/distributions/families.hpp"
#include "math/functions/cholesky.hpp"
#include "math/functions/exponential.hpp"
#include "math/functions/logarithm.hpp"
#include "math/functions/normal_distribution.hpp"
#include "warps/common_options.hpp"
#include "warps/named_domain.hpp"
#include "warps/warp.hpp"

namespace stipple::warps::normal {
namespace {

constexpr Param<Numbers> mean{{.name = "mean",
                               .fallback = "0",
                               .help = "Mean: one number for all coordinates, or one for each"}};

constexpr Param<Numbers> deviation{
    {.name = "deviation",
     .fallback = "1",
     .help = "Standard deviation, above 0: one number for all coordinates, or one for each"}};

constexpr Param<Numbers> covariance{
    {.name = "covariance",
     .fallback = {},
     .help = "Covariance matrix, instead of deviations: d x d numbers, row after row: 2,1 1,2"}};

/// Mean and lower Cholesky factor; if diagonal, only the factor's diagonal is stored.
struct Shape {
    std::vector<double> mean;
    std::vector<double> factor;

    std::size_t dimension() const { return mean.size(); }
    bool diagonal() const { return factor.size() == mean.size(); }
    double scale(std::size_t k) const { return factor[diagonal() ? k : k * dimension() + k]; }
    double covariance(std::size_t i, std::size_t j) const;
    /// Standard deviation of coordinate k.
    double reach(std::size_t k) const { return std::sqrt(covariance(k, k)); }
};

/// Element (i, j) of L L^T.
double Shape::covariance(std::size_t i, std::size_t j) const {
    if (diagonal()) return i == j ? factor[i] * factor[i] : 0;
    double sum = 0;
    for (std::size_t k = 0; k <= std::min(i, j); ++k)
        sum += factor[i * dimension() + k] * factor[j * dimension() + k];
    return sum;
}

/// Replaces z by m + s z in each row, with a scale s for each coordinate.
STIPPLE_WIDE void spread(const double* middle, const double* scale, std::size_t d,
                         std::span<double> rows) {
    for (std::size_t i = 0; i < rows.size(); i += d)
        for (std::size_t k = 0; k < d; ++k) rows[i + k] = middle[k] + scale[k] * rows[i + k];
}

/// Replaces z by m + L z, in each row from the last coordinate to the first.
STIPPLE_WIDE void mix(const double* middle, const double* factor, std::size_t d,
                      std::span<double> rows) {
    for (std::size_t i = 0; i < rows.size(); i += d)
        for (std::size_t k = d; k-- > 0;) {
            double sum = 0;
            for (std::size_t j = 0; j <= k; ++j) sum += factor[k * d + j] * rows[i + j];
            rows[i + k] = middle[k] + sum;
        }
}

class NormalDomain final : public NamedDomain {
  public:
    NormalDomain(Shape shape, std::string spec)
        : NamedDomain(std::move(spec), shape.dimension(), shape.dimension()),
          shape_(std::move(shape)) {
        for (std::size_t k = 0; k < shape_.dimension(); ++k)
            log_peak_ -= logarithm(shape_.scale(k)) + 0.5 * logarithm(2 * std::numbers::pi);
    }

    double measure() const override { return std::numeric_limits<double>::infinity(); }
    bool contains(std::span<const double> point) const override {
        for (const double x : point)
            if (!std::isfinite(x)) return false;
        return true;
    }

    /// Extends 4 standard deviations to each side of the mean.
    Box bounding_box() const override {
        Box box;
        for (std::size_t k = 0; k < dimension(); ++k) {
            box.low.push_back(shape_.mean[k] - 4 * shape_.reach(k));
            box.high.push_back(shape_.mean[k] + 4 * shape_.reach(k));
        }
        return box;
    }
    double density(std::span<const double> point) const override {
        if (!contains(point)) return 0;
        std::vector<double> z(dimension());
        standardise(point, z);
        double square = 0;
        for (const double x : z) square += x * x;
        const double log = log_peak_ - 0.5 * square;
        return log > 709 ? std::numeric_limits<double>::infinity() : stipple::exponential(log);
    }
    void to_cube(std::span<const double> point, std::span<double> cube) const override {
        standardise(point, cube);
        for (double& x : cube) x = normal_distribution(x);
    }
    std::optional<Estimate> box_mass(const Box& box) const override {
        std::vector<double> z(dimension());
        return mass_from(box, z, 0);
    }
    std::optional<Moments> moments() const override {
        const std::size_t d = dimension();
        Moments m{shape_.mean, std::vector<double>(d * d), std::vector<double>(d)};
        for (std::size_t i = 0; i < d; ++i)
            for (std::size_t j = 0; j < d; ++j) m.covariance[i * d + j] = shape_.covariance(i, j);
        return m;
    }
    std::vector<std::string> cube_axes() const override {
        std::vector<std::string> axes;
        for (std::size_t k = 0; k < dimension(); ++k)
            axes.push_back(k == 0
                               ? "probability below x1"
                               : fmt::format("probability below x{}, given the preceding", k + 1));
        return axes;
    }

    bool infinite(std::span<const double> row) const {
        return std::ranges::any_of(row, [](double u) { return u <= 0 || u >= 1; });
    }
    void from_cube(std::span<const double> cube, std::span<double> image) const {
        std::ranges::copy(cube, image.begin());
        bounded_normal_quantiles(image);
        (shape_.diagonal() ? spread : mix)(shape_.mean.data(), shape_.factor.data(), dimension(),
                                           image);
    }

  private:
    /// Probability of the box in the coordinates k, k + 1, ..., given z_0 ... z_(k-1), the
    /// standardised coordinates before k.
    Estimate mass_from(const Box& box, std::vector<double>& z, std::size_t k) const {
        const std::size_t d = dimension();
        if (k == d) return {1, 0};
        double before = shape_.mean[k];
        for (std::size_t j = 0; j < k && !shape_.diagonal(); ++j)
            before += shape_.factor[k * d + j] * z[j];
        const double low = (box.low[k] - before) / shape_.scale(k);
        const double high = (box.high[k] - before) / shape_.scale(k);
        if (!(low < high)) return {};
        if (shape_.diagonal() || k + 1 == d) {
            const double here = low > 0 ? normal_distribution(-low) - normal_distribution(-high)
                                        : normal_distribution(high) - normal_distribution(low);
            return here * mass_from(box, z, k + 1);
        }
        double inner = 0;
        const auto slice = [&](double x) {
            z[k] = x;
            const Estimate rest = mass_from(box, z, k + 1);
            inner = std::max(inner, rest.error);
            return rest.value * stipple::exponential(-0.5 * x * x) /
                   std::sqrt(2 * std::numbers::pi);
        };
        constexpr double far = 9;  // the probability beyond is 2e-19
        Estimate mass = integrate_smooth(slice, std::max(low, -far), std::min(high, far));
        mass.error += inner;
        return mass;
    }

    /// Computes z = L^-1 (x - m).
    void standardise(std::span<const double> point, std::span<double> z) const {
        const std::size_t d = dimension();
        for (std::size_t k = 0; k < d; ++k) {
            double rest = point[k] - shape_.mean[k];
            for (std::size_t j = 0; j < k && !shape_.diagonal(); ++j)
                rest -= shape_.factor[k * d + j] * z[j];
            z[k] = rest / shape_.scale(k);
        }
    }

    Shape shape_;
    double log_peak_ = 0;
};

std::vector<double> deviations_of(const Values& options, std::size_t d) {
    const auto numbers = one_for_each(deviation, options[deviation], d);
    for (const double s : numbers)
        if (!(s >= 1e-150 && s <= 1e150))
            fail(ErrorKind::usage, "--deviation: {} is outside [1e-150, 1e+150]", s);
    return numbers;
}

/// Lower Cholesky factor of --covariance. @throws Error(usage) that names the defect of the matrix
std::vector<double> factor_of(const std::vector<double>& matrix, std::size_t d) {
    if (matrix.size() != d * d)
        fail(ErrorKind::usage, "--covariance: expected {} x {} numbers, row after row; {} given", d,
             d, matrix.size());
    for (std::size_t i = 0; i < d; ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (matrix[i * d + j] != matrix[j * d + i])
                fail(ErrorKind::usage,
                     "--covariance: not symmetric: row {} has {}, but row {} has {}", j + 1,
                     matrix[j * d + i], i + 1, matrix[i * d + j]);
    for (const double x : matrix)
        if (std::abs(x) > 1e300)
            fail(ErrorKind::usage, "--covariance: {} is outside [-1e300, 1e300]", x);
    auto found = cholesky(matrix, d);
    if (found.failed > 0)
        fail(ErrorKind::usage,
             "--covariance: not positive definite: its leading {} x {} minor is {:.6g}",
             found.failed, found.failed, found.minor);
    return std::move(found.factor);
}

std::size_t root_of(std::size_t n) {
    std::size_t d = 1;
    while (d * d < n) ++d;
    return d;
}

std::unique_ptr<Mapping> make(const WarpRequest& want) {
    const bool correlated = want.options.given(covariance);
    if (correlated && want.options.given(deviation))
        fail(ErrorKind::usage,
             "--deviation: cannot be combined with --covariance; give one of them");
    const std::vector<double> matrix = want.options[covariance];
    std::size_t d = want.given;
    if (want.options[deviation].size() > 1) d = want.options[deviation].size();
    if (matrix.size() > 1) d = root_of(matrix.size());
    if (want.options[mean].size() > 1) d = want.options[mean].size();
    Shape shape{.mean = one_for_each(mean, want.options[mean], d),
                .factor = correlated ? factor_of(matrix, d) : deviations_of(want.options, d)};
    for (double& m : shape.mean) m += 0.0;  // + 0.0 avoids -0 in the points
    for (std::size_t k = 0; k < d; ++k)
        require_resolved("--", "mean", shape.mean[k], "deviation", shape.reach(k));
    return domain_mapping<NormalDomain>(std::move(shape), want.spec());
}

}  // namespace

Warp unit() {
    return {.name = "normal",
            .summary = "Normal distribution with any mean and covariance, by inversion",
            .source = "Rosenblatt 1952, doi:10.1214/aoms/1177729394; quantiles: Wichura 1988",
            .related = {"box-muller", "gauss"},
            .strata =
                "xi_k is the probability below x_k given the preceding coordinates, used directly: "
                "small xi is far below the mean",
            .options = Schema(mean, deviation, covariance),
            .aliases = {"gaussian"},
            .mapping = make};
}

}  // namespace stipple::warps::normal
