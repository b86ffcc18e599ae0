// SPDX-License-Identifier: MIT
#include "media/png_picture.hpp"

#include <gtest/gtest.h>

#include "core/rng.hpp"
#include "support/pictures.hpp"
#include "support/units.hpp"

namespace stipple::testing::png_picture_test {
namespace {

using Samples = std::vector<std::uint16_t>;

PngPicture read(const std::string& bytes) { return read_png(bytes, "p.png", {}); }

std::string refused(const std::string& bytes) {
    ::testing::internal::CaptureStderr();
    const std::string error = error_of([&] { read(bytes); });
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
    return error;
}

}  // namespace

TEST(PngPicture, ReadsGreyOfEveryDepth) {
    for (const bool interlaced : {false, true})
        for (const int bits : {1, 2, 4, 8, 16}) {
            const auto most = static_cast<std::uint16_t>((1U << bits) - 1);
            const auto some = static_cast<std::uint16_t>(most / 3);
            const PngPicture picture = read(png_of(3, 2, {0, most, some, most, most, 0},
                                                   {.bits = bits, .interlaced = interlaced}));
            EXPECT_EQ(picture.width, 3U);
            EXPECT_EQ(picture.height, 2U);
            const double third = static_cast<double>(some) / most;
            EXPECT_EQ(picture.grey, (std::vector<double>{0, 1, third, 1, 1, 0})) << bits;
            EXPECT_TRUE(picture.opacity.empty());
        }
}

TEST(PngPicture, WeighsColoursByTheirLuminance) {
    for (const int bits : {8, 16}) {
        const auto most = static_cast<std::uint16_t>((1U << bits) - 1);
        const PngPicture picture =
            read(png_of(5, 1, {most, 0, 0, 0, most, 0, 0, 0, most, most, most, most, 77, 77, 77},
                        {.colour = PNG_COLOR_TYPE_RGB, .bits = bits}));
        const std::vector<double> expected{0.2126, 0.7152, 0.0722, 1, 77.0 / most};
        EXPECT_EQ(picture.grey, expected) << bits;
    }
}

TEST(PngPicture, ReadsPalettesAndTransparency) {
    const PngKind indexed{.colour = PNG_COLOR_TYPE_PALETTE,
                          .bits = 2,
                          .interlaced = false,
                          .palette = {{0, 0, 0}, {255, 255, 255}, {255, 0, 0}},
                          .palette_alpha = {255, 51}};
    const PngPicture picture = read(png_of(4, 1, {0, 1, 2, 1}, indexed));
    EXPECT_EQ(picture.grey, (std::vector<double>{0, 1, 0.2126, 1}));
    EXPECT_EQ(picture.opacity, (std::vector<double>{1, 0.2, 1, 0.2}));

    const PngPicture grey =
        read(png_of(2, 1, {51, 102, 255, 0}, {.colour = PNG_COLOR_TYPE_GRAY_ALPHA}));
    EXPECT_EQ(grey.grey, (std::vector<double>{0.2, 1}));
    EXPECT_EQ(grey.opacity, (std::vector<double>{0.4, 0}));

    const PngPicture colour = read(png_of(1, 2, {0, 65535, 0, 13107, 0, 0, 65535, 65535},
                                          {.colour = PNG_COLOR_TYPE_RGB_ALPHA, .bits = 16}));
    EXPECT_EQ(colour.grey, (std::vector<double>{0.7152, 0.0722}));
    EXPECT_EQ(colour.opacity, (std::vector<double>{0.2, 1}));
}

// Adam7 stores pixels in seven passes, which must not change the picture.
TEST(PngPicture, InterlacingChangesNothing) {
    Samples samples(3 * 37 * 21);
    const Rng rng(1);
    for (std::size_t i = 0; i < samples.size(); ++i)
        samples[i] = static_cast<std::uint16_t>(rng.below(i, 256));
    const PngKind plain{.colour = PNG_COLOR_TYPE_RGB};
    const PngKind woven{.colour = PNG_COLOR_TYPE_RGB, .interlaced = true};
    EXPECT_EQ(read(png_of(37, 21, samples, plain)).grey, read(png_of(37, 21, samples, woven)).grey);
}

TEST(PngPicture, RefusesEveryTruncationSilently) {
    for (const bool interlaced : {false, true}) {
        const std::string whole =
            png_of(9, 5, Samples(9 * 5 * 4, 99),
                   {.colour = PNG_COLOR_TYPE_RGB_ALPHA, .interlaced = interlaced});
        EXPECT_EQ(refused(whole), "");
        for (std::size_t size = 0; size < whole.size(); ++size) {
            const std::string error = refused(whole.substr(0, size));
            EXPECT_TRUE(error.starts_with(size < 8 ? "input: p.png: not a PNG picture"
                                                   : "input: p.png: not a whole PNG picture: "))
                << size << ": " << error;
            EXPECT_EQ(error.find('\n'), std::string::npos);
        }
    }
}

// Chunks have checksums, so a changed byte is an error or has no effect, but never a crash.
TEST(PngPicture, SurvivesAnyChangedByte) {
    const std::string whole = png_of(9, 5, Samples(9 * 5, 99), {.interlaced = true});
    std::size_t refusals = 0;
    for (std::size_t at = 8; at < whole.size(); ++at)
        for (const int flip : {1, 0x80, 0xff}) {
            std::string bytes = whole;
            bytes[at] = static_cast<char>(bytes[at] ^ flip);
            refusals += !refused(bytes).empty();
        }
    EXPECT_GT(refusals, (whole.size() - 8) * 2);
}

// Tests text lengths that use every byte of the length field; libpng verifies the chunks'
// checksums.
TEST(PngPicture, TextsOfAnyLengthComeBack) {
    const std::string picture = png_of(9, 5, Samples(9 * 5, 99));
    for (const std::size_t size : {0U, 1U, 255U, 256U, 65'535U, 70'000U, 20'000'000U}) {
        const std::string text(size, 'x');
        const std::string both = png_with_text(png_with_text(picture, "a", text), "bc", "short");
        EXPECT_EQ(both.size(), picture.size() + 12 + 2 + size + 12 + 3 + 5);
        EXPECT_TRUE(text_of_png(both, "a") == text) << size;
        EXPECT_EQ(text_of_png(both, "bc"), "short");
        EXPECT_EQ(text_of_png(both, "b"), std::nullopt);
        EXPECT_EQ(read(both).grey, read(picture).grey);
    }
}

TEST(PngPicture, RefusesWhatNeedsTooMuchMemory) {
    const std::string bytes = png_of(100, 100, Samples(10'000));
    EXPECT_EQ(error_of([&] { read_png(bytes, "p.png", {.max_memory = 100'000}); }),
              "limit: the picture p.png needs 234 KiB of memory; the limit is 97.7 KiB | raise "
              "the limit with --max-memory");
}

}  // namespace stipple::testing::png_picture_test
