// SPDX-License-Identifier: MIT
//
// A glyph is written as a path: M begins a stroke, L goes straight on, Q goes through a quarter of
// an ellipse whose tangents meet at its first point.
#include "plot/letters.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

namespace stipple {
namespace {

struct Glyph {
    char32_t letter;
    int advance;  ///< thousandths of an em
    const char* path;
};

constexpr std::array glyphs = {
    Glyph{U' ', 278, ""},
    Glyph{U'!', 278, "M3.9 19L3.9 6.5M3.9 1.2L3.9 1.8"},
    Glyph{U'"', 355, "M3.2 19L3.2 14M6.8 19L6.8 14"},
    Glyph{U'#', 556, "M5.6 1L7.4 19M9.6 1L11.4 19M2 7L13.2 7M2.4 13L13.6 13"},
    Glyph{U'$', 556,
          "M12.8 14Q12.4 17.6 7.8 17.6Q3 17.6 3 14Q3 11 7.8 10Q13.2 9 13.2 6Q13.2 2.4 7.8 2.4"
          "Q2.6 2.4 2.2 6M7.8 20L7.8 0"},
    Glyph{U'%', 889,
          "M6.6 19Q10.6 19 10.6 14.8Q10.6 10.6 6.6 10.6Q2.6 10.6 2.6 14.8Q2.6 19 6.6 19"
          "M18.3 9.4Q22.3 9.4 22.3 5.2Q22.3 1 18.3 1Q14.3 1 14.3 5.2Q14.3 9.4 18.3 9.4"
          "M7.4 1L17.4 19"},
    Glyph{U'&', 667,
          "M17 1L6.2 14.2Q4.6 19 8.4 19Q12 19 11.8 15.6Q11.6 13 7.6 11Q2 8.4 2 5.4Q2 1 7 1"
          "Q13 1 15.2 9"},
    Glyph{U'\'', 191, "M2.7 19L2.7 14"},
    Glyph{U'(', 333, "M7.4 20Q2.6 14.5 2.6 7.5Q2.6 0.5 7.4 -5"},
    Glyph{U')', 333, "M1.9 20Q6.7 14.5 6.7 7.5Q6.7 0.5 1.9 -5"},
    Glyph{U'*', 389, "M5.4 19.4L5.4 12.4M2.4 17.6L8.4 14.2M8.4 17.6L2.4 14.2"},
    Glyph{U'+', 584, "M8.2 2L8.2 14M2.2 8L14.2 8"},
    Glyph{U',', 278, "M4.2 1.6L4 0Q3.8 -1.8 2.6 -2.6"},
    Glyph{U'-', 333, "M1.8 7.4L7.5 7.4"},
    Glyph{U'.', 278, "M3.9 1.2L3.9 1.6"},
    Glyph{U'/', 278, "M0.6 0L7.2 20"},
    Glyph{U'0', 556,
          "M7.8 19Q13.4 19 13.4 12L13.4 8Q13.4 1 7.8 1Q2.2 1 2.2 8L2.2 12Q2.2 19 7.8 19"},
    Glyph{U'1', 556, "M3.4 15.4Q7.4 15.6 8.6 19L8.6 1"},
    Glyph{U'2', 556, "M2.4 14Q2.4 19 7.8 19Q13.2 19 13.2 14Q13.2 10.5 8.5 7.5Q2.2 4 2.2 1L13.4 1"},
    Glyph{U'3', 556,
          "M2.4 15Q2.8 19 7.6 19Q12.8 19 12.8 14.6Q12.8 10.6 7.6 10.6L6.2 10.6"
          "M7.6 10.6Q13.4 10.6 13.4 5.8Q13.4 1 7.8 1Q2.4 1 2.2 5.4"},
    Glyph{U'4', 556, "M10.6 1L10.6 19L1.8 6L13.8 6"},
    Glyph{U'5', 556,
          "M12.6 19L4.4 19L3.2 10.2Q5 12.6 8 12.6Q13.4 12.6 13.4 6.8Q13.4 1 7.6 1Q2.8 1 2.2 5"},
    Glyph{U'6', 556,
          "M13 15.4Q12.4 19 8.2 19Q2.2 19 2.2 9.5L2.2 7Q2.2 1 7.9 1Q13.5 1 13.5 6.8"
          "Q13.5 12.4 8 12.4Q3.2 12.4 2.2 8"},
    Glyph{U'7', 556, "M2.2 19L13.4 19Q7.4 11 6 1"},
    Glyph{U'8', 556,
          "M7.8 10.6Q2.8 10.6 2.8 14.8Q2.8 19 7.8 19Q12.8 19 12.8 14.8Q12.8 10.6 7.8 10.6"
          "Q13.4 10.6 13.4 5.8Q13.4 1 7.8 1Q2.2 1 2.2 5.8Q2.2 10.6 7.8 10.6"},
    Glyph{U'9', 556,
          "M2.6 4.6Q3.2 1 7.4 1Q13.4 1 13.4 10.5L13.4 13Q13.4 19 7.7 19Q2.1 19 2.1 13.2"
          "Q2.1 7.6 7.6 7.6Q12.4 7.6 13.4 12"},
    Glyph{U':', 278, "M3.9 1.2L3.9 1.6M3.9 11.6L3.9 12"},
    Glyph{U';', 278, "M3.9 11.6L3.9 12M4.2 1.6L4 0Q3.8 -1.8 2.6 -2.6"},
    Glyph{U'<', 584, "M14 13L2.4 8L14 3"},
    Glyph{U'=', 584, "M2.2 10.6L14.2 10.6M2.2 5.4L14.2 5.4"},
    Glyph{U'>', 584, "M2.4 13L14 8L2.4 3"},
    Glyph{U'?', 556,
          "M2.6 14.4Q2.8 19 7.8 19Q13 19 13 14.6Q13 11.8 9.6 9.8Q7.6 8.4 7.6 5.8"
          "M7.6 1.2L7.6 1.6"},
    Glyph{U'@', 1015,
          "M18.6 12.6L17.4 6Q17 3.6 19.6 3.6Q24 4.4 24.6 10.6Q24.6 19 15 19Q4 18.6 3.6 8"
          "Q3.6 -3 14.6 -3Q18 -3 20.6 -1.4M17.9 9Q17 13 13.6 13Q9.4 12.6 9 7.6Q9 3.8 12.2 3.8"
          "Q16 3.8 17.9 9"},
    Glyph{U'A', 667, "M1.6 1L9.35 19L17.1 1M4.4 7.2L14.3 7.2"},
    Glyph{U'B', 667,
          "M3 1L3 19L10 19Q15.6 19 15.6 14.8Q15.6 10.6 10 10.6L3 10.6M10 10.6"
          "Q16.8 10.6 16.8 5.8Q16.8 1 10 1L3 1"},
    Glyph{U'C', 722, "M18 13.4Q17 19 10.6 19Q2.4 19 2.4 10Q2.4 1 10.6 1Q17.6 1 18.2 7.4"},
    Glyph{U'D', 722, "M3 1L3 19L9.6 19Q17.8 19 17.8 10Q17.8 1 9.6 1L3 1"},
    Glyph{U'E', 667, "M16.4 1L3 1L3 19L16 19M3 10.4L15 10.4"},
    Glyph{U'F', 611, "M3 1L3 19L15.6 19M3 10.4L13.6 10.4"},
    Glyph{U'G', 778,
          "M18.6 14Q17.4 19 11 19Q2.4 19 2.4 10Q2.4 1 11 1Q16.6 1 18.8 5.6L18.8 9.6L11.6 9.6"
          "M18.8 5.6L18.8 1"},
    Glyph{U'H', 722, "M3 1L3 19M17.2 1L17.2 19M3 10.4L17.2 10.4"},
    Glyph{U'I', 278, "M3.9 1L3.9 19"},
    Glyph{U'J', 500, "M11 19L11 6.4Q11 1 6.2 1Q1.6 1 1.6 6.6"},
    Glyph{U'K', 667, "M3 1L3 19M16.4 19L3 7.6M7.8 11.6L17.2 1"},
    Glyph{U'L', 556, "M3 19L3 1L14.2 1"},
    Glyph{U'M', 833, "M3 1L3 19L11.65 1L20.3 19L20.3 1"},
    Glyph{U'N', 722, "M3 1L3 19L17.2 1L17.2 19"},
    Glyph{U'O', 778, "M10.9 19Q19.4 19 19.4 10Q19.4 1 10.9 1Q2.4 1 2.4 10Q2.4 19 10.9 19"},
    Glyph{U'P', 667, "M3 1L3 19L10.4 19Q16.8 19 16.8 13.9Q16.8 8.8 10.4 8.8L3 8.8"},
    Glyph{U'Q', 778,
          "M10.9 19Q19.4 19 19.4 10Q19.4 1 10.9 1Q2.4 1 2.4 10Q2.4 19 10.9 19M12.4 5.4L19.2 0.2"},
    Glyph{U'R', 722,
          "M3 1L3 19L11 19Q17.6 19 17.6 14.4Q17.6 9.8 11 9.8L3 9.8M11 9.8Q16.6 9.8 16.8 5.6"
          "Q16.8 2.6 18 1"},
    Glyph{U'S', 667,
          "M16 14.2Q15.6 19 9.4 19Q3 19 3 14.6Q3 11.6 8 10.5L11 9.9Q16.8 8.8 16.8 5.6"
          "Q16.8 1 9.6 1Q2.4 1 2 6.4"},
    Glyph{U'T', 611, "M8.55 1L8.55 19M1.2 19L15.9 19"},
    Glyph{U'U', 722, "M3 19L3 8Q3 1 10.1 1Q17.2 1 17.2 8L17.2 19"},
    Glyph{U'V', 667, "M1.4 19L9.35 1L17.3 19"},
    Glyph{U'W', 944, "M1.2 19L7 1L13.2 19L19.4 1L25.2 19"},
    Glyph{U'X', 667, "M2 1L16.8 19M16.8 1L2 19"},
    Glyph{U'Y', 667, "M1.6 19L9.35 9L17.1 19M9.35 9L9.35 1"},
    Glyph{U'Z', 611, "M1.8 19L15.4 19L1.6 1L15.8 1"},
    Glyph{U'[', 278, "M7 20L3 20L3 -5L7 -5"},
    Glyph{U'\\', 278, "M0.6 20L7.2 0"},
    Glyph{U']', 278, "M0.8 20L4.8 20L4.8 -5L0.8 -5"},
    Glyph{U'^', 469, "M2 10L6.5 19L11 10"},
    Glyph{U'_', 556, "M0 -3L15.6 -3"},
    Glyph{U'`', 333, "M2.4 19L5.4 15.6"},
    Glyph{U'a', 556,
          "M2.8 10.4Q3.2 13.5 7.4 13.5Q12 13.5 12 9.8L12 4Q12 1 14.2 1.2"
          "M12 8.8Q11.6 7.8 7.4 7.4Q2 6.8 2 4.2Q2 1 6 1Q11 1 12 5.6"},
    Glyph{U'b', 556,
          "M2.6 1L2.6 19M2.6 7.2Q2.6 13.5 8 13.5Q13.4 13.5 13.4 7.2Q13.4 1 8 1Q2.6 1 2.6 7.2"},
    Glyph{U'c', 500, "M12.4 9.6Q11.8 13.5 7.3 13.5Q2 13.5 2 7.2Q2 1 7.3 1Q11.9 1 12.5 5"},
    Glyph{U'd', 556,
          "M12.9 1L12.9 19M12.9 7.2Q12.9 13.5 7.5 13.5Q2.1 13.5 2.1 7.2Q2.1 1 7.5 1"
          "Q12.9 1 12.9 7.2"},
    Glyph{U'e', 556,
          "M2.1 7.6L13.4 7.6Q13.4 13.5 7.8 13.5Q2.1 13.5 2.1 7.2Q2.1 1 7.8 1Q12 1 13.1 4.4"},
    Glyph{U'f', 278, "M7.3 18.9Q3.6 19.4 3.6 15.6L3.6 1M0.8 13.3L7 13.3"},
    Glyph{U'g', 556,
          "M12.9 13.5L12.9 0Q12.9 -5 7.4 -5Q3 -5 2.4 -2M12.9 7.2Q12.9 13.5 7.5 13.5"
          "Q2.1 13.5 2.1 7.2Q2.1 1 7.5 1Q12.9 1 12.9 7.2"},
    Glyph{U'h', 556, "M2.6 1L2.6 19M2.6 8Q2.6 13.5 7.8 13.5Q12.8 13.5 12.8 8.8L12.8 1"},
    Glyph{U'i', 222, "M3.1 1L3.1 13.5M3.1 18.2L3.1 18.8"},
    Glyph{U'j', 222, "M3.1 13.5L3.1 -2Q3.1 -5 0.4 -4.9M3.1 18.2L3.1 18.8"},
    Glyph{U'k', 500, "M2.6 1L2.6 19M12 13.5L2.6 5M6 8.2L12.9 1"},
    Glyph{U'l', 222, "M3.1 1L3.1 19"},
    Glyph{U'm', 833,
          "M2.6 1L2.6 13.5M2.6 8.6Q2.6 13.5 7.2 13.5Q11.6 13.5 11.6 9L11.6 1"
          "M11.6 8.6Q11.6 13.5 16.2 13.5Q20.7 13.5 20.7 9L20.7 1"},
    Glyph{U'n', 556, "M2.6 1L2.6 13.5M2.6 8Q2.6 13.5 7.8 13.5Q12.8 13.5 12.8 8.8L12.8 1"},
    Glyph{U'o', 556, "M7.8 13.5Q13.5 13.5 13.5 7.2Q13.5 1 7.8 1Q2 1 2 7.2Q2 13.5 7.8 13.5"},
    Glyph{U'p', 556,
          "M2.6 -5L2.6 13.5M2.6 7.2Q2.6 13.5 8 13.5Q13.4 13.5 13.4 7.2Q13.4 1 8 1"
          "Q2.6 1 2.6 7.2"},
    Glyph{U'q', 556,
          "M12.9 -5L12.9 13.5M12.9 7.2Q12.9 13.5 7.5 13.5Q2.1 13.5 2.1 7.2Q2.1 1 7.5 1"
          "Q12.9 1 12.9 7.2"},
    Glyph{U'r', 333, "M2.6 1L2.6 13.5M2.6 8Q2.8 13.3 8.6 13.2"},
    Glyph{U's', 500,
          "M11.6 10.4Q11.2 13.5 6.9 13.5Q2.4 13.5 2.4 10.4Q2.4 8.2 6.9 7.4Q12.2 6.5 12.2 4.2"
          "Q12.2 1 7.2 1Q2 1 1.8 4.6"},
    Glyph{U't', 278, "M3.6 17.4L3.6 4Q3.6 1 7 1.2M0.8 13.3L6.9 13.3"},
    Glyph{U'u', 556, "M12.8 13.5L12.8 1M12.8 6.5Q12.8 1 7.6 1Q2.6 1 2.6 5.7L2.6 13.5"},
    Glyph{U'v', 500, "M1.4 13.5L7 1L12.6 13.5"},
    Glyph{U'w', 722, "M1.2 13.5L5.6 1L10.1 13.5L14.6 1L19 13.5"},
    Glyph{U'x', 500, "M1.8 1L12.2 13.5M12.2 1L1.8 13.5"},
    Glyph{U'y', 500, "M1.4 13.5L7 1M12.6 13.5L6.4 -2.4Q5.4 -5.2 1.8 -4.8"},
    Glyph{U'z', 500, "M2 13.3L12 13.3L1.8 1.1L12.3 1.1"},
    Glyph{U'{', 334,
          "M7.4 20Q4.6 20 4.6 17L4.6 11Q4.6 7.6 2 7.5Q4.6 7.4 4.6 4L4.6 -2Q4.6 -5 7.4 -5"},
    Glyph{U'|', 260, "M3.6 20L3.6 -5"},
    Glyph{U'}', 334, "M2 20Q4.8 20 4.8 17L4.8 11Q4.8 7.6 7.4 7.5Q4.8 7.4 4.8 4L4.8 -2Q4.8 -5 2 -5"},
    Glyph{U'~', 584, "M2.4 6.4Q3 9.8 5.6 9.8Q7.2 9.8 8.2 8Q9.2 6.2 10.9 6.2Q13.4 6.2 14 9.6"},
    Glyph{U'°', 400,
          "M5.6 19.4Q8.4 19.4 8.4 16.6Q8.4 13.8 5.6 13.8Q2.8 13.8 2.8 16.6"
          "Q2.8 19.4 5.6 19.4"},
    Glyph{U'±', 584, "M8.2 5L8.2 15M2.2 10L14.2 10M2.2 1.6L14.2 1.6"},
    Glyph{U'·', 278, "M3.9 7.6L3.9 8"},
    Glyph{U'×', 584, "M3.4 3.2L13 12.8M13 3.2L3.4 12.8"},
    Glyph{U'Δ', 612, "M1.6 1L8.6 19L15.6 1L1.6 1"},
    Glyph{U'–', 556, "M0.4 7.4L15.2 7.4"},
    Glyph{U'…', 1000, "M4.7 1.2L4.7 1.6M14 1.2L14 1.6M23.3 1.2L23.3 1.6"},
    Glyph{U'−', 584, "M2.2 8L14.2 8"},
    Glyph{U'√', 549, "M1 9L3.4 10.2L7 1L12.6 20.6L15.4 20.6"},
    Glyph{U'∞', 713,
          "M10 7.5Q13 12 15.5 12Q18.4 12 18.4 7.5Q18.4 3 15.5 3Q13 3 10 7.5Q7 12 4.5 12"
          "Q1.6 12 1.6 7.5Q1.6 3 4.5 3Q7 3 10 7.5"},
};

constexpr Glyph unknown{U'\uFFFD', 556, "M2 1L13.6 1L13.6 19L2 19L2 1"};

/// Raised letters are small ones, higher up.
constexpr double raised_size = 0.6;
constexpr double raised_by = 8.5;

constexpr std::u32string_view raised_letters = U"⁰¹²³⁴⁵⁶⁷⁸⁹⁻";
constexpr std::u32string_view plain_letters = U"0123456789−";

/// Letters of Latin-1 from U+00C0 on, without their accents.
constexpr std::u32string_view bare_letters =
    U"AAAAAAACEEEEIIIIDNOOOOO×OUUUUYPsaaaaaaaceeeeiiiidnooooo/ouuuuypy";

const Glyph& plain_glyph(char32_t letter) {
    if (letter >= 0xC0 && letter < 0xC0 + bare_letters.size()) letter = bare_letters[letter - 0xC0];
    const auto it = std::ranges::lower_bound(glyphs, letter, {}, &Glyph::letter);
    return it != glyphs.end() && it->letter == letter ? *it : unknown;
}

/// The plain letter of a raised one.
std::optional<char32_t> lowered(char32_t letter) {
    const auto at = raised_letters.find(letter);
    return at == std::u32string_view::npos ? std::nullopt : std::optional(plain_letters[at]);
}

/// Reads the path's numbers and draws.
class Pen {
  public:
    explicit Pen(std::string_view path) : at_(path.data()), end_(at_ + path.size()) {}

