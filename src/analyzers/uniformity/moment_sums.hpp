// SPDX-License-Identifier: MIT
//
// Sums of powers of rows of numbers, and the moments of a sample that follow from them.
//
//     S_p = sum z^p, p = 1..6, with z = (x - c) / u, and for each pair of columns sum z^p z'^q, p,
//     q in {1, 2}; c is near the mean, so that central moments lose little by cancellation, and u a
//     power of two, 1 unless the sixth powers of x - c could be too large or too small for doubles.
//
// A batch is summed by blocks; the blocks' sums are added in order with compensation for rounding
// (Neumaier). Sums of batches are added in pairs, pairs of pairs and so on, like a binary counter:
// batches 2i and 2i + 1, then 4i to 4i + 3, .... Sums left without a partner are added from the
// end.
//
// Shape   memory: one set of sums for each binary digit of the number of batches.
// Promise the same for any number of threads, and for any distribution of the batches: the sums of
//         consecutive batches may be merged in any order.
// Source  A. Neumaier, Zeitschrift fuer Angewandte Mathematik und Mechanik 54 (1974) 39-51.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/bytes/packed.hpp"

#include "stipple/run.hpp"

namespace stipple::analyzers {

/// Moments of a sample: one number per column, and a matrix of covariances, row by row.
struct SampleMoments {
    std::vector<double> mean;
    std::vector<double> variance;  ///< unbiased variance
    std::vector<double> skewness;  ///< m3 / m2^(3/2); 0 if all numbers are equal
    std::vector<double> covariance;
};

/// Moments with the standard error of each.
struct SampleAndErrors {
    SampleMoments value;
    SampleMoments error;
};

class MomentSums {
  public:
    /// Sums powers of (x - about) / unit for each column; `first` is the index of the first batch.
    /// Units are chosen for the size of the numbers in `rows`; without rows they are 1.
    explicit MomentSums(std::vector<double> about, std::uint64_t first = 0,
                        std::span<const double> rows = {});

    /// Takes the next batch.
    void add(std::span<const double> rows, const RunContext& run);

    void pack(Packer& to) const;
    /// Merges the sums of the batches that directly follow this object's.
    void merge(Unpacker& from);

    /// Moments of at least two rows. @throws Error(limit) if powers or moments exceed the largest
    /// double, or variances are below the smallest normal one
    [[nodiscard]] SampleAndErrors moments() const;

  private:
    /// Sums over 2^level batches: powers 1..6 of each column, then products of pairs of columns.
    struct Node {
        std::uint64_t first = 0;  ///< index of the first batch, a multiple of 2^level
        std::uint64_t level = 0;
        std::vector<double> sums = {};
        std::vector<double> carries = {};  ///< compensation of each sum for rounding

        [[nodiscard]] double sum(std::size_t i) const { return sums[i] + carries[i]; }
        void add(std::span<const double> more);
        void add(const Node& other);
    };

    [[nodiscard]] std::size_t width() const { return about_.size(); }
    [[nodiscard]] std::size_t size() const;
    /// Index of the first of four sums for the columns i < j: of x y, x^2 y, x y^2 and x^2 y^2.
    [[nodiscard]] std::size_t pair(std::size_t i, std::size_t j) const;
    void add_block(std::span<const double> rows, std::span<double> sums) const;
    void take(Node node);
    [[nodiscard]] Node total() const;
    void column(const Node& all, std::size_t k, SampleAndErrors& out) const;
    void cross(const Node& all, std::size_t i, std::size_t j, SampleAndErrors& out) const;

    std::vector<double> about_;
    std::vector<double> unit_;
    std::uint64_t next_ = 0;  ///< index of the next batch
    std::uint64_t count_ = 0;
    std::vector<Node> nodes_;  ///< in the order of their batches
};

}  // namespace stipple::analyzers
