// SPDX-License-Identifier: MIT
//
// Comparison of samplers: generates sets for every combination of generator, count, dimension and
// seed, and measures each with every analyzer. Also the HTML page that shows sets side by side.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "stipple/points.hpp"
#include "stipple/run.hpp"

namespace stipple {

struct Study {
    std::vector<std::string> generators = {};  ///< specs
    std::vector<std::string> analyzers = {};   ///< specs: "integration:integrand=genz-gaussian"
    std::vector<std::string> warps = {};       ///< specs, applied in order
    std::vector<std::uint64_t> counts = {1024};
    std::vector<std::uint64_t> dimensions = {2};
    std::uint64_t first_seed = 1;
    std::uint64_t seeds = 1;             ///< sets per generator, count and dimension
    std::vector<std::string> keys = {};  ///< results to keep, such as "value"; empty: all numbers
};

/// One number from one analyzer on one set.
struct StudyValue {
    std::string generator;
    std::string analyzer;
    std::uint64_t dimension = 0;
    std::uint64_t count = 0;
    std::uint64_t seed = 0;
    std::string key;              ///< dotted, as in Report
    std::optional<double> value;  ///< empty if the analyzer failed
    std::string failure;          ///< why it failed; empty if it did not
};

/// Returns all values, ordered by generator, dimension, count, seed and analyzer.
/// @throws Error(usage) for units and options that do not exist; Error(cancelled)
std::vector<StudyValue> study(const Study& study, const RunContext& run = {});

/// Mean over the seeds, with its Student t confidence interval (NaN for a single set).
struct StudyMean {
    std::string generator;
    std::string analyzer;
    std::uint64_t dimension = 0;
    std::uint64_t count = 0;
    std::string key;
    std::uint64_t sets = 0;
    double mean = 0;
    double low = 0;
    double high = 0;
    double rms = 0;  ///< root mean square, the usual mean of errors
};

/// @param confidence in (0, 1)
std::vector<StudyMean> means_of(std::span<const StudyValue> values, double confidence = 0.95);

/// A set and its name on the page.
struct NamedSet {
    std::string name;
    PointSet points;
};

/// Writes a self-contained HTML page that compares up to 12 sets of one dimension: pictures,
/// spectra and all measures. @throws Error(usage), Error(io), Error(cancelled)
void write_report(const std::string& path, std::span<const NamedSet> sets,
                  const RunContext& run = {});

}  // namespace stipple
