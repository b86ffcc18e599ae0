// SPDX-License-Identifier: MIT
//
// Parser of glyphs.txt. Each line is a glyph: its letter, its advance in thousandths of an em, and
// a path. M begins a stroke, L draws a straight line, Q a quarter of an ellipse; the first point of
// Q is where its tangents meet.
#include "plot/drawing/letters.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/text.hpp"

namespace stipple::plot {

const char* glyph_table();  // glyphs.txt

namespace {

struct Glyph {
    char32_t letter = 0;
    int advance = 0;  ///< thousandths of an em
    std::string path = {};
};

const Glyph unknown{U'\uFFFD', 556, "M2 1L13.6 1L13.6 19L2 19L2 1"};

constexpr std::u32string_view raised_letters = U"⁰¹²³⁴⁵⁶⁷⁸⁹⁻";
constexpr std::u32string_view plain_letters = U"0123456789−";

/// Base letters of U+00C0 and the following letters of Latin-1; `accents` has their accents.
constexpr std::u32string_view bare_letters =
    U"AAAAAAACEEEEIIIIDNOOOOO×OUUUUYPßaaaaaaaceeeeiiiidnooooo/ouuuuypy";
constexpr std::string_view accents =
    "`'^~:o ,`'^:`'^: ~`'^~: /`'^:'  `'^~:o ,`'^:`'^: ~`'^~: /`'^:' :";
static_assert(accents.size() == bare_letters.size());

/// Path of an accent, centred at x = 0. Its y is relative to the top of the letter, or to the
/// baseline for ',' (below the letter) and '/' (through it).
const char* path_of(char accent) {
    switch (accent) {
        case '`':
            return "M-2.4 3.2L0.8 0";
        case '\'':
            return "M2.4 3.2L-0.8 0";
        case '^':
            return "M-3 0L0 3L3 0";
        case '~':
            return "M-3.6 0.4Q-3 2.4 -1.2 2L1.2 0.8Q3 0.4 3.6 2.4";
        case ':':
            return "M-2.6 1L-2.6 1.6M2.6 1L2.6 1.6";
        case 'o':
            return "M0 3.6Q1.9 3.6 1.9 1.7Q1.9 -0.2 0 -0.2Q-1.9 -0.2 -1.9 1.7Q-1.9 3.6 0 3.6";
        case ',':
            return "M0 1L-0.6 -1.2Q2.2 -1.4 2 -3Q1.8 -4.6 -1.8 -4.4";
        default:
            return "M-6 0L6 15";
    }
}

/// All glyphs, sorted by letter; parsed from lines such as "L 556 M3 19L3 1L14.2 1".
const std::vector<Glyph>& glyphs() {
    static const auto all = [] {
        std::vector<Glyph> found;
        for (const std::string_view line : split(glyph_table(), '\n')) {
            if (line.empty()) continue;
            const Letter letter = first_letter(line);
            std::istringstream rest{std::string(line.substr(letter.size))};
            rest.exceptions(std::ios::badbit);  // otherwise a failed allocation would be hidden
            Glyph glyph{.letter = letter.point};
            rest >> glyph.advance >> std::ws;
            std::getline(rest, glyph.path);
            found.push_back(std::move(glyph));
        }
        return found;
    }();
    return all;
}

const Glyph& plain_glyph(char32_t letter) {
    if (letter >= 0xC0 && letter < 0xC0 + bare_letters.size()) letter = bare_letters[letter - 0xC0];
    const auto it = std::ranges::lower_bound(glyphs(), letter, {}, &Glyph::letter);
    return it != glyphs().end() && it->letter == letter ? *it : unknown;
}

/// Adds a rational quadratic Bezier curve with weight sqrt(1/2): a quarter of an ellipse if the
/// tangents are perpendicular.
void add_curve(std::vector<Position>& stroke, Position corner, Position end) {
    constexpr int steps = 8;
    const Position start = stroke.back();
    for (int i = 1; i <= steps; ++i) {
        const double t = static_cast<double>(i) / steps;
        const double a = (1 - t) * (1 - t);
        const double b = 2 * t * (1 - t) * std::sqrt(0.5);
        const double c = t * t;
        const double sum = a + b + c;
        stroke.push_back({(a * start.x + b * corner.x + c * end.x) / sum,
                          (a * start.y + b * corner.y + c * end.y) / sum});
    }
}

std::vector<std::vector<Position>> strokes_in(const std::string& path) {
    std::vector<std::vector<Position>> strokes;
    std::istringstream in(path);
    in.exceptions(std::ios::badbit);
    char command = 0;
    for (Position at; in >> command >> at.x >> at.y;) {
        if (command == 'M') strokes.emplace_back();
        Position end;
        if (command == 'Q' && in >> end.x >> end.y)
            add_curve(strokes.back(), at, end);
        else
            strokes.back().push_back(at);
    }
    return strokes;
}

/// Adds the accent of a Latin-1 letter.
void add_accent(std::vector<std::vector<Position>>& strokes, char32_t letter) {
    if (letter < 0xC0 || letter >= 0xC0 + accents.size()) return;
    const char accent = accents[letter - 0xC0];
    if (accent == ' ') return;
    const bool above = accent != ',' && accent != '/';
    const bool small = letter >= 0xE0;
    if (above && small && bare_letters[letter - 0xC0] == U'i')
        strokes.resize(1);  // removes the dot of i
    const double middle = em_units * plain_glyph(letter).advance / 2000;
    const double base = !above ? 0 : small ? 16 : 21.5;
    for (auto& stroke : strokes_in(path_of(accent))) {
        for (Position& position : stroke) position = {position.x + middle, position.y + base};
        strokes.push_back(std::move(stroke));
    }
}

/// Width of most texts in DejaVu Sans relative to Helvetica.
double wider(bool bold) { return bold ? 1.3 : 1.16; }

}  // namespace

std::optional<char32_t> lowered(char32_t letter) {
    const auto at = raised_letters.find(letter);
    return at == std::u32string_view::npos ? std::nullopt : std::optional(plain_letters[at]);
}

double advance_of(char32_t letter) {
    const auto plain = lowered(letter);
    const double size = plain ? raised_size : 1;
    return size * em_units * plain_glyph(plain.value_or(letter)).advance / 1000;
}

std::vector<std::vector<Position>> strokes_of(char32_t letter) {
    const auto plain = lowered(letter);
    auto strokes = strokes_in(plain_glyph(plain.value_or(letter)).path);
    if (!plain) {
        add_accent(strokes, letter);
        return strokes;
    }
    for (auto& stroke : strokes)
        for (Position& position : stroke)
            position = {position.x * raised_size, position.y * raised_size + raised_by};
    return strokes;
}

double text_width(std::string_view text, double size) {
    double units = 0;
    for (const char32_t letter : code_points(text)) units += advance_of(letter);
    return units * size / em_units;
}

Area room_of(const Label& label) {
    const double width = text_width(label.text, label.size) * wider(label.bold);
    const double share = label.anchor == Anchor::start ? 0 : label.anchor == Anchor::end ? 1 : 0.5;
    const auto [x, y] = label.at;
    constexpr double ascent = 0.76;
    const double height = label.size;
    if (label.upward) return {x - ascent * height, y - (1 - share) * width, height, width};
    return {x - share * width, y - ascent * height, width, height};
}

std::vector<std::string> wrapped(std::string_view text, double size, double width, bool bold,
                                 bool shorten) {
    constexpr std::u32string_view breaks = U" _-/,.:;=";
    const std::u32string letters = code_points(text);
    const double room = width * em_units / (size * wider(bold));
    std::vector<std::string> lines;
    for (std::size_t first = 0; first < letters.size();) {
        double used = 0;
        std::size_t end = first;
        std::size_t good = first;  // position after the last possible break
        for (; end < letters.size(); ++end) {
            used += advance_of(letters[end]);
            if (used > room && letters[end] != U' ' && end > first) break;
            const bool point = end + 1 < letters.size() && letters[end] == U'.' &&
                               letters[end + 1] >= U'0' && letters[end + 1] <= U'9';
            if (!point && breaks.find(letters[end]) != std::u32string_view::npos) good = end + 1;
        }
        std::size_t next = end < letters.size() && good > first ? good : end;
        std::string line = utf8_of(std::u32string_view(letters).substr(first, next - first));
        if (shorten && end < letters.size() && good == first) {
            used += advance_of(U'…') - advance_of(letters[end]);
            while (next > first + 1 && used > room) used -= advance_of(letters[--next]);
            line = utf8_of(std::u32string_view(letters).substr(first, next - first)) + "…";
            next = letters.find_first_of(breaks, end);
            next = next == letters.npos ? letters.size() : next + 1;
        }
        if (const auto text_of_line = trim(line); !text_of_line.empty())
            lines.emplace_back(text_of_line);
        first = next;
    }
    return lines;
}

void add_lines(Drawing& drawing, const Label& label, const std::vector<std::string>& lines,
               double leading) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const double back = leading * static_cast<double>(lines.size() - 1 - i);
        Label line = label;
        line.text = lines[i];
        (label.upward ? line.at.x : line.at.y) -= back;
        drawing.add(std::move(line));
    }
}

}  // namespace stipple::plot
