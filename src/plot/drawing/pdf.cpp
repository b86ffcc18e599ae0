// SPDX-License-Identifier: MIT
//
// A drawing as a PDF page. Text remains text, in embedded fonts that contain only the used glyphs,
// with a table of their characters for searching and copying.
//
// Source  ISO 32000-1:2008, Document management, Portable document format 1.7 (as far as 1.4 goes);
//         Apple, TrueType Reference Manual, chapter 6 (glyf, head, hhea, hmtx, loca, maxp).
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <map>
#include <new>
#include <numbers>

#include "core/bytes/fingerprint.hpp"
#include "core/text.hpp"
#include "plot/drawing/drawing.hpp"
#include "plot/drawing/letters.hpp"

namespace stipple::plot {
namespace {

// ---------------------------------------------------------------- fonts

// Letters as TrueType outlines. The outline of a stroke is one closed line: along its left side,
// around its end, back along the other side, and around its beginning. At left turns the outline
// passes through the centre of the pen, at right turns it follows an arc around the pen. It may
// cross itself, which the nonzero winding rule allows.

constexpr int font_em = 1000;                      ///< font units per em
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

/// Bounding box of glyphs, in font units.
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
std::string font_of(const std::vector<Table>& tables) {
    const int count = static_cast<int>(tables.size());
    std::string out;
    put_number(out, 0x00010000, 4);
    put_words(out, {count, 64, 2, 16 * count - 64});  // with the search range for 4 to 7 tables
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

/// Advance width of a letter in font units.
int font_advance(char32_t letter) {
    return static_cast<int>(std::lround(font_units * advance_of(letter)));
}

/// A TrueType font without a character map: glyph 0 is a box, glyph i > 0 is letters[i - 1]. Bold
/// fonts have a broader pen.
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
    return font_of({{"glyf", glyf},
                    {"head", head_table(whole)},
                    {"hhea", hhea},
                    {"hmtx", hmtx},
                    {"loca", loca},
                    {"maxp", maxp}});
}

// ---------------------------------------------------------------- the page

/// Compresses bytes with zlib.
std::string deflated(const std::string& bytes) {
    uLongf size = compressBound(static_cast<uLong>(bytes.size()));
    std::string out(size, '\0');
    const int done = compress2(reinterpret_cast<Bytef*>(out.data()), &size,
                               reinterpret_cast<const Bytef*>(bytes.data()),
                               static_cast<uLong>(bytes.size()), Z_DEFAULT_COMPRESSION);
    if (done != Z_OK) throw std::bad_alloc();
    out.resize(size);
    return out;
}

std::string stream_of(const std::string& keys, const std::string& bytes) {
    const std::string content = deflated(bytes);
    return fmt::format("<<{}/Filter/FlateDecode/Length {}>>\nstream\n", keys, content.size()) +
           content + "\nendstream";
}

/// A letter encoded in UTF-16, as hexadecimal digits.
std::string utf16_of(char32_t letter) {
    if (letter < 0x10000) return fmt::format("{:04X}", static_cast<std::uint32_t>(letter));
    return fmt::format("{:04X}{:04X}", 0xD800 + ((letter - 0x10000) >> 10),
                       0xDC00 + ((letter - 0x10000) & 0x3FF));
}

/// A text as a string of the PDF's information dictionary.
std::string text_string(const std::string& text) {
    std::string out = "<FEFF";
    for (const char32_t letter : code_points(text)) out += utf16_of(letter);
    return out + ">";
}

/// Letters used on a page: regular (0) and bold (1). Glyph i > 0 of a font is its letter i - 1.
using Fonts = std::array<std::u32string, 2>;

/// The table that maps glyphs to Unicode (ToUnicode CMap).
std::string unicode_map(const std::u32string& letters) {
    constexpr std::size_t most = 100;  // limit for entries in a block
    std::string map =
        "/CIDInit/ProcSet findresource begin 12 dict begin begincmap"
        "/CIDSystemInfo<</Registry(Adobe)/Ordering(UCS)/Supplement 0>>def"
        "/CMapName/Adobe-Identity-UCS def/CMapType 2 def\n"
        "1 begincodespacerange<0000><FFFF>endcodespacerange\n";
    for (std::size_t first = 0; first < letters.size(); first += most) {
        const std::size_t end = std::min(first + most, letters.size());
        map += fmt::format("{} beginbfchar\n", end - first);
        for (std::size_t i = first; i < end; ++i)
            map += fmt::format("<{:04X}><{}>\n", i + 1, utf16_of(letters[i]));
        map += "endbfchar\n";
    }
    return map + "endcmap CMapName currentdict/CMap defineresource pop end end";
}

/// Appends the objects of a font; returns the first object's number, by which the page refers to
/// the font.
std::size_t add_font(std::vector<std::string>& objects, const std::u32string& letters, bool bold) {
    const std::size_t number = objects.size() + 1;
    std::string bytes = font_file(letters, bold);
    std::uint64_t tag = fingerprint(bytes);  // names of font subsets begin with six letters
    std::string name;
    for (int k = 0; k < 6; ++k, tag /= 26) name += static_cast<char>('A' + tag % 26);
    name += bold ? "+Stipple-Bold" : "+Stipple";
    std::string widths = fmt::format("{}", font_advance(U'\uFFFD'));
    for (const char32_t letter : letters) widths += fmt::format(" {}", font_advance(letter));
    objects.push_back(
        fmt::format("<</Type/Font/Subtype/Type0/BaseFont/{}/Encoding/Identity-H/DescendantFonts[{} "
                    "0 R]/ToUnicode {} 0 R>>",
                    name, number + 1, number + 4));
    objects.push_back(
        fmt::format("<</Type/Font/Subtype/CIDFontType2/BaseFont/{}/CIDSystemInfo<</Registry(Adobe)"
                    "/Ordering(Identity)/Supplement 0>>/FontDescriptor {} 0 R/CIDToGIDMap/Identity"
                    "/W[0[{}]]>>",
                    name, number + 2, widths));
    objects.push_back(fmt::format(
        "<</Type/FontDescriptor/FontName/{}/Flags 4/FontBBox[-200 -250 1100 950]/ItalicAngle 0"
        "/Ascent 900/Descent -250/CapHeight 714/StemV {}/FontFile2 {} 0 R>>",
        name, bold ? 107 : 82, number + 3));
    objects.push_back(stream_of(fmt::format("/Length1 {}", bytes.size()), bytes));
    objects.push_back(stream_of("", unicode_map(letters)));
    return number;
}

/// Writes shapes as operators of a content stream; y is downwards.
class Content {
  public:
    void operator()(const Line& line) {
        if (line.vertices.size() < 2) return;
        stroke(line.colour, line.width);
        if (line.dash == Dash::dashed) out_ += "[6 4]0 d\n";
        if (line.dash == Dash::dotted) out_ += "[1.5 3]0 d\n";
        path(line.vertices);
        out_ += "S\n";
        if (line.dash != Dash::none) out_ += "[]0 d\n";
    }

