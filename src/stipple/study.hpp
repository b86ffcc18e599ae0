// SPDX-License-Identifier: MIT
//
// Comparing samplers: every generator at every count and dimension, with several seeds, measured by
// every analyzer; and the page that shows sets side by side.
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
    std::uint64_t seeds = 1;  ///< sets of each generator, count and dimension
};

/// One number of one analyzer on one set.
struct StudyValue {
    std::string generator;
    std::string analyzer;
    std::uint64_t dimension = 0;
    std::uint64_t count = 0;
    std::uint64_t seed = 0;
    std::string key;              ///< dotted, as in Report
    std::optional<double> value;  ///< none where it failed
    std::string failure;          ///< why; else empty
};

/// All values, in the order of generators, dimensions, counts, seeds and analyzers.
/// @throws Error(usage) for units and options that do not exist; Error(cancelled)
std::vector<StudyValue> study(const Study& study, const RunContext& run = {});

/// The mean over the seeds of a study, with the interval of Student's t (NaN for a single set).
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
    double rms = 0;  ///< the root of the mean of the squares, as of errors
};

/// @param confidence in (0, 1)
std::vector<StudyMean> means_of(std::span<const StudyValue> values, double confidence = 0.95);

/// A set under a name.
struct NamedSet {
    std::string name;
    PointSet points;
};

/// Writes a self-contained HTML page that compares up to 12 sets of one dimension: pictures, spectra
/// and all measures. @throws Error(usage), Error(io), Error(cancelled)
void write_report(const std::string& path, std::span<const NamedSet> sets,
                  const RunContext& run = {});

}  // namespace stipple
