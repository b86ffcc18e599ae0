// SPDX-License-Identifier: MIT
//
// What becomes of a dart that is far enough from all older points.
#pragma once

#include <atomic>
#include <cstdint>

namespace stipple {

enum Fate : std::uint8_t { unknown, stays, goes };

/// A Fate that several threads may ask for and tell at the same time; they all find the same.
class SharedFate {
  public:
    [[nodiscard]] Fate get() const {
        return std::atomic_ref<Fate>(fate_).load(std::memory_order_relaxed);
    }
    void set(Fate fate) { std::atomic_ref<Fate>(fate_).store(fate, std::memory_order_relaxed); }

  private:
    mutable Fate fate_ = unknown;  // there is no reference to a constant atomic
};

}  // namespace stipple
