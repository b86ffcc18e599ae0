// SPDX-License-Identifier: MIT
//
// Where a number falls among rising sums, in constant expected time: the range of the sums is cut
// into equal buckets, and for each is known how many sums lie in buckets before it. The search is
// then among the sums of one bucket.
//
//     bucket(w) = floor(w * buckets / total),    the first sum above w lies in
//     [starts[bucket(w)], starts[bucket(w) + 1]].
//
// Shape   sums >= 0, none below the one before; numbers in [0, total).
// Cost    4 bytes a bucket; O(1 + log of the sums in the bucket) a search.
// Promise the same answer as a binary search among all sums, whatever the rounding: bucket() rises
//         with w, and sums and numbers go through the same.
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

/// Up to as many sums are gone through without asking how many there are.
inline constexpr std::size_t few_sums = 16;

/// Cuts [0, total] into buckets.
class Buckets {
  public:
    Buckets() = default;
    Buckets(double total, std::size_t count)
        : scale_(static_cast<double>(count) / total), last_(count - 1) {
        if (!std::isfinite(scale_)) scale_ = 0;  // all in the first: slower, and as right
    }

    [[nodiscard]] std::size_t of(double w) const {
        // To signed numbers is one instruction, to unsigned ones several.
        return std::min(static_cast<std::size_t>(static_cast<std::int64_t>(w * scale_)), last_);
    }

  private:
    double scale_ = 0;
    std::size_t last_ = 0;
};

/// Fills the `starts`, one more than there are buckets, for sums whose last is the total. Gives the
/// power of two above the most sums of a bucket, at most 16.
inline std::size_t fill_guide(std::span<const double> sums, std::span<std::uint32_t> starts) {
    const Buckets buckets(sums.back(), starts.size() - 1);
    std::ranges::fill(starts, 0);
    for (const double sum : sums) ++starts[buckets.of(sum) + 1];
    const std::size_t most = std::ranges::max(starts);
    for (std::size_t b = 1; b < starts.size(); ++b) starts[b] += starts[b - 1];
    return std::min(few_sums, std::bit_ceil(most + 1));
}

/// The first of the sums above w < sums.back(), which lies in [low, high].
/// @param few a power of two up to 16: what is done for as many sums is the same for all numbers
inline std::size_t first_above(std::span<const double> sums, std::size_t low, std::size_t high,
                               double w, std::size_t few = few_sums) {
    const std::size_t last = sums.size() - 1;
    if (high - low < few) {
        // Always as many steps, which the machine can do for several numbers at a time. What they
        // meet beyond `high` is above w, too.
        for (std::size_t step = few / 2; step > 0; step /= 2)
            low += sums[std::min(low + step - 1, last)] <= w ? step : 0;
        return low;
    }
    const auto from = sums.begin() + static_cast<std::ptrdiff_t>(low);
    const auto to = sums.begin() + static_cast<std::ptrdiff_t>(std::min(high, last));
    return static_cast<std::size_t>(std::upper_bound(from, to, w) - sums.begin());
}

/// Rising sums with their guide.
class GuideTable {
  public:
    GuideTable() = default;
    /// Sums >= 0, none below the one before, the last above 0.
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

    /// Where the interval i begins and ends.
    [[nodiscard]] double begin(std::size_t i) const { return i == 0 ? 0 : sums_[i - 1]; }
    [[nodiscard]] double end(std::size_t i) const { return sums_[i]; }
    [[nodiscard]] double width(std::size_t i) const { return sums_[i] - begin(i); }

    /// The interval that holds w >= 0; from the total on, the last that is not empty.
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
    std::size_t few_ = few_sums;  ///< that a bucket has at most, if it is few
};

}  // namespace stipple