    void operator()(const Patch& patch) {
        opacity(patch.opacity);
        fill(patch.colour);
        path(patch.vertices);
        out_ += "h f\n";
        opacity(1);
    }

    /// Draws disks as strokes of length 0 with round ends.
    void operator()(const Disks& disks) {
        opacity(disks.opacity);
        stroke(disks.colour, 2 * disks.radius);
        out_ += "1 J\n";
        for (const Position& centre : disks.centres) {
            const std::string at = place(centre);
            out_ += at + " m " + at + " l\n";
        }
        out_ += "S 0 J\n";
        opacity(1);
    }

    void operator()(const Label& label) {
        if (label.text.empty()) return;
        const double width = text_width(label.text, label.size);
        const double back = label.anchor == Anchor::start    ? 0
                            : label.anchor == Anchor::middle ? width / 2
                                                             : width;
        const Position at = label.upward ? Position{label.at.x, label.at.y + back}
                                         : Position{label.at.x - back, label.at.y};
        std::u32string& letters = fonts_[label.bold ? 1 : 0];
        std::string glyphs;
        for (const char32_t letter : code_points(label.text)) {
            const std::size_t known = std::min(letters.find(letter), letters.size());
            if (known == letters.size()) letters += letter;
            glyphs += fmt::format("{:04X}", known + 1);
        }
        fill(label.colour);
        out_ += fmt::format("BT /F{} {} Tf {} {} Tm <{}> Tj ET\n", label.bold ? 2 : 1,
                            short_number(label.size), label.upward ? "0 -1 -1 0" : "1 0 0 -1",
                            place(at), glyphs);
    }

    void operator()(const PixelImage& image) {
        std::string pixels;
        for (const Colour c : image.pixels)
            for (const std::uint8_t part : {c.red, c.green, c.blue})
                pixels += static_cast<char>(part);
        images_.push_back(stream_of(
            fmt::format("/Type/XObject/Subtype/Image/Width {}/Height {}/ColorSpace/DeviceRGB"
                        "/BitsPerComponent 8",
                        image.columns, image.rows),
            pixels));
        const Area& a = image.area;
        out_ += fmt::format("q {} 0 0 {} {} {} cm /I{} Do Q\n", short_number(a.width),
                            short_number(-a.height), short_number(a.left), short_number(a.bottom()),
                            images_.size());
    }

    void operator()(const ClipWindow& window) {
        if (clipped_) out_ += "Q\n";
        clipped_ = !window.open;
        if (!clipped_) return;
        const Area& a = window.area;
        out_ += fmt::format("q {} {} {} {} re W n\n", short_number(a.left), short_number(a.top),
                            short_number(a.width), short_number(a.height));
    }

    void operator()(const SvgGroup&) {}

    std::string take() {
        if (clipped_) out_ += "Q\n";
        return std::move(out_);
    }
    [[nodiscard]] const std::vector<std::string>& images() const { return images_; }
    [[nodiscard]] const Fonts& fonts() const { return fonts_; }
    /// Opacities of graphics states, by the states' names.
    [[nodiscard]] const std::map<std::string, std::string>& opacities() const { return opacities_; }

