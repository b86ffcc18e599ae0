// SPDX-License-Identifier: MIT
//
// Spatial index of disks of very different radii in a rectangle.
//
//     class c:  2^(c-1) s <= r < 2^c s,    s the minimum radius
//
// Disks of class c are in cells with sides of at least 2^c s. Empty cells take no memory: the hash
// of a cell selects a list of disks, so that a few tiny disks in a large box cost no more than
// others.
//
// Cost    a query visits about nine cells of each class that has disks; 36 to 60 bytes a disk.
// Promise finds every disk that may be too near; possibly others, and some twice.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "generators/box_space.hpp"
#include "math/combinatorics/splitmix64.hpp"
#include "math/neighbors/spaced_points.hpp"

namespace stipple {

struct Disk {
    std::array<double, 2> at;
    double radius;
};

class VariedIndex {
  public:
    /// @param expected estimated number of disks; the index grows if there are more
    VariedIndex(const BoxSpace& space, double least_radius, std::size_t expected)
        : low_{space.box.low[0], space.box.low[1]},
          sides_{space.box.extent(0), space.box.extent(1)},
          torus_(space.torus),
          least_(least_radius),
          last_class_(class_of(space.largest_distance())),
          classes_(last_class_ + 1),
          heads_(std::bit_ceil(std::max<std::size_t>(expected, 64)), none) {
        disks_.reserve(expected);
        next_.reserve(expected);
        for (std::size_t c = 0; c <= last_class_; ++c)
            for (std::size_t k = 0; k < 2; ++k) {
                classes_[c].reach = std::ldexp(least_, static_cast<int>(c));
                const double count = std::floor(sides_[k] / (classes_[c].reach * (1 + 1e-9)));
                classes_[c].count[k] = static_cast<std::int64_t>(std::max(1.0, count));
                classes_[c].scale[k] = static_cast<double>(classes_[c].count[k]) / sides_[k];
            }
    }

    [[nodiscard]] const std::vector<Disk>& disks() const { return disks_; }

    void add(const Disk& disk) {
        disks_.push_back(disk);
        next_.push_back(none);
        if (disks_.size() > heads_.size()) return grow();
        link(static_cast<std::uint32_t>(disks_.size() - 1));
    }

    /// Whether two disks are nearer than the smaller radius, by squared_distance() of
    /// math/neighbors/spaced_points.hpp.
    [[nodiscard]] bool too_near(const Disk& a, const Disk& b) const {
        const double r = std::min(a.radius, b.radius);
        return squared_distance<2>(a.at.data(), b.at.data(), sides_, torus_) < r * r;
    }

    /// Distance along axis k.
    [[nodiscard]] double apart(std::size_t k, double x, double y) const {
        const double d = std::abs(x - y);
        return torus_ ? std::min(d, sides_[k] - d) : d;
    }
    [[nodiscard]] double side(std::size_t k) const { return sides_[k]; }
    [[nodiscard]] bool torus() const { return torus_; }

    /// Calls visit(disk) for every disk that may be too near to a disk of at most `radius` centred
    /// in [low, high]; returns true as soon as a call does.
    template <class Visit>
    bool any_near(const std::array<double, 2>& low, const std::array<double, 2>& high,
                  double radius, const Visit& visit) const {
        for (std::size_t c = 0; c <= last_class_; ++c) {
            if (classes_[c].disks == 0) continue;
            const double reach = c == last_class_ ? radius : std::min(radius, classes_[c].reach);
            const Cells x = cells(c, 0, low[0] - reach, high[0] + reach);
            const Cells y = cells(c, 1, low[1] - reach, high[1] + reach);
            for (std::int64_t j = y.first; j < y.first + y.count; ++j) {
                const std::uint64_t row = row_hash(c, wrapped(c, 1, j));
                for (std::int64_t i = x.first; i < x.first + x.count; ++i)
                    for (std::uint32_t at = heads_[bucket(row, wrapped(c, 0, i))]; at != none;
                         at = next_[at])
                        if (visit(disks_[at])) return true;
            }
        }
        return false;
    }

