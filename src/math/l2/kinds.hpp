// SPDX-License-Identifier: MIT
//
// The kinds of L2 discrepancy, each by the kernel k that it has on every axis.
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

/// The diaphony's kernel over the second Bernoulli polynomial.
inline constexpr double diaphony = 2 * std::numbers::pi * std::numbers::pi;

/// sum_pq s_pq phi_p(x) phi_q(y) + sigma |x - y| with phi = 1, x, x^2, |x - 1/2|. All coefficients
/// are times 48; those not listed are 0.
struct AxisKernel {
    std::int64_t s00 = 0;
    std::int64_t s01 = 0;  ///< s10 is the same, and so on
    std::int64_t s02 = 0;
    std::int64_t s03 = 0;
    std::int64_t s11 = 0;
    std::int64_t sigma = 0;
    std::array<std::int64_t, 4> mean{};  ///< of k(x, y) over y, in phi(x)
    std::int64_t total = 0;              ///< mean of that
};

struct KindRecord {
    std::string_view name;
    AxisKernel kernel;  ///< k, or k / scale
    double scale = 1;
    bool projections = true;  ///< 1 + k on every axis, not k: all projections count
};

const KindRecord& record_of(Kind kind);

/// Weights of the axes; none: all are 1, and factors are k alone where the kind has no projections.
using AxisWeights = std::vector<double>;

/// Whether factors are k, not 1 + w k.
bool is_kernel_alone(Kind kind, const AxisWeights& weights);

inline double weight_of(const AxisWeights& weights, std::size_t axis) {
    return weights.empty() ? 1 : weights[axis];
}

struct Square {
    double squared;
    double error;  ///< `squared` is off by at most this
};

/// Of words separated by commas, each kind once and in the order of all_kinds; `all` is every kind.
/// @throws Error(usage) naming the first unknown word
std::vector<Kind> parse_kinds(std::string_view words);

}  // namespace stipple::l2
