// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <tuple>

#include "core/machine/int128.hpp"
#include "core/rng.hpp"
#include "math/arithmetic/double_double.hpp"
#include "math/l2/squares.hpp"
#include "support/exact.hpp"
#include "support/lattices.hpp"
#include "support/units.hpp"

namespace stipple::testing::l2_discrepancy_test {

using l2::Kind;

namespace {

using Weights = std::vector<double>;

const Fraction half(1, 2);
Fraction from_middle(const Fraction& x) { return abs(x - half); }

/// Definition of a kind: its kernel on an axis, the kernel's mean over one argument and over both.
struct Definition {
    const char* name;
    bool projections;
    Fraction (*kernel)(const Fraction&, const Fraction&);
    Fraction (*mean)(const Fraction&);
    Fraction total;
};

Fraction falling(const Fraction& x, const Fraction& y) { return 1 - std::max(x, y); }
Fraction falling_mean(const Fraction& x) { return (1 - x * x) / 2; }
Fraction wrapped(const Fraction& x, const Fraction& y) {
    const Fraction t = abs(x - y);
    return half - t + t * t;
}
Fraction third(const Fraction&) { return Fraction(1, 3); }

const Definition definitions[] = {
    {"star", false, falling, falling_mean, Fraction(1, 3)},
    {"extreme", false,
     [](const Fraction& x, const Fraction& y) -> Fraction { return std::min(x, y) - x * y; },
     [](const Fraction& x) -> Fraction { return x * (1 - x) / 2; }, Fraction(1, 12)},
    {"periodic", false, wrapped, third, Fraction(1, 3)},
    {"centered", true,
     [](const Fraction& x, const Fraction& y) -> Fraction {
         return (from_middle(x) + from_middle(y) - abs(x - y)) / 2;
     },
     [](const Fraction& x) -> Fraction {
         return (from_middle(x) - from_middle(x) * from_middle(x)) / 2;
     },
     Fraction(1, 12)},
    {"wraparound", true, wrapped, third, Fraction(1, 3)},
    {"mixture", true,
     [](const Fraction& x, const Fraction& y) -> Fraction {
         const Fraction t = abs(x - y);
         return Fraction(7, 8) - from_middle(x) / 4 - from_middle(y) / 4 - t * 3 / 4 + t * t / 2;
     },
     [](const Fraction& x) -> Fraction {
         return Fraction(2, 3) - from_middle(x) / 4 - from_middle(x) * from_middle(x) / 4;
     },
     Fraction(7, 12)},
    {"modified", true, falling, falling_mean, Fraction(1, 3)},
    {"average", false,
     [](const Fraction& x, const Fraction& y) -> Fraction { return (1 - abs(x - y)) / 2; },
     [](const Fraction& x) -> Fraction { return Fraction(1, 4) + x * (1 - x) / 2; },
     Fraction(1, 3)},
    {"symmetric", true,
     [](const Fraction& x, const Fraction& y) -> Fraction { return 1 - 2 * abs(x - y); },
     [](const Fraction& x) -> Fraction { return 2 * x * (1 - x); }, Fraction(1, 3)},
};

const Definition& definition(std::string_view name) {
    return *std::ranges::find(definitions, name, &Definition::name);
}

/// Oracle: the square by its definition, in fractions.
Fraction exact_square(const PointSet& set, const Definition& kind, const Weights& weights = {}) {
    const std::size_t n = set.count();
    const std::size_t d = set.dimension();
    const Fraction one = kind.projections || !weights.empty() ? 1 : 0;
    const auto w = [&](std::size_t j) { return weights.empty() ? 1 : exactly(weights[j]); };
    Fraction total = 1;
    for (std::size_t j = 0; j < d; ++j) total *= one + w(j) * kind.total;
    Fraction means = 0;
    Fraction pairs = 0;
    for (std::size_t i = 0; i < n; ++i) {
        Fraction mean = 1;
        for (std::size_t j = 0; j < d; ++j) mean *= one + w(j) * kind.mean(exactly(set[i][j]));
        means += mean;
        for (std::size_t k = 0; k < n; ++k) {
            Fraction product = 1;
            for (std::size_t j = 0; j < d; ++j)
                product *= one + w(j) * kind.kernel(exactly(set[i][j]), exactly(set[k][j]));
            pairs += product;
        }
    }
    const Fraction count = n;
    return total - 2 * means / count + pairs / (count * count);
}

/// Oracle: the square for the product of d copies of a set on a line, from sums over the line.
Fraction product_square(std::span<const double> line, const Definition& kind, int d) {
    const Fraction one = kind.projections ? 1 : 0;
    const Fraction n = line.size();
    Fraction mean = 0;
    Fraction pairs = 0;
    for (const double x : line) {
        mean += (one + kind.mean(exactly(x))) / n;
        for (const double y : line) pairs += (one + kind.kernel(exactly(x), exactly(y))) / (n * n);
    }
    Fraction totals = 1;
    Fraction means = 1;
    Fraction products = 1;
    for (int j = 0; j < d; ++j) {
        totals *= one + kind.total;
        means *= mean;
        products *= pairs;
    }
    return totals - 2 * means + products;
}

/// Numbers with 104 bits and an exponent, for products of any size.
struct Precise {
    DoubleDouble number;
    int exponent = 0;

