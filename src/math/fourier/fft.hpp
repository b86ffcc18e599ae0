// SPDX-License-Identifier: MIT
//
// Fast Fourier transforms, by the library that STIPPLE_FFT names in CMake: FFTW (fft_fftw.cpp), or
// pocketfft (fft_pocketfft.cpp), which is under a licence that leaves the program under its own.
// All of them sum x_j exp(-2 pi i j k / n), backwards exp(2 pi i j k / n), and none divides by n.
//
// Promise the same bits for any number of threads, and with `estimated` plans in any run on the
//         same machine; the two libraries round differently.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace stipple {

/// How FFTW looks for its way: it guesses, or tries several, which takes up to seconds and may
/// change last bits from run to run.
enum class Planning { estimated, measured };

/// A transform of lines of one length, in place, that any number of threads may execute.
class LineTransform {
  public:
    /// Real numbers become the n / 2 + 1 complex ones of the frequencies from 0 on.
    enum class Kind { real, complex };

    LineTransform(Kind kind, std::size_t length, Planning planning);
    ~LineTransform();

    /// @param lines aligned as GridCells are
    /// @param spacing doubles from one line to the next, a multiple of 8
    void execute(double* lines, std::size_t spacing, std::size_t count) const;

  private:
    struct Plan;
    std::unique_ptr<Plan> plan_;
};

/// A real function on a product of cyclic groups, and its spectrum, of which the last group has
/// n / 2 + 1 frequencies.
class GroupTransform {
  public:
    /// @param shape orders of the groups, of which the last varies fastest
    /// @param values, spectrum are used, and changed, by all that follows
    GroupTransform(const std::vector<int>& shape, double* values, double* spectrum);
    ~GroupTransform();

    void forward() const;

    /// Destroys the spectrum.
    void backward() const;

  private:
    struct Plan;
    std::unique_ptr<Plan> plan_;
};

/// The library and its version.
std::string fft_library();

/// The licence that it leaves a program, as the end of a sentence about stipple's.
std::string_view fft_licence();

/// Takes what FFTW learnt about this machine from a file; where there is none, nothing.
/// @throws Error(io), Error(input), or Error(usage) in a program without FFTW
void read_wisdom(const std::string& path);

/// What FFTW knows by now, as such a file holds it.
std::string wisdom_text();

}  // namespace stipple
