// SPDX-License-Identifier: MIT
//
// Sobol' sequence: a digital sequence in base 2. Digit by digit over GF(2), coordinate k of point i
// is
//
//     x_k(i) = sum_j i_j v_kj    where    i = sum_j i_j 2^j,
//
// with direction numbers v_kj that grow from a primitive polynomial p_k (sobol_directions.cpp). The
// first coordinate is the radical inverse in base 2.
//
// Shape   n x d for d <= 3667, or as many as a file has; indices below 2^52.
// Cost    O(n d), at the speed of the cache: see math/digital/binary_net.hpp.
// Promise coordinates are exact (scrambled: their first 53 digits are). Any 2^m points from a
//         multiple of 2^m on are a (t,m,d)-net in base 2, t = sum_k (deg p_k - 1), k > 1; also if
//         scrambled. Both orders have the same nets.
// Beware  other counts, or leaving out the first point, lose this evenness; a note reports it.
// Source  I. M. Sobol', USSR Comput. Math. Math. Phys. 7(4) (1967) 86-112,
//         doi:10.1016/0041-5553(67)90144-9. Order: I. A. Antonov, V. M. Saleev, ibid. 19(1) (1979)
//         252-256, doi:10.1016/0041-5553(79)90085-5. Directions: S. Joe, F. Y. Kuo, SIAM J. Sci.
//         Comput. 30 (2008) 2635-2654, doi:10.1137/070709359.
#include "generators/digital/sobol_directions.hpp"
#include "generators/net_sequence.hpp"

namespace stipple::generators::sobol {
namespace {

constexpr Param<Path> directions{
    {.name = "directions",
     .help = "File of direction numbers in Joe and Kuo's format: a line of names, then a line \"d "
             "s a m_1 ... m_s\" for each dimension from 2 on; or LDData's \"# sobol\", with the m "
             "alone. Default: a table of Joe and Kuo"}};

BinaryMatrices matrices_of(const Plan& plan, const Values& options) {
    return options.given(directions)
               ? sobol_matrices(plan.dimension, binary_digits, options[directions])
               : sobol_matrices(plan.dimension, binary_digits);
}

std::unique_ptr<Sequence> make(const Plan& plan, const Values& options, const RunContext&) {
    return binary_sequence(matrices_of(plan, options), plan, options);
}

/// All columns of each matrix; and the upper halves of the first 32, for 32-bit indices.
std::vector<Constants> constants(const Plan& plan, const Values& options, const RunContext&) {
    const BinaryMatrices matrices = matrices_of(plan, options);
    Constants all{"columns", {}};
    Constants upper{"upper", {}, true};
    for (std::size_t k = 0; k < plan.dimension; ++k)
        for (std::size_t j = 0; j < matrices.digits(); ++j) {
            const std::uint64_t column = matrices.columns[j * plan.dimension + k];
            all.numbers.push_back(column);
            if (j < 32) upper.numbers.push_back(column >> 32);
        }
    return {all, upper};
}

}  // namespace

Generator unit() {
    return {.name = "sobol",
            .summary = "Sobol' sequence: a digital sequence in base 2, plain or scrambled",
            .source =
                "Sobol' 1967, doi:10.1016/0041-5553(67)90144-9; Joe and Kuo 2008, "
                "doi:10.1137/070709359",
            .related = {"quasi-random", "low-discrepancy", "joe-kuo", "sobolset"},
            .traits = {.max_dimension = sobol_table_dimensions,
                       .max_index = std::uint64_t{1} << binary_digits,
                       .more_dimensions = std::string(directions.name)},
            .options = Schema(binary_order, binary_scramble, directions),
            .aliases = {"lp-tau"},
            .sequence = make,
            .uses_seed = binary_uses_seed,
            .notes = binary_notes,
            .constants = constants};
}

}  // namespace stipple::generators::sobol
