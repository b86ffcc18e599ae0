// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/rng.hpp"
#include "support/units.hpp"

using namespace stipple;
using namespace stipple::testing;

namespace {

const Grid& grid_of(const Report& report) { return std::get<Grid>(*report.find("grid")); }

const Report::Integers& cells_of(const Report& report) {
    return std::get<Report::Integers>(*report.find("radial.cells"));
}

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

/// Mean of reports as the command line makes it: numbers, curves and grids, then refine.
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

// |exp(i phi)|^2 / 1 = 1.
TEST(Periodogram, OnePointHasPowerOneEverywhere) {
    for (const std::string method : {"nufft", "direct"}) {
        for (const auto& row : std::vector<std::vector<double>>{
                 {0.3}, {0.3, 0.7}, {1, 0}, {one_minus_ulp, 1}, {0.1, 0.2, 0.9}}) {
            const Report report =
                spectrum(points_of({row}), {{"method", method}, {"max-frequency", "9"}});
            for (const double p : grid_of(report).values) EXPECT_NEAR(p, 1, 1e-8);
            for (const double p : report.curve("radial.power")) EXPECT_NEAR(p, 1, 1e-8);
            EXPECT_EQ(report.number("effective_nyquist"), 0);
            EXPECT_NEAR(report.number("oscillation"), 0, 1e-7);
        }
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

// A k x k grid is in phase at multiples of k and cancels elsewhere.
TEST(Periodogram, RegularGridHasPeaksOfPowerNAtMultiplesOfItsSide) {
    for (const int k : {3, 8}) {
        const Report report = spectrum(corner_grid(k), {{"max-frequency", "20"}});
        for (int f0 = -20; f0 <= 20; ++f0)
            for (int f1 = -20; f1 <= 20; ++f1)
                EXPECT_NEAR(power_at(report, f0, f1), f0 % k == 0 && f1 % k == 0 ? k * k : 0, 1e-7)
                    << k << ": " << f0 << ' ' << f1;
    }
}

// Row = f_1 and column = f_0: points that differ in x alone have a power that changes along rows.
TEST(Periodogram, ColumnsAreFrequenciesInX) {
    const Report report = spectrum(points_of({{0, 0.2}, {0.5, 0.2}}), {{"max-frequency", "4"}});
    const Grid& grid = grid_of(report);
    for (std::size_t row = 0; row < 9; ++row)
        for (std::size_t column = 0; column < 9; ++column)
            EXPECT_NEAR(grid.values[row * 9 + column], column % 2 == 0 ? 2 : 0, 1e-8);
}

// Rings by hand: 1/2 <= |f| < 3/2 holds (+-1, 0), (0, +-1), (+-1, +-1); 3/2 <= |f| < 5/2 holds
// (+-2, 0), (0, +-2), (+-2, +-1), (+-1, +-2).
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
        EXPECT_EQ(reversed[reversed.size() / 2], 64);  // at zero
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

// White noise: 2 P is chi-square with 2 degrees of freedom, nearly, and independent at different
// f but for -f. 40 sets at F = 24: the mean over 900 pairs x 40 sets has a standard deviation of
// 1/190, so 6 of them fail by chance once in 5e8 runs. Points that keep a 0.8 of the square have a
// spectrum far from it.
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

// Expectation of a jittered m x m grid off its reciprocal lattice:
// P(f) = 1 - sinc^2(f_0 / m) sinc^2(f_1 / m). The mean over 400 sets has, at each frequency, a
// standard deviation of P / 20 (P being exponentially distributed, nearly); 6 of them at 300
// frequencies fail by chance less than once in 1e5 runs. White noise must be told apart.
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

// The anisotropy of a mean power is that of the mean, -10 log10(sets) for white noise, and not the
// mean anisotropy, which is near 0 dB. Over rings 8..24 with over 1800 / 2 values the ratio's
// standard deviation is below 0.6 dB.
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

// Both definitions on a power made by hand: 0 up to ring 4, 1 beyond it. The disk |f| < r + 1/2 has
// 0 up to r = 4; with N_r vectors inside, its mean is (N_5 - N_4) / N_5 = 28 / 96 at r = 5.
TEST(Periodogram, EffectiveNyquistAndOscillationByHand) {
    Grid power{.rows = 21, .columns = 21, .values = std::vector<double>(21 * 21)};
    std::size_t inside_4 = 0;
    std::size_t inside_5 = 0;
    for (int f1 = -10; f1 <= 10; ++f1)
        for (int f0 = -10; f0 <= 10; ++f0) {
            const double r = std::hypot(f0, f1);
            inside_4 += r > 0 && r < 4.5;
            inside_5 += r > 0 && r < 5.5;
            power.values[static_cast<std::size_t>((f1 + 10) * 21 + f0 + 10)] = r < 4.5 ? 0 : 1;
        }
    Report report;
    report.add("grid", power);
    report.add("regular_nyquist", 8.0);
    const Analyzer& unit = find_analyzer("periodogram");
    unit.refine(report, 1, unit.options.defaults());
    const double at_5 = double(inside_5 - inside_4) / double(inside_5);
    EXPECT_NEAR(report.number("effective_nyquist"), (4.5 + 0.1 / at_5) / 2, 1e-12);
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
}

// What a regular grid can do: its first peaks, at f = k, end the empty disk.
TEST(Periodogram, RegularGridHasItsOwnNyquistFrequency) {
    const Report report = spectrum(corner_grid(32));
    EXPECT_EQ(report.number("max_frequency"), 64);
    EXPECT_EQ(report.number("regular_nyquist"), 16);
    EXPECT_NEAR(report.number("effective_nyquist"), 16, 0.25);
}

// Nothing is infinite or not a number, which JSON cannot hold.
TEST(Periodogram, EqualPointsAndEmptyRingsGiveFiniteNumbers) {
    for (const auto& set : {corner_grid(16), points_of({{0.5, 0.5}, {0.5, 0.5}, {0.5, 0.5}}),
                            points_of({{0, 0}}), points_of({{1}, {1}})}) {
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
                1e-11, 1e-12);
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
              "usage: --tolerance: 1e-14 is outside [1e-13, 0.1]");
    EXPECT_EQ(refusal(make("random", points(10, 3)), {{"grid", "a.npy"}}),
              "usage: --grid: takes points of dimension 2; these have 3");
    EXPECT_EQ(refusal(make("random", points(10, 1)), {{"image", "a.png"}}),
              "usage: --image: takes points of dimension 2; these have 1");
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
