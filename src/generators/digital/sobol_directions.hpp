// SPDX-License-Identifier: MIT
//
// Direction numbers of Sobol' sequences: what each generating matrix grows from.
#pragma once

#include <cstddef>
#include <string>

#include "math/digital/binary_net.hpp"

namespace stipple {

/// Dimensions of the table that the program carries.
extern const std::size_t sobol_table_dimensions;

/// Matrices of `digits` columns by the table of Joe and Kuo; dimension <= sobol_table_dimensions.
BinaryMatrices sobol_matrices(std::size_t dimension, std::size_t digits);

/// The same by a file in the format of Joe and Kuo's: a line of names, then one line a dimension
/// from the second on, "d s a m_1 ... m_s"; or LDData's `# sobol`, lines of no more than the m; or
/// LatNet Builder's of either kind, also interlaced. The whole file is checked.
/// @throws Error(input) naming line and column; Error(usage) when it has too few dimensions
BinaryMatrices sobol_matrices(std::size_t dimension, std::size_t digits, const std::string& path);

}  // namespace stipple
