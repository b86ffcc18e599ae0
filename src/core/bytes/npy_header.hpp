// SPDX-License-Identifier: MIT
//
// The front of NumPy's array files: a magic string, a version, the length of a header, and a Python
// dictionary that says how the raw numbers behind it are stored.
//
//     \x93NUMPY 1 0 <u16> {'descr': '<f8', 'fortran_order': False, 'shape': (1024, 2), }
//
// Source  numpy.lib.format, NEP 1 (https://numpy.org/neps/nep-0001-npy-format.html).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/bytes/raw_numbers.hpp"

namespace stipple {

inline constexpr std::string_view npy_magic = "\x93NUMPY";

/// What a header says.
struct NpyHeader {
    RawType type = {};
    bool columns_first = false;           ///< the first index runs fastest
    std::vector<std::size_t> shape = {};  ///< any number of extents, any of them 0
    std::string shown_shape = {};         ///< as it is written: "(1024, 2)"
    std::size_t start = 0;                ///< byte at which the dictionary begins
    std::size_t size = 0;                 ///< bytes before the numbers
    std::string source = {};              ///< for messages

    /// Whether some extent is 0.
    [[nodiscard]] bool empty() const;

    /// @throws Error(input) "SOURCE: byte N: what" with the dictionary's place
    [[noreturn]] void refuse(const std::string& what) const;
};

/// Versions 1 to 3; float64, float32 and integers of either byte order.
/// @throws Error(input) "SOURCE: byte N: what is wrong; what is expected"
NpyHeader read_npy_header(std::string_view bytes, const std::string& source);

/// How many numbers the shape has. @throws Error(input) unless a file of `bytes` bytes holds just
/// these.
std::size_t npy_numbers(const NpyHeader& header, std::size_t bytes);

/// The front of a file of an array, its numbers point after point: version 1, and blanks up to a
/// multiple of 64 bytes.
std::string npy_head(std::span<const std::uint64_t> shape, bool single);

}  // namespace stipple
