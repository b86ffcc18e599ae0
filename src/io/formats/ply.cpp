// SPDX-License-Identifier: MIT
//
// Polygon file with the points as vertices x, y, z (missing coordinates are 0) and no faces;
// binary, or text if a precision is given. With several sets, each vertex also has its set's
// number.
//
// Shape   1 to 3 dimensions, float64 or float32; extras become properties of the same name. Write
//         only.
// Source  G. Turk, The PLY polygon file format, Stanford University, 1994.
#include <fmt/format.h>

#include <algorithm>

#include "core/bytes/raw_numbers.hpp"
#include "io/decimal.hpp"
#include "io/format.hpp"
#include "io/provenance.hpp"

namespace stipple::io::ply {
namespace {

void head(const Layout& layout, std::string& out) {
    out += layout.precision ? "ply\nformat ascii 1.0\n" : "ply\nformat binary_little_endian 1.0\n";
    if (layout.meta) out += to_comment_lines(layout.provenance, "comment ");
    const auto count = layout.counts.total();
    out += "element vertex " + std::to_string(count) + "\n";
    const std::string property = layout.single ? "property float " : "property double ";
    for (const char* axis : {"x", "y", "z"}) out += property + axis + "\n";
    for (const std::string& extra : layout.extras) out += property + extra + "\n";
    if (layout.many_sets()) out += "property int set\n";
    out += "end_header\n";
}

void rows(const Layout& layout, std::size_t set, std::uint64_t, std::span<const double> numbers,
          std::string& out) {
    const std::size_t d = layout.dimension;
    const auto number = static_cast<std::int32_t>(set);
    std::vector<double> vertex(3 + layout.extras.size());
    const std::string close = layout.many_sets() ? fmt::format(" {}\n", number) : "\n";
    for (std::size_t i = 0; i < numbers.size(); i += layout.width()) {
        const auto row = numbers.subspan(i, layout.width());
        std::copy_n(row.begin(), d, vertex.begin());
        std::copy(row.begin() + static_cast<std::ptrdiff_t>(d), row.end(), vertex.begin() + 3);
        if (layout.precision) {
            append_rows(out, vertex, vertex.size(), {"", " ", close}, layout.precision);
            continue;
        }
        append_raw(out, vertex, layout.single);
        if (layout.many_sets()) out.append(reinterpret_cast<const char*>(&number), 4);
    }
}

}  // namespace

Format unit() {
    return {.name = "ply",
            .summary = "Polygon file with the points as vertices; write only",
            .source = "Turk 1994, The PLY polygon file format",
            .extensions = {".ply"},
            .traits = {.binary = true, .counts_first = true, .max_dimension = 3},
            .head = head,
            .rows = rows};
}

}  // namespace stipple::io::ply
