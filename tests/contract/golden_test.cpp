// SPDX-License-Identifier: MIT
//
// Fingerprints in golden.txt of the points that every unit makes, or moves, for given options and
// seeds, so that no change alters users' points unnoticed. A deliberate change raises the unit's
// stream_version; `scripts/golden` rewrites the table. Densities, inverses and moments of warps,
// and reports of analyzers, have fingerprints without a version: they may improve.
//
//     generators halton scramble=owen n=1000 d=2 seed=1 version=1 0123456789abcdef
//     warps disk - n=10000 d=2 seed=1 inverse 0123456789abcdef
//
// Each unit has lines for its default options, and for each flag and each choice of its options.
// Warps and scrambles move points made here by integer arithmetic. The table is the same on every
// machine: scripts/machines.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/bytes/fingerprint.hpp"
#include "core/text.hpp"
#include "pipeline/chain.hpp"
#include "places.hpp"
#include "report/document.hpp"
#include "support/contract.hpp"

namespace stipple::testing::golden_test {
namespace {

constexpr const char* table_path = STIPPLE_SOURCE_DIR "/tests/contract/golden.txt";

/// Settings as in a spec, with file names replaced by "...".
std::string label(const Schema& schema, const Settings& settings) {
    std::vector<std::string> words;
    for (const auto& [name, text] : settings) {
        const auto& option = *std::ranges::find(schema.options(), name, &Option::name);
        words.push_back(name + "=" + (option.type == "file" ? "..." : text));
    }
    return words.empty() ? "-" : join(words, ",");
}

/// The settings that a unit needs, alone and with each flag and each choice added.
std::vector<Settings> variants(const Schema& schema, const Settings& needed) {
    std::vector<Settings> all = {needed};
    for (const Option& option : schema.options()) {
        const auto given = std::ranges::any_of(
            needed, [&](const auto& setting) { return setting.first == option.name; });
        auto words = option.choices;
        if (option.type == "flag" && option.name != "invert") words = {"true"};
        for (const std::string& word : words) {
            if (given || (!option.optional && format_value(option.fallback) == word)) continue;
            all.push_back(needed);
            all.back().emplace_back(option.name, word);
        }
    }
    return all;
}

std::uint64_t fingerprint_of(const std::vector<double>& numbers) {
    return fingerprint(std::span<const double>(numbers));
}
std::uint64_t fingerprint_of(const std::string& text) { return fingerprint(text); }

/// One line of the table with the fingerprint of work()'s result, or "refused".
template <class Work>
std::string line_of(const std::string& key, const Work& work) {
    try {
        return key + " " + format_fingerprint(fingerprint_of(work()));
    } catch (const Error&) {
        return key + " refused";
    }
}
template <class Work>
std::string line_of(const std::string& key, std::uint64_t version, const Work& work) {
    return line_of(key + " version=" + std::to_string(version), work);
}

std::string key_of(const std::string& unit, const std::string& settings, std::uint64_t n,
                   std::size_t d, std::uint64_t seed) {
    std::ostringstream key;
    key << unit << ' ' << settings << " n=" << n << " d=" << d << " seed=" << seed;
    return key.str();
}

std::vector<std::string> lines_of(const Generator& unit) {
    std::vector<std::string> lines;
    const auto& traits = unit.traits;
    const auto add = [&](const Settings& settings, std::uint64_t n, std::size_t wanted,
                         std::uint64_t seed) {
        const std::size_t d = std::clamp(wanted, traits.min_dimension, traits.max_dimension);
        const std::string key =
            key_of("generators " + unit.name, label(unit.options, settings), n, d, seed);
        lines.push_back(line_of(key, unit.stream_version, [&] {
            const PointSet set = make(unit.name, points(n, d), settings, {.seed = seed});
            return std::vector<double>(set.flat().begin(), set.flat().end());
        }));
    };
    const Settings needed = needed_options(unit.name);
    const std::uint64_t many = count_of(unit.name, many_of(unit.name));
    const std::uint64_t some = count_of(unit.name, std::min<std::uint64_t>(many, 1024));
    add(needed, many, 2, 1);
    add(needed, some, 2, 987654321);
    // 729 = 9^3 = 27^2, a count that grids and arrays support.
    if (traits.max_dimension > 2)
        add(needed, traits.sequence ? count_of(unit.name, 729) : 200, 3, 1);
    // Larger sets of fast generators, enough to fill several tiles of space.
    if (traits.max_dimension > 2 && !traits.sequence && many_of(unit.name) > 5000)
        add(needed, 5000, 3, 1);
    for (const Settings& settings : variants(unit.options, needed))
        if (settings != needed) add(settings, some, 2, 3);
    const auto options = unit.options.names();
    if (std::ranges::find(options, "density") == options.end()) return lines;
    Settings dense = needed;
    dense.emplace_back("density", needed_options("image")[0].second);
    add(dense, 200, 2, 4);
    return lines;
}

/// Points independent of all units: multiples of odd numbers modulo 2^53.
std::vector<double> plain_points(std::size_t n, std::size_t d) {
    std::vector<double> rows(n * d);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < d; ++k) {
            const std::uint64_t step = (0x9E3779B97F4A7C15U >> (3 * k)) | 1;
            rows[i * d + k] =
                static_cast<double>((i * step) >> (11 - 3 * std::min<std::size_t>(k, 3)) &
                                    ((std::uint64_t{1} << 53) - 1)) *
                0x1p-53;
        }
    return rows;
}

std::vector<double> moved(const std::string& unit, const Settings& settings, std::size_t n,
                          std::size_t d, std::uint64_t seed) {
    const Spec spec{.name = unit, .coordinates = {}, .settings = settings};
    return WarpChain({&spec, 1}, d, {.seed = seed, .count = n}).forward(plain_points(n, d));
}

std::vector<std::string> lines_of(const Scramble& unit) {
    std::vector<std::string> lines;
    for (const std::uint64_t seed : {std::uint64_t{1}, std::uint64_t{987654321}})
        for (const Settings& settings : variants(unit.options, {})) {
            const std::string key =
                key_of("scrambles " + unit.name, label(unit.options, settings), 10'000, 3, seed);
            lines.push_back(line_of(key, unit.stream_version,
                                    [&] { return moved(unit.name, settings, 10'000, 3, seed); }));
        }
    return lines;
}

std::vector<double> densities_of(const Mapping& map, std::span<const double> image) {
    const std::size_t d = map.domain()->dimension();
    std::vector<double> densities;
    for (std::size_t at = 0; at < image.size(); at += d)
        densities.push_back(map.density(image.subspan(at, d)));
    return densities;
}

std::vector<double> inverse_of(const Mapping& map, std::span<const double> image) {
    std::vector<double> cube(image.size() / map.domain()->dimension() * map.cube_dimension());
    map.inverse(image, cube);
    return cube;
}

std::vector<double> numbers_of(const Moments& moments) {
    std::vector<double> numbers = moments.mean;
    numbers.insert(numbers.end(), moments.covariance.begin(), moments.covariance.end());
    numbers.insert(numbers.end(), moments.skewness.begin(), moments.skewness.end());
    return numbers;
}

std::vector<std::string> lines_of(const Warp& unit) {
    std::vector<std::string> lines;
    for (const Settings& settings : variants(unit.options, needed_options(unit.name))) {
        const Spec spec{.name = unit.name, .coordinates = {}, .settings = settings};
        std::unique_ptr<Mapping> map;
        try {
            map = unit.make(spec.values(unit.options), 2, {});
        } catch (const Error&) {
            map = nullptr;
        }
        const std::size_t d = map ? map->cube_dimension() : 2;
        const std::string key =
            key_of("warps " + unit.name, label(unit.options, settings), 10'000, d, 1);
        std::vector<double> image;
        lines.push_back(line_of(key, unit.stream_version,
                                [&] { return image = moved(unit.name, settings, 10'000, d, 1); }));
        if (image.empty()) continue;
        lines.push_back(line_of(key + " density", [&] { return densities_of(*map, image); }));
        lines.push_back(line_of(key + " inverse", [&] { return inverse_of(*map, image); }));
        if (const auto moments = map->domain()->moments())
            lines.push_back(line_of(key + " moments", [&] { return numbers_of(*moments); }));
    }
    return lines;
}

std::vector<std::string> lines_of(const Analyzer& unit) {
    std::vector<std::string> lines;
    const std::size_t d =
        std::clamp<std::size_t>(2, unit.traits.min_dimension, unit.traits.max_dimension);
    const PointSet set = make("random", points(256, d));
    Settings needed = needed_options(unit.name);
    // FFTW's rounding in fast transforms depends on the processor.
    if (unit.name == "periodogram") needed.emplace_back("method", "direct");
    for (const Settings& settings : variants(unit.options, needed)) {
        const std::string key =
            key_of("analyzers " + unit.name, label(unit.options, settings), set.count(), d, 1);
        lines.push_back(line_of(key, [&] {
            const Spec spec{.name = unit.name, .coordinates = {}, .settings = settings};
            return json_text(json_of(analyze(unit, set, spec.values(unit.options), {})));
        }));
    }
    return lines;
}

/// All units, such as "generators/halton".
std::vector<std::string> all_units() {
    std::vector<std::string> names;
    for (const auto& name : names_of(generators::all())) names.push_back("generators/" + name);
    for (const auto& name : names_of(scrambles::all())) names.push_back("scrambles/" + name);
    for (const auto& name : names_of(warps::all())) names.push_back("warps/" + name);
    for (const auto& name : names_of(analyzers::all())) names.push_back("analyzers/" + name);
    return names;
}

std::vector<std::string> lines_of(const std::string& unit) {
    const auto slash = unit.find('/');
    const std::string name = unit.substr(slash + 1);
    if (unit.starts_with("generators/")) return lines_of(find_generator(name));
    if (unit.starts_with("scrambles/")) return lines_of(*scramble_named(name));
    if (unit.starts_with("analyzers/")) return lines_of(find_analyzer(name));
    return lines_of(find_warp(name));
}

/// Unit of a line, such as "generators/halton".
std::string unit_in(const std::string& line) {
    std::istringstream words(line);
    std::string kind;
    std::string name;
    words >> kind >> name;
    return kind + "/" + name;
}

std::vector<std::string> table() {
    std::ifstream in(table_path);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);)
        if (!line.empty() && line[0] != '#') lines.push_back(line);
    return lines;
}

/// A line without its fingerprint: the unit, options and version.
std::string rules_of(const std::string& line) { return line.substr(0, line.rfind(' ')); }

class Golden : public ::testing::TestWithParam<std::string> {};

TEST_P(Golden, IsTheSameAsEver) {
    if (std::getenv("STIPPLE_GOLDEN") != nullptr) GTEST_SKIP() << "the table is being written";
    std::vector<std::string> expected = table();
    std::erase_if(expected, [](const std::string& line) { return unit_in(line) != GetParam(); });
    EXPECT_EQ(lines_of(GetParam()), expected)
        << "A new unit, or new cases: run scripts/golden. Other points than before, if that is "
           "meant: raise stream_version in the record of "
        << GetParam() << " first; points that no release made: scripts/golden --same-version.";
}

std::string golden_name(const ::testing::TestParamInfo<std::string>& info) {
    std::string name = info.param;
    std::ranges::replace(name, '-', '_');
    std::ranges::replace(name, '/', '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(Units, Golden, ::testing::ValuesIn(all_units()), golden_name);

TEST(GoldenTable, HoldsNoUnitThatIsGone) {
    if (!STIPPLE_EXPERIMENTS) GTEST_SKIP() << "the units of the experiments are left out";
    const auto units = all_units();
    for (const std::string& line : table())
        EXPECT_TRUE(std::ranges::find(units, unit_in(line)) != units.end()) << line;
}

// The fingerprint depends on every bit of every number.
TEST(GoldenTable, TellsPointsApartByOneBit) {
    std::vector<double> rows = moved("owen", {}, 1000, 2, 1);
    const auto before = fingerprint(std::span<const double>(rows));
    rows[777] = std::nextafter(rows[777], 2);
    EXPECT_NE(fingerprint(std::span<const double>(rows)), before);
}

// Not a test: run by scripts/golden.
TEST(GoldenTable, IsWrittenOnDemand) {
    const char* const mode = std::getenv("STIPPLE_GOLDEN");
    if (mode == nullptr) GTEST_SKIP() << "scripts/golden writes the table";
    std::map<std::string, std::string> old;
    for (const std::string& line : table()) old[rules_of(line)] = line;
    std::string text =
        "# Fingerprints (FNV-1a, 64 bits) of what units make, move and find; written by "
        "scripts/golden.\n";
    for (const std::string& unit : all_units())
        for (std::string line : lines_of(unit)) {
            const auto known = old.find(rules_of(line));
            const bool versioned = line.find(" version=") != std::string::npos;
            const bool changed = known != old.end() && known->second != line;
            if (changed && versioned && std::string_view(mode) != "same-version") {
                ADD_FAILURE() << "changed under the same stream_version: " << line;
                line = known->second;
            }
            text += line + "\n";
        }
    std::ofstream(table_path) << text;
}

}  // namespace

}  // namespace stipple::testing::golden_test
