// SPDX-License-Identifier: MIT
//
// Smallest processor time in seconds of ten in-memory calls of the library on one thread.
// python_bench.py compares it to measure the overhead of the module.
//
//     stipple_library_call GENERATOR COUNT DIMENSION [ANALYZER]
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <stipple/stipple.hpp>
#include <string>

int main(int, char** words) {
    const std::string generator = words[1];
    stipple::Request request{.dimension = std::stoull(words[3])};
    if (const auto count = std::stoull(words[2]); count > 0) request.count = count;
    const stipple::RunContext run{.threads = 1};
    const auto points = [&] { return stipple::generate(generator, request, {}, run); };
    const auto now = [] {
        timespec t{};
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
        return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
    };
    const auto seconds = [&](const auto& call) {
        double least = 1e9;
        for (int k = 0; k < 10; ++k) {
            const double began = now();
            (void)call();
            least = std::min(least, now() - began);
        }
        return least;
    };
    if (words[4] == nullptr) return std::printf("%.9f\n", seconds(points)) < 0;
    const stipple::PointSet set = points();
    std::printf("%.9f\n", seconds([&] { return stipple::analyze(words[4], set, {}, run); }));
}
