// SPDX-License-Identifier: MIT
#include "io/format.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "io/io_support.hpp"

namespace stipple::testing::format_test {

TEST(Formats, AreFoundByName) {
    EXPECT_EQ(io::format_named("npy").name, "npy");
    EXPECT_EQ(error_of([] { io::format_named("cvs"); }),
              "usage: unknown format 'cvs' | did you mean 'csv'?");
}

TEST(Formats, AreFoundByExtension) {
    const auto name = [](const char* path) {
        const Format* format = io::format_of_extension(path);
        return format == nullptr ? std::string() : format->name;
    };
    for (const auto& [path, format] : {std::pair{"a.csv", "csv"},
                                       {"dir.npy/a.tsv", "tsv"},
                                       {"a.TXT", "txt"},
                                       {"a.dat", "txt"},
                                       {"a.b.json", "json"},
                                       {"a.jsonl", "jsonl"},
                                       {"a.npy", "npy"},
                                       {"a.bin", "bin"},
                                       {"a.f64", "bin"},
                                       {"a.f32", "bin"},
                                       {"a.ply", "ply"},
                                       {"a.svg", "svg"},
                                       {"a", ""},
                                       {"-", ""},
                                       {"a.csv/b", ""},
                                       {".csv", ""},
                                       {"a.", ""},
                                       {"a.xyz", ""}})
        EXPECT_EQ(name(path), format) << path;
    EXPECT_TRUE(io::extension_is_single("a.f32"));
    EXPECT_FALSE(io::extension_is_single("a.f64"));
}

TEST(Formats, AreToldByTheirFirstBytes) {
    const auto name = [](std::string_view bytes) { return io::format_of_bytes(bytes).name; };
    const PointSet points = random_points(5, 2);
    for (const char* format : {"csv", "json", "jsonl", "npy"}) {
        EXPECT_EQ(name(written(format, {points}, {.provenance = some_provenance()})), format);
        EXPECT_EQ(name(written(format, {points, points})), format);
    }
    EXPECT_EQ(name("[[1,2],\n[3,4]]"), "json");
    EXPECT_EQ(name("\xEF\xBB\xBF [\n[1,2]]"), "json");
    EXPECT_EQ(name("[1,2]\n[3,4]\n"), "jsonl");
    EXPECT_EQ(name("[1,2]"), "jsonl");
    EXPECT_EQ(name("{\"points\":[[1,2]]}\n"), "json");
    EXPECT_EQ(name("{\"a\":\"}\"}\n[1,2]\n"), "jsonl");
    EXPECT_EQ(name("{\n\"points\":[[1,2]]}\n"), "json");
    EXPECT_EQ(name("{}"), "json");
    EXPECT_EQ(name("}"), "csv");
    EXPECT_EQ(name(""), "csv");
    EXPECT_EQ(name("1 2\n"), "csv");
}

// Untrusted files must be read or rejected, without a crash, a hang or wrong results. Sanitizers
// find more.
TEST(Formats, BrokenFilesAreReadOrRefused) {
    std::mt19937_64 random(1);
    const std::vector<PointSet> sets{random_points(4, 2, 1), random_points(4, 2, 2)};
    for (const Format& format : io::all()) {
        if (!format.read) continue;
        const std::vector<PointSet> some(sets.begin(),
                                         sets.begin() + (format.traits.many_sets ? 2 : 1));
        const std::string good =
            written(format.name, some, {.meta = true, .provenance = some_provenance()});
        for (int round = 0; round < 2000; ++round) {
            std::string bad = good;
            for (auto edits = 1 + random() % 3; edits > 0; --edits) {
                const auto at = random() % bad.size();
                constexpr std::string_view likely = "0123456789.,-+eE[]{}\":#\n\r\t \0x";
                const char c = random() % 4 != 0 ? likely[random() % likely.size()]
                                                 : static_cast<char>(random());
                if (random() % 3 == 0)
                    bad.erase(at, 1 + random() % 4);
                else if (random() % 2 == 0)
                    bad.insert(at, 1, c);
                else
                    bad[at] = c;
                if (bad.empty()) bad = "0";
            }
            try {
                for (const PointSet& set : read_as(format.name, bad, {.dimension = 2})) {
                    ASSERT_GT(set.count(), 0U) << bad;
                    for (const double x : set.flat()) ASSERT_TRUE(std::isfinite(x)) << bad;
                }
            } catch (const Error& error) {
                ASSERT_TRUE(std::string_view(error.what()).starts_with("p")) << error.what();
                ASSERT_EQ(error.kind(), ErrorKind::input) << error.what();
            }
        }
    }
}

}  // namespace stipple::testing::format_test