    std::vector<std::vector<Position>> draw() {
        while (at_ != end_) {
            const char command = *at_++;
            const Position spot = read_spot();
            if (command == 'M') strokes_.emplace_back();
            if (command == 'Q')
                turn(spot, read_spot());
            else
                strokes_.back().push_back(spot);
        }
        return std::move(strokes_);
    }

  private:
    double read() {
        if (*at_ == ' ') ++at_;
        double value = 0;
        at_ = std::from_chars(at_, end_, value).ptr;
        return value;
    }

    Position read_spot() {
        const double x = read();
        return {x, read()};
    }

    /// A rational curve of weight sqrt(1/2): a quarter of a circle or an ellipse where the tangents
    /// are at right angles.
    void turn(Position corner, Position end) {
        constexpr int steps = 8;
        const Position start = strokes_.back().back();
        for (int i = 1; i <= steps; ++i) {
            const double t = static_cast<double>(i) / steps;
            const double a = (1 - t) * (1 - t);
            const double b = 2 * t * (1 - t) * std::sqrt(0.5);
            const double c = t * t;
            const double sum = a + b + c;
            strokes_.back().push_back({(a * start.x + b * corner.x + c * end.x) / sum,
                                       (a * start.y + b * corner.y + c * end.y) / sum});
        }
    }

