// SPDX-License-Identifier: MIT
#include "plot/drawing/colour_bar.hpp"

#include "plot/drawing/panel.hpp"

namespace stipple::plot {

void draw_colour_bar(Drawing& drawing, const Area& area, const std::string& name,
                     const Theme& theme, const std::function<Colour(double)>& colour,
                     const std::vector<Tick>& ticks) {
    constexpr std::size_t levels = 256;
    PixelImage bar{.area = area, .columns = 1, .rows = levels};
    for (std::size_t i = 0; i < levels; ++i)
        bar.pixels.push_back(colour(1 - static_cast<double>(i) / static_cast<double>(levels - 1)));
    drawing.add(std::move(bar));
    const double right = area.right();
    const double bottom = area.bottom();
    drawing.line({area.left, area.top}, {area.left, bottom + 1}, theme.frame);
    drawing.line({right, area.top}, {right, bottom + 1}, theme.frame);
    drawing.line({area.left, area.top}, {right + 1, area.top}, theme.frame);
    drawing.line({area.left, bottom}, {right + 1, bottom}, theme.frame);
    for (const auto& [share, text] : ticks) {
        const double y = bottom - share * area.height;
        drawing.line({right, y}, {right + 4, y}, theme.frame);
        drawing.add(Label{.text = text,
                          .at = {right + 8, y + 0.36 * number_size},
                          .size = number_size,
                          .colour = theme.text});
    }
    drawing.add(Label{.text = name,
                      .at = {right, area.top - 8},
                      .size = number_size,
                      .colour = theme.ink,
                      .anchor = Anchor::middle});
}

}  // namespace stipple::plot
