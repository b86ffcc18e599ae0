// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/program.hpp"

namespace stipple::testing::reproduce_test {

using ::testing::HasSubstr;

namespace {

/// Expects the file to be identical.
void expect_identical(const Sandbox& box, const std::string& file) {
    const Outcome outcome = box.run({"reproduce", file});
    EXPECT_EQ(outcome.code, 0) << file << ": " << outcome.out << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_TRUE(outcome.out.starts_with(file + ": identical: ")) << outcome.out;
}

/// Verdict on a file that differs; exit code 1.
std::string difference(const Sandbox& box, const std::string& file) {
    const Outcome outcome = box.run({"reproduce", file});
    EXPECT_EQ(outcome.code, 1) << outcome.out << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return outcome.out;
}

std::string refusal(const Sandbox& box, const std::string& file, int code = 3) {
    const Outcome outcome = box.run({"reproduce", file});
    EXPECT_EQ(outcome.code, code) << outcome.out << outcome.err;
    EXPECT_EQ(outcome.out, "");
    return outcome.err;
}

void replace_in(const Sandbox& box, const std::string& file, const std::string& from,
                const std::string& to) {
    std::string text = box.read(file);
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from << " in " << text.substr(0, 600);
    box.write(file, text.replace(at, from.size(), to));
}

}  // namespace

// A search that was stopped early has no end that could be compared.
TEST(Reproduce, RefusesInterruptedSearchesAtOnce) {
    const Sandbox box;
    good(box.shell("stipple generate optimized -n 8 --effort 1 -o a.json"));
    expect_identical(box, "a.json");
    replace_in(box, "a.json", R"("found":{)", R"("found":{"ended":"interrupted",)");
    EXPECT_EQ(
        refusal(box, "a.json"),
        "stipple: a.json: its search was interrupted, and cannot be stopped at the same place "
        "again; the file is the only copy of its points; the whole search finds other ones\n");
}

// Every output with provenance can be reproduced, in any format and with any options.
TEST(Reproduce, MakesAgainWhatGenerateWrote) {
    const Sandbox box;
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"halton -n 500 -d 3 --start 7", "a.json"},
        {"halton -n 500", "b.csv"},
        {"sobol --scramble owen --seed 12 -n 256 -d 5 --no-header", "c.csv"},
        {"random --seed 18446744073709551615 -n 100", "d.txt"},
        {"random -n 100 -m 4", "e.csv"},
        {"random -n 100 -m 4", "f.txt"},
        {"random -n 100 -m 3", "g.jsonl"},
        {"random -n 100 -m 3", "h.npy"},
        {"random -n 100 -m 3", "i.json"},
        {"random -n 100 --dtype f32", "j.npy"},
        {"random -n 100 -d 3 -m 2", "k.f32"},
        {"random -n 100 --dtype f32", "l.bin"},
        {"random -n 300 --precision 4", "m.csv"},
        {"random -n 300 --precision 0", "n.json"},
        {"random -n 1000 --shard 1/3", "o.csv"},
        {"poisson-disk -n 200 --shard 1/3", "p.json"},
        {"poisson-disk -n 200 --bounds 0..4,0..3", "q.json"},
        {"poisson-disk --radius 0.1", "r.csv"},
        {"poisson-disk -n 100 -m 2", "s.json"},
        {"random -n 200 -w disk --with-pdf", "t.csv"},
        {"random -n 200 -w disk --with-pdf --with-weight -m 2", "u.json"},
        {"random -n 200 -w disk --with-weight", "v.txt"},
        {"random -n 200 -w disk:method=rejection", "w.csv"},
        {"sobol -n 64 -d 4 -w owen@1,2 -w 'triangle@3,4:vertices=[0,0 2,0 0,1]' -m 2", "x.csv"},
        {"random -n 50 -f psa", "y.any"},
        {"random -n 50 --with-pdf -w disk", "z.npy"},
        {"random -n 50 -d 3", "aa.ply"},
        {"random -n 50 --precision 5", "ab.ply"},
        {"random -n 50 -m 2 --dtype f32 -w disk --with-pdf", "ac.ply"},
        {"random -n 50 -w 'disk:center=[1,2]'", "ad.svg"},
        {"grid -n 100 --bounds 2..3", "ae.csv"},
        {"poisson-disk -n 90 --bounds 0..4,0..3 --with-pdf", "af.csv"},
        {"halton -n 20000", "ag.csv"},
        {"random -n 300000 --dtype f32", "ah.npy"},
        {"tiled -n 100 --tile-points 64 --iterations 2 -w 'triangle:vertices=[0,0 1,0 0,1]'",
         "it's here.txt"}};
    for (const auto& [options, file] : cases) {
        const Outcome made =
            box.shell("stipple generate " + options + " --meta --quiet -o \"" + file + "\"");
        ASSERT_EQ(made.code, 0) << options << made.err;
        expect_identical(box, file);
    }
}

