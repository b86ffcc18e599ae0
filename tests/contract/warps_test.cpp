// SPDX-License-Identifier: MIT
//
// Promises of every registered warp, with default options.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/rng.hpp"
#include "core/text.hpp"
#include "pipeline/chain.hpp"
#include "pipeline/pipeline.hpp"
#include "support/contract.hpp"
#include "support/planar.hpp"

namespace stipple::testing::warps_test {
namespace {

/// Default options, and example values for options without a default.
Values options_of(const Warp& unit) {
    return Spec{.name = unit.name, .coordinates = {}, .settings = needed_options(unit.name)}.values(
        unit.options);
}

class EveryWarp : public ::testing::TestWithParam<std::string> {
  protected:
    const Warp& unit = find_warp(GetParam());
    const std::unique_ptr<Mapping> mapping = unit.make(options_of(unit), 2, {});
    const std::size_t in = mapping->cube_dimension();
    const std::size_t out = mapping->domain()->dimension();

    /// Random points, and all combinations of edge values of the cube.
    std::vector<double> cube() const {
        std::vector<double> rows(3000 * in);
        Rng(5).fill(0, rows);
        const std::vector<double> edges = {0, 0x1p-60, 0.25, 0.5, 0.75, one_minus_ulp};
        std::vector<std::size_t> at(in, 0);
        while (true) {
            for (const std::size_t k : at) rows.push_back(edges[k]);
            std::size_t k = 0;
            while (k < in && ++at[k] == edges.size()) at[k++] = 0;
            if (k == in) return rows;
        }
    }
};

TEST_P(EveryWarp, MapsTheWholeCubeIntoItsDomain) {
    const auto rows = cube();
    std::vector<double> image(rows.size() / in * out);
    std::vector<std::uint8_t> keep(rows.size() / in, 1);
    mapping->forward(rows, image, keep);
    for (std::size_t i = 0; i < keep.size(); ++i) {
        if (!keep[i]) continue;
        const auto point = std::span<const double>(image).subspan(i * out, out);
        EXPECT_TRUE(mapping->domain()->contains(point)) << "point " << i;
        // The density may be 0 on the rim, the image of the cube's edges.
        const auto unit_point = std::span<const double>(rows).subspan(i * in, in);
        const bool edge = std::ranges::count(unit_point, 0.0) > 0;
        const double density = mapping->density(point);
        EXPECT_TRUE(density > 0 || (edge && density == 0)) << "point " << i << ": " << density;
    }
}

TEST_P(EveryWarp, StandsAHundredThousandHostilePoints) {
    const std::size_t count = 100'000;
    std::vector<double> rows(count * in), image(count * out);
    const Rng rng(17);
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = hostile_number(rng.bits(i));
    std::vector<std::uint8_t> keep(count, 1);
    mapping->forward(rows, image, keep);
    std::vector<double> cell(mapping->domain()->cube_dimension());
    for (std::size_t i = 0; i < count; ++i) {
        if (!keep[i]) continue;
        const auto point = std::span<const double>(image).subspan(i * out, out);
        ASSERT_TRUE(mapping->domain()->contains(point)) << "point " << i;
        ASSERT_TRUE(mapping->density(point) >= 0) << "point " << i;
        mapping->domain()->to_cube(point, cell);
        for (const double u : cell) ASSERT_TRUE(u >= 0 && u <= 1) << "point " << i << ": " << u;
    }
}

/// Replaces numbers: by one of any size, a small integer, or one next to the original.
class HostileOptions {
  public:
    explicit HostileOptions(std::uint64_t seed) : rng_(seed) {}

    /// Settings for all options with numbers and words; options with file names or formulas are
    /// unchanged.
    Settings settings(const Schema& schema) {
        Settings chosen;
        for (const Option& option : schema.options()) {
            if (next() % 4 == 0) continue;
            if (option.type == "choice")
                chosen.emplace_back(option.name, option.choices[next() % option.choices.size()]);
            else if (option.type == "number" || option.type == "integer")
                chosen.emplace_back(option.name, number_of(option));
            else if (option.type == "numbers" || option.type == "points")
                chosen.emplace_back(option.name, with_other_numbers(format_value(option.fallback)));
        }
        return chosen;
    }

  private:
    std::uint64_t next() { return rng_.bits(at_++); }
    double part() { return to_unit(next()); }

    std::string number_of(const Option& option) {
        double x = option.low + hostile_number(next()) * (option.high - option.low);
        if (!std::isfinite(x) || std::abs(x) < 0x1p-200 || next() % 4 == 0) x = std::abs(number(1));
        if (option.type == "integer") x = std::trunc(std::min(x, 1e3));
        return format_number(std::clamp(x, option.low, option.high));
    }

    double number(double old) {
        const double sign = next() % 2 == 0 ? 1 : -1;
        switch (next() % 8) {
            case 0:
                return sign * std::ldexp(part(), static_cast<int>(next() % 400) - 200);
            case 1:
                return old;
            case 2:
                return old + sign * std::ldexp(part(), -static_cast<int>(next() % 54));
            case 3:
                return last_;
            case 4:
                return last_ + sign * std::ldexp(part(), -static_cast<int>(next() % 54));
            case 5:
                return sign * part();
            default:
                return sign * static_cast<double>(next() % 10);
        }
    }

