// SPDX-License-Identifier: MIT
#include "math/fourier/grid_sum.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/machine/wide.hpp"
#include "core/parallel.hpp"

namespace stipple {
namespace {

constexpr std::uint64_t block = std::uint64_t{1} << 18;  // number of cells per block

// Adding 1.5 * 2^52 units rounds x to a multiple of the unit, held in the sum's low bits.
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

/// Smallest multiple of 4 with 2^exponent >= size. As 2^exponent < 16 size, rounding a cell changes
/// it by at most 2^-61 of `size`.
int exponent_of(double size) {
    if (!(size > 0)) return 0;
    constexpr int farthest = 1000;
    const int below = std::clamp(std::ilogb(size), -farthest, farthest);
    const bool above = size > std::ldexp(1.0, below);
    return 4 * static_cast<int>(std::ceil((below + (above ? 1 : 0)) / 4.0));
}

}  // namespace

void ScaledGridSum::add(std::span<const double> cells, double size, const RunContext& run) {
    const int exponent = exponent_of(size);
    const double factor = std::ldexp(1.0, -exponent);
    Cells& sum = sums_[exponent];
    sum.coarse.resize(cells.size());
    sum.fine.resize(cells.size());
    for_each_block(silent(run), cells.size(), block, [&](const Block& b) {
        add_cells(cells.data() + b.first, factor, b.last - b.first, sum.coarse.data() + b.first,
                  sum.fine.data() + b.first);
    });
}

void ScaledGridSum::copy_to(std::span<double> cells, const RunContext& run) const {
    for_each_block(silent(run), cells.size(), block, [&](const Block& b) {
        const auto here = cells.subspan(b.first, b.last - b.first);
        std::ranges::fill(here, 0.0);
        for (const auto& [exponent, sum] : sums_) {
            const double factor = std::ldexp(1.0, exponent);
            for (std::size_t i = 0; i < here.size(); ++i)
                here[i] += (signed_of(sum.coarse[b.first + i]) * coarse_unit +
                            signed_of(sum.fine[b.first + i]) * fine_unit) *
                           factor;
        }
    });
}

void ScaledGridSum::pack(Packer& to) const {
    to.put<std::uint64_t>(sums_.size());
    for (const auto& [exponent, sum] : sums_)
        to.put(exponent).put_all(sum.coarse).put_all(sum.fine);
}

void ScaledGridSum::merge(Unpacker& from) {
    for (auto left = from.take<std::uint64_t>(); left > 0; --left) {
        auto& [coarse, fine] = sums_[from.take<int>()];
        for (auto* mine : {&coarse, &fine}) {
            const auto more = from.take_all<std::uint64_t>();
            mine->resize(std::max(mine->size(), more.size()));
            for (std::size_t i = 0; i < more.size(); ++i) (*mine)[i] += more[i];
        }
    }
}

}  // namespace stipple
