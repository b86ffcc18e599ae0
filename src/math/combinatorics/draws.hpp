// SPDX-License-Identifier: MIT
//
// Uniform random numbers of a stream, returned one by one in order, generated in batches.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/domain.hpp"
#include "core/rng.hpp"

namespace stipple {

class DrawStream {
  public:
    explicit DrawStream(const Rng& rng) : rng_(rng) {}

    /// Next number, uniform in [0, 1).
    double next() {
        if (used_ == batch_.size()) {
            rng_.fill(first_, batch_);
            first_ += batch_.size();
            used_ = 0;
        }
        return batch_[used_++];
    }

    /// Writes a uniform point of the box to p; redraws coordinates that round to an upper face.
    void point(const Box& box, double* p) {
        for (std::size_t k = 0; k < box.dimension(); ++k) do
                p[k] = box.low[k] + next() * box.extent(k);
            while (p[k] >= box.high[k]);
    }

  private:
    Rng rng_;
    std::array<double, 256> batch_{};
    std::size_t used_ = batch_.size();
    std::uint64_t first_ = 0;
};

}  // namespace stipple
