// SPDX-License-Identifier: MIT
//
// Generating matrices of Sobol' sequences, which grow from direction numbers.
#pragma once

#include <cstddef>
#include <string>

#include "math/digital/binary_net.hpp"

namespace stipple {

/// Number of dimensions in the program's table.
extern const std::size_t sobol_table_dimensions;

/// Matrices of `digits` columns from the table of Joe and Kuo; dimension <= sobol_table_dimensions.
BinaryMatrices sobol_matrices(std::size_t dimension, std::size_t digits);

/// The same from a file in the format of Joe and Kuo: a line of names, then for each dimension from
/// the second on one line "d s a m_1 ... m_s"; or LDData's `# sobol`, lines of the m only; or
/// LatNet Builder's format of either kind, also interlaced. The whole file is checked.
/// @throws Error(input) naming line and column; Error(usage) if it has too few dimensions
BinaryMatrices sobol_matrices(std::size_t dimension, std::size_t digits, const std::string& path);

}  // namespace stipple
