// SPDX-License-Identifier: MIT
//
// Whether b^m points are equidistributed over elementary boxes: q_k digits to coordinate k cut the
// cube into b^(q_1 + ... + q_d) boxes of sides b^-q_k, and each of them should hold the same number
// of points. Two ways to find out, both exact:
//
//     counting   n steps a division
//     rank       where the points are a digital net: rows 1..q_k of all generating matrices C_k
//                are to be linearly independent over F_b; no point is looked at
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/point_set.hpp"
#include "stipple/run.hpp"

namespace stipple::equidistribution {

/// The first m digits of each coordinate, as one number below b^m.
struct Net {
    std::uint32_t base = 2;
    std::size_t digits = 0;  ///< m
    std::size_t count = 0;   ///< b^m, at most 2^31 - 1 points
    std::size_t dimension = 0;
    std::vector<std::int32_t> cells = {};  ///< coordinate after coordinate

    [[nodiscard]] std::span<const std::int32_t> coordinate(std::size_t k) const {
        return std::span(cells).subspan(k * count, count);
    }
};

/// A coordinate is in the last interval [j / b^m, (j + 1) / b^m) whose lower edge, rounded to a
/// double as the coordinate was, it reaches; 1 is in the last of all.
Net net_of(const PointSet& points, std::uint32_t base, std::size_t digits, const RunContext& run);

/// Generating matrices: row(k, l)[j] is digit l + 1 of coordinate k of point b^j, less that of
/// point 0.
struct Matrices {
    std::uint32_t base = 2;
    std::size_t size = 0;                ///< m
    std::vector<std::uint32_t> entries;  ///< matrix after matrix, row after row

    [[nodiscard]] std::span<const std::uint32_t> row(std::size_t k, std::size_t l) const {
        return std::span(entries).subspan((k * size + l) * size, size);
    }
};

/// The matrices, if the base is prime and the points in their order are a digital net, digitally
/// shifted or not: point i is the sum, digit by digit modulo b, of those that the digits of i say.
std::optional<Matrices> matrices_of(const Net& net, const RunContext& run);

/// Tests divisions with at most m digits in all, one coordinate after the other. Not to be shared
/// by threads.
class Probe {
  public:
    Probe() = default;
    Probe(const Probe&) = delete;
    Probe& operator=(const Probe&) = delete;
    virtual ~Probe() = default;

    /// Cuts by `digits` digits of a coordinate, as the depth-th of the cuts (from 0). The division
    /// so far is known to be equal.
    virtual void cut(std::size_t depth, std::size_t coordinate, std::size_t digits) = 0;

    /// Whether that cut, as the last one, leaves the boxes equal.
    virtual bool equal(std::size_t depth, std::size_t coordinate, std::size_t digits) = 0;
};

/// By the ranks of the net's matrices, or else by counting points. Keeps references to all.
std::unique_ptr<Probe> probe_of(const Net& net, const std::optional<Matrices>& matrices,
                                const RunContext& run);

/// Whether boxes are equal however `digits` digits are dealt to the coordinates from the depth-th
/// on, each getting some.
bool all_equal(Probe& probe, std::span<const std::size_t> along, std::size_t depth,
               std::size_t digits);

}  // namespace stipple::equidistribution
