// SPDX-License-Identifier: MIT
//
// Header of NumPy's array files: a magic string, a version, the header's length, and a Python
// dictionary that describes the raw numbers after it.
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

struct NpyHeader {
    RawType type = {};
    bool columns_first = false;           ///< column-major order: the first index varies fastest
    std::vector<std::size_t> shape = {};  ///< extents; may be empty, or contain 0
    std::string shown_shape = {};         ///< as written in the file: "(1024, 2)"
    std::size_t start = 0;                ///< position of the dictionary, in bytes
    std::size_t size = 0;                 ///< bytes before the array's numbers
    std::string source = {};              ///< name of the file, for messages

    /// Whether some extent is 0.
    [[nodiscard]] bool empty() const;

    /// @throws Error(input) "SOURCE: byte N: what", with the dictionary's position
    [[noreturn]] void refuse(const std::string& what) const;
};

/// Parses a header of version 1 to 3 with numbers float64, float32 or integer, of any byte order.
/// @throws Error(input) "SOURCE: byte N: error; what is expected"
NpyHeader read_npy_header(std::string_view bytes, const std::string& source);

/// Number of elements in the array.
/// @throws Error(input) unless a file of `bytes` bytes ends exactly after these elements
std::size_t npy_numbers(const NpyHeader& header, std::size_t bytes);

/// Header of version 1 for an array in row-major order, padded to a multiple of 64 bytes.
std::string npy_head(std::span<const std::uint64_t> shape, bool single);

}  // namespace stipple
