// SPDX-License-Identifier: MIT
//
// Letters as TrueType outlines. The outline of a stroke is one closed line: along its left side,
// around its end, back along the other side, and around its beginning. At left turns the outline
// passes through the centre of the pen, at right turns it follows an arc around the pen. It may
// cross itself, which the nonzero winding rule allows.
//
// Source  Apple, TrueType Reference Manual, chapter 6 (glyf, head, hhea, hmtx, loca, maxp).
#include "plot/drawing/font_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "plot/drawing/letters.hpp"

namespace stipple::plot {
namespace {

constexpr double font_units = font_em / em_units;  ///< font units per unit of the glyph grid

/// Appends a number in big-endian order.
void put_number(std::string& out, std::int64_t value, int bytes) {
    for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8)
        out += static_cast<char>(static_cast<std::uint64_t>(value) >> shift & 0xFF);
}
void put_words(std::string& out, std::initializer_list<int> words) {
    for (const int word : words) put_number(out, word, 2);
}

struct Node {
    int x;
    int y;
    bool operator==(const Node&) const = default;
};
using Outline = std::vector<Node>;

Position unit_vector(Position from, Position to) {
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    return {(to.x - from.x) / length, (to.y - from.y) / length};
}

/// Adds the outline at a corner of a stroke: an arc around the pen, from the left side of direction
/// `before` to that of `after`.
void add_corner(Outline& outline, Position corner, Position before, Position after, double radius) {
    constexpr double step = std::numbers::pi / 6;
    const auto add = [&](double dx, double dy) {
        const Node node{static_cast<int>(std::lround(font_units * (corner.x + dx))),
                        static_cast<int>(std::lround(font_units * (corner.y + dy)))};
        if (outline.empty() || outline.back() != node) outline.push_back(node);
    };
    const double cross = before.x * after.y - before.y * after.x;
    const double dot = before.x * after.x + before.y * after.y;
    const bool left = cross > 1e-9;
    const double turn = left ? 0 : std::acos(std::clamp(dot, -1.0, 1.0));
    const int steps = std::max(1, static_cast<int>(std::ceil(turn / step)));
    add(-radius * before.y, radius * before.x);
    if (left) add(0, 0);
    for (int k = 1; k < steps; ++k) {
        const double angle = std::atan2(before.x, -before.y) - turn * k / steps;
        add(radius * std::cos(angle), radius * std::sin(angle));
    }
    add(-radius * after.y, radius * after.x);
}

Outline stroke_outline(std::vector<Position> stroke, double radius) {
    stroke.erase(std::unique(stroke.begin(), stroke.end()), stroke.end());
    const std::size_t n = stroke.size();
    if (n < 2) return {};
    std::vector<Position> way = stroke;  // the stroke forwards and backwards
    for (std::size_t i = n - 1; i-- > 1;) way.push_back(stroke[i]);
    Outline outline;
    for (std::size_t i = 0; i < way.size(); ++i) {
        const Position before = way[(i + way.size() - 1) % way.size()];
        const Position after = way[(i + 1) % way.size()];
        add_corner(outline, way[i], unit_vector(before, way[i]), unit_vector(way[i], after),
                   radius);
    }
    if (outline.front() == outline.back()) outline.pop_back();
    return outline;
}

/// Bounding box.
struct Extent {
    int left = 0, low = 0, right = 0, high = 0;
};

Extent extent_of(const std::vector<Outline>& glyph) {
    Extent extent{32767, 32767, -32768, -32768};
    for (const Outline& outline : glyph)
        for (const auto& [x, y] : outline)
            extent = {std::min(extent.left, x), std::min(extent.low, y), std::max(extent.right, x),
                      std::max(extent.high, y)};
    return glyph.empty() ? Extent{} : extent;
}

std::string glyph_bytes(const std::vector<Outline>& glyph) {
    std::string out;
    if (glyph.empty()) return out;
    const Extent extent = extent_of(glyph);
    put_words(out,
              {static_cast<int>(glyph.size()), extent.left, extent.low, extent.right, extent.high});
    int last = -1;
    for (const Outline& outline : glyph)
        put_number(out, last += static_cast<int>(outline.size()), 2);
    put_number(out, 0, 2);  // no instructions
    constexpr char on_curve = 0x01;
    constexpr char overlapping = 0x40;
    out += static_cast<char>(on_curve | overlapping);
    out.append(static_cast<std::size_t>(last), on_curve);
    for (int Node::*axis : {&Node::x, &Node::y}) {
        int before = 0;
        for (const Outline& outline : glyph)
            for (const Node& node : outline) {
                put_number(out, node.*axis - before, 2);
                before = node.*axis;
            }
    }
    out.resize((out.size() + 3) / 4 * 4, '\0');
    return out;
}

std::vector<Outline> outlines_of(char32_t letter, bool bold) {
    const bool raised = lowered(letter).has_value();
    const double radius = (bold ? 3 : 2.3) / 2 * (raised ? raised_size : 1);
    std::vector<Outline> glyph;
    for (const auto& stroke : strokes_of(letter))
        if (Outline outline = stroke_outline(stroke, radius); !outline.empty())
            glyph.push_back(std::move(outline));
    return glyph;
}

std::uint32_t checksum(const std::string& table) {
    std::uint32_t sum = 0;
    for (std::size_t i = 0; i < table.size(); ++i)
        sum += static_cast<std::uint32_t>(static_cast<unsigned char>(table[i]))
               << (24 - 8 * (i % 4));
    return sum;
}

struct Table {
    const char* name;
    std::string bytes;
};

/// Font file: a directory of the tables, followed by their bytes. Tables must be sorted by name.
std::string file_of(const std::vector<Table>& tables) {
    const int count = static_cast<int>(tables.size());
    std::string out;
    put_number(out, 0x00010000, 4);
    put_words(out, {count, 64, 2, 16 * count - 64});  // correct for 4 to 7 tables
    auto offset = static_cast<std::int64_t>(12 + 16 * tables.size());
    for (const auto& [name, bytes] : tables) {
        out += name;
        put_number(out, checksum(bytes), 4);
        put_number(out, offset, 4);
        put_number(out, static_cast<std::int64_t>(bytes.size()), 4);
        offset += static_cast<std::int64_t>((bytes.size() + 3) / 4 * 4);
    }
    for (const auto& [name, bytes] : tables) {
        out += bytes;
        out.resize((out.size() + 3) / 4 * 4, '\0');
    }
    return out;
}

std::string head_table(const Extent& all) {
    std::string head;
    for (const std::int64_t word : {0x00010000LL, 0x00010000LL, 0LL, 0x5F0F3CF5LL})
        put_number(head, word, 4);  // versions, a checksum (not used), the magic number
    put_words(head, {0x0003, font_em});
    put_number(head, 0, 8);  // no dates, so that equal letters give equal bytes
    put_number(head, 0, 8);
    put_words(head, {all.left, all.low, all.right, all.high, 0, 8, 2, 1, 0});
    return head;
}

}  // namespace