  private:
    static std::string colour(Colour c) {
        return fmt::format("{:.3g} {:.3g} {:.3g}", c.red / 255.0, c.green / 255.0, c.blue / 255.0);
    }
    static std::string place(const Position& at) {
        return short_number(at.x) + " " + short_number(at.y);
    }
    void fill(Colour c) { out_ += colour(c) + " rg\n"; }
    void stroke(Colour c, double width) {
        out_ += fmt::format("{} RG {} w 1 j\n", colour(c), short_number(width));
    }

    void opacity(double value) {
        const std::string name = fmt::format("G{:.0f}", 100 * value);
        if (name == opacity_) return;
        opacities_[name] = short_number(value);
        opacity_ = name;
        out_ += fmt::format("/{} gs\n", name);
    }

    void path(const std::vector<Position>& vertices) {
        for (const Position& vertex : vertices)
            out_ += place(vertex) + (&vertex == vertices.data() ? " m\n" : " l\n");
    }

    std::string out_;
    bool clipped_ = false;
    Fonts fonts_;
    std::string opacity_ = "G100";
    std::vector<std::string> images_;
    std::map<std::string, std::string> opacities_ = {{"G100", "1"}};
};

/// A PDF file with these objects: the first must be the catalogue, the last the information
/// dictionary.
std::string file_of(const std::vector<std::string>& objects) {
    std::string out = "%PDF-1.4\n%\xE2\xE3\xCF\xD3\n";
    std::string places = "0000000000 65535 f \n";
    for (std::size_t i = 0; i < objects.size(); ++i) {
        places += fmt::format("{:010} 00000 n \n", out.size());
        out += fmt::format("{} 0 obj\n", i + 1) + objects[i] + "\nendobj\n";
    }
    const std::size_t table = out.size();
    const std::size_t count = objects.size() + 1;
    return out + fmt::format(
                     "xref\n0 {}\n{}trailer\n<</Size {}/Root 1 0 R/Info {} 0 R>>\n"
                     "startxref\n{}\n%%EOF\n",
                     count, places, count, objects.size(), table);
}

}  // namespace

std::string pdf_bytes(const Drawing& drawing, double scale, const PictureNotes& notes) {
    Content content;
    Drawing ground;
    ground.rectangle({0, 0, drawing.width, drawing.height}, drawing.background);
    content(std::get<Patch>(ground.shapes[0]));
    for (const Shape& shape : drawing.shapes) std::visit(content, shape);
    const double points = 0.75 * scale;
    const std::string page = fmt::format("{0} 0 0 -{0} 0 {1} cm\n", short_number(points),
                                         short_number(points * drawing.height)) +
                             content.take();
    std::vector<std::string> objects(4);
    objects[0] = "<</Type/Catalog/Pages 2 0 R>>";
    objects[1] = "<</Type/Pages/Kids[3 0 R]/Count 1>>";
    objects[3] = stream_of("", page);
    std::string fonts;
    for (std::size_t bold = 0; bold < 2; ++bold)
        if (const std::u32string& letters = content.fonts()[bold]; !letters.empty())
            fonts += fmt::format("/F{} {} 0 R", bold + 1, add_font(objects, letters, bold == 1));
    std::string images;
    for (const std::string& image : content.images()) {
        objects.push_back(image);
        images += fmt::format("/I{} {} 0 R", &image - content.images().data() + 1, objects.size());
    }
    std::string states;
    for (const auto& [name, value] : content.opacities())
        states += fmt::format("/{}<</ca {}/CA {}>>", name, value, value);
    objects[2] = fmt::format(
        "<</Type/Page/Parent 2 0 R/MediaBox[0 0 {} {}]/Contents 4 0 R/Resources<</Font<<{}>>"
        "/XObject<<{}>>/ExtGState<<{}>>>>>>",
        short_number(points * drawing.width), short_number(points * drawing.height), fonts, images,
        states);
    std::string information = "/Title" + text_string(drawing.title);
    for (const auto& [keyword, text] : notes)
        information +=
            fmt::format("/{}{}", keyword == "Software" ? "Producer" : keyword, text_string(text));
    objects.push_back("<<" + information + ">>");
    return file_of(objects);
}

std::string pdf_note(std::string_view pdf, const std::string& keyword) {
    const std::string begin = fmt::format("/{}<FEFF", keyword);
    const auto at = pdf.rfind(begin);
    if (at == pdf.npos) return {};
    std::u32string letters;
    for (pdf.remove_prefix(at + begin.size()); pdf.size() >= 4; pdf.remove_prefix(4)) {
        std::uint32_t unit = 0;
        if (std::from_chars(pdf.data(), pdf.data() + 4, unit, 16).ptr != pdf.data() + 4) break;
        const bool second = unit >> 10 == 0x37 && !letters.empty() && letters.back() >> 10 == 0x36;
        if (second)
            letters.back() = 0x10000 + ((letters.back() & 0x3FF) << 10) + (unit & 0x3FF);
        else
            letters += unit;
    }
    return utf8_of(letters);
}

}  // namespace stipple::plot
