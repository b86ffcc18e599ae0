// SPDX-License-Identifier: MIT
#include "analyzers/rings.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "math/functions/logarithm.hpp"

namespace stipple::analyzers {
namespace {

constexpr double lowest_db = -100;

/// Half of the rows of a spectrum; the other half contains the opposite frequency vectors.
struct HalfOfRows {
    explicit HalfOfRows(const Grid& of)
        : power(of), width(static_cast<std::int64_t>(of.columns)), last(width / 2) {}

    /// Calls visit(centre, f_1^2 + f_2^2, middle) for each row: `centre` points to the power at f_0
    /// = 0, and `middle` is true for the row that contains the opposites of its own vectors.
    template <class Visit>
    void visit(const RunContext& run, Visit&& visit) const {
        for (std::size_t row = power.rows / 2; row < power.rows; ++row) {
            run.check_stop();
            const auto line = static_cast<std::int64_t>(row);
            const std::int64_t f1 = power.rows == 1 ? 0 : line % width - last;
            const std::int64_t f2 = power.rows <= power.columns ? 0 : line / width - last;
            visit(power.values.data() + row * power.columns + last, f1 * f1 + f2 * f2,
                  row == power.rows / 2);
        }
    }

    const Grid& power;
    std::int64_t width;
    std::int64_t last;  ///< F, the highest frequency
};

/// Calls visit(ring, power) for one of each pair of opposite frequency vectors in rings 1..F. In
/// integers, k - 1/2 <= |f| < k + 1/2 is k^2 - k < |f|^2 <= k^2 + k.
template <class Visit>
void for_half_of_rings(const Grid& power, const RunContext& run, Visit&& visit) {
    const HalfOfRows rows(power);
    rows.visit(run, [&](const double* centre, std::int64_t across, bool middle) {
        std::int64_t ring = 0;
        for (std::int64_t f0 = 0; f0 <= rows.last; ++f0) {
            const std::int64_t square = across + f0 * f0;
            while (ring * ring + ring < square) ++ring;
            if (ring > rows.last) break;
            if (ring == 0) continue;
            const auto of = static_cast<std::size_t>(ring);
            visit(of, centre[f0]);
            if (f0 > 0 && !middle) visit(of, centre[-f0]);
        }
    });
}

}  // namespace

Rings rings_of(const Grid& power, const RunContext& run) {
    const std::size_t last = power.columns / 2;
    Rings rings{std::vector<double>(last), std::vector<double>(last),
                std::vector<std::int64_t>(last)};
    for_half_of_rings(power, run, [&](std::size_t k, double p) {
        rings.power[k - 1] += p;
        ++rings.cells[k - 1];
    });
    for (std::size_t i = 0; i < last; ++i) rings.power[i] /= static_cast<double>(rings.cells[i]);
    for_half_of_rings(power, run, [&](std::size_t k, double p) {
        const double deviation = p - rings.power[k - 1];
        rings.variance[k - 1] += deviation * deviation;
    });
    for (std::size_t i = 0; i < last; ++i) {
        rings.variance[i] /= static_cast<double>(rings.cells[i]);
        rings.cells[i] *= 2;
    }
    return rings;
}

double decibels(double ratio) {
    constexpr DoubleDouble per_log{std::numbers::log10e, 1.098319650216765e-17};
    return 10 * (logarithm_parts(ratio) * per_log).high;  // exact for powers of 10
}

double anisotropy_db(double variance, double mean, double least) {
    if (!(mean > least)) return lowest_db;
    const double ratio = variance / (mean * mean);
    return ratio > 1e-10 ? decibels(ratio) : lowest_db;
}

namespace {

/// Sums over half of the frequency vectors of one length.
struct Shell {
    double power = 0;
    double cells = 0;

