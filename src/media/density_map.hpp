// SPDX-License-Identifier: MIT
//
// A density on the unit square, constant on each cell of a W x H grid, read from a picture or an
// array:
//
//     cell (i, j) = [i/W, (i+1)/W) x [j/H, (j+1)/H),    mean over the square = 1.
//
// PNG     value = luminance x alpha (media/png_picture.hpp), samples taken as linear; the top row
//         is at y near 1. Inverted, for ink on paper: (1 - luminance) x alpha. Transparent areas
//         get no points either way.
// PFM     value = the grey of media/pfm_picture.hpp; the top row is at y near 1. Inverted: largest
//         value - value.
// NPY     shape (H, W), row 0 at y = 0; any real type. Inverted: largest value - value.
//
// A uniform point (u, v) is mapped by inversion: y where the cumulative sum of the rows reaches the
// fraction v, then x where the cumulative sum of that row's cells reaches the fraction u. Both the
// marginal and the conditional distribution are piecewise linear, and are inverted with guide
// tables (math/densities/guide_table.hpp).
//
// Shape   W, H >= 1; values finite, not negative, not all 0.
// Cost    18 bytes a cell; O(1) time a point on average. At 4096 x 4096, limited by memory access,
//         place_all() takes 70 ns a point and place() about 4 times as long.
// Promise at(place(u, v)) > 0; find() returns u and v up to the rounding of the sums.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "math/densities/guide_table.hpp"
#include "media/pfm_picture.hpp"
#include "stipple/run.hpp"

namespace stipple {

class DensityMap {
  public:
    /// Scales the values to a mean of 1. @param values in row-major order from y = 0, not all 0
    DensityMap(std::size_t width, std::size_t height, std::vector<double> values);

    [[nodiscard]] std::size_t width() const { return width_; }
    [[nodiscard]] std::size_t height() const { return height_; }

    /// Densities of the cells in row-major order from y = 0; their mean is 1.
    [[nodiscard]] std::span<const double> values() const { return values_; }

    /// Density at a point of the closed unit square.
    [[nodiscard]] double at(double x, double y) const {
        return values_[cell_of(y, height_) * width_ + cell_of(x, width_)];
    }

    [[nodiscard]] double largest() const { return largest_; }

    /// Largest density at points of the closed rectangle [x0, x1] x [y0, y1].
    [[nodiscard]] double largest_in(double x0, double x1, double y0, double y1) const;

    /// Maps uniform points of [0, 1)^2 to this density. y increases with v, and x with u.
    [[nodiscard]] std::array<double, 2> place(double u, double v) const;

    /// Applies place() to all rows (u, v) of `cube`; faster, since memory accesses overlap.
    void place_all(std::span<const double> cube, std::span<double> image) const;

    /// Inverse of place(), from the closed unit square into itself. All x in an empty cell
    /// give the same u, and all y in an empty row the same v.
    [[nodiscard]] std::array<double, 2> find(double x, double y) const;

  private:
    /// A point whose row is known, but whose x is not yet.
    struct Visit {
        std::size_t row;
        std::size_t bucket;  ///< index into row_guides_
        double wanted;       ///< cumulative sum to find within the row
        double y;
    };
    /// Data for searching one row.
    struct Row {
        double total;
        double most;  ///< the largest double below total
        Buckets buckets;
    };

    [[nodiscard]] Visit visit(double u, double v) const;
    [[nodiscard]] double across(const Visit& visit) const;

    void lay_out_guides();

    static std::size_t cell_of(double x, std::size_t cells) {
        const auto i = static_cast<std::size_t>(x * static_cast<double>(cells));
        return i < cells ? i : cells - 1;
    }

    std::size_t width_;
    std::size_t height_;
    std::vector<double> values_;
    std::vector<double> row_sums_;  ///< cumulative sums of the cells, row by row
    std::vector<Row> rows_;
    GuideTable column_;                      ///< guide table for finding a point's row
    std::vector<std::uint32_t> row_guides_;  ///< guide tables of the rows, concatenated
    std::size_t row_guide_size_ = 0;
    double largest_ = 0;
};

/// Reads a picture or array. @throws Error(io): missing or unreadable; Error(input): not PNG, PFM
/// or NPY, damaged, not two-dimensional, empty, negative, not finite or all zero; Error(limit)
DensityMap read_density(const std::string& path, bool invert, const RunContext& run);

/// Reads an NPY array of lengths, unscaled. @throws as read_density; Error(input) also for other
/// formats and for lengths that are not above 0
PlaneValues read_lengths(const std::string& path, const RunContext& run);

/// Like read_density(), but for a region: values other than 0 become 1 before scaling.
DensityMap read_mask(const std::string& path, bool invert, const RunContext& run);

}  // namespace stipple
