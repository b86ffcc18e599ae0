// SPDX-License-Identifier: MIT
//
// Points of files and pipes that may be larger than memory: block after block, in order.
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

/// Sets of points, one after the other.
class PointStream {
  public:
    PointStream() = default;
    PointStream(const PointStream&) = delete;
    PointStream& operator=(const PointStream&) = delete;
    virtual ~PointStream() = default;

    [[nodiscard]] virtual std::size_t dimension() const = 0;

    /// Goes to the next set, to the first one at first. The set before must have been read to its
    /// end. False: there is none.
    virtual bool next_set() = 0;

    /// Number of sets, where it is known before.
    [[nodiscard]] virtual std::optional<std::size_t> sets() const { return std::nullopt; }

    /// Whether there is one set, as far as its front tells.
    [[nodiscard]] virtual bool looks_like_one_set() const { return sets() == std::size_t{1}; }

    /// Points of this set, where they are known before.
    [[nodiscard]] virtual std::optional<std::uint64_t> count() const { return std::nullopt; }

    [[nodiscard]] virtual const Provenance& provenance() const = 0;

    /// Whether all points are in memory anyway.
    [[nodiscard]] virtual bool held() const { return false; }

    /// All sets, where none was gone to yet.
    virtual std::vector<PointSet> read_all(const RunContext& run);

    /// Takes the set's next points, as many as fit; fewer, or none, only at its end.
    /// @throws Error(input), Error(io), Error(cancelled)
    virtual std::size_t read(std::span<double> rows) = 0;

    /// Goes past the set's next points, as many as there are up to `count`, and says how many these
    /// were. Where the place of every point is known, what is passed is not looked at.
    virtual std::uint64_t skip(std::uint64_t count);
};

/// What is small, or must be read as a whole (JSON, columns of a matrix one after the other, CSV
/// with a column that tells the set), is read so; the rest in blocks. Errors are those of
/// read_points, save that points before the place that is wrong were given out already.
std::unique_ptr<PointStream> open_points(const std::string& path, const ReadOptions& options,
                                         const RunContext& run, const Format* format = nullptr);

/// The points of several files of one set each, as one set; a file is opened when its turn comes.
/// Their provenance is that of the whole where they are all of its shards, in order; else only the
/// domain that they share is known.
/// @throws Error(input) for points of different numbers of coordinates or on different domains, and
/// for a file of several sets
using Opener = std::function<std::unique_ptr<PointStream>(const std::string& path)>;
std::unique_ptr<PointStream> join_points(std::vector<std::string> paths, Opener open);

// Below: for formats.

/// Bytes that are numbers, set after set.
struct RawShape {
    std::size_t sets = 1;
    std::optional<std::uint64_t> count = {};  ///< points of a set; else all that come
    std::size_t width = 1;                    ///< numbers of a point
    RawType type = {};
    std::size_t offset = 0;  ///< bytes before the first number
};

std::unique_ptr<PointStream> stream_raw(std::unique_ptr<Feed> feed, const RawShape& shape,
                                        const ReadOptions& options);

/// @throws Error(input) naming the first number that is not finite, its byte and, unless the shape
/// has the width 0, its point
/// @param before numbers before these
void check_finite(std::span<const double> numbers, const RawShape& shape, const std::string& source,
                  std::size_t before = 0);

}  // namespace stipple::io
