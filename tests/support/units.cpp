// SPDX-License-Identifier: MIT
#include "support/units.hpp"

#include <fstream>
#include <map>
#include <sstream>

#include "core/text.hpp"
#include "places.hpp"

namespace stipple::testing {
namespace {

/// Settings after a unit's name in settings.txt, split at their `=`.
Settings settings_of(const std::string& unit) {
    Settings settings;
    std::ifstream in(STIPPLE_SOURCE_DIR "/tests/contract/settings.txt");
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line);
        std::string word;
        if (!(words >> word) || word != unit) continue;
        while (words >> word) {
            const auto at = word.find('=');
            std::string value = word.substr(at + 1);
            if (value.starts_with("data/") || value.starts_with("tests/"))
                value = STIPPLE_SOURCE_DIR "/" + value;
            settings.emplace_back(word.substr(0, at), value);
        }
    }
    return settings;
}

}  // namespace

Settings needed_options(const std::string& unit) {
    Settings needed = settings_of(unit);
    std::erase_if(needed, [](const auto& setting) {
        return setting.first == "n" || setting.first == "counts";
    });
    return needed;
}

std::uint64_t many_of(const std::string& unit) {
    for (const auto& [name, value] : settings_of(unit))
        if (name == "n") return std::stoull(value);
    return 10'000;
}

std::uint64_t count_of(const std::string& unit, std::uint64_t wanted) {
    std::uint64_t count = wanted;
    for (const auto& [name, value] : settings_of(unit)) {
        if (name != "counts") continue;
        for (const auto listed : split(value, ',')) {
            count = std::stoull(std::string(listed));
            if (count >= wanted) return count;
        }
    }
    return count;
}

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
