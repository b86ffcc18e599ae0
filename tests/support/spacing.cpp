// SPDX-License-Identifier: MIT
#include "support/spacing.hpp"

namespace stipple::testing {

PointSet make_in(const std::string& generator, const Space& space,
                 std::optional<std::uint64_t> count, const Settings& settings, std::uint64_t seed) {
    Settings all = settings;
    all.emplace_back(space.torus ? "torus" : "bounded", "true");
    Request request{.count = count, .dimension = space.box.dimension()};
    request.bounds = space.box;
    return make(generator, request, all, {.seed = seed});
}

}  // namespace stipple::testing
