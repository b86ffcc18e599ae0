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

/// Fills `rows` with the next points of a set, as many as fit, or fewer at its end. Returns their
/// number.
using NextRows = std::function<std::size_t(std::span<double> rows)>;

/// Reader of a set in memory, from point `first` on. The set must outlive it.
NextRows rows_of(const PointSet& points, std::uint64_t first = 0);

/// Calls take(rows) for one batch after another, until it returns false; the next batch is read
/// meanwhile. Every batch except the last has exactly `batch` rows, so that sums over blocks are
/// reproducible. Returns false if take() did.
/// @param width numbers per row
bool in_batches(const NextRows& next, std::size_t batch, std::size_t width, const RunContext& run,
                const std::function<bool(std::span<const double>)>& take);

/// A set whose rows are about to be read.
struct OpenSet {
    NextRows next;
    std::uint64_t count = 0;                 ///< number of points; 0 if known only at the end
    std::span<const double> densities = {};  ///< densities stored with the points; may be empty
    std::vector<SideFile> side_files = {};   ///< files written with the points
};

/// Metadata of the sets of one file, available before their rows.
struct SetsHead {
    Provenance provenance;
    Counts counts = {};              ///< numbers of points of the sets; 0 if known only at the end
    std::optional<Box> extent = {};  ///< area that a picture must show; nullopt: the domain
};

/// One set after the other, with everything that a sink needs.
struct SetStream {
    std::size_t sets = 1;
    DomainPtr domain;                  ///< domain of the points
    const WarpChain* chain = nullptr;  ///< warps of the rows, for their density; may be null
    /// Opens a set. Called once for each set, in order.
    std::function<OpenSet(std::size_t set, const RunContext&)> open = {};
    /// Returns the metadata of a file with the sets [first, last). Called before these are opened.
    std::function<SetsHead(std::size_t first, std::size_t last)> head = {};
    std::function<std::uint64_t(std::size_t set)> seed = {};  ///< seed of a set, for file names
    bool one_at_a_time = false;  ///< memory holds one set, replaced by head() and open()
    bool side_files = false;     ///< some sets have side files
    bool starts = false;         ///< --start can leave out the first points of a set

    /// Coordinates per point.
    [[nodiscard]] std::size_t dimension() const { return domain->dimension(); }
};

/// Stream of sets in memory, which must outlive it.
/// @param chain warps that made the sets, to compute densities that the sets do not store; may be
/// null
SetStream stream_of(const std::vector<PointSet>& sets, const WarpChain* chain = nullptr);

/// Stream of the sets make(0), make(1), ..., with one in memory at a time.
/// @param seed of the first set in file names; later sets have seed + 1, ...
SetStream stream_of(std::size_t sets, std::function<PointSet(std::size_t set)> make,
                    std::uint64_t seed, const WarpChain* chain = nullptr);

/// Makes all sets of a stream and stores them on disk. The new stream knows their counts and common
/// metadata before they are opened. Calls take(files) with the side files of each set.
SetStream waiting(const SetStream& made, const RunContext& run,
                  const std::function<void(const std::vector<SideFile>&)>& take);

/// A copy of the context for one of several sets, whose progress is a part of the whole.
RunContext part_of_run(const RunContext& run, std::size_t set, std::size_t sets);

}  // namespace stipple
