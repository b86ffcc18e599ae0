// SPDX-License-Identifier: MIT
#include "math/digital/digit_permutations.hpp"

#include <algorithm>
#include <numeric>

#include "math/arithmetic/ratio.hpp"
#include "math/digital/radical_inverse.hpp"

namespace stipple {
namespace {

/// Random permutation of the digits at a position, by Fisher and Yates.
std::vector<std::uint16_t> random_permutation(std::uint64_t base, std::size_t position,
                                              const Rng& numbers) {
    std::vector<std::uint16_t> images(base);
    std::iota(images.begin(), images.end(), std::uint16_t{0});
    for (std::uint64_t left = base; left > 1; --left)
        std::swap(images[left - 1], images[numbers.below(position * base + left - 1, left)]);
    return images;
}

}  // namespace

std::vector<std::uint32_t> faure_permutation(std::uint32_t base) {
    if (base == 2) return {0, 1};
    std::vector<std::uint32_t> images;
    if (base % 2 == 0) {
        const auto half = faure_permutation(base / 2);
        for (const std::uint32_t odd : {0U, 1U})
            for (const std::uint32_t image : half) images.push_back(2 * image + odd);
        return images;
    }
    const std::uint32_t middle = (base - 1) / 2;
    for (const std::uint32_t image : faure_permutation(base - 1))
        images.push_back(image + (image >= middle ? 1 : 0));
    images.insert(images.begin() + middle, middle);
    return images;
}

PermutedInverse::PermutedInverse(std::uint32_t base, const Rng& numbers)
    : base_(base), block_(base) {
    std::size_t position = 0;
    for (const std::uint16_t image : random_permutation(base, position++, numbers))
        low_.push_back(image);
    for (; block_ * base <= largest_digit_table; block_ *= base) {
        // A higher digit changes more slowly along the table, and its image is less significant.
        std::vector<double> longer;
        for (const std::uint16_t image : random_permutation(base, position++, numbers))
            for (const double low : low_) longer.push_back(low * base + image);
        low_ = std::move(longer);
    }
    margin_ = static_cast<double>(block_) * 0x1p-51;
    for (Wide reach = block_; reach < exact_limit; reach *= base) {
        const auto images = random_permutation(base, position++, numbers);
        permuted_.insert(permuted_.end(), images.begin(), images.end());
    }
    // The random digits after the last position of any index below 2^53 form a uniform number.
    zeros_.push_back(numbers.uniform(position * base_));
    for (std::size_t at = permuted_.size(); at > 0; at -= base_)
        zeros_.push_back((permuted_[at - base_] + zeros_.back()) / static_cast<double>(base_));
    std::ranges::reverse(zeros_);
}

/// Images of the digits `high`, which follow the t low ones, as a fraction of b^-t in
/// [margin_, 1 - margin_].
double PermutedInverse::behind(std::uint64_t high) const {
    Wide digits = 0;
    Wide power = 1;
    std::size_t position = 0;
    for (; high > 0; high /= base_, ++position) {
        digits = digits * base_ + permuted_[position * base_ + high % base_];
        power *= base_;
    }
    // `digits` and `power` are below 2^53: power <= base_ * high <= block_ * high <= the index.
    const auto whole = static_cast<double>(static_cast<std::uint64_t>(digits));
    const double fraction =
        (whole + zeros_[position]) / static_cast<double>(static_cast<std::uint64_t>(power));
    return std::clamp(fraction, margin_, 1 - margin_);
}

double PermutedInverse::of(std::uint64_t index) const {
    return (low_[index % block_] + behind(index / block_)) / static_cast<double>(block_);
}

void PermutedInverse::fill(std::uint64_t first, std::size_t count, double* out,
                           std::size_t stride) const {
    const auto block = static_cast<double>(block_);
    while (count > 0) {
        const std::uint64_t start = first % block_;
        const auto run = std::min<std::size_t>(count, block_ - start);
        const double rest = behind(first / block_);
        fill_quotients(std::span(low_).subspan(start, run), 1, rest, block, out, stride);
        first += run;
        count -= run;
        out += run * stride;
    }
}

}  // namespace stipple
