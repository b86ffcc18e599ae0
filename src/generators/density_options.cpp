// SPDX-License-Identifier: MIT
#include "generators/density_options.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "core/rng.hpp"

namespace stipple {

void check_invert(const Values& options) {
    if (options[invert_option] && !options.given(density_option))
        fail(ErrorKind::usage, "--invert: there is no --density to invert");
}

void check_density(const Values& options, std::size_t dimension) {
    check_invert(options);
    if (options.given(density_option) && dimension != 2)
        fail(ErrorKind::usage, "--dimension: {} is not 2, the dimension of a --density", dimension);
}

std::optional<DensityMap> given_density(const Values& options, const RunContext& run) {
    if (options.try_find(density_option.name) == nullptr) return {};
    check_invert(options);
    if (!options.given(density_option)) return {};
    return read_density(options[density_option], options[invert_option], run);
}

double follow(const DensityMap& map, const Box& box, double* point) {
    std::array<double, 2> at{};
    for (std::size_t k = 0; k < 2; ++k)
        at[k] = std::min((point[k] - box.low[k]) / box.extent(k), one_minus_ulp);
    at = map.place(at[0], at[1]);
    for (std::size_t k = 0; k < 2; ++k)
        point[k] =
            std::min(box.low[k] + at[k] * box.extent(k), std::nextafter(box.high[k], box.low[k]));
    return 1 / std::sqrt(map.at(at[0], at[1]));
}

void note_density(const Values& options, PointSet& points) {
    auto& notes = points.provenance.options;
    if (options.given(density_option)) notes.emplace_back("density", options[density_option]);
    if (options[invert_option]) notes.emplace_back("invert", "true");
}

const char* shaping_option(const Values& options) {
    for (const char* name : {"density", "mask", "radius-map"})
        if (const auto* item = options.try_find(name); item != nullptr && item->given) return name;
    return nullptr;
}

}  // namespace stipple
