// SPDX-License-Identifier: MIT
//
// Points with where they come from: a plain value.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/domain.hpp"
#include "core/options.hpp"
#include "core/rows.hpp"

namespace stipple {

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
    std::string domain = "unit-cube";
    std::string bounds;     ///< empty: none
    std::string shard;      ///< "I/K"; empty: the whole
    double efficiency = 1;  ///< share of the points that warps did not drop
    std::string command;    ///< that makes it, without what cannot change it

    std::optional<int> precision = {};  ///< digits after the point that were kept in writing
    bool single = false;                ///< the numbers were cut to float32 in writing
    /// Files that it was made from, each with the fingerprint of its bytes.
    std::vector<std::pair<std::string, std::string>> inputs = {};
    /// Units with rules of a later version than the first, each with it.
    std::vector<std::pair<std::string, std::uint64_t>> stream_versions = {};

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

    [[nodiscard]] std::size_t count() const { return dimension_ ? flat().size() / dimension_ : 0; }
    [[nodiscard]] std::size_t dimension() const { return dimension_; }

    [[nodiscard]] std::span<double> operator[](std::size_t i) {
        return flat().subspan(i * dimension_, dimension_);
    }
    [[nodiscard]] std::span<const double> operator[](std::size_t i) const {
        return flat().subspan(i * dimension_, dimension_);
    }

    [[nodiscard]] std::span<double> flat() { return rows_.numbers(); }
    [[nodiscard]] std::span<const double> flat() const { return rows_.numbers(); }

    /// The same numbers, wherever they come from.
    bool operator==(const PointSet& other) const {
        return dimension_ == other.dimension_ && std::ranges::equal(flat(), other.flat());
    }

    DomainPtr domain;       ///< what the points live on; the unit cube unless set
    Provenance provenance;  ///< empty unless known

    std::vector<SideFile> side_files;  ///< for whoever writes the points to write, too

  private:
    Rows rows_;
    std::size_t dimension_ = 0;
};

}  // namespace stipple
