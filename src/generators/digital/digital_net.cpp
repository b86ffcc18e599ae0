// SPDX-License-Identifier: MIT
//
// Digital net from a file of generating matrices. With the digits a_0, a_1, ... of index i in the
// prime base b, lowest first, coordinate k of point i is
//
//     x = sum_j y_j b^(-j-1)    where    y = C_k a  mod b.
//
// For nets of higher order, the digits of alpha coordinates are interlaced into one: the first
// digit of each, then the second of each, and so on.
//
// Layouts of files; `#` starts a comment, anywhere:
//
//     dnet      first line `# dnet`, then four numbers: base b, number s of matrices, their number
//               of columns m (or of points, b^m), and of rows r; then a line for each matrix: its m
//               columns as integers below b^r, whose most significant digit in base b is the first
//               row (the format of LDData; LatNet Builder writes another title and omits the base,
//               which is then 2);
//     dnetup    the same after `# dnetup`, but the first row is the least significant digit;
//     digits    the same four numbers after `# digits`; then s times r lines of m digits, matrix
//               after matrix, row after row;
//     columns   no first line and no numbers, base 2, a line for each matrix, as in dnetup (the
//               files *.col of the Magic Point Shop);
//     rows      no first line and no numbers, square matrices as in digits (the files of
//               MatBuilder).
//
// Example: Pascal's triangle modulo 2, for the first 2^3 = 8 points of Sobol's second coordinate:
//
//     # dnet                              # digits
//     2  # base                           2 1 3 3
//     1  # matrix                         1 1 1
//     3  # columns: 2^3 points            0 1 0
//     3  # rows                           0 0 1
//     4 6 5
//
// Shape   n x d for s >= alpha d matrices of m columns; i < b^m and i < 2^53.
// Cost    O(n d); base 2: half a nanosecond a coordinate; others: five to ten. Nested scrambling in
//         other bases takes up to two microseconds if matrices are not triangular.
// Promise every coordinate is below 1, and correctly rounded from its first t digits, where t is
//         the largest number with b^t <= 2^50 (53 in base 2).
// Source  H. Niederreiter, Random Number Generation and Quasi-Monte Carlo Methods, SIAM 1992,
//         section 4.3, doi:10.1137/1.9781611970081; interlacing: J. Dick, SIAM J. Numer. Anal. 46
//         (2008) 1519-1553, doi:10.1137/060666639. Layouts: github.com/QMCSoftware/LDData,
//         formats.md (dnet, dnetup); F. Y. Kuo, D. Nuyens, Found. Comput. Math. 16 (2016)
//         1631-1696, doi:10.1007/s10208-016-9329-5 (columns); L. Paulin et al., ACM Trans. Graph.
//         41 (2022) 84, doi:10.1145/3528223.3530063 (rows).

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/text.hpp"
#include "generators/generator.hpp"
#include "generators/net_sequence.hpp"
#include "math/arithmetic/ratio.hpp"
#include "math/combinatorics/primes.hpp"
#include "math/digital/base_net.hpp"
#include "math/functions/powers.hpp"
#include "media/token_file.hpp"

