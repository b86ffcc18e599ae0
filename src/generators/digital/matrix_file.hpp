// SPDX-License-Identifier: MIT
//
// Generating matrices of digital nets from text files. `#` opens a comment, anywhere. The layouts:
//
//     dnet      first line `# dnet`, then four numbers: base b, number s of matrices, their columns
//               k (or the number of points, b^k), and rows r; then a line a matrix: its k columns
//               as whole numbers below b^r, in whose base b digits the first row is the most
//               significant (the format of LDData and LatNet Builder);
//     dnetup    the same, `# dnetup`, with the first row the least significant;
//     digits    the same four numbers after `# digits`; then s r lines of k digits, matrix after
//               matrix, row after row;
//     columns   no first line and no numbers, base 2, a line a matrix, as in dnetup (the files
//               *.col of the Magic Point Shop);
//     rows      no first line and no numbers, square matrices as in digits (the files of
//               MatBuilder).
//
// For instance, Pascal's triangle modulo 2, of the first 2^3 = 8 points of Sobol':
//
//     # dnet                              # digits
//     2  # base                           2 1 3 3
//     1  # matrix                         1 1 1
//     3  # columns: 2^3 points            0 1 0
//     3  # rows                           0 0 1
//     4 6 5
//
// Source   github.com/QMCSoftware/LDData, formats.md (dnet, dnetup); F. Y. Kuo, D. Nuyens, Found.
//          Comput. Math. 16 (2016) 1631-1696, doi:10.1007/s10208-016-9329-5 (columns); L. Paulin et
//          al., ACM Trans. Graph. 41 (2022) 84, doi:10.1145/3528223.3530063 (rows).
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "math/digital/base_net.hpp"
#include "media/token_file.hpp"

namespace stipple {

/// Matrices of one shape, in one prime base.
struct MatrixFile {
    std::uint32_t base = 2;
    std::vector<DigitMatrix> matrices;
};

/// @param layout one of the above, or `auto`: the one that the first line names.
/// @param base of the layout `rows`.
/// @throws Error(input) naming file, line and column
MatrixFile read_matrices(TokenFile& file, std::string_view layout, std::uint32_t base);

/// Coordinates of higher order: row r of the k-th is row r / alpha of matrix alpha k + r mod alpha.
/// What is left over of the matrices when alpha does not divide their number is left out.
/// Source   J. Dick, SIAM J. Numer. Anal. 46 (2008) 1519-1553, doi:10.1137/060666639.
std::vector<DigitMatrix> interlace(const std::vector<DigitMatrix>& matrices, std::size_t alpha);

}  // namespace stipple
