// SPDX-License-Identifier: MIT
//
// Interface of a point-file format: a record with pure functions between rows and bytes. Blocks of
// rows can be formatted on any thread and joined in order.
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

/// Number of points in each set. Takes constant memory if all sets have equally many.
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
    /// Counts of sets [first, last).
    [[nodiscard]] Counts part(std::uint64_t first, std::uint64_t last) const;

  private:
    std::uint64_t sets_ = 0;
    std::uint64_t first_ = 0;
    std::vector<std::uint64_t> all_ = {};  ///< empty if all sets are equal
};

/// Parameters of a writer, known before the first row.
struct Layout {
    std::size_t dimension = 0;             ///< coordinates per point
    std::vector<std::string> extras = {};  ///< names of the numbers after the coordinates ("pdf")
    Counts counts = {};                    ///< points of each set
    bool header = true;                    ///< column names, in CSV
    bool meta = false;                     ///< provenance in `# ` lines
    bool single = false;                   ///< float32 in binary formats
    std::optional<int> precision = {};     ///< digits after the point
    Provenance provenance = {};
    std::optional<Box> extent = {};  ///< area that svg shows; unset: provenance.bounds or unit cube

    [[nodiscard]] std::size_t width() const { return dimension + extras.size(); }
    [[nodiscard]] bool many_sets() const { return counts.size() > 1; }
    /// Names of the coordinates, then of the extras.
    [[nodiscard]] std::vector<std::string> columns() const;
};

/// Default names of coordinates: x / x,y / x,y,z / x1..xd.
std::vector<std::string> coordinate_names(std::size_t dimension);

/// Coordinate names in the provenance if their number is right; otherwise the default names.
std::vector<std::string> coordinate_names(std::size_t dimension, const Provenance& provenance);

namespace io {
class Feed;
class PointStream;
struct CarriedMeta;
}  // namespace io

/// Parameters of a reader.
struct ReadOptions {
    std::string source = "-";                   ///< for messages and reports
    std::optional<std::size_t> dimension = {};  ///< required by bin, checked by other formats
    std::vector<std::string> columns = {};  ///< names, or numbers from 1; empty: all coordinates
    /// Columns to read if `columns` is empty and the file has all of these names.
    std::vector<std::string> expected = {};
    Levels levels = {};  ///< level names of categorical columns

    bool any_count = false;      ///< accepts numbers of points and columns other than the header's
    bool all_columns = false;    ///< reads columns pdf and weight as coordinates, too
    bool densities = false;      ///< reads column pdf or weight as a number after the coordinates
    bool single = false;         ///< bin holds float32
    bool gaps = false;           ///< text: reads empty fields, NA and nan as NaN
    std::string strengths = {};  ///< weight column, read after the coordinates
    bool meta_beside = false;    ///< reads FILE.meta.json, too, if there is one
    const io::CarriedMeta* beside = nullptr;  ///< contents of FILE.meta.json, for formats
};

struct FormatTraits {
    bool binary = false;
    bool equal_sets = false;    ///< all sets must have the same number of points
    bool many_sets = true;      ///< a file can hold more than one set
    bool counts_first = false;  ///< the file's head contains the counts or the extent
    bool meta_beside = false;   ///< provenance goes to a sidecar file
    std::size_t max_dimension = 1'000'000;
    std::size_t min_dimension = 1;
};

struct Format {
    using Rows = void (*)(const Layout&, std::size_t set, std::uint64_t first,
                          std::span<const double> rows, std::string& out);

    std::string name;
    std::string summary;
    std::string source;                   ///< specification, such as "RFC 4180"; or "none"
    std::vector<std::string> extensions;  ///< ".csv"
    FormatTraits traits;

    /// Functions that append text before all rows, before the rows of each set, and after all rows;
    /// null: no such text.
    void (*head)(const Layout&, std::string& out) = nullptr;
    void (*begin_set)(const Layout&, std::size_t set, std::string& out) = nullptr;
    /// Appends rows first, first + 1, ... of a set; sets are numbered from 0 in this file. Pure.
    Rows rows = nullptr;
    void (*tail)(const Layout&, std::string& out) = nullptr;

    /// Parses all sets from the bytes of a file; null: write only.
    /// @throws Error(input) "FILE:LINE:COLUMN: error; what is expected", or, for binary data,
    /// "FILE: byte N: ..." with bytes counted from 0
    std::vector<PointSet> (*read)(std::string_view bytes, const ReadOptions&,
                                  const RunContext&) = nullptr;

    /// Opens a stream that reads in blocks and takes ownership of the feed. Returns null, without
    /// touching the feed, if its front shows that the file must be read as a whole. Unset if the
    /// format cannot be read in blocks.
    std::unique_ptr<io::PointStream> (*stream)(std::unique_ptr<io::Feed>&, const ReadOptions&,
                                               const RunContext&) = nullptr;
};

namespace io {

/// All formats, in alphabetical order.
const std::vector<Format>& all();

/// The format called `name`. @throws Error(usage) suggesting the nearest name
const Format& format_named(std::string_view name);

/// Lower-case extension of a file name, ".csv"; an extension .gz or .zst is removed first.
std::string extension_of(std::string_view path);

/// Checks the extension of an output's name; accepts names without extension. @throws Error(usage)
/// with `hint` if the extension is not among `known`
void require_extension(std::string_view path, std::span<const std::string> known,
                       const std::string& hint);

/// The format with this file's extension; null if there is none.
const Format* format_of_extension(std::string_view path);

/// Whether the extension means float32: ".f32".
bool extension_is_single(std::string_view path);

/// Radius of the disks that show `count` points: 0.15 times the mean distance sqrt(area / count),
/// between 0.5 and 10. Units are 1/1000 of the picture's longer side.
inline double disk_radius(double area, double count) {
    return std::clamp(0.15 * std::sqrt(area / std::max(count, 1.0)), 0.5, 10.0);
}

/// Detects the format by the first bytes: npy, utk, json or jsonl; otherwise csv, which reads all
/// plain text.
const Format& format_of_bytes(std::string_view bytes);

}  // namespace io
}  // namespace stipple
