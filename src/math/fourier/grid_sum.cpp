// SPDX-License-Identifier: MIT
#include "math/fourier/grid_sum.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/machine/wide.hpp"
#include "core/parallel.hpp"

namespace stipple {
namespace {

constexpr std::uint64_t block = std::uint64_t{1} << 18;  // cells

// Adding 1.5 x 2^52 units rounds to a multiple of the unit, which then stands in the last bits.
constexpr double coarse_unit = 0x1p-21;
constexpr double fine_unit = 0x1p-64;
constexpr double coarse_magic = 0x1.8p52 * coarse_unit;
constexpr double fine_magic = 0x1.8p52 * fine_unit;

STIPPLE_WIDE
void add_cells(const double* cells, double factor, std::size_t count, std::uint64_t* coarse,
               std::uint64_t* fine) {
    for (std::size_t i = 0; i < count; ++i) {
        const double x = cells[i] * factor;
        const double high = x + coarse_magic;
        const double low = (x - (high - coarse_magic)) + fine_magic;
        coarse[i] +=
            std::bit_cast<std::uint64_t>(high) - std::bit_cast<std::uint64_t>(coarse_magic);
        fine[i] += std::bit_cast<std::uint64_t>(low) - std::bit_cast<std::uint64_t>(fine_magic);
    }
}

double signed_of(std::uint64_t bits) {
    return static_cast<double>(static_cast<std::int64_t>(bits));
}

/// The least multiple of 4 with size <= 2^exponent; of a sum of such grids one loses 2^-61 of its
/// size at most.
int exponent_of(double size) {
    if (!(size > 0)) return 0;
    constexpr int farthest = 1000;
    const int below = std::clamp(std::ilogb(size), -farthest, farthest);
    const bool above = size > std::ldexp(1.0, below);
    return 4 * static_cast<int>(std::ceil((below + (above ? 1 : 0)) / 4.0));
}

}  // namespace

void GridSum::add(std::span<const double> cells, int exponent, const RunContext& run) {
    const double factor = std::ldexp(1.0, -exponent);
    coarse_.resize(cells.size());
    fine_.resize(cells.size());
    for_each_block(silent(run), cells.size(), block, [&](const Block& b) {
        add_cells(cells.data() + b.first, factor, b.last - b.first, coarse_.data() + b.first,
                  fine_.data() + b.first);
    });
}

void GridSum::copy_to(std::span<double> cells, int exponent, const RunContext& run) const {
    const double factor = std::ldexp(1.0, exponent);
    for_each_block(silent(run), cells.size(), block, [&](const Block& b) {
        for (std::uint64_t i = b.first; i < b.last; ++i)
            cells[i] =
                (signed_of(coarse_[i]) * coarse_unit + signed_of(fine_[i]) * fine_unit) * factor;
    });
}

void GridSum::pack(Packer& to) const { to.put_all(coarse_).put_all(fine_); }

void GridSum::merge(Unpacker& from) {
    for (auto* mine : {&coarse_, &fine_}) {
        const auto more = from.take_all<std::uint64_t>();
        mine->resize(std::max(mine->size(), more.size()));
        for (std::size_t i = 0; i < more.size(); ++i) (*mine)[i] += more[i];
    }
}

void ScaledGridSum::add(std::span<const double> cells, double size, const RunContext& run) {
    const int exponent = exponent_of(size);
    sums_[exponent].add(cells, exponent, run);
}

void ScaledGridSum::copy_to(std::span<double> cells, const RunContext& run) const {
    std::vector<double> part;
    for (const auto& [exponent, sum] : sums_) {
        const bool first = &sum == &sums_.begin()->second;
        if (!first) part.resize(cells.size());
        const std::span<double> here = first ? cells : std::span<double>(part);
        sum.copy_to(here, exponent, run);
        for (std::size_t i = 0; i < part.size(); ++i) cells[i] += part[i];
    }
}

void ScaledGridSum::pack(Packer& to) const {
    to.put<std::uint64_t>(sums_.size());
    for (const auto& [exponent, sum] : sums_) sum.pack(to.put(exponent));
}

void ScaledGridSum::merge(Unpacker& from) {
    const auto count = from.take<std::uint64_t>();
    for (std::uint64_t i = 0; i < count; ++i) sums_[from.take<int>()].merge(from);
}

}  // namespace stipple
