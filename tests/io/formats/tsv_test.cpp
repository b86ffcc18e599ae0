// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "io/io_support.hpp"

namespace stipple::testing::tsv_test {
namespace {
const PointSet two = points_of({{0, 0.5}, {0.25, -1e-7}});
}

TEST(Tsv, HasTabsWhereCsvHasCommas) {
    for (const Layout& layout : {Layout{}, Layout{.header = false}, Layout{.precision = 3},
                                 Layout{.meta = true, .provenance = some_provenance()}}) {
        std::string csv = written("csv", {two}, layout);
        const auto rows = csv.rfind("0.25");
        std::string tsv = written("tsv", {two}, layout);
        EXPECT_EQ(tsv.substr(rows).find(','), std::string::npos);
        std::ranges::replace(csv.begin() + static_cast<std::ptrdiff_t>(rows), csv.end(), ',', '\t');
        EXPECT_EQ(tsv.substr(rows), csv.substr(rows));
    }
    EXPECT_EQ(written("tsv", {two, points_of({{1, 2}})}),
              "set\tx\ty\n0\t0\t0.5\n0\t0.25\t-1e-07\n1\t1\t2\n");
}

TEST(Tsv, NamesWithBlanksAndWordsReadBack) {
    PointSet set = points_of({{0, 1}, {1, 0.5}});
    set.provenance.columns = {"my material", "length"};
    set.provenance.levels = {{"my material", {"mild steel", "oak"}}};
    const std::string text = written("tsv", {set}, {.provenance = set.provenance});
    EXPECT_EQ(text, "\"my material\"\tlength\n\"mild steel\"\t1\noak\t0.5\n");
    EXPECT_EQ(read_as("tsv", text).at(0), set);
}

TEST(Tsv, NamesWithSeparatorsReadBackFromAnyFormat) {
    for (const std::vector<std::string>& names : {std::vector<std::string>{"load; N", "layers"},
                                                  {"a, b", "b (mm, cold)"},
                                                  {"a\tb", "c;d"},
                                                  {"x", "y, mm; z"}}) {
        PointSet set = points_of({{1, 0}, {5, 3}, {3, 6}});
        set.provenance.columns = names;
        for (const char* format : {"csv", "tsv"}) {
            const std::string text = written(format, {set}, {.provenance = set.provenance});
            EXPECT_EQ(read_as(format, text).at(0), set) << text;
        }
    }
    // Names without quotes, as other programs write them.
    EXPECT_EQ(read_as("tsv", "x, mm\ty; mm\n1\t2\n").at(0).provenance.columns,
              (std::vector<std::string>{"x, mm", "y; mm"}));
    EXPECT_EQ(read_as("csv", "x,\ty\n1,\t2\n").at(0).provenance.columns,
              (std::vector<std::string>{}));  // x and y are the default names
    EXPECT_EQ(read_as("csv", "\"x; mm\",y\n1,2\n3,4\n").at(0).flat().size(), 4U);
}

}  // namespace stipple::testing::tsv_test
