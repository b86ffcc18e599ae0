// SPDX-License-Identifier: MIT
//
// Designs of experiments in coded levels.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "support/units.hpp"

namespace stipple::testing {

/// Result of the generator's search under that name; empty if there is none.
inline std::string found_in(const PointSet& points, std::string_view name) {
    for (const auto& [key, value] : points.provenance.found)
        if (key == name) return value;
    return {};
}

/// The design in coded levels, mapped to the box in its provenance.
inline PointSet coded_design(std::string_view generator, Request request,
                             const Settings& settings = {}) {
    const PointSet cube = make(generator, request, settings);
    request.bounds = parse_box(found_in(cube, "coded_bounds"), cube.dimension());
    request.dimension = cube.dimension();
    return generate(generator, request, settings);
}

/// Runs in the usual notation, "+-+ ---", with 0 for the middle level.
inline std::vector<std::string> signs_of(const PointSet& coded) {
    std::vector<std::string> rows;
    for (std::size_t i = 0; i < coded.count(); ++i) {
        std::string row;
        for (const double x : coded[i]) row += x == -1 ? '-' : x == 1 ? '+' : x == 0 ? '0' : '?';
        rows.push_back(row);
    }
    return rows;
}

inline double column_product(const PointSet& coded, std::size_t a, std::size_t b) {
    double sum = 0;
    for (std::size_t i = 0; i < coded.count(); ++i) sum += coded[i][a] * coded[i][b];
    return sum;
}

}  // namespace stipple::testing
