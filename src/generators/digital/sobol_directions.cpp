// SPDX-License-Identifier: MIT
//
// The first s direction numbers m_1, ..., m_s of a dimension (m_j odd, below 2^j) are given; its
// polynomial x^s + a_1 x^(s-1) + ... + a_(s-1) x + 1 over GF(2) gives the others. With
// v_j = m_j / 2^j as column j,
//
//     v_j = a_1 v_(j-1) + ... + a_(s-1) v_(j-s+1) + v_(j-s) + v_(j-s) / 2^s,     j > s.
//
// Source   P. Bratley, B. L. Fox, ACM Trans. Math. Softw. 14 (1988) 88-100,
//          doi:10.1145/42288.214372, for the recurrence; S. Joe, F. Y. Kuo, SIAM J. Sci. Comput. 30
//          (2008) 2635-2654, doi:10.1137/070709359, for the first numbers.
#include "generators/digital/sobol_directions.hpp"

#include <algorithm>
#include <bit>
#include <boost/random/detail/sobol_table.hpp>

#include "core/error.hpp"
#include "core/text.hpp"
#include "generators/net_sequence.hpp"
#include "media/token_file.hpp"

namespace stipple {
namespace {

using JoeKuoTable = boost::random::detail::qrng_tables::sobol;

/// Polynomial and first direction numbers of a dimension, which determine the others.
struct Initializer {
    std::size_t degree = 0;
    std::uint64_t interior = 0;             ///< a_1 ... a_(s-1) as bits, a_1 the highest
    std::vector<std::uint64_t> first = {};  ///< m_1 ... m_s
};

Initializer from_table(std::size_t row) {
    const std::uint64_t polynomial = JoeKuoTable::polynomial(row);
    Initializer initial{.degree = static_cast<std::size_t>(std::bit_width(polynomial)) - 1};
    initial.interior = (polynomial ^ std::bit_floor(polynomial)) >> 1;
    for (std::size_t j = 0; j < initial.degree; ++j)
        initial.first.push_back(JoeKuoTable::minit(row, j));
    return initial;
}

void grow(const Initializer& initial, std::size_t k, BinaryMatrices& matrices) {
    const std::size_t s = initial.degree;
    const std::size_t digits = matrices.digits();
    const auto column = [&](std::size_t j) -> std::uint64_t& {
        return matrices.columns[j * matrices.dimension + k];
    };
    for (std::size_t j = 0; j < digits; ++j) {
        if (j < s) {
            column(j) = initial.first[j] << (63 - j);
            continue;
        }
        std::uint64_t sum = column(j - s) ^ (column(j - s) >> s);
        for (std::size_t i = 1; i < s; ++i)
            if (initial.interior >> (s - 1 - i) & 1) sum ^= column(j - i);
        column(j) = sum;
    }
}

BinaryMatrices van_der_corput_first(std::size_t dimension, std::size_t digits) {
    BinaryMatrices matrices{dimension, std::vector<std::uint64_t>(dimension * digits)};
    for (std::size_t j = 0; j < std::min<std::size_t>(digits, 64); ++j)
        matrices.columns[j * dimension] = std::uint64_t{1} << (63 - j);
    return matrices;
}

/// @param bare the line has m_1 ... m_s only; the polynomial is that of the table
Initializer read_line(TokenFile& file, std::size_t dimension, bool bare) {
    Initializer initial;
    if (bare) {
        if (dimension > JoeKuoTable::max_dimension)
            file.refuse(file.peek(), "more lines than there are polynomials");
        initial = from_table(dimension - 2);
        initial.first.clear();
    } else {
        file.number("the dimension that comes next", dimension, dimension);
        const std::size_t s = initial.degree = file.number_on_line("the degree s", 1, 63);
        initial.interior =
            file.number_on_line("the coefficients a", 0, (std::uint64_t{1} << (s - 1)) - 1);
    }
    for (std::size_t j = 1; j <= initial.degree; ++j) {
        const Token token = file.peek();
        const std::string what = fmt::format("an odd m_{}", j);
        const std::uint64_t most = (std::uint64_t{1} << j) - 1;
        initial.first.push_back(bare && j == 1 ? file.number(what, 1, most)
                                               : file.number_on_line(what, 1, most));
        if (initial.first.back() % 2 == 0)
            file.refuse(token, fmt::format("{} is even; expected {}", shown(token.text), what));
    }
    file.expect_line_end();
    return initial;
}

/// Reads LatNet Builder's header, lines of a number and a comment: the dimension, for interlaced
/// points the factor and the number of components, and maybe m for 2^m points. Returns the
/// interlacing factor, 1 by default.
std::size_t take_header(TokenFile& file) {
    std::size_t alpha = 1;
    while (file.comment_has("#")) {
        const bool interlaced = file.comment_has(interlacing_comment);
        const std::uint64_t number =
            file.number("a number of the header", 1, interlaced ? 64 : 1'000'000);
        if (interlaced) alpha = static_cast<std::size_t>(number);
        file.expect_line_end();
    }
    return alpha;
}

/// Interlaces the digits of alpha coordinates at a time: first digits, then second digits, ...
BinaryMatrices interlaced(const BinaryMatrices& matrices, std::size_t alpha) {
    BinaryMatrices woven{matrices.dimension / alpha, {}};
    for (std::size_t at = 0; at < matrices.columns.size(); at += alpha) {
        std::uint64_t column = 0;
        for (std::size_t r = 0; r < 64; ++r)
            column |= (matrices.columns[at + r % alpha] >> (63 - r / alpha) & 1) << (63 - r);
        woven.columns.push_back(column);
    }
    return woven;
}

}  // namespace

const std::size_t sobol_table_dimensions = JoeKuoTable::max_dimension;

BinaryMatrices sobol_matrices(std::size_t dimension, std::size_t digits) {
    BinaryMatrices matrices = van_der_corput_first(dimension, digits);
    for (std::size_t k = 1; k < dimension; ++k) grow(from_table(k - 1), k, matrices);
    return matrices;
}

BinaryMatrices sobol_matrices(std::size_t dimension, std::size_t digits, const std::string& path) {
    TokenFile file(path);
    const bool bare = (file.is_headed("# sobol") && !file.is_headed("# soboljk")) ||
                      file.is_headed("# Parameters m_{j,c} for Sobol points");
    if (file.peek().text == "d") file.skip_line();
    const bool latnet = file.is_headed("# Parameters");
    const std::size_t alpha = latnet ? take_header(file) : 1;
    std::vector<Initializer> initials;
    while (!file.at_end()) initials.push_back(read_line(file, initials.size() + 2, bare));
    if (initials.empty())
        file.refuse_whole("no direction numbers; expected lines \"d s a m_1 ... m_s\"");
    const std::size_t most = (initials.size() + 1) / alpha;
    if (dimension > most)
        fail(ErrorKind::usage, "--dimension: {} is outside [1, {}], the dimensions in {}",
             dimension, most, path);
    BinaryMatrices matrices = van_der_corput_first(dimension * alpha, digits);
    for (std::size_t k = 1; k < matrices.dimension; ++k) grow(initials[k - 1], k, matrices);
    return alpha > 1 ? interlaced(matrices, alpha) : matrices;
}

}  // namespace stipple
