// SPDX-License-Identifier: MIT
//
// A drawing as SVG. Text stays text, in whatever plain sans serif the reader has; pixels are a PNG
// picture inside.
//
// Source  W3C, Scalable Vector Graphics 1.1.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "io/decimal.hpp"
#include "media/png_picture.hpp"
#include "plot/drawing.hpp"
#include "plot/html_text.hpp"
#include "plot/letters.hpp"

namespace stipple {
namespace {

constexpr const char* font = "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif";

std::string hex(Colour c) { return fmt::format("#{:02x}{:02x}{:02x}", c.red, c.green, c.blue); }

/// Hundredths of a unit are more than eyes see.
std::string number(double x) {
    std::string text = fmt::format("{:.2f}", x);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text == "-0" ? "0" : text;
}

/// Text as XML writes it between tags.
std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : clean_text(text)) {
        if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '&')
            out += "&amp;";
        else
            out += c;
    }
    return out;
}

/// Writes shapes one after the other.
class Writer {
  public:
    void operator()(const Line& line) {
        if (line.spots.size() < 2) return;
        // Lines one unit wide are sharp where they run along the middle of pixels.
        const bool half = line.crisp && std::lround(line.width) % 2 == 1;
        out_ += "<path d=\"";
        for (std::size_t i = 0; i < line.spots.size(); ++i) {
            const Spot spot = line.spots[i];
            const double x = half ? std::floor(spot.x) + 0.5 : spot.x;
            const double y = half ? std::floor(spot.y) + 0.5 : spot.y;
            out_ += fmt::format("{}{} {}", i == 0 ? "M" : "L", number(x), number(y));
        }
        out_ += fmt::format("\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"", hex(line.colour),
                            number(line.width));
        if (line.dash == Dash::dashed) out_ += " stroke-dasharray=\"6 4\"";
        if (line.dash == Dash::dotted) out_ += " stroke-dasharray=\"1.5 3\"";
        out_ +=
            line.crisp ? " shape-rendering=\"crispEdges\"/>\n" : " stroke-linejoin=\"round\"/>\n";
    }

    void operator()(const Patch& patch) {
        out_ += "<path d=\"";
        for (std::size_t i = 0; i < patch.spots.size(); ++i)
            out_ += fmt::format("{}{} {}", i == 0 ? "M" : "L", number(patch.spots[i].x),
                                number(patch.spots[i].y));
        out_ += fmt::format("Z\" fill=\"{}\"", hex(patch.colour));
        if (patch.opacity < 1) out_ += fmt::format(" fill-opacity=\"{}\"", number(patch.opacity));
        out_ += "/>\n";
    }

    void operator()(const Disks& disks) {
        out_ += fmt::format("<g fill=\"{}\"", hex(disks.colour));
        if (disks.opacity < 1) out_ += fmt::format(" fill-opacity=\"{}\"", number(disks.opacity));
        out_ += ">\n";
        std::string close = "\" r=\"";
        io::append_number(close, disks.radius, 2);
        close += "\"/>\n";
        for (const Spot& centre : disks.centres) {
            out_ += "<circle cx=\"";
            io::append_number(out_, centre.x, 2);
            out_ += "\" cy=\"";
            io::append_number(out_, centre.y, 2);
            out_ += close;
        }
        out_ += "</g>\n";
    }

    void operator()(const Label& label) {
        out_ +=
            fmt::format("<text x=\"{}\" y=\"{}\" font-size=\"{}\" fill=\"{}\"", number(label.at.x),
                        number(label.at.y), number(label.size), hex(label.colour));
        if (label.anchor == Anchor::middle) out_ += " text-anchor=\"middle\"";
        if (label.anchor == Anchor::end) out_ += " text-anchor=\"end\"";
        if (label.bold) out_ += " font-weight=\"bold\"";
        if (label.upward)
            out_ += fmt::format(" transform=\"rotate(-90 {} {})\"", number(label.at.x),
                                number(label.at.y));
        out_ += fmt::format(">{}</text>\n", escaped(label.text));
    }

    void operator()(const Raster& raster) {
        std::string bytes;
        bytes.reserve(3 * raster.pixels.size());
        for (const Colour& c : raster.pixels)
            for (const std::uint8_t part : {c.red, c.green, c.blue})
                bytes += static_cast<char>(part);
        const Area& a = raster.area;
        out_ += fmt::format(
            "<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\" "
            "style=\"image-rendering:pixelated\" "
            "xlink:href=\"data:image/png;base64,{}\"/>\n",
            number(a.left), number(a.top), number(a.width), number(a.height),
            base64(encode_png({raster.columns, raster.rows, 8, true}, bytes, {})));
    }

    void operator()(const Window& window) {
        if (in_window_) out_ += "</g>\n";
        in_window_ = !window.open;
        if (window.open) return;
        // Named by what it shows, so that drawings can stand in one page.
        const Area& a = window.area;
        const std::string name = fmt::format("w{}-{}-{}-{}", number(a.left), number(a.top),
                                             number(a.width), number(a.height));
        out_ += fmt::format(
            "<clipPath id=\"{0}\"><rect x=\"{1}\" y=\"{2}\" width=\"{3}\" height=\"{4}\"/>"
            "</clipPath>\n<g clip-path=\"url(#{0})\">\n",
            name, number(a.left), number(a.top), number(a.width), number(a.height));
    }

    std::string take() {
        if (in_window_) out_ += "</g>\n";
        in_window_ = false;
        return std::move(out_);
    }

  private:
    std::string out_;
    bool in_window_ = false;
};

}  // namespace

std::string svg_element(const Drawing& drawing, double scale, const PictureNotes& notes) {
    std::string out = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" "
        "width=\"{}\" height=\"{}\" viewBox=\"0 0 {} {}\" font-family=\"{}\">\n<title>{}</title>\n",
        number(drawing.width * scale), number(drawing.height * scale), number(drawing.width),
        number(drawing.height), font, escaped(drawing.title));
    if (!notes.empty()) {
        out += "<metadata>\n";
        for (const auto& [keyword, text] : notes)
            out += fmt::format("{}: {}\n", escaped(keyword), escaped(text));
        out += "</metadata>\n";
    }
    out += fmt::format("<rect width=\"{}\" height=\"{}\" fill=\"{}\"/>\n", number(drawing.width),
                       number(drawing.height), hex(drawing.ground));
    Writer writer;
    for (const Shape& shape : drawing.shapes) std::visit(writer, shape);
    return out + writer.take() + "</svg>\n";
}

std::string svg_bytes(const Drawing& drawing, double scale, const PictureNotes& notes) {
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + svg_element(drawing, scale, notes);
}

}  // namespace stipple
