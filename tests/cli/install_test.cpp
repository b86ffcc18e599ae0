// SPDX-License-Identifier: MIT
//
// The files installed by `cmake --install` suffice to build and run another program.
#include <gtest/gtest.h>

#include "places.hpp"
#include "support/examples.hpp"
#include "support/program.hpp"

namespace stipple::testing::install_test {

TEST(Install, OutsideProgramsBuildAgainstThePackage) {
    if (sanitized()) GTEST_SKIP() << "the package is that of plain builds";
    const Sandbox box;
    const std::string prefix = (box.path() / "prefix").string();
    ASSERT_EQ(box.shell("cmake --install " STIPPLE_BINARY_DIR " --prefix " + prefix).code, 0);
    const Outcome built = box.shell("cmake -S " STIPPLE_SOURCE_DIR
                                    "/data/examples -B build -G Ninja -DCMAKE_PREFIX_PATH=" +
                                    prefix + " && cmake --build build");
    ASSERT_EQ(built.code, 0) << built.out << built.err;
    expect_examples((box.path() / "build").string());
    EXPECT_EQ(box.shell(prefix + "/bin/stipple --version").code, 0);
}

}  // namespace stipple::testing::install_test
