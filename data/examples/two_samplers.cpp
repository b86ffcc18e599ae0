// SPDX-License-Identifier: MIT
//
// A study of two samplers: star discrepancies of random and of scrambled Sobol' points, eight sets of
// each at four sizes, as means with confidence intervals; and a page that shows one set of each.
#include <cstdio>
#include <stipple/stipple.hpp>

int main() {
    const std::vector<stipple::StudyValue> values =
        stipple::study({.generators = {"random", "sobol:scramble=owen"},
                        .analyzers = {"star-discrepancy"},
                        .counts = {64, 128, 256, 512},
                        .seeds = 8});
    for (const stipple::StudyMean& mean : stipple::means_of(values))
        if (mean.key == "value")
            std::printf("%-20s %4llu points: %.4f [%.4f, %.4f]\n", mean.generator.c_str(),
                        static_cast<unsigned long long>(mean.count), mean.mean, mean.low,
                        mean.high);

    const std::vector<stipple::NamedSet> sets = {
        {"random", stipple::generate("random", {.count = 256})},
        {"Sobol'", stipple::generate("sobol:scramble=owen", {.count = 256})}};
    stipple::write_report("two_samplers.html", sets);
}
