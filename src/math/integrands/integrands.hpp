// SPDX-License-Identifier: MIT
//
// Functions whose integrals are known, to integrate by points.
//
//     genz-gaussian:seed=3,difficulty=5
//
// A kind of integrand has a name, typed options and the region that it is defined on; for a number
// of dimensions and values of its options it makes one function with its exact integral.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/options.hpp"

namespace stipple {

/// What an integrand is defined on.
enum class Region {
    cube,        ///< [0, 1]^d
    hemisphere,  ///< unit vectors with z >= 0, by solid angle
    anywhere,    ///< any domain whose measure is finite
};

struct Integrand {
    std::function<double(std::span<const double>)> value;

    /// Its integral over the region; `anywhere`: divided by the region's measure.
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

/// All of them, those of a family together.
const std::vector<IntegrandKind>& integrand_kinds();

/// @throws Error(usage) naming the nearest one.
const IntegrandKind& integrand_kind(std::string_view name);

/// The six families of A. Genz.
std::vector<IntegrandKind> genz_integrands();

/// Indicators in the unit square: disk, half-plane and the visible part of a light.
std::vector<IntegrandKind> planar_integrands();

/// One formula each: constant, Gaussian, zone plate, Owen, Sobol' g, sky.
std::vector<IntegrandKind> smooth_integrands();

}  // namespace stipple
