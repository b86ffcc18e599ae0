// SPDX-License-Identifier: MIT
//
// Packages, made, unpacked and run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "places.hpp"
#include "support/program.hpp"

namespace stipple::testing::package_test {

using ::testing::HasSubstr;

namespace {

/// The program, its manual, its completions and its papers, below a prefix.
void expect_whole(const Sandbox& box, const std::string& prefix) {
    for (const char* file :
         {"bin/stipple", "share/man/man1/stipple.1.gz", "share/man/man1/stipple-generate.1.gz",
          "share/man/man7/stipple-formats.7.gz", "share/bash-completion/completions/stipple",
          "share/zsh/site-functions/_stipple", "share/fish/vendor_completions.d/stipple.fish",
          "share/doc/stipple/copyright", "share/doc/stipple/changelog.gz",
          "include/stipple/stipple.hpp"})
        EXPECT_TRUE(box.exists(prefix + "/" + file)) << file;
    EXPECT_THAT(box.read(prefix + "/share/doc/stipple/copyright"), HasSubstr("MIT License"));
    const std::string program = box.path().string() + "/" + prefix + "/bin/stipple";
    // 6511/129600, known by hand.
    EXPECT_THAT(good(box.shell(program + " generate halton -n 100 --start 1 | " + program +
                               " analyze star-discrepancy --format csv")),
                HasSubstr("0.05023"));
    EXPECT_THAT(good(box.shell("dpkg-deb --contents made/*.deb")),
                HasSubstr("-rwxr-xr-x root/root"));
}

/// dpkg itself puts it down, into a system of its own that knows no other package, and takes it
/// away.
void expect_that_dpkg_takes_it(const Sandbox& box) {
    const std::string dpkg =
        "mkdir -p root/var/lib/dpkg/info root/var/lib/dpkg/updates && touch "
        "root/var/lib/dpkg/status && dpkg --root=$PWD/root --force-depends "
        "--force-script-chrootless --log=/dev/null ";
    const Outcome installed = box.shell(dpkg + "--install made/*.deb");
    ASSERT_EQ(installed.code, 0) << installed.err;
    EXPECT_THAT(good(box.shell("root/usr/bin/stipple --version")), HasSubstr("stipple "));
    ASSERT_EQ(box.shell(dpkg + "--remove stipple").code, 0);
    EXPECT_FALSE(box.exists("root/usr/bin/stipple"));
}

}  // namespace

TEST(Package, OfDebianAndAsArchiveIsWholeAndRuns) {
    if (sanitized()) GTEST_SKIP() << "the package is that of plain builds";
    const Sandbox box;
    if (box.shell("command -v dpkg-shlibdeps && command -v dpkg-deb").code != 0)
        GTEST_SKIP() << "Debian's tools are not installed";
    const Outcome made =
        box.shell("cpack --config " STIPPLE_BINARY_DIR "/CPackConfig.cmake -B made");
    ASSERT_EQ(made.code, 0) << made.out << made.err;
    const Outcome unpacked = box.shell(
        "mkdir deb tar && dpkg -x made/*.deb deb && tar -xzf made/*.tar.gz -C tar "
        "--strip-components=1");
    ASSERT_EQ(unpacked.code, 0) << unpacked.err;
    expect_whole(box, "deb/usr");
    expect_whole(box, "tar");
    const std::string control = good(box.shell("dpkg-deb --field made/*.deb"));
    EXPECT_THAT(control, HasSubstr("Package: stipple"));
    for (const char* library : {"libc6", "libfftw3", "libfmt", "libtbb", "libpng"})
        EXPECT_THAT(control, HasSubstr(library));
    EXPECT_THAT(good(box.shell("dpkg-deb --contents made/*.deb")),
                HasSubstr("-rwxr-xr-x root/root"));
    if (box.shell("test $(id -u) = 0").code == 0) expect_that_dpkg_takes_it(box);
}

}  // namespace stipple::testing::package_test
