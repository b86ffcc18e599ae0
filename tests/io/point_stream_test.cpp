// SPDX-License-Identifier: MIT
//
// Reading in blocks gives the points of the whole file, also for files larger than the first
// buffer.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "io/files.hpp"
#include "io/point_stream.hpp"
#include "pipeline/produce.hpp"
#include "support/units.hpp"

namespace stipple::testing::point_stream_test {
namespace {

class PointStreams : public ::testing::Test {
  protected:
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::string path(const std::string& name) {
        std::filesystem::create_directories(folder_);
        return (folder_ / name).string();
    }

    /// A file with sets of n points.
    std::string file(const std::string& name, std::uint64_t n, std::uint64_t sets = 1) {
        SetsToMake job;
        job.generator = &find_generator("random");
        job.options = job.generator->options.defaults();
        job.request = {.count = n};
        job.sets = sets;
        produce(job, {.path = path(name), .format = io::format_of_extension(name)}, {});
        return path(name);
    }

    void append(const std::string& at, const std::string& bytes) {
        std::ofstream(at, std::ios::app | std::ios::binary) << bytes;
    }

  private:
    std::filesystem::path folder_ =
        std::filesystem::temp_directory_path() /
        (std::string("stipple_streams_") +
         ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

/// All sets of a stream, read in blocks of `block` rows.
std::vector<PointSet> drained(io::PointStream& stream, std::size_t block) {
    std::vector<PointSet> sets;
    const std::size_t d = stream.dimension();
    std::vector<double> rows(block * d);
    while (stream.next_set()) {
        std::vector<double> flat;
        for (std::size_t got = block; got == block;) {
            got = stream.read(rows);
            flat.insert(flat.end(), rows.begin(),
                        rows.begin() + static_cast<std::ptrdiff_t>(got * d));
        }
        EXPECT_EQ(stream.count().value_or(flat.size() / d), flat.size() / d);
        sets.emplace_back(std::move(flat), d);
    }
    return sets;
}

std::vector<PointSet> in_blocks(const std::string& path, const ReadOptions& options,
                                std::size_t block, bool held = false) {
    const auto stream = io::open_points(path, options, {});
    EXPECT_EQ(stream->held(), held) << path;
    return drained(*stream, block);
}

void expect_same(const std::string& path, const ReadOptions& options = {.dimension = 2},
                 bool held = false) {
    const auto whole = io::read_points(path, options, {});
    for (const std::size_t block : {1000UL, 77'777UL, 1'000'000UL})
        EXPECT_EQ(in_blocks(path, options, block, held), whole) << path << " " << block;
    EXPECT_EQ(io::open_points(path, options, {})->read_all({}), whole);
}

/// Expects reading in blocks to give the same error as reading the whole file.
void expect_same_error(const std::string& path, const ReadOptions& options = {.dimension = 2}) {
    const auto error = error_of([&] { io::read_points(path, options, {}); });
    EXPECT_NE(error, "");
    EXPECT_EQ(error_of([&] { in_blocks(path, options, 4096); }), error);
}

}  // namespace

TEST_F(PointStreams, AreThePointsOfTheFile) {
    for (const char* name : {"a.bin", "a.npy", "a.csv", "a.txt"}) expect_same(file(name, 300'000));
    expect_same(file("b.npy", 150'000, 2));
    expect_same(file("b.txt", 60'001, 3));
}

TEST_F(PointStreams, HoldWhatIsSmallOrMustBeWhole) {
    expect_same(file("small.csv", 10), {}, true);
    expect_same(file("small.bin", 10), {.dimension = 2}, true);
    expect_same(file("a.json", 110'000), {}, true);
    expect_same(file("sets.csv", 60'000, 2), {});
}

TEST_F(PointStreams, PickColumns) {
    expect_same(file("a.csv", 120'000), {.columns = {"y"}});
    expect_same(file("a.bin", 300'000), {.dimension = 2, .columns = {"2", "1"}});
    expect_same(file("a.npy", 300'000), {.columns = {"2"}});
}

TEST_F(PointStreams, SetsOfAGeneratorHaveOneSeedAfterTheOther) {
    const auto at = path("seeds.txt");
    std::string text = "# tool: \"stipple\"\n# generator: \"random\"\n# seed: 5\n";
    for (int i = 0; i < 900'000; ++i) text += i == 500'000 ? "#\n" : "0.5 0.5\n";
    append(at, text);
    const auto sets = io::open_points(at, {}, {})->read_all({});
    ASSERT_EQ(sets.size(), 2U);
    EXPECT_EQ(sets[0].provenance.seed, 5U);
    EXPECT_EQ(sets[1].provenance.seed, 6U);
}

TEST_F(PointStreams, HoldPointsOfManyCoordinates) {
    std::string row = "0";
    for (int k = 1; k < 512; ++k) row += ",0";
    std::string text;
    for (int i = 0; i < 5000; ++i) text += row + "\n";
    const auto at = path("wide.csv");
    append(at, text);
    EXPECT_EQ(io::open_points(at, {}, {})->read_all({}).at(0).count(), 5000U);
}

TEST_F(PointStreams, SayWhatIsWrongAsForTheWhole) {
    const auto wrong = [&](const char* name, std::uint64_t n, const std::string& more) {
        const auto at = file(name, n);
        append(at, more);
        return at;
    };
    for (const char* more : {"1,2,3\n", "1\n", "x,1\n", "1,nan\n", "\x01,2\n"})
        expect_same_error(wrong("a.csv", 120'000, more));
    expect_same_error(wrong("a.txt", 120'000, "#\n#\n1 2\n"));
    expect_same_error(wrong("a.txt", 120'000, "#\n"));
    expect_same_error(wrong("a.bin", 300'000, "123"));
    expect_same_error(
        wrong("a.bin", 300'000, std::string("\0\0\0\0\0\0\xf0\x7f\0\0\0\0\0\0\0\0", 16)));
    expect_same_error(wrong("a.npy", 300'000, "123"));
    const auto cut = file("b.npy", 300'000);
    std::filesystem::resize_file(cut, 4'700'000);
    expect_same_error(cut);
    expect_same_error(path("missing.csv"));
}

}  // namespace stipple::testing::point_stream_test
