// SPDX-License-Identifier: MIT
//
// Picture of a unit's points for its help, drawn with characters.
#include <optional>

#include "cli/verbs.hpp"
#include "core/error.hpp"
#include "pipeline/generated.hpp"
#include "pipeline/units.hpp"
#include "plot/text_picture.hpp"

namespace stipple::cli {
namespace {

/// Points of a generator with default options, or their image under a warp; nullopt if an option
/// without a default is needed.
std::optional<PointSet> sample_of(const char* generator, std::uint64_t count, std::size_t dimension,
                                  std::vector<Spec> warps) {
    const Generator& made_by = find_generator(generator);
    try {
        return GeneratedSets({.generator = &made_by,
                              .options = quick_options(made_by),
                              .request = {.count = count, .dimension = dimension},
                              .warps = std::move(warps)},
                             {})
            .made(0, {});
    } catch (const Error&) {
        return std::nullopt;
    }
}

}  // namespace

std::string picture_in_letters(Verb verb, const UnitInfo& unit) {
    std::optional<PointSet> points;
    if (verb == Verb::generate) points = sample_of(unit.name.c_str(), 256, 2, {});
    if (verb == Verb::warp && scramble_named(unit.name) == nullptr)
        for (std::size_t d = 1; d <= 3 && !points; ++d)
            points = sample_of("jittered", d == 3 ? 1000 : 900, d, {parse_spec(unit.name)});
    if (!points) return {};
    plot::PointsPicture picture{.sets = {&*points}, .names = {unit.name}};
    return plot::points_as_text(picture, {.columns = 48, .rows = 24});
}

}  // namespace stipple::cli
