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
#include "core/bytes/npy_header.hpp"
#include "core/bytes/raw_numbers.hpp"
#include "core/error.hpp"
#include "io/columns.hpp"
#include "io/format.hpp"
#include "io/point_stream.hpp"
#include "io/source_text.hpp"

namespace stipple::io::npy {
namespace {

void head(const Layout& layout, std::string& out) {
    std::vector<std::uint64_t> shape = {layout.counts[0], layout.width()};
    if (layout.many_sets()) shape.insert(shape.begin(), layout.counts.size());
    out += npy_head(shape, layout.single);
}

void rows(const Layout& layout, std::size_t, std::uint64_t, std::span<const double> numbers,
          std::string& out) {
    append_raw(out, numbers, layout.single);
}

/// Converts column-major order to row-major.
std::vector<double> rows_first(const std::vector<double>& stored, std::size_t sets, std::size_t n,
                               std::size_t d) {
    std::vector<double> table(stored.size());
    for (std::size_t r = 0; r < sets; ++r)
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t k = 0; k < d; ++k)
                table[(r * n + i) * d + k] = stored[r + sets * (i + n * k)];
    return table;
}

/// Converts the shape (n,), (n, d) or (sets, n, d) of an array. @throws Error(input) for other
/// shapes
RawShape shape_of(const NpyHeader& header) {
    const std::size_t rank = header.shape.size();
    if (rank == 0 || rank > 3)
        header.refuse(fmt::format("an array of shape {}; expected (n,), (n, d) or (sets, n, d)",
                                  header.shown_shape));
    if (header.empty())
        header.refuse(fmt::format("an array of shape {} holds no points", header.shown_shape));
    return {.sets = rank == 3 ? header.shape[0] : 1,
            .count = header.shape[rank == 3 ? 1 : 0],
            .width = rank == 1 ? 1 : header.shape.back(),
            .type = header.type,
            .offset = header.size};
}

std::vector<PointSet> read(std::string_view bytes, const ReadOptions& options,
                           const RunContext& run) {
    const std::string source = source_name(options.source);
    const NpyHeader header = read_npy_header(bytes, source);
    const RawShape shape = shape_of(header);
    const std::size_t size = npy_numbers(header, bytes.size());
    run.need_memory(static_cast<double>(size) * 8, "reading " + source);
    if (!header.columns_first)
        return stream_raw(std::make_unique<Feed>(bytes), shape, options)->read_all(run);
    const Columns columns = choose_columns({}, shape.width, options, source);
    std::vector<double> table(size);
    take_raw(bytes.substr(header.size), header.type, table);
    check_finite(table, {.width = 0, .type = header.type, .offset = header.size}, source);
    table = rows_first(table, shape.sets, *shape.count, shape.width);
    std::vector<std::uint64_t> starts(shape.sets);
    for (std::size_t r = 0; r < shape.sets; ++r) starts[r] = r * *shape.count;
    return cut_sets(keep_coordinates(std::move(table), columns), columns.dimension, starts, {});
}

/// Streams row-major arrays. Returns null for column-major ones, which must be read as a whole.
std::unique_ptr<PointStream> stream(std::unique_ptr<Feed>& feed, const ReadOptions& options,
                                    const RunContext& run) {
    const std::string source = source_name(options.source);
    const NpyHeader header = read_npy_header(feed->front(), source);
    if (header.columns_first) return nullptr;
    const RawShape shape = shape_of(header);
    run.need_memory(64 * static_cast<double>(shape.width), "a row of " + source);
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
