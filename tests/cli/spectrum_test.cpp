// SPDX-License-Identifier: MIT
//
// Power spectra on the command line: sets without files, weights, windows, pictures, wisdom.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "math/fourier/fft.hpp"
#include "media/png_picture.hpp"
#include "support/program.hpp"

namespace stipple::testing::spectrum_test {

using nlohmann::json;
using ::testing::HasSubstr;

namespace {

json report_of(const Outcome& outcome) {
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return json::parse(outcome.out);
}

void expect_error(const Outcome& outcome, int code, const std::string& words) {
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(words));
    EXPECT_EQ(outcome.out, "");
}

}  // namespace

// Sets from files, from a pipe and directly from the generator give the same spectrum.
TEST(Spectrum, OfGeneratedSetsIsThatOfTheirFiles) {
    const Sandbox box;
    for (const std::string analyzer : {"periodogram", "nearest-neighbor", "moments"}) {
        const std::string rest = " --average --format json";
        json piped = report_of(box.shell(
            "stipple generate random -n 500 -m 5 -s 3 | stipple analyze " + analyzer + rest));
        json made = report_of(box.shell("stipple analyze " + analyzer +
                                        " --generate random -n 500 -m 5 -s 3" + rest));
        EXPECT_EQ(made["results"], piped["results"]) << analyzer;
        EXPECT_EQ(made["standard_error"], piped["standard_error"]) << analyzer;
        EXPECT_EQ(made["input"]["source"], "random");
    }
}

TEST(Spectrum, OfGeneratedSetsTakesOptionsWarpsAndStart) {
    const Sandbox box;
    const auto both = [&](const std::string& words, const std::string& spec,
                          const std::string& rest, const std::string& judge) {
        const json piped = report_of(box.shell("stipple generate " + words + " " + rest +
                                               " -f json | stipple analyze " + judge));
        const json made =
            report_of(box.shell("stipple analyze " + judge + " --generate " + spec + " " + rest));
        EXPECT_EQ(made["results"], piped["results"]) << words;
        EXPECT_EQ(made["input"]["domain"], piped["input"]["domain"]) << words;
    };
    both("halton --scramble owen", "halton:scramble=owen", "-n 300 --start 7 -s 9",
         "star-discrepancy");
    both("random", "random", "-n 3000 -w disk", "moments");
    both("poisson-disk", "poisson-disk", "-n 200 -d 2", "periodogram");
}

TEST(Spectrum, StandardErrorsAreGivenForEveryBin) {
    const Sandbox box;
    const json report =
        report_of(box.shell("stipple analyze periodogram --generate "
                            "sobol:scramble=owen -n 256 -m 50 --average"));
    EXPECT_EQ(report["standard_error"]["radial"]["power"].size(),
              report["results"]["radial"]["power"].size());
    EXPECT_NEAR(report["results"]["expected_anisotropy_db"], -10 * std::log10(50), 1e-12);
}

TEST(Spectrum, SetsOfDifferentSizesHaveAMeanWhichIsSaid) {
    const Sandbox box;
    box.write("a.csv", box.run({"generate", "random", "-n", "400"}).out);
    box.write("b.csv", box.run({"generate", "random", "-n", "100"}).out);
    const Outcome mean = box.run({"analyze", "periodogram", "a.csv", "b.csv", "--pool"});
    EXPECT_EQ(report_of(mean)["results"]["max_frequency"], 40);
    EXPECT_THAT(mean.err, HasSubstr("differ in their number of points; all are measured with "
                                    "--max-frequency 40, as the first\n"));
    EXPECT_THAT(
        box.run({"analyze", "periodogram", "a.csv", "b.csv", "--pool", "--max-frequency", "8"}).err,
        HasSubstr("differ in their number of points\n"));
}

// More text than the reader's buffer: the sets are read completely, one after the other.
TEST(Spectrum, ManySetsInOnePipeComeOneAfterTheOther) {
    const Sandbox box;
    const std::string make = "stipple generate random -n 20000 -m 8";
    const std::string judge = " | stipple analyze moments --average --format json";
    EXPECT_EQ(report_of(box.shell(make + judge))["results"],
              report_of(box.shell(make + " -f npy" + judge))["results"]);
    expect_error(box.shell("(" + make + "; echo 0,0.5,0.5) | stipple analyze moments"), 3,
                 "set 0 begins again");
}

TEST(Spectrum, WeightsAreAColumn) {
    const Sandbox box;
    box.write("w.csv", "x,s,y\n0,2,0\n0.5,-1,0\n");
    const json report = report_of(box.run({"analyze", "periodogram", "w.csv", "--weights", "s",
                                           "--max-frequency", "4", "--grid", "g.npy"}));
    EXPECT_EQ(report["input"]["dimension"], 2);
    EXPECT_EQ(report["options"]["weights"], "s");
    EXPECT_THAT(box.read("g.npy"), HasSubstr("'shape': (9, 9)"));
    const auto weights = [&](const std::string& column) {
        return box.run({"analyze", "periodogram", "w.csv", "--weights", column});
    };
    EXPECT_EQ(weights("2").code, 0);
    expect_error(weights("mass"), 2, "--weights: w.csv:1 has no column 'mass'");
    box.write("w.csv", "x,y,s\n0,0,1\n0.5,0,nan\n");
    expect_error(weights("s"), 3, "w.csv:3:7: 'nan' is not finite");
    expect_error(box.run({"analyze", "periodogram", "--generate", "random", "--weights", "s"}), 2,
                 "--weights: generated points have no weight column");
}

