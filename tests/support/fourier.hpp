// SPDX-License-Identifier: MIT
//
// Fourier sums of complete point sets, by the fast method and directly.
#pragma once

#include <span>

#include "math/fourier/kaiser_bessel.hpp"
#include "math/fourier/nufft.hpp"

namespace stipple::testing {

inline FourierSums transform(const Nufft& nufft, std::span<const double> rows,
                             const RunContext& run, Planning planning = Planning::estimated) {
    FourierSummation sum(nufft);
    sum.add(rows, run);
    return sum.finish(planning, run);
}

inline FourierSums fourier_sums_directly(std::span<const double> rows, std::size_t dimension,
                                         std::size_t max_frequency, const RunContext& run,
                                         bool weighted = false) {
    DirectSummation sums(dimension, max_frequency, weighted);
    sums.add(rows, run);
    return sums.finish();
}

/// Weight of the j-th grid point by the table's polynomials, at u in [0, 1).
inline double weight_of(const WeightTable& table, std::size_t j, double u) {
    const double scaled = u * static_cast<double>(table.pieces());
    const auto piece = static_cast<std::size_t>(scaled);
    const double t = 2 * (scaled - static_cast<double>(piece)) - 1;
    const std::size_t row = WeightTable::row_of(table.width());
    const double* numbers = table.coefficients() + piece * (table.degree() + 1) * row + j;
    double value = 0;
    for (std::size_t k = 0; k <= table.degree(); ++k) value = value * t + numbers[k * row];
    return value;
}

}  // namespace stipple::testing
