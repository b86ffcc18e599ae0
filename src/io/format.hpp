// SPDX-License-Identifier: MIT
//
// What a point-file format is: its record, and pure functions between rows and bytes. Rows can be
// formatted block by block on any thread and joined in order.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/options.hpp"
#include "core/point_set.hpp"
#include "stipple/run.hpp"

namespace stipple {

/// Points of each of several sets: one number where all have as many, however many there are.
class Counts {
  public:
    Counts() = default;
    Counts(std::initializer_list<std::uint64_t> counts) {
        for (const std::uint64_t count : counts) push_back(count);
    }
    static Counts equal(std::uint64_t sets, std::uint64_t each);

    void push_back(std::uint64_t count);
    [[nodiscard]] std::uint64_t size() const { return sets_; }
    [[nodiscard]] std::uint64_t operator[](std::uint64_t set) const {
        return all_.empty() ? first_ : all_[set];
    }
    [[nodiscard]] bool are_equal() const { return all_.empty(); }
    [[nodiscard]] std::uint64_t total() const;
    /// Those of sets [first, last).
    [[nodiscard]] Counts part(std::uint64_t first, std::uint64_t last) const;

  private:
    std::uint64_t sets_ = 0;
    std::uint64_t first_ = 0;
    std::vector<std::uint64_t> all_ = {};  ///< where they are not equal
};

/// What a writer knows before the first row.
struct Layout {
    std::size_t dimension = 0;             ///< coordinates of a point
    std::vector<std::string> extras = {};  ///< names of further numbers in a row ("pdf")
    Counts counts = {};                    ///< points of each set
    bool header = true;                    ///< CSV
    bool meta = false;                     ///< provenance in `# ` lines
    bool single = false;                   ///< float32 in binary formats
    std::optional<int> precision = {};     ///< digits after the point
    Provenance provenance = {};
    std::optional<Box> extent = {};  ///< what a picture shows; else the bounds, else the unit cube

    [[nodiscard]] std::size_t width() const { return dimension + extras.size(); }
    [[nodiscard]] bool many_sets() const { return counts.size() > 1; }
    /// The names of the coordinates, then the extras.
    [[nodiscard]] std::vector<std::string> columns() const;
};

/// Names of coordinates: x / x,y / x,y,z / x1..xd.
std::vector<std::string> coordinate_names(std::size_t dimension);

/// Those that a provenance keeps, if they are as many; else the names above.
std::vector<std::string> coordinate_names(std::size_t dimension, const Provenance& provenance);

namespace io {
class Feed;
class PointStream;
}  // namespace io

/// What a reader is told.
struct ReadOptions {
    std::string source = "-";                   ///< for messages and reports
    std::optional<std::size_t> dimension = {};  ///< needed by bin; checked by the others
    std::vector<std::string> columns = {};  ///< names, or numbers from 1; empty: all coordinates
    /// Those that are read where there is no `columns` and the file names all of them.
    std::vector<std::string> expected = {};
    Levels levels = {};  ///< of columns that hold words

    bool any_count = false;    ///< a head may announce another number of points
    bool all_columns = false;  ///< those called pdf or weight are coordinates, too
    bool densities = false;    ///< a column called pdf or weight is a number behind the coordinates
    bool single = false;       ///< bin holds float32
    bool gaps = false;         ///< text: an empty field, and nan, is a coordinate NaN
    std::string strengths = {};  ///< column that becomes a number behind the coordinates
};

struct FormatTraits {
    bool binary = false;
    bool equal_sets = false;    ///< all sets must have as many points
    bool many_sets = true;      ///< a file can hold more than one set
    bool counts_first = false;  ///< what comes before the rows tells their number, or their extent
    bool meta_beside = false;   ///< has no place for provenance: it goes to a file beside
    std::size_t max_dimension = 1'000'000;
    std::size_t min_dimension = 1;
};

struct Format {
    using Rows = void (*)(const Layout&, std::size_t set, std::uint64_t first,
                          std::span<const double> rows, std::string& out);

    std::string name;
    std::string summary;
    std::string source;                   ///< where the format is described
    std::vector<std::string> extensions;  ///< ".csv"
    FormatTraits traits;

    /// Appends what comes before all rows, before the rows of each set, and after all; may be
    /// empty.
    void (*head)(const Layout&, std::string& out) = nullptr;
    void (*begin_set)(const Layout&, std::size_t set, std::string& out) = nullptr;
    /// Appends rows first, first + 1, ... of a set (numbered from 0 in this file). Pure.
    Rows rows = nullptr;
    void (*tail)(const Layout&, std::string& out) = nullptr;

    /// The sets in the bytes of a file. Empty: write only.
    /// @throws Error(input) "FILE:LINE:COLUMN: what is wrong; what is expected", or, for bytes that
    /// are no text, "FILE: byte N: ..." with bytes counted from 0
    std::vector<PointSet> (*read)(std::string_view bytes, const ReadOptions&,
                                  const RunContext&) = nullptr;

    /// The same in blocks, where the front of the bytes shows that it can be done: takes the feed
    /// then, and leaves it where it gives nothing. Empty: never.
    std::unique_ptr<io::PointStream> (*stream)(std::unique_ptr<io::Feed>&, const ReadOptions&,
                                               const RunContext&) = nullptr;
};

namespace io {

/// All formats, in alphabetical order.
const std::vector<Format>& all();

/// The format called `name`. @throws Error(usage) naming the nearest.
const Format& format_named(std::string_view name);

/// The extension of a file's name in small letters, ".csv", without that of its compression.
std::string extension_of(std::string_view path);

/// Refuses the name of an output with an extension other than the known ones, with a hint at what
/// else to do. @throws Error(usage)
void require_extension(std::string_view path, std::span<const std::string> known,
                       const std::string& hint);

/// The format that a file's extension means, if any.
const Format* format_of_extension(std::string_view path);

/// Whether a file's extension says float32: ".f32".
bool extension_is_single(std::string_view path);

/// Radius of the disks of `count` points on an area, in its units, of which 1000 make a picture:
/// 0.15 of the mean distance sqrt(area / count), between 0.5 and 10.
inline double disk_radius(double area, double count) {
    return std::clamp(0.15 * std::sqrt(area / std::max(count, 1.0)), 0.5, 10.0);
}

/// The format that the first bytes tell: npy, utk, json, jsonl; else csv (which reads all plain text).
const Format& format_of_bytes(std::string_view bytes);

}  // namespace io
}  // namespace stipple