TEST(Reproduce, KnowsTheSetsOfFilesOfTheirOwn) {
    const Sandbox box;
    good(box.shell("stipple generate jittered -n 100 -m 3 --seed 5 --meta -o 'set{set}.csv'"));
    good(box.shell("stipple generate poisson-disk -n 50 -m 3 --meta -o 'disks{seed}.csv'"));
    for (const char* file : {"set0.csv", "set1.csv", "set2.csv", "disks1.csv", "disks3.csv"})
        expect_identical(box, file);
}

TEST(Reproduce, KnowsTheSetsThatConvertPutIntoFilesOfTheirOwn) {
    const Sandbox box;
    good(box.shell(
        "stipple generate random -n 20 -m 3 --seed 40 -o a.json && stipple convert a.json -o "
        "'c{seed}.json' && stipple warp disk a.json -o 'w{set}.json' && stipple generate random "
        "-n 20 -d 3 -m 2 --meta -o 'p{set}.ply'"));
    for (const char* file :
         {"c40.json", "c41.json", "c42.json", "w0.json", "w2.json", "p0.ply", "p1.ply"})
        expect_identical(box, file);
}

// Follows warps and scrambles of later commands, and the truncation of digits in between.
TEST(Reproduce, FollowsLaterCommands) {
    const Sandbox box;
    good(
        box.shell("stipple generate sobol -n 128 -o a.json && stipple warp disk a.json -o b.json "
                  "&& stipple warp disk --inverse b.json -o c.json"));
    good(
        box.shell("stipple warp owen a.json --seed 9 -m 4 -o d.json && stipple warp owen a.json "
                  "--seed 9 -m 2 -o 'e{set}.json' && stipple convert d.json --meta -o f.csv"));
    good(
        box.shell("stipple generate random -n 100 --precision 3 -o g.json && stipple warp disk "
                  "g.json --with-pdf -o h.json && stipple convert h.json --precision 2 -o i.json"));
    for (const char* file : {"a.json", "b.json", "c.json", "d.json", "e0.json", "e1.json", "f.csv",
                             "g.json", "h.json"})
        expect_identical(box, file);
    EXPECT_THAT(good(box.run({"reproduce", "i.json"})), HasSubstr("2 digits after the point"));
}

