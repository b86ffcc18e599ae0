// SPDX-License-Identifier: MIT
#include "analyzers/discrepancy/axis_places.hpp"

#include "core/large_pages.hpp"

namespace stipple::analyzers {

std::vector<std::uint32_t> places_on_axis(std::vector<Placed>& items, std::vector<double>& values,
                                          const RunContext& run) {
    radix_sort(items, run);
    std::vector<std::uint32_t> places;
    fill_with_zeros(places, items.size());
    std::size_t seen = 0;
    for (const auto& [value, item] : items) {
        if (++seen % 65536 == 0) run.check_stop();
        if (values.empty() || values.back() != value) values.push_back(value);
        places[item] = static_cast<std::uint32_t>(values.size() - 1);
    }
    return places;
}

}  // namespace stipple::analyzers
