// SPDX-License-Identifier: MIT
//
// A column of small numbers beside columns of doubles. Vectors hold sixteen of 16 bits, so that GCC
// takes sixteen points at a time through a loop that fills both: four chains of operations on
// vectors of four doubles stand side by side in the code, where a processor would else wait for the
// end of one before it sees the next. Of 32 bits, two chains do; better for a method with many
// numbers at hand. Results are the same; nobody reads the numbers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace stipple::warps {

/// Points that go through one loop.
inline constexpr std::size_t paced = 128;

template <class Beat = std::uint16_t>
class Pace {
  public:
    void mark(std::size_t i) { beat_[i] = static_cast<Beat>(i); }

    /// Behind the loop: keeps compilers from leaving out what is never read.
    void end() const {
#if defined(__GNUC__)
        asm volatile("" : : "r"(beat_.data()) : "memory");
#endif
    }

  private:
    std::array<Beat, paced> beat_;
};

}  // namespace stipple::warps
