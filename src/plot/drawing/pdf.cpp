// SPDX-License-Identifier: MIT
//
// A drawing as a page of PDF. Text is text, in Helvetica and Symbol, which every reader has; letters
// that these do not have are drawn as strokes.
//
// Source  ISO 32000-1:2008, Document management, Portable document format 1.7 (as far as 1.4 goes).
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <map>
#include <new>
#include <optional>

#include "core/text.hpp"
#include "plot/drawing/drawing.hpp"
#include "plot/drawing/letters.hpp"

namespace stipple::plot {
namespace {

/// Bytes as zlib makes them smaller.
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

/// A text for readers, in UTF-16.
std::string text_string(const std::string& text) {
    std::string out = "<FEFF";
    for (const char32_t letter : code_points(text))
        if (letter < 0x10000)
            out += fmt::format("{:04X}", static_cast<std::uint32_t>(letter));
        else
            out += fmt::format("{:04X}{:04X}", 0xD800 + ((letter - 0x10000) >> 10),
                               0xDC00 + ((letter - 0x10000) & 0x3FF));
    return out + ">";
}

/// Where a letter is in the encodings of the fonts.
struct Placed {
    bool symbol = false;  ///< of the font Symbol
    char byte = 0;
};

std::optional<Placed> place_of(char32_t letter) {
    struct Entry {
        char32_t letter;
        Placed placed;
    };
    constexpr auto entry = [](char32_t of, bool symbol, int byte) {
        return Entry{of, {symbol, static_cast<char>(byte)}};
    };
    static constexpr std::array known = {
        entry(U'…', false, 0x85), entry(U'–', false, 0x96), entry(U'—', false, 0x97),
        entry(U'‘', false, 0x91), entry(U'’', false, 0x92), entry(U'“', false, 0x93),
        entry(U'”', false, 0x94), entry(U'•', false, 0x95), entry(U'‑', false, '-'),
        entry(U'−', true, 0x2D),  entry(U'∞', true, 0xA5),  entry(U'√', true, 0xD6),
        entry(U'≤', true, 0xA3),  entry(U'≥', true, 0xB3),  entry(U'Δ', true, 0x44),
        entry(U'χ', true, 0x63),  entry(U'π', true, 0x70),  entry(U'σ', true, 0x73),
        entry(U'λ', true, 0x6C),  entry(U'ψ', true, 0x79)};
    if (letter >= 0x20 && letter < 0x7F) return Placed{false, static_cast<char>(letter)};
    if (letter >= 0xA0 && letter <= 0xFF) return Placed{false, static_cast<char>(letter)};
    const auto it = std::ranges::find(known, letter, &Entry::letter);
    return it == known.end() ? std::nullopt : std::optional(it->placed);
}

/// A letter of a string in brackets.
std::string escaped(char byte) {
    if (byte == '(' || byte == ')' || byte == '\\') return {'\\', byte};
    const auto code = static_cast<unsigned char>(byte);
    return code < 0x7F ? std::string(1, byte) : fmt::format("\\{:03o}", code);
}

/// Writes shapes as operators of a page's content, y downward.
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

    /// Strokes without length, whose ends are round.
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
        const double width = text_width(label.text, label.size);
        double along = label.anchor == Anchor::start    ? 0
                       : label.anchor == Anchor::middle ? -width / 2
                                                        : -width;
        fill(label.colour);
        for (const char32_t letter : code_points(label.text)) {
            if (!put(letter, label, along)) draw(letter, label, along);
            along += advance_of(letter) * label.size / em_units * (label.bold ? bold_width : 1);
        }
        end_text();
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
    /// Opacities by their names.
    [[nodiscard]] const std::map<std::string, std::string>& opacities() const { return opacities_; }

  private:
    static constexpr double bold_width = 1.05;  ///< of Helvetica-Bold over Helvetica, about

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

    /// Where a label's text is so far along its line.
    static Position moved(const Label& label, double along, double up = 0) {
        return label.upward ? Position{label.at.x - up, label.at.y - along}
                            : Position{label.at.x + along, label.at.y - up};
    }

    /// Adds a letter of a font; raised ones are small. False: the fonts do not have it.
    bool put(char32_t letter, const Label& label, double along) {
        const auto plain = lowered(letter);
        const auto found = place_of(plain.value_or(letter));
        if (!found) return false;
        const double size = plain ? raised_size * label.size : label.size;
        const std::string font = fmt::format("/F{} {}",
                                             found->symbol ? 3
                                             : label.bold  ? 2
                                                           : 1,
                                             short_number(size));
        if (font != font_ || !in_text_) {
            end_text();
            const double up = plain ? raised_by * label.size / em_units : 0;
            out_ +=
                fmt::format("BT {} Tf {} {} Tm (", font, label.upward ? "0 -1 -1 0" : "1 0 0 -1",
                            place(moved(label, along, up)));
            font_ = font;
            in_text_ = true;
        }
        out_ += escaped(found->byte);
        return true;
    }

    void end_text() {
        if (in_text_) out_ += ") Tj ET\n";
        in_text_ = false;
    }

    /// Draws a letter that the fonts do not have.
    void draw(char32_t letter, const Label& label, double along) {
        end_text();
        const double unit = label.size / em_units;
        stroke(label.colour, 2.3 * unit);
        for (const auto& line : strokes_of(letter)) {
            std::vector<Position> vertices;
            for (const Position& at : line)
                vertices.push_back(moved(label, along + at.x * unit, at.y * unit));
            path(vertices);
            out_ += "S\n";
        }
    }

    std::string out_;
    bool clipped_ = false;
    bool in_text_ = false;
    std::string font_;
    std::string opacity_ = "G100";
    std::vector<std::string> images_;
    std::map<std::string, std::string> opacities_ = {{"G100", "1"}};
};

/// A file of objects, the first of which is the catalogue and the last the information.
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
    constexpr std::size_t first_image = 8;
    std::string images;
    for (std::size_t i = 0; i < content.images().size(); ++i)
        images += fmt::format("/I{} {} 0 R", i + 1, first_image + i);
    std::string states;
    for (const auto& [name, value] : content.opacities())
        states += fmt::format("/{}<</ca {}/CA {}>>", name, value, value);
    const auto font = [](const char* name, const char* encoding) {
        return fmt::format("<</Type/Font/Subtype/Type1/BaseFont/{}{}>>", name, encoding);
    };
    constexpr const char* latin = "/Encoding/WinAnsiEncoding";
    std::vector<std::string> objects = {
        "<</Type/Catalog/Pages 2 0 R>>",
        "<</Type/Pages/Kids[3 0 R]/Count 1>>",
        fmt::format("<</Type/Page/Parent 2 0 R/MediaBox[0 0 {} {}]/Contents 4 0 R/Resources<</Font"
                    "<</F1 5 0 R/F2 6 0 R/F3 7 0 R>>/XObject<<{}>>/ExtGState<<{}>>>>>>",
                    short_number(points * drawing.width), short_number(points * drawing.height),
                    images, states),
        stream_of("", page),
        font("Helvetica", latin),
        font("Helvetica-Bold", latin),
        font("Symbol", "")};
    objects.insert(objects.end(), content.images().begin(), content.images().end());
    std::string information = "/Title" + text_string(drawing.title);
    for (const auto& [keyword, text] : notes)
        information +=
            fmt::format("/{}{}", keyword == "Software" ? "Producer" : keyword, text_string(text));
    objects.push_back("<<" + information + ">>");
    return file_of(objects);
}

}  // namespace stipple::plot