    std::string with_other_numbers(std::string_view text) {
        std::string out;
        while (!text.empty()) {
            const std::size_t end = std::min(text.find_first_of(", "), text.size());
            last_ = number(std::stod(std::string(text.substr(0, end))));
            out += format_number(last_);
            if (end < text.size()) out += text[end];
            text.remove_prefix(std::min(end + 1, text.size()));
        }
        return out;
    }

    Rng rng_;
    std::uint64_t at_ = 0;
    double last_ = 0;
};

double density_of_image(const Mapping& map, std::span<const double> cube) {
    return map.density(image_of(map, {cube.begin(), cube.end()}));
}

/// Expects images of hostile points to be in the domain with a positive, finite density; at rims
/// and the middle, at least points beside them. Biased methods may have an infinite density.
void expect_keeps_points(const Mapping& map, bool biased, std::size_t count) {
    const PointSet cube = hostile_points(count, map.cube_dimension());
    const std::size_t d = map.domain()->dimension();
    std::vector<double> image(count * d);
    std::vector<std::uint8_t> keep(count, 1);
    map.forward(cube.flat(), image, keep);
    for (std::size_t i = 0; i < count; ++i) {
        if (keep[i] == 0) continue;
        const auto point = std::span<const double>(image).subspan(i * d, d);
        const auto telling = [](double u) { return std::abs(2 * u - std::round(2 * u)) < 0x1p-38; };
        const double density = map.density(point);
        bool right = density > 0 && (std::isfinite(density) || biased);
        if (!right && density >= 0 && std::ranges::any_of(cube[i], telling)) {
            std::vector<double> beside(cube[i].begin(), cube[i].end());
            for (double& u : beside) u += u < 0.75 ? 0x1p-20 : -0x1p-20;
            const double there = density_of_image(map, beside);
            right = there > 0 && std::isfinite(there);
        }
        ASSERT_TRUE(map.domain()->contains(point) && right)
            << "point " << i << ": " << format_number(cube[i].front()) << ", "
            << format_number(cube[i].back()) << ", density " << density;
    }
}

// Tries random options, and skips those that the warp rejects.
TEST_P(EveryWarp, KeepsItsPointsWhateverItsOptions) {
    const Settings needed = needed_options(unit.name);
    HostileOptions hostile(3);
    for (int trial = 0; trial < 150 && !HasFailure(); ++trial) {
        Settings settings = needed;
        for (auto& [name, text] : hostile.settings(unit.options))
            if (std::ranges::find(needed, name, &Settings::value_type::first) == needed.end())
                settings.emplace_back(name, text);
        const Spec spec{.name = unit.name, .coordinates = {}, .settings = settings};
        std::unique_ptr<Mapping> map;
        if (!error_of([&] { map = unit.make(spec.values(unit.options), 2, {}); }).empty()) continue;
        SCOPED_TRACE(format_spec(unit.name, spec.values(unit.options), unit.options));
        expect_keeps_points(*map, unit.traits.biased, trial < 20 ? 500 : 60);
    }
}

TEST_P(EveryWarp, ComesBackWithinRounding) {
    if (!unit.traits.invertible) GTEST_SKIP();
    const auto rows = cube();
    std::vector<double> image(rows.size() / in * out);
    std::vector<std::uint8_t> keep(rows.size() / in, 1);
    mapping->forward(rows, image, keep);
    std::vector<double> back(rows.size());
    mapping->inverse(image, back);
    std::vector<double> again(image.size());
    for (const double x : back) EXPECT_TRUE(x >= 0 && x <= 1) << x;
    mapping->forward(back, again, keep);
    // If an edge of the cube is mapped to one point, the inverse may differ, but its image may not.
    const auto point = [](const std::vector<double>& all, std::size_t i, std::size_t d) {
        return join(std::span(all).subspan(i * d, d), ", ");
    };
    for (std::size_t k = 0; k < image.size(); ++k)
        EXPECT_NEAR(again[k], image[k], 1e-14)
            << "cube (" << point(rows, k / out, in) << "), preimage (" << point(back, k / out, in)
            << ")";
}

// The contract of parse_domain: parsing a domain's spec gives that domain.
TEST_P(EveryWarp, DomainSpecParsesBack) {
    const std::string spec = mapping->domain()->spec();
    EXPECT_EQ(parse_domain(spec, out)->spec(), spec);
}

TEST_P(EveryWarp, CellsAreInTheCube) {
    const auto rows = cube();
    std::vector<double> image(rows.size() / in * out);
    std::vector<std::uint8_t> keep(rows.size() / in, 1);
    mapping->forward(rows, image, keep);
    std::vector<double> coordinates(mapping->domain()->cube_dimension());
    for (std::size_t i = 0; i < keep.size(); ++i) {
        if (!keep[i]) continue;
        mapping->domain()->to_cube(std::span<const double>(image).subspan(i * out, out),
                                   coordinates);
        for (const double u : coordinates) EXPECT_TRUE(u >= 0 && u <= 1) << u;
    }
    EXPECT_EQ(mapping->domain()->cube_axes().size(), coordinates.size());
}

TEST_P(EveryWarp, HasACompleteRecord) {
    expect_complete_record(unit);
    EXPECT_FALSE(unit.strata.empty());
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryWarp, ::testing::ValuesIn(names_of(warps::all())),
                         case_name);

}  // namespace

}  // namespace stipple::testing::warps_test
