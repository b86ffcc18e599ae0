// SPDX-License-Identifier: MIT
//
// Promises of every registered file format.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "io/format.hpp"
#include "support/contract.hpp"

namespace stipple::testing::formats_test {
namespace {

class EveryFormat : public ::testing::TestWithParam<std::string> {
  protected:
    const Format& unit = io::format_named(GetParam());

    /// A file with these sets, with rows formatted in blocks of `block`.
    std::string written(const std::vector<PointSet>& sets, std::size_t block = 7) const {
        Layout layout{.dimension = sets.front().dimension()};
        for (const PointSet& set : sets) layout.counts.push_back(set.count());
        layout.provenance.domain = "unit-cube";
        std::string bytes;
        if (unit.head) unit.head(layout, bytes);
        for (std::size_t s = 0; s < sets.size(); ++s) {
            if (unit.begin_set) unit.begin_set(layout, s, bytes);
            const auto flat = sets[s].flat();
            const std::size_t step = block * layout.dimension;
            for (std::size_t i = 0; i < flat.size(); i += step)
                unit.rows(layout, s, i / layout.dimension,
                          flat.subspan(i, std::min(step, flat.size() - i)), bytes);
        }
        if (unit.tail) unit.tail(layout, bytes);
        return bytes;
    }

    std::vector<PointSet> read(const std::string& bytes, std::size_t dimension) const {
        return unit.read(bytes, {.source = "file", .dimension = dimension}, {});
    }

    std::vector<std::size_t> dimensions() const {
        std::vector<std::size_t> list;
        for (const std::size_t d : {1, 2, 3, 5})
            if (d >= unit.traits.min_dimension && d <= unit.traits.max_dimension) list.push_back(d);
        return list;
    }
};

TEST_P(EveryFormat, GivesBackEveryBitThatItWasGiven) {
    if (!unit.read) GTEST_SKIP() << "write only";
    for (const std::size_t d : dimensions())
        for (const std::size_t n : {1, 2, 100}) {
            const PointSet set = make("random", points(n, d));
            const auto back = read(written({set}), d);
            ASSERT_EQ(back.size(), 1U) << n << ' ' << d;
            EXPECT_EQ(back[0], set) << n << ' ' << d;
        }
}

// Blocks are formatted by different threads and joined.
TEST_P(EveryFormat, BytesDoNotDependOnTheBlocks) {
    const std::size_t d = dimensions().front();
    const PointSet set = make("random", points(100, d));
    EXPECT_EQ(written({set}, 1), written({set}, 100));
}

TEST_P(EveryFormat, TruncationIsRefusedOrGivesWholePoints) {
    if (!unit.read) GTEST_SKIP() << "write only";
    const std::size_t d = dimensions().back();
    const PointSet set = make("random", points(20, d));
    const std::string bytes = written({set});
    for (std::size_t size = 0; size < bytes.size(); ++size) try {
            for (const PointSet& part : read(bytes.substr(0, size), d)) {
                EXPECT_EQ(part.dimension(), d);
                EXPECT_LE(part.count(), 20U);
            }
        } catch (const Error& e) {
            EXPECT_EQ(e.kind(), ErrorKind::input) << e.what();
        }
}

TEST_P(EveryFormat, HasACompleteRecord) {
    EXPECT_FALSE(unit.summary.empty());
    EXPECT_FALSE(unit.source.empty());
    EXPECT_NE(unit.rows, nullptr);
    for (const std::string& extension : unit.extensions)
        EXPECT_EQ(io::format_of_extension("p" + extension)->name, unit.name) << extension;
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryFormat, ::testing::ValuesIn(names_of(io::all())),
                         case_name);

}  // namespace

// Text and binary formats preserve all finite doubles, also in several sets.
TEST(AnyPoints, SurviveEveryFormatThatIsRead) {
    const auto survives = [](const Format& format, const std::vector<std::vector<double>>& rows) {
        Layout layout{.dimension = rows.front().size(), .counts = {rows.size()}};
        const PointSet set = points_of(rows);
        std::string bytes;
        if (format.head) format.head(layout, bytes);
        if (format.begin_set) format.begin_set(layout, 0, bytes);
        format.rows(layout, 0, 0, set.flat(), bytes);
        if (format.tail) format.tail(layout, bytes);
        const auto back = format.read(bytes, {.source = "file", .dimension = set.dimension()}, {});
        return back.size() == 1 && back[0] == set;
    };
    const bool held = rc::check("every set comes back", [&] {
        const auto d = *rc::gen::inRange<std::size_t>(1, 6);
        const auto finite = rc::gen::suchThat(rc::gen::map<std::uint64_t>([](std::uint64_t bits) {
                                                  return std::bit_cast<double>(bits);
                                              }),
                                              [](double x) { return std::isfinite(x); });
        const auto rows = *rc::gen::nonEmpty(rc::gen::container<std::vector<std::vector<double>>>(
            rc::gen::container<std::vector<double>>(d, finite)));
        for (const Format& format : io::all())
            if (format.read && d >= format.traits.min_dimension && d <= format.traits.max_dimension)
                RC_ASSERT(survives(format, rows));
    });
    EXPECT_TRUE(held);
}

}  // namespace stipple::testing::formats_test
