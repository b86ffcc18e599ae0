// SPDX-License-Identifier: MIT
#include "support/units.hpp"

namespace stipple::testing {

Request points(std::uint64_t count, std::size_t dimension, std::uint64_t start) {
    return {.count = count, .dimension = dimension, .start = start};
}

PointSet make(std::string_view generator, Request request, const Settings& settings,
              const Seeded& seeded) {
    request.seed = seeded.seed;
    return generate(generator, request, settings,
                    {.threads = seeded.threads, .max_memory = seeded.max_memory});
}

PointSet points_of(const std::vector<std::vector<double>>& rows) {
    std::vector<double> flat;
    for (const auto& row : rows) flat.insert(flat.end(), row.begin(), row.end());
    return {std::move(flat), rows.front().size()};
}

double measure(std::string_view analyzer, std::string_view key, const PointSet& points,
               const Settings& settings) {
    return analyze(analyzer, points, settings).number(key);
}

}  // namespace stipple::testing
