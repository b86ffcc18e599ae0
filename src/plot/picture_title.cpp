// SPDX-License-Identifier: MIT
#include "plot/picture_title.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/spec.hpp"
#include "pipeline/units.hpp"

namespace stipple::plot {
namespace {

bool seed_matters(const Generator& generator, const Provenance& from) {
    try {
        Values values = generator.options.defaults();
        for (const auto& [name, text] : from.options) generator.options.set(values, name, text);
        return uses_seed(generator, values);
    } catch (const Error&) {
        return generator.traits.seeded;  // options of another version
    }
}

/// "owen", "owen:depth=3": random, unlike a warp.
bool is_scramble(const std::string& warp) {
    return scramble_named(warp.substr(0, warp.find_first_of(":@"))) != nullptr;
}

}  // namespace

std::string title_of_points(const PointSet& points, const std::string& source) {
    const Provenance& from = points.provenance;
    if (from.generator.empty())
        return source == "-" || source.empty() ? "points" : source.substr(source.rfind('/') + 1);
    std::string title = from.generator;
    for (const std::string& warp : from.warps) title += ", " + warp;
    return title;
}

std::string subtitle_of_points(const PointSet& points) {
    const Provenance& from = points.provenance;
    std::string text = fmt::format("{} point{}", points.count(), points.count() == 1 ? "" : "s");
    const Generator* generator = generator_named(from.generator);
    if (generator == nullptr) return text;
    if (std::ranges::any_of(from.warps, is_scramble) || seed_matters(*generator, from))
        text += fmt::format(", seed {}", from.seed);
    if (from.start > 0) text += fmt::format(", from index {}", from.start);
    const auto defaults = typed_settings(generator->options.defaults(), generator->options);
    for (const auto& setting : from.options) {
        constexpr std::size_t readable = 40;
        const auto& [name, value] = setting;
        const bool is_default = std::ranges::find(defaults, setting) != defaults.end();
        if (!is_default && value.size() <= readable) text += fmt::format(", {}={}", name, value);
    }
    return text;
}

}  // namespace stipple::plot
