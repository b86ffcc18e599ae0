// SPDX-License-Identifier: MIT
//
// The public API: headers that need only the standard library, and functions that throw if they
// cannot do what was requested.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <regex>
#include <stipple/stipple.hpp>

#include "core/spec.hpp"
#include "pipeline/generated.hpp"
#include "pipeline/units.hpp"
#include "places.hpp"
#include "support/temporary_file.hpp"
#include "support/units.hpp"

namespace stipple::testing::api_test {

namespace {

const double nan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST(Api, HeadersIncludeTheStandardLibraryAlone) {
    const std::regex allowed(R"(#include (<[a-z_]+>|"stipple/[a-z]+\.hpp").*)");
    for (const auto& entry :
         std::filesystem::directory_iterator(STIPPLE_SOURCE_DIR "/src/stipple")) {
        std::ifstream in(entry.path());
        for (std::string text; std::getline(in, text);)
            EXPECT_TRUE(!text.starts_with("#include") || std::regex_match(text, allowed))
                << entry.path() << ": " << text;
    }
}

TEST(Api, ASpecAndSettingsGiveTheSamePoints) {
    const Request request{.count = 100, .dimension = 3, .seed = 9};
    const PointSet by_spec = generate("sobol:scramble=owen", request);
    EXPECT_EQ(by_spec, generate("sobol", request, {{"scramble", "owen"}}));
    EXPECT_NE(by_spec, generate("sobol:scramble=owen", {.count = 100, .dimension = 3}));
    EXPECT_EQ(by_spec.provenance.generator, "sobol");
    EXPECT_EQ(by_spec.provenance.seed, 9U);
    EXPECT_EQ(error_of([] { generate("hallton"); }).substr(0, 34),
              "usage: unknown generator 'hallton'");
    EXPECT_NE(error_of([] { generate("halton@1"); }), "");
}

TEST(Api, ASamplerGivesThePointsOfTheSet) {
    const Request request{.count = 64, .dimension = 2, .start = 3, .seed = 5};
    const PointSet set = generate("halton:scramble=owen", request);
    const Sampler sampler("halton:scramble=owen", request);
    std::vector<double> rows(2 * 10);
    sampler.fill(20, rows);
    EXPECT_TRUE(std::ranges::equal(rows, set.flat().subspan(40, 20)));

    std::vector<double> odd(3);
    EXPECT_EQ(error_of([&] { sampler.fill(0, odd); }),
              "usage: 3 numbers cannot be divided into rows of 2");
    const std::uint64_t late = (1ULL << 53) - 8;
    const Sampler tail("random", {.dimension = 2, .start = late});
    EXPECT_EQ(error_of([&] { tail.fill(0, rows); }).substr(0, 20), "usage: points 0 to 9") << late;
    const Sampler ends("jittered", {.count = 16, .dimension = 2});
    EXPECT_EQ(error_of([&] { ends.fill(7, rows); }),
              "usage: points 7 to 16 are beyond the last one, which is 15");
    const Sampler last("faure", {.dimension = 7});  // 17 digits in base 7
    EXPECT_EQ(error_of([&] { last.fill(232630513987207, std::span(rows).first(7)); }),
              "usage: points 232630513987207 to 232630513987207 are beyond the last one, which is "
              "232630513987206");
    EXPECT_EQ(error_of([&] { last.fill(232630513987206, std::span(rows).first(7)); }), "");
    EXPECT_NE(error_of([] { Sampler("poisson-disk"); }), "");
    EXPECT_NE(error_of([] { Sampler("random", {.bounds = Box{{0}, {2}}}); }), "");
}

TEST(Api, PointsOneByOneAreThoseOfABlock) {
    std::vector<std::string> specs{
        "sobol:scramble=owen",          "sobol:scramble=matrix",     "sobol:order=natural",
        "sobol:scramble=digital-shift", "halton:scramble=owen",      "halton:scramble=permutation",
        "halton:scramble=faure",        "halton:scramble=reverse",   "halton:leap=1000003",
        "faure:scramble=owen",          "niederreiter:scramble=owen"};
    for (const Generator& generator : generators::all())
        if (generator.traits.sequence && generator.traits.prefix) specs.push_back(generator.name);
    std::size_t compared = 0;
    for (const std::string& spec : specs)
        for (const std::size_t d : {1, 2, 7, 40})
            for (const std::uint64_t first : {0ULL, 1000ULL, (1ULL << 31) - 20, (1ULL << 48) + 5}) {
                std::vector<double> block(d * 40);
                std::vector<double> single(d);
                try {
                    const Sampler sampler(spec, {.dimension = d, .seed = 9});
                    sampler.fill(first, block);
                    for (std::size_t i = 0; i < 40; ++i) {
                        sampler.fill(first + i, single);
                        ASSERT_TRUE(std::ranges::equal(single, std::span(block).subspan(i * d, d)))
                            << spec << " point " << first + i << " d = " << d;
                    }
                    ++compared;
                } catch (const Error& e) {
                    ASSERT_EQ(e.kind(), ErrorKind::usage) << e.what();  // dimension or index
                }
            }
    EXPECT_GT(compared, 150U);
}

TEST(Api, LackOfMemoryIsALimit) {
    const auto kind_of = [](const auto& call) {
        try {
            call();
        } catch (const Error& e) {
            return e.kind();
        }
        return ErrorKind::cancelled;  // no error
    };
    // More numbers than a vector can have, so nothing is allocated.
    const Request vast{.count = 1ULL << 50, .dimension = 2048};
    EXPECT_EQ(kind_of([&] { generate("random", vast); }), ErrorKind::limit);
    EXPECT_EQ(kind_of([&] { generate("sobol:scramble=owen", vast); }), ErrorKind::limit);
    EXPECT_EQ(kind_of([&] { PointSet(std::size_t{1} << 63, 2); }), ErrorKind::limit);
    EXPECT_EQ(kind_of([&] { Rows::unwritten(std::size_t{1} << 61, 8); }), ErrorKind::limit);
    for (const std::string name : {"poisson-disk", "latin-hypercube"})
        EXPECT_EQ(error_of([&] { generate(name, {.count = 1ULL << 60, .dimension = 2}); }),
                  "usage: --count: 1152921504606846976 is outside [1, 9007199254740992], the range "
                  "of " +
                      name);
    EXPECT_EQ(error_of([] { generate("poisson-disk", {.count = 1ULL << 48, .dimension = 2}); }),
              "limit: a radius of 4.97e-08, with about 2.81e+14 points, needs 9.98e+14 search "
              "cells; at most 2^32 are possible, for about 1.2e+09 points");
    EXPECT_EQ(
        error_of([] { generate("sample-elimination", {.count = 1ULL << 48, .dimension = 2}); }),
        "limit: --count: 281474976710656 points are chosen from 1.407e+15; at most 2^32 are "
        "possible, for 8.6e+08 points");
    if (sanitized()) GTEST_SKIP() << "the sanitizer stops the program when memory is lacking";
    EXPECT_EQ(error_of([] { PointSet(1ULL << 50, 2); }),
              "limit: out of memory for 1125899906842624 points of 2 coordinates, which take "
              "1.8e+07 GB");
    EXPECT_EQ(kind_of([] { Warper("normal", 1ULL << 50); }), ErrorKind::limit);
    for (const std::string& name : generator_names()) {
        const auto kind = kind_of([&] { generate(name, {.count = 1ULL << 50, .dimension = 2}); });
        EXPECT_TRUE(kind == ErrorKind::limit || kind == ErrorKind::usage) << name;
    }
}

// Points of a triangle lie in the square, whose discrepancy they have not.
TEST(Api, WhatIsDefinedForTheCubeRefusesOtherDomains) {
    const PointSet cube = generate("halton", {.count = 50, .dimension = 2, .start = 1});
    const PointSet triangle = warp("triangle", cube);
    for (const std::string analyzer : {"star-discrepancy", "l2-discrepancy", "dispersion"}) {
        EXPECT_NO_THROW(analyze(analyzer, cube)) << analyzer;
        try {
            analyze(analyzer, triangle);
            ADD_FAILURE() << analyzer;
        } catch (const Error& e) {
            EXPECT_EQ(e.kind(), ErrorKind::input);
            EXPECT_EQ(
                e.what(),
                analyzer + " requires points of the unit cube; the domain of these is triangle");
        }
    }
}

TEST(Api, AWarpGoesThereAndBack) {
    const PointSet cube = generate("halton", {.count = 50, .dimension = 2, .start = 1});
    const PointSet disk = warp("disk:radius=2", cube);
    EXPECT_EQ(domain_of(disk), "disk:radius=2");
    EXPECT_DOUBLE_EQ(measure_of(disk), 4 * std::acos(-1.0));
    for (const double density : densities(disk)) EXPECT_DOUBLE_EQ(density, 1 / measure_of(disk));
    const PointSet back = warp_back("disk:radius=2", disk);
    const Warper warper("disk:radius=2", 2);
    EXPECT_TRUE(std::ranges::equal(warper.forward(cube.flat()), disk.flat()));
    EXPECT_TRUE(std::ranges::equal(warper.inverse(disk.flat()), back.flat()));
    for (std::size_t i = 0; i < cube.flat().size(); ++i)
        EXPECT_NEAR(back.flat()[i], cube.flat()[i], 1e-14);
    EXPECT_NE(error_of([&] { warp("disk", disk); }), "") << "it is on a disk already";
    EXPECT_NE(error_of([&] { (void)warper.forward(std::vector<double>{0.5}); }), "");
    EXPECT_NE(error_of([&] { (void)warper.forward(std::vector<double>{0.5, nan}); }), "");
    EXPECT_NE(error_of([&] { (void)warper.density(std::vector<double>{0.5, 1, 2}); }), "");
    EXPECT_NE(error_of([] { Warper("disk", 3); }), "");
}

TEST(Api, ASetThatNobodyCouldMeanIsRefused) {
    EXPECT_NE(error_of([] { PointSet({0.1, 0.2, 0.3}, 2); }), "");
    PointSet set(3, 2);
    EXPECT_EQ(error_of([&] { (void)set[3]; }),
              "usage: there is no point 3 (from 0); the set has 3 points");
    const PointSet moved = std::move(set);
    EXPECT_NE(error_of([&] { (void)set[0]; }), "");  // NOLINT(bugprone-use-after-move): on purpose
    PointSet homeless = generate("random", {.count = 200});
    homeless.domain.reset();
    EXPECT_GT(analyze("chi-square", homeless).number("p_value"), 0);
    for (const PointSet& odd : {PointSet(), PointSet({nan, 0}, 2), PointSet({-1, 5}, 2)})
        for (const std::string& analyzer : analyzer_names())
            EXPECT_NE(error_of([&] { (void)analyze(analyzer, odd); }), "") << analyzer;
}

TEST(Api, PartsOfASetThatDoNotFitAreRefused) {
    const PointSet cube = generate("halton", {.count = 50, .dimension = 2, .start = 1});
    const std::string path = "stipple_api_test.csv";
    std::filesystem::remove(path);
    const auto expect_refused = [&](const PointSet& set, const std::string& words) {
        for (const std::string name : {"integration", "chi-square", "moments"})
            EXPECT_EQ(error_of([&] { analyze(name, set); }), words) << name;
        EXPECT_EQ(error_of([&] { warp("disk", set); }), words);
        EXPECT_EQ(error_of([&] { warp_back("disk", set); }), words);
        EXPECT_EQ(error_of([&] { (void)densities(set); }), words);
        EXPECT_EQ(error_of([&] { write(path, set); }), words);
        EXPECT_FALSE(std::filesystem::exists(path));
    };
    PointSet odd = cube;
    odd.densities = {1, 2};
    expect_refused(odd, "usage: 2 densities for 50 points");
    odd.densities.assign(50, 1);
    odd.densities[3] = 0;
    expect_refused(odd, "input: point 3: its density is 0; expected a number above 0");
    odd = cube;
    odd[7][1] = nan;
    EXPECT_EQ(error_of([&] { write(path, odd); }),
              "input: point 7: coordinate 2 is nan; expected a finite number");
    EXPECT_NE(error_of([&] { write_report(path, std::vector<NamedSet>{{"odd", odd}}); }), "");
    odd = cube;
    odd.domain = domain_named("ball", 3);
    EXPECT_EQ(error_of([&] { write(path, odd); }),
              "usage: points of 2 coordinates are not on ball");
    odd = cube;
    odd.densities.assign(50, 2);
    EXPECT_EQ(densities(odd), odd.densities);
}

TEST(Api, SetsHaveTheCommandThatMakesThem) {
    const PointSet set = generate("poisson-disk", {.count = 50, .seed = 4});
    EXPECT_EQ(set.provenance.command, "stipple generate poisson-disk --count 50 --seed 4");
    EXPECT_EQ(generate("sobol:scramble=owen",
                       {.dimension = 3, .start = 64, .bounds = Box{{0, 0, -1}, {1, 1, 1}}},
                       {{"scramble", "matrix"}})
                  .provenance.command,
              "stipple generate sobol:scramble=matrix --dimension 3 --start 64 "
              "--bounds 0..1,0..1,-1..1 --seed 1");
    const std::string path = "stipple_api_sets.json";
    const std::vector<PointSet> others = {set, generate("random", {.count = 50})};
    write(path, others);
    const PointSet read_back = read_sets(path).front();
    EXPECT_EQ(read_back.provenance.generator, "") << "neither command makes both";
    EXPECT_EQ(read_back, set);
    std::filesystem::remove(path);
}

TEST(Api, BoundsAreABoxOfThePoints) {
    const auto refusal = [](const Box& box) {
        return error_of([&] { generate("halton", {.bounds = box}); });
    };
    const double infinity = std::numeric_limits<double>::infinity();
    for (const Box& box : std::vector<Box>{{{}, {}},
                                           {{0, 0}, {1}},
                                           {{0}, {1, 1}},
                                           {{0, nan}, {1, 1}},
                                           {{0, 0}, {1, infinity}},
                                           {{-1e308, 0}, {1e308, 1}},
                                           {{0, 1}, {1, 1}},
                                           {{0, 2}, {1, 1}}}) {
        EXPECT_EQ(refusal(box), "usage: --bounds: expected finite low < high for each coordinate");
        EXPECT_NE(error_of([&] { generate("poisson-disk", {.bounds = box}); }), "");
    }
    EXPECT_EQ(refusal({{0, 0, 0}, {1, 1, 1}}), "usage: --bounds: 3 ranges for 2 coordinates");
    // All points would be the lower end.
    EXPECT_EQ(
        refusal({{0, 1e20}, {1, 1e20 + 16384}}),
        "usage: --bounds: the range from 1e+20 to 1.0000000000000002e+20 is so narrow that it "
        "is lost in rounding");
    EXPECT_EQ(
        refusal({{0, 0}, {1, 1e-320}}),
        "usage: --bounds: the range from 0 to 1e-320 is so narrow that it is lost in rounding");
    for (const std::string generator : {"random", "poisson-disk", "best-candidate"})
        EXPECT_EQ(
            error_of([&] {
                generate(generator, {.count = 9, .dimension = 3, .bounds = Box{{0, 0}, {1, 1}}});
            }),
            "usage: --bounds: 2 ranges for 3 coordinates")
            << generator;
}

// The number of points decides how far micro-jitter moves them.
TEST(Api, ScramblesKnowTheSetAndAreRecordedWithTheirSeed) {
    const PointSet set = generate("halton", {.count = 64, .dimension = 2});
    const PointSet moved = warp("micro-jitter", set);
    EXPECT_EQ(moved, warp("micro-jitter:cells=64", set));
    EXPECT_EQ(moved.provenance.warps, std::vector<std::string>{"micro-jitter:seed=1"});
    EXPECT_EQ(error_of([] { Warper("micro-jitter", 2); }),
              "usage: micro-jitter: --cells: needed, as the number of points is unknown");
    EXPECT_NO_THROW(Warper("micro-jitter:cells=64", 2));
}

// The ways of a point: generated with a warp, warped as a set, mapped row by row.
TEST(Api, AllWaysToWarpGiveTheSamePoints) {
    std::size_t compared = 0;
    const std::vector<std::string> scrambles = scramble_names();
    std::vector<std::string> names = warp_names();
    std::ranges::copy(scrambles, std::back_inserter(names));
    for (const std::string& name : names)
        for (const std::size_t d : {1, 2, 3, 4}) {
            const bool scramble = std::ranges::find(scrambles, name) != scrambles.end();
            const Request request{.count = 81, .dimension = d, .start = scramble ? 0U : 1U};
            const PointSet cube = generate("halton", request);
            PointSet made;
            try {
                const Generator& halton = find_generator("halton");
                made = GeneratedSets({.generator = &halton,
                                      .options = halton.options.defaults(),
                                      .request = request,
                                      .warps = {parse_spec(name)}},
                                     {})
                           .made(0, {});
            } catch (const Error&) {
                continue;  // needs a file, or another dimension
            }
            ++compared;
            const PointSet warped = warp(name, cube);
            // One that leaves points out is given more of them by generate.
            ASSERT_LE(warped.count(), made.count()) << name;
            EXPECT_TRUE(std::ranges::equal(warped.flat(), made.flat().first(warped.flat().size())))
                << name;
            if (scramble) continue;  // may depend on the bases and the number of points
            const std::vector<double> rows = Warper(name, d).forward(cube.flat());
            EXPECT_TRUE(std::ranges::equal(rows, warped.flat())) << name;
        }
    EXPECT_GE(compared, 60U);
}

TEST(Api, SetsAreWrittenAndReadBack) {
    const std::vector<PointSet> sets = {generate("random", {.count = 5, .dimension = 3}),
                                        generate("halton", {.count = 5, .dimension = 3})};
    const auto folder = std::filesystem::temp_directory_path() / "stipple_api_test";
    std::filesystem::create_directory(folder);
    const std::string path = (folder / "sets.npy").string();
    write(path, sets);
    EXPECT_EQ(read_sets(path), sets);
    EXPECT_NE(error_of([&] { (void)read(path); }), "") << "there are two";
    write(path, sets[1]);
    EXPECT_EQ(read(path), sets[1]);
    EXPECT_NE(error_of([&] { write(path, std::vector<PointSet>{}); }), "");
    EXPECT_NE(error_of([&] { write(path, PointSet()); }), "");
    EXPECT_NE(error_of([&] { write(path, std::vector{PointSet(2, 2), PointSet(2, 3)}); }), "");
    EXPECT_NE(error_of([&] { (void)read((folder / "missing.csv").string()); }), "");
    std::filesystem::remove_all(folder);
}

TEST(Api, StudiesHaveAllNumbersOfAnAnalyzer) {
    std::vector<std::string> keys;
    for (const StudyValue& v : study({.generators = {"halton"},
                               .analyzers = {"integration:integrand=owen", "moments"},
                               .counts = {16}}))
        if (v.analyzer != "moments") keys.push_back(v.key);
    EXPECT_EQ(keys, (std::vector<std::string>{"owen.estimate", "owen.exact", "owen.error"}));
}

// By hand: the mean of four values, and its interval of 3.182 standard errors.
TEST(Api, MeansOfAStudyHaveStudentsInterval) {
    std::vector<StudyValue> values;
    for (const double x : {1.0, 2.0, 3.0, 4.0})
        values.push_back({"g", "a", 2, 8, values.size(), "value", x, ""});
    values.push_back({"g", "a", 2, 8, 9, "value", std::nullopt, "it failed"});
    const auto means = means_of(values);
    ASSERT_EQ(means.size(), 1U);
    EXPECT_EQ(means[0].sets, 4U);
    EXPECT_DOUBLE_EQ(means[0].mean, 2.5);
    EXPECT_NEAR(means[0].high - 2.5, 3.182446 * std::sqrt(5.0 / 3 / 4), 1e-5);
    EXPECT_NE(error_of([&] { (void)means_of(values, 1); }), "");
}

TEST(Api, AStudyGivesWhatItsPartsGive) {
    const auto values = study({.generators = {"sobol", "random"},
                               .analyzers = {"star-discrepancy", "nearest-neighbor"},
                               .counts = {16, 32},
                               .first_seed = 3,
                               .seeds = 2});
    std::size_t found = 0;
    for (const StudyValue& v : values) {
        if (v.generator != "random" || v.key != "value" || v.count != 32 || v.seed != 4) continue;
        const PointSet set = generate("random", {.count = 32, .dimension = 2, .seed = 4});
        EXPECT_EQ(v.value, analyze("star-discrepancy", set).number("value"));
        ++found;
    }
    EXPECT_EQ(found, 1U);
}

}  // namespace stipple::testing::api_test
