// SPDX-License-Identifier: MIT
#include "analyzers/spectrum/periodogram_power.hpp"

#include <complex>

#include "core/machine/large_pages.hpp"
#include "math/functions/powers.hpp"

namespace stipple::analyzers {
namespace {

/// Transform of the window on one axis, at the frequency f. Without a window it is 1 at 0; for hann
/// 1/2 at 0 and -1/4 at 1 and -1; otherwise 0.
double window_transform(std::int64_t f, bool hann) {
    if (!hann) return f == 0 ? 1 : 0;
    return f == 0 ? 0.5 : std::abs(f) == 1 ? -0.25 : 0;
}

}  // namespace

Grid power_of(const FourierSums& sums, const Strengths& strengths, bool hann,
              const RunContext& run) {
    const std::size_t last = sums.max_frequency;
    const std::size_t width = 2 * last + 1;
    Grid power{.rows = sums.values.size() / (last + 1), .columns = width, .values = {}};
    fill_with_zeros(power.values, power.rows * width);
    const double squared = hann ? whole_power(0.375, sums.dimension) : 1;
    const double scale = 1 / (squared * strengths.squares);
    for (std::size_t row = 0; row < power.rows; ++row) {
        run.check_stop();
        const auto* half = sums.values.data() + row * (last + 1);
        double* values = power.values.data() + row * width;
        double* mirrored = power.values.data() + (power.rows - 1 - row) * width;
        for (std::size_t f = 0; f <= last; ++f)
            values[last + f] = mirrored[last - f] = std::norm(half[f]) * scale;
    }
    const auto line = static_cast<std::int64_t>(width);
    const auto reach = [&](std::size_t axis) { return hann && axis < sums.dimension ? 1 : 0; };
    for (std::int64_t f2 = -reach(2); f2 <= reach(2); ++f2)
        for (std::int64_t f1 = -reach(1); f1 <= reach(1); ++f1)
            for (std::int64_t f0 = -reach(0); f0 <= reach(0); ++f0) {
                if (f0 == 0 && f1 == 0 && f2 == 0) continue;
                double shape = 1;
                const std::int64_t f[] = {f0, f1, f2};
                for (std::size_t k = 0; k < sums.dimension; ++k)
                    shape *= window_transform(f[k], hann);
                const double of = std::norm(sums.at({f0, f1, f2}) - shape * strengths.sum);
                const std::int64_t middle = static_cast<std::int64_t>(power.values.size() / 2);
                const std::int64_t at = middle + (f2 * line + f1) * line + f0;
                power.values[static_cast<std::size_t>(at)] =
                    of / ((squared - shape * shape) * strengths.squares);
            }
    power.values[power.values.size() / 2] = strengths.sum * strengths.sum / strengths.squares;
    return power;
}

}  // namespace stipple::analyzers
