// SPDX-License-Identifier: MIT
//
// Power of a spectrum from its Fourier sums and the sums of the strengths; the formulas are at the
// top of periodogram.cpp.
#pragma once

#include <cmath>
#include <cstdint>

#include "math/fourier/grid_sum.hpp"
#include "math/fourier/transform.hpp"
#include "stipple/report.hpp"
#include "stipple/run.hpp"

namespace stipple::analyzers {

/// The sums sum_j s_j and sum_j s_j^2.
struct Strengths {
    double sum = 0;
    double squares = 0;
};

/// Sums the weights of points that arrive in blocks, possibly in several processes. Partial sums
/// are merged in the order of the grids.
class StrengthSums {
  public:
    void add(double strength) {
        if (points_ == block) close();
        block_.sum += strength;
        block_.squares += strength * strength;
        ++points_;
    }

    [[nodiscard]] Strengths total() {
        if (sum_.empty()) return block_;
        if (points_ > 0) close();
        Strengths all;
        sum_.copy_to({&all.sum, 1}, {});
        squares_.copy_to({&all.squares, 1}, {});
        return all;
    }

    void pack(Packer& to) {
        close();
        sum_.pack(to);
        squares_.pack(to);
    }
    /// The points of this object must be whole blocks.
    void merge(Unpacker& from) {
        if (points_ > 0) close();
        sum_.merge(from);
        squares_.merge(from);
    }

  private:
    /// Number of points per block; a divisor of the number of points per grid.
    static constexpr std::uint64_t block = std::uint64_t{1} << 21;

    void close() {
        sum_.add({&block_.sum, 1}, std::abs(block_.sum), {});
        squares_.add({&block_.squares, 1}, block_.squares, {});
        block_ = {};
        points_ = 0;
    }

    Strengths block_;
    std::uint64_t points_ = 0;
    ScaledGridSum sum_;
    ScaledGridSum squares_;
};

/// Power at all frequencies from the sums at half of them; P(-f) = P(f) holds exactly.
/// @param hann whether the points were weighted by the Hann window
Grid power_of(const FourierSums& sums, const Strengths& strengths, bool hann,
              const RunContext& run);

}  // namespace stipple::analyzers
