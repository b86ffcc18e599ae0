// SPDX-License-Identifier: MIT
//
// Periodogram of n points: their power at integer frequency vectors f,
//
//     P(f) = | sum_j exp(-2 pi i f.x_j) |^2 / n,        f in {-F..F}^d,
//
// so that white noise has mean 1. From it, with f = 0 left out everywhere:
//
//     radial power       P_k = mean of P over the ring k - 1/2 <= |f| < k + 1/2,  k = 1..F
//     anisotropy         variance of P over the ring (mean squared deviation) / P_k^2, in dB;
//                        no less than -100 dB, which is what a ring of equal powers gets
//     effective Nyquist  R / 2, where R is the largest radius, at most F, of a disk |f| < R that
//                        has a mean power of at most 1/10; between the rims of rings the mean is
//                        interpolated. 0 if no disk has
//     oscillation        10 times the root of the mean of (P_k - 1)^2 over the frequency vectors of
//                        rings a..b: a is the first with P_k >= 0.98 (else that of most power),
//                        b = a + 5 n^(1/d), at most F
//
// Shape   points in [0, 1]^d, d = 1, 2, 3; the 2-D power has row = f_1, column = f_0, -F..F.
// Units   cycles a unit length; published tables give the effective Nyquist frequency over
//         `regular_nyquist`, n^(1/d) / 2, which is that of a regular grid.
// Cost    O(n w^d + (4F)^d log F), see math/nufft.hpp; `direct` O(n (2F)^d).
// Beware  one set's power has a standard deviation of 100 % at every frequency: average sets. A
//         mean of anisotropies is not the anisotropy of the mean power; so the power itself goes
//         into the report, and refine() works out all else from its mean.
// Source  R. A. Ulichney, Proc. IEEE 76 (1988) 56-79, doi:10.1109/5.3288 (radial mean, anisotropy);
//         D. Heck, T. Schloemer, O. Deussen, ACM Trans. Graph. 32:3 (2013) 25 (effective Nyquist
//         frequency, oscillation; thresholds as in the authors' program psa).

#include <algorithm>
#include <cmath>

#include "analyzers/analyzer.hpp"
#include "core/error.hpp"
#include "math/nufft.hpp"