    void add(const Shell& more) {
        power += more.power;
        cells += more.cells;
    }
    [[nodiscard]] bool is_low() const { return power <= 0.1 * cells; }
};

/// Integer square root of x >= 0, rounded down.
std::int64_t whole_root(std::int64_t x) {
    auto root = static_cast<std::int64_t>(std::sqrt(static_cast<double>(x)));
    while (root * root > x) --root;
    while ((root + 1) * (root + 1) <= x) ++root;
    return root;
}

/// Shells of a ring by |f|^2, without those beyond the highest frequency.
std::map<std::int64_t, Shell> shells_of(const Grid& power, std::int64_t ring,
                                        const RunContext& run) {
    std::map<std::int64_t, Shell> shells;
    const HalfOfRows rows(power);
    const std::int64_t inner = ring * ring - ring;
    const std::int64_t outer = std::min(ring * ring + ring, rows.last * rows.last);
    rows.visit(run, [&](const double* centre, std::int64_t across, bool middle) {
        if (across > outer) return;
        const std::int64_t begin = across > inner ? 0 : whole_root(inner - across) + 1;
        for (std::int64_t f0 = begin; f0 <= whole_root(outer - across); ++f0) {
            Shell& shell = shells[across + f0 * f0];
            shell.add({centre[f0], 1});
            if (f0 > 0 && !middle) shell.add({centre[-f0], 1});
        }
    });
    return shells;
}

}  // namespace

double effective_nyquist(const Grid& power, const Rings& rings, const RunContext& run) {
    std::vector<Shell> within(1);  // sums over rings 1..k
    for (std::size_t i = 0; i < rings.power.size(); ++i) {
        const double cells = static_cast<double>(rings.cells[i]) / 2;
        within.push_back(within.back());
        within.back().add({rings.power[i] * cells, cells});
    }
    // From the outermost ring inwards. The mean power up to any shell of a ring is at least the sum
    // of powers inside the ring divided by the number of cells inside and in the ring. This bound
    // excludes most rings before their shells are computed.
    const std::size_t last = rings.power.size();
    for (std::size_t ring = last; ring > 0; --ring) {
        if (!Shell{within[ring - 1].power, within[ring].cells}.is_low()) continue;
        Shell inside = within[ring - 1];
        bool low = false;
        bool found = false;
        double radius = 0;
        const auto look = [&](std::size_t at) {
            for (const auto& [square, shell] :
                 shells_of(power, static_cast<std::int64_t>(at), run)) {
                if (low) radius = std::sqrt(static_cast<double>(square));
                if (at > ring) return;
                inside.add(shell);
                low = inside.is_low();
                found = found || low;
            }
        };
        look(ring);
        if (low && ring == last) return static_cast<double>(last) / 2;
        if (low) look(ring + 1);
        if (found) return radius / 2;
    }
    return 0;
}

namespace {

/// Mean of a term over rings first..last; weighted(cells, power) is the term's sum over one ring.
template <class Weighted>
double mean_of(const Rings& rings, std::size_t first, std::size_t last, const Weighted& weighted) {
    double sum = 0;
    double cells = 0;
    for (std::size_t i = first; i <= last; ++i) {
        const auto weight = static_cast<double>(rings.cells[i]);
        sum += weighted(weight, rings.power[i]);
        cells += weight;
    }
    return sum / cells;
}

}  // namespace

Oscillation oscillation(const Rings& rings, double regular_nyquist) {
    const auto& power = rings.power;
    auto first = std::ranges::find_if(power, [](double p) { return p >= 0.98; });
    const bool reached = first != power.end();
    if (!reached) first = std::ranges::max_element(power);
    const auto a = static_cast<std::size_t>(first - power.begin());
    const double reach = static_cast<double>(a) + std::round(10 * regular_nyquist);
    const bool cut = reach >= static_cast<double>(power.size());
    const std::size_t b = cut ? power.size() - 1 : static_cast<std::size_t>(reach);
    const auto square = [](double weight, double p) { return weight * (p - 1) * (p - 1); };
    return {10 * std::sqrt(mean_of(rings, a, b, square)), reached && !cut};
}

double total_variation(const Rings& rings) {
    const auto size = [](double weight, double p) { return weight * std::abs(p - 1); };
    return mean_of(rings, 0, rings.power.size() - 1, size) / 2;
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
        const double u = logarithm(static_cast<double>(i + 1));
        const double v = logarithm(rings.power[i]);
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
