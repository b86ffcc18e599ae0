// SPDX-License-Identifier: MIT
//
// Sets that are measured side by side; what comes of them is handed on in their order, as if they
// had been measured one after the other.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>

#include "core/point_set.hpp"
#include "report/document.hpp"
#include "stipple/run.hpp"

namespace stipple::cli {

/// A set with where it was found.
struct FoundSet {
    PointSet points;
    std::string source;
    std::size_t number;  ///< in its file
    std::size_t of;      ///< sets in its file
};

/// `measure` is called from several threads at once, `keep` from one.
/// @throws the first error, in the order of the sets; once a stop was requested and all sets that
/// had begun were measured nevertheless, leaves the others.
void measure_sets(std::span<const FoundSet> sets, const RunContext& run,
                  const std::function<Measurement(const FoundSet&, const RunContext&)>& measure,
                  const std::function<void(const FoundSet&, Measurement)>& keep);

}  // namespace stipple::cli
