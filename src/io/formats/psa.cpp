// SPDX-License-Identifier: MIT
//
// Files of PSA (point set analysis): the number of points on the first line, then one point `x y`
// per line.
//
// Shape   one set of 2-D points.
// Beware  never detected by content: its first line looks like a point with one coordinate.
// Source  the text files of PSA, the program for point set analysis by T. Schloemer.
#include "core/error.hpp"
#include "core/text.hpp"
#include "io/carried_meta.hpp"
#include "io/decimal.hpp"
#include "io/format.hpp"
#include "io/formats/delimited.hpp"

namespace stipple::io::psa {
namespace {

void head(const Layout& layout, std::string& out) {
    if (!layout.extras.empty())
        fail(ErrorKind::usage, "--format: psa cannot hold {}", join(layout.extras, ", "));
    out += std::to_string(layout.counts[0]) + "\n";
}

void rows(const Layout& layout, std::size_t, std::uint64_t, std::span<const double> numbers,
          std::string& out) {
    append_rows(out, numbers, layout.width(), {"", " ", "\n"}, layout.precision);
}

std::vector<PointSet> read(std::string_view bytes, const ReadOptions& options,
                           const RunContext& run) {
    const SourceText text(bytes, options.source);
    const Top top = read_top(text);
    const std::string_view line = trim(line_at(text, top.first));
    const auto count = parse_unsigned(line);
    if (!count)
        text.refuse(line.data(), shown(line) + " is not a number of points; psa begins with one");
    const Columns columns = choose_columns({}, 2, options, text.source());
    Rows rows = read_rows(text, top.next, columns, {.separator = ' '}, run);
    const std::size_t found = rows.numbers.size() / columns.dimension;
    if (!rows.marks.empty()) text.refuse(rows.marks[0].at, "'#' begins another set; psa holds one");
    if (found != *count || found == 0)
        text.refuse(line.data(), fmt::format("the first line is {}, but the number of points is "
                                             "{}; expected as many, at least one",
                                             *count, found));
    const bool told = options.beside && options.beside->fits(1, found, 2, bytes);
    return cut_sets(std::move(rows.numbers), columns.dimension, {0},
                    told ? options.beside->provenance : top.provenance);
}

}  // namespace

Format unit() {
    return {.name = "psa",
            .summary = "The number of points, then one line 'x y' per point",
            .source = "PSA, the program by T. Schloemer",
            .extensions = {},
            .traits = {.many_sets = false,
                       .counts_first = true,
                       .meta_beside = true,
                       .max_dimension = 2,
                       .min_dimension = 2},
            .head = head,
            .rows = rows,
            .read = read};
}

}  // namespace stipple::io::psa
