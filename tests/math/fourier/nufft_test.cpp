// SPDX-License-Identifier: MIT
#include "math/fourier/nufft.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <complex>
#include <fstream>
#include <numbers>
#include <string>
#include <thread>

#include "core/error.hpp"
#include "core/rng.hpp"
#include "math/fourier/kaiser_bessel.hpp"
#include "support/fourier.hpp"
#include "support/temporary_file.hpp"

namespace stipple::testing::nufft_test {
namespace {

using Numbers = std::vector<double>;

struct NamedRows {
    std::string name;
    Numbers rows;
};

/// Sets from incoherent to all points in phase, including the ends of the cube and numbers next to
/// them.
std::vector<NamedRows> sets(std::size_t count, std::size_t d) {
    Numbers random(count * d);
    Rng(11).fill(0, random);
    std::vector<NamedRows> all = {{"random", random}};
    const auto add = [&](std::string name, auto&& coordinate) {
        Numbers rows = random;
        for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = coordinate(i, random[i]);
        all.push_back({std::move(name), std::move(rows)});
    };
    add("corner grid", [](std::size_t, double x) { return std::floor(x * 8) / 8; });
    add("clustered", [](std::size_t, double x) { return 0.5 + 1e-4 * x * x; });
    add("all at 0", [](std::size_t, double) { return 0.0; });
    add("all at 1", [](std::size_t, double) { return 1.0; });
    add("all next to 1", [](std::size_t, double) { return one_minus_ulp; });
    add("all equal", [&](std::size_t i, double) { return random[i % d]; });
    add("ends", [](std::size_t i, double) {
        return i % 3 == 0 ? 0.0 : i % 3 == 1 ? 1.0 : one_minus_ulp;
    });
    add("tiny", [](std::size_t, double x) { return x * 1e-300; });
    return all;
}

double largest_difference(const FourierSums& a, const FourierSums& b) {
    EXPECT_EQ(a.values.size(), b.values.size());
    double worst = 0;
    for (std::size_t i = 0; i < a.values.size(); ++i)
        worst = std::max(worst, std::abs(a.values[i] - b.values[i]));
    return worst;
}

std::size_t frequency_for(std::size_t d) { return d == 1 ? 200 : d == 2 ? 24 : 7; }

/// The definition, one frequency at a time, in extended precision: the oracle for the direct sum.
std::complex<double> by_definition(const Numbers& rows, std::size_t d,
                                   std::array<std::int64_t, 3> f) {
    std::complex<long double> sum;
    for (std::size_t i = 0; i < rows.size(); i += d) {
        long double turns = 0;
        for (std::size_t k = 0; k < d; ++k)
            turns += static_cast<long double>(f[k]) * static_cast<long double>(rows[i + k]);
        sum += std::polar(1.0L, -2 * std::numbers::pi_v<long double> * turns);
    }
    return {static_cast<double>(sum.real()), static_cast<double>(sum.imag())};
}

}  // namespace

// 0 and 1/2 are in phase at even frequencies and cancel at odd ones; 0 and 1/4 in the plane:
// 1 + exp(-i pi f_1 / 2).
TEST(FourierSums, DirectSumsByHand) {
    const Numbers halves = {0, 0.5};
    const FourierSums line = fourier_sums_directly(halves, 1, 5, {});
    for (std::int64_t f = -5; f <= 5; ++f)
        EXPECT_NEAR(std::abs(line.at({f, 0, 0}) - (f % 2 == 0 ? 2.0 : 0.0)), 0, 1e-15) << f;

    const Numbers pair = {0, 0, 0, 0.25};
    const FourierSums plane = fourier_sums_directly(pair, 2, 2, {});
    using namespace std::complex_literals;
    for (std::int64_t f0 = -2; f0 <= 2; ++f0) {
        EXPECT_NEAR(std::abs(plane.at({f0, 0, 0}) - 2.0), 0, 1e-15);
        EXPECT_NEAR(std::abs(plane.at({f0, 1, 0}) - (1.0 - 1i)), 0, 1e-15);
        EXPECT_NEAR(std::abs(plane.at({f0, -1, 0}) - (1.0 + 1i)), 0, 1e-15);
        EXPECT_NEAR(std::abs(plane.at({f0, 2, 0})), 0, 1e-15);
    }
}

TEST(FourierSums, DirectSumsAgreeWithTheDefinition) {
    for (std::size_t d = 1; d <= 3; ++d) {
        Numbers rows(40 * d);
        Rng(5).fill(0, rows);
        const auto last = static_cast<std::int64_t>(d == 1 ? 5000 : 6);
        const FourierSums sums = fourier_sums_directly(rows, d, static_cast<std::size_t>(last), {});
        for (std::uint64_t i = 0; i < 50; ++i) {
            std::array<std::int64_t, 3> f{};
            for (std::size_t k = 0; k < d; ++k)
                f[k] = static_cast<std::int64_t>(
                           Rng(6, k).below(i, static_cast<std::uint64_t>(2 * last + 1))) -
                       last;
            EXPECT_NEAR(std::abs(sums.at(f) - by_definition(rows, d, f)), 0, 1e-13)
                << d << "-D, f = " << f[0] << ' ' << f[1] << ' ' << f[2];
        }
    }
}

// The header's promise: for every set, not only if errors cancel.
TEST(Nufft, MeetsEveryToleranceForEverySet) {
    for (std::size_t d = 1; d <= 3; ++d)
        for (const std::size_t n : {1U, 7U, 300U, 3000U})
            for (const auto& [name, rows] : sets(n, d)) {
                const std::size_t last = frequency_for(d);
                const FourierSums truth = fourier_sums_directly(rows, d, last, {});
                for (const double tolerance : {1e-1, 1e-3, 1e-6, 1e-9, 1e-11, 1e-13}) {
                    const Nufft nufft(n, d, last, tolerance);
                    const double error = largest_difference(transform(nufft, rows, {}), truth) /
                                         std::sqrt(static_cast<double>(n));
                    EXPECT_LE(error, std::max(tolerance, rounding_floor(n)))
                        << name << ", " << d << "-D, n = " << n << ", tolerance " << tolerance;
                }
            }
}

namespace {

/// Largest error over waves of the band, for a point at u spread with these weights.
template <class Weights>
double error_in_band(const KaiserBessel& window, double u, const Weights& weights) {
    double worst = 0;
    const double middle = static_cast<double>(window.width() - 1) / 2;
    for (std::size_t part = 0; part <= 160; ++part) {
        const double omega = 2 * std::numbers::pi * window.band() * static_cast<double>(part) / 160;
        std::complex<double> sum;
        for (std::size_t j = 0; j < window.width(); ++j)
            sum += weights(j) * std::polar(1.0, -omega * (static_cast<double>(j) - middle));
        sum /= window.scaling(omega / (2 * std::numbers::pi));
        worst = std::max(worst, std::abs(sum - std::polar(1.0, -omega * (u - 0.5))));
    }
    return worst;
}

double error_in_band(const KaiserBessel& window, double u) {
    const auto weights = window.weights(u);
    return error_in_band(window, u, [&](std::size_t j) { return weights[j]; });
}

/// I0(beta sqrt(1 - (2a/w)^2)) / I0(beta), whose transform gives the scaling factors.
double window_at(const KaiserBessel& window, double a) {
    const auto w = static_cast<double>(window.width());
    const double beta = 0.98 * std::numbers::pi * w * (1 - window.band());
    const double square = 1 - 4 * a * a / (w * w);
    return square < 0 ? 0
                      : std::cyl_bessel_i(0, beta * std::sqrt(square)) / std::cyl_bessel_i(0, beta);
}

}  // namespace

// The error is evaluated at a few positions in the band and the cell; elsewhere it is at most a
// tenth larger.
TEST(KaiserBessel, ErrorIsTheLargestInTheBand) {
    for (std::size_t width = 2; width <= 12; ++width)
        for (const double band : {0.12, 0.18, 0.22, 0.25, 0.3, 0.35, 0.38}) {
            const KaiserBessel window(width, band);
            double worst = 0;
            for (int i = 0; i <= 64; ++i) worst = std::max(worst, error_in_band(window, i / 64.0));
            EXPECT_LE(worst, 1.1 * window.error() + 1e-14) << width << ", " << band;
            EXPECT_GE(worst, 0.9 * window.error() - 1e-14) << width << ", " << band;
        }
}

TEST(KaiserBessel, WeightsAreTheWindowAtTheGridPoints) {
    for (const std::size_t width : {2U, 5U, 12U}) {
        const KaiserBessel window(width, 0.25);
        for (const double u : {0.0, 0.3, 1.0})
            for (std::size_t j = 0; j < width; ++j)
                EXPECT_NEAR(window.weights(u)[j],
                            window_at(window, u + (static_cast<double>(width) / 2 - 1) -
                                                  static_cast<double>(j)),
                            1e-14);
    }
}

// All points at the position with the largest error, in phase.
TEST(Nufft, MeetsTheToleranceWhereTheWindowIsWorst) {
    const std::vector<double> rows(184, one_minus_ulp);
    const FourierSums truth = fourier_sums_directly(rows, 1, 27, {});
    const Nufft nufft(184, 1, 27, 3.75e-6);
    EXPECT_LE(largest_difference(transform(nufft, rows, {}), truth), 3.75e-6 * std::sqrt(184));
}

// The error must grow with the tolerance: the coarsest window is not accidentally exact.
TEST(Nufft, ErrorFollowsTheTolerance) {
    Numbers rows(2 * 500);
    Rng(3).fill(0, rows);
    const FourierSums truth = fourier_sums_directly(rows, 2, 20, {});
    const auto error = [&](double tolerance) {
        return largest_difference(transform(Nufft(500, 2, 20, tolerance), rows, {}), truth);
    };
    EXPECT_GT(error(1e-1), 1e-5);
    EXPECT_GT(error(1e-6), 1e-10);
    EXPECT_LT(error(1e-12), 1e-11);
}

TEST(Nufft, SmallestAndLargeFrequencies) {
    Numbers rows(2 * 50);
    Rng(8).fill(0, rows);
    for (const std::size_t last : {1U, 2U, 3U, 111U}) {
        const FourierSums truth = fourier_sums_directly(rows, 2, last, {});
        const FourierSums sums = transform(Nufft(50, 2, last, 1e-10), rows, {});
        EXPECT_LE(largest_difference(sums, truth), 1e-10 * std::sqrt(50)) << last;
    }
    Numbers line(50);
    Rng(9).fill(0, line);
    const FourierSums truth = fourier_sums_directly(line, 1, 100'000, {});
    const FourierSums sums = transform(Nufft(50, 1, 100'000, 1e-11), line, {});
    EXPECT_LE(largest_difference(sums, truth), 1e-11 * std::sqrt(50));
}

// Several batches, many tiles in blocks of bands, and one tile with all points.
TEST(Nufft, SameBitsForAnyNumberOfThreads) {
    for (std::size_t d = 1; d <= 3; ++d)
        for (const bool clustered : {false, true}) {
            const std::size_t n = d == 1 ? 1'200'000 : 60'000;
            Numbers rows(n * d);
            Rng(2).fill(0, rows);
            if (clustered)
                for (double& x : rows) x = 0.3 + 1e-3 * x;
            const Nufft nufft(n, d, d == 3 ? 12 : d == 2 ? 256 : 150, 1e-8);
            const FourierSums one = transform(nufft, rows, {.threads = 1});
            for (const unsigned threads : {2U, 7U})
                EXPECT_EQ(transform(nufft, rows, {.threads = threads}).values, one.values)
                    << d << "-D, " << threads << " threads";
            Numbers few(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(200 * d));
            const FourierSums direct = fourier_sums_directly(few, d, 9, {.threads = 1});
            EXPECT_EQ(fourier_sums_directly(few, d, 9, {.threads = 7}).values, direct.values);
        }
}

TEST(Nufft, MirrorsHalfOfTheSums) {
    Numbers rows(2 * 30);
    Rng(4).fill(0, rows);
    const FourierSums sums = transform(Nufft(30, 2, 10, 1e-10), rows, {});
    for (std::int64_t f0 = -10; f0 <= 10; ++f0)
        for (std::int64_t f1 = -10; f1 <= 10; ++f1)
            EXPECT_NEAR(std::abs(sums.at({f0, f1, 0}) - by_definition(rows, 2, {f0, f1, 0})), 0,
                        1e-9)
                << f0 << ' ' << f1;
}

TEST(Nufft, ProgressRisesToTheEndAndStopIsHeeded) {
    Numbers rows(2 * 200'000);
    Rng(1).fill(0, rows);
    const Nufft nufft(200'000, 2, 100, 1e-9);
    double last = 0;
    bool rising = true;
    RunContext run{.threads = 2};
    run.progress = [&](double done) {
        rising = rising && done >= last;
        last = done;
    };
    (void)transform(nufft, rows, run);
    EXPECT_TRUE(rising);
    EXPECT_EQ(last, 1);

    std::stop_source source;
    source.request_stop();
    EXPECT_THROW((void)transform(nufft, rows, {.stop = source.get_token()}), Error);
    EXPECT_THROW((void)fourier_sums_directly(rows, 2, 20, {.stop = source.get_token()}), Error);
}

// Blocks of any size give the same bits, also if a batch ends inside one.
TEST(Nufft, SameBitsHoweverThePointsArePortioned) {
    const std::size_t n = 1'100'000;
    Numbers rows(n);
    Rng(7).fill(0, rows);
    const Nufft nufft(n, 1, 100, 1e-7);
    const FourierSums whole = transform(nufft, rows, {});
    for (const std::size_t portion : {std::size_t{131'072}, std::size_t{1'048'575}}) {
        FourierSummation sum(nufft);
        for (std::size_t at = 0; at < n; at += portion)
            sum.add(std::span(rows).subspan(at, std::min(portion, n - at)), {});
        EXPECT_EQ(sum.finish(Planning::estimated, {}).values, whole.values) << portion;
    }
}

// A block of the points i / 2^24, which cancel at every frequency except 0, and a few more: in one
// sum, and split between ranks.
TEST(Nufft, BlocksOfManyPointsAddUpWhoeverSumsThem) {
    const Nufft plan(std::uint64_t{1} << 30, 1, 4, 1e-6);
    const std::uint64_t block = FourierSummation::block_of(plan);
    ASSERT_EQ(block, std::uint64_t{1} << 24);
    std::vector<double> more(1000);
    Rng(8).fill(0, more);
    FourierSummation whole(plan);
    FourierSummation part(plan);
    std::vector<double> some(std::size_t{1} << 20);
    for (std::uint64_t at = 0; at < block; at += some.size()) {
        for (std::size_t i = 0; i < some.size(); ++i)
            some[i] = static_cast<double>(at + i) / static_cast<double>(block);
        whole.add(some, {});
        part.add(some, {});
    }
    whole.add(more, {});
    FourierSummation others(plan);
    others.add(more, {});
    Packer packed;
    others.pack(packed, {});
    const std::string state = packed.take();
    Unpacker from(state);
    part.merge(from, {});
    const FourierSums sums = whole.finish(Planning::estimated, {});
    EXPECT_EQ(part.finish(Planning::estimated, {}).values, sums.values);
    const FourierSums truth = fourier_sums_directly(more, 1, 4, {});
    for (std::size_t f = 0; f <= 4; ++f) {
        const double all = f == 0 ? static_cast<double>(block) : 0;
        EXPECT_NEAR(std::abs(sums.values[f] - truth.values[f] - all), 0, 1e-6 * 4096) << f;
    }
}

// Weights multiply the summands: compared with the direct sum, and the direct sum with repeated
// points.
TEST(Nufft, StrengthsMultiplyThePoints) {
    for (std::size_t d = 1; d <= 3; ++d) {
        Numbers once;
        Numbers often;
        Numbers random(d * 60);
        Rng(12).fill(0, random);
        double squares = 0;
        for (std::size_t i = 0; i < 60; ++i) {
            const std::span point(random.data() + i * d, d);
            once.insert(once.end(), point.begin(), point.end());
            once.push_back(static_cast<double>(i % 4));
            squares += static_cast<double>(i % 4 * (i % 4));
            for (std::size_t k = 0; k < i % 4; ++k)
                often.insert(often.end(), point.begin(), point.end());
        }
        const std::size_t last = frequency_for(d);
        const FourierSums direct = fourier_sums_directly(once, d, last, {}, true);
        EXPECT_LE(largest_difference(direct, fourier_sums_directly(often, d, last, {})), 1e-11);
        const Nufft nufft(60, d, last, 1e-9, true);
        EXPECT_LE(largest_difference(transform(nufft, once, {}), direct),
                  1e-9 * std::sqrt(squares));
    }
}

// Measured plans use other algorithms, with the same sums within the tolerance.
TEST(Nufft, MeasuredPlansStayWithinTheTolerance) {
    Numbers rows(2 * 300);
    Rng(13).fill(0, rows);
    const Nufft nufft(300, 2, 12, 1e-10);
    const FourierSums guessed = transform(nufft, rows, {}, Planning::estimated);
    const FourierSums measured = transform(nufft, rows, {}, Planning::measured);
    EXPECT_LE(largest_difference(guessed, measured), 1e-10 * std::sqrt(300));
}

TEST(Nufft, WisdomIsWrittenAndReadBack) {
    const TemporaryFile file("");
    std::filesystem::remove(file.path());
    if (!fft_library().starts_with("fftw")) {
        EXPECT_THROW(read_wisdom(file.path()), Error);
        return;
    }
    read_wisdom(file.path());  // does not exist, so nothing is read
    std::ofstream(file.path()) << wisdom_text();
    read_wisdom(file.path());
    std::ofstream(file.path()) << "no wisdom";
    try {
        read_wisdom(file.path());
        FAIL() << "took words for wisdom";
    } catch (const Error& e) {
        EXPECT_EQ(e.kind(), ErrorKind::input);
        EXPECT_NE(std::string(e.what()).find("not a wisdom file of fftw"), std::string::npos);
    }
    EXPECT_THROW(read_wisdom("/"), Error);
}

TEST(QuickLength, IsEvenAndAPowerOfTwoButForASmallFactor) {
    EXPECT_EQ(quick_length(31), 32U);
    EXPECT_EQ(quick_length(1281), 1536U);  // 1296 = 2^4 81 is slower
    EXPECT_EQ(quick_length(1537), 1600U);
    for (std::size_t least = 33; least < 5000; least += 61) {
        const std::size_t length = quick_length(least);
        EXPECT_EQ(length % 2, 0U);
        EXPECT_GE(length, least);
        EXPECT_LE(length, least * 5 / 4 + 2);
    }
}

// The closed form compared with the integral over the window by the trapezoidal rule, which is
// exact apart from the window's jump at its ends.
TEST(KaiserBessel, ScalingIsTheTransformOfAKaiserBesselWindow) {
    const KaiserBessel window(12, 0.25);
    for (const double xi : {0.0, 0.1, 0.25}) {
        const int steps = 20'000;
        double sum = 0;
        for (int i = 0; i <= steps; ++i) {
            const double a = -6 + 12.0 * i / steps;
            sum += window_at(window, a) * std::cos(2 * std::numbers::pi * xi * a) *
                   (i % steps ? 1.0 : 0.5);
        }
        EXPECT_NEAR(sum * 12 / steps, window.scaling(xi), 1e-12) << xi;
    }
}

// The polynomials add little error: rounding of numbers up to 1 for wide windows.
TEST(WeightTable, IsAsGoodAsTheWeights) {
    for (const double band : {0.12, 0.25, 0.35})
        for (std::size_t width = KaiserBessel::min_width; width <= KaiserBessel::max_width;
             ++width) {
            const KaiserBessel window(width, band);
            const WeightTable table(window);
            double worst = 0;
            for (int i = 0; i < 300; ++i) {
                const double u = (i + 0.3) / 300;
                const auto weight = [&](std::size_t j) { return weight_of(table, j, u); };
                worst = std::max(worst, error_in_band(window, u, weight));
            }
            EXPECT_LE(worst, 1.1 * window.error() + 1.5e-14) << width << ", " << band;
        }
}

TEST(KaiserBessel, NarrowestWithinTolerance) {
    for (const double band : {1. / 3, 1. / 4, 1. / 8})
        for (const double tolerance : {1e-2, 1e-5, 1e-8}) {
            const KaiserBessel window = window_for(tolerance, band);
            EXPECT_LE(window.error(), tolerance);
            if (window.width() > KaiserBessel::min_width) {
                EXPECT_GT(KaiserBessel(window.width() - 1, band).error(), tolerance);
            }
        }
}

}  // namespace stipple::testing::nufft_test
