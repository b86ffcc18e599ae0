// SPDX-License-Identifier: MIT
#include "generators/density_options.hpp"

#include "core/error.hpp"

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
