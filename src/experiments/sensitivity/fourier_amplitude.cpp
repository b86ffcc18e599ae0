// SPDX-License-Identifier: MIT
//
// Extended FAST: the design has a curve for each input i. On this curve input i oscillates with a
// high frequency w = floor((N - 1) / (2 M)), and all other inputs with frequencies up to w / (2 M),
// M being --harmonics. With the power P(f) = |1/N sum_s y_s exp(-2 pi i f s / N)|^2 of the output
// along the curve,
//
//     S_i = sum_{p = 1..M} P(p w) / V,    ST_i = 1 - sum_{f = 1..w/2} P(f) / V,
//
// where V is the sum of P(f) over all f in [1, (N - 1) / 2].
//
// Shape   n = N k rows, curve after curve, N > 4 M^2.
// Cost    O(n N / (4 M)).
// Beware  errors come from aliasing and from overlapping harmonics, and no interval shows them. If
//         harmonics above the M-th matter, S is too small, by an eighth for an input with two levels
//         of 1/4 and 3/4, and ST is too small or too large, as in many dimensions.
// Source  A. Saltelli, S. Tarantola, K. P.-S. Chan, Technometrics 41 (1999) 39-56,
//         doi:10.1080/00401706.1999.10485594.
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "experiments/sensitivity/methods.hpp"
#include "math/functions/trigonometry.hpp"

namespace stipple::analyzers::sensitivity {
namespace {

/// Fourier powers of n outputs along a curve.
class Spectrum {
  public:
    Spectrum(std::size_t n, std::size_t harmonics)
        : n_(n), harmonics_(harmonics), frequency_((n - 1) / (2 * harmonics)), turns_(n) {
        for (std::size_t s = 0; s < n; ++s)
            turns_[s] = cos_sin_turns(static_cast<double>(s) / static_cast<double>(n));
    }

    /// S and ST of outputs with mean 0, which are not constant.
    [[nodiscard]] std::pair<double, double> shares(std::span<const double> y,
                                                   const RunContext& run) const {
        double all = 0;
        double nyquist = 0;
        for (std::size_t s = 0; s < n_; ++s) {
            all += y[s] * y[s];
            nyquist += s % 2 == 0 ? y[s] : -y[s];
        }
        all /= static_cast<double>(n_);
        if (n_ % 2 == 0)
            all -= nyquist / static_cast<double>(n_) * nyquist / static_cast<double>(n_);
        std::vector<double> low(frequency_ / 2);
        for_each_block(run, low.size(), 16, [&](const Block& block) {
            for (std::uint64_t f = block.first; f < block.last; ++f) low[f] = power(y, f + 1);
        });
        double others = 0;
        for (const double p : low) others += 2 * p;
        return {own_share(y, all), 1 - others / all};
    }

    /// Fraction of the variance `all` that is at the harmonics of w.
    [[nodiscard]] double own_share(std::span<const double> y, double all) const {
        double own = 0;
        for (std::size_t p = 1; p <= harmonics_; ++p) own += 2 * power(y, p * frequency_);
        return own / all;
    }

  private:
    [[nodiscard]] double power(std::span<const double> y, std::size_t f) const {
        double re = 0;
        double im = 0;
        for (std::size_t s = 0, at = 0; s < n_; ++s) {
            re += y[s] * turns_[at].cos;
            im += y[s] * turns_[at].sin;
            at += f;
            if (at >= n_) at -= n_;
        }
        const auto n = static_cast<double>(n_);
        return re / n * re / n + im / n * im / n;
    }

