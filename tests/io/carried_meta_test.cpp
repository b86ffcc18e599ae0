// SPDX-License-Identifier: MIT
#include "io/carried_meta.hpp"

#include <gtest/gtest.h>

#include <array>

#include "io/io_support.hpp"
#include "media/png_picture.hpp"
#include "support/units.hpp"

namespace stipple::testing::carried_meta_test {
namespace {

/// Provenance with characters that are special in XML, roff and shells.
Provenance awkward() {
    Provenance meta = some_provenance();
    meta.command = "stipple generate halton -w 'a<b>&amp;c' \"\\n";
    meta.precision = 3;
    meta.single = true;
    meta.inputs = {{"a &lt; b.png", "00ff"}};
    meta.stream_versions = {{"halton", 2}};
    return meta;
}

}  // namespace

TEST(CarriedMeta, ComesBackFromAFileBeside) {
    const io::CarriedMeta meta{.of = "npy",
                               .width = 3,
                               .sets = 2,
                               .single = true,
                               .front = "0123456789abcdef",
                               .extras = {"pdf"},
                               .provenance = awkward()};
    const auto back = io::carried_meta(io::to_text(meta), "p");
    EXPECT_EQ(back.of, "npy");
    EXPECT_EQ(back.width, 3U);
    EXPECT_EQ(back.sets, 2U);
    EXPECT_TRUE(back.single);
    EXPECT_EQ(back.front, meta.front);
    EXPECT_EQ(back.extras, meta.extras);
    EXPECT_EQ(back.provenance, awkward());
    EXPECT_EQ(io::meta_path("a/b.npy"), "a/b.npy.meta.json");
}

TEST(CarriedMeta, ComesBackFromPlyAndSvgAndLeavesTheRestAsItWas) {
    for (const char* format : {"ply", "svg"}) {
        const PointSet points = points_of({{0, 0.5}, {0.25, 1e-7}});
        const Layout plain{.provenance = awkward()};
        Layout layout = plain;
        layout.meta = true;
        const std::string with = written(format, {points}, layout);
        const auto found = io::find_carried_meta(with, "p");
        ASSERT_TRUE(found) << format;
        EXPECT_EQ(found->of, format);
        EXPECT_EQ(found->provenance, awkward()) << format;
        EXPECT_EQ(io::without_meta(with), written(format, {points}, plain)) << format;
        EXPECT_FALSE(io::find_carried_meta(io::without_meta(with), "p")) << format;
    }
}

TEST(CarriedMeta, ComesBackFromAPictureThatStaysThePicture) {
    const std::array<std::uint16_t, 6> samples = {0, 1, 65535, 300, 7, 8};
    const std::string plain = encode_png({3, 2, 16}, png_bytes_of_samples(samples, 16), {});
    EXPECT_FALSE(io::find_carried_meta(plain, "p"));
    const std::string with =
        io::png_with_meta(plain, {.of = "mask-image", .provenance = awkward()});
    const auto found = io::find_carried_meta(with, "p");
    ASSERT_TRUE(found);
    EXPECT_EQ(found->of, "mask-image");
    EXPECT_EQ(found->provenance, awkward());
    EXPECT_EQ(read_png(with, "p", {}).grey, read_png(plain, "p", {}).grey);  // checks all CRCs
}

TEST(CarriedMeta, IsNotFoundWhereThereIsNone) {
    for (const char* bytes : {"", "ply\n", "<svg>", "x,y\n0,0\n", "\x89PNG\r\n\x1a\n",
                              "\x89PNG\r\n\x1a\n\xff\xff\xff\xfftEXtstipple"})
        EXPECT_FALSE(io::find_carried_meta(bytes, "p")) << bytes;
    for (const char* text : {"", "{", "{}", "[1]", R"({"format":"stipple.meta","version":2})"})
        EXPECT_EQ(error_of([&] { io::carried_meta(text, "p.meta.json"); }),
                  "input: p.meta.json: no provenance; expected "
                  "{\"format\":\"stipple.meta\",\"version\":1,...}");
}

}  // namespace stipple::testing::carried_meta_test