TEST(Reproduce, NamesTheFirstDifference) {
    const Sandbox box;
    good(box.shell("stipple generate halton -n 10 --meta -o a.csv"));
    replace_in(box, "a.csv", "\n0.5,", "\n0.5000000000000001,");
    EXPECT_EQ(difference(box, "a.csv"),
              "a.csv: different: point 1, x: the file has 0.5000000000000001; made again it is "
              "0.5\n");
    good(box.shell("stipple generate random -n 3 -m 2 -o b.json"));
    std::string text = box.read("b.json");
    const auto last = text.rfind(',');
    box.write("b.json", text.replace(last, text.find(']', last) - last, ",0.25"));
    EXPECT_THAT(difference(box, "b.json"),
                HasSubstr("different: set 1, point 2, y: the file has 0.25; made again it is 0."));
    good(box.shell("stipple generate halton -n 10 --meta -o c.csv && sed -i '$d' c.csv"));
    EXPECT_THAT(difference(box, "c.csv"), HasSubstr("it has 9 points; made again it has 10"));
    good(box.shell("stipple generate halton -n 10 --meta -o d.csv && echo 0.5,0.5 >> d.csv"));
    EXPECT_THAT(difference(box, "d.csv"), HasSubstr("more than the 10 points"));
    // The count in a file's header is not used for the comparison.
    good(box.shell("stipple generate halton -n 10 -o f.jsonl && sed -i '$d' f.jsonl"));
    EXPECT_THAT(difference(box, "f.jsonl"), HasSubstr("it has 9 points; made again it has 10"));
    good(
        box.shell("stipple generate halton -n 10 -o g.jsonl && echo '[0.5,0.5]' >> g.jsonl && "
                  "stipple generate halton -n 3 -o h.json && sed -i '3d' h.json"));
    EXPECT_THAT(difference(box, "g.jsonl"), HasSubstr("more than the 10 points"));
    EXPECT_THAT(difference(box, "h.json"), HasSubstr("point 1, x: the file has 0.25"));
    for (const std::string file : {"k.csv", "k.txt", "k.json", "k.jsonl"}) {
        good(box.shell("stipple generate random -n 2 -w disk --with-pdf --with-weight --meta -o " +
                       file));
        replace_in(box, file, "0.3183098861837907", "0.3183098861837908");
        EXPECT_THAT(difference(box, file), HasSubstr("point 0, pdf"));
        replace_in(box, file, "0.3183098861837908", "0.3183098861837907");
        replace_in(box, file, "3.14159265358979", "3.14159265358978");
        EXPECT_THAT(difference(box, file), HasSubstr("point 0, weight"));
    }
    good(
        box.shell("stipple generate random -n 10 -f svg --meta -o e.svg && sed -i "
                  "'s/<circle cx=\"[0-9]/<circle cx=\"99/' e.svg"));
    EXPECT_THAT(difference(box, "e.svg"), HasSubstr("different: line "));
}

TEST(Reproduce, SpeaksToProgramsAndWritesThePoints) {
    const Sandbox box;
    good(
        box.shell("stipple generate random -n 10 --meta -o a.csv && stipple generate random -n 10 "
                  "-o b.csv"));
    const auto same = nlohmann::json::parse(good(box.run({"reproduce", "a.csv", "--json"})));
    EXPECT_EQ(same["format"], "stipple.reproduction");
    EXPECT_EQ(same["identical"], true);
    EXPECT_EQ(same["points"], 10);
    EXPECT_EQ(same["command"], "stipple generate random --count 10 --meta");
    good(
        box.shell("stipple reproduce a.csv -o again.csv && cmp a.csv again.csv && stipple "
                  "reproduce a.csv -o again.npy && stipple convert again.npy -o c.csv && cmp b.csv "
                  "c.csv"));
    EXPECT_EQ(box.shell("stipple reproduce a.csv -o - 2>/dev/null | cmp - a.csv").code, 0);
    EXPECT_EQ(good(box.shell("cat a.csv | stipple reproduce -")),
              "stdin: identical: 10 points of 2 coordinates\n");
    EXPECT_THAT(good(box.shell("stipple reproduce <(cat a.csv)")),
                HasSubstr(": identical: 10 points of 2 coordinates\n"));
    EXPECT_EQ(box.run({"reproduce", "a.csv", "-o", "no/where.csv"}).code, 4);
    replace_in(box, "a.csv", "\n0.", "\n0.0");
    const Outcome other = box.run({"reproduce", "a.csv", "--json"});
    EXPECT_EQ(other.code, 1);
    const auto verdict = nlohmann::json::parse(other.out);
    EXPECT_EQ(verdict["identical"], false);
    EXPECT_EQ(verdict["difference"]["point"], 0);
    EXPECT_EQ(verdict["difference"]["coordinate"], "x");
}