namespace stipple::analyzers {
namespace {

constexpr Param<std::int64_t> max_frequency{
    .name = "max-frequency",
    .low = 1,
    .high = 1'000'000,
    .optional = true,
    .unit = "cycles a unit length",
    .help =
        "Frequencies go from -F to F along each axis; without it twice n^(1/d), rounded up, "
        "but at least 16 and at most 65536, 1024 or 64 in 1, 2 or 3 dimensions"};

constexpr Param<Choice> method{
    .name = "method",
    .fallback = "nufft",
    .choices = "nufft|direct",
    .help = "nufft: non-uniform fast Fourier transform; direct: the plain sum, slow"};

constexpr Param<double> tolerance{
    .name = "tolerance",
    .fallback = 1e-9,
    .low = 1e-13,
    .high = 1e-1,
    .help = "Largest error of the complex sums, relative to sqrt(n), of the method nufft"};

constexpr Param<Path> grid_file{
    {.name = "grid",
     .help = "Saves the 2-D power to this .npy file: row = fy, column = fx, from -F to F"}};

constexpr Param<Path> image_file{
    {.name = "image",
     .help = "Draws the 2-D power to this .png file, grey = P / (1 + P), white noise middle grey"}};

constexpr double lowest_db = -100;

std::size_t default_frequency(std::size_t count, std::size_t dimension) {
    constexpr double most[] = {0, 65536, 1024, 64};
    const double twice =
        2 * std::pow(static_cast<double>(count), 1 / static_cast<double>(dimension));
    // A root such as 1000^(1/3) may come out a little above the whole number that it is.
    return static_cast<std::size_t>(std::clamp(std::ceil(twice - 1e-9), 16.0, most[dimension]));
}

/// Calls visit(ring, power) for all frequency vectors in rings 1..F. The power is stored with one
/// row for each (f_2, f_1), so its shape tells the dimension. In integers, k - 1/2 <= |f| < k + 1/2
/// is k^2 - k < |f|^2 <= k^2 + k.
template <class Visit>
void for_each_in_rings(const Grid& power, const RunContext& run, Visit&& visit) {
    const auto width = static_cast<std::int64_t>(power.columns);
    const std::int64_t last = width / 2;
    for (std::size_t row = 0; row < power.rows; ++row) {
        run.check_stop();
        const auto line = static_cast<std::int64_t>(row);
        const std::int64_t f1 = power.rows == 1 ? 0 : line % width - last;
        const std::int64_t f2 = power.rows <= power.columns ? 0 : line / width - last;
        const std::int64_t across = f1 * f1 + f2 * f2;
        const double* values = power.values.data() + row * power.columns;
        std::int64_t ring = 0;
        for (std::int64_t f0 = 0; f0 <= last; ++f0) {
            const std::int64_t square = across + f0 * f0;
            while (ring * ring + ring < square) ++ring;
            if (ring > last) break;
            if (ring == 0) continue;
            visit(static_cast<std::size_t>(ring), values[last + f0]);
            if (f0 > 0) visit(static_cast<std::size_t>(ring), values[last - f0]);
        }
    }
}

/// Means and variances over rings; index 0 is ring 1.
struct Rings {
    std::vector<double> power;
    std::vector<double> variance;
    std::vector<std::int64_t> cells;
};

Rings rings_of(const Grid& power, const RunContext& run) {
    const std::size_t last = power.columns / 2;
    Rings rings{std::vector<double>(last), std::vector<double>(last),
                std::vector<std::int64_t>(last)};
    for_each_in_rings(power, run, [&](std::size_t k, double p) {
        rings.power[k - 1] += p;
        ++rings.cells[k - 1];
    });
    for (std::size_t i = 0; i < last; ++i) rings.power[i] /= static_cast<double>(rings.cells[i]);
    for_each_in_rings(power, run, [&](std::size_t k, double p) {
        const double deviation = p - rings.power[k - 1];
        rings.variance[k - 1] += deviation * deviation;
    });
    for (std::size_t i = 0; i < last; ++i) rings.variance[i] /= static_cast<double>(rings.cells[i]);
    return rings;
}

double decibels(double variance, double mean) {
    const double ratio = variance / (mean * mean);
    return ratio > 1e-10 ? 10 * std::log10(ratio) : lowest_db;  // also where mean is 0: 0 / 0
}

double effective_nyquist(const Rings& rings) {
    constexpr double threshold = 0.1;
    double radius = 0;
    double sum = 0;
    double cells = 0;
    double before = threshold;  // mean inside the last rim; at the first there is none
    for (std::size_t i = 0; i < rings.power.size(); ++i) {
        sum += rings.power[i] * static_cast<double>(rings.cells[i]);
        cells += static_cast<double>(rings.cells[i]);
        const double mean = sum / cells;
        const double rim = static_cast<double>(i) + 1.5;
        if (mean <= threshold)
            radius = rim;
        else if (before < threshold)
            radius = rim - (mean - threshold) / (mean - before);
        before = mean;
    }
    return std::min(radius, static_cast<double>(rings.power.size())) / 2;
}

double oscillation(const Rings& rings, double regular_nyquist) {
    const auto& power = rings.power;
    auto first = std::ranges::find_if(power, [](double p) { return p >= 0.98; });
    if (first == power.end()) first = std::ranges::max_element(power);
    const auto a = static_cast<std::size_t>(first - power.begin());
    const double reach = static_cast<double>(a) + std::round(10 * regular_nyquist);
    const std::size_t b = reach < static_cast<double>(power.size())
                              ? static_cast<std::size_t>(reach)
                              : power.size() - 1;
    double sum = 0;
    double cells = 0;
    for (std::size_t i = a; i <= b; ++i) {
        const auto weight = static_cast<double>(rings.cells[i]);
        sum += weight * (power[i] - 1) * (power[i] - 1);
        cells += weight;
    }
    return 10 * std::sqrt(sum / cells);
}

/// Puts all that follows from the power into the report.
void summarize(Report& report, const Grid& power, double regular_nyquist, const RunContext& run) {
    const Rings rings = rings_of(power, run);
    Report::Curve frequency;
    Report::Curve anisotropy;
    for (std::size_t i = 0; i < rings.power.size(); ++i) {
        frequency.push_back(static_cast<double>(i + 1));
        anisotropy.push_back(decibels(rings.variance[i], rings.power[i]));
    }
    Report radial;
    radial.add("frequency", std::move(frequency), "cycles a unit length");
    radial.add("power", rings.power);
    radial.add("anisotropy_db", std::move(anisotropy), "dB");
    radial.add("cells", rings.cells);
    report.add("radial", std::move(radial));
    report.add("effective_nyquist", effective_nyquist(rings), "cycles a unit length");
    report.add("oscillation", oscillation(rings, regular_nyquist));
}

/// Power at all frequencies from the sums at half of them; P(-f) = P(f) holds to the last bit.
Grid power_of(const FourierSums& sums, std::size_t count, const RunContext& run) {
    const std::size_t last = sums.max_frequency;
    const std::size_t width = 2 * last + 1;
    Grid power{.rows = sums.values.size() / (last + 1), .columns = width, .values = {}};
    power.values.resize(power.rows * width);
    const auto n = static_cast<double>(count);
    for (std::size_t row = 0; row < power.rows; ++row) {
        run.check_stop();
        const auto* half = sums.values.data() + row * (last + 1);
        double* values = power.values.data() + row * width;
        double* mirrored = power.values.data() + (power.rows - 1 - row) * width;
        for (std::size_t f = 0; f <= last; ++f)
            values[last + f] = mirrored[last - f] = std::norm(half[f]) / n;
    }
    power.values[power.values.size() / 2] = n;  // f = 0, exactly
    return power;
}

FourierSums sums_of(const PointSet& points, std::size_t frequency, const Values& options,
                    const RunContext& run) {
    const std::size_t d = points.dimension();
    const std::string what = fmt::format("--max-frequency {}", frequency);
    const double half = fourier_sums_size(d, frequency);
    if (options[method] == "direct") {
        run.need_memory(half * 32, what);
        return fourier_sums_directly(points.flat(), d, frequency, run);
    }
    const Nufft nufft(points.count(), d, frequency, options[tolerance]);
    run.need_memory(std::max(nufft.bytes(), half * 32), what);
    return nufft.transform(points.flat(), run);
}

Report analyze(const PointSet& points, const Values& options, const RunContext& run) {
    const std::size_t d = points.dimension();
    const std::size_t n = points.count();
    for (const auto& file : {grid_file, image_file})
        if (options.given(file) && d != 2)
            fail(ErrorKind::usage, "--{}: takes points of dimension 2; these have {}", file.name,
                 d);
    const std::size_t frequency = options.given(max_frequency)
                                      ? static_cast<std::size_t>(options[max_frequency])
                                      : default_frequency(n, d);
    const double regular = std::pow(static_cast<double>(n), 1 / static_cast<double>(d)) / 2;
    Report report;
    report.add("max_frequency", static_cast<std::int64_t>(frequency));
    Grid power = power_of(sums_of(points, frequency, options, run), n, run);
    summarize(report, power, regular, run);
    report.add("regular_nyquist", regular, "cycles a unit length");
    report.add("method", options[method]);
    const double asked = options[method] == "direct" ? 0 : options[tolerance];
    report.add("tolerance", std::max(asked, rounding_floor(n)));
    report.add("grid", std::move(power));
    return report;
}

void refine(Report& mean, std::size_t, const Values&) {
    const auto* grid = mean.find("grid");
    if (grid == nullptr)
        fail_with_hint(ErrorKind::usage, "give them one --max-frequency",
                       "--average: the spectra have different frequencies, as the sets have "
                       "different numbers of points");
    const auto* power = std::get_if<Grid>(grid);
    summarize(mean, *power, mean.number("regular_nyquist"), {});
}

}  // namespace

Analyzer periodogram() {
    return {
        .name = "periodogram",
        .summary = "Power spectrum at integer frequencies, its radial mean and anisotropy",
        .source =
            "Ulichney 1988, doi:10.1109/5.3288; Heck, Schloemer, Deussen 2013, ACM TOG 32(3):25",
        .traits = {.min_dimension = 1, .max_dimension = 3},
        .options = Schema(max_frequency, method, tolerance, grid_file, image_file),
        .results =
            {{"max_frequency", "F: frequencies go from -F to F"},
             {"radial.frequency", "Frequency k of each ring, k - 1/2 <= |f| < k + 1/2"},
             {"radial.power", "Mean power over the ring; white noise has 1"},
             {"radial.anisotropy_db",
              "Variance over the ring / squared mean, in dB, at least -100; white noise has 0, "
              "less 10 log10 of the number of sets averaged"},
             {"radial.cells", "Frequency vectors in the ring"},
             {"effective_nyquist",
              "Half the largest radius, at most F, within which the mean power is at most 0.1"},
             {"oscillation",
              "10 x root mean square of radial power - 1, from where it first reaches 0.98"},
             {"regular_nyquist", "n^(1/d) / 2, the Nyquist frequency of a regular grid"},
             {"method", "nufft or direct"},
             {"tolerance",
              "Bound of the error of the complex sums, relative to sqrt(n); no less than what "
              "rounding leaves where all points are in phase"}},
        .analyze = analyze,
        .refine = refine};
}

}  // namespace stipple::analyzers
