// SPDX-License-Identifier: MIT
#include "analyzers/shared.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace stipple {

const Sharing* sharing_of(const Analyzer& analyzer) {
    using namespace analyzers;
    static const std::vector<std::pair<std::string, Sharing>> table = {
        {"chi-square", chi_square_sharing()},
        {"kolmogorov-smirnov", kolmogorov_smirnov_sharing()},
        {"moments", moments_sharing()},
        {"periodogram", periodogram_sharing()},
        {"star-discrepancy", star_discrepancy_sharing()}};
    const auto it = std::ranges::find_if(
        table, [&](const auto& entry) { return entry.first == analyzer.name; });
    return it == table.end() ? nullptr : &it->second;
}

}  // namespace stipple
