// SPDX-License-Identifier: MIT
//
// A drawing as SVG. Text remains text, in a sans serif font of the viewer; pixels are embedded as a
// PNG picture.
//
// Source  W3C, Scalable Vector Graphics 1.1; colours of pages: CSS Color 5, light-dark().
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "io/decimal.hpp"
#include "plot/drawing/drawing.hpp"
#include "plot/drawing/html_text.hpp"

namespace stipple::plot {
namespace {

constexpr const char* font = "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif";

std::string hex(Colour c) { return fmt::format("#{:02x}{:02x}{:02x}", c.red, c.green, c.blue); }

/// Attribute such as fill="#0072b2", plus the colour on dark pages if it differs.
std::string paint(const char* property, Colour light, Colour dark) {
    std::string text = fmt::format(" {}=\"{}\"", property, hex(light));
    if (light != dark)
        text += fmt::format(" style=\"{}:light-dark({},{})\"", property, hex(light), hex(dark));
    return text;
}

/// Writes shapes in order, as elements of SVG.
class Writer {
  public:
    explicit Writer(bool page) : page_(page) {}

    void operator()(const Line& line, const Line& dark) {
        if (line.vertices.size() < 2) return;
        // Lines of odd width are sharp only along the middle of pixels.
        const bool half = line.crisp && std::lround(line.width) % 2 == 1;
        add_path(line.vertices, half);
        out_ += fmt::format("\" fill=\"none\"{} stroke-width=\"{}\"",
                            paint("stroke", line.colour, dark.colour), short_number(line.width));
        if (line.dash == Dash::dashed) out_ += " stroke-dasharray=\"6 4\"";
        if (line.dash == Dash::dotted) out_ += " stroke-dasharray=\"1.5 3\"";
        out_ +=
            line.crisp ? " shape-rendering=\"crispEdges\"/>\n" : " stroke-linejoin=\"round\"/>\n";
    }

    void operator()(const Patch& patch, const Patch& dark) {
        add_path(patch.vertices, false);
        out_ += "Z\"" + paint("fill", patch.colour, dark.colour);
        if (patch.opacity < 1)
            out_ += fmt::format(" fill-opacity=\"{}\"", short_number(patch.opacity));
        out_ += "/>\n";
    }

    void operator()(const Disks& disks, const Disks& dark) {
        if (page_) return dots(disks, dark);
        out_ += "<g" + paint("fill", disks.colour, dark.colour);
        if (disks.opacity < 1)
            out_ += fmt::format(" fill-opacity=\"{}\"", short_number(disks.opacity));
        out_ += ">\n";
        std::string close = "\" r=\"";
        io::append_number(close, disks.radius, 2);
        close += "\"/>\n";
        for (const Position& centre : disks.centres) {
            out_ += "<circle cx=\"";
            io::append_number(out_, centre.x, 2);
            out_ += "\" cy=\"";
            io::append_number(out_, centre.y, 2);
            out_ += close;
        }
        out_ += "</g>\n";
    }

    void operator()(const Label& label, const Label& dark) {
        out_ += fmt::format("<text x=\"{}\" y=\"{}\" font-size=\"{}\"{}", short_number(label.at.x),
                            short_number(label.at.y), short_number(label.size),
                            paint("fill", label.colour, dark.colour));
        if (label.anchor == Anchor::middle) out_ += " text-anchor=\"middle\"";
        if (label.anchor == Anchor::end) out_ += " text-anchor=\"end\"";
        if (label.bold) out_ += " font-weight=\"bold\"";
        if (label.upward)
            out_ += fmt::format(" transform=\"rotate(-90 {} {})\"", short_number(label.at.x),
                                short_number(label.at.y));
        out_ += fmt::format(">{}</text>\n", xml_text(label.text));
    }

    /// Embeds only the light drawing's pixels. If the dark drawing's pixels differ, the page's
    /// style sheet inverts the light pixels on dark pages.
    void operator()(const PixelImage& raster, const PixelImage& dark) {
        const Area& a = raster.area;
        const bool grey = std::ranges::all_of(
            raster.pixels, [](Colour c) { return c.red == c.green && c.green == c.blue; });
        out_ += fmt::format(
            "<image{} x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\" "
            "style=\"image-rendering:pixelated\" {}=\"data:image/png;base64,{}\"/>\n",
            raster.pixels == dark.pixels ? "" : " class=\"inverted\"", short_number(a.left),
            short_number(a.top), short_number(a.width), short_number(a.height),
            page_ ? "href" : "xlink:href", base64(png_bytes_of(raster, grey)));
    }

