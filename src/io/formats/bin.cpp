// SPDX-License-Identifier: MIT
//
// Raw numbers and nothing else: little-endian float64 (or float32), point after point and set after
// set. Reading requires the dimension, and all points form one set, unless FILE.meta.json tells the
// dimension, the sets and their size.
//
// Promise float32 is rounded toward zero: values below 1 stay below 1.
#include "core/bytes/raw_numbers.hpp"
#include "core/error.hpp"
#include "io/carried_meta.hpp"
#include "io/columns.hpp"
#include "io/format.hpp"
#include "io/point_stream.hpp"
#include "io/source_text.hpp"

namespace stipple::io::bin {
namespace {

void rows(const Layout& layout, std::size_t, std::uint64_t, std::span<const double> numbers,
          std::string& out) {
    append_raw(out, numbers, layout.single);
}

std::size_t width_of(const ReadOptions& options) {
    if (!options.dimension || *options.dimension == 0)
        fail(ErrorKind::usage, "{}: raw numbers have no dimension; give it with -d",
             source_name(options.source));
    return *options.dimension;
}

std::unique_ptr<PointStream> stream(std::unique_ptr<Feed>& feed, const ReadOptions& options,
                                    const RunContext& /*run*/) {
    RawShape shape{.width = width_of(options), .type = {.size = options.single ? 4U : 8U}};
    if (options.beside && options.beside->width == shape.width && options.beside->sets > 0) {
        shape.sets = options.beside->sets;
        shape.count = options.beside->provenance.count;
    }
    ReadOptions inner = options;
    inner.dimension.reset();  // was the width of the file's rows, not of the picked columns
    return stream_raw(std::move(feed), shape, inner);
}

std::vector<PointSet> read(std::string_view bytes, const ReadOptions& options,
                           const RunContext& run) {
    const std::string source = source_name(options.source);
    const std::size_t width = width_of(options);
    const std::size_t size = options.single ? 4 : 8;
    if (bytes.empty()) refuse_empty(options.source, "raw points");
    if (bytes.size() % size != 0 || bytes.size() / size % width != 0)
        fail(ErrorKind::input,
             "{}: byte {}: the last point is cut off; expected whole points, {} float{} each",
             source, bytes.size(), width, 8 * size);
    run.need_memory(static_cast<double>(bytes.size() / size) * 8, "reading " + source);
    auto feed = std::make_unique<Feed>(bytes);
    return stream(feed, options, run)->read_all(run);
}

}  // namespace

Format unit() {
    return {
        .name = "bin",
        .summary =
            "Raw little-endian numbers, point after point; needs -d, or FILE.meta.json, to read",
        .source = "none",
        .extensions = {".bin", ".f64", ".f32"},
        .traits = {.binary = true, .meta_beside = true},
        .rows = rows,
        .read = read,
        .stream = stream};
}

}  // namespace stipple::io::bin
