// SPDX-License-Identifier: MIT
#include "generators/digital/matrix_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "core/text.hpp"
#include "core/utf8.hpp"
#include "math/combinatorics/primes.hpp"
#include "math/functions/powers.hpp"

namespace stipple {
namespace {

constexpr std::size_t most_columns = 64;
constexpr std::size_t most_rows = 4096;
constexpr std::size_t most_matrices = 1'000'000;

struct Header {
    std::uint32_t base = 2;
    std::size_t matrices = 0;
    std::size_t columns = 0;
    std::size_t rows = 0;
};

std::string layout_of(const TokenFile& file, std::string_view wanted) {
    if (wanted != "auto") return std::string(wanted);
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
    header.base = static_cast<std::uint32_t>(file.number("the base", 2, BaseNet::largest_base));
    if (!is_prime(header.base))
        file.refuse(at, fmt::format("the base {} is not a prime, {} divides it", header.base,
                                    smallest_factor(header.base)));
    header.matrices = file.number("the number of matrices", 1, most_matrices);
    const Token shape = file.peek();
    header.columns = file.number("the number of columns, or of points", 1);
    for (std::size_t k = 1; header.columns > most_columns && k <= most_columns; ++k)
        if (saturating_power(header.base, k) == header.columns) header.columns = k;
    if (header.columns > most_columns)
        file.refuse(shape, fmt::format("{} is neither a number of columns up to {} nor one of "
                                       "points, a power of {}",
                                       shape.text, most_columns, header.base));
    header.rows = file.number("the number of rows", 1, most_rows);
    file.expect_line_end();
    return header;
}

/// The numbers of a line, `count` of them or, for 0, all there are.
std::vector<std::uint64_t> read_line(TokenFile& file, std::string_view what, std::size_t count,
                                     std::uint64_t high) {
    std::vector<std::uint64_t> line{file.number(what, 0, high)};
    while (count == 0 ? !file.at_line_end() : line.size() < count)
        line.push_back(file.number_on_line(what, 0, high));
    file.expect_line_end();
    return line;
}

/// The matrix of columns that are whole numbers; `up`: the first row is the least significant.
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

/// `line` is the first row, which is there already.
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

/// base^rows - 1; 0 where that is beyond 64 bits.
std::uint64_t largest_column(const Header& header) {
    const std::uint64_t power = saturating_power(header.base, header.rows - 1);
    if (power - 1 > (~std::uint64_t{0} - (header.base - 1)) / header.base) return 0;
    return (power - 1) * header.base + (header.base - 1);
}

MatrixFile with_header(TokenFile& file, std::string_view layout) {
    const Header header = read_header(file);
    MatrixFile found{.base = header.base, .matrices = {}};
    const std::uint64_t high = largest_column(header);
    if (layout != "digits" && high == 0)
        file.refuse_whole(
            fmt::format("columns of {} digits in base {} are beyond 64 bits; expected "
                        "the layout digits",
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
        file.refuse(file.peek(), fmt::format("{} is too much; expected the end of the file behind "
                                             "{} matrices",
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

}  // namespace

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

std::vector<DigitMatrix> interlace(const std::vector<DigitMatrix>& matrices, std::size_t alpha) {
    std::vector<DigitMatrix> woven;
    for (std::size_t first = 0; first + alpha <= matrices.size(); first += alpha) {
        DigitMatrix& matrix =
            woven.emplace_back(alpha * matrices[first].rows, matrices[first].columns);
        for (std::size_t r = 0; r < matrix.rows; ++r)
            for (std::size_t c = 0; c < matrix.columns; ++c)
                matrix.at(r, c) = matrices[first + r % alpha].at(r / alpha, c);
    }
    return woven;
}

}  // namespace stipple
