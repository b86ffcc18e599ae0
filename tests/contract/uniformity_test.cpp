// SPDX-License-Identifier: MIT
//
// Every registered warp, with each of its methods, under the tests of uniformity: random points are
// uniform on its domain, stratified points are not rejected, and faults are found: biased methods,
// a tilt of 3 % (1 % if STIPPLE_THOROUGH is set), a missing corner, swapped or reflected
// coordinates, a density that is off by 2 %, a point outside.
//
// Seeds are fixed. False alarm: fewer than 300 tests at levels of 1e-6 or 5 standard deviations:
// 5e-4 in all.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/rng.hpp"
#include "core/text.hpp"
#include "pipeline/chain.hpp"
#include "places.hpp"
#include "support/contract.hpp"
#include "support/warping.hpp"

namespace stipple::testing::uniformity_test {
namespace {

const std::size_t many = std::size_t{1} << (thorough() ? 20 : 17);

const Settings strict = {{"level", "1e-6"}};

/// Caches sets, which are the same for all warps of a dimension.
const PointSet& cube_points(const std::string& generator, std::size_t n, std::size_t d) {
    static std::map<std::tuple<std::string, std::size_t, std::size_t>, PointSet> made;
    auto& set = made[{generator, n, d}];
    if (set.count() == 0) set = make(generator, points(n, d));
    return set;
}

std::string verdict(const PointSet& points, const Settings& settings = strict) {
    return analyze("chi-square", points, settings).text("verdict");
}

/// Whether the points are found non-uniform, or outside the domain.
bool rejected(const PointSet& points, const Settings& settings = strict) {
    std::string found = "outside";
    const auto error = error_of([&] { found = verdict(points, settings); });
    EXPECT_TRUE(error.empty() || error.find("outside the domain") != std::string::npos) << error;
    return found == "non-uniform" || !error.empty();
}

/// Whether the method's own density equals that of its domain.
bool is_right(const Mapping& map) {
    const PointSet image = warped(map, cube_points("random", 100, map.cube_dimension()));
    const DomainPtr domain = map.domain();
    for (std::size_t i = 0; i < image.count(); ++i)
        if (std::abs(map.density(image[i]) / domain->density(image[i]) - 1) > 1e-6) return false;
    return true;
}

/// The warp with each choice of its option `method`, or with default options.
std::vector<std::string> specs_of(const Warp& warp) {
    std::vector<std::string> specs;
    for (const Option& option : warp.options.options())
        for (const auto& choice : option.choices)
            if (option.name == "method") specs.push_back(warp.name + ":method=" + choice);
    if (specs.empty()) specs.push_back(warp.name);
    return specs;
}

std::vector<std::string> all_specs() {
    std::vector<std::string> specs;
    for (const Warp& warp : warps::all())
        for (auto& spec : specs_of(warp)) specs.push_back(std::move(spec));
    return specs;
}

std::string spec_name(const ::testing::TestParamInfo<std::string>& info) {
    std::string name = info.param;
    for (char& c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    return name;
}

class Uniformity : public ::testing::TestWithParam<std::string> {
  protected:
    void SetUp() override {
        Spec spec = parse_spec(GetParam());
        const Warp& warp = find_warp(spec.name);
        for (const auto& setting : needed_options(spec.name)) spec.settings.push_back(setting);
        map_ = warp.make(spec.values(warp.options), 2, {});
        in_ = map_->cube_dimension();
    }

    const Mapping& map() const { return *map_; }
    std::size_t in() const { return in_; }
    PointSet image(const std::string& generator, std::size_t n) const {
        return warped(map(), cube_points(generator, n, in_));
    }

  private:
    std::unique_ptr<Mapping> map_;
    std::size_t in_ = 0;
};

/// Number near n that is a d-th power, as for a grid with equally many cells along each axis.
std::size_t power_near(std::size_t n, std::size_t d) {
    const double side = std::pow(static_cast<double>(n), 1 / static_cast<double>(d)) + 1e-9;
    return static_cast<std::size_t>(std::pow(std::floor(side), static_cast<double>(d)) + 0.5);
}

}  // namespace

TEST_P(Uniformity, RandomPointsAreUniformWhereTheMethodIsRight) {
    const PointSet points = image("random", 100'000);
    EXPECT_EQ(verdict(points, {{"level", "1e-6"}, {"shifted", "true"}}),
              is_right(map()) ? "uniform" : "non-uniform");
}

TEST_P(Uniformity, StrataAreNoFault) {
    if (!is_right(map())) GTEST_SKIP();
    EXPECT_NE(verdict(image("jittered", power_near(65'536, in()))), "non-uniform");
    EXPECT_NE(verdict(image("sobol", 65'536)), "non-uniform");
}

// All coordinates of the cube tilted by 3 %: noncentrality 0.3 n t^2 = 35 for each on three cells,
// against a threshold of 24 for one axis and 38 for two. So one axis, and warps that drop points,
// get twice as many. A tilt of 1 % takes 2^20 points, for which every day has no time.
TEST_P(Uniformity, ASmallTiltIsFound) {
    if (!is_right(map())) GTEST_SKIP();
    const double tilt = thorough() ? 0.01 : 0.03;
    PointSet cube = cube_points("random", in() == 1 || map().drops() ? 2 * many : many, in());
    for (double& u : cube.flat()) u *= 1 - tilt + tilt * u;
    EXPECT_TRUE(rejected(warped(map(), cube), {{"level", "1e-5"}, {"cells", "3"}}));
}

// Removes a corner with 1 % of the cube; for methods that drop corners anyway, a block beside its
// middle.
TEST_P(Uniformity, AMissingCornerIsFound) {
    if (!is_right(map())) GTEST_SKIP();
    const PointSet& whole = cube_points("random", 100'000, in());
    // A larger block if other coordinates of the cube partly fill the gap.
    const double share = in() > map().domain()->cube_dimension() ? 0.03 : 0.01;
    const double side = std::pow(share, 1 / static_cast<double>(in()));
    const double low = map().drops() ? 0.6 : 1 - side;
    const auto kept = [&](double u) { return u < low || u >= low + side; };
    std::vector<double> flat;
    for (std::size_t i = 0; i < whole.count(); ++i)
        if (std::ranges::any_of(whole[i], kept))
            flat.insert(flat.end(), whole[i].begin(), whole[i].end());
    EXPECT_TRUE(rejected(warped(map(), PointSet(std::move(flat), in()))));
}

/// Whether moving the points changes the density by more than 20 % for many of them.
template <class Change>
bool changes_density(const PointSet& before, const Change& change) {
    std::size_t different = 0;
    for (std::size_t i = 0; i < 1000; ++i) {
        const double density = before.domain->density(before[i]);
        std::vector<double> point(before[i].begin(), before[i].end());
        change(point);
        const bool inside = before.domain->contains(point);
        different += !inside || std::abs(before.domain->density(point) / density - 1) > 0.2;
    }
    return different > 200;
}

TEST_P(Uniformity, CoordinatesInTheWrongPlaceOrOnTheWrongSideAreFound) {
    if (!is_right(map())) GTEST_SKIP();
    const PointSet right = image("random", 100'000);
    const Box box = right.domain->bounding_box();
    const auto look = [&](const auto& change, const std::string& what) {
        if (!changes_density(right, change)) return;
        PointSet wrong = right;
        for (std::size_t i = 0; i < wrong.count(); ++i) change(wrong[i]);
        EXPECT_TRUE(rejected(wrong)) << what;
    };
    if (right.dimension() > 1) look([](auto&& point) { std::swap(point[0], point[1]); }, "swapped");
    for (std::size_t k = 0; k < right.dimension(); ++k)
        look([&](auto&& point) { point[k] = box.low[k] + (box.high[k] - point[k]); },
             fmt::format("reflected {}", k));
}

/// Bisects from an outside point to an inside point; returns an outside point next to an inside
/// one.
std::vector<double> just_outside(const Domain& domain, std::vector<double> in,
                                 std::vector<double> out) {
    for (int step = 0; step < 2200; ++step) {
        std::vector<double> middle(in.size());
        for (std::size_t k = 0; k < in.size(); ++k) middle[k] = in[k] + 0.5 * (out[k] - in[k]);
        if (middle == in || middle == out) break;
        (domain.contains(middle) ? in : out) = middle;
    }
    return out;
}

TEST_P(Uniformity, OnePointAnUlpOutsideIsFound) {
    PointSet points = image("random", 2000);
    const DomainPtr domain = points.domain;
    std::vector<double> far(points[0].begin(), points[0].end());
    for (double& x : far) x += 1e9;
    if (domain->contains(far)) GTEST_SKIP() << "has no end there";
    const auto at = just_outside(*domain, {points[0].begin(), points[0].end()}, far);
    std::ranges::copy(at, points[points.count() - 1].begin());
    const auto named = fmt::format("1 of {} points are outside the domain", points.count());
    for (const char* analyzer : {"chi-square", "moments"})
        EXPECT_NE(error_of([&] { analyze(analyzer, points); }).find(named), std::string::npos)
            << analyzer;
}

namespace {

struct Mean {
    double value = 0;
    double error = 0;
};

template <class F>
Mean mean_of(std::size_t n, const F& f) {
    double sum = 0, squares = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const double x = f(i);
        sum += x;
        squares += x * x;
    }
    const auto count = static_cast<double>(n);
    const double mean = sum / count;
    return {mean, std::sqrt(std::max(0.0, squares / count - mean * mean) / count)};
}

/// Measure of the part of the domain whose density is at least `least`: the mean of 1 / pdf there
/// over points with that pdf, and the fraction of the box's uniform points that are there.
std::pair<Mean, Mean> measures_above(const Mapping& map, const PointSet& image, double least,
                                     double factor) {
    const Box box = map.domain()->bounding_box();
    const std::size_t d = image.dimension();
    const double volume = volume_of(box);
    const auto& uniform = cube_points("sobol", 1 << 17, d);
    std::vector<double> point(d);
    const Mean box_mean = mean_of(uniform.count(), [&](std::size_t i) {
        for (std::size_t k = 0; k < d; ++k) point[k] = box.low[k] + uniform[i][k] * box.extent(k);
        return map.density(point) >= least ? volume : 0;
    });
    const Mean point_mean = mean_of(image.count(), [&](std::size_t i) {
        const bool inside = std::ranges::equal(image[i], box.low, std::greater_equal<>()) &&
                            std::ranges::equal(image[i], box.high, std::less_equal<>());
        const double pdf = map.density(image[i]);
        return inside && pdf >= least ? 1 / (factor * pdf) : 0;
    });
    return {point_mean, box_mean};
}

}  // namespace

// For domains with as many numbers per point as coordinates: the integral of 1 over regions of high
// density, computed in two ways. For curves and surfaces: the density times the map's Jacobian is
// 1.
TEST_P(Uniformity, DensityIsRightWithinTwoPercent) {
    const std::size_t d = map().domain()->dimension();
    const PointSet points = image("random", 200'000);
    const Domain& domain = *map().domain();
    if (d == in() || d == domain.cube_dimension()) {
        const double volume = volume_of(domain.bounding_box());
        if (domain.measure() > 1.000001 * volume && std::isfinite(domain.measure()))
            GTEST_SKIP() << "no volume: a set of single points";
        std::vector<double> densities;
        for (std::size_t i = 0; i < 1001; ++i) densities.push_back(map().density(points[i]));
        std::ranges::nth_element(densities, densities.begin() + 500);
        const double least = 0.3 * densities[500];
        const auto agree = [&](double factor) {
            const auto [a, b] = measures_above(map(), points, least, factor);
            if (b.value == 0) return true;
            return std::abs(a.value - b.value) <
                   4 * std::sqrt(a.error * a.error + 0.01 * b.error * b.error) + 1e-3 * b.value;
        };
        if (measures_above(map(), points, least, 1).second.value == 0)
            GTEST_SKIP() << "no volume: a set of single points";
        EXPECT_TRUE(agree(1));
        EXPECT_FALSE(agree(1.02)) << "blind";
        return;
    }
    if (!find_warp(parse_spec(GetParam()).name).traits.invertible)
        GTEST_SKIP() << "several points of the cube make the same one";
    std::vector<double> products;
    const PointSet& cube = cube_points("random", 1001, in());
    for (std::size_t i = 0; i < cube.count(); ++i) {
        const auto here = warped(map(), PointSet({cube[i].begin(), cube[i].end()}, in()));
        if (here.count() == 1)
            products.push_back(map().density(here[0]) *
                               stretch_at(map(), {cube[i].begin(), cube[i].end()}, 1e-6));
    }
    const double kept = static_cast<double>(products.size()) / static_cast<double>(cube.count());
    const auto middle = products.begin() + static_cast<std::ptrdiff_t>(products.size() / 2);
    std::ranges::nth_element(products, middle);
    EXPECT_NEAR(*middle * kept, 1, kept < 1 ? 0.1 : 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Registry, Uniformity, ::testing::ValuesIn(all_specs()), spec_name);

}  // namespace stipple::testing::uniformity_test
