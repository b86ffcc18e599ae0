// SPDX-License-Identifier: MIT
//
// Makes packages, unpacks and runs them; scripts/packages lets a system install them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/text.hpp"
#include "math/fourier/fft.hpp"
#include "places.hpp"
#include "support/program.hpp"

namespace stipple::testing::package_test {

using ::testing::HasSubstr;

namespace {

/// Checks the program, its manual, completions and documents below a prefix.
void expect_whole(const Sandbox& box, const std::string& prefix) {
    for (const char* file :
         {"bin/stipple", "share/man/man1/stipple.1.gz", "share/man/man1/stipple-generate.1.gz",
          "share/man/man7/stipple-formats.7.gz", "share/bash-completion/completions/stipple",
          "share/zsh/site-functions/_stipple", "share/fish/vendor_completions.d/stipple.fish",
          "share/doc/stipple/copyright", "share/doc/stipple/changelog.gz",
          "share/doc/stipple/README.md", "include/stipple/stipple.hpp"})
        EXPECT_TRUE(box.exists(prefix + "/" + file)) << file;
    EXPECT_THAT(box.read(prefix + "/share/doc/stipple/copyright"), HasSubstr("Random123/*"));
    const std::string links = good(box.shell("cd " + prefix +
                                             "/share/doc/stipple && grep -o "
                                             "'](\\w[^):]*)' README.md | tr -d ']()'"));
    for (const auto file : split(trim(links), '\n'))
        EXPECT_TRUE(box.exists(prefix + "/share/doc/stipple/" + std::string(file))) << file;
    const std::string program = box.path().string() + "/" + prefix + "/bin/stipple";
    // The expected value 6511/129600 is known by hand.
    EXPECT_THAT(good(box.shell(program + " generate halton -n 100 --start 1 | " + program +
                               " analyze star-discrepancy --format csv")),
                HasSubstr("0.05023"));
}

/// Installs and removes the package with dpkg, in a root directory without any other package.
void expect_that_dpkg_takes_it(const Sandbox& box) {
    const std::string dpkg =
        "mkdir -p root/var/lib/dpkg/info root/var/lib/dpkg/updates && touch "
        "root/var/lib/dpkg/status && dpkg --root=$PWD/root --force-depends "
        "--force-script-chrootless --log=/dev/null ";
    const Outcome installed =
        box.shell(dpkg + "--install made/stipple_*.deb made/libstipple-dev_*.deb");
    ASSERT_EQ(installed.code, 0) << installed.err;
    EXPECT_THAT(good(box.shell("root/usr/bin/stipple --version")), HasSubstr("stipple "));
    EXPECT_TRUE(box.exists("root/usr/lib/libstipple.a"));
    ASSERT_EQ(box.shell(dpkg + "--remove stipple libstipple-dev").code, 0);
    EXPECT_FALSE(box.exists("root/usr"));
}

}  // namespace

TEST(Package, OfDebianAndAsArchiveAreWholeAndRun) {
    if (sanitized()) GTEST_SKIP() << "the package is that of plain builds";
    const Sandbox box;
    if (box.shell("command -v dpkg-shlibdeps && command -v dpkg-deb").code != 0)
        GTEST_SKIP() << "Debian's tools are not installed";
    const Outcome made =
        box.shell("cpack --config " STIPPLE_BINARY_DIR "/CPackConfig.cmake -B made");
    ASSERT_EQ(made.code, 0) << made.out << made.err;
    const Outcome unpacked = box.shell(
        "mkdir tar && for package in made/*.deb; do dpkg -x $package deb; done && "
        "tar -xzf made/*.tar.gz -C tar --strip-components=1");
    ASSERT_EQ(unpacked.code, 0) << unpacked.err;
    expect_whole(box, "deb/usr");
    expect_whole(box, "tar");
    const auto depends = [&](const std::string& package) {
        EXPECT_TRUE(box.exists("deb/usr/share/doc/" + package + "/copyright")) << package;
        return good(box.shell("dpkg-deb --field made/" + package + "_*.deb Depends"));
    };
    EXPECT_EQ(
        good(box.shell("for p in made/*.deb; do dpkg-deb -f $p Description | head -n 1; done | "
                       "sort | uniq -d")),
        "");
    for (const char* library : {"libc6", "libfmt", "libtbb", "libzstd"})
        EXPECT_THAT(depends("stipple"), HasSubstr(library));
    for (const char* needed : {"libfmt-dev", "libtbb-dev", "libpng-dev"})
        EXPECT_THAT(depends("libstipple-dev"), HasSubstr(needed));
    if (box.exists("deb/usr/lib/python3")) {
        const std::string version =
            good(box.shell("PYTHONPATH=deb/usr/lib/python3/dist-packages python3 -c 'import "
                           "importlib.metadata as m; print(m.version(\"stipple\"), end=\"\")'"));
        EXPECT_THAT(good(box.run({"--version"})), HasSubstr("stipple " + version));
        const std::string about =
            good(box.shell("cat deb/usr/lib/python3/dist-packages/*/METADATA"));
        for (const char* part :
             {"\nAuthor: The stipple authors\n", "\nKeywords: quasi-Monte Carlo,",
              "\n\nA program, C++ library and Python module that makes"})
            EXPECT_THAT(about, HasSubstr(part));
        for (const char* needed : {"python3 (<< ", "python3-numpy"})
            EXPECT_THAT(depends("python3-stipple"), HasSubstr(needed));
    }
    const bool fftw = fft_library().starts_with("fftw");
    EXPECT_EQ(depends("stipple").find("libfftw3-double3") != std::string::npos, fftw);
    EXPECT_EQ(depends("libstipple-dev").find("libfftw3-dev") != std::string::npos, fftw);
    EXPECT_THAT(box.read("deb/usr/share/doc/stipple/copyright"),
                HasSubstr(fftw ? "GPL-2" : "Max-Planck-Society"));
    EXPECT_THAT(good(box.shell("dpkg-deb --contents made/stipple_*.deb")),
                HasSubstr("-rwxr-xr-x root/root"));
    if (box.shell("test $(id -u) = 0").code == 0) expect_that_dpkg_takes_it(box);
}

TEST(Package, IsInstalledWithoutFilesInTheBuildFolder) {
    if (sanitized()) GTEST_SKIP() << "what is installed is that of plain builds";
    const Sandbox box;
    good(box.shell("touch before && cmake --install " STIPPLE_BINARY_DIR " --prefix $PWD/there"));
    expect_whole(box, "there");
    EXPECT_EQ(good(box.shell("find " STIPPLE_BINARY_DIR "/src " STIPPLE_BINARY_DIR
                             "/words -newer before")),
              "");
}

}  // namespace stipple::testing::package_test