    std::size_t n_;
    std::size_t harmonics_;
    std::size_t frequency_;
    std::vector<CosSin> turns_;
};

/// Ranks of coordinate j along curve i of n rows, minus their mean.
std::vector<double> along(const PointSet& design, std::size_t i, std::size_t j, std::size_t n) {
    std::vector<double> x(n);
    for (std::size_t s = 0; s < n; ++s) x[s] = design[i * n + s][j];
    x = ranks_of(x);
    for (double& value : x) value -= 0.5;
    return x;
}

/// Determines M of a closed curve with the frequency w = floor((n - 1) / (2 M)) from its 2 w
/// crossings of the mean. Since n > 4 M^2, no other M has this w. Returns 0 if no M fits.
std::size_t harmonics_of(std::span<const double> curve) {
    std::size_t crossings = 0;
    for (std::size_t s = 0; s < curve.size(); ++s)
        crossings += (curve[s] > 0) != (curve[(s + 1) % curve.size()] > 0) ? 1 : 0;
    const std::size_t w = crossings / 2;
    return w == 0 ? 0 : (curve.size() - 1) / (2 * w);
}

}  // namespace

Layout find_curves(const PointSet& design, std::optional<std::size_t> asked,
                   const RunContext& run) {
    const std::size_t k = design.dimension();
    const std::size_t n = design.count() / k;
    if (design.count() % k != 0)
        return {.trouble = fmt::format("{} rows are not a multiple of {}", design.count(), k)};
    const std::size_t harmonics = harmonics_of(along(design, 0, 0, n));
    if (harmonics == 0)
        return {.trouble = "coordinate 1 oscillates too fast on curve 1, or not at all"};
    if (asked.value_or(harmonics) != harmonics)
        return {.trouble =
                    fmt::format("on curve 1, coordinate 1 oscillates as for {} harmonics, not {}",
                                harmonics, *asked)};
    if (n <= 4 * harmonics * harmonics)
        return {.trouble = fmt::format("curves have {} rows, but {} harmonics need {}", n,
                                       harmonics, 4 * harmonics * harmonics + 1)};
    const Spectrum spectrum(n, harmonics);
    // own_share() is 0.998 for a triangle wave and M = 4; it is smaller for discrete inputs.
    constexpr double own_least = 0.7;
    constexpr double others_most = 0.1;
    for (std::size_t i = 0; i < k; ++i)
        for (std::size_t j = 0; j < k; ++j) {
            run.check_stop();
            const auto x = along(design, i, j, n);
            double all = 0;
            for (const double value : x) all += value * value / static_cast<double>(n);
            const double share = all > 0 ? spectrum.own_share(x, all) : 0;
            if (i == j ? share < own_least : share > others_most)
                return {.trouble = fmt::format(
                            "on curve {}, {:.2g} of the variance of coordinate {} is at the "
                            "curve's frequency and its harmonics; expected {}",
                            i + 1, share, j + 1, i == j ? "nearly all" : "nearly nothing")};
        }
    return {.group = n, .harmonics = harmonics};
}

Effects fourier_amplitudes(const Layout& layout, const Inputs& inputs, const Response& response,
                           const RunContext& run) {
    const std::size_t k = inputs.size();
    const std::size_t n = layout.group;
    const auto runs = succeeded(response.y);
    if (runs.size() < response.y.size())
        fail(ErrorKind::input,
             "the output {} has {} failed runs; a curve with gaps has no spectrum: repeat these "
             "runs, or use --method rank or chaos",
             response.name, response.y.size() - runs.size());
    const Centred f = centred(response.y);
    const Spectrum spectrum(n, layout.harmonics);
    Effects effects{.used = response.y.size(),
                    .samples = n,
                    .mean = f.mean,
                    .variance = held(f.variance() * f.unit * f.unit),
                    .kinds = {{"first", std::vector<Index>(k)}, {"total", std::vector<Index>(k)}}};
    for (std::size_t i = 0; i < k; ++i) {
        const auto whole = static_cast<double>(k);
        const RunContext part =
            run.stage(static_cast<double>(i) / whole, static_cast<double>(i + 1) / whole);
        const std::span curve = std::span(f.z).subspan(i * n, n);
        std::vector<double> y(curve.begin(), curve.end());
        double mean = 0;
        for (const double value : y) mean += value / static_cast<double>(n);
        for (double& value : y) value -= mean;
        const bool constant = is_constant(std::span(response.y).subspan(i * n, n));
        const auto [first, total] = constant ? std::pair(none, none) : spectrum.shares(y, part);
        effects.kinds[0].of[i].value = first;
        effects.kinds[1].of[i].value = total;
        effects.missing.push_back(constant ? "the output is constant on the input's curve" : "");
    }
    return effects;
}

}  // namespace stipple::analyzers::sensitivity
