// SPDX-License-Identifier: MIT
//
// Streams of points from files and pipes that may be larger than memory, read block by block in
// order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/bytes/raw_numbers.hpp"
#include "core/point_set.hpp"
#include "io/feed.hpp"
#include "io/format.hpp"
#include "stipple/run.hpp"

namespace stipple::io {

/// Sequence of point sets, read in order.
class PointStream {
  public:
    PointStream() = default;
    PointStream(const PointStream&) = delete;
    PointStream& operator=(const PointStream&) = delete;
    virtual ~PointStream() = default;

    [[nodiscard]] virtual std::size_t dimension() const = 0;

    /// Moves to the next set, at first to the first one. The current set must have been read to its
    /// end. Returns false after the last set.
    virtual bool next_set() = 0;

    /// Number of sets, if known in advance.
    [[nodiscard]] virtual std::optional<std::size_t> sets() const { return std::nullopt; }

    /// Whether the front of the input suggests a single set.
    [[nodiscard]] virtual bool looks_like_one_set() const { return sets() == std::size_t{1}; }

    /// Number of points in this set, if known in advance.
    [[nodiscard]] virtual std::optional<std::uint64_t> count() const { return std::nullopt; }

    /// Provenance of the first set; of the set numbered 0, if the file numbers its sets.
    [[nodiscard]] virtual const Provenance& provenance() const = 0;

    /// Whether all points are already in memory.
    [[nodiscard]] virtual bool held() const { return false; }

    /// Reads all sets; call it before next_set().
    virtual std::vector<PointSet> read_all(const RunContext& run);

    /// Reads the next points of the set into `rows` and returns how many: fewer than fit only at
    /// the end of the set. @throws Error(input), Error(io), Error(cancelled)
    virtual std::size_t read(std::span<double> rows) = 0;

    /// Skips up to `count` points of the set and returns how many were skipped. In binary files,
    /// the skipped bytes are not checked.
    virtual std::uint64_t skip(std::uint64_t count);
};

/// Opens a file as a stream. Small files and those that must be read as a whole (JSON, column-major
/// matrices, text with unknown level names), are read at once; others in blocks. Errors are those
/// of read_points, but may occur after valid points were already returned.
std::unique_ptr<PointStream> open_points(const std::string& path, const ReadOptions& options,
                                         const RunContext& run, const Format* format = nullptr);

/// As above, for a file that is open; `path` is its name. Bytes in memory must stay valid.
std::unique_ptr<PointStream> open_points(std::unique_ptr<Feed> feed, const std::string& path,
                                         const ReadOptions& options, const RunContext& run,
                                         const Format* format = nullptr);

/// Numbers per row in the file that an option names; reads only the first rows if possible.
/// @throws as read_given
std::size_t width_of_given(std::string_view option, const std::string& path);

/// One of several files that are joined.
struct JoinedFile {
    std::string name;
    std::size_t dimension = 0;
    Provenance provenance = {};
};

/// Checks that the points of a file can follow those of the first.
/// @throws Error(input) for another number of coordinates or another domain, and for other column
/// names or level names if both files have these
void require_alike(const JoinedFile& file, const JoinedFile& first);

using Opener = std::function<std::unique_ptr<PointStream>(const std::string& path)>;
/// Concatenates files of one set each into one set; each file is opened when it is needed. If the
/// files are all shards of one set, the provenance is that of the whole set; otherwise it holds
/// only what they have in common. New level names of later files get the next indices.
/// @param first index of the file to begin with
/// @throws Error(input) as require_alike(), but accepts other level names; for a file with several
/// sets; and for shards of one set that are out of order
std::unique_ptr<PointStream> join_points(std::vector<std::string> paths, Opener open,
                                         const RunContext& run, std::size_t first = 0);

// Functions for the implementation of formats.

/// Layout of raw numbers in a file, one set after another.
struct RawShape {
    std::size_t sets = 1;
    std::optional<std::uint64_t> count = {};  ///< points per set; unset: all to the end of the file
    std::size_t width = 1;                    ///< numbers per point
    RawType type = {};
    std::size_t offset = 0;  ///< bytes before the first number
};

std::unique_ptr<PointStream> stream_raw(std::unique_ptr<Feed> feed, const RawShape& shape,
                                        const ReadOptions& options);

/// Checks that all numbers are finite. @throws Error(input) naming the first that is not, its byte
/// and, unless shape.width is 0, its point
/// @param before how many numbers of the file precede these
void check_finite(std::span<const double> numbers, const RawShape& shape, const std::string& source,
                  std::size_t before = 0);

}  // namespace stipple::io
