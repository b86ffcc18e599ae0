// SPDX-License-Identifier: MIT
//
// Tests if n = b^m points are equidistributed over elementary boxes. A division by q_k digits of
// each coordinate k consists of b^(q_1 + ... + q_d) boxes with sides b^-q_k, which should all
// contain the same number of points. Two exact methods:
//
//     counting   n steps per division
//     rank       for digital nets: rows 1..q_k of the generating matrices C_k of all coordinates
//                together must be linearly independent over F_b; points are not needed
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

/// The first m digits of each coordinate, as an integer below b^m.
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

/// Truncates the coordinates of points to their first m digits. The edges j / b^m of intervals are
/// rounded to doubles; a coordinate is in the interval with the last edge that does not exceed it,
/// and 1 is in the last interval.
Net net_of(const PointSet& points, std::uint32_t base, std::size_t digits, const RunContext& run);

/// Generating matrices: row(k, l)[j] is digit l + 1 of coordinate k of point b^j minus that of
/// point 0.
struct Matrices {
    std::uint32_t base = 2;
    std::size_t size = 0;                ///< m
    std::vector<std::uint32_t> entries;  ///< matrix by matrix, row by row

    [[nodiscard]] std::span<const std::uint32_t> row(std::size_t k, std::size_t l) const {
        return std::span(entries).subspan((k * size + l) * size, size);
    }
};

/// The generating matrices, if the base is prime and the points in their order form a digital net,
/// with or without a digital shift: each digit of i adds its multiple of a fixed vector to point i,
/// digit by digit modulo b. Otherwise nullopt.
std::optional<Matrices> matrices_of(const Net& net, const RunContext& run);

/// Tests divisions with at most m digits in total, one coordinate after another. Not thread-safe.
class Probe {
  public:
    Probe() = default;
    Probe(const Probe&) = delete;
    Probe& operator=(const Probe&) = delete;
    virtual ~Probe() = default;

    /// Makes cut number `depth`, from 0: divides by `digits` digits of a coordinate. All boxes of
    /// the previous cuts must hold the same number of points.
    virtual void cut(std::size_t depth, std::size_t coordinate, std::size_t digits) = 0;

    /// True if all boxes hold the same number of points after the previous cuts and this one.
    virtual bool equal(std::size_t depth, std::size_t coordinate, std::size_t digits) = 0;
};

/// Uses the ranks of the matrices if given, else counts points. Keeps references to all arguments.
std::unique_ptr<Probe> probe_of(const Net& net, const std::optional<Matrices>& matrices,
                                const RunContext& run);

/// True if all boxes hold the same number of points for every distribution of `digits` digits among
/// the coordinates along[depth], ... that gives each of them at least one digit.
bool all_equal(Probe& probe, std::span<const std::size_t> along, std::size_t depth,
               std::size_t digits);

}  // namespace stipple::equidistribution
