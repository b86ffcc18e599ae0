// SPDX-License-Identifier: MIT
//
// Sets on their way from a source (a generator, memory, a file) to a sink (a file, an analyzer, a
// comparison): their rows in blocks, and their metadata.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/point_set.hpp"
#include "io/format.hpp"
#include "pipeline/chain.hpp"

namespace stipple {

/// Gives a set's next points, as many as fit; fewer only at its end.
using NextRows = std::function<std::size_t(std::span<double> rows)>;

/// The points of a set in memory, from one on; the set must stay.
NextRows rows_of(const PointSet& points, std::uint64_t first = 0);

/// Calls take(rows) with all that comes, as long as it gives true, the next batch being fetched
/// meanwhile: batches of so many rows, but for the last, on which sums by blocks rely. False: it gave
/// false.
/// @param batch rows at a time @param width numbers of a row
bool in_batches(const NextRows& next, std::size_t batch, std::size_t width, const RunContext& run,
                const std::function<bool(std::span<const double>)>& take);

/// A set that is begun.
struct OpenSet {
    NextRows next;
    std::uint64_t count = 0;                 ///< points; 0: known only at the end
    std::span<const double> densities = {};  ///< of the points, where a set in memory has them
    std::vector<SideFile> side_files = {};   ///< files that come with the points
};

/// Metadata of the sets of one file, available before their rows.
struct SetsHead {
    Provenance provenance;
    Counts counts = {};              ///< points of each set; 0: known only at the end
    std::optional<Box> extent = {};  ///< what a picture shows, if more than the domain
};

/// Sets, one after the other, with everything that a sink needs.
struct SetStream {
    std::size_t sets = 1;
    DomainPtr domain;                  ///< of the points
    const WarpChain* chain = nullptr;  ///< warps that made the rows, for their density; null: none
    /// Begins a set; called once for each, in order.
    std::function<OpenSet(std::size_t set, const RunContext&)> open = {};
    /// Metadata of a file of the sets [first, last); called before these are opened.
    std::function<SetsHead(std::size_t first, std::size_t last)> head = {};
    std::function<std::uint64_t(std::size_t set)> seed = {};  ///< of {seed} in file names
    bool one_at_a_time = false;  ///< head and open make a set in place of the one before
    bool side_files = false;     ///< some sets have side files
    bool starts = false;         ///< --start can leave out a set's first point

    /// Coordinates of a point.
    [[nodiscard]] std::size_t dimension() const { return domain->dimension(); }
};

/// Sets in memory, which must stay.
/// @param chain warps that made them, for their density if they have none of their own
SetStream stream_of(const std::vector<PointSet>& sets, const WarpChain* chain = nullptr);

/// Sets made by make(0), make(1), ..., one in memory at a time.
/// @param seed of the first set in file names; the next ones have seed + 1, ...
SetStream stream_of(std::size_t sets, std::function<PointSet(std::size_t set)> make,
                    std::uint64_t seed, const WarpChain* chain = nullptr);

/// The same sets, all made and kept on disk, with their counts and common metadata known. Calls
/// take(files) with the side files of each set.
SetStream waiting(const SetStream& made, const RunContext& run,
                  const std::function<void(const std::vector<SideFile>&)>& take);

/// The part of a run's progress that one of several sets is.
RunContext part_of_run(const RunContext& run, std::size_t set, std::size_t sets);

}  // namespace stipple