// Provenance distinguishes a given radius from a computed one; its options contain both.
TEST(Reproduce, TellsWhatWasAskedFromWhatWasFound) {
    const Sandbox box;
    good(box.shell("stipple generate poisson-disk -n 200 -o a.json"));
    const auto meta = nlohmann::json::parse(box.read("a.json"))["meta"];
    ASSERT_TRUE(meta["options"].contains("radius"));
    EXPECT_EQ(meta["command"].get<std::string>().find("--radius"), std::string::npos);
    expect_identical(box, "a.json");
    replace_in(box, "a.json", "\"radius\":0.", "\"radius\":0.9");
    const Outcome outcome = box.run({"reproduce", "a.json"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_THAT(outcome.err, HasSubstr("radius 0.9"));
}

// Programs that use the library do not record a command.
TEST(Reproduce, DoesWithoutACommand) {
    const Sandbox box;
    good(
        box.shell("stipple generate halton -n 100 -d 3 --start 7 -o a.json && stipple generate "
                  "random -n 50 --seed 3 -w owen -w 'triangle:vertices=[0,0 1,0 0,1]' -o b.json"));
    good(box.shell(
        "stipple generate halton --start 1 -n 64 -d 4 -w sphere@1,2 -w normal@4 -o d.json && "
        "stipple generate halton -n 60 -d 5 -f json | stipple warp owen --seed 4 -f json | "
        "stipple warp disk@2,3 -o e.json && stipple warp disk@2,3 --inverse e.json -o f.json && "
        "stipple warp owen f.json -f json | stipple warp sphere@1,2 -o g.json"));
    for (const char* file : {"a.json", "b.json", "d.json", "e.json", "f.json", "g.json"}) {
        replace_in(box, file, "\"command\":\"stipple generate", "\"command\":\"");
        expect_identical(box, file);
    }
    good(box.shell("stipple generate halton -n 100 --shard 0/2 -o c.json"));
    replace_in(box, "c.json", "\"command\":\"stipple generate", "\"command\":\"");
    EXPECT_THAT(refusal(box, "c.json"), HasSubstr("no command, which a part of a set needs"));
}

TEST(Reproduce, NoticesFilesThatAreGoneOrChanged) {
    const Sandbox box;
    good(
        box.shell("stipple generate void-and-cluster -n 64 --size 16x16 --mask-image m.png -o "
                  "v.csv && stipple generate lloyd -n 30 --iterations 3 --density m.png -o l.json "
                  "&& stipple generate random -n 50 -w image:file=m.png --meta -o i.csv"));
    expect_identical(box, "m.png");
    for (const char* file : {"l.json", "i.csv"}) {
        // A file is not read only because another file names it.
        EXPECT_THAT(refusal(box, file), HasSubstr("made from 'm.png', which is read only if "
                                                  "--input allows it; give it with --input m.png"));
        good(box.run({"reproduce", file, "--input", "m.png"}));
        good(box.shell("cp m.png other.png"));
        good(box.run({"reproduce", file, "--input", "other.png"}));
        EXPECT_EQ(box.run({"reproduce", file, "--input", "none.png"}).code, 4);
    }
    good(
        box.shell("stipple generate void-and-cluster -n 64 --size 16x16 --seed 2 --mask-image "
                  "n.png -o v.csv; mv m.png old.png; mv n.png m.png"));
    for (const char* file : {"l.json", "i.csv"}) {
        const Outcome changed = box.run({"reproduce", file, "--input", "m.png"});
        EXPECT_EQ(changed.code, 3);
        EXPECT_THAT(changed.err, HasSubstr("made from 'm.png', which has changed since"));
        good(box.run({"reproduce", file, "--input", "old.png"}));
    }
    // A pipe is read once, by the generator.
    good(
        box.shell("stipple generate random -n 40 | stipple generate lloyd --iterations 2 --from "
                  "/dev/stdin -o s.json"));
    EXPECT_THAT(refusal(box, "s.json"), HasSubstr("'/dev/stdin', a pipe that is not kept"));
}

TEST(Reproduce, ComparesPicturesByTheirPixels) {
    const Sandbox box;
    good(
        box.shell("stipple generate void-and-cluster -n 16 --size 8x8 -m 2 --mask-image "
                  "'m{set}.png' -o 'v{set}.csv'"));
    for (const char* file : {"m0.png", "m1.png"}) expect_identical(box, file);
    // Combines the second picture's pixels with the first one's provenance: chunks are header,
    // text, pixels.
    std::string one = box.read("m0.png");
    const std::string two = box.read("m1.png");
    box.write("mixed.png", one.substr(0, one.find("IDAT") - 4) + two.substr(two.find("IDAT") - 4));
    EXPECT_THAT(difference(box, "mixed.png"), HasSubstr("different: column "));
}

TEST(Reproduce, SaysThatRulesChanged) {
    const Sandbox box;
    good(box.shell("stipple generate random -n 10 -w owen -o a.json && cp a.json b.json"));
    replace_in(box, "a.json", "\"command\"", "\"stream_versions\":{\"random\":2},\"command\"");
    EXPECT_THAT(difference(box, "a.json"),
                HasSubstr("a.json: the rules of random changed: the file is of stream version 2"));
    replace_in(box, "b.json", "\"command\"", "\"stream_versions\":{\"owen\":7},\"command\"");
    EXPECT_THAT(difference(box, "b.json"), HasSubstr("the rules of owen changed"));
    // Another version of stipple with the same stream versions makes the same points.
    good(box.shell("stipple generate random -n 10 -o c.json"));
    replace_in(box, "c.json", "\"version\":\"0.1.0\"", "\"version\":\"9.8.7\"");
    expect_identical(box, "c.json");
    replace_in(box, "c.json", "\"points\":[\n[0.", "\"points\":[\n[0.0");
    EXPECT_THAT(difference(box, "c.json"), HasSubstr("(made by stipple 9.8.7; this is 0.1.0)"));
}

TEST(Reproduce, RefusesWhatTellsNothing) {
    const Sandbox box;
    good(box.shell(
        "stipple generate random -n 10 -o a.csv && stipple generate random -n 10 -o a.npy "
        "&& stipple generate random -n 10 -o a.svg && stipple generate random -n 10 | "
        "stipple analyze moments > r.json && stipple generate random -n 10 -o b.json && "
        "stipple generate random -n 10 -o a.bin && stipple generate random -n 5 --seed 3 -m 2 -o "
        "c.json"));
    for (const char* file : {"a.csv", "a.npy", "a.svg", "a.bin"})
        EXPECT_THAT(refusal(box, file),
                    HasSubstr("it does not record how its points were made; json and jsonl always "
                              "record it; generate --meta"));
    EXPECT_THAT(refusal(box, "r.json"), HasSubstr("r.json: it holds results of analyze"));
    EXPECT_THAT(refusal(box, "missing.json", 4), HasSubstr("missing.json"));
    EXPECT_EQ(box.run({"reproduce"}).code, 2);
    EXPECT_EQ(box.run({"reproduce", "a.csv", "a.npy"}).code, 2);
    box.write("a.npy.meta.json", "{}");
    EXPECT_THAT(refusal(box, "a.npy"), HasSubstr("a.npy.meta.json: no provenance"));
    replace_in(box, "b.json", "\"generator\":\"random\"", "\"generator\":\"rondom\"");
    EXPECT_THAT(refusal(box, "b.json"),
                HasSubstr("b.json: this stipple (0.1.0) cannot follow its provenance: unknown "
                          "generator 'rondom'; did you mean 'random'?"));
    replace_in(box, "c.json", "--seed 3", "--seed 4");
    EXPECT_THAT(refusal(box, "c.json"),
                HasSubstr("its command makes 2 sets from one of seed 4, its seed is 3"));
}

TEST(Reproduce, SaysWhatFilesWithoutPointsAre) {
    const Sandbox box;
    good(box.shell(
        "stipple generate random -n 20 -o a.csv && stipple report a.csv -o r.html && "
        "stipple report a.csv -o r.json && stipple analyze moments a.csv -o m.csv && "
        "stipple generate halton -n 9 --meta -o h.npy && for t in csv jsonl; do stipple study "
        "--generators halton,random -n 9 --seeds 2 --analyze moments --summary -o s.$t; done"));
    for (const char* file : {"r.html", "r.json"})
        EXPECT_THAT(refusal(box, file),
                    HasSubstr("a report about points, which it does not contain; it names the "
                              "command that makes it again"));
    for (const char* file : {"s.csv", "s.jsonl", "s.summary.csv", "s.summary.jsonl",
                             "s.comparisons.csv", "s.comparisons.jsonl"})
        EXPECT_THAT(refusal(box, file),
                    AllOf(HasSubstr("a table of a study, without points; the command in"),
                          HasSubstr("'stipple generate' with a row's generator")));
    EXPECT_THAT(refusal(box, "m.csv"), HasSubstr("m.csv: it holds results of analyze"));
    EXPECT_THAT(refusal(box, "h.npy.meta.json"), HasSubstr("reproduce takes the file of points"));
}

TEST(Reproduce, MakesThePointsOfAPictureAgain) {
    const Sandbox box;
    good(box.shell(
        "stipple generate random -n 20 -w 'disk:center=[1,2]' -o p.json && stipple "
        "generate random -n 20 -o bare.csv && for f in svg png pdf; do stipple plot p.json "
        "--title '<&é𝄞>' -o p.$f && stipple plot bare.csv -o bare.$f; done"));
    for (const std::string format : {"svg", "png", "pdf"}) {
        EXPECT_THAT(
            refusal(box, "p." + format),
            HasSubstr("it was drawn by 'stipple plot p.json --title '<&é𝄞>'' of the points of "
                      "'stipple generate random"));
        EXPECT_EQ(box.run({"reproduce", "p." + format, "-o", format + ".csv"}).code, 0);
        EXPECT_EQ(box.read(format + ".csv"), good(box.run({"convert", "p.json", "-f", "csv"})));
        EXPECT_THAT(refusal(box, "bare." + format),
                    HasSubstr("drawn by 'stipple plot bare.csv', of no single set with "
                              "provenance"));
    }
}

/// Options of the kind's units whose text is a file name.
std::vector<std::pair<std::string, std::string>> file_options(const std::string& kind) {
    const Sandbox box;
    std::vector<std::pair<std::string, std::string>> found;
    const auto units = nlohmann::json::parse(good(box.run({"list", kind, "--json"})));
    for (const auto& unit : units[kind])
        for (const auto& option : unit["options"])
            if (option["type"] == "file") found.emplace_back(unit["name"], option["name"]);
    return found;
}

// Options that write side files are not part of the recipe, nor is the output format.
TEST(Reproduce, NeedsNoOptionsThatOnlyWriteFiles) {
    for (const std::string make :
         {"rank1-lattice -n 64 -d 3 --vector-output side.txt --vector-format latnet-builder",
          "rank1-lattice -n 64 -d 3 --vector-output side.txt",
          "polynomial-lattice -n 64 -d 3 --vector-output side.txt --vector-format lddata",
          "void-and-cluster -n 64 --mask-image side.png"})
        for (const std::string file : {"p.json", "p.csv --meta", "p.npy --meta"}) {
            const Sandbox box;
            good(box.shell("stipple generate -q " + make + " -o " + file + " && rm side.*"));
            const std::string name = file.substr(0, file.find(' '));
            EXPECT_THAT(good(box.run({"reproduce", name})), HasSubstr(": identical: 64 points"));
            const auto files = box.files();
            EXPECT_TRUE(std::ranges::none_of(files, [](const std::string& f) {
                return f.starts_with("side");
            })) << make;
        }
}

// An untrusted file may name other files in any option, in its command, options or warps. They are
// neither read nor written.
TEST(Reproduce, OpensNoFileThatItsProvenanceNames) {
    const auto of_generators = file_options("generators");
    const auto of_warps = file_options("warps");
    ASSERT_GE(of_generators.size(), 9U);
    ASSERT_GE(of_warps.size(), 4U);
    const auto versions = nlohmann::json::parse(good(Sandbox().run({"list", "--json"})));
    std::string rules;  // current stream versions
    for (const char* kind : {"generators", "warps"})
        for (const auto& unit : versions[kind])
            rules += (rules.empty() ? "" : ",") + unit["name"].dump() + ":" +
                     unit["stream_version"].dump();
    const auto expect_refused = [&rules](const std::string& meta) {
        const Sandbox box;
        box.write("canary", "precious");
        box.write("a.json",
                  R"({"format":"stipple.points","version":1,"meta":{"seed":1,"dimension":2,)"
                  R"("stream_versions":{)" +
                      rules + "}," + meta + R"(},"dimension":2,"count":1,"points":[[0.5,0.5]]})");
        const Outcome outcome = box.run({"reproduce", "a.json", "-o", "again.csv"});
        const bool only_writes = meta.find("output") != std::string::npos ||
                                 meta.find("mask-image") != std::string::npos;
        EXPECT_EQ(outcome.code, only_writes ? 1 : 3) << meta << outcome.out << outcome.err;
        if (!only_writes) {
            EXPECT_THAT(outcome.err,
                        ::testing::AnyOf(HasSubstr("'canary'"), HasSubstr("contradicts --count"),
                                         HasSubstr("the number of new points is missing")))
                << meta;
        }
        EXPECT_EQ(box.read("canary"), "precious");
        auto files = box.files();
        std::erase(files, "again.csv");
        EXPECT_EQ(files, (std::vector<std::string>{"a.json", "canary"}));
    };
    for (const auto& [unit, option] : of_generators) {
        const std::string generator = "\"generator\":\"" + unit + "\"";
        expect_refused(generator + ",\"command\":\"stipple generate " + unit + " --" + option +
                       " canary\"");
        expect_refused(generator + ",\"count\":1,\"options\":{\"" + option + "\":\"canary\"}");
    }
    for (const auto& [unit, option] : of_warps) {
        const std::string warp = unit + ":" + option + "=canary";
        const std::string random = "\"generator\":\"random\",\"warps\":[\"";
        expect_refused(random + warp + "\"],\"count\":1");
        expect_refused(random + "mixture:components=[sphere|" + warp + "]\"],\"count\":1");
        expect_refused(random + warp + "\"],\"command\":\"stipple generate random -n 1\"");
    }
}

// A provenance cannot contain values that the command line rejects.
TEST(Reproduce, RefusesValuesThatNoneCanHave) {
    const Sandbox box;
    good(box.shell("stipple generate random -n 10 --meta -o a.csv"));
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"seed: 1", "seed: 18446744073709551616"},
        {"seed: 1", "seed: -1"},
        {"seed: 1", "seed: 1e999"},
        {"count: 10", "count: -1"},
        {"count: 10", "count: 1e308"},
        {"warps: []", "warps: [3]"},
        {"start: 0", "start: \"0\""}};
    for (const auto& [was, is] : cases) {
        good(box.shell("cp a.csv b.csv"));
        replace_in(box, "b.csv", was, is);
        const std::string key = was.substr(0, was.find(':'));
        EXPECT_THAT(refusal(box, "b.csv"), HasSubstr("its " + key + " cannot be '")) << is;
    }
    // Also in options that are missing from the command.
    for (const char* option : {"\"mask\":\"m.png\"", "\"cell\":\"nowhere\""}) {
        good(box.shell("stipple generate void-and-cluster -n 16 --size 8x8 -o c.json"));
        replace_in(box, "c.json", "\"cell\":\"center\"", option);
        EXPECT_THAT(refusal(box, "c.json"), HasSubstr("cannot follow its provenance")) << option;
    }
}