    /// Whether a disk would be too near to one in the index.
    [[nodiscard]] bool blocks(const Disk& disk) const {
        return any_near(disk.at, disk.at, disk.radius,
                        [&](const Disk& other) { return too_near(disk, other); });
    }

  private:
    static constexpr std::uint32_t none = 0xffff'ffff;

    struct Class {
        double reach = 0;  ///< upper bound of the radii in the class, 2^c s
        std::array<std::int64_t, 2> count{};
        std::array<double, 2> scale{};  ///< cells per unit of length
        std::size_t disks = 0;
    };
    struct Cells {
        std::int64_t first;
        std::int64_t count;
    };

    /// Class of a radius. May exceed last_class_, which also has the disks of all higher classes.
    [[nodiscard]] std::size_t class_of(double radius) const {
        int exponent = 0;
        std::frexp(std::min(radius / least_, 1e300), &exponent);
        return static_cast<std::size_t>(std::max(exponent, 0));
    }

    [[nodiscard]] std::int64_t cell(std::size_t c, std::size_t k, double x) const {
        const double at = std::floor((x - low_[k]) * classes_[c].scale[k]);
        // Coordinates far outside the box are clamped to cells that are outside, too.
        const auto count = static_cast<double>(classes_[c].count[k]);
        return static_cast<std::int64_t>(std::clamp(at, -2 * count - 2, 3 * count + 2));
    }

    /// Cells that may overlap [low, high], each once; on the torus indices may exceed [0, count).
    [[nodiscard]] Cells cells(std::size_t c, std::size_t k, double low, double high) const {
        const std::int64_t count = classes_[c].count[k];
        const double slack = 1e-9 / classes_[c].scale[k];
        std::int64_t first = cell(c, k, low - slack);
        std::int64_t last = cell(c, k, high + slack);
        if (!torus_) {
            first = std::clamp<std::int64_t>(first, 0, count - 1);
            last = std::clamp<std::int64_t>(last, 0, count - 1);
        }
        if (last - first + 1 >= count) return {0, count};
        return {first, last - first + 1};
    }

    [[nodiscard]] std::uint64_t wrapped(std::size_t c, std::size_t k, std::int64_t i) const {
        const std::int64_t count = classes_[c].count[k];
        while (i < 0) i += count;
        while (i >= count) i -= count;
        return static_cast<std::uint64_t>(i);
    }

    static std::uint64_t row_hash(std::size_t c, std::uint64_t row) {
        return SplitMix64(row << 8 | c).next();
    }
    [[nodiscard]] std::size_t bucket(std::uint64_t row, std::uint64_t column) const {
        return (row + column) & (heads_.size() - 1);
    }

    void link(std::uint32_t number) {
        const Disk& disk = disks_[number];
        const std::size_t c = std::min(class_of(disk.radius), last_class_);
        const std::int64_t zero = 0;
        const auto at = [&](std::size_t k) {
            return static_cast<std::uint64_t>(
                std::clamp(cell(c, k, disk.at[k]), zero, classes_[c].count[k] - 1));
        };
        std::uint32_t& head = heads_[bucket(row_hash(c, at(1)), at(0))];
        next_[number] = head;
        head = number;
        ++classes_[c].disks;
    }

    void grow() {
        heads_.assign(2 * heads_.size(), none);
        for (Class& c : classes_) c.disks = 0;
        for (std::uint32_t i = 0; i < disks_.size(); ++i) link(i);
    }

    std::array<double, 2> low_;
    std::array<double, 2> sides_;
    bool torus_;
    double least_;
    std::size_t last_class_;
    std::vector<Class> classes_;
    std::vector<Disk> disks_;
    std::vector<std::uint32_t> next_;   ///< next disk in the list of its cell
    std::vector<std::uint32_t> heads_;  ///< first disk of each list; the size is a power of 2
};

}  // namespace stipple
