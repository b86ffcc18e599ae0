// SPDX-License-Identifier: MIT
//
// Analyzers whose work on one set several processes can share: by parts of the set, each of which
// sees some of the points; or by parts of a search, of which each sees all.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "analyzers/analyzer.hpp"
#include "core/peers.hpp"

namespace stipple {

/// Measures a part of a set whose count was told, and takes in what others found of other parts.
class SharedAccumulator : public Accumulator {
  public:
    /// Called before any points come, where others take those before: the first here is point
    /// `first`, and `head` the first batch of the whole set.
    virtual void begin_at(std::uint64_t first, std::span<const double> head) = 0;

    /// What it has found, for the one that merges it. No points may come any more.
    virtual std::string state(const RunContext& run) = 0;

    /// Takes in what the accumulator of the points right behind its own has found. The report is
    /// then, to the last bit, that of one accumulator that was given all of them.
    virtual void merge(std::string_view state, const RunContext& run) = 0;
};

/// How the work of an analyzer is shared; one of both is there.
struct Sharing {
    /// Points that stay together: each part begins at a multiple of it. `accumulate` then makes a
    /// SharedAccumulator. @throws Error(usage) where these options stand against it
    std::function<std::uint64_t(const Arrival&, const Values&)> grain = {};

    /// As `analyze`, with others that were given the same points and options; all of them get the
    /// report.
    std::function<Report(const PointSet&, const Values&, Peers&, const RunContext&)> together = {};
};

/// How an analyzer's work is shared; nullptr where it is not.
const Sharing* sharing_of(const Analyzer& analyzer);

// Of the units:
namespace analyzers {
Sharing chi_square_sharing();
Sharing kolmogorov_smirnov_sharing();
Sharing moments_sharing();
Sharing periodogram_sharing();
Sharing star_discrepancy_sharing();
}  // namespace analyzers

}  // namespace stipple
