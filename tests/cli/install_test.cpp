// SPDX-License-Identifier: MIT
//
// What `cmake --install` puts down is enough for another program to be built and run against.
#include <gtest/gtest.h>

#include "places.hpp"
#include "support/program.hpp"

namespace stipple::testing::install_test {

TEST(Install, AnOutsideProgramBuildsAgainstThePackage) {
    if (sanitized()) GTEST_SKIP() << "the package is that of plain builds";
    const Sandbox box;
    const std::string prefix = (box.path() / "prefix").string();
    ASSERT_EQ(box.shell("cmake --install " STIPPLE_BINARY_DIR " --prefix " + prefix).code, 0);
    box.write("CMakeLists.txt",
              "cmake_minimum_required(VERSION 3.25)\n"
              "project(outside CXX)\n"
              "find_package(stipple 0.1 REQUIRED)\n"
              "add_executable(outside outside.cpp)\n"
              "target_link_libraries(outside PRIVATE stipple::stipple)\n");
    box.write("outside.cpp",
              "#include <stipple/stipple.hpp>\n"
              "#include <cstdio>\n"
              "int main() {\n"
              "    const auto points = stipple::generate(\"halton\", {.count = 100, .dimension = "
              "2, .start "
              "= 1});\n"
              "    const auto report = stipple::analyze(\"star-discrepancy\", points);\n"
              "    std::printf(\"%.6f\\n\", report.number(\"value\"));\n"
              "}\n");
    const Outcome built = box.shell("cmake -S . -B build -G Ninja -DCMAKE_PREFIX_PATH=" + prefix +
                                    " && cmake --build build");
    ASSERT_EQ(built.code, 0) << built.out << built.err;
    EXPECT_EQ(box.shell("build/outside").out, "0.050239\n");  // 6511/129600
    EXPECT_EQ(box.shell(prefix + "/bin/stipple --version").code, 0);
}

}  // namespace stipple::testing::install_test
