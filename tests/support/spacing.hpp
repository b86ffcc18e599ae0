// SPDX-License-Identifier: MIT
//
// Distances in a box by their definition, for sets with a minimum distance.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/text.hpp"
#include "support/units.hpp"

namespace stipple::testing {

struct Space {
    Box box;
    bool torus;

    [[nodiscard]] std::string name() const {
        return format_box(box) + (torus ? " torus" : " bounded");
    }
};

/// Squares, cubes and lines, odd proportions, thin boxes, boxes far from the origin; torus and
/// bounded.
inline std::vector<Space> some_spaces() {
    std::vector<Space> all;
    for (const bool torus : {true, false})
        for (const Box& box : std::vector<Box>{{{0, 0}, {1, 1}},
                                               {{0}, {1}},
                                               {{-7, 3}, {6.3, 4.1}},
                                               {{1e6, -5}, {1e6 + 9, 8}},
                                               {{0, 0}, {90, 0.01}},
                                               {{-9, 1, 2}, {8, 1.3, 5.7}},
                                               {{0, 0, 0, 0}, {1, 1, 1, 1}}})
            all.push_back({box, torus});
    return all;
}

/// Points of a generator in that space.
PointSet make_in(const std::string& generator, const Space& space,
                 std::optional<std::uint64_t> count, const Settings& settings = {},
                 std::uint64_t seed = 1);

/// Oracle: the distance by its definition.
inline double distance(std::span<const double> p, std::span<const double> q, const Space& space) {
    double sum = 0;
    for (std::size_t k = 0; k < p.size(); ++k) {
        double d = std::abs(p[k] - q[k]);
        if (space.torus) d = std::min(d, (space.box.high[k] - space.box.low[k]) - d);
        sum += d * d;
    }
    return std::sqrt(sum);
}

/// Distance from point i to the nearest point with a lower index.
inline double distance_to_earlier(const PointSet& set, std::size_t i, const Space& space) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < i; ++j) least = std::min(least, distance(set[i], set[j], space));
    return least;
}

inline double smallest_distance(const PointSet& set, const Space& space) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < set.count(); ++i)
        least = std::min(least, distance_to_earlier(set, i, space));
    return least;
}

inline void expect_inside(const PointSet& set, const Space& space) {
    for (std::size_t i = 0; i < set.count(); ++i)
        for (std::size_t k = 0; k < set.dimension(); ++k)
            EXPECT_TRUE(set[i][k] >= space.box.low[k] && set[i][k] < space.box.high[k])
                << space.name();
}

/// A number that the generator computed and stored in the provenance.
inline double noted(const PointSet& set, std::string_view option) {
    for (const auto& [name, text] : set.provenance.options)
        if (name == option) return parse_number(text).value();
    return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace stipple::testing
