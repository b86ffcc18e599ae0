// SPDX-License-Identifier: MIT
//
// Product weights j^-decay of the coordinates j = 1, ..., d.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace stipple {

inline std::vector<double> decaying_weights(std::int64_t decay, std::size_t dimension) {
    std::vector<double> weights(dimension, 1);
    // Divisions round in the same way on every machine; pow() need not.
    for (std::size_t j = 0; j < dimension; ++j)
        for (std::int64_t e = 0; e < decay; ++e) weights[j] /= static_cast<double>(j + 1);
    return weights;
}

}  // namespace stipple