TEST(Reproduce, LeavesNoFiles) {
    const Sandbox box;
    good(
        box.shell("stipple generate void-and-cluster -n 16 --size 8x8 --mask-image m.png -o v.json "
                  "&& rm m.png"));
    expect_identical(box, "v.json");
    EXPECT_EQ(box.files(), std::vector<std::string>{"v.json"});
}

// npy, bin and psa cannot store provenance; it is in a file beside them.
TEST(Meta, StandsBesideFormatsWithoutAPlaceForIt) {
    const Sandbox box;
    good(box.shell("stipple generate random -n 10 --meta -o a.npy"));
    EXPECT_EQ(box.files(), (std::vector<std::string>{"a.npy", "a.npy.meta.json"}));
    const auto beside = nlohmann::json::parse(box.read("a.npy.meta.json"));
    EXPECT_EQ(beside["format"], "stipple.meta");
    EXPECT_EQ(beside["of"], "npy");
    EXPECT_EQ(beside["meta"]["generator"], "random");
    const Outcome piped = box.shell("stipple generate random -n 10 --meta -f npy | wc -c");
    EXPECT_EQ(piped.code, 0);
    EXPECT_THAT(piped.err, HasSubstr("--meta: the format npy cannot hold provenance"));
}

}  // namespace stipple::testing::reproduce_test
