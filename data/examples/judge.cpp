// SPDX-License-Identifier: MIT
//
// Points read from a file, and judged: `judge FILE`.
#include <cstdio>
#include <stipple/stipple.hpp>

int main(int argc, char** argv) {
    if (argc < 2) {
        std::fprintf(stderr, "usage: judge FILE\n");
        return 2;
    }
    try {
        const stipple::PointSet points = stipple::read(argv[1]);
        const stipple::Report test = stipple::analyze("chi-square", points);
        std::printf("%zu points on %s: %s (p = %.3g)\n", points.count(),
                    stipple::domain_of(points).c_str(), test.text("verdict").c_str(),
                    test.number("p_value"));
        if (points.dimension() == 2 && stipple::domain_of(points) == "unit-cube") {
            const stipple::Report star = stipple::analyze("star-discrepancy", points);
            std::printf("star discrepancy: %.6f\n", star.number("value"));
        }
    } catch (const stipple::Error& error) {
        std::fprintf(stderr, "judge: %s\n", error.what());
        return 1;
    }
}
