// SPDX-License-Identifier: MIT
//
// The transforms of fft.hpp for vectors of STIPPLE_VECTOR_BITS. Not a standalone header:
// core/machine/vector_widths.hpp includes it, and with it the library, in fft_pocketfft.cpp, once
// for every width. Headers that the library needs are included before.

#undef POCKETFFT_HDRONLY_H
#undef PYTHONIC_INCLUDE_NUMPY_FFT_POCKETFFT_HPP  // include guard of Debian's copy
#include POCKETFFT_HEADER

inline std::complex<double>* as_complex(double* p) {
    return reinterpret_cast<std::complex<double>*>(p);
}

inline void real_lines(double* lines, std::size_t length, std::size_t spacing, std::size_t count) {
    const auto step = static_cast<std::ptrdiff_t>(spacing * sizeof(double));
    pocketfft::r2c<double>({count, length}, {step, 8}, {step, 16}, 1, true, lines,
                           as_complex(lines), 1);
}

inline void complex_lines(double* lines, std::size_t length, std::size_t spacing,
                          std::size_t count) {
    const auto step = static_cast<std::ptrdiff_t>(spacing * sizeof(double));
    auto* numbers = as_complex(lines);
    pocketfft::c2c<double>({count, length}, {step, 16}, {step, 16}, {1}, true, numbers, numbers, 1);
}

inline void to_spectrum(const Layout& in, double* values, double* spectrum) {
    pocketfft::r2c<double>(in.shape, in.value_steps, in.spectrum_steps, in.axes, true, values,
                           as_complex(spectrum), 1);
}

inline void to_values(const Layout& in, double* values, double* spectrum) {
    pocketfft::c2r<double>(in.shape, in.spectrum_steps, in.value_steps, in.axes, false,
                           as_complex(spectrum), values, 1);
}
