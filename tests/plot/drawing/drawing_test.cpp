// SPDX-License-Identifier: MIT
//
// Drawings as SVG and as pixels, their letters, and the numbers on axes.
#include "plot/drawing/drawing.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <regex>

#include "core/error.hpp"
#include "core/rng.hpp"
#include "media/png_picture.hpp"
#include "plot/drawing/html_text.hpp"
#include "plot/drawing/letters.hpp"
#include "plot/drawing/panel.hpp"
#include "plot/drawing/ticks.hpp"

namespace stipple::testing::drawing_test {

using namespace plot;

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

namespace {

constexpr Colour black{0, 0, 0};
constexpr Colour white{255, 255, 255};

Drawing page(double width, double height) {
    return {.width = width, .height = height, .background = white, .title = "a <b> & c"};
}

PngPicture pixels(const Drawing& drawing, double scale = 1) {
    return read_png(png_bytes_of(drawing, scale), "test", {});
}

double grey_at(const PngPicture& picture, std::size_t x, std::size_t y) {
    return picture.grey[y * picture.width + x];
}

/// Amount of ink, in pixels.
double ink(const PngPicture& picture) {
    double sum = 0;
    for (const double grey : picture.grey) sum += 1 - grey;
    return sum;
}

std::vector<std::string> texts(const Ticks& ticks) {
    std::vector<std::string> found;
    for (const Tick& tick : ticks.numbers) found.push_back(tick.text);
    return found;
}

}  // namespace

TEST(PngDrawing, CrispLinesAreWholePixels) {
    for (const double scale : {1.0, 2.0}) {
        Drawing drawing = page(20, 10);
        drawing.line({3, 4}, {9, 4}, black);
        const PngPicture picture = pixels(drawing, scale);
        EXPECT_EQ(picture.width, 20 * scale);
        EXPECT_EQ(ink(picture), 6 * scale * scale) << scale;
        const auto at = static_cast<std::size_t>(scale);
        EXPECT_EQ(grey_at(picture, 3 * at, 4 * at), 0);
        EXPECT_EQ(grey_at(picture, 2 * at, 4 * at), 1);
    }
}

TEST(PngDrawing, ShapesCoverTheirArea) {
    Drawing disk = page(60, 60);
    disk.add(Disks{.centres = {{30.3, 29.8}}, .radius = 20, .colour = black});
    EXPECT_NEAR(ink(pixels(disk)), 400 * 3.14159265, 4);

    Drawing patch = page(60, 60);
    patch.add(Patch{.vertices = {{10, 10}, {50.5, 10}, {10, 40}}, .colour = black});
    EXPECT_NEAR(ink(pixels(patch)), 40.5 * 30 / 2, 2);
    patch = page(60, 60);
    patch.add(Patch{.vertices = {{10, 10}, {50.5, 10}, {10, 40}}, .colour = black, .opacity = 0.5});
    EXPECT_NEAR(ink(pixels(patch)), 40.5 * 30 / 4, 3);

    Drawing line = page(60, 60);
    line.add(Line{.vertices = {{10, 10}, {50, 40}}, .colour = black, .width = 4});
    EXPECT_NEAR(ink(pixels(line)), 50 * 4 + 4 * 3.14159265, 3);  // with two half disks
    line = page(60, 60);
    line.add(
        Line{.vertices = {{0, 30}, {60, 30}}, .colour = black, .width = 2, .dash = Dash::dashed});
    EXPECT_NEAR(ink(pixels(line)), 60 * 2 * 0.6, 10);
}

TEST(PngDrawing, NothingIsDrawnOutsideOfAWindow) {
    Drawing drawing = page(40, 40);
    drawing.add(ClipWindow{.area = {10, 10, 5, 5}});
    drawing.rectangle({0, 0, 40, 40}, black);
    drawing.add(Disks{.centres = {{30, 30}}, .radius = 5, .colour = black});
    EXPECT_EQ(ink(pixels(drawing)), 25);
    drawing.add(ClipWindow{.area = {}, .open = true});
    drawing.rectangle({30, 30, 2, 2}, black);
    EXPECT_EQ(ink(pixels(drawing)), 29);
}

// Shapes outside the picture, however far, have no effect.
TEST(PngDrawing, TakesShapesOutsideOfThePicture) {
    Drawing drawing = page(10, 10);
    drawing.add(Line{.vertices = {{-1e12, 5}, {1e12, 5}}, .colour = black, .width = 2});
    drawing.add(Disks{.centres = {{1e300, -1e300}}, .radius = 3, .colour = black});
    drawing.add(Patch{.vertices = {{-1e9, -1e9}, {-1e9, -5}, {-5, -5}}, .colour = black});
    drawing.add(Label{.text = "far", .at = {-500, 700}, .colour = black});
    EXPECT_LT(ink(pixels(drawing)), 25);
}

TEST(PngDrawing, RastersAreSharpWhenLargerAndMeansWhenSmaller) {
    Drawing drawing = page(8, 8);
    drawing.add(PixelImage{
        .area = {0, 0, 8, 8}, .columns = 2, .rows = 2, .pixels = {black, white, white, black}});
    const PngPicture picture = pixels(drawing);
    EXPECT_EQ(ink(picture), 32);
    EXPECT_EQ(grey_at(picture, 3, 3), 0);
    EXPECT_EQ(grey_at(picture, 4, 3), 1);

    drawing = page(1, 1);
    drawing.add(PixelImage{
        .area = {0, 0, 1, 1}, .columns = 2, .rows = 2, .pixels = {black, white, white, white}});
    EXPECT_NEAR(pixels(drawing).grey[0], 191 / 255.0, 1e-9);
}

TEST(PngDrawing, IsTheSameEveryTimeAndSaysWhatItIs) {
    Drawing drawing = page(30, 20);
    drawing.add(Label{.text = "x", .at = {5, 15}, .colour = black});
    const std::string bytes = png_bytes_of(drawing, 2, {{"stipple", "{\"n\":1}"}});
    EXPECT_EQ(bytes, png_bytes_of(drawing, 2, {{"stipple", "{\"n\":1}"}}));
    EXPECT_THAT(bytes, HasSubstr("iTXt"));
    EXPECT_THAT(bytes, HasSubstr("{\"n\":1}"));
    EXPECT_THAT(bytes, HasSubstr("a <b> & c"));
}

TEST(SvgDrawing, TextIsTextAndEscaped) {
    Drawing drawing = page(30, 20);
    drawing.add(Label{.text = "a<b & \"c\" \xFF\x01 10⁻³", .at = {5, 15}, .colour = black});
    const std::string svg = svg_bytes(drawing, 1);
    EXPECT_THAT(svg, HasSubstr(">a&lt;b &amp; \"c\" \\xff\\x01 10⁻³</text>"));
    EXPECT_THAT(svg, HasSubstr("<title>a &lt;b&gt; &amp; c</title>"));
    EXPECT_TRUE(svg.starts_with("<?xml"));
    EXPECT_TRUE(svg_element(drawing, drawing, "a \"b\"").starts_with("<svg"));
    EXPECT_THAT(svg_element(drawing, drawing, "a \"b\""),
                HasSubstr("aria-label=\"a &quot;b&quot;\""));
}

TEST(SvgDrawing, HairlinesRunAlongTheMiddleOfPixels) {
    Drawing drawing = page(30, 20);
    drawing.line({3, 4}, {9.7, 4.9}, black);
    EXPECT_THAT(svg_bytes(drawing, 1), HasSubstr("M3.5 4.5L9.5 4.5"));
}

// ---------------------------------------------------------------- letters

TEST(Letters, EveryPrintableLetterHasStrokesWithinItsBox) {
    for (char32_t letter = U'!'; letter <= U'~'; ++letter) {
        const auto strokes = strokes_of(letter);
        EXPECT_FALSE(strokes.empty()) << static_cast<int>(letter);
        const bool unknown = strokes == strokes_of(U'\uFFFD');
        EXPECT_FALSE(unknown) << static_cast<int>(letter);
        for (const auto& stroke : strokes)
            for (const Position& position : stroke) {
                EXPECT_TRUE(position.x >= 0 && position.x <= advance_of(letter) + 0.1)
                    << static_cast<int>(letter) << " " << position.x;
                EXPECT_TRUE(position.y >= -6 && position.y <= 21) << static_cast<int>(letter);
            }
    }
    for (const char32_t letter : {U'⁻', U'³', U'×', U'·', U'−', U'…', U'√', U'∞', U'±'})
        EXPECT_NE(strokes_of(letter), strokes_of(U'\uFFFD')) << static_cast<int>(letter);
    EXPECT_TRUE(strokes_of(U' ').empty());
    EXPECT_EQ(strokes_of(U'æ'), strokes_of(U'a'));
    EXPECT_EQ(strokes_of(U'þ'), strokes_of(U'p'));
    EXPECT_EQ(strokes_of(U'Σ'), strokes_of(U'\uFFFD'));
}

// A quarter of a circle: the pen keeps its distance from the centre.
TEST(Letters, CurvesAreEllipses) {
    const auto strokes = strokes_of(U'o');
    for (const Position& position : strokes[0]) {
        const double x = position.x < 7.8 ? (position.x - 7.8) / 5.8 : (position.x - 7.8) / 5.7;
        const double y = position.y < 7.2 ? (position.y - 7.2) / 6.2 : (position.y - 7.2) / 6.3;
        EXPECT_NEAR(x * x + y * y, 1, 1e-9);
    }
}

// Text is broken at blanks and after signs, and anywhere in longer words; no letter is lost.
TEST(Letters, LongTextsAreWrapped) {
    EXPECT_THAT(wrapped("abc", 12, 100), ElementsAre("abc"));
    EXPECT_THAT(wrapped("", 12, 100), ElementsAre());
    const auto width_of = [](const char* text) {
        return room_of({.text = text, .at = {}, .size = 12}).width;
    };
    EXPECT_THAT(wrapped("one two three", 12, width_of("one two")), ElementsAre("one two", "three"));
    EXPECT_THAT(wrapped("outer_diameter", 12, width_of("outer_dia")),
                ElementsAre("outer_", "diameter"));
    EXPECT_THAT(wrapped("temperature", 12, width_of("temper")), ElementsAre("temper", "ature"));
    EXPECT_THAT(wrapped("slope 0.125", 12, width_of("slope 0.12")), ElementsAre("slope", "0.125"));
    EXPECT_THAT(wrapped("üü", 12, 1), ElementsAre("ü", "ü"));
    EXPECT_THAT(wrapped("a temperature gradient", 12, width_of("gradient"), false, true),
                ElementsAre("a", "temp…", "gradient"));
    EXPECT_THAT(wrapped("üü", 12, 1, false, true), ElementsAre("ü…"));
    for (double width = 1; width < 300; width += 7) {
        std::string all;
        for (const std::string& line : wrapped("a/long/path/to/points.csv", 12, width)) {
            EXPECT_TRUE(text_width(line, 12) <= width || line.size() == 1) << line;
            all += line;
        }
        EXPECT_EQ(all, "a/long/path/to/points.csv");
    }
}

// ---------------------------------------------------------------- numbers on axes

TEST(Ticks, AreOneTwoOrFiveTimesAPowerOfTen) {
    EXPECT_THAT(texts(linear_ticks(0, 1, 6)),
                ElementsAre("0.0", "0.2", "0.4", "0.6", "0.8", "1.0"));
    EXPECT_THAT(texts(linear_ticks(-1, 1, 5)), ElementsAre("−1.0", "−0.5", "0.0", "0.5", "1.0"));
    EXPECT_THAT(texts(linear_ticks(0, 23, 6)), ElementsAre("0", "5", "10", "15", "20"));
    EXPECT_THAT(texts(linear_ticks(0, 2, 9, true)), ElementsAre("0", "1", "2"));
}

TEST(Ticks, LargeAndSmallNumbersShareAPower) {
    const Ticks large = linear_ticks(0, 250000, 4);
    EXPECT_EQ(large.exponent, 5);
    EXPECT_THAT(texts(large), ElementsAre("0", "1", "2"));
    const Ticks small = linear_ticks(0, 0.003, 4);
    EXPECT_EQ(small.exponent, -3);
    EXPECT_THAT(texts(small), ElementsAre("0", "1", "2", "3"));
    EXPECT_EQ(power_of_ten(-13), "10⁻¹³");
}

TEST(Ticks, OfALogarithmicAxisArePowersOfTen) {
    EXPECT_THAT(texts(log_ticks(0.02, 300, 8)), ElementsAre("0.1", "1", "10", "100"));
    EXPECT_THAT(texts(log_ticks(1e-7, 1e-3, 8)),
                ElementsAre("10⁻⁷", "10⁻⁶", "10⁻⁵", "10⁻⁴", "10⁻³"));
    EXPECT_THAT(texts(log_ticks(1e-12, 1, 4)), ElementsAre("10⁻¹²", "10⁻⁸", "10⁻⁴", "10⁰"));
    EXPECT_THAT(texts(log_ticks(30, 1100, 8)), ElementsAre("50", "100", "200", "500", "1000"));
    EXPECT_EQ(log_ticks(1, 10, 8).minor.size() + log_ticks(1, 10, 8).numbers.size(), 10U);
    EXPECT_GE(log_ticks(5.1, 5.9, 8).numbers.size(), 2U);
}

// In these ranges, no step of 1, 2 or 5 gives between two and the requested number of ticks.
TEST(Ticks, AreTwoAtLeast) {
    EXPECT_THAT(texts(linear_ticks(-4.5, 4.1, 4)), ElementsAre("−4", "0", "4"));
    EXPECT_THAT(texts(linear_ticks(1.5, 6.5, 2)), ElementsAre("2", "6"));
    EXPECT_THAT(texts(linear_ticks(-4.9, 0.1, 2)), ElementsAre("−4", "0"));
    EXPECT_THAT(texts(log_ticks(0.9e-5, 1.1e-3, 2)), ElementsAre("10⁻⁵", "10⁻³"));
    EXPECT_THAT(texts(linear_ticks(0.5, 1.5, 9, true)), ElementsAre("1"));
}

TEST(Ticks, AreTwoToSoManyInAnyRangeAndWithinIt) {
    for (double high = 1; high < 1000; high *= 1.013)
        for (const double below : {-30.0, -1.0, -0.93, -0.11, 0.0, 0.003, 0.31, 0.9})
            for (std::size_t most = 2; most <= 11; ++most)
                for (const bool log : {false, true}) {
                    const double low = below * high;
                    if (log && low <= 0) continue;
                    const Ticks ticks =
                        log ? log_ticks(low, high, most) : linear_ticks(low, high, most);
                    const auto& all = ticks.numbers;
                    ASSERT_GE(all.size(), 2U) << low << " to " << high << ", " << most;
                    ASSERT_LE(all.size(), most) << low << " to " << high;
                    ASSERT_GE(all.front().value, low - 1e-8 * high);
                    ASSERT_LE(all.back().value, high * (1 + 1e-8));
                }
}

// For any range and size, neighbouring numbers keep their distance.
TEST(Ticks, NeverOverlap) {
    for (const double high : {1e-9, 0.0123, 1.0, 7.3, 99.9, 12345.6, 9.99e9})
        for (const double length : {60.0, 100.0, 333.0, 900.0})
            for (const bool log : {false, true}) {
                const Axis axis{.low = log ? high / 3e4 : -high, .high = high, .log = log};
                double end = -1e9;
                const Ticks ticks = axis.ticks(length, false);
                EXPECT_GE(ticks.numbers.size(), 2U);
                if (ticks.numbers.size() <= 2) continue;
                for (const Tick& tick : ticks.numbers) {
                    const double half = text_width(tick.text, number_size) / 2;
                    EXPECT_GT(axis.share(tick.value) * length - half, end)
                        << high << " " << length << " " << log;
                    end = axis.share(tick.value) * length + half;
                }
            }
}

TEST(Panel, PutsTheEndsOfItsAxesAtTheFramesCorners) {
    const Panel linear({10, 20, 100, 50}, {.low = -1, .high = 3}, {.low = 0, .high = 8});
    EXPECT_EQ(linear.at(-1, 0), (Position{10, 70}));
    EXPECT_EQ(linear.at(3, 8), (Position{110, 20}));
    EXPECT_EQ(linear.at(1, 4), (Position{60, 45}));
    const Panel log({0, 0, 100, 100}, {.low = 1, .high = 100, .log = true},
                    {.low = 0.01, .high = 1, .log = true});
    EXPECT_NEAR(log.x(10), 50, 1e-9);
    EXPECT_NEAR(log.y(0.1), 50, 1e-9);
}

// A single value, no value, zeros on a logarithmic axis: there is still an axis.
TEST(Panel, MendsAxesWithoutExtent) {
    for (const auto& [low, high] :
         {std::pair{2.0, 2.0},
          {0.0, 0.0},
          {-3.0, -3.0},
          {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()}})
        for (const bool log : {false, true}) {
            Axis axis{.low = low, .high = high, .log = log};
            axis.make_valid();
            EXPECT_LT(axis.low, axis.high);
            EXPECT_TRUE(!log || axis.low > 0);
            EXPECT_FALSE(axis.ticks(300, false).numbers.empty());
        }
}

namespace {

/// Pairs of doubles of every kind: random bits, equal, adjacent, tiny, huge, of both signs.
std::vector<std::pair<double, double>> ranges_of_every_kind() {
    constexpr double none = std::numeric_limits<double>::denorm_min();
    const double ends[] = {0, none,      1e-320, 1e-308, 1e-300,       1e-10, 0.1,  1 - 1e-13,
                           1, 1 + 1e-13, 1e5,    1e15,   1e15 + 0.125, 1e300, 1e307};
    std::vector<std::pair<double, double>> found;
    for (const double a : ends)
        for (const double b : ends)
            for (const auto& [low, high] : {std::pair{a, b}, {-a, b}, {a, -b}, {-a, -b}})
                found.emplace_back(low, high);
    const Rng rng(7, 0);
    for (std::uint64_t i = 0; found.size() < 10'000; i += 2) {
        double low = std::bit_cast<double>(rng.bits(i));
        double high = std::bit_cast<double>(rng.bits(i + 1));
        if (i % 3 == 1) high = std::nextafter(low, high);
        if (i % 3 == 2) high = low * (1 + std::exp2(-static_cast<double>(i / 6 % 60)));
        found.emplace_back(low, high);
    }
    return found;
}

/// Properties of every axis.
void expect_axis(const Axis& axis, double length, const std::string& what) {
    ASSERT_LT(axis.low, axis.high) << what;
    ASSERT_TRUE(std::isfinite(axis.high - axis.low)) << what;
    for (const bool upright : {false, true}) {
        const Ticks ticks = axis.ticks(length, upright);
        ASSERT_GE(ticks.numbers.size(), axis.whole ? 0U : 2U) << what;
        ASSERT_LE(ticks.numbers.size(), 12U) << what;
        ASSERT_LE(ticks.minor.size(), 1000U) << what;
        double last = -1;
        for (const Tick& tick : ticks.numbers) {
            ASSERT_GT(axis.share(tick.value), last) << what;
            ASSERT_THAT(tick.text, Not(::testing::ContainsRegex("nan|inf"))) << what;
            ASSERT_LT(tick.text.size(), 24U) << what;
            last = axis.share(tick.value);
            ASSERT_LE(last, 1 + 1e-6) << what;
        }
    }
}

}  // namespace

// Every pair of doubles gives an axis with few, ascending, finite numbers, or an error that
// explains why there is none.
TEST(Panel, HasAnAxisForEveryPairOfDoubles) {
    std::size_t drawn = 0;
    for (const auto& [low, high] : ranges_of_every_kind())
        for (const bool log : {false, true}) {
            Axis axis{.low = low, .high = high, .log = log};
            const std::string what = fmt::format("{} to {}, {}", low, high, log);
            if (std::isfinite(low) && std::isfinite(high) &&
                std::max(std::abs(low), std::abs(high)) > most_shown) {
                EXPECT_THROW(require_shown(low, high), Error) << what;
                continue;
            }
            axis.make_valid();
            expect_axis(axis, 300, what);
            const bool shown = low < high && flaw_of_range(low, high).empty();
            if (!log && std::isfinite(high - low) && low <= high) {
                EXPECT_EQ(axis.name.empty(), shown || !(low < high)) << what << axis.name;
                EXPECT_EQ(axis.low == low && axis.high == high, shown) << what;
            }
            if (log) {
                ASSERT_LE(binary_ticks(axis.low, axis.high, 5).numbers.size(), 5U) << what;
            }
            const Panel panel({50, 10, 300, 200}, axis, axis);
            for (const double value : {low, high, 0.0, 1e300, -1e300})
                if (std::isfinite(value)) {
                    ASSERT_LE(std::abs(panel.x(value)), 1e5) << what;
                    ASSERT_LE(std::abs(panel.y(value)), 1e5) << what;
                }
            ++drawn;
        }
    EXPECT_GT(drawn, 5000U);
}

TEST(Ticks, SayWhyARangeIsNotShown) {
    EXPECT_EQ(flaw_of_range(1, std::nextafter(1.0, 2)), "all the same to 13 digits");
    EXPECT_EQ(flaw_of_range(1e15, 1e15 + 0.125), "all the same to 13 digits");
    EXPECT_EQ(flaw_of_range(0, 5e-324), "differs by less than 1e-300");
    EXPECT_EQ(flaw_of_range(1, 1 + 1e-12), "");
    EXPECT_EQ(flaw_of_range(2, 2), "");
    EXPECT_EQ(rounded_ends(1, 1 + 1e-12),
              (std::pair<std::string, std::string>("1", "1.000000000001")));
    EXPECT_EQ(rounded_ends(-1, 2), (std::pair<std::string, std::string>("−1", "2")));
    EXPECT_EQ(rounded_ends(-0.0, 2), (std::pair<std::string, std::string>("0", "2")));
}

// Drawing a line that leaves the frame for 1e300 ends, also if it is dashed.
TEST(PngDrawing, EndsLinesThatGoFarOutside) {
    const Panel panel({10, 10, 80, 80}, {.low = 0, .high = 1}, {.low = 0, .high = 1});
    for (const Dash dash : {Dash::none, Dash::dashed, Dash::dotted}) {
        Drawing drawing = page(100, 100);
        drawing.add(
            Line{.vertices = {panel.at(0.1, 0.2), panel.at(0.9, 1e300), panel.at(-1e300, 5)},
                 .dash = dash});
        EXPECT_GT(ink(pixels(drawing)), 20);
        EXPECT_LT(svg_bytes(drawing, 1).size(), 2000U);
    }
}

TEST(HtmlText, LeavesNoLetterThatMeansSomethingElse) {
    EXPECT_EQ(html_text("a<b>&\"c\" 'd' é"), "a&lt;b&gt;&amp;&quot;c&quot; 'd' é");
    EXPECT_EQ(html_text("<script>alert(1)</script>"), "&lt;script&gt;alert(1)&lt;/script&gt;");
    EXPECT_THAT(html_text("\xff\x01"), Not(HasSubstr("\x01")));
}

// RFC 4648, section 10.
TEST(HtmlText, Base64AsPrinted) {
    EXPECT_EQ(base64(""), "");
    EXPECT_EQ(base64("f"), "Zg==");
    EXPECT_EQ(base64("fo"), "Zm8=");
    EXPECT_EQ(base64("foo"), "Zm9v");
    EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
    EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

// Accents are above their letters, small and capital; for i the accent replaces the dot.
TEST(Letters, HaveTheirAccents) {
    const auto top = [](char32_t letter) {
        double highest = 0;
        for (const auto& stroke : strokes_of(letter))
            for (const Position& position : stroke) highest = std::max(highest, position.y);
        return highest;
    };
    for (const auto& [accented, bare] :
         {std::pair{U'ü', U'u'}, {U'é', U'e'}, {U'ñ', U'n'}, {U'Å', U'A'}, {U'Ö', U'O'}}) {
        EXPECT_EQ(advance_of(accented), advance_of(bare));
        EXPECT_GT(strokes_of(accented).size(), strokes_of(bare).size());
        EXPECT_GT(top(accented), top(bare));
    }
    EXPECT_EQ(strokes_of(U'î').size(), strokes_of(U'i').size());
    EXPECT_EQ(top(U'ç'), top(U'c'));
    EXPECT_NE(advance_of(U'ß'), advance_of(U's'));
    for (const char32_t letter : std::u32string_view(U"ßµΩμ"))
        EXPECT_NE(strokes_of(letter).front().size(), strokes_of(U'\uFFFD').front().size());
}

}  // namespace stipple::testing::drawing_test