    const char* at_;
    const char* end_;
    std::vector<std::vector<Position>> strokes_;
};

/// Bytes that follow the first one of a letter in UTF-8, or nothing for what begins none.
std::optional<std::size_t> following(unsigned char first) {
    if (first < 0x80) return 0;
    if (first >= 0xC2 && first < 0xE0) return 1;
    if (first >= 0xE0 && first < 0xF0) return 2;
    if (first >= 0xF0 && first < 0xF5) return 3;
    return std::nullopt;
}

/// The letter at the front of the text and its length; U+FFFD of one byte where there is none.
std::pair<char32_t, std::size_t> first_letter(std::string_view text) {
    const auto first = static_cast<unsigned char>(text[0]);
    const auto more = following(first);
    if (more == std::size_t{0}) return {first, 1};
    if (!more || text.size() <= *more) return {U'\uFFFD', 1};
    char32_t letter = first & (0x3FU >> *more);
    for (std::size_t k = 1; k <= *more; ++k) {
        const auto byte = static_cast<unsigned char>(text[k]);
        if ((byte & 0xC0) != 0x80) return {U'\uFFFD', 1};
        letter = letter << 6 | (byte & 0x3FU);
    }
    const bool overlong = (*more == 2 && letter < 0x800) || (*more == 3 && letter < 0x10000);
    const bool none = overlong || letter > 0x10FFFF || (letter >= 0xD800 && letter < 0xE000);
    if (none) return {U'\uFFFD', 1};
    return {letter, *more + 1};
}

}  // namespace

std::u32string letters_of(std::string_view text) {
    std::u32string letters;
    while (!text.empty()) {
        const auto [letter, size] = first_letter(text);
        letters += letter;
        text.remove_prefix(size);
    }
    return letters;
}

void append_utf8(std::string& out, char32_t letter) {
    const auto put = [&out](char32_t byte) { out += static_cast<char>(byte); };
    if (letter < 0x80) {
        put(letter);
        return;
    }
    if (letter < 0x800) {
        put(0xC0 | letter >> 6);
    } else if (letter < 0x10000) {
        put(0xE0 | letter >> 12);
        put(0x80 | (letter >> 6 & 0x3F));
    } else {
        put(0xF0 | letter >> 18);
        put(0x80 | (letter >> 12 & 0x3F));
        put(0x80 | (letter >> 6 & 0x3F));
    }
    put(0x80 | (letter & 0x3F));
}

std::string clean_text(std::string_view text) {
    std::string out;
    for (const char32_t letter : letters_of(text)) {
        const bool control = letter < 0x20 || (letter >= 0x7F && letter < 0xA0);
        if (!control && letter != 0xFFFE && letter != 0xFFFF) append_utf8(out, letter);
    }
    return out;
}

double advance_of(char32_t letter) {
    const auto plain = lowered(letter);
    const double size = plain ? raised_size : 1;
    return size * em_units * plain_glyph(plain.value_or(letter)).advance / 1000;
}

std::vector<std::vector<Position>> strokes_of(char32_t letter) {
    const auto plain = lowered(letter);
    auto strokes = Pen(plain_glyph(plain.value_or(letter)).path).draw();
    if (!plain) return strokes;
    for (auto& stroke : strokes)
        for (Position& spot : stroke)
            spot = {spot.x * raised_size, spot.y * raised_size + raised_by};
    return strokes;
}

double text_width(std::string_view text, double size) {
    double units = 0;
    for (const char32_t letter : letters_of(text)) units += advance_of(letter);
    return units * size / em_units;
}

std::string shortened_to(const std::string& text, double size, double width) {
    if (text_width(text, size) <= width) return text;
    std::u32string letters = letters_of(text);
    std::string out;
    while (!letters.empty()) {
        letters.erase(0, 1);
        out = "…";
        for (const char32_t letter : letters) append_utf8(out, letter);
        if (text_width(out, size) <= width) break;
    }
    return out;
}

std::string cut_to(const std::string& text, double size, double width) {
    if (text_width(text, size) <= width) return text;
    std::u32string letters = letters_of(text);
    std::string out;
    while (!letters.empty()) {
        letters.pop_back();
        out.clear();
        for (const char32_t letter : letters) append_utf8(out, letter);
        out += "…";
        if (text_width(out, size) <= width) break;
    }
    return out;
}

}  // namespace stipple
