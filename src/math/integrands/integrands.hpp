// SPDX-License-Identifier: MIT
//
// Test functions with known integrals.
//
//     genz-gaussian:seed=3,difficulty=5
//
// A kind of integrand has a name, typed options and a region of definition. Given a dimension and
// option values, it makes one function with its exact integral.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/options.hpp"

namespace stipple {

enum class Region {
    cube,        ///< [0, 1]^d
    hemisphere,  ///< unit vectors with z >= 0, measured by solid angle
    anywhere,    ///< any domain of finite measure
};

struct Integrand {
    std::function<double(std::span<const double>)> value;

    /// Integral over the region; for `anywhere`, the mean over the region.
    double exact = 0;
};

struct IntegrandKind {
    std::string name;
    std::string summary;
    Region region = Region::cube;
    std::size_t min_dimension = 1;
    std::size_t max_dimension = 10'000;
    Schema options;
    std::function<Integrand(std::size_t dimension, const Values&)> make;
};

/// All kinds, grouped by family.
const std::vector<IntegrandKind>& integrand_kinds();

/// Returns the kind with this name. @throws Error(usage) suggesting the nearest name.
const IntegrandKind& integrand_kind(std::string_view name);

/// Checks the integral of a peak. @throws Error(usage) if float64 cannot hold it: then it cannot hold
/// most values either, and an estimate of 0 would seem to be exact
void require_normal(double exact, std::string_view name, std::size_t dimension);

/// The six families of A. Genz.
std::vector<IntegrandKind> genz_integrands();

/// Indicators in the unit square: disk, half-plane and the visible part of a light.
std::vector<IntegrandKind> planar_integrands();

/// Single formulas: Gaussian, zone plate, Owen, Sobol' g, sky, and the constant `measure`.
std::vector<IntegrandKind> smooth_integrands();

}  // namespace stipple