int font_advance(char32_t letter) {
    return static_cast<int>(std::lround(font_units * advance_of(letter)));
}

std::string font_file(std::u32string_view letters, bool bold) {
    constexpr int ascent = 900;
    constexpr int descent = -250;
    std::u32string all = U"\uFFFD";  // glyph 0, drawn as a box
    all += letters;
    std::string glyf, loca, hmtx;
    Extent whole;
    int widest = 0, nodes = 0, outlines = 0;
    for (const char32_t letter : all) {
        const auto glyph = outlines_of(letter, bold);
        const Extent extent = extent_of(glyph);
        int here = 0;
        for (const Outline& outline : glyph) here += static_cast<int>(outline.size());
        put_number(loca, static_cast<std::int64_t>(glyf.size()), 4);
        glyf += glyph_bytes(glyph);
        put_words(hmtx, {font_advance(letter), extent.left});
        whole = {std::min(whole.left, extent.left), std::min(whole.low, extent.low),
                 std::max(whole.right, extent.right), std::max(whole.high, extent.high)};
        widest = std::max(widest, font_advance(letter));
        nodes = std::max(nodes, here);
        outlines = std::max(outlines, static_cast<int>(glyph.size()));
    }
    put_number(loca, static_cast<std::int64_t>(glyf.size()), 4);
    const int count = static_cast<int>(all.size());
    std::string hhea, maxp;
    put_words(hhea, {1, 0, ascent, descent, 0, widest, whole.left, 0, whole.right, 1, 0, 0, 0, 0, 0,
                     0, 0, count});
    put_words(maxp, {1, 0, count, nodes, outlines, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0});
    return file_of({{"glyf", glyf},
                    {"head", head_table(whole)},
                    {"hhea", hhea},
                    {"hmtx", hmtx},
                    {"loca", loca},
                    {"maxp", maxp}});
}

}  // namespace stipple::plot
