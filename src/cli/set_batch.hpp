// SPDX-License-Identifier: MIT
//
// Sets that wait to be measured, to be spread over the threads a few megabytes at a time; what
// comes of it is handed on in their order, as if they had been measured one after the other.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

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

class SetBatch {
  public:
    using Measure = std::function<Measurement(const FoundSet&, const RunContext&)>;
    using Keep = std::function<void(const FoundSet&, Measurement)>;

    /// `measure` is called from several threads at once, `keep` from one.
    SetBatch(const RunContext& run, Measure measure, Keep keep);

    /// Takes a set, and measures those that wait when they have become many. Large sets do not
    /// wait: they get all threads, and the memory, for themselves.
    void add(FoundSet set);

    /// Measures all that wait. @throws the first error, in the order of the sets; once a stop was
    /// requested and all sets that had begun were measured nevertheless, leaves the others.
    void finish();

  private:
    void alone(const FoundSet& set);

    const RunContext& run_;
    Measure measure_;
    Keep keep_;
    std::vector<FoundSet> waiting_;
    std::size_t numbers_ = 0;  ///< coordinates of these
};

}  // namespace stipple::cli
