// SPDX-License-Identifier: MIT
//
// Kinds of L2 discrepancy, given by their kernel k on every axis.
#pragma once

#include <array>
#include <cstdint>
#include <numbers>
#include <string_view>
#include <vector>

namespace stipple::l2 {

enum class Kind {
    star,
    extreme,
    periodic,
    centered,
    wraparound,
    mixture,
    modified,
    diaphony,
    average,
    symmetric
};

inline constexpr Kind all_kinds[] = {
    Kind::star,    Kind::extreme,  Kind::periodic, Kind::centered, Kind::wraparound,
    Kind::mixture, Kind::modified, Kind::diaphony, Kind::average,  Kind::symmetric};

/// Ratio of the diaphony's kernel to the second Bernoulli polynomial.
inline constexpr double diaphony = 2 * std::numbers::pi * std::numbers::pi;

/// The kernel sum_pq s_pq phi_p(x) phi_q(y) + sigma |x - y| with phi = 1, x, x^2, |x - 1/2|. All
/// coefficients are multiplied by 48; those not listed are 0.
struct AxisKernel {
    std::int64_t s00 = 0;
    std::int64_t s01 = 0;  ///< also s10; likewise s02 is also s20, and s03 is also s30
    std::int64_t s02 = 0;
    std::int64_t s03 = 0;
    std::int64_t s11 = 0;
    std::int64_t sigma = 0;
    std::array<std::int64_t, 4> mean{};  ///< mean of k(x, y) over y, in terms of phi(x)
    std::int64_t total = 0;              ///< mean of k over x and y
};

struct KindRecord {
    std::string_view name;
    AxisKernel kernel;  ///< k, or k / scale
    double scale = 1;
    bool projections = true;  ///< factors are 1 + k instead of k, so that all projections count
};

const KindRecord& record_of(Kind kind);

/// Weights of the axes. If empty, all are 1, and kinds without projections have factors k.
using AxisWeights = std::vector<double>;

/// True if factors are k, false if 1 + w k.
bool is_kernel_alone(Kind kind, const AxisWeights& weights);

inline double weight_of(const AxisWeights& weights, std::size_t axis) {
    return weights.empty() ? 1 : weights[axis];
}

struct Square {
    double squared;
    double error;  ///< bound on the error of `squared`
};

/// Parses kinds separated by commas; `all` is every kind. Returns each once, in the order of
/// all_kinds.
/// @throws Error(usage) naming the first unknown word
std::vector<Kind> parse_kinds(std::string_view words);

}  // namespace stipple::l2
