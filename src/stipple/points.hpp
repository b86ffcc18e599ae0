// SPDX-License-Identifier: MIT
//
// Point sets: values with their provenance.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace stipple {

class Domain;  ///< the space that points live on; warp.hpp has functions that query it
using DomainPtr = std::shared_ptr<const Domain>;

/// An axis-parallel box [low, high).
struct Box {
    std::vector<double> low;
    std::vector<double> high;

    [[nodiscard]] std::size_t dimension() const { return low.size(); }
    [[nodiscard]] double extent(std::size_t k) const { return high[k] - low[k]; }
    bool operator==(const Box&) const = default;
};

/// Storage for the coordinates of a point set: a given vector, or fresh memory that the caller must
/// fill. Large fresh blocks request large pages if the system has them: with 4 KiB pages, the first
/// touch of each page and the filling with zeros took most of the time of making a large set.
class Rows {
  public:
    Rows() = default;

    /// Takes ownership of the numbers.
    explicit Rows(std::vector<double> numbers) : given_(std::move(numbers)), view_(given_) {}

    /// Fresh memory for `count` rows of `width` numbers; write them before reading them.
    /// @throws Error(limit) if the memory is not available
    static Rows unwritten(std::size_t count, std::size_t width);

    Rows(const Rows& other) : Rows(std::vector<double>(other.view_.begin(), other.view_.end())) {}
    Rows(Rows&& other) noexcept
        : given_(std::move(other.given_)),
          fresh_(std::move(other.fresh_)),
          view_(std::exchange(other.view_, {})) {}
    Rows& operator=(Rows other) noexcept {
        given_.swap(other.given_);
        fresh_.swap(other.fresh_);
        std::swap(view_, other.view_);
        return *this;
    }
    ~Rows() = default;

    [[nodiscard]] std::span<double> numbers() { return view_; }
    [[nodiscard]] std::span<const double> numbers() const { return view_; }

  private:
    std::vector<double> given_;
    std::unique_ptr<double[]> fresh_;
    std::span<double> view_;  ///< of given_ or fresh_
};

/// Names of the levels 0, 1, ... of categorical coordinates: (column, its level names).
using Levels = std::vector<std::pair<std::string, std::vector<std::string>>>;

/// Origin of a point set: enough to generate it again.
struct Provenance {
    std::string version;                                       ///< version of stipple
    std::string generator;                                     ///< empty: unknown
    std::vector<std::pair<std::string, std::string>> options;  ///< as on a command line
    std::uint64_t seed = 1;
    std::uint64_t count = 0;
    std::size_t dimension = 0;
    std::uint64_t start = 0;
    std::vector<std::string> warps;  ///< specs, in order
    /// Names of the coordinates; empty: x, y, ...
    std::vector<std::string> columns = {};
    Levels levels = {};  ///< level names, by column
    std::string domain = "unit-cube";
    std::string bounds;     ///< empty: no bounds
    std::string shard;      ///< "I/K"; empty: the whole set
    double efficiency = 1;  ///< fraction of the points that warps kept
    std::string command;    ///< command that makes the set, without options that do not affect it

    std::optional<int> precision = {};  ///< digits after the point to which the file was rounded
    bool single = false;                ///< the file holds float32
    /// Input files, each with the fingerprint of its bytes.
    std::vector<std::pair<std::string, std::string>> inputs = {};
    /// Results of the generator's search, by name, such as a lattice's generating vector.
    std::vector<std::pair<std::string, std::string>> found = {};
    /// Units whose stream_version is above 1, each with that version.
    std::vector<std::pair<std::string, std::uint64_t>> stream_versions = {};
    /// Why provenance that was read is no recipe: an invalid field, or picked columns; else empty.
    std::string flaw = {};
    /// The generator's points are independent. Not written, since it follows from the generator's
    /// name.
    bool independent = false;
    /// Column of the file that holds each point's density, "pdf" or "weight"; not written.
    std::string density_column = {};
    bool named = false;  ///< the file names its columns, maybe x, y, ...; not written

    bool operator==(const Provenance&) const = default;
};

/// A file that a generator was asked to write along with the points.
struct SideFile {
    std::string path;
    std::string bytes;
};

class PointSet {
  public:
    PointSet() = default;

    /// All coordinates are 0. @throws Error(limit) if the memory is not available
    PointSet(std::size_t count, std::size_t dimension);

    /// Takes rows of `dimension` numbers. @throws Error(usage) if the last row is incomplete
    PointSet(std::vector<double> rows, std::size_t dimension)
        : PointSet(Rows(std::move(rows)), dimension) {}

    PointSet(Rows rows, std::size_t dimension);

    [[nodiscard]] std::size_t count() const { return flat().empty() ? 0 : count_; }
    [[nodiscard]] std::size_t dimension() const { return dimension_; }

    /// Point i. @throws Error(usage) if i >= count()
    [[nodiscard]] std::span<double> operator[](std::size_t i) {
        require(i);
        return flat().subspan(i * dimension_, dimension_);
    }
    [[nodiscard]] std::span<const double> operator[](std::size_t i) const {
        require(i);
        return flat().subspan(i * dimension_, dimension_);
    }

    [[nodiscard]] std::span<double> flat() { return rows_.numbers(); }
    [[nodiscard]] std::span<const double> flat() const { return rows_.numbers(); }

    /// Compares coordinates and dimension; the provenance may differ.
    bool operator==(const PointSet& other) const {
        return dimension_ == other.dimension_ && std::ranges::equal(flat(), other.flat());
    }

    DomainPtr domain;  ///< the space that the points live on; null: the unit cube

    /// Density of each point, above 0, with respect to the domain's measure; empty if the points
    /// follow the domain's density.
    std::vector<double> densities;
    Provenance provenance;  ///< empty if unknown

    std::vector<SideFile> side_files;  ///< to be written along with the points

  private:
    void require(std::size_t i) const {
        if (i >= count()) refuse(i);
    }
    [[noreturn]] void refuse(std::size_t i) const;

    Rows rows_;
    std::size_t dimension_ = 0;
    std::size_t count_ = 0;
};

}  // namespace stipple
