// SPDX-License-Identifier: MIT
//
// A density on the unit square, constant on each cell of a W x H grid, read from a picture or an
// array:
//
//     cell (i, j) = [i/W, (i+1)/W) x [j/H, (j+1)/H),    mean over the square = 1.
//
// PNG     value = luminance x alpha (media/png_picture.hpp), samples taken as linear; the top row of
//         the picture is the top of the square, y near 1. Inverted, for ink on paper:
//         (1 - luminance) x alpha. What is transparent gets no points either way.
// PFM     value = the grey of media/pfm_picture.hpp; the top row is the top of the square. Inverted:
//         largest value - value.
// NPY     shape (H, W), row 0 at y = 0; any real type. Inverted: largest value - value.
//
// A uniform point (u, v) is placed row first: y where the sum of the rows reaches v of the whole,
// then x where the sum of that row's cells reaches u of the row: the marginal, then the
// conditional, both piecewise linear, by guide tables (math/densities/guide_table.hpp).
//
// Shape   W, H >= 1; values finite, none negative, not all 0.
// Cost    18 bytes a cell; all is O(1) a point on average. At 4096 x 4096, where memory is what
//         costs, place_all() takes 70 ns a point and place() some 4 times as long.
// Promise at(place(u, v)) > 0; find() gives u and v back within the rounding of the sums.
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
    /// Values row after row from y = 0, not all 0; scales them to a mean of 1.
    DensityMap(std::size_t width, std::size_t height, std::vector<double> values);

    [[nodiscard]] std::size_t width() const { return width_; }
    [[nodiscard]] std::size_t height() const { return height_; }

    /// Row after row from y = 0; their mean is 1.
    [[nodiscard]] std::span<const double> values() const { return values_; }

    /// Density at a point of the closed unit square.
    [[nodiscard]] double at(double x, double y) const {
        return values_[cell_of(y, height_) * width_ + cell_of(x, width_)];
    }

    [[nodiscard]] double largest() const { return largest_; }

    /// Largest density at points of the closed rectangle [x0, x1] x [y0, y1].
    [[nodiscard]] double largest_in(double x0, double x1, double y0, double y1) const;

    /// Image of a point of [0, 1)^2 under the map that takes the uniform density to this one,
    /// rising in v along y, and in u along x.
    [[nodiscard]] std::array<double, 2> place(double u, double v) const;

    /// The same for rows u, v of `cube`, whose cells are fetched from memory side by side.
    void place_all(std::span<const double> cube, std::span<double> image) const;

    /// The way back, from the closed unit square into the closed unit square. What lies in an empty
    /// cell goes where its neighbours meet.
    [[nodiscard]] std::array<double, 2> find(double x, double y) const;

  private:
    /// A point on its way to its place: what is known once its row is.
    struct Visit {
        std::size_t row;
        std::size_t bucket;  ///< of row_guides_
        double wanted;       ///< the sum of the row's cells that it falls on
        double y;
    };
    /// What a row is searched with.
    struct Row {
        double total;
        double most;  ///< the largest number below it
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
    std::vector<double> row_sums_;  ///< of each row: sums of the cells up to each
    std::vector<Row> rows_;
    GuideTable column_;                      ///< the rows, one above the other
    std::vector<std::uint32_t> row_guides_;  ///< one row's after the other
    std::size_t row_guide_size_ = 0;
    double largest_ = 0;
};

/// Reads a picture or an array. @throws Error(io): missing or unreadable; Error(input), naming the
/// file: neither PNG, PFM nor NPY, damaged, not two-dimensional, empty, negative, not finite, all
/// zero; Error(limit)
DensityMap read_density(const std::string& path, bool invert, const RunContext& run);

/// Reads an array of lengths as it is. @throws as read_density; what is no array, and a length that
/// is not above 0, are Error(input)
PlaneValues read_lengths(const std::string& path, const RunContext& run);

/// As read_density, for a region: 1 where the value is not 0, before scaling.
DensityMap read_mask(const std::string& path, bool invert, const RunContext& run);

}  // namespace stipple
