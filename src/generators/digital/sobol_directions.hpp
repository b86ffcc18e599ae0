// SPDX-License-Identifier: MIT
//
// Generating matrices of Sobol' sequences, which grow from direction numbers.
#pragma once

#include <cstddef>
#include <string>

#include "math/digital/binary_net.hpp"

namespace stipple {

/// Number of dimensions in the table of Joe and Kuo that is built into the program.
extern const std::size_t sobol_table_dimensions;

/// Matrices of `digits` columns from the table of Joe and Kuo; dimension <= sobol_table_dimensions.
BinaryMatrices sobol_matrices(std::size_t dimension, std::size_t digits);

/// Matrices from a file in the format of Joe and Kuo: a line of names, then for each dimension from
/// the second on one line "d s a m_1 ... m_s". Also reads LDData's `# sobol`, whose lines have only
/// the m, and LatNet Builder's versions of both formats, also interlaced. Checks the whole file.
/// @throws Error(input) naming line and column; Error(usage) if it has too few dimensions
BinaryMatrices sobol_matrices(std::size_t dimension, std::size_t digits, const std::string& path);

}  // namespace stipple
