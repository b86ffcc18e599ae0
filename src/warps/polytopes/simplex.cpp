// SPDX-License-Identifier: MIT
//
// Unit cube onto the simplex of all points x >= 0 with x_1 + ... + x_d <= s, uniformly, by
// Rosenblatt's transformation. With the remainder r_k = s - x_1 - ... - x_k-1,
//
//     x_k = r_k (1 - (1 - xi_k)^(1 / m)),    xi_k = 1 - (1 - x_k / r_k)^m,    m = d - k + 1.
//
// Shape   any number of coordinates for which s^d / d! is in [1e-300, 1e300]: up to 166 for s = 1.
// Strata  xi_k is the probability below x_k given the preceding coordinates, used directly.
// Cost    O(1) a coordinate, with one logarithm and one exponential; about 6 ns on one core.
// Promise x in the simplex, up to d 2^-52 s. A round trip returns the same xi within 1e-14 times s
//         / r_k. The same bits on every machine.
// Source  M. Rosenblatt, Annals of Mathematical Statistics 23 (1952) 470-472,
//         doi:10.1214/aoms/1177729394.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/machine/wide.hpp"
#include "core/rng.hpp"
#include "math/functions/exponential.hpp"
#include "math/functions/logarithm.hpp"
#include "warps/common_options.hpp"
#include "warps/named_domain.hpp"
#include "warps/warp.hpp"

namespace stipple::warps::simplex {
namespace {

constexpr double rounding = 2 * std::numeric_limits<double>::epsilon();

constexpr auto bound = length_option("bound", 1, "Upper bound of the sum of coordinates, above 0");

constexpr std::size_t some_rows = 256;

/// Subtracts a coordinate from the remainder of each row; `left` is the number of coordinates not
/// yet made. xi = 1 takes the whole remainder for the last coordinate; for others xi = 1 is
/// replaced by the largest number below 1.
STIPPLE_WIDE [[gnu::flatten]] void break_off(double* x, double* rest, double left,
                                             std::size_t rows) {
    const double share = 1 / left;
    for (std::size_t i = 0; i < rows; ++i) {
        const double loss = exp_minus_1(share * log_1p(-std::min(x[i], one_minus_ulp)));
        const double part = left == 1 ? x[i] : 0.0 - loss;
        x[i] = rest[i] * part;
        rest[i] += rest[i] * loss;
    }
}

class SimplexDomain final : public NamedDomain {
  public:
    SimplexDomain(double most, std::size_t d, std::string spec)
        : NamedDomain(std::move(spec), d, d), bound_(most) {
        for (std::size_t k = 1; k <= d; ++k) volume_ *= bound_ / static_cast<double>(k);
        if (!(volume_ > 1e-300 && volume_ < 1e300))
            fail(ErrorKind::usage,
                 "--bound: in {} dimensions the volume is {:.3g}; expected [1e-300, 1e+300]", d,
                 volume_);
    }

    double measure() const override { return volume_; }
    bool contains(std::span<const double> point) const override {
        double sum = 0;
        for (const double x : point) {
            if (!(x >= 0)) return false;
            sum += x;
        }
        return sum <= bound_ * (1 + static_cast<double>(dimension()) * rounding);
    }
    Box bounding_box() const override {
        return {std::vector<double>(dimension(), 0), std::vector<double>(dimension(), bound_)};
    }
    void to_cube(std::span<const double> point, std::span<double> cube) const override {
        double rest = bound_;
        for (std::size_t k = 0; k < point.size(); ++k) {
            const auto left = static_cast<double>(point.size() - k);
            const double share = rest > 0 ? std::min(point[k] / rest, 1.0) : 0;
            cube[k] = share < 1 ? 0.0 - exp_minus_1(left * log_1p(-share)) : 1;
            rest -= point[k];
        }
    }
    /// Moments of Dirichlet's distribution with d + 1 parameters equal to 1.
    std::optional<Moments> moments() const override {
        const std::size_t d = dimension();
        const auto n = static_cast<double>(d);
        const double unit = bound_ * bound_ / ((n + 1) * (n + 1) * (n + 2));
        const double skewness = 2 * (n - 1) * std::sqrt(n + 2) / ((n + 3) * std::sqrt(n));
        Moments m{std::vector<double>(d, bound_ / (n + 1)), std::vector<double>(d * d, -unit),
                  std::vector<double>(d, skewness)};
        for (std::size_t k = 0; k < d; ++k) m.covariance[k * d + k] = n * unit;
        return m;
    }
    std::vector<std::string> cube_axes() const override {
        std::vector<std::string> axes{"probability below x1"};
        for (std::size_t k = 2; k <= dimension(); ++k)
            axes.push_back(fmt::format("probability below x{}, given the preceding", k));
        return axes;
    }

    void from_cube(std::span<const double> cube, std::span<double> image) const {
        const std::size_t d = dimension();
        std::array<double, some_rows> column, rest;
        for (std::size_t first = 0; first < cube.size() / d; first += some_rows) {
            const std::size_t rows = std::min(some_rows, cube.size() / d - first);
            rest.fill(bound_);
            for (std::size_t k = 0; k < d; ++k) {
                for (std::size_t i = 0; i < rows; ++i) column[i] = cube[(first + i) * d + k];
                break_off(column.data(), rest.data(), static_cast<double>(d - k), rows);
                for (std::size_t i = 0; i < rows; ++i) image[(first + i) * d + k] = column[i];
            }
        }
    }

  private:
    double bound_;
    double volume_ = 1;
};

std::unique_ptr<Mapping> make(const WarpRequest& want) {
    return domain_mapping<SimplexDomain>(want.options[bound], want.given, want.spec());
}

}  // namespace

Warp unit() {
    return {.name = "simplex",
            .summary = "Simplex x >= 0, x1 + ... + xd <= bound, in any dimension",
            .source = "Rosenblatt 1952, doi:10.1214/aoms/1177729394",
            .related = {"mixture-design", "barycentric", "tetrahedron"},
            .strata =
                "xi_k is the probability below x_k given the preceding coordinates; it is used "
                "directly",
            .options = Schema(bound),
            .mapping = make};
}

}  // namespace stipple::warps::simplex
