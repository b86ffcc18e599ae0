// SPDX-License-Identifier: MIT
//
// Digital net from a file of generating matrices. With the digits a_0, a_1, ... of index i in the
// prime base b, lowest first, coordinate k of point i is
//
//     x = sum_r y_r b^(-r-1)    where    y = C_k a  mod b.
//
// For nets of higher order, the digits of alpha coordinates are interlaced to one: the first digit
// of each, then the second of each, and so on.
//
// Shape   n x d for s >= alpha d matrices of m columns; i < b^m and i < 2^53. The layouts of files
//         are described in matrix_file.hpp.
// Cost    O(n d); base 2: half a nanosecond a coordinate; others: five to ten. Scrambled nested in
//         other bases, up to two microseconds where matrices are not triangular.
// Promise every coordinate is correctly rounded from its first r digits, b^r <= 2^50 or, in base 2,
//         r = 53; and below 1.
// Source  H. Niederreiter, Random Number Generation and Quasi-Monte Carlo Methods, SIAM 1992,
//         section 4.3, doi:10.1137/1.9781611970081; interlacing: J. Dick, SIAM J. Numer. Anal. 46
//         (2008) 1519-1553, doi:10.1137/060666639.

#include <algorithm>

#include "core/error.hpp"
#include "generators/digital/matrix_file.hpp"
#include "generators/generator.hpp"
#include "generators/net_sequence.hpp"
#include "math/arithmetic/ratio.hpp"
#include "math/functions/powers.hpp"

namespace stipple::generators::digital_net {
namespace {

constexpr Param<Path> matrices_option{
    {.name = "matrices",
     .help = "File of the generating matrices; needed, and gives the dimension"}};
constexpr Param<Choice> layout{
    .name = "layout",
    .fallback = "auto",
    .choices = "auto|dnet|dnetup|digits|columns|rows",
    .help =
        "How the file is written: dnet and dnetup of LatNet Builder and LDData (base, matrices, "
        "columns, rows, then a whole number a column and a line a matrix), digits (the same "
        "four numbers, then the matrices row by row), columns (Magic Point Shop: no header, "
        "base 2), rows (MatBuilder: no header, square); auto: as its first line says"};
constexpr Param<std::int64_t> base_option{.name = "base",
                                          .low = 2,
                                          .high = BaseNet::largest_base,
                                          .optional = true,
                                          .help =
                                              "Base of a file in the layout rows, a prime; "
                                              "else 2"};
constexpr Param<std::int64_t> interlacing{.name = "interlace",
                                          .fallback = 1,
                                          .low = 1,
                                          .high = 64,
                                          .help =
                                              "Interlacing factor alpha: a coordinate is made "
                                              "of the digits of that many matrices"};

MatrixFile read(const Values& options) {
    if (!options.given(matrices_option))
        fail(ErrorKind::usage, "--matrices: digital-net needs a file of generating matrices");
    const bool rows = options[layout] == "rows";
    if (options.given(base_option) && !rows)
        fail(ErrorKind::usage, "--base: only the layout rows does not say or fix its base");
    const std::uint32_t base = prime_base(options.given(base_option) ? options[base_option] : 2);
    TokenFile file(options[matrices_option]);
    return read_matrices(file, options[layout], base);
}

Plan plan(const Request& request, const Values& options) {
    const MatrixFile file = read(options);
    const auto alpha = static_cast<std::size_t>(options[interlacing]);
    const std::size_t most = file.matrices.size() / alpha;
    if (most == 0)
        fail(ErrorKind::usage, "--interlace: {} is above the {} matrices of {}", alpha,
             file.matrices.size(), options[matrices_option]);
    const Plan decided = default_plan(request, 1024, most);
    if (decided.dimension > most)
        fail(ErrorKind::usage, "--dimension: {} is outside [1, {}], what {} gives",
             decided.dimension, most, options[matrices_option]);
    const std::size_t columns = file.matrices.front().columns;
    const std::uint64_t end = std::min(saturating_power(file.base, columns), exact_limit);
    if (request.start > end || decided.count > end - request.start)
        fail(ErrorKind::usage,
             "--count: {} points from index {} on go beyond the {} = {}^{} points of {}",
             decided.count, request.start, end, file.base, columns, options[matrices_option]);
    return decided;
}

std::unique_ptr<Sequence> make(const Plan& decided, const Values& options, const RunContext&) {
    MatrixFile file = read(options);
    const auto alpha = static_cast<std::size_t>(options[interlacing]);
    file.matrices.resize(decided.dimension * alpha);
    if (alpha > 1) file.matrices = interlace(file.matrices, alpha);
    return net_sequence(file.base, std::move(file.matrices), decided, options);
}

std::vector<std::string> notes(const Request& request, const Plan& decided, const Values& options) {
    return net_notes(read(options).base, request, decided);
}

}  // namespace

Generator unit() {
    return {.name = "digital-net",
            .summary = "Digital net in a prime base, from a file of generating matrices",
            .source =
                "Niederreiter 1992, doi:10.1137/1.9781611970081; "
                "Dick 2008, doi:10.1137/060666639",
            .traits = {},
            .options = Schema(matrices_option, layout, base_option, interlacing, binary_scramble),
            .plan = plan,
            .sequence = make,
            .uses_seed = binary_uses_seed,
            .notes = notes};
}

}  // namespace stipple::generators::digital_net
