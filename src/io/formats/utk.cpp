// SPDX-License-Identifier: MIT
//
// UTK's binary files: 20 bytes, then the numbers of all sets, point after point.
//
//     UTK! <u8 type> 0 0 0 <u32 sets> <u32 n> <u32 d>
//
// Shape   d columns, including extras. Types are int32, int64, uint32, uint64, float32 and float64,
//         coded 0 to 5; only the last two are written. Little-endian.
// Beware  UTK calls these files .bin; they are detected by their first four bytes.
// Source  UTK, the Uni{corn|form} tool kit, include/utk/utils/PointsetIO.hpp.
#include <array>

#include "core/bytes/raw_numbers.hpp"
#include "core/error.hpp"
#include "io/format.hpp"
#include "io/point_stream.hpp"
#include "io/source_text.hpp"

namespace stipple::io::utk {
namespace {

constexpr std::size_t head_size = 20;

void append_word(std::string& out, std::uint64_t value, const char* what) {
    if (value >> 32 != 0)
        fail(ErrorKind::usage, "--format: utk holds at most 4294967295 {}; these are {}", what,
             value);
    for (int shift = 0; shift < 32; shift += 8) out += static_cast<char>(value >> shift & 255);
}

void head(const Layout& layout, std::string& out) {
    out += "UTK!";
    out.append({layout.single ? '\4' : '\5', '\0', '\0', '\0'});
    append_word(out, layout.counts.size(), "sets");
    append_word(out, layout.counts[0], "points");
    append_word(out, layout.width(), "coordinates");
}

void rows(const Layout& layout, std::size_t, std::uint64_t, std::span<const double> numbers,
          std::string& out) {
    append_raw(out, numbers, layout.single);
}

/// Parses the first 20 bytes of a file. @throws Error(input) if they are invalid
RawShape shape_of(std::string_view bytes, const std::string& source) {
    const auto refuse = [&](std::size_t byte, const std::string& what) {
        fail(ErrorKind::input, "{}: byte {}: {}", source, byte, what);
    };
    if (!bytes.starts_with("UTK!")) refuse(0, "not a file of UTK; expected the bytes UTK!");
    if (bytes.size() < head_size)
        refuse(bytes.size(), fmt::format("the file ends within its first {} bytes", head_size));
    constexpr std::array<RawType, 6> types = {{{RawType::integer, 4},
                                               {RawType::integer, 8},
                                               {RawType::natural, 4},
                                               {RawType::natural, 8},
                                               {RawType::floating, 4},
                                               {RawType::floating, 8}}};
    const auto type = static_cast<unsigned char>(bytes[4]);
    if (type >= types.size()) refuse(4, fmt::format("numbers of type {}; expected 0 to 5", type));
    std::array<double, 3> words{};  // numbers of sets, points and coordinates
    take_raw(bytes.substr(8), {RawType::natural, 4}, words);
    if (words[0] * words[1] * words[2] == 0)
        refuse(8, fmt::format("{} sets of {} points with {} coordinates hold no points", words[0],
                              words[1], words[2]));
    return {.sets = static_cast<std::size_t>(words[0]),
            .count = static_cast<std::uint64_t>(words[1]),
            .width = static_cast<std::size_t>(words[2]),
            .type = types[type],
            .offset = head_size};
}

std::unique_ptr<PointStream> stream(std::unique_ptr<Feed>& feed, const ReadOptions& options,
                                    const RunContext& run) {
    const std::string source = source_name(options.source);
    const RawShape shape = shape_of(feed->front(), source);
    run.need_memory(64 * static_cast<double>(shape.width), "a row of " + source);
    return stream_raw(std::move(feed), shape, options);
}

std::vector<PointSet> read(std::string_view bytes, const ReadOptions& options,
                           const RunContext& run) {
    const std::string source = source_name(options.source);
    const RawShape shape = shape_of(bytes, source);
    const double wanted = static_cast<double>(shape.sets) * static_cast<double>(*shape.count) *
                          static_cast<double>(shape.width * shape.type.size);
    const std::size_t found = bytes.size() - head_size;
    if (static_cast<double>(found) < wanted)
        fail(ErrorKind::input,
             "{}: byte {}: the file ends too soon; expected {} bytes of numbers, found {}", source,
             bytes.size(), wanted, found);
    return stream_raw(std::make_unique<Feed>(bytes), shape, options)->read_all(run);
}

}  // namespace

Format unit() {
    return {
        .name = "utk",
        .summary = "UTK's binary files: 'UTK!', sets, points, dimension, numbers",
        .source = "UTK, the Uni{corn|form} tool kit",
        .extensions = {".utk"},
        .traits = {.binary = true, .equal_sets = true, .counts_first = true, .meta_beside = true},
        .head = head,
        .rows = rows,
        .read = read,
        .stream = stream};
}

}  // namespace stipple::io::utk
