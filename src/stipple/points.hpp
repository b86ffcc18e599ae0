// SPDX-License-Identifier: MIT
//
// Point sets: plain values, with where they come from.
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

class Domain;  ///< what points live on; warp.hpp has what can be asked of it
using DomainPtr = std::shared_ptr<const Domain>;

/// An axis-parallel box [low, high).
struct Box {
    std::vector<double> low;
    std::vector<double> high;

    [[nodiscard]] std::size_t dimension() const { return low.size(); }
    [[nodiscard]] double extent(std::size_t k) const { return high[k] - low[k]; }
    bool operator==(const Box&) const = default;
};

/// Room for the numbers of a point set: a vector that is there already, or fresh memory that is to
/// be written. Large fresh rooms ask for large pages, where the system has them: the first touch of
/// every page costs as much as making some thousand coordinates, and with pages of 4 KiB that, and
/// filling them with zeros first, was most of the time that a large set took.
class Rows {
  public:
    Rows() = default;

    /// Takes the numbers.
    explicit Rows(std::vector<double> numbers) : given_(std::move(numbers)), view_(given_) {}

    /// Room for numbers, which must be written before they are read.
    static Rows unwritten(std::size_t count);

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
    std::span<double> view_;  ///< of the one that is used
};

/// Of coordinates whose numbers 0, 1, ... stand for words, by name: the words.
using Levels = std::vector<std::pair<std::string, std::vector<std::string>>>;

/// Where a point set comes from: enough to make it again.
struct Provenance {
    std::string version;                                       ///< of stipple
    std::string generator;                                     ///< empty: not known
    std::vector<std::pair<std::string, std::string>> options;  ///< as one types them
    std::uint64_t seed = 1;
    std::uint64_t count = 0;
    std::size_t dimension = 0;
    std::uint64_t start = 0;
    std::vector<std::string> warps;  ///< specs, in order
    /// Names of the coordinates, where they have others than x, y, ...
    std::vector<std::string> columns = {};
    Levels levels = {};  ///< of columns
    std::string domain = "unit-cube";
    std::string bounds;     ///< empty: none
    std::string shard;      ///< "I/K"; empty: the whole
    double efficiency = 1;  ///< share of the points that warps did not drop
    std::string command;    ///< that makes it, without what cannot change it

    std::optional<int> precision = {};  ///< digits after the point that were kept in writing
    bool single = false;                ///< the numbers were cut to float32 in writing
    /// Files that it was made from, each with the fingerprint of its bytes.
    std::vector<std::pair<std::string, std::string>> inputs = {};
    /// What the generator's search found, such as a lattice's vector, by name.
    std::vector<std::pair<std::string, std::string>> found = {};
    /// Units with rules of a later version than the first, each with it.
    std::vector<std::pair<std::string, std::uint64_t>> stream_versions = {};
    /// What no such value can be, of one that was read; empty: nothing.
    std::string flaw = {};
    /// The generator's points are independent of one another; not written, but known by its name.
    bool independent = false;
    /// Column of the file that tells the density of each point, "pdf" or "weight"; not written.
    std::string density_column = {};

    bool operator==(const Provenance&) const = default;
};

/// A file that a generator was asked to write beside the points.
struct SideFile {
    std::string path;
    std::string bytes;
};

class PointSet {
  public:
    PointSet() = default;

    /// All coordinates 0.
    PointSet(std::size_t count, std::size_t dimension)
        : PointSet(std::vector<double>(count * dimension), dimension) {}

    /// Takes rows of `dimension` numbers. @throws Error(usage) where these do not come out even
    PointSet(std::vector<double> rows, std::size_t dimension)
        : PointSet(Rows(std::move(rows)), dimension) {}

    PointSet(Rows rows, std::size_t dimension);

    [[nodiscard]] std::size_t count() const { return flat().empty() ? 0 : count_; }
    [[nodiscard]] std::size_t dimension() const { return dimension_; }

    /// Point i. @throws Error(usage) where there is none
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

    /// The same numbers, wherever they come from.
    bool operator==(const PointSet& other) const {
        return dimension_ == other.dimension_ && std::ranges::equal(flat(), other.flat());
    }

    DomainPtr domain;  ///< what the points live on; the unit cube unless set

    /// Density of each point with respect to the domain's measure, where that is known and may not
    /// be the domain's own; empty: it is.
    std::vector<double> densities;
    Provenance provenance;  ///< empty unless known

    std::vector<SideFile> side_files;  ///< for whoever writes the points to write, too

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
