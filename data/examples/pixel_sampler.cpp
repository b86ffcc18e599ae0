// SPDX-License-Identifier: MIT
//
// A renderer's pixel sampler. Every pixel takes its own stretch of one Owen-scrambled Sobol' sequence:
// a place in the pixel, and a place on the lens. Here the pixels show how much of them a disk covers.
#include <cmath>
#include <cstdio>
#include <stipple/stipple.hpp>
#include <vector>

int main() {
    constexpr int side = 16;
    constexpr int samples = 64;  // a pixel; a power of two keeps each stretch a net
    const stipple::Sampler sampler("sobol:scramble=owen", {.dimension = 4, .seed = 7});
    const stipple::Warper lens("disk@3,4:radius=0.05", 4);

    double sum = 0;
    std::vector<double> rows(samples * 4);
    for (int pixel = 0; pixel < side * side; ++pixel) {
        sampler.fill(static_cast<std::uint64_t>(pixel) * samples, rows);
        const std::vector<double> rays = lens.forward(rows);
        int hits = 0;
        for (int i = 0; i < samples; ++i) {
            const double x = (pixel % side + rays[4 * i]) / side + rays[4 * i + 2];
            const double y = (pixel / side + rays[4 * i + 1]) / side + rays[4 * i + 3];
            hits += std::hypot(x - 0.5, y - 0.5) < 0.3 ? 1 : 0;
        }
        sum += static_cast<double>(hits) / samples;
    }
    std::printf("covered: %.2f of the picture; the disk's area is 0.28\n", sum / (side * side));
}
