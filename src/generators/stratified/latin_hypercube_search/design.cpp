// SPDX-License-Identifier: MIT
#include "generators/stratified/latin_hypercube_search/design.hpp"

#include <algorithm>
#include <cmath>

namespace stipple::latin_hypercube_search {

Axis even_parts(std::size_t points, Level parts) {
    if (parts == 0) return {};
    Axis axis{.places = std::vector<Level>(points), .parts = parts};
    const auto n = static_cast<std::int64_t>(points);
    const std::int64_t m = parts;
    for (std::int64_t level = 0; level < n; ++level)
        axis.places[static_cast<std::size_t>(level)] =
            static_cast<Level>((n * (2 * (level * m / n) + 1) - m) / (2 * m));
    return axis;
}

Axis parts_by(std::span<const double> outcomes, bool categories) {
    const std::size_t n = outcomes.size();
    Axis axis{.places = std::vector<Level>(n)};
    double same = 0;  // pairs of levels with the same outcome
    for (std::size_t first = 0, last = 0; first < n; first = last) {
        while (last < n && outcomes[last] == outcomes[first]) ++last;
        std::fill(&axis.places[first], &axis.places[first] + (last - first),
                  static_cast<Level>((first + last - 1) / 2));
        ++axis.parts;
        const auto size = static_cast<double>(last - first);
        same += size * (size - 1) / 2;
    }
    const auto count = static_cast<double>(n);
    const double pairs = count * (count - 1) / 2;
    if (categories && axis.parts > 1)
        axis.apart = static_cast<Level>(
            std::min(std::round(count * (count + 1) / 6 * pairs / (pairs - same)), count * count));
    return axis;
}

}  // namespace stipple::latin_hypercube_search