TEST(Spectrum, PicturesTellTheirScale) {
    const Sandbox box;
    for (const std::string scale : {"ratio", "linear", "log"})
        for (const std::string bits : {"8", "16"}) {
            report_of(box.run({"analyze", "periodogram", "--generate", "random", "-n", "200",
                               "--max-frequency", "10", "--image", "p.png", "--image-scale", scale,
                               "--image-bits", bits}));
            const std::string bytes = box.read("p.png");
            EXPECT_THAT(bytes, HasSubstr("grey = ")) << scale;
            const PngPicture picture = read_png(bytes, "p.png", {});
            ASSERT_EQ(picture.width, 21U);
            EXPECT_EQ(picture.grey[10 * 21 + 10], 0);
            for (std::size_t i = 0; i < picture.grey.size(); ++i)
                EXPECT_NEAR(picture.grey[i], picture.grey[picture.grey.size() - 1 - i], 1e-12);
        }
}

TEST(Spectrum, OfSpaceIsACubeAndItsSlices) {
    const Sandbox box;
    report_of(
        box.run({"analyze", "periodogram", "--generate", "random", "-d", "3", "-n", "100",
                 "--max-frequency", "5", "--grid", "g.npy", "--image", "p.png", "--slice", "2"}));
    EXPECT_THAT(box.read("g.npy"), HasSubstr("'shape': (11, 11, 11)"));
    EXPECT_THAT(box.read("p.png"), HasSubstr("Plane fz = 2."));
    EXPECT_GT(read_png(box.read("p.png"), "p.png", {}).grey[60], 0) << "frequency 0 is elsewhere";
    expect_error(box.run({"analyze", "periodogram", "--generate", "random", "-d", "3", "-n", "100",
                          "--max-frequency", "5", "--image", "p.png", "--slice", "6"}),
                 2, "--slice: 6 is outside [-5, 5]");
}

TEST(Spectrum, FilesAreOfTheFormatThatTheyAreNamedFor) {
    const Sandbox box;
    const auto write = [&](const std::vector<std::string>& files) {
        std::vector<std::string> words = {"analyze", "periodogram", "--generate", "random"};
        words.insert(words.end(), files.begin(), files.end());
        return box.run(words);
    };
    expect_error(write({"--image", "p.jpg"}), 2, "--image: writes .png; 'p.jpg' has another name");
    expect_error(write({"--grid", "g.csv"}), 2, "--grid: writes .npy; 'g.csv' has another name");
    expect_error(write({"--grid", "g.npy", "-o", "g.npy", "-f", "json"}), 2,
                 "--grid: --output writes g.npy");
    EXPECT_EQ(box.files(), std::vector<std::string>{});
    report_of(write({"--image", "/dev/null", "--grid", "/dev/null"}));
}

TEST(Spectrum, AMeanOverSizesSaysWhichTheyAre) {
    const Sandbox box;
    const auto mean = box.shell(
        "stipple generate random -n 40 -o a.csv && stipple generate random -n 90 -o b.csv && "
        "stipple analyze periodogram b.csv a.csv --pool -o m.json");
    EXPECT_THAT(mean.err, HasSubstr("differ in their number of points"));
    const json input = json::parse(box.read("m.json")).at("input");
    EXPECT_EQ(input.at("count"), 40);
    EXPECT_EQ(input.at("largest_count"), 90);
}

TEST(Spectrum, WisdomIsWrittenAndRead) {
    const Sandbox box;
    const auto run = [&] {
        return box.run(
            {"analyze", "periodogram", "--generate", "random", "-n", "50", "--wisdom", "w.txt"});
    };
    if (!fft_library().starts_with("fftw"))
        return expect_error(run(), 2, "--wisdom: w.txt is for FFTW; this program uses");
    const json first = report_of(run());
    EXPECT_THAT(box.read("w.txt"), HasSubstr("fftw"));
    const json second = report_of(run());
    for (std::size_t i = 0; i < first["results"]["radial"]["power"].size(); ++i)
        EXPECT_NEAR(first["results"]["radial"]["power"][i].get<double>(),
                    second["results"]["radial"]["power"][i].get<double>(), 1e-8);
    box.write("w.txt", "words");
    expect_error(run(), 3, "w.txt: not a wisdom file of fftw");
}

TEST(Spectrum, RefusesWhatDoesNotGoTogether) {
    const Sandbox box;
    const auto refused = [&](const std::string& words, int code, const std::string& why) {
        expect_error(box.shell("stipple analyze periodogram " + words + " < /dev/null"), code, why);
    };
    refused("-n 100", 2, "--count: requires --generate, which is not given");
    refused("--generate random p.csv", 4, "p.csv");
    refused("--generate random --bounds 0..1", 2, "--bounds: applies to points from files");
    refused("--generate randon", 2, "unknown generator 'randon'");
    refused("--generate random -n 1", 3, "periodogram needs at least 2 points; there is 1");
    refused("--generate random --max-frequency 0", 2, "--max-frequency: 0 is outside [1, 1000000]");
    refused("--generate random --max-frequency 100000 --max-memory 2G", 5,
            "--max-frequency 100000 needs ");
    refused("--generate random -d 4", 3, "periodogram requires points of dimension 1 to 3");
}

}  // namespace stipple::testing::spectrum_test
