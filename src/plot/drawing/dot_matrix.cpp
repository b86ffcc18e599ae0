// SPDX-License-Identifier: MIT
#include "plot/drawing/dot_matrix.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/text.hpp"
#include "plot/drawing/panel.hpp"

namespace stipple::plot {
DotMatrix::DotMatrix(std::size_t columns, std::size_t rows)
    : columns_(std::max<std::size_t>(columns, 1)),
      rows_(std::max<std::size_t>(rows, 1)),
      letters_(columns_ * rows_),
      pens_(columns_ * rows_) {}

void DotMatrix::set(double right, double up) {
    const auto x = cell_at(right, width());
    const auto row = cell_at(up, height());
    if (!x || !row) return;
    const std::size_t y = height() - 1 - *row;
    constexpr std::array<std::array<unsigned char, 2>, 4> bits = {
        {{0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}}};
    unsigned char& letter = letters_[y / 4 * columns_ + *x / 2];
    letter = static_cast<unsigned char>(letter | bits[y % 4][*x % 2]);
    pens_[y / 4 * columns_ + *x / 2] = static_cast<unsigned char>(pen_);
}

void DotMatrix::draw(double right0, double up0, double right1, double up1) {
    const double dots = std::max(std::abs(right1 - right0) * static_cast<double>(width()),
                                 std::abs(up1 - up0) * static_cast<double>(height()));
    const double steps = std::clamp(std::ceil(dots), 1.0, 1e4);
    set(right0, up0);
    for (double k = 0.5; k < steps; ++k)  // the middles of steps, as their ends may be on edges
        set(right0 + (right1 - right0) * k / steps, up0 + (up1 - up0) * k / steps);
    set(right1, up1);
}

std::string DotMatrix::row(std::size_t row, bool coloured) const {
    std::string text;
    for (std::size_t i = row * columns_; i < (row + 1) * columns_;) {
        const unsigned char pen = pens_[i];
        std::string part;
        for (const std::size_t end = (row + 1) * columns_; i < end && pens_[i] == pen; ++i)
            append_utf8(part, 0x2800U + letters_[i]);
        text += in_colour(part, pen, coloured);
    }
    return text;
}

std::string in_colour(const std::string& text, std::size_t pen, bool coloured) {
    constexpr std::array codes = {36, 33, 32, 35, 34, 31};  // terminal colours, ordered by contrast
    return coloured ? fmt::format("\x1b[{}m{}\x1b[0m", codes[pen % codes.size()], text) : text;
}

std::size_t shown_width(std::string_view line) {
    std::size_t width = code_points(line).size();
    for (auto code = line.find('\x1b'); code != std::string_view::npos;
         code = line.find('\x1b', code + 1))
        width -= std::min(line.find('m', code), line.size() - 1) + 1 - code;
    return width;
}

std::string framed(const DotMatrix& dots, const TextFrame& frame) {
    const std::size_t columns = dots.width() / 2;
    const std::size_t rows = dots.height() / 4;
    const auto length = [](const std::string& text) { return code_points(text).size(); };
    const std::size_t side = std::max(length(frame.low_y), length(frame.high_y));
    std::string text;
    if (!frame.name_y.empty()) text += fmt::format("{:{}} {}\n", "", side, frame.name_y);
    text += fmt::format("{:{}} ┌{:─<{}}┐\n", "", side, "", columns);
    for (std::size_t i = 0; i < rows; ++i) {
        const std::string& label = i == 0 ? frame.high_y : i + 1 == rows ? frame.low_y : "";
        text += fmt::format("{:>{}} │{}│{}\n", label, side, dots.row(i, frame.coloured),
                            i < frame.beside.size() ? frame.beside[i] : "");
    }
    text += fmt::format("{:{}} └{:─<{}}┘\n", "", side, "", columns);
    if (frame.name_x.empty() && frame.low_x.empty()) return text;
    const std::size_t taken = length(frame.low_x) + length(frame.high_x) + length(frame.name_x);
    const std::size_t room = columns + 2 > taken ? columns + 2 - taken : 2;
    return text + fmt::format("{:{}} {}{:{}}{}{:{}}{}\n", "", side, frame.low_x, "", room / 2,
                              frame.name_x, "", room - room / 2, frame.high_x);
}

}  // namespace stipple::plot
