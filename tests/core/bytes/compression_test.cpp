// SPDX-License-Identifier: MIT
#include "core/bytes/compression.hpp"

#include <gtest/gtest.h>

#include "core/rng.hpp"
#include "support/units.hpp"

namespace stipple::testing::compression_test {
namespace {

constexpr Compression kinds[] = {Compression::gzip, Compression::zstd};

std::string compressed(Compression kind, std::string_view text, std::size_t step = 1 << 20) {
    std::string out;
    const auto sink = [&](std::string_view bytes) {
        out += bytes;
        return true;
    };
    Compressor compressor(kind);
    for (; !text.empty(); text.remove_prefix(std::min(step, text.size())))
        compressor.add(text.substr(0, step), sink);
    compressor.finish(sink);
    return out;
}

/// Passes `step` bytes at a time on both sides.
std::string decompressed(Compression kind, std::string_view bytes, std::size_t step = 1 << 20) {
    const auto refill = [&] {
        const auto next = bytes.substr(0, step);
        bytes.remove_prefix(next.size());
        return next;
    };
    Decompressor decompressor(kind, refill, "p.csv");
    std::string out;
    std::string part(step, '\0');
    for (std::size_t got = step; got == step;) {
        got = decompressor.read(part);
        out.append(part, 0, got);
    }
    return out;
}

std::string noise(std::size_t size) {
    std::string text(size, '\0');
    for (std::size_t i = 0; i < size; ++i) text[i] = static_cast<char>(i * i * 2654435761 >> 13);
    return text;
}

/// 13 bytes as compressed by Python's gzip.
const std::string table = "x,y\n0.25,0.5\n";
constexpr unsigned char by_python[] = {0x1f, 0x8b, 0x08, 0x00, 0x00, 0x00, 0x00, 0x00, 0x02,
                                       0x03, 0xab, 0xd0, 0xa9, 0xe4, 0x32, 0xd0, 0x33, 0x32,
                                       0xd5, 0x31, 0xd0, 0x33, 0xe5, 0x02, 0x00, 0x98, 0x6b,
                                       0x5e, 0x4d, 0x0d, 0x00, 0x00, 0x00};

/// One uncompressed block, by hand from RFC 8878: magic, a header for one segment of 13 bytes, and
/// a block that is the last (1), raw (0), and 13 bytes long (13 << 3).
const std::string by_hand =
    std::string("\x28\xb5\x2f\xfd\x20\x0d", 6) + std::string("\x69\x00\x00", 3) + table;

}  // namespace

TEST(Compression, ReadsWhatOthersWrite) {
    const std::string gzip(reinterpret_cast<const char*>(by_python), sizeof by_python);
    EXPECT_EQ(compression_of_bytes(gzip), Compression::gzip);
    EXPECT_EQ(compression_of_bytes(by_hand), Compression::zstd);
    EXPECT_EQ(compression_of_bytes(table), Compression::none);
    for (const std::size_t step : {1, 2, 7, 1000}) {
        EXPECT_EQ(decompressed(Compression::gzip, gzip, step), table) << step;
        EXPECT_EQ(decompressed(Compression::zstd, by_hand, step), table) << step;
        EXPECT_EQ(decompressed(Compression::gzip, gzip + gzip, step), table + table) << step;
        EXPECT_EQ(decompressed(Compression::zstd, by_hand + by_hand, step), table + table) << step;
    }
}

TEST(Compression, BringsBackBytesOfAnySize) {
    for (const Compression kind : kinds)
        for (const std::size_t size : {0, 1, 65'535, 65'536, 65'537, 3'000'000})
            for (const std::string& text : {noise(size), std::string(size, 'x')}) {
                const std::string bytes = compressed(kind, text);
                EXPECT_EQ(compression_of_bytes(bytes), kind);
                EXPECT_TRUE(decompressed(kind, bytes) == text) << size;
                EXPECT_TRUE(decompressed(kind, compressed(kind, text, 999), 4097) == text) << size;
                EXPECT_LT(bytes.size(), (text[0] == 'x' ? size / 700 : size + size / 1000) + 40);
            }
}

TEST(Compression, RefusesEveryTruncationAndChangedByte) {
    for (const Compression kind : kinds) {
        const std::string whole = compressed(kind, table + table);
        for (std::size_t size = 0; size < whole.size(); ++size)
            EXPECT_EQ(error_of([&] { decompressed(kind, whole.substr(0, size)); }),
                      "input: p.csv: the compressed bytes end too soon");
        std::size_t refused = 0;
        for (std::size_t at = 0; at < whole.size(); ++at) {
            std::string bytes = whole;
            bytes[at] = static_cast<char>(bytes[at] ^ 0x10);
            const std::string error = error_of([&] { decompressed(kind, bytes); });
            refused += error.starts_with("input: p.csv: the compressed bytes ");
        }
        // The time, system and level bytes of gzip are not checked.
        EXPECT_GE(refused, whole.size() - 7);
        EXPECT_NE(error_of([&] { decompressed(kind, whole + "rest"); }), "");
    }
}

TEST(Compression, IsNamedByTheEndOfAName) {
    EXPECT_EQ(compression_of_name("p.csv.gz"), Compression::gzip);
    EXPECT_EQ(compression_of_name("P.CSV.GZ"), Compression::gzip);
    EXPECT_EQ(compression_of_name("p.zst"), Compression::zstd);
    for (const char* name : {"", "gz", "p.csv", "p.gzip", "p.gz.csv", "pgz", "zst"})
        EXPECT_EQ(compression_of_name(name), Compression::none) << name;
}

TEST(Compression, EndsWhereNobodyWantsMore) {
    for (const Compression kind : kinds) {
        Compressor compressor(kind);
        const auto closed = [](std::string_view) { return false; };
        EXPECT_FALSE(compressor.add(noise(10'000'000), closed));
    }
}

}  // namespace stipple::testing::compression_test
