// SPDX-License-Identifier: MIT
//
// The integral of exp(-x y) over the unit square, with an error bar: sixteen independently scrambled
// Sobol' sets give sixteen estimates.
#include <cmath>
#include <cstdio>
#include <stipple/stipple.hpp>

int main() {
    constexpr int sets = 16;
    double sum = 0;
    double squares = 0;
    for (std::uint64_t seed = 1; seed <= sets; ++seed) {
        const stipple::PointSet points =
            stipple::generate("sobol:scramble=owen", {.count = 4096, .dimension = 2, .seed = seed});
        double estimate = 0;
        for (std::size_t i = 0; i < points.count(); ++i)
            estimate += std::exp(-points[i][0] * points[i][1]);
        estimate /= static_cast<double>(points.count());
        sum += estimate;
        squares += estimate * estimate;
    }
    const double mean = sum / sets;
    const double error = std::sqrt((squares / sets - mean * mean) / (sets - 1));
    std::printf("%.6f, standard error below 1e-6: %s; exact: 0.796600\n", mean,
                error < 1e-6 ? "yes" : "no");
}
