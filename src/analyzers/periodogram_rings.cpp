// SPDX-License-Identifier: MIT
#include "analyzers/periodogram_rings.hpp"

#include <algorithm>
#include <cmath>

namespace stipple::analyzers {
namespace {

constexpr double lowest_db = -100;

/// Calls visit(ring, |f|^2, power) for half of the frequency vectors in rings 1..F, of which the
/// others are the opposites. In integers, k - 1/2 <= |f| < k + 1/2 is k^2 - k < |f|^2 <= k^2 + k.
template <class Visit>
void for_half_of_rings(const Grid& power, const RunContext& run, Visit&& visit) {
    const auto width = static_cast<std::int64_t>(power.columns);
    const std::int64_t last = width / 2;
    for (std::size_t row = power.rows / 2; row < power.rows; ++row) {
        run.check_stop();
        const auto line = static_cast<std::int64_t>(row);
        const std::int64_t f1 = power.rows == 1 ? 0 : line % width - last;
        const std::int64_t f2 = power.rows <= power.columns ? 0 : line / width - last;
        const std::int64_t across = f1 * f1 + f2 * f2;
        const double* values = power.values.data() + row * power.columns;
        const bool centre = row == power.rows / 2;
        std::int64_t ring = 0;
        for (std::int64_t f0 = 0; f0 <= last; ++f0) {
            const std::int64_t square = across + f0 * f0;
            while (ring * ring + ring < square) ++ring;
            if (ring > last) break;
            if (ring == 0) continue;
            const auto of = static_cast<std::size_t>(ring);
            visit(of, square, values[last + f0]);
            if (f0 > 0 && !centre) visit(of, square, values[last - f0]);
        }
    }
}

}  // namespace

Rings rings_of(const Grid& power, const RunContext& run) {
    const std::size_t last = power.columns / 2;
    Rings rings{std::vector<double>(last), std::vector<double>(last),
                std::vector<std::int64_t>(last)};
    for_half_of_rings(power, run, [&](std::size_t k, std::int64_t, double p) {
        rings.power[k - 1] += p;
        ++rings.cells[k - 1];
    });
    for (std::size_t i = 0; i < last; ++i) rings.power[i] /= static_cast<double>(rings.cells[i]);
    for_half_of_rings(power, run, [&](std::size_t k, std::int64_t, double p) {
        const double deviation = p - rings.power[k - 1];
        rings.variance[k - 1] += deviation * deviation;
    });
    for (std::size_t i = 0; i < last; ++i) {
        rings.variance[i] /= static_cast<double>(rings.cells[i]);
        rings.cells[i] *= 2;
    }
    return rings;
}

double anisotropy_db(double variance, double mean, double least) {
    if (!(mean > least)) return lowest_db;
    const double ratio = variance / (mean * mean);
    return ratio > 1e-10 ? 10 * std::log10(ratio) : lowest_db;
}

double effective_nyquist(const Grid& power, const RunContext& run) {
    constexpr double threshold = 0.1;
    const std::size_t last = power.columns / 2;
    const bool line = power.rows == 1;  // where squares are few, and far apart
    struct Shell {
        double power = 0;
        double cells = 0;
    };
    std::vector<Shell> shells(line ? last + 1 : last * last + 1);  // by |f|, or its square
    for_half_of_rings(power, run, [&](std::size_t ring, std::int64_t square, double p) {
        const std::size_t at = line ? ring : static_cast<std::size_t>(square);
        if (at >= shells.size()) return;
        shells[at].power += p;
        shells[at].cells += 1;
    });
    double radius = 0;
    Shell inside;
    bool low = false;
    for (std::size_t at = 1; at < shells.size(); ++at) {
        if (shells[at].cells == 0) continue;
        const auto number = static_cast<double>(at);
        if (low) radius = line ? number : std::sqrt(number);
        inside.power += shells[at].power;
        inside.cells += shells[at].cells;
        low = inside.power <= threshold * inside.cells;
    }
    return (low ? static_cast<double>(last) : radius) / 2;
}

Oscillation oscillation(const Rings& rings, double regular_nyquist) {
    const auto& power = rings.power;
    auto first = std::ranges::find_if(power, [](double p) { return p >= 0.98; });
    const bool reached = first != power.end();
    if (!reached) first = std::ranges::max_element(power);
    const auto a = static_cast<std::size_t>(first - power.begin());
    const double reach = static_cast<double>(a) + std::round(10 * regular_nyquist);
    const bool cut = reach >= static_cast<double>(power.size());
    const std::size_t b = cut ? power.size() - 1 : static_cast<std::size_t>(reach);
    double sum = 0;
    double cells = 0;
    for (std::size_t i = a; i <= b; ++i) {
        const auto weight = static_cast<double>(rings.cells[i]);
        sum += weight * (power[i] - 1) * (power[i] - 1);
        cells += weight;
    }
    return {10 * std::sqrt(sum / cells), reached && !cut};
}

double total_variation(const Rings& rings) {
    double sum = 0;
    double cells = 0;
    for (std::size_t i = 0; i < rings.power.size(); ++i) {
        const auto weight = static_cast<double>(rings.cells[i]);
        sum += weight * std::abs(rings.power[i] - 1);
        cells += weight;
    }
    return sum / cells / 2;
}

std::optional<double> low_frequency_exponent(const Rings& rings, double regular_nyquist,
                                             double least) {
    const auto wanted = static_cast<std::size_t>(std::max(4.0, regular_nyquist / 2));
    const std::size_t last = std::min(wanted, rings.power.size());
    std::size_t found = 0;
    double weights = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (std::size_t i = 0; i < last; ++i) {
        if (rings.power[i] <= least) continue;
        const auto weight = static_cast<double>(rings.cells[i]);
        const double u = std::log(static_cast<double>(i + 1));
        const double v = std::log(rings.power[i]);
        weights += weight;
        x += weight * u;
        y += weight * v;
        xx += weight * u * u;
        xy += weight * u * v;
        ++found;
    }
    if (found < 3) return std::nullopt;
    return (weights * xy - x * y) / (weights * xx - x * x);
}

}  // namespace stipple::analyzers
