// SPDX-License-Identifier: MIT
#include "plot/drawing/html_text.hpp"

#include <algorithm>
#include <cstdint>

#include "core/text.hpp"

namespace stipple::plot {

std::string xml_text(std::string_view text) {
    std::string out = printable(text);
    replace_all(out, "&", "&amp;");
    replace_all(out, "<", "&lt;");
    replace_all(out, ">", "&gt;");
    return out;
}

std::string html_text(std::string_view text) {
    std::string out = xml_text(text);
    replace_all(out, "\"", "&quot;");
    return out;
}

std::string base64(std::string_view bytes) {
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve(bytes.size() / 3 * 4 + 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t here = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t word = 0;
        for (std::size_t k = 0; k < 3; ++k)
            word = word << 8 | (k < here ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k)
            out += k <= here ? digits[word >> (18 - 6 * k) & 63] : '=';
    }
    return out;
}

}  // namespace stipple::plot
