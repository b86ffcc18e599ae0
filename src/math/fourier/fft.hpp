// SPDX-License-Identifier: MIT
//
// Fast Fourier transforms, by the library that STIPPLE_FFT selects in CMake: FFTW (fft_fftw.cpp),
// or pocketfft (fft_pocketfft.cpp), whose licence does not change that of the program. Forward
// transforms sum x_j exp(-2 pi i j k / n), backward ones x_j exp(2 pi i j k / n); neither divides
// by n.
//
// Promise the same bits for any number of threads, and with `estimated` plans in every run on the
//         same machine. The two libraries round differently.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace stipple {

/// FFTW's choice of algorithm: estimated, or measured by trying several. Measuring takes up to
/// seconds and may change last bits from run to run.
enum class Planning { estimated, measured };

/// In-place transform of lines of equal length. Threads may execute it concurrently.
class LineTransform {
  public:
    /// real: n real numbers become n / 2 + 1 complex ones, of frequencies 0, 1, ..., n / 2.
    enum class Kind { real, complex };

    LineTransform(Kind kind, std::size_t length, Planning planning);
    ~LineTransform();

    /// @param lines start of the first line, aligned to 64 bytes
    /// @param spacing doubles from one line to the next, a multiple of 8
    void execute(double* lines, std::size_t spacing, std::size_t count) const;

  private:
    struct Plan;
    std::unique_ptr<Plan> plan_;
};

/// Transform of a real function on a product of cyclic groups. The spectrum has all frequencies of
/// each group except the last: if this has order n, only 0, 1, ..., n / 2.
class GroupTransform {
  public:
    /// @param shape orders of the groups, the last one varying fastest
    /// @param values, spectrum arrays that all transforms read and overwrite
    GroupTransform(const std::vector<int>& shape, double* values, double* spectrum);
    ~GroupTransform();

    void forward() const;

    /// Transforms back and destroys the spectrum.
    void backward() const;

  private:
    struct Plan;
    std::unique_ptr<Plan> plan_;
};

/// Name and version of the library.
std::string fft_library();

/// Licence of a program with this library; the text ends a sentence about stipple's licence.
std::string_view fft_licence();

/// Loads FFTW's measurements of this machine from a file; does nothing if the file does not exist.
/// @throws Error(io), Error(input), or Error(usage) in a program without FFTW
void read_wisdom(const std::string& path);

/// FFTW's current measurements, in the format that read_wisdom() reads.
std::string wisdom_text();

}  // namespace stipple