    void operator()(const ClipWindow& window, const ClipWindow&) {
        close(in_group_);
        close(in_window_);
        if (window.open) return;
        // The clip path is named by its area, so that equal names in different drawings mean equal
        // areas.
        const Area& a = window.area;
        const std::string name =
            fmt::format("w{}-{}-{}-{}", short_number(a.left), short_number(a.top),
                        short_number(a.width), short_number(a.height));
        out_ += fmt::format(
            "<clipPath id=\"{0}\"><rect x=\"{1}\" y=\"{2}\" width=\"{3}\" height=\"{4}\"/>"
            "</clipPath>\n<g clip-path=\"url(#{0})\">\n",
            name, short_number(a.left), short_number(a.top), short_number(a.width),
            short_number(a.height));
        in_window_ = true;
    }

    void operator()(const SvgGroup& group, const SvgGroup&) {
        close(in_group_);
        if (!page_ || group.attributes.empty()) return;
        out_ += fmt::format("<g {}>\n", group.attributes);
        in_group_ = true;
    }

    std::string take() {
        close(in_group_);
        close(in_window_);
        return std::move(out_);
    }

  private:
    void close(bool& open) {
        if (open) out_ += "</g>\n";
        open = false;
    }

    /// Begins a path. If `half`, coordinates are aligned to the middle of pixels.
    void add_path(const std::vector<Position>& vertices, bool half) {
        out_ += "<path d=\"";
        for (const auto& [x, y] : vertices)
            out_ += fmt::format("{}{} {}", &x == &vertices[0].x ? "M" : "L",
                                short_number(half ? std::floor(x) + 0.5 : x),
                                short_number(half ? std::floor(y) + 0.5 : y));
    }

    /// Draws disks as strokes of length 0 with round ends: a third of the bytes of circles.
    void dots(const Disks& disks, const Disks& dark) {
        out_ +=
            fmt::format("<path fill=\"none\" stroke-linecap=\"round\" stroke-width=\"{}\"{}",
                        short_number(2 * disks.radius), paint("stroke", disks.colour, dark.colour));
        if (disks.opacity < 1)
            out_ += fmt::format(" stroke-opacity=\"{}\"", short_number(disks.opacity));
        out_ += " d=\"";
        for (const Position& centre : disks.centres) {
            out_ += 'M';
            io::append_number(out_, centre.x, 1);
            out_ += ' ';
            io::append_number(out_, centre.y, 1);
            out_ += "h0";
        }
        out_ += "\"/>\n";
    }

    bool page_;
    std::string out_;
    bool in_window_ = false;
    bool in_group_ = false;
};

/// The background and all shapes, in light and dark colours.
std::string body_of(const Drawing& light, const Drawing& dark, bool page) {
    assert(light.shapes.size() == dark.shapes.size());
    Writer writer(page);
    for (std::size_t i = 0; i < light.shapes.size(); ++i)
        std::visit([&]<class S>(const S& shape) { writer(shape, std::get<S>(dark.shapes[i])); },
                   light.shapes[i]);
    return fmt::format("<rect width=\"{}\" height=\"{}\"{}/>\n", short_number(light.width),
                       short_number(light.height),
                       paint("fill", light.background, dark.background)) +
           writer.take();
}

}  // namespace

std::string short_number(double x) {
    std::string text = fmt::format("{:.2f}", x);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text == "-0" ? "0" : text;
}

std::string svg_element(const Drawing& light, const Drawing& dark, const std::string& label) {
    return fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n",
                       short_number(light.width), short_number(light.height), html_text(label)) +
           body_of(light, dark, true) + "</svg>\n";
}

std::string svg_bytes(const Drawing& drawing, double scale, const PictureNotes& notes) {
    std::string out = fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" "
        "width=\"{}\" height=\"{}\" viewBox=\"0 0 {} {}\" font-family=\"{}\">\n<title>{}</title>\n",
        short_number(drawing.width * scale), short_number(drawing.height * scale),
        short_number(drawing.width), short_number(drawing.height), font, xml_text(drawing.title));
    if (!notes.empty()) {
        out += "<metadata>\n";
        for (const auto& [keyword, text] : notes)
            out += fmt::format("{}: {}\n", xml_text(keyword), xml_text(text));
        out += "</metadata>\n";
    }
    return out + body_of(drawing, drawing, false) + "</svg>\n";
}

}  // namespace stipple::plot
