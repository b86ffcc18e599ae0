// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <map>
#include <numbers>
#include <utility>

#include "analyzers/rings.hpp"
#include "core/rng.hpp"
#include "pipeline/chain.hpp"
#include "support/fourier.hpp"
#include "support/units.hpp"

namespace stipple::testing::periodogram_test {
namespace {

const Grid& grid_of(const Report& report) { return std::get<Grid>(*report.find("grid")); }

const Report::Integers& cells_of(const Report& report) {
    return std::get<Report::Integers>(*report.find("radial.cells"));
}

bool flag(const Report& report, std::string_view key) { return std::get<bool>(*report.find(key)); }

/// Power at (f0, f1).
double power_at(const Report& report, std::int64_t f0, std::int64_t f1 = 0) {
    const Grid& grid = grid_of(report);
    const auto last = static_cast<std::int64_t>(grid.columns / 2);
    const std::int64_t row = grid.rows == 1 ? 0 : f1 + last;
    return grid.values[static_cast<std::size_t>(row * (2 * last + 1) + f0 + last)];
}

Report spectrum(const PointSet& set, const Settings& settings = {}, const RunContext& run = {}) {
    return analyze("periodogram", set, settings, run);
}

PointSet corner_grid(int k) {
    std::vector<std::vector<double>> rows;
    for (int i = 0; i < k; ++i)
        for (int j = 0; j < k; ++j) rows.push_back({double(i) / k, double(j) / k});
    return points_of(rows);
}

PointSet jittered_grid(int m, std::uint64_t seed) {
    const Rng rng(seed);
    PointSet set = corner_grid(m);
    auto flat = set.flat();
    for (std::size_t i = 0; i < flat.size(); ++i) flat[i] += rng.uniform(i) / m;
    return set;
}

double sinc(double x) {
    const double y = std::numbers::pi * x;
    return x == 0 ? 1 : std::sin(y) / y;
}

/// Mean of reports like on the command line: numbers, curves and grids, then refine.
Report mean_of(const std::vector<Report>& reports) {
    Report mean = reports.front();
    Grid grid = grid_of(mean);
    for (std::size_t r = 1; r < reports.size(); ++r)
        for (std::size_t i = 0; i < grid.values.size(); ++i)
            grid.values[i] += grid_of(reports[r]).values[i];
    for (double& p : grid.values) p /= static_cast<double>(reports.size());
    mean.add("grid", std::move(grid));
    const Analyzer& unit = find_analyzer("periodogram");
    unit.refine(mean, reports.size(), unit.options.defaults());
    return mean;
}

}  // namespace

// One point has |exp(i phi)|^2 = 1, but a set needs two. So two points at the same position: |2
// exp(i phi)|^2 / 2 = 2; and the sums themselves for one.
TEST(Periodogram, PointsInOnePlaceHaveTheirNumberAsPowerEverywhere) {
    for (const std::string method : {"nufft", "direct"})
        for (const auto& row : std::vector<std::vector<double>>{
                 {0.3}, {0.3, 0.7}, {1, 0}, {one_minus_ulp, 1}, {0.1, 0.2, 0.9}}) {
            const std::size_t d = row.size();
            const FourierSums one = method == "direct" ? fourier_sums_directly(row, d, 9, {})
                                                       : transform(Nufft(1, d, 9, 1e-9), row, {});
            for (const auto& sum : one.values) EXPECT_NEAR(std::norm(sum), 1, 1e-8);
            std::vector<std::string> said;
            RunContext run;
            run.warn = [&](const std::string& sentence) { said.push_back(sentence); };
            const Report report =
                spectrum(points_of({row, row}), {{"method", method}, {"max-frequency", "9"}}, run);
            for (const double p : grid_of(report).values) EXPECT_NEAR(p, 2, 1e-8);
            EXPECT_EQ(report.number("effective_nyquist"), 0);
            EXPECT_NEAR(report.number("oscillation"), 10, 1e-7);
            EXPECT_NEAR(report.number("total_variation"), 0.5, 1e-8);
            EXPECT_EQ(said,
                      std::vector<std::string>{
                          "all 2 points are equal, so that they are in phase at every frequency"});
        }
}

// 0 and 1/2: |1 + (-1)^f|^2 / 2 = 2 at even f, 0 at odd f.
TEST(Periodogram, TwoPointsOnALineByHand) {
    for (const std::string method : {"nufft", "direct"}) {
        const Report report =
            spectrum(points_of({{0}, {0.5}}), {{"method", method}, {"max-frequency", "6"}});
        for (std::int64_t f = -6; f <= 6; ++f)
            EXPECT_NEAR(power_at(report, f), f % 2 == 0 ? 2 : 0, 1e-8) << f;
        EXPECT_EQ(cells_of(report), Report::Integers(6, 2));
    }
}

// Points of a k x k grid are in phase at multiples of k and cancel elsewhere.
TEST(Periodogram, RegularGridHasPeaksOfPowerNAtMultiplesOfItsSide) {
    for (const int k : {3, 8}) {
        const Report report = spectrum(corner_grid(k), {{"max-frequency", "20"}});
        for (int f0 = -20; f0 <= 20; ++f0)
            for (int f1 = -20; f1 <= 20; ++f1)
                EXPECT_NEAR(power_at(report, f0, f1), f0 % k == 0 && f1 % k == 0 ? k * k : 0, 1e-7)
                    << k << ": " << f0 << ' ' << f1;
    }
}

// Row = f_1 and column = f_0: points that differ only in x have a power that varies along rows.
TEST(Periodogram, ColumnsAreFrequenciesInX) {
    const Report report = spectrum(points_of({{0, 0.2}, {0.5, 0.2}}), {{"max-frequency", "4"}});
    const Grid& grid = grid_of(report);
    for (std::size_t row = 0; row < 9; ++row)
        for (std::size_t column = 0; column < 9; ++column)
            EXPECT_NEAR(grid.values[row * 9 + column], column % 2 == 0 ? 2 : 0, 1e-8);
}

// Rings by hand: 1/2 <= |f| < 3/2 contains (+-1, 0), (0, +-1), (+-1, +-1); 3/2 <= |f| < 5/2
// contains (+-2, 0), (0, +-2), (+-2, +-1), (+-1, +-2).
TEST(Periodogram, RingsAreOneUnitWideAndWithoutZero) {
    const PointSet set = make("random", points(100, 2));
    const Report report = spectrum(set, {{"max-frequency", "12"}});
    ASSERT_EQ(cells_of(report).size(), 12U);
    EXPECT_EQ(cells_of(report)[0], 8);
    EXPECT_EQ(cells_of(report)[1], 12);
    for (std::int64_t k = 1; k <= 12; ++k) {
        std::vector<double> ring;
        for (std::int64_t f0 = -12; f0 <= 12; ++f0)
            for (std::int64_t f1 = -12; f1 <= 12; ++f1) {
                const double r = std::hypot(f0, f1);
                if (r >= double(k) - 0.5 && r < double(k) + 0.5)
                    ring.push_back(power_at(report, f0, f1));
            }
        double mean = 0;
        for (const double p : ring) mean += p / double(ring.size());
        double variance = 0;
        for (const double p : ring) variance += (p - mean) * (p - mean) / double(ring.size());
        const auto i = static_cast<std::size_t>(k - 1);
        EXPECT_EQ(cells_of(report)[i], static_cast<std::int64_t>(ring.size()));
        EXPECT_EQ(report.curve("radial.frequency")[i], double(k));
        EXPECT_NEAR(report.curve("radial.power")[i], mean, 1e-12);
        EXPECT_NEAR(report.curve("radial.anisotropy_db")[i],
                    10 * std::log10(variance / (mean * mean)), 1e-9);
    }
}

TEST(Periodogram, RingsInSpaceHoldAllVectorsOnce) {
    const Report report = spectrum(make("random", points(50, 3)), {{"max-frequency", "6"}});
    std::int64_t vectors = 0;
    for (int a = -6; a <= 6; ++a)
        for (int b = -6; b <= 6; ++b)
            for (int c = -6; c <= 6; ++c)
                vectors += a * a + b * b + c * c > 0 && std::hypot(a, b, c) < 6.5;
    std::int64_t cells = 0;
    for (const std::int64_t n : cells_of(report)) cells += n;
    EXPECT_EQ(cells, vectors);
    EXPECT_EQ(cells_of(report)[0], 18);  // 6 along the axes, 12 on the diagonals of planes
}

TEST(Periodogram, MethodsAgree) {
    for (std::size_t d = 1; d <= 3; ++d) {
        const PointSet set = make("random", points(200, d));
        const Report fast = spectrum(set, {{"max-frequency", "10"}, {"tolerance", "1e-12"}});
        const Report direct = spectrum(set, {{"max-frequency", "10"}, {"method", "direct"}});
        EXPECT_EQ(direct.text("method"), "direct");
        for (std::size_t i = 0; i < grid_of(fast).values.size(); ++i)
            ASSERT_NEAR(grid_of(fast).values[i], grid_of(direct).values[i], 1e-10);
    }
}

TEST(Periodogram, OppositeFrequenciesHaveEqualPowerToTheLastBit) {
    for (std::size_t d = 1; d <= 3; ++d) {
        const Report report = spectrum(make("random", points(64, d)), {{"max-frequency", "7"}});
        std::vector<double> reversed = grid_of(report).values;
        std::ranges::reverse(reversed);
        EXPECT_EQ(reversed, grid_of(report).values);
        EXPECT_EQ(reversed[reversed.size() / 2], 64);  // at frequency 0
    }
}

TEST(Periodogram, DoesNotChangeWhenTheSetIsMovedAroundTheTorus) {
    PointSet set = make("random", points(500, 2));
    const Report before = spectrum(set, {{"max-frequency", "15"}});
    for (std::size_t i = 0; i < set.count(); ++i) {
        set[i][0] = std::fmod(set[i][0] + 0.37, 1);
        set[i][1] = std::fmod(set[i][1] + 0.81, 1);
    }
    const Report after = spectrum(set, {{"max-frequency", "15"}});
    for (std::size_t i = 0; i < grid_of(before).values.size(); ++i)
        ASSERT_NEAR(grid_of(before).values[i], grid_of(after).values[i], 1e-7);
}

TEST(Periodogram, SameForAnyNumberOfThreads) {
    const PointSet set = make("random", points(20'000, 2));
    const Report one = spectrum(set, {}, {.threads = 1});
    EXPECT_EQ(spectrum(set, {}, {.threads = 2}), one);
    EXPECT_EQ(spectrum(set, {}, {.threads = 7}), one);
}

// White noise: 2 P is nearly chi-square with 2 degrees of freedom, and independent at different f
// except -f. For 40 sets with F = 24, the mean over 900 pairs x 40 sets has a standard deviation of
// 1/190; exceeding 6 of them has a probability of 2e-9. Points restricted to 0.8 of the square have
// a very different spectrum.
TEST(Periodogram, WhiteNoiseHasMeanPowerOneAndOtherSetsHaveNot) {
    const auto mean_power = [](double squeeze) {
        double sum = 0;
        double cells = 0;
        for (std::uint64_t seed = 1; seed <= 40; ++seed) {
            PointSet set = make("random", points(1000, 2), {}, {.seed = seed});
            for (double& x : set.flat()) x *= squeeze;
            const Report report = spectrum(set, {{"max-frequency", "24"}});
            for (std::size_t i = 0; i < 24; ++i) {
                const auto weight = static_cast<double>(cells_of(report)[i]);
                sum += weight * report.curve("radial.power")[i];
                cells += weight;
            }
        }
        return sum / cells;
    };
    const double deviation = 1 / std::sqrt(40 * 1875 / 2.0);
    EXPECT_NEAR(mean_power(1), 1, 6 * deviation);
    EXPECT_GT(mean_power(0.8), 1 + 20 * deviation);
}

// Expectation of a jittered m x m grid off its reciprocal lattice: P(f) = 1 - sinc^2(f_0 / m)
// sinc^2(f_1 / m). The mean over 400 sets has, at each frequency, a standard deviation of P / 20 (P
// is nearly exponentially distributed); exceeding 6 of them at any of 300 frequencies has a
// probability below 1e-5. White noise must be rejected.
TEST(Periodogram, JitteredGridHasItsExactExpectation) {
    const int m = 8;
    const int last = 12;
    std::vector<Report> jittered;
    std::vector<Report> white;
    for (std::uint64_t seed = 1; seed <= 400; ++seed) {
        const Settings settings = {{"max-frequency", std::to_string(last)}};
        jittered.push_back(spectrum(jittered_grid(m, seed), settings));
        white.push_back(spectrum(make("random", points(64, 2), {}, {.seed = seed}), settings));
    }
    const Report mean = mean_of(jittered);
    const Report wrong = mean_of(white);
    int told_apart = 0;
    for (int f0 = 0; f0 <= last; ++f0)
        for (int f1 = -last; f1 <= last; ++f1) {
            if (f0 % m == 0 && f1 % m == 0) continue;
            const double shape = sinc(double(f0) / m) * sinc(double(f1) / m);
            const double expected = 1 - shape * shape;
            EXPECT_NEAR(power_at(mean, f0, f1), expected, 6 * expected / 20) << f0 << ' ' << f1;
            told_apart += std::abs(power_at(wrong, f0, f1) - expected) > 6 * expected / 20;
        }
    EXPECT_GT(told_apart, 20);
}

// The anisotropy of a mean spectrum is -10 log10(sets) for white noise, while the mean anisotropy
// is near 0 dB. Over rings 8..24 with more than 1800 / 2 values, the ratio's standard deviation is
// below 0.6 dB.
TEST(Periodogram, AnisotropyOfAMeanIsThatOfTheMeanPower) {
    std::vector<Report> reports;
    for (std::uint64_t seed = 1; seed <= 100; ++seed)
        reports.push_back(spectrum(make("random", points(1000, 2), {}, {.seed = seed}),
                                   {{"max-frequency", "24"}}));
    const Report mean = mean_of(reports);
    double one = 0;
    double all = 0;
    for (std::size_t i = 7; i < 24; ++i) {
        one += reports[0].curve("radial.anisotropy_db")[i] / 17;
        all += mean.curve("radial.anisotropy_db")[i] / 17;
    }
    EXPECT_NEAR(one, 0, 2);
    EXPECT_NEAR(all, -20, 2);
    EXPECT_NE(mean.number("oscillation"), reports[0].number("oscillation"));
}

// Both definitions on a simple power: 0 up to ring 4, 1 beyond. The disk |f| < r + 1/2 has 0 up to
// r = 4; with N_r vectors inside, its mean is (N_5 - N_4) / N_5 = 28 / 96 at r = 5.
TEST(Periodogram, EffectiveNyquistAndOscillationByHand) {
    Grid power{.rows = 21, .columns = 21, .values = std::vector<double>(21 * 21)};
    for (int f1 = -10; f1 <= 10; ++f1)
        for (int f0 = -10; f0 <= 10; ++f0) {
            const double r = std::hypot(f0, f1);
            power.values[static_cast<std::size_t>((f1 + 10) * 21 + f0 + 10)] = r < 4.5 ? 0 : 1;
        }
    Report report;
    report.add("grid", power);
    report.add("regular_nyquist", 8.0);
    report.add("tolerance", 1e-9);
    const Analyzer& unit = find_analyzer("periodogram");
    unit.refine(report, 1, unit.options.defaults());
    EXPECT_EQ(report.number("effective_nyquist"), 2.5);  // |f| < 5 has none, 12 of 80 below 5.1
    EXPECT_EQ(report.number("oscillation"), 0);

    // A ring of power 3 from 7 on: 10 sqrt(sum of cells 4 / cells of rings 5..10).
    double cells = 0;
    double raised = 0;
    for (int f1 = -10; f1 <= 10; ++f1)
        for (int f0 = -10; f0 <= 10; ++f0) {
            const double r = std::hypot(f0, f1);
            cells += r >= 4.5 && r < 10.5;
            if (r < 6.5 || r >= 7.5) continue;
            ++raised;
            power.values[static_cast<std::size_t>((f1 + 10) * 21 + f0 + 10)] = 3;
        }
    report.add("grid", power);
    unit.refine(report, 1, unit.options.defaults());
    EXPECT_NEAR(report.number("oscillation"), 10 * std::sqrt(4 * raised / cells), 1e-12);
    EXPECT_FALSE(flag(report, "oscillation_complete"));
}

// Power is 1 from the first ring on, so the window is the rings 1..1 + 5 n^(1/d).
TEST(Periodogram, OscillationIsCompleteWhereItsWindowIs) {
    const Analyzer& unit = find_analyzer("periodogram");
    const auto complete = [&](std::size_t last, double power) {
        const std::size_t width = 2 * last + 1;
        Report report;
        report.add("grid", Grid{.rows = width,
                                .columns = width,
                                .values = std::vector<double>(width * width, power)});
        report.add("regular_nyquist", 2.0);
        report.add("tolerance", 1e-9);
        unit.refine(report, 1, unit.options.defaults());
        return flag(report, "oscillation_complete");
    };
    EXPECT_FALSE(complete(20, 1));
    EXPECT_TRUE(complete(21, 1));
    EXPECT_FALSE(complete(21, 0.9)) << "it never begins";
}

// Neither can results with windows or distances of different sizes be averaged.
TEST(Periodogram, NorHaveOtherAnalyzersOverOtherLengths) {
    for (const char* name : {"pair-correlation", "hyperuniformity"}) {
        const Analyzer& unit = find_analyzer(name);
        const auto refusal = [&](std::uint64_t n) {
            const std::vector<Report> sets = {analyze(name, make("random", points(100, 2))),
                                              analyze(name, make("random", points(n, 2)))};
            Report mean;
            return error_of([&] { unit.combine(mean, sets, unit.options.defaults()); });
        };
        EXPECT_EQ(refusal(100), "") << name;
        EXPECT_TRUE(refusal(110).starts_with("usage: --average: the sets ")) << name;
    }
}

// Frequencies normalized by n^(1/d) differ between sets of different n.
TEST(Periodogram, NormalizedFrequenciesOfOtherSizesHaveNoMean) {
    const Analyzer& unit = find_analyzer("periodogram");
    const std::vector<Report> sets = {spectrum(make("random", points(100, 2))),
                                      spectrum(make("random", points(110, 2)))};
    const auto refusal = [&](const char* normalize) {
        Values values = unit.options.defaults();
        unit.options.set(values, "normalize-frequency", normalize);
        Report mean;
        return error_of([&] { unit.combine(mean, sets, values); });
    };
    EXPECT_EQ(
        refusal("true"),
        "usage: --average: the sets differ in number of points, and therefore in their normalised "
        "frequencies | use the same number of points, or omit --normalize-frequency");
    EXPECT_EQ(refusal("false"), "");
}

// Frequencies one by one in the order of their lengths, for powers whose mean oscillates about one
// tenth.
TEST(Periodogram, EffectiveNyquistLooksAtEveryLength) {
    std::size_t between = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        const std::size_t d = 1 + seed % 3;
        const std::int64_t last = d == 3 ? 6 : 19;
        const auto width = static_cast<std::size_t>(2 * last + 1);
        Grid power{.rows = d == 1   ? 1
                           : d == 2 ? width
                                    : width * width,
                   .columns = width,
                   .values = {}};
        power.values.resize(power.rows * power.columns);
        const Rng rng(seed);
        std::map<std::int64_t, std::pair<double, double>> shells;
        for (std::size_t i = 0; i < power.values.size(); ++i) {
            const std::size_t opposite = power.values.size() - 1 - i;
            const double u = to_unit(rng.bits(std::min(i, opposite)));
            power.values[i] = 0.2 * u * std::pow(0.1 + u, static_cast<double>(seed % 5) / 4);
            std::int64_t square = 0;
            for (std::size_t k = 0, rest = i; k < d; ++k, rest /= width) {
                const auto f = static_cast<std::int64_t>(rest % width) - last;
                square += f * f;
            }
            if (square == 0 || square > last * last) continue;
            shells[square].first += power.values[i];
            shells[square].second += 1;
        }
        double sum = 0;
        double cells = 0;
        double wanted = 0;
        bool low = false;
        for (const auto& [square, shell] : shells) {
            if (low) wanted = std::sqrt(static_cast<double>(square)) / 2;
            sum += shell.first;
            cells += shell.second;
            low = sum <= 0.1 * cells;
        }
        if (low) wanted = static_cast<double>(last) / 2;
        if (wanted > 0 && !low) ++between;
        EXPECT_EQ(analyzers::effective_nyquist(power, analyzers::rings_of(power, {}), {}), wanted)
            << seed;
    }
    EXPECT_GE(between, 10);
}

// The first peaks of a regular grid, at f = k, end the empty disk.
TEST(Periodogram, RegularGridHasItsOwnNyquistFrequency) {
    const Report report = spectrum(corner_grid(32));
    EXPECT_EQ(report.number("max_frequency"), 64);
    EXPECT_EQ(report.number("regular_nyquist"), 16);
    EXPECT_EQ(report.number("effective_nyquist"), 16);
}

// JSON cannot represent infinity or NaN.
TEST(Periodogram, EqualPointsAndEmptyRingsGiveFiniteNumbers) {
    for (const auto& set : {corner_grid(16), points_of({{0.5, 0.5}, {0.5, 0.5}, {0.5, 0.5}}),
                            points_of({{0, 0}, {0, 0}}), points_of({{1}, {1}})}) {
        const Report report = spectrum(set);
        for (const char* key : {"radial.power", "radial.anisotropy_db"})
            for (const double value : report.curve(key)) EXPECT_TRUE(std::isfinite(value)) << key;
        for (const double db : report.curve("radial.anisotropy_db")) EXPECT_GE(db, -100);
        EXPECT_TRUE(std::isfinite(report.number("effective_nyquist")));
        EXPECT_TRUE(std::isfinite(report.number("oscillation")));
    }
    const Report equal = spectrum(points_of({{0.3, 0.5}, {0.3, 0.5}, {0.3, 0.5}}));
    for (const double p : equal.curve("radial.power")) EXPECT_NEAR(p, 3, 1e-7);
}

TEST(Periodogram, DefaultFrequencyIsTwiceTheRootOfTheCount) {
    EXPECT_EQ(measure("periodogram", "max_frequency", make("random", points(1000, 2))), 64);
    EXPECT_EQ(measure("periodogram", "max_frequency", make("random", points(1000, 3))), 20);
    EXPECT_EQ(measure("periodogram", "max_frequency", make("random", points(1000, 1))), 2000);
    EXPECT_EQ(measure("periodogram", "max_frequency", make("random", points(5, 2))), 16);
}

TEST(Periodogram, ReportsATighterToleranceOnlyWhereFloatsHoldIt) {
    const Settings tight = {{"tolerance", "1e-13"}, {"max-frequency", "5"}};
    EXPECT_EQ(measure("periodogram", "tolerance", make("random", points(10'000, 2))), 1e-9);
    EXPECT_NEAR(measure("periodogram", "tolerance", make("random", points(10'000, 2)), tight),
                1.5e-11, 1e-12);
}

TEST(Periodogram, RefusesWhatItCannotDo) {
    const PointSet set = make("random", points(10, 2));
    const auto refusal = [&](const PointSet& points, const Settings& settings,
                             const RunContext& run = {}) {
        return error_of([&] { (void)spectrum(points, settings, run); });
    };
    EXPECT_EQ(refusal(set, {{"max-frequency", "0"}}),
              "usage: --max-frequency: 0 is outside [1, 1000000]");
    EXPECT_EQ(refusal(set, {{"tolerance", "1e-14"}}),
              "usage: --tolerance: 1e-14 is below 1e-13, the limit of float64; --method direct is "
              "as exact as float64");
    EXPECT_EQ(refusal(set, {{"tolerance", "1e-14"}, {"method", "direct"}}), "");
    EXPECT_EQ(refusal(set, {{"image-bits", "16"}}),
              "usage: --image-bits: applies to --image, which is not given");
    EXPECT_EQ(refusal(set, {{"image-scale", "log"}}),
              "usage: --image-scale: applies to --image, which is not given");
    EXPECT_EQ(refusal(set, {{"tolerance", "0.2"}}), "usage: --tolerance: 0.2 is outside [0, 0.1]");
    EXPECT_EQ(refusal(make("random", points(10, 1)), {{"image", "a.png"}}),
              "usage: --image: requires points of dimension 2 or 3; these have 1");
    EXPECT_EQ(refusal(set, {{"slice", "1"}}),
              "usage: --slice: requires points of dimension 3; these have 2");
    EXPECT_EQ(refusal(points_of({{0.5, 0.5}}), {}),
              "input: periodogram needs at least 2 points; there is 1");
    EXPECT_NE(refusal(make("random", points(10, 4)), {}).find("dimension 1 to 3"),
              std::string::npos);
    for (const std::string method : {"nufft", "direct"}) {
        const std::string large = refusal(set, {{"max-frequency", "5000"}, {"method", method}},
                                          {.max_memory = std::uint64_t{1} << 30});
        EXPECT_TRUE(large.starts_with("limit: --max-frequency 5000 needs ")) << large;
    }
    std::stop_source source;
    source.request_stop();
    EXPECT_EQ(refusal(set, {}, {.stop = source.get_token()}), "cancelled: interrupted");
}

// White noise at every ring: 2 R P of a mean over R sets and the vectors of a ring is nearly
// chi-square distributed; with c / 2 independent vectors the mean has the standard deviation sqrt(2
// / (c R)). 24 rings at 5.5 deviations: false alarm 1e-6. A jittered grid must be rejected.
TEST(Periodogram, MeanPowerOfWhiteNoiseIsOneInEveryBinWithinItsBand) {
    std::vector<Report> white;
    std::vector<Report> jittered;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        const Settings settings = {{"max-frequency", "24"}};
        white.push_back(spectrum(make("random", points(1000, 2), {}, {.seed = seed}), settings));
        jittered.push_back(spectrum(jittered_grid(32, seed), settings));
    }
    const Report mean = mean_of(white);
    const Report other = mean_of(jittered);
    EXPECT_EQ(mean.number("expected_anisotropy_db"), -20);
    EXPECT_EQ(white[0].number("expected_anisotropy_db"), 0);
    for (std::size_t i = 0; i < 24; ++i) {
        const double band = 5.5 * std::sqrt(2 / (100.0 * static_cast<double>(cells_of(mean)[i])));
        EXPECT_NEAR(mean.curve("radial.power")[i], 1, band) << i + 1;
        EXPECT_LT(other.curve("radial.power")[i], 1 - band) << i + 1;
    }
}

// P(f) = 1 - sinc^2 sinc^2 is about pi^2 |f|^2 / (3 m^2) near 0, and 1 for white noise: exponents 2
// and 0. The fit over 8 rings of the mean of 100 sets has standard deviations below 0.1.
TEST(Periodogram, LowFrequencyExponentOfJitterIsTwoAndOfNoiseZero) {
    std::vector<Report> white;
    std::vector<Report> jittered;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        const Settings settings = {{"max-frequency", "16"}};
        white.push_back(spectrum(make("random", points(1024, 2), {}, {.seed = seed}), settings));
        jittered.push_back(spectrum(jittered_grid(32, seed), settings));
    }
    EXPECT_NEAR(mean_of(jittered).number("low_frequency_exponent"), 2, 0.25);
    EXPECT_NEAR(mean_of(white).number("low_frequency_exponent"), 0, 0.25);
    EXPECT_LT(mean_of(white).number("total_variation"), 0.05);
    EXPECT_GT(mean_of(jittered).number("total_variation"), 0.3);
    // A lattice has no power there, and so no exponent.
    EXPECT_EQ(spectrum(corner_grid(32)).find("low_frequency_exponent"), nullptr);
}

// All power of a lattice of 16 x 16 points is at (16, 0), (16, 16) and so on. Its ring 16 has power
// 256 at 4 of c frequencies: variance 256^2 (4/c - 16/c^2), squared mean (1024/c)^2. Rounding
// errors elsewhere have no anisotropy, for one set and for a mean.
TEST(Periodogram, RingsWithoutPowerHaveNoAnisotropy) {
    for (const char* method : {"nufft", "direct"}) {
        const Report lattice =
            spectrum(corner_grid(16), {{"max-frequency", "16"}, {"method", method}});
        for (const Report& report : {lattice, mean_of({lattice, lattice})}) {
            const auto& anisotropy = report.curve("radial.anisotropy_db");
            for (std::size_t i = 0; i < 15; ++i) EXPECT_EQ(anisotropy[i], -100) << method << i + 1;
            const auto& cells = std::get<Report::Integers>(*lattice.find("radial.cells"));
            const auto c = static_cast<double>(cells[15]);
            EXPECT_NEAR(anisotropy[15], 10 * std::log10(c / 4 - 1), 1e-6) << method;
        }
    }
}

TEST(Periodogram, NormalizedFrequenciesAreCyclesAMeanDistance) {
    const PointSet set = make("jittered", points(400, 2));
    const Report plain = spectrum(set);
    const Report report = spectrum(set, {{"normalize-frequency", "true"}});
    EXPECT_EQ(report.curve("radial.power"), plain.curve("radial.power"));
    for (std::size_t i = 0; i < 40; ++i)
        EXPECT_EQ(report.curve("radial.frequency")[i], double(i + 1) / 20);
    EXPECT_NEAR(report.number("effective_nyquist"), plain.number("effective_nyquist") / 20, 1e-12);
    EXPECT_NEAR(report.number("relative_nyquist"), plain.number("effective_nyquist") / 10, 1e-12);
    EXPECT_EQ(report.number("regular_nyquist"), 10);
}

/// Report on rows with a weight after each point's coordinates, as with --weights.
Report weighted(const std::vector<std::vector<double>>& rows, Settings settings) {
    const Analyzer& unit = find_analyzer("periodogram");
    settings.emplace_back("weights", "w");
    Values values = unit.options.defaults();
    for (const auto& [name, text] : settings) unit.options.set(values, name, text);
    std::vector<double> flat;
    for (const auto& row : rows) flat.insert(flat.end(), row.begin(), row.end());
    bool given = false;
    const auto next = [&](std::span<double> room) {
        if (std::exchange(given, true)) return std::size_t{0};
        std::ranges::copy(flat, room.begin());
        return rows.size();
    };
    const std::size_t d = rows.front().size() - 1;
    return analyze(unit, {unit_cube(d), {}, true}, next, values, {}).report;
}

// Weights 2 and -1 at 0 and 1/2: |2 - (-1)^f|^2 / 5 = 1/5 at even f, 9/5 at odd f.
TEST(Periodogram, StrengthsByHand) {
    for (const std::string method : {"nufft", "direct"}) {
        const Report report =
            weighted({{0, 2}, {0.5, -1}}, {{"method", method}, {"max-frequency", "6"}});
        for (std::int64_t f = -6; f <= 6; ++f)
            EXPECT_NEAR(power_at(report, f), f % 2 == 0 ? 0.2 : 1.8, 1e-8) << f;
    }
    EXPECT_EQ(error_of([] {
                  (void)weighted({{0.1, 0}, {0.2, 0}}, {});
              }),
              "input: --weights: all 2 weights are 0; expected at least one other number");
}

// A power of two as a common factor of the weights changes no bit; weights below 1e-100 or above
// 1e100 are rejected, because squares could become 0 or infinite.
TEST(Periodogram, PowerDoesNotDependOnTheScaleOfStrengths) {
    const auto scaled = [](double factor, const std::string& window) {
        const PointSet set = make("random", points(300, 3));
        std::vector<std::vector<double>> rows;
        for (std::size_t i = 0; i < 300; ++i)
            rows.push_back({set[i][0], set[i][1], (set[i][2] - 0.3) * factor});
        return weighted(rows, {{"max-frequency", "12"}, {"window", window}});
    };
    for (const std::string window : {"none", "hann"}) {
        const Report one = scaled(1, window);
        for (const int exponent : {-300, 3, 300})
            EXPECT_EQ(scaled(std::ldexp(1, exponent), window), one) << exponent;
    }
    const auto refusal = [](double strength) {
        return error_of([&] { (void)weighted({{0.1, 1}, {0.4, strength}, {0.7, 0}}, {}); });
    };
    EXPECT_EQ(refusal(-1e300),
              "input: --weights: the weight of point 1 is -1e+300; expected 0, or 1e-100 to 1e+100 "
              "in size | the power does not depend on the scale of the weights: divide all by the "
              "largest, and replace those that are still too small by 0");
    EXPECT_NE(refusal(2e-200), "");
    EXPECT_EQ(refusal(1e100), "");
    EXPECT_EQ(refusal(1e-100), "");
    EXPECT_EQ(refusal(0), "");
}

// Constant weights 1 change nothing; random weights keep white noise white.
TEST(Periodogram, WhiteNoiseStaysWhiteWithStrengths) {
    double sum = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const PointSet set = make("random", points(500, 3), {}, {.seed = seed});
        std::vector<std::vector<double>> rows;
        for (std::size_t i = 0; i < 500; ++i)
            rows.push_back({set[i][0], set[i][1], set[i][2] - 0.3});
        const Report report = weighted(rows, {{"max-frequency", "12"}});
        for (const double p : report.curve("radial.power")) sum += p / 240;
    }
    EXPECT_NEAR(sum, 1, 0.1);
}

// The definition, point by point; then white noise, whose mean is 1 at every frequency, also next
// to 0: 2000 sets, standard deviation 1 / sqrt(2000) at each of 12 frequencies; false alarm 1e-5 at
// 5 of them. Without subtraction of the window's own transform, power there would be near n / 4.
TEST(Periodogram, HannWindowIsTheDefinitionAndLeavesNoiseWhite) {
    const PointSet set = make("random", points(50, 2));
    const Report report = spectrum(set, {{"window", "hann"}, {"max-frequency", "5"}});
    EXPECT_EQ(report.text("window"), "hann");
    EXPECT_EQ(report.text("boundary"), "faded out");
    EXPECT_EQ(spectrum(set).text("boundary"), "torus");
    const auto transform = [](int f) { return f == 0 ? 0.5 : std::abs(f) == 1 ? -0.25 : 0.0; };
    for (int f0 = 0; f0 <= 5; ++f0)
        for (int f1 = -5; f1 <= 5; ++f1) {
            if (f0 == 0 && f1 == 0) continue;
            std::complex<double> sum;
            for (std::size_t i = 0; i < 50; ++i) {
                double w = 1;
                for (const double x : set[i]) w *= (1 - std::cos(2 * std::numbers::pi * x)) / 2;
                sum += std::polar(w, -2 * std::numbers::pi * (f0 * set[i][0] + f1 * set[i][1]));
            }
            const double shape = transform(f0) * transform(f1);
            const double expected =
                std::norm(sum - 50 * shape) / 50 / (0.375 * 0.375 - shape * shape);
            EXPECT_NEAR(power_at(report, f0, f1), expected, 1e-7) << f0 << ' ' << f1;
        }
    std::vector<double> means(25);
    for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
        const Report one = spectrum(make("random", points(40, 2), {}, {.seed = seed}),
                                    {{"window", "hann"}, {"max-frequency", "2"}});
        for (std::size_t i = 0; i < 25; ++i) means[i] += grid_of(one).values[i] / 2000;
    }
    for (std::size_t i = 0; i < 12; ++i) EXPECT_NEAR(means[i], 1, 5.5 / std::sqrt(2000)) << i;
}

// The same in three dimensions, at frequencies along one axis and along two.
TEST(Periodogram, HannWindowIsTheDefinitionInSpace) {
    const PointSet set = make("random", points(40, 3));
    const Report report = spectrum(set, {{"window", "hann"}, {"max-frequency", "2"}});
    for (const std::array<int, 3> f :
         {std::array{0, 0, 1}, {1, 0, 0}, {0, -1, 0}, {1, 0, 1}, {0, 0, 2}}) {
        std::complex<double> sum;
        double shape = 1;
        for (const int k : f) shape *= k == 0 ? 0.5 : std::abs(k) == 1 ? -0.25 : 0;
        for (std::size_t i = 0; i < 40; ++i) {
            double w = 1;
            double turns = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                w *= (1 - std::cos(2 * std::numbers::pi * set[i][k])) / 2;
                turns += f[k] * set[i][k];
            }
            sum += std::polar(w, -2 * std::numbers::pi * turns);
        }
        const double expected =
            std::norm(sum - 40 * shape) / 40 / (std::pow(0.375, 3) - shape * shape);
        const int at = ((f[2] + 2) * 5 + f[1] + 2) * 5 + f[0] + 2;
        EXPECT_NEAR(grid_of(report).values[static_cast<std::size_t>(at)], expected, 1e-7) << at;
    }
}

// A box is mapped to the cube: frequencies are cycles per side.
TEST(Periodogram, BoxesAreMeasuredAsTheCubeThatTheyAre) {
    PointSet set = make("random", points(100, 2));
    const Report cube = spectrum(set);
    for (std::size_t i = 0; i < 100; ++i) {
        set[i][0] *= 8;
        set[i][1] = set[i][1] * 2 - 1;
    }
    set.domain = parse_domain("box:bounds=[0..8,-1..1]", 2);
    const Report box = spectrum(set);
    for (std::size_t i = 0; i < 20; ++i)
        EXPECT_NEAR(box.curve("radial.power")[i], cube.curve("radial.power")[i], 1e-7);
}

// More points than are buffered: the result is the same whether or not their number is known.
TEST(Periodogram, LargeSetsComeInPieces) {
    const PointSet set = make("random", points(1'100'000, 1));
    const Analyzer& unit = find_analyzer("periodogram");
    Values values = unit.options.defaults();
    unit.options.set(values, "max-frequency", "8");
    const Report whole = analyze(unit, set, values, {});
    std::size_t at = 0;
    const auto next = [&](std::span<double> rows) {
        const std::size_t some = std::min(rows.size(), set.count() - at);
        std::ranges::copy(set.flat().subspan(at, some), rows.begin());
        at += some;
        return some;
    };
    EXPECT_EQ(analyze(unit, {unit_cube(1)}, next, values, {}).report, whole);
    const FourierSums truth = fourier_sums_directly(set.flat(), 1, 8, {.threads = 2});
    for (std::int64_t f = 1; f <= 8; ++f) {
        const double sum = std::abs(truth.at({f, 0, 0})) / std::sqrt(1.1e6);
        EXPECT_NEAR(power_at(whole, f), sum * sum, 3e-9 * (sum + 1)) << f;
    }
}

// Sets of other sizes are measured at the frequencies of the first one.
TEST(Periodogram, FollowsTheFrequenciesOfTheFirstSetOfAMean) {
    const Analyzer& unit = find_analyzer("periodogram");
    Values values = unit.options.defaults();
    const Report first = analyze(unit, make("random", points(400, 2)), values, {});
    unit.follow(first, values);
    const Report second = analyze(unit, make("random", points(100, 2)), values, {});
    EXPECT_EQ(second.number("max_frequency"), 40);
    unit.follow(second, values);
    EXPECT_EQ(second.number("max_frequency"), 40);
}

}  // namespace stipple::testing::periodogram_test
