// SPDX-License-Identifier: MIT
//
// A Poisson-disk set that follows a density: 32 x 32 cells, from light on the left to dark on the right.
#include <cstdio>
#include <stipple/stipple.hpp>

int main() {
    stipple::PointSet density(32, 32);  // rows of an array
    for (std::size_t row = 0; row < 32; ++row)
        for (std::size_t column = 0; column < 32; ++column)
            density[row][column] = 0.2 + static_cast<double>(column);
    stipple::write("density.npy", density);

    const stipple::PointSet points =
        stipple::generate("poisson-disk:density=density.npy", {.count = 2000, .seed = 3});
    stipple::write("points.svg", points);

    std::size_t right = 0;
    for (std::size_t i = 0; i < points.count(); ++i) right += points[i][0] >= 0.5 ? 1 : 0;
    std::printf("%zu points, %s on the right half\n", points.count(),
                right > points.count() * 7 / 10 ? "most" : "too few");
}