namespace stipple::generators::digital_net {
namespace {

constexpr Param<Path> matrices_option{
    {.name = "matrices", .help = "File of the generating matrices, required; gives the dimension"}};
constexpr Param<Choice> layout_option{
    .name = "layout",
    .fallback = "auto",
    .choices = "auto|dnet|dnetup|digits|columns|rows",
    .help =
        "Layout of the file: dnet and dnetup of LatNet Builder and LDData (base, matrices, "
        "columns, rows, then one line per matrix, one whole number per column), digits (the same "
        "four numbers, then the matrices row by row), columns (Magic Point Shop: no header, base "
        "2), rows (MatBuilder: no header, square); auto: from the first line"};
constexpr Param<std::int64_t> base_option{
    .name = "base",
    .low = 2,
    .high = BaseNet::largest_base,
    .optional = true,
    .help = "Base of a file in the layout rows, a prime; default: 2"};
constexpr Param<std::int64_t> interlacing{
    .name = "interlace",
    .low = 1,
    .high = 64,
    .optional = true,
    .help =
        "Interlacing factor alpha: each coordinate takes its digits from alpha matrices; default: "
        "from the file, else 1"};

/// Matrices of the same size, in one prime base.
struct MatrixFile {
    std::uint32_t base = 2;
    std::vector<DigitMatrix> matrices;
    std::size_t interlaced = 1;  ///< interlacing factor, from the file or the options
};

constexpr std::size_t most_columns = 64;
constexpr std::size_t most_rows = 4096;
constexpr std::size_t most_matrices = 1'000'000;

struct Header {
    std::uint32_t base = 2;
    std::size_t matrices = 0;
    std::size_t columns = 0;
    std::size_t rows = 0;
    std::size_t interlaced = 1;
};

/// First line of LatNet Builder's files of nets, which do not contain the base.
constexpr std::string_view latnet_title = "# Parameters for a digital net in base 2";

std::string layout_of(const TokenFile& file, std::string_view wanted) {
    if (wanted != "auto") return std::string(wanted);
    if (file.is_headed(latnet_title)) return "dnet";
    const std::string_view line = file.first_line();
    if (line.starts_with("#")) {
        const auto words = split(trim(line.substr(1)), ' ');
        for (const char* layout : {"dnet", "dnetup", "digits"})
            if (!words.empty() && trim(words.front()) == layout) return layout;
    }
    file.refuse({.text = {}, .line = 1, .column = 1},
                "the first line is not # dnet, # dnetup or # digits; expected one of them, or else "
                "--layout columns or rows");
}

Header read_header(TokenFile& file) {
    Header header;
    const Token at = file.peek();
    if (!file.is_headed(latnet_title))
        header.base = static_cast<std::uint32_t>(file.number("the base", 2, BaseNet::largest_base));
    if (!is_prime(header.base))
        file.refuse(at, fmt::format("the base {} is not a prime, {} divides it", header.base,
                                    smallest_factor(header.base)));
    header.matrices = file.number("the number of matrices", 1, most_matrices);
    if (file.comment_has(interlacing_comment)) {
        header.interlaced = file.number("the interlacing factor", 1, 64);
        header.matrices *= header.interlaced;
        file.number("the number of components", header.matrices, header.matrices);
    }
    const Token shape = file.peek();
    header.columns = file.number("the number of columns, or of points", 1);
    for (std::size_t k = 1; header.columns > most_columns && k <= most_columns; ++k)
        if (saturating_power(header.base, k) == header.columns) header.columns = k;
    if (header.columns > most_columns)
        file.refuse(
            shape,
            fmt::format(
                "{} is neither a number of columns up to {} nor a number of points, a power of {}",
                shape.text, most_columns, header.base));
    header.rows = file.number("the number of rows", 1, most_rows);
    file.expect_line_end();
    return header;
}

/// Integers of a line: `count` of them, or all of them if `count` is 0.
std::vector<std::uint64_t> read_line(TokenFile& file, std::string_view what, std::size_t count,
                                     std::uint64_t high) {
    std::vector<std::uint64_t> line{file.number(what, 0, high)};
    while (count == 0 ? !file.at_line_end() : line.size() < count)
        line.push_back(file.number_on_line(what, 0, high));
    file.expect_line_end();
    return line;
}

/// Matrix with columns given as integers; `up`: the first row is their least significant digit.
DigitMatrix of_columns(const std::vector<std::uint64_t>& columns, std::uint32_t base,
                       std::size_t rows, bool up) {
    DigitMatrix matrix(rows, columns.size());
    for (std::size_t c = 0; c < columns.size(); ++c) {
        std::uint64_t rest = columns[c];
        for (std::size_t r = 0; r < rows; ++r, rest /= base)
            matrix.at(up ? r : rows - 1 - r, c) = static_cast<std::uint32_t>(rest % base);
    }
    return matrix;
}

/// Reads the remaining rows of a matrix whose first row is `line`.
DigitMatrix of_rows(TokenFile& file, std::vector<std::uint64_t> line, std::uint32_t base,
                    std::size_t rows) {
    DigitMatrix matrix(rows, line.size());
    for (std::size_t r = 0;;) {
        for (std::size_t c = 0; c < line.size(); ++c)
            matrix.at(r, c) = static_cast<std::uint32_t>(line[c]);
        if (++r == rows) return matrix;
        line = read_line(file, "a digit", line.size(), base - 1);
    }
}

/// Largest column as an integer, base^rows - 1; 0 if it exceeds 64 bits.
std::uint64_t largest_column(const Header& header) {
    const std::uint64_t power = saturating_power(header.base, header.rows - 1);
    if (power - 1 > (~std::uint64_t{0} - (header.base - 1)) / header.base) return 0;
    return (power - 1) * header.base + (header.base - 1);
}

MatrixFile with_header(TokenFile& file, std::string_view layout) {
    const Header header = read_header(file);
    MatrixFile found{.base = header.base, .matrices = {}, .interlaced = header.interlaced};
    const std::uint64_t high = largest_column(header);
    if (layout != "digits" && high == 0)
        file.refuse_whole(fmt::format(
            "columns of {} digits in base {} exceed 64 bits; expected the layout digits",
            header.rows, header.base));
    while (found.matrices.size() < header.matrices)
        if (layout == "digits")
            found.matrices.push_back(
                of_rows(file, read_line(file, "a digit", header.columns, header.base - 1),
                        header.base, header.rows));
        else
            found.matrices.push_back(of_columns(read_line(file, "a column", header.columns, high),
                                                header.base, header.rows, layout == "dnetup"));
    if (!file.at_end())
        file.refuse(file.peek(),
                    fmt::format("unexpected {}; expected the end of the file after {} matrices",
                                shown(file.peek().text), header.matrices));
    return found;
}

MatrixFile of_bare_columns(TokenFile& file) {
    std::vector<std::vector<std::uint64_t>> lines;
    std::size_t rows = 1;
    while (!file.at_end()) {
        const std::size_t count = lines.empty() ? 0 : lines.front().size();
        lines.push_back(read_line(file, "a column", count, ~std::uint64_t{0}));
        for (const std::uint64_t column : lines.back())
            rows = std::max(rows, static_cast<std::size_t>(std::bit_width(column)));
    }
    MatrixFile found;
    for (const auto& line : lines) found.matrices.push_back(of_columns(line, 2, rows, true));
    return found;
}

MatrixFile of_bare_rows(TokenFile& file, std::uint32_t base) {
    MatrixFile found{.base = base, .matrices = {}};
    std::size_t size = 0;
    while (!file.at_end()) {
        auto line = read_line(file, "a digit", size, base - 1);
        size = line.size();
        found.matrices.push_back(of_rows(file, std::move(line), base, size));
    }
    return found;
}

/// @param base base of the matrices in the layout `rows`
MatrixFile read_matrices(TokenFile& file, std::string_view wanted, std::uint32_t base) {
    if (file.at_end()) file.refuse_whole("no matrix; expected generating matrices");
    const std::string layout = layout_of(file, wanted);
    if (layout != "columns" && layout != "rows") return with_header(file, layout);
    const MatrixFile found = layout == "rows" ? of_bare_rows(file, base) : of_bare_columns(file);
    if (found.matrices.front().columns > most_columns)
        file.refuse_whole(fmt::format("{} columns; expected at most {}",
                                      found.matrices.front().columns, most_columns));
    return found;
}

MatrixFile read(const Values& options) {
    if (!options.given(matrices_option))
        fail(ErrorKind::usage, "--matrices: digital-net needs a file of generating matrices");
    const bool rows = options[layout_option] == "rows";
    if (options.given(base_option) && !rows)
        fail(ErrorKind::usage,
             "--base applies to the layout rows only; the others give or fix their base");
    const std::uint32_t base = prime_base(options.given(base_option) ? options[base_option] : 2);
    TokenFile file(options[matrices_option]);
    MatrixFile found = read_matrices(file, options[layout_option], base);
    if (options.given(interlacing))
        found.interlaced = static_cast<std::size_t>(options[interlacing]);
    return found;
}

Plan plan(const Request& request, const Values& options) {
    const MatrixFile file = read(options);
    const std::size_t alpha = file.interlaced;
    const std::size_t most = file.matrices.size() / alpha;
    if (most == 0)
        fail(ErrorKind::usage, "--interlace: {} is above the {} matrices of {}", alpha,
             file.matrices.size(), options[matrices_option]);
    const Plan decided = default_plan(request, 1024, most);
    if (decided.dimension > most)
        fail(ErrorKind::usage, "--dimension: {} is outside [1, {}], the dimensions in {}",
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
    file.matrices.resize(decided.dimension * file.interlaced);
    return net_sequence(file.base, interlace(std::move(file.matrices), file.interlaced), decided,
                        options);
}

std::vector<std::uint32_t> bases(const Plan& /*decided*/, const Values& options) {
    return {read(options).base};
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
            .related = {"niederreiter-xing", "generating-matrices", "net"},
            .traits = {},
            .options =
                Schema(matrices_option, layout_option, base_option, interlacing, binary_scramble),
            .plan = plan,
            .sequence = make,
            .uses_seed = binary_uses_seed,
            .notes = notes,
            .bases = bases};
}

}  // namespace stipple::generators::digital_net
