// SPDX-License-Identifier: MIT
#include "pipeline/produce.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "pipeline/pipeline.hpp"
#include "pipeline/warping.hpp"
#include "stipple/warp.hpp"
#include "support/temporary_file.hpp"
#include "support/units.hpp"

namespace stipple::testing::produce_test {
namespace {

/// Output of a target without a file.
std::string written(std::vector<PointSet> sets, Target target = {}) {
    std::string bytes;
    target.sink = [&](std::string_view more) {
        bytes += more;
        return true;
    };
    write_sets(std::move(sets), target, {});
    return bytes;
}

}  // namespace

TEST(WriteSets, TakesTheFormatOfTheNameOrCsv) {
    EXPECT_EQ(written({points_of({{0.5, 0.25}})}), "x,y\n0.5,0.25\n");
    const TemporaryFile file("", ".txt");
    write_sets({points_of({{0.5, 0.25}})}, {.path = file.path()}, {});
    EXPECT_EQ(file.bytes(), "0.5 0.25\n");
}

TEST(WriteSets, RefusesWhatIsNoPoints) {
    EXPECT_EQ(error_of([] { written({}); }), "input: there are no points to write");
    EXPECT_EQ(error_of([] { written({PointSet()}); }), "input: set 0 has no points to write");
    EXPECT_EQ(error_of([] {
                  written({PointSet(2, 2), PointSet(2, 3)});
              }),
              "input: set 1 has points of 3 coordinates; those before have 2");
}

TEST(WriteSets, TakesPointsWithoutADomainForThoseOfTheCube) {
    PointSet points = points_of({{0.5, 0.25}});
    points.domain = nullptr;
    EXPECT_EQ(written({points}), "x,y\n0.5,0.25\n");
    EXPECT_EQ(analyze("star-discrepancy", points).number("value"), 0.875);
    PointSet more = generate("random", {.count = 100, .dimension = 2});
    more.domain = nullptr;
    EXPECT_GT(analyze("chi-square", more).number("p_value"), 0);
}

// A stop that comes when the points are written has interrupted nothing.
TEST(Produce, TellsWhetherASearchWasStopped) {
    const auto is_stopped = [](const char* name, const Target& target, const RunContext& of) {
        SetsToMake job;
        job.generator = &find_generator(name);
        job.options = job.generator->options.defaults();
        job.request = {.count = 24, .dimension = 2};
        return produce(job, target, of);
    };
    for (const char* name : {"random", "poisson-disk"}) {
        std::stop_source late;
        Target target{.format = &io::format_named("json")};
        target.sink = [&](std::string_view bytes) {
            if (bytes.ends_with("}\n")) late.request_stop();
            return true;
        };
        EXPECT_FALSE(is_stopped(name, target, {.threads = 1, .stop = late.get_token()}));
        EXPECT_TRUE(late.stop_requested());
    }
    const TemporaryFile file("", ".csv");
    std::stop_source early;
    RunContext run{.threads = 1, .stop = early.get_token()};
    run.progress = [&](double done) {
        if (done > 0) early.request_stop();
    };
    EXPECT_TRUE(is_stopped("optimized", {.path = file.path()}, run));
}

// Sets made one at a time: on disk they are the same, and what all of them have is known.
TEST(SetStream, WaitsOnDiskWithCountsAndCommonOptions) {
    const auto make = [](std::size_t set) {
        PointSet points(std::vector<double>(2 * (set + 1), 0.25 * static_cast<double>(set)), 2);
        points.domain = unit_cube(2);
        points.provenance.options = {{"method", "fast"}, {"radius", std::to_string(set)}};
        points.side_files = {{.path = "p" + std::to_string(set), .bytes = {}}};
        return points;
    };
    std::string beside;
    const SetStream sets = waiting(stream_of(3, make, 7), {}, [&](const auto& files) {
        for (const SideFile& file : files) beside += file.path;
    });
    EXPECT_EQ(beside, "p0p1p2");
    EXPECT_EQ(sets.seed(2), 9U);
    const SetsHead head = sets.head(0, 3);
    EXPECT_EQ(head.provenance.options,
              (std::vector<std::pair<std::string, std::string>>{{"method", "fast"}}));
    for (std::size_t set = 0; set < 3; ++set) {
        const OpenSet open = sets.open(set, {});
        std::vector<double> rows(100);
        EXPECT_EQ(open.count, set + 1);
        EXPECT_EQ(head.counts[set], set + 1);
        ASSERT_EQ(open.next(rows), set + 1);
        rows.resize(2 * (set + 1));
        EXPECT_TRUE(std::ranges::equal(rows, make(set).flat()));
        EXPECT_EQ(open.next(rows), 0U);
    }
}

// Blocks that are warped in parallel lose different numbers of points; the remaining ones are
// joined in order.
TEST(WriteWarped, DropsPointsOfAStreamAsOfASetInMemory) {
    const PointSet points = generate("random", {.count = 300'000, .dimension = 2});
    const TemporaryFile file("", ".f64");
    write_sets({points}, {.path = file.path()}, {});
    const auto stream = io::open_points(file.path(), {.dimension = 2}, {});
    ASSERT_FALSE(stream->held());
    std::string bytes;
    Target target{.format = &io::format_named("bin")};
    target.sink = [&](std::string_view more) {
        bytes += more;
        return true;
    };
    const Spec spec = parse_spec("disk:method=rejection");
    write_warped({.stream = stream.get(), .on = unit_cube(2)}, spec, false, target, {.threads = 3});
    const PointSet image = warp("disk:method=rejection", points);
    EXPECT_LT(image.count(), points.count());
    ASSERT_EQ(bytes.size(), image.flat().size_bytes());
    EXPECT_EQ(std::memcmp(bytes.data(), image.flat().data(), bytes.size()), 0);
}

// Sets have provenance, so that files written of them have it, too.
TEST(Generate, TellsWhereThePointsAreFrom) {
    const PointSet points =
        generate("halton", {.count = 5, .dimension = 3, .start = 7, .seed = 9}, {{"leap", "7"}});
    const Provenance& from = points.provenance;
    EXPECT_EQ(from.generator, "halton");
    EXPECT_EQ(from.seed, 9U);
    EXPECT_EQ(from.count, 5U);
    EXPECT_EQ(from.dimension, 3U);
    EXPECT_EQ(from.start, 7U);
    EXPECT_FALSE(from.version.empty());
    EXPECT_NE(std::ranges::find(from.options, std::pair<std::string, std::string>("leap", "7")),
              from.options.end());
}

TEST(PointSet, ConsistsOfWholePoints) {
    EXPECT_EQ(error_of([] {
                  PointSet(std::vector<double>{.1, .2, .3}, 2);
              }),
              "usage: 3 numbers cannot be divided into points of 2 coordinates");
    EXPECT_EQ(error_of([] { PointSet(std::vector<double>{.1}, 0); }),
              "usage: 1 numbers cannot be divided into points of 0 coordinates");
}

TEST(Report, SaysWhatIsNoNumber) {
    const Report report = analyze("star-discrepancy", points_of({{0.5, 0.25}}));
    EXPECT_EQ(error_of([&] { static_cast<void>(report.number("exact")); }),
              "usage: the result 'exact' is not a number");
}

}  // namespace stipple::testing::produce_test
