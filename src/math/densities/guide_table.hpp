// SPDX-License-Identifier: MIT
//
// Guide table: search among increasing sums in constant expected time. The range of the sums is cut
// into equal buckets, and for each bucket the number of sums in earlier buckets is stored. So a
// search is limited to the sums in one bucket.
//
//     bucket(w) = floor(w * buckets / total),    the first sum above w has an index in
//     [starts[bucket(w)], starts[bucket(w) + 1]].
//
// Shape   sums >= 0, not decreasing; numbers in [0, total).
// Cost    4 bytes per bucket; O(1 + log(sums in the bucket)) per search.
// Promise the same result as a binary search among all sums, regardless of rounding: bucket() does
//         not decrease, and is the same function for sums and numbers.
// Source  H.-C. Chen, Y. Asau, "On generating random variates from an empirical distribution", AIIE
//         Trans. 6(2) (1974) 163-166, doi:10.1080/05695557408974949.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace stipple {

/// Up to this many sums are searched in a fixed number of steps.
inline constexpr std::size_t few_sums = 16;

/// Divides [0, total] into buckets of equal width.
class Buckets {
  public:
    Buckets() = default;
    Buckets(double total, std::size_t count)
        : scale_(static_cast<double>(count) / total), last_(count - 1) {
        if (!std::isfinite(scale_)) scale_ = 0;  // all sums in the first bucket: slower
    }

    [[nodiscard]] std::size_t of(double w) const {
        // Conversion to a signed integer takes one instruction, to an unsigned one several.
        return std::min(static_cast<std::size_t>(static_cast<std::int64_t>(w * scale_)), last_);
    }

  private:
    double scale_ = 0;
    std::size_t last_ = 0;
};

/// Fills `starts`, whose size is the number of buckets plus 1, for sums that end with the total.
/// Returns the power of two above the largest number of sums in a bucket, at most 16.
inline std::size_t fill_guide(std::span<const double> sums, std::span<std::uint32_t> starts) {
    const Buckets buckets(sums.back(), starts.size() - 1);
    std::ranges::fill(starts, 0);
    for (const double sum : sums) ++starts[buckets.of(sum) + 1];
    const std::size_t most = std::ranges::max(starts);
    for (std::size_t b = 1; b < starts.size(); ++b) starts[b] += starts[b - 1];
    return std::min(few_sums, std::bit_ceil(most + 1));
}

/// Returns the index of the first sum above w. Requires w < sums.back(), and an index in [low,
/// high].
/// @param few a power of two up to 16; fewer sums than this are searched in a fixed number of steps
inline std::size_t first_above(std::span<const double> sums, std::size_t low, std::size_t high,
                               double w, std::size_t few = few_sums) {
    const std::size_t last = sums.size() - 1;
    if (high - low < few) {
        // The number of steps is fixed, so that the processor can overlap several searches. Sums
        // after `high` are also above w.
        for (std::size_t step = few / 2; step > 0; step /= 2)
            low += sums[std::min(low + step - 1, last)] <= w ? step : 0;
        return low;
    }
    const auto from = sums.begin() + static_cast<std::ptrdiff_t>(low);
    const auto to = sums.begin() + static_cast<std::ptrdiff_t>(std::min(high, last));
    return static_cast<std::size_t>(std::upper_bound(from, to, w) - sums.begin());
}

/// Increasing sums with their guide table. Interval i is from sum i - 1, or 0, to sum i.
class GuideTable {
  public:
    GuideTable() = default;
    /// @param sums not decreasing, >= 0, the last one positive
    GuideTable(std::vector<double> sums, std::size_t buckets)
        : sums_(std::move(sums)),
          most_(std::nextafter(sums_.back(), 0.0)),
          buckets_(sums_.back(), buckets),
          starts_(buckets + 1) {
        few_ = fill_guide(sums_, starts_);
    }

    [[nodiscard]] std::size_t size() const { return sums_.size(); }
    [[nodiscard]] double total() const { return sums_.back(); }
    [[nodiscard]] std::span<const double> sums() const { return sums_; }

    /// Ends and width of interval i.
    [[nodiscard]] double begin(std::size_t i) const { return i == 0 ? 0 : sums_[i - 1]; }
    [[nodiscard]] double end(std::size_t i) const { return sums_[i]; }
    [[nodiscard]] double width(std::size_t i) const { return sums_[i] - begin(i); }

    /// Index of the interval that contains w >= 0; for w >= total, of the last nonempty interval.
    [[nodiscard]] std::size_t at(double w) const {
        const double inside = std::min(w, most_);
        const std::size_t bucket = buckets_.of(inside);
        return first_above(sums_, starts_[bucket], starts_[bucket + 1], inside, few_);
    }

  private:
    std::vector<double> sums_;
    double most_ = 0;  ///< the largest number below the total
    Buckets buckets_;
    std::vector<std::uint32_t> starts_;
    std::size_t few_ = few_sums;  ///< result of fill_guide(), for first_above()
};

}  // namespace stipple