    void multiply(const DoubleDouble& by) {
        number = number * by;
        if (number.high == 0) return;
        const int shift = std::ilogb(number.high);
        number = {std::ldexp(number.high, -shift), std::ldexp(number.low, -shift)};
        exponent += shift;
    }
    [[nodiscard]] DoubleDouble over(int unit) const {
        return {std::ldexp(number.high, exponent - unit), std::ldexp(number.low, exponent - unit)};
    }
};

DoubleDouble negative(const DoubleDouble& x) { return {-x.high, -x.low}; }
DoubleDouble magnitude(const DoubleDouble& x) { return x.high < 0 ? negative(x) : x; }
DoubleDouble times(double a, const DoubleDouble& x) { return DoubleDouble{a, 0} * x; }

/// Kernel on an axis by its definition.
DoubleDouble kernel_of(Kind kind, double x, double y) {
    const DoubleDouble t = magnitude(exact_sum(x, -y));
    const DoubleDouble u = magnitude(exact_sum(x, -0.5));
    const DoubleDouble v = magnitude(exact_sum(y, -0.5));
    const DoubleDouble parabola = t * (t + DoubleDouble{-1, 0});
    switch (kind) {
        case Kind::star:
        case Kind::modified:
            return exact_sum(1, -std::max(x, y));
        case Kind::extreme:
            return times(std::min(x, y), exact_sum(1, -std::max(x, y)));
        case Kind::centered:
            return times(0.5, u + v + negative(t));
        case Kind::mixture:
            return DoubleDouble{0.875, 0} + times(-0.25, u + v + times(3, t)) + times(0.5, t * t);
        case Kind::diaphony: {
            const DoubleDouble sixth{1.0 / 6, 0x1.5555555555555p-57};
            return times(2 * std::numbers::pi * std::numbers::pi, sixth + parabola);
        }
        case Kind::average:
            return times(0.5, DoubleDouble{1, 0} + negative(t));
        case Kind::symmetric:
            return DoubleDouble{1, 0} + times(-2, t);
        default:
            return DoubleDouble{0.5, 0} + parabola;
    }
}

/// Mean of a kernel over y; without x the mean over both arguments.
DoubleDouble mean_of(Kind kind, std::optional<double> x) {
    const DoubleDouble third{1.0 / 3, 0x1.5555555555555p-56};
    const DoubleDouble u = magnitude(exact_sum(x.value_or(0), -0.5));
    switch (kind) {
        case Kind::star:
        case Kind::modified:
            if (!x) return third;
            return times(0.5, DoubleDouble{1, 0} + negative(exact_product(*x, *x)));
        case Kind::extreme:
        case Kind::centered:
            if (!x) return times(0.25, third);
            return kind == Kind::extreme ? times(0.5 * *x, exact_sum(1, -*x))
                                         : times(0.5, u + negative(u * u));
        case Kind::mixture:
            if (!x) return times(1.75, third);
            return times(2, third) + times(-0.25, u + u * u);
        case Kind::diaphony:
            return {0, 0};
        case Kind::average:
        case Kind::symmetric: {
            if (!x) return third;
            const DoubleDouble bow = times(*x, exact_sum(1, -*x));  // x (1 - x)
            return kind == Kind::symmetric ? times(2, bow)
                                           : DoubleDouble{0.25, 0} + times(0.5, bow);
        }
        default:
            return third;
    }
}

/// Oracle: the square pair by pair by the definitions; the error is about 2^-90 of the largest sum,
/// for sums in the range of double.
double plain_square(const PointSet& set, Kind kind, const Weights& weights = {}) {
    const std::size_t n = set.count();
    const bool alone = weights.empty() && !l2::record_of(kind).projections;
    const auto product = [&](const auto& kernel) {
        Precise all{{1, 0}};
        for (std::size_t j = 0; j < set.dimension(); ++j) {
            const DoubleDouble k = times(weights.empty() ? 1 : weights[j], kernel(j));
            all.multiply(alone ? k : DoubleDouble{1, 0} + k);
        }
        return all;
    };
    const Precise total = product([&](std::size_t) { return mean_of(kind, {}); });
    const int unit = total.exponent;
    DoubleDouble means;
    DoubleDouble pairs;
    for (std::size_t i = 0; i < n; ++i) {
        means = means + product([&](std::size_t j) { return mean_of(kind, set[i][j]); }).over(unit);
        for (std::size_t k = 0; k <= i; ++k) {
            const auto pair =
                product([&](std::size_t j) { return kernel_of(kind, set[i][j], set[k][j]); });
            pairs = pairs + times(k < i ? 2 : 1, pair.over(unit));
        }
    }
    const Fraction count = n;
    const auto exact = [](const DoubleDouble& x) { return exactly(x.high) + exactly(x.low); };
    const Fraction squared =
        exact(total.over(unit)) - 2 * exact(means) / count + exact(pairs) / (count * count);
    return std::ldexp(static_cast<double>(squared), unit);
}

Settings settings_of(const char* kinds, const Weights& weights) {
    std::string text;
    for (const double w : weights) text += fmt::format("{}{}", text.empty() ? "" : ",", w);
    Settings settings{{"kind", kinds}};
    if (!weights.empty()) settings.push_back({"weights", text});
    return settings;
}

Report report_of(const PointSet& set, const Weights& weights = {}, const char* kinds = "all") {
    return analyze("l2-discrepancy", set, settings_of(kinds, weights));
}

double squared(const Report& report, std::string_view kind) {
    return report.number(fmt::format("{}.squared", kind));
}

/// |a - b| / b
double off(double a, const Fraction& b) {
    return std::abs(static_cast<double>((exactly(a) - b) / b));
}

PointSet random_set(std::size_t n, std::size_t d, std::uint64_t seed) {
    return make("random", points(n, d), {}, {.seed = seed});
}

/// Random sets, sets with ties, points in corners.
std::vector<PointSet> small_sets(std::size_t d) {
    std::vector<PointSet> sets;
    for (const std::size_t n : {1, 2, 3, 7, 20}) {
        sets.push_back(random_set(n, d, n));
        for (const std::uint64_t steps : {1, 2, 5}) sets.push_back(on_lattice(n, d, steps, n));
    }
    sets.push_back(PointSet(3, d));
    sets.push_back(PointSet(std::vector<double>(3 * d, 1.0), d));
    return sets;
}

PointSet mapped(PointSet set, double (*map)(double)) {
    for (double& x : set.flat()) x = map(x);
    return set;
}

constexpr Kind reflectable[] = {Kind::extreme, Kind::periodic, Kind::centered, Kind::wraparound,
                                Kind::mixture, Kind::diaphony, Kind::average,  Kind::symmetric};

/// Kinds that divide and conquer supports.
std::vector<Kind> divisible(std::size_t dimension) {
    std::vector<Kind> kinds;
    for (const Kind kind : l2::all_kinds)
        if (l2::divides(dimension, kind, {})) kinds.push_back(kind);
    return kinds;
}

std::string name_of(Kind kind) { return std::string(l2::record_of(kind).name); }

/// Midpoints of `side` cells of the line.
std::vector<double> middles(std::size_t side) {
    std::vector<double> line;
    for (std::size_t i = 0; i < side; ++i)
        line.push_back(static_cast<double>(2 * i + 1) / static_cast<double>(2 * side));
    return line;
}

PointSet cubed(const std::vector<double>& line) {
    const std::size_t side = line.size();
    PointSet cube(side * side * side, 3);
    for (std::size_t i = 0; i < cube.count(); ++i) {
        cube[i][0] = line[i % side];
        cube[i][1] = line[i / side % side];
        cube[i][2] = line[i / side / side];
    }
    return cube;
}

}  // namespace

TEST(L2Discrepancy, IsExactOnALineAndInThePlane) {
    for (const std::size_t d : {1, 2})
        for (const PointSet& set : small_sets(d)) {
            const Report report = report_of(set);
            for (const Definition& kind : definitions) {
                const Fraction exact = exact_square(set, kind);
                EXPECT_LE(off(squared(report, kind.name), exact), 0x1p-51)
                    << kind.name << ", n = " << set.count() << ", d = " << d;
            }
        }
}

TEST(L2Discrepancy, IsWithinItsErrorInMoreDimensions) {
    for (const std::size_t d : {3, 4})
        for (const PointSet& set : small_sets(d)) {
            if (d == 4 && set.count() > 7) continue;
            const Report report = report_of(set);
            for (const Definition& kind : definitions) {
                const std::string key = kind.name;
                const double value = std::sqrt(static_cast<double>(exact_square(set, kind)));
                const double error = report.number(key + ".error");
                EXPECT_NEAR(report.number(key + ".value"), value, error) << key;
                EXPECT_LE(error, 2e-13 * value) << key << ", n = " << set.count();
            }
        }
}

TEST(L2Discrepancy, WeighsProjectionsByTheProductOfTheirWeights) {
    const Weights weights{0.25, 1.5, 0, 3};
    for (const std::size_t d : {1, 2, 4}) {
        const PointSet set = on_lattice(12, d, 7, d);
        const Weights mine(weights.begin(), weights.begin() + static_cast<std::ptrdiff_t>(d));
        const Report report = report_of(set, mine);
        for (const Definition& kind : definitions) {
            const Fraction exact = exact_square(set, kind, mine);
            EXPECT_LE(off(squared(report, kind.name), exact), 1e-14) << kind.name << ", d = " << d;
        }
    }
}

// The weights are doubles: 1/3 and 1/9 are rounded, and the exact square is that of these doubles.
TEST(L2Discrepancy, DecayGivesCoordinateJTheWeightJToTheMinusDecay) {
    const std::vector<Weights> by_decay = {
        {1, 1, 1, 1}, {1, 1. / 2, 1. / 3, 1. / 4}, {1, 1. / 4, 1. / 9, 1. / 16}};
    for (std::size_t decay = 0; decay < by_decay.size(); ++decay)
        for (const std::size_t d : {1, 2, 3, 4})
            for (const PointSet& set : small_sets(d)) {
                if (set.count() > 7) continue;
                const Weights mine(by_decay[decay].begin(),
                                   by_decay[decay].begin() + static_cast<std::ptrdiff_t>(d));
                const Report report = analyze("l2-discrepancy", set,
                                              {{"decay", std::to_string(decay)}, {"kind", "all"}});
                for (const Definition& kind : definitions)
                    EXPECT_LE(off(squared(report, kind.name), exact_square(set, kind, mine)), 1e-13)
                        << kind.name << ", decay " << decay << ", n = " << set.count()
                        << ", d = " << d;
            }
}

TEST(L2Discrepancy, WithWeightsOfOneStarIsModifiedAndPeriodicIsWraparound) {
    for (const std::size_t d : {1, 2, 3}) {
        const PointSet set = random_set(50, d, 3);
        const Report plain = report_of(set);
        const Report ones = report_of(set, Weights(d, 1));
        for (const char* kind : {"centered", "wraparound", "mixture", "modified", "diaphony"})
            EXPECT_DOUBLE_EQ(squared(ones, kind), squared(plain, kind)) << kind;
        EXPECT_DOUBLE_EQ(squared(ones, "star"), squared(plain, "modified"));
        EXPECT_DOUBLE_EQ(squared(ones, "periodic"), squared(plain, "wraparound"));
    }
}

TEST(L2Discrepancy, WeightsOfZeroLeaveNothing) {
    for (const std::size_t d : {2, 3})
        for (const Definition& kind : definitions)
            EXPECT_EQ(squared(report_of(random_set(9, d, 1), Weights(d, 0)), kind.name), 0);
}

// scipy.stats.qmc.discrepancy(x, method=...), SciPy 1.10, of the first example of its documentation
// and of qmc.Halton(3, scramble=False).random(100).
TEST(L2Discrepancy, AgreesWithSciPy) {
    PointSet set = points_of({{1, 3}, {2, 6}, {3, 2}, {4, 5}, {5, 1}, {6, 4}});
    for (double& x : set.flat()) x = (2.0 * x - 1.0) / 12.0;
    const Report small = report_of(set);
    EXPECT_NEAR(squared(small, "centered"), 0.008142039609053464, 2e-15);
    EXPECT_NEAR(squared(small, "wraparound"), 0.01684670781892894, 2e-15);
    EXPECT_NEAR(squared(small, "mixture"), 0.014895592206789487, 2e-15);
    EXPECT_NEAR(small.number("star.value"), 0.06833606212558091, 2e-15);

    const Report halton = report_of(make("halton", points(100, 3)));
    EXPECT_NEAR(squared(halton, "centered"), 0.000761690509242019, 1e-14);
    EXPECT_NEAR(squared(halton, "wraparound"), 0.0006200154844040462, 1e-14);
    EXPECT_NEAR(squared(halton, "mixture"), 0.0010599037156469038, 1e-14);
    EXPECT_NEAR(halton.number("star.value"), 0.013345897863399583, 1e-14);
}

// arXiv:2508.04926: the average is the mean of the squared star discrepancies with respect to all
// corners. Hickernell's symmetric discrepancy is (4/3)^d - 2/n sum prod (1 + 2 x - 2 x^2) + 2^d/n^2
// sum prod (1 - t).
TEST(L2Discrepancy, AverageIsTheMeanOfStarOverAllCorners) {
    for (const std::size_t d : {1, 2, 3, 5}) {
        const PointSet set = on_lattice(40, d, 1 << 20, d);
        double sum = 0;
        for (std::size_t corner = 0; corner < std::size_t{1} << d; ++corner) {
            PointSet turned = set;
            for (std::size_t i = 0; i < set.count(); ++i)
                for (std::size_t j = 0; j < d; ++j)
                    if ((corner >> j & 1) != 0) turned[i][j] = 1 - set[i][j];
            sum += squared(report_of(turned, {}, "star"), "star");
        }
        const Report report = report_of(set, {}, "average,symmetric");
        EXPECT_NEAR(squared(report, "average") / std::ldexp(sum, -static_cast<int>(d)), 1, 1e-12);
        EXPECT_NEAR(std::ldexp(squared(report, "average"), 2 * static_cast<int>(d)) /
                        squared(report, "symmetric"),
                    1, 1e-12);
    }
}

// On a line, the centered grid has the least star discrepancy, 1 / (n sqrt 12).
TEST(L2Discrepancy, OfACenteredGridOnALineIsKnown) {
    for (const std::size_t n : {1, 2, 5, 4096, 100'000}) {
        PointSet set(n, 1);
        for (std::size_t i = 0; i < n; ++i)
            set[i][0] = (static_cast<double>(i) + 0.5) / static_cast<double>(n);
        const auto count = static_cast<double>(n);
        // coordinates that are not dyadic have errors of 2^-54
        EXPECT_NEAR(measure("l2-discrepancy", "star.value", set) * count * std::sqrt(12), 1, 1e-13)
            << n;
    }
}

// The sum over m != 0 divisible by n of 1/m^2 is pi^2 / (3 n^2); divided by 2 pi^2 it is that of
// B_2.
TEST(L2Discrepancy, OfARegularGridOnALineIsKnownForPeriodicKinds) {
    for (const std::size_t n : {1, 8, 1024}) {
        const Report report = report_of(make("grid", points(n, 1)));
        const double square = static_cast<double>(n) * static_cast<double>(n);
        EXPECT_DOUBLE_EQ(squared(report, "diaphony"),
                         std::numbers::pi * std::numbers::pi / (3 * square));
        EXPECT_DOUBLE_EQ(squared(report, "periodic"), 1 / (6 * square));
    }
}

TEST(L2Discrepancy, OfOnePointIsTheDiaphonysLargest) {
    const double factor = 1 + std::numbers::pi * std::numbers::pi / 3;
    for (const std::size_t d : {1, 2, 3, 6})
        EXPECT_NEAR(squared(report_of(random_set(1, d, d)), "diaphony") /
                        (std::pow(factor, static_cast<double>(d)) - 1),
                    1, 1e-14);
}

/// Square of the diaphony by cosines up to frequency `most`.
double cosine_square(const PointSet& set, int most) {
    const auto n = static_cast<double>(set.count());
    double sum = 0;
    for (int f = -most; f <= most; ++f)
        for (int g = -most; g <= most; ++g) {
            if (f == 0 && g == 0) continue;
            double real = 0;
            double imaginary = 0;
            for (std::size_t i = 0; i < set.count(); ++i) {
                const double at = 2 * std::numbers::pi * (f * set[i][0] + g * set[i][1]);
                real += std::cos(at);
                imaginary += std::sin(at);
            }
            const double size = std::max(1, std::abs(f)) * std::max(1, std::abs(g));
            sum += (real * real + imaginary * imaginary) / (n * n * size * size);
        }
    return sum;
}

// The error is at most the tail of 1/m^2 on each axis; for random points, with random phases, it is
// about 2 / most (1 + pi^2/3) 2 / n.
TEST(L2Discrepancy, IsTheDiaphonyOfItsFourierSeries) {
    const PointSet set = random_set(8, 2, 4);
    const double whole = squared(report_of(set), "diaphony");
    const double part = cosine_square(set, 200);
    EXPECT_LT(part, whole);
    EXPECT_LT(whole - part, 0.02);
    EXPECT_GT(whole, 1);
}

// J. H. Halton, S. K. Zaremba, Monatsh. Math. 73 (1969) 316-328: Hammersley sets in base 2. At 2^20
// points the square is 10^-11 of its largest term.
TEST(L2Discrepancy, OfHammersleySetsIsHaltonsAndZarembas) {
    for (const int m : {0, 1, 2, 3, 10, 20}) {
        const Fraction n = exactly(std::ldexp(1, m));
        const Fraction scaled = Fraction(m * m, 64) + Fraction(29 * m, 192) + Fraction(3, 8) -
                                Fraction(m, 16) / n + Fraction(1, 4) / n -
                                Fraction(1, 72) / (n * n);
        const PointSet set = make("hammersley", points(std::uint64_t{1} << m, 2));
        EXPECT_LE(off(measure("l2-discrepancy", "star.squared", set), scaled / (n * n)), 0x1p-51)
            << m;
    }
}

// On a lattice all points have the same sum, so one sum suffices. 2^20 points, exact fractions.
TEST(L2Discrepancy, OfALatticeIsASingleSum) {
    const std::uint64_t n = 1 << 20;
    const std::uint64_t step = 443'165;
    PointSet set(n, 2);
    using boost::multiprecision::cpp_int;
    cpp_int periodic = 0;  // sum of (n^2/2 - k n + k^2) on both axes, doubled
    cpp_int wraparound = 0;
    for (std::uint64_t i = 0; i < n; ++i) {
        const std::uint64_t j = i * step % n;
        set[i][0] = std::ldexp(static_cast<double>(i), -20);
        set[i][1] = std::ldexp(static_cast<double>(j), -20);
        const auto a = static_cast<Int128>(n * n - 2 * i * (n - i));
        const auto b = static_cast<Int128>(n * n - 2 * j * (n - j));
        const auto whole = static_cast<Int128>(2 * n * n);
        periodic += cpp_int(a * b);
        wraparound += cpp_int((a + whole) * (b + whole));
    }
    const Fraction size = cpp_int(4) << 100;  // n^4 of the kernels times n, and 4
    const Report report = report_of(set);
    EXPECT_LE(off(squared(report, "periodic"), Fraction(periodic) / size - Fraction(1, 9)),
              0x1p-51);
    EXPECT_LE(off(squared(report, "wraparound"), Fraction(wraparound) / size - Fraction(16, 9)),
              0x1p-51);
    EXPECT_LT(report.number("star.value"), 1e-5);
}

// For the product of two grids, sums of kernels are products of sums over the line.
TEST(L2Discrepancy, OfAProductOfGridsIsAProductOfSums) {
    const std::size_t side = 64;
    PointSet line(side, 1);
    PointSet square(side * side, 2);
    for (std::size_t i = 0; i < side; ++i) {
        line[i][0] = static_cast<double>(2 * i + 1) / 128;
        for (std::size_t j = 0; j < side; ++j) {
            square[i * side + j][0] = static_cast<double>(2 * i + 1) / 128;
            square[i * side + j][1] = static_cast<double>(2 * j + 1) / 128;
        }
    }
    const Report report = report_of(square);
    for (const Definition& kind : definitions)
        EXPECT_LE(off(squared(report, kind.name), product_square(line.flat(), kind, 2)), 0x1p-51)
            << kind.name;
}

TEST(L2Discrepancy, OfThePlaneIsThatOfAllPairs) {
    for (const std::size_t n : {1000, 3001})
        for (const PointSet& set : {random_set(n, 2, n), on_lattice(n, 2, 40, n)}) {
            const Report report = report_of(set);
            for (const Kind kind : l2::all_kinds) {
                const auto pairs = l2::pair_square(set, kind, {}, {});
                EXPECT_NEAR(squared(report, name_of(kind)), pairs.squared,
                            pairs.error + 0x1p-51 * pairs.squared)  // and its own rounding
                    << name_of(kind) << ", n = " << n;
                EXPECT_LE(pairs.error, 1e-9 * pairs.squared) << name_of(kind);
            }
        }
}

// In the plane and by divide and conquer the result is exact; for even sets most digits cancel.
TEST(L2Discrepancy, OfAllPairsIsExactWhereMuchCancels) {
    for (const PointSet& set :
         {random_set(300, 2, 1), on_lattice(277, 2, 40, 2), make("sobol", points(1024, 2)),
          make("sobol", points(1024, 3)), make("halton", points(500, 4))})
        for (const Kind kind : l2::all_kinds) {
            if (set.dimension() > 2 && !l2::divides(set.dimension(), kind, {})) continue;
            const auto pairs = l2::pair_square(set, kind, {}, {.threads = 2});
            const double exact = set.dimension() == 2
                                     ? squared(report_of(set), name_of(kind))
                                     : l2::divide_square(set, kind, {}, {}).squared;
            EXPECT_NEAR(pairs.squared, exact, 0x1p-51 * exact) << name_of(kind);
            EXPECT_LE(pairs.error, 1e-13 * exact) << name_of(kind) << set.dimension();
            EXPECT_EQ(pairs.squared, l2::pair_square(set, kind, {}, {.threads = 1}).squared);
        }
}

// Coordinates that are multiples of 2^-53, and others; equal ones, and adjacent ones.
TEST(L2Discrepancy, OfAllPairsIsThatOfItsDefinition) {
    PointSet close = random_set(131, 3, 3);
    for (std::size_t i = 1; i < close.count(); i += 2)
        for (std::size_t k = 0; k < 3; ++k) close[i][k] = std::nextafter(close[i - 1][k], 0.0);
    PointSet tiny = random_set(100, 3, 4);
    for (double& x : tiny.flat()) x *= 1e-18;
    for (const PointSet& set :
         {random_set(300, 3, 1), on_lattice(277, 4, 40, 2), make("sobol", points(512, 5)),
          make("halton", points(300, 9)), make("rank1-lattice", points(512, 5)), close, tiny,
          random_set(500, 6, 2)})
        for (const Kind kind : l2::all_kinds) {
            const double plain = plain_square(set, kind);
            const auto pairs = l2::pair_square(set, kind, {}, {});
            EXPECT_NEAR(pairs.squared, plain, 0x1p-51 * plain)
                << name_of(kind) << ", d = " << set.dimension();
            EXPECT_LE(pairs.error, 1e-13 * pairs.squared) << name_of(kind);
        }
}

TEST(L2Discrepancy, OfAllPairsIsExactWithWeights) {
    const Weights weights{0.25, 1.5, 0, 3};
    for (const PointSet& set : small_sets(4)) {
        if (set.count() > 7) continue;
        for (const Definition& kind : definitions) {
            const auto which = l2::parse_kinds(kind.name).front();
            EXPECT_LE(off(l2::pair_square(set, which, weights, {}).squared,
                          exact_square(set, kind, weights)),
                      0x1p-51)
                << kind.name << ", n = " << set.count();
        }
    }
}

// The sum of lanes does not depend on the vector width, nor on unused lanes after the last point.
TEST(L2Discrepancy, DoesNotDependOnTheWidthOfVectors) {
    using l2::pair_square;
    for (const PointSet& set : {random_set(150, 3, 1), on_lattice(67, 4, 40, 2),
                                make("halton", points(129, 3)), random_set(2, 3, 1)})
        for (const Kind kind : l2::all_kinds)
            for (const Weights& weights : {Weights{}, Weights(set.dimension(), 0.3)}) {
                const double widest = pair_square(set, kind, weights, {}).squared;
                for (const Vectors vectors : {Vectors::anywhere, Vectors::fours})
                    EXPECT_EQ(pair_square(set, kind, weights, {}, vectors).squared, widest)
                        << name_of(kind);
            }
}

// A square below the range of double, and one that is the difference of numbers near 1.
TEST(L2Discrepancy, SaysWhatItIsOffByWhereNothingIsLeft) {
    const PointSet high = random_set(3, 400, 1);
    const PointSet few = small_sets(3)[2];
    const Weights tiny{1e-40, 1e-40, 1e-40};
    for (const auto& [set, weights, kind] :
         {std::tuple{high, Weights{}, "extreme"}, {few, tiny, "star"}}) {
        std::vector<std::string> told;
        RunContext run;
        run.warn = [&](const std::string& sentence) { told.push_back(sentence); };
        const Report report = analyze("l2-discrepancy", set, settings_of(kind, weights), run);
        const double value = report.number(fmt::format("{}.value", kind));
        EXPECT_FALSE(std::signbit(value));
        EXPECT_GT(report.number(fmt::format("{}.error", kind)), 1e-160);
        EXPECT_EQ(told.size(), 1U);
    }
    EXPECT_GE(report_of(few, tiny, "star").number("star.error"), 1e-20);
}

// Products of hundreds of factors exceed the range of double: star's are near 3^-d, those of small
// weights near 1, and those of large ones huge.
TEST(L2Discrepancy, IsWithinATrillionthInHundredsOfDimensions) {
    const PointSet high = random_set(40, 600, 1);
    const PointSet low = make("sobol", points(64, 410));
    const PointSet many = make("sobol", points(256, 100));
    // First factors small and last ones large, or the other way round.
    PointSet sides = random_set(100, 400, 2);
    for (std::size_t i = 0; i < sides.count(); ++i)
        for (std::size_t j = 0; j < sides.dimension(); ++j)
            sides[i][j] = std::ldexp(sides[i][j] + ((i % 2 == 0) == (j < 200) ? 1 : 0), -1);
    for (const auto& [set, weights, kind] : {std::tuple{high, Weights{}, Kind::star},
                                             {high, {}, Kind::periodic},
                                             {high, {}, Kind::wraparound},
                                             {high, {}, Kind::centered},
                                             {high, {}, Kind::mixture},
                                             {low, {}, Kind::diaphony},
                                             {low, {}, Kind::modified},
                                             {low, {}, Kind::star},
                                             {random_set(40, 250, 1), {}, Kind::extreme},
                                             {many, Weights(100, 1e-6), Kind::star},
                                             {many, Weights(100, 1e-6), Kind::mixture},
                                             {many, Weights(100, 3e2), Kind::extreme},
                                             {many, Weights(100, 100), Kind::diaphony},
                                             {many, Weights(100, 1e-6), Kind::average},
                                             {many, Weights(100, 1), Kind::symmetric},
                                             {high, {}, Kind::average},
                                             {many, Weights(100, 30), Kind::symmetric},
                                             {sides, {}, Kind::star},
                                             {sides, {}, Kind::modified}}) {
        const double plain = plain_square(set, kind, weights);
        const auto pairs = l2::pair_square(set, kind, weights, {});
        EXPECT_NEAR(pairs.squared, plain, 1e-13 * plain + pairs.error)
            << name_of(kind) << ", d = " << set.dimension();
        EXPECT_LE(pairs.error, 1e-12 * plain) << name_of(kind) << ", d = " << set.dimension();
    }
}

TEST(L2Discrepancy, OfDividedSetsIsExact) {
    const Weights weights{0.25, 1.5, 0, 2};
    for (const std::size_t d : {3, 4})
        for (const PointSet& set : small_sets(d))
            for (const Kind kind : divisible(d)) {
                if (kind == Kind::diaphony || (d == 4 && set.count() > 7)) continue;
                const auto& by_definition = definition(name_of(kind));
                EXPECT_LE(off(l2::divide_square(set, kind, {}, {}).squared,
                              exact_square(set, by_definition)),
                          0x1p-51)
                    << name_of(kind) << ", n = " << set.count() << ", d = " << d;
                const Weights mine(weights.begin(),
                                   weights.begin() + static_cast<std::ptrdiff_t>(d));
                if (!l2::divides(d, kind, mine) || set.count() > 7) continue;
                EXPECT_LE(off(l2::divide_square(set, kind, mine, {}).squared,
                              exact_square(set, by_definition, mine)),
                          0x1p-51)
                    << name_of(kind) << ", n = " << set.count() << ", d = " << d;
            }
}

TEST(L2Discrepancy, OfDividedSetsIsThatOfAllPairs) {
    for (const auto& [n, d] : {std::pair<std::size_t, std::size_t>{5000, 3}, {700, 4}})
        for (const PointSet& set : {random_set(n, d, n), on_lattice(n, d, 20, n)})
            for (const Kind kind : divisible(d)) {
                const double divided = l2::divide_square(set, kind, {}, {.threads = 1}).squared;
                const auto pairs = l2::pair_square(set, kind, {}, {});
                EXPECT_NEAR(divided, pairs.squared, pairs.error + 0x1p-52 * divided)
                    << name_of(kind) << ", d = " << d;
                EXPECT_EQ(divided, l2::divide_square(set, kind, {}, {.threads = 3}).squared);
            }
}

TEST(L2Discrepancy, DividesManyPointsInThreeDimensions) {
    const auto line = middles(32);
    const Report report = report_of(cubed(line), {}, "star,centered");
    for (const char* name : {"star", "centered"}) {
        EXPECT_EQ(report.text(std::string(name) + ".method"), "divide-and-conquer");
        EXPECT_LE(off(squared(report, name), product_square(line, definition(name), 3)), 0x1p-51);
    }
    for (const Kind kind :
         {Kind::periodic, Kind::wraparound, Kind::mixture, Kind::average, Kind::symmetric}) {
        EXPECT_TRUE(l2::divide_wins(50'000, 3, kind, {}));
        EXPECT_FALSE(l2::divide_wins(10'000, 3, kind, {}));
        const auto few = middles(11);
        const auto divided = l2::divide_square(cubed(few), kind, {}, {.threads = 2});
        const Fraction exact = product_square(few, definition(name_of(kind)), 3);
        EXPECT_LE(off(divided.squared, exact), 0x1p-51) << name_of(kind);
        EXPECT_NEAR(divided.squared, static_cast<double>(exact), divided.error);
    }
    EXPECT_FALSE(l2::divides(4, Kind::wraparound, {}));
    EXPECT_FALSE(l2::divides(3, Kind::wraparound, {1, 1, 1e5})) << "no room for sums";
    // With weights these kinds need three products, and have room for fewer points.
    EXPECT_TRUE(l2::divide_wins(20'000'000, 3, Kind::extreme, {}));
    EXPECT_FALSE(l2::divide_wins(20'000'000, 3, Kind::extreme, {1, 1, 1}));
    EXPECT_FALSE(l2::divide_wins(20'000'000, 3, Kind::star, {18, 18, 18}));
}

TEST(L2Discrepancy, WeightsWhoseInversesOverflowDoNotCount) {
    const PointSet set = random_set(20, 4, 3);
    for (const Kind kind : l2::all_kinds) {
        const auto with = l2::pair_square(set, kind, {1, 1e-310, 0.5, 5e-324}, {});
        EXPECT_EQ(with.squared, l2::pair_square(set, kind, {1, 0, 0.5, 0}, {}).squared);
        const auto tiny = l2::pair_square(set, kind, {1e-310, 1e-310, 0, 0}, {});
        EXPECT_EQ(tiny.squared, 0);
        EXPECT_GT(tiny.error, 1e-309);
    }
}

TEST(L2Discrepancy, DoesNotDependOnTheOrderOfPointsAndAxes) {
    for (const std::size_t d : {2, 3}) {
        const PointSet set = random_set(700, d, 5);
        PointSet turned = set;
        for (std::size_t i = 0; i < set.count(); ++i)
            for (std::size_t j = 0; j < d; ++j) turned[699 - i][d - 1 - j] = set[i][j];
        const Report before = report_of(set);
        const Report after = report_of(turned);
        for (const Kind kind : l2::all_kinds)
            EXPECT_NEAR(squared(after, name_of(kind)) / squared(before, name_of(kind)), 1,
                        d == 2 ? 0 : 1e-11)
                << name_of(kind);
    }
}

TEST(L2Discrepancy, DoesNotChangeUnderReflectionsButForTheCornerKinds) {
    const PointSet set = on_lattice(300, 2, 1 << 20, 6);
    const PointSet mirror = mapped(set, [](double x) { return 1 - x; });
    const Report before = report_of(set);
    const Report after = report_of(mirror);
    for (const Kind kind : reflectable)
        EXPECT_EQ(squared(after, name_of(kind)), squared(before, name_of(kind))) << name_of(kind);
    EXPECT_NE(squared(after, "star"), squared(before, "star"));
    EXPECT_NE(squared(after, "modified"), squared(before, "modified"));
}

TEST(L2Discrepancy, OfPeriodicKindsDoesNotChangeUnderShiftsOfTheTorus) {
    const PointSet set = on_lattice(300, 2, 1 << 20, 7);
    const PointSet moved =
        mapped(set, [](double x) { return x + 0.3125 < 1 ? x + 0.3125 : x + 0.3125 - 1; });
    const Report before = report_of(set);
    const Report after = report_of(moved);
    for (const char* kind : {"periodic", "wraparound", "diaphony"})
        EXPECT_EQ(squared(after, kind), squared(before, kind)) << kind;
    EXPECT_NE(squared(after, "centered"), squared(before, "centered"));
}

// E squared = (2^-d - 3^-d) / n for n independent points. The mean of 400 squares is nearly normal;
// each test fails by chance at 4.5 standard errors: 7e-6.
TEST(L2Discrepancy, OfRandomSetsHasItsExpectation) {
    for (const std::size_t d : {2, 3}) {
        double sum = 0;
        double squares = 0;
        double stratified = 0;
        const int sets = 400;
        for (int s = 0; s < sets; ++s) {
            const std::uint64_t seed = 100 + static_cast<std::uint64_t>(s);
            const Settings star = {{"kind", "star"}};
            const double x =
                measure("l2-discrepancy", "star.squared", random_set(64, d, seed), star);
            sum += x;
            squares += x * x;
            stratified += measure("l2-discrepancy", "star.squared",
                                  make("jittered", points(64, d), {}, {.seed = seed}), star);
        }
        const double mean = sum / sets;
        const double error = std::sqrt((squares / sets - mean * mean) / sets);
        const auto power = static_cast<double>(d);
        const double expected = (std::pow(2, -power) - std::pow(3, -power)) / 64;
        EXPECT_NEAR(mean, expected, 4.5 * error) << d;
        EXPECT_LT(stratified / sets, expected - 4.5 * error) << "blind, " << d;
    }
}

TEST(L2Discrepancy, DoesNotDependOnTheNumberOfThreads) {
    for (const auto& [n, d] : {std::pair{100'001, 2}, {1001, 4}}) {
        const PointSet set =
            random_set(static_cast<std::size_t>(n), static_cast<std::size_t>(d), 8);
        const Report one = analyze("l2-discrepancy", set, {}, {.threads = 1});
        for (const unsigned threads : {2U, 5U})
            EXPECT_EQ(one, analyze("l2-discrepancy", set, {}, {.threads = threads})) << threads;
    }
}

TEST(L2Discrepancy, TakesTinyCoordinatesAndNegativeZero) {
    const PointSet set = points_of({{1e-300, -0.0}, {0x1p-64, 0.25}, {1, 0x1p-70}});
    const PointSet near = points_of({{0, 0}, {0, 0.25}, {1, 0}});
    const Report a = report_of(set);
    const Report b = report_of(near);
    for (const Kind kind : l2::all_kinds)
        EXPECT_NEAR(squared(a, name_of(kind)), squared(b, name_of(kind)), 1e-15);
}

TEST(L2Discrepancy, GivesTheKindsAskedForInTheOrderOfItsList) {
    const Report report = report_of(random_set(10, 2, 1), {}, "mixture, star,mixture");
    ASSERT_EQ(report.entries().size(), 2U);
    EXPECT_EQ(report.entries()[0].name, "star");
    EXPECT_EQ(report.entries()[1].name, "mixture");
}

TEST(L2Discrepancy, RefusesWrongOptionsAndSaysWhy) {
    const PointSet set = random_set(10, 3, 1);
    const auto error = [&](const Settings& settings) {
        return error_of([&] { analyze("l2-discrepancy", set, settings); });
    };
    EXPECT_EQ(
        error({{"kind", "star,centred"}}),
        "usage: --kind: 'centred' is not a kind of L2 discrepancy | did you mean 'centered'?");
    EXPECT_TRUE(error({{"kind", ""}}).starts_with("usage: --kind: "));
    EXPECT_EQ(error({{"weights", "1,2"}}),
              "usage: --weights: 2 numbers for points of 3 coordinates; expected one for each");
    EXPECT_EQ(error({{"weights", "1,-0.5,2"}}), "usage: --weights: -0.5 is outside [0, 1e6]");
    EXPECT_EQ(error({{"weights", "1,1e7,2"}}), "usage: --weights: 10000000 is outside [0, 1e6]");
    EXPECT_TRUE(error({{"weights", "1,nan,2"}}).starts_with("usage: --weights: "));
    EXPECT_EQ(error({{"weights", "1,1,1"}, {"decay", "2"}}),
              "usage: --weights contradicts --decay; give one of them");
    EXPECT_EQ(error({{"decay", "21"}}), "usage: --decay: 21 is outside [0, 20]");
    RunContext small;
    small.max_memory = 100;
    for (const std::size_t d : {2, 3})
        EXPECT_TRUE(error_of([&] {
                        analyze("l2-discrepancy", random_set(99, d, 1), {}, small);
                    }).starts_with("limit: "));
}

TEST(L2Discrepancy, RefusesWhatNoDoubleHolds) {
    const PointSet set = random_set(5, 2000, 1);
    EXPECT_EQ(error_of([&] { report_of(set, {}, "wraparound"); }),
              "limit: wraparound discrepancy: in 2000 dimensions its square is beyond the largest "
              "double | --kind selects others");
    EXPECT_TRUE(std::isfinite(squared(report_of(set, {}, "star"), "star")));
    // The report has all kinds; diaphony is the first that overflows: 500 log10(1 + pi^2/3) = 316.
    const Report all = report_of(random_set(3, 500, 1));
    EXPECT_EQ(all.text("diaphony.missing"),
              "in 500 dimensions its square is beyond the largest double");
    EXPECT_EQ(all.find("diaphony.value"), nullptr);
    for (const char* kind :
         {"star", "extreme", "periodic", "centered", "mixture", "average", "symmetric"})
        EXPECT_TRUE(std::isfinite(squared(all, kind))) << kind;
}

TEST(L2Discrepancy, StopsAtOnceInManyDimensions) {
    const PointSet set = random_set(20'000, 6, 1);
    std::stop_source source;
    RunContext run{.threads = 2, .stop = source.get_token()};
    run.progress = [&](double) { source.request_stop(); };
    EXPECT_EQ(error_of([&] { analyze("l2-discrepancy", set, {}, run); }), "cancelled: interrupted");
}

// One point has squared = (1 + pi^2 / 3)^d - 1. The constant 2 pi^2 in float64 would be off by more
// than the error that is told.
TEST(L2Discrepancy, DiaphonyInManyDimensionsIsWithinItsError) {
    const long double factor =
        1 + std::numbers::pi_v<long double> * std::numbers::pi_v<long double> / 3;
    const PointSet one(1, 300);
    const Report found = analyze("l2-discrepancy", one, {{"kind", "diaphony"}});
    const long double exact = std::sqrt(std::pow(factor, 300.0L) - 1);
    EXPECT_LE(std::abs(found.number("diaphony.value") - exact), found.number("diaphony.error"));
}

}  // namespace stipple::testing::l2_discrepancy_test
