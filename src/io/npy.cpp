// SPDX-License-Identifier: MIT
//
// NumPy's array files: a magic string, a version, the length of a header, a Python dictionary
// padded with blanks to a multiple of 64 bytes, and the raw numbers.
//
//     \x93NUMPY 1 0 <u16> {'descr': '<f8', 'fortran_order': False, 'shape': (1024, 2), }
//
// Shape   (n, d), or (R, n, d) for R sets; extras count as coordinates. The reader also takes (n,),
//         versions 2 and 3, both byte orders, column-major order, float32 and integers.
// Source  numpy.lib.format, NEP 1 (https://numpy.org/neps/nep-0001-npy-format.html).
#include "core/error.hpp"
#include "core/npy_header.hpp"
#include "io/binary.hpp"
#include "io/columns.hpp"
#include "io/format.hpp"
#include "io/point_stream.hpp"
#include "io/source_text.hpp"

namespace stipple::io::npy {
namespace {

void head(const Layout& layout, std::string& out) {
    std::string header = fmt::format(
        "{{'descr': '<f{}', 'fortran_order': False, 'shape': ({}{}, {}), }}", layout.single ? 4 : 8,
        layout.many_sets() ? fmt::format("{}, ", layout.counts.size()) : std::string(),
        layout.counts.at(0), layout.width());
    constexpr std::size_t before = 10;
    const std::size_t used = before + header.size() + 1;
    header.append((64 - used % 64) % 64, ' ');
    header += '\n';
    out += npy_magic;
    out.append({'\1', '\0', static_cast<char>(header.size() % 256),
                static_cast<char>(header.size() / 256)});
    out += header;
}

void rows(const Layout& layout, std::size_t, std::uint64_t, std::span<const double> numbers,
          std::string& out) {
    append_raw(out, numbers, layout.single);
}

/// Point after point what was stored with the first index running fastest.
std::vector<double> rows_first(const std::vector<double>& stored, std::size_t sets, std::size_t n,
                               std::size_t d) {
    std::vector<double> table(stored.size());
    for (std::size_t r = 0; r < sets; ++r)
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t k = 0; k < d; ++k)
                table[(r * n + i) * d + k] = stored[r + sets * (i + n * k)];
    return table;
}

std::vector<PointSet> read(std::string_view bytes, const ReadOptions& options,
                           const RunContext& run) {
    const std::string source = source_name(options.source);
    const NpyHeader header = read_npy_header(bytes, source);
    const std::size_t rank = header.shape.size();
    if (rank == 0 || rank > 3)
        header.refuse(fmt::format("an array of shape {}; expected (n,), (n, d) or (sets, n, d)",
                                  header.shown_shape));
    if (header.empty())
        header.refuse(fmt::format("an array of shape {} holds no points", header.shown_shape));
    const std::size_t size = npy_numbers(header, bytes.size());
    const std::string_view data = bytes.substr(header.size);
    const std::size_t sets = rank == 3 ? header.shape[0] : 1;
    const std::size_t width = rank == 1 ? 1 : header.shape.back();
    const std::size_t n = size / sets / width;

    run.need_memory(static_cast<double>(size) * 8, "reading " + source);
    const Columns columns = choose_columns({}, width, options, source);
    std::vector<double> table(size);
    take_raw(data, header.type, table);
    check_finite(table, {.source = source,
                         .row = header.columns_first ? 0 : width,
                         .size = header.type.size,
                         .offset = header.size});
    if (header.columns_first) table = rows_first(table, sets, n, width);
    std::vector<std::uint64_t> starts(sets);
    for (std::size_t r = 0; r < sets; ++r) starts[r] = r * n;
    return cut_sets(keep_coordinates(std::move(table), columns), columns.dimension, starts, {});
}

/// Point after point; what is stored with the first index running fastest needs all of it.
std::unique_ptr<PointStream> stream(std::unique_ptr<Feed>& feed, const ReadOptions& options,
                                    const RunContext& run) {
    const std::string source = source_name(options.source);
    const NpyHeader header = read_npy_header(feed->front(), source);
    const std::size_t rank = header.shape.size();
    if (rank == 0 || rank > 3 || header.empty() || header.columns_first) return nullptr;
    run.need_memory(64 * static_cast<double>(header.shape.back()), "a row of " + source);
    const bool many = rank == 3;
    const RawShape shape{.sets = many ? header.shape[0] : 1,
                         .count = header.shape[many ? 1 : 0],
                         .width = rank == 1 ? 1 : header.shape.back(),
                         .type = header.type,
                         .offset = header.size};
    return stream_raw(std::move(feed), shape, options);
}

}  // namespace

Format unit() {
    return {
        .name = "npy",
        .summary = "NumPy array of shape (n, d), or (sets, n, d)",
        .source = "NEP 1, numpy.lib.format",
        .extensions = {".npy"},
        .traits = {.binary = true, .equal_sets = true, .counts_first = true, .meta_beside = true},
        .head = head,
        .rows = rows,
        .read = read,
        .stream = stream};
}

}  // namespace stipple::io::npy
