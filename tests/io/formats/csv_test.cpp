// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>

#include "io/columns.hpp"
#include "io/files.hpp"
#include "io/io_support.hpp"
#include "io/provenance.hpp"

namespace stipple::testing::csv_test {
namespace {

const PointSet two = points_of({{0, 0.5}, {0.25, 1e-7}});

std::vector<PointSet> csv(std::string_view bytes, ReadOptions options = {}) {
    return read_as("csv", bytes, std::move(options));
}

std::string refused(std::string_view bytes, ReadOptions options = {}) {
    options.source = "p.csv";
    return refusal("csv", bytes, options);
}

/// A text of several blocks.
std::string long_text(std::size_t rows) { return written("csv", {random_points(rows, 2)}); }

}  // namespace

TEST(Csv, HeaderNamesTheCoordinates) {
    EXPECT_EQ(written("csv", {points_of({{0.5}})}), "x\n0.5\n");
    EXPECT_EQ(written("csv", {two}), "x,y\n0,0.5\n0.25,1e-07\n");
    EXPECT_EQ(written("csv", {points_of({{1, 2, 3}})}), "x,y,z\n1,2,3\n");
    EXPECT_EQ(written("csv", {points_of({{1, 2, 3, 4}})}), "x1,x2,x3,x4\n1,2,3,4\n");
    EXPECT_EQ(written("csv", {points_of({{1, 2, 9}})}, {.extras = {"pdf"}}), "x,y,pdf\n1,2,9\n");
    EXPECT_EQ(written("csv", {two}, {.header = false}), "0,0.5\n0.25,1e-07\n");
    EXPECT_EQ(written("csv", {two}, {.precision = 3}), "x,y\n0.000,0.500\n0.250,0.000\n");
}

TEST(Csv, SeveralSetsHaveTheirNumbersInFront) {
    EXPECT_EQ(written("csv", {two, points_of({{1, 1}})}),
              "set,x,y\n0,0,0.5\n0,0.25,1e-07\n1,1,1\n");
}

TEST(Csv, MetaStandsOnTopAndReadsBack) {
    const std::string text = written("csv", {two}, {.meta = true, .provenance = some_provenance()});
    EXPECT_TRUE(text.starts_with("# tool: \"stipple\"\n# version: \"0.1.0\"\n")) << text;
    EXPECT_TRUE(text.ends_with("\nx,y\n0,0.5\n0.25,1e-07\n")) << text;
    const auto sets = csv(text);
    EXPECT_EQ(sets.at(0), two);
    Provenance expected = some_provenance();
    expected.named = true;
    EXPECT_EQ(sets.at(0).provenance, expected);
}

TEST(Csv, CommentsOfOthersAreNotTakenForProvenance) {
    EXPECT_EQ(csv("# seed: 99\n# domain: \"moon\"\n0,1\n").at(0).provenance, Provenance{});
}

TEST(Csv, ReadsWhatSpreadsheetsWrite) {
    EXPECT_EQ(csv("\xEF\xBB\xBF\"x\",\"y\"\r\n0,0.5\r\n\"0.25\",1E-7\r\n").at(0), two);
    EXPECT_EQ(csv("x;y\r\n0;0.5\r\n0.25;1e-7").at(0), two);
    EXPECT_EQ(csv("x pos\ty pos\n0\t0.5\n0.25\t1e-7\n").at(0), two);
    EXPECT_EQ(csv("x,y\r0,0.5\r0.25,1e-7\r").at(0), two);
}

// As written by write.csv of R and to_csv of pandas.
TEST(Csv, LeavesRowNamesOut) {
    for (const char* text :
         {"\"\",\"x\",\"y\"\n\"1\",0,0.5\n\"2\",0.25,1e-07\n",
          "\"\",\"x\",\"y\"\n\"a row\",0,0.5\n\"b, too\",0.25,1e-07\n",
          ",x,y\n0,0,0.5\n1,0.25,1e-07\n", ",x,y,pdf\n0,0,0.5,2\n1,0.25,1e-07,3\n"})
        EXPECT_EQ(csv(text), std::vector{two}) << text;
    EXPECT_EQ(csv(",x,y\n7,0,0.5\n", {.columns = {"1", "x"}}), std::vector{points_of({{7, 0}})});
    EXPECT_EQ(csv(",x\n7,0\n", {.all_columns = true}), std::vector{points_of({{7, 0}})});
}

TEST(Csv, ReadsWhatNumPyWrites) {
    const PointSet expected = points_of({{0, 0.5}, {0.1, 1.0 / 3}, {0.999, -2e-300}});
    EXPECT_EQ(csv("0.000000000000000000e+00 5.000000000000000000e-01\n"
                  "1.000000000000000056e-01 3.333333333333333148e-01\n"
                  "9.989999999999999991e-01 -2.000000000000000050e-300\n")
                  .at(0),
              expected);
    EXPECT_EQ(csv("# x,y\n"
                  "0.000000000000000000e+00,5.000000000000000000e-01\n"
                  "1.000000000000000056e-01,3.333333333333333148e-01\n"
                  "9.989999999999999991e-01,-2.000000000000000050e-300\n")
                  .at(0),
              expected);
}

TEST(Csv, ReadsBlanksOfAllKinds) {
    EXPECT_EQ(csv("  0   0.5  \n\n# a comment\n\t0.25 \t 1e-7").at(0), two);
    EXPECT_EQ(csv("#\n# title\n#\n0, 0.5\n0.25 ,1e-7\n\n").at(0), two);
    EXPECT_EQ(csv("0\t0.5\n0.25\t1e-7\n").at(0), two);
}

TEST(Csv, ReadsOneLineAndOneNumber) {
    EXPECT_EQ(csv("0.5,0.25").at(0), points_of({{0.5, 0.25}}));
    EXPECT_EQ(csv("0.5").at(0), points_of({{0.5}}));
    EXPECT_EQ(csv("+1").at(0), points_of({{1}}));
    EXPECT_EQ(csv("x\n1e-999").at(0), points_of({{0}}));
}

TEST(Csv, EveryDoubleSurvives) {
    std::mt19937_64 random(1);
    std::vector<double> rows;
    while (rows.size() < 200'000) {
        const double value = std::bit_cast<double>(random());
        if (std::isfinite(value)) rows.push_back(value);
    }
    const PointSet points(rows, 2);
    const auto back = csv(written("csv", {points})).at(0);
    for (std::size_t i = 0; i < rows.size(); ++i)
        ASSERT_EQ(std::bit_cast<std::uint64_t>(back.flat()[i]),
                  std::bit_cast<std::uint64_t>(rows[i]));
}

TEST(Csv, DensityIsNoCoordinateUnlessPicked) {
    const std::string text = "x,y,pdf\n1,2,3\n4,5,6\n";
    EXPECT_EQ(csv(text).at(0), points_of({{1, 2}, {4, 5}}));
    EXPECT_EQ(csv(text, {.columns = {"pdf"}}).at(0), points_of({{3}, {6}}));
    EXPECT_EQ(csv("weight x\n1 2\n").at(0), points_of({{2}}));
}

TEST(Csv, ColumnsArePickedByNameOrNumberInAnyOrder) {
    const std::string text = "name,x,y\n\"a, b\",1,2\nnan,3,4\n,5,6\n";
    EXPECT_EQ(csv(text, {.columns = {"y", "x"}}).at(0), points_of({{2, 1}, {4, 3}, {6, 5}}));
    EXPECT_EQ(csv(text, {.columns = {"2"}}).at(0), points_of({{1}, {3}, {5}}));
    EXPECT_EQ(csv("1 2 3\n4 5 6\n", {.columns = {"z", "1"}}).at(0), points_of({{3, 1}, {6, 4}}));
    EXPECT_EQ(csv("a 2 3\nb\t5 6\n", {.columns = {"2"}}).at(0), points_of({{2}, {5}}));
    EXPECT_EQ(refused("x,y\n1,2\n", {.columns = {"z"}}),
              "usage: --column: p.csv:1 has no column 'z'; its columns are 1 to 2 | known: x, y");
    EXPECT_EQ(refused("x,y\n1,2\n", {.columns = {"3"}}),
              "usage: --column: p.csv:1 has no column '3'; its columns are 1 to 2 | known: x, y");
    EXPECT_EQ(refused("x,y\n1,2\n", {.columns = {"x", "1"}}),
              "usage: --column: '1' is picked twice; pick each column once");
}

TEST(Csv, SetColumnSplits) {
    const auto sets = csv("set,x,y\n4,0,0.5\n4,0.25,1e-7\n5,1,1\n");
    ASSERT_EQ(sets.size(), 2U);
    EXPECT_EQ(sets[0], two);
    EXPECT_EQ(sets[1], points_of({{1, 1}}));
    const auto shuffled = csv("set,x\n1,10\n0,20\n1,30\n");
    ASSERT_EQ(shuffled.size(), 2U);
    EXPECT_EQ(shuffled[0], points_of({{10}, {30}}));
    EXPECT_EQ(shuffled[1], points_of({{20}}));
    EXPECT_EQ(csv("set,x\n1,10\n0,20\n", {.columns = {"set"}}).at(0), points_of({{1}, {0}}));
}

TEST(Csv, SetsOfManyBlocksReadBack) {
    std::vector<PointSet> sets;
    for (const std::size_t count : {1U, 50'000U, 3U, 40'000U, 30'000U})
        sets.push_back(random_points(count, 2, count));
    EXPECT_EQ(csv(written("csv", sets)), sets);
    EXPECT_EQ(csv(written("txt", sets)), sets);
}

TEST(Csv, ThreadsChangeNothing) {
    std::string text = long_text(100'000);
    ASSERT_GT(text.size(), 3U << 20);
    const auto expected = random_points(100'000, 2);
    for (const unsigned threads : {1U, 2U, 7U})
        EXPECT_EQ(read_as("csv", text, {}, {.threads = threads}).at(0), expected) << threads;

    // With two errors in different blocks, the first is reported.
    text[text.find('\n', text.size() / 2) + 1] = '?';
    text[text.find('\n', text.size() - 99) + 1] = '?';
    const std::string error = refusal("csv", text, {}, {.threads = 1});
    const auto line =
        1 + std::count(text.begin(), text.begin() + std::ptrdiff_t(text.find('?')), '\n');
    EXPECT_EQ(error.find("input: p:" + std::to_string(line) + ":1: '?."), 0U) << error;
    for (const unsigned threads : {2U, 7U})
        EXPECT_EQ(refusal("csv", text, {}, {.threads = threads}), error) << threads;
}

// A line much longer than a block, a text that is mostly comments, and blocks without any row.
TEST(Csv, BlocksWithoutRowsAreNoTrouble) {
    const std::string comment = "# " + std::string(3'000'000, '-') + "\n";
    EXPECT_EQ(
        csv("0,0.5\n" + comment + std::string(2'500'000, '\n') + "0.25,1e-7\n" + comment).at(0),
        two);
    const PointSet wide = random_points(3, 70'000);
    EXPECT_EQ(csv(written("csv", {wide})).at(0), wide);
}

// The shortest possible rows fill a block's buffer completely.
TEST(Csv, BlocksOfShortRowsHaveRoom) {
    std::string text;
    while (text.size() < 2'500'000) text += "1\n";
    EXPECT_EQ(csv(text).at(0), PointSet(std::vector<double>(text.size() / 2, 1.0), 1));
    for (std::size_t i = 1; i < text.size(); i += 4) text[i] = ' ';
    text.pop_back();
    EXPECT_EQ(csv(text).at(0), PointSet(std::vector<double>((text.size() + 1) / 2, 1.0), 2));
}

// The fast parser and the general one read the same.
TEST(Csv, QuotesAndBlanksDoNotMatter) {
    const PointSet points = random_points(1000, 3);
    std::string text = "x,y,z\n";
    for (std::size_t i = 0; i < points.count(); ++i)
        text += fmt::format("{} ,\t\"{}\",  {}\n", points[i][0], points[i][1], points[i][2]);
    EXPECT_EQ(csv(text).at(0), points);
}

TEST(Csv, MissingNumbersAreNaNWhereTheyAreAsked) {
    const ReadOptions gaps{.gaps = true};
    const auto missing = [&](std::string_view bytes) {
        std::vector<std::size_t> at;
        const PointSet set = csv(bytes, gaps).at(0);
        for (std::size_t i = 0; i < set.flat().size(); ++i)
            if (std::isnan(set.flat()[i])) at.push_back(i);
        return std::pair{set.count(), at};
    };
    using Found = std::pair<std::size_t, std::vector<std::size_t>>;
    EXPECT_EQ(missing("x,y\n1,\n,\n\n3,nan\n"), (Found{3, {1, 2, 3, 5}}));
    EXPECT_EQ(missing("x,y\n1,NA\n\"\",2\nNaN,3\n"), (Found{3, {1, 2, 4}}));
    EXPECT_EQ(missing("y\n1\n\n3\n\n"), (Found{4, {1, 3}}));  // an empty line is a gap
    EXPECT_EQ(csv("y\n1\n\n3\n").at(0).count(), 2U);
    // Rows of missing numbers are shorter than the shortest complete ones; in several blocks.
    std::string text = "a,b,c\n";
    for (int i = 0; i < 700'000; ++i) text += ",,\n";
    EXPECT_EQ(missing(text).first, 700'000U);
    EXPECT_EQ(refusal("csv", "x,y\n1,abc\n", {.source = "p.csv", .gaps = true}),
              "input: p.csv:2:3: 'abc' is not a number; expected one such as 0.5 or 1e-3");
    EXPECT_EQ(refusal("csv", "x,y\n1,inf\n", {.source = "p.csv", .gaps = true}),
              "input: p.csv:2:3: 'inf' is not finite; expected a finite number");
}

TEST(Csv, RefusesWhatIsNotANumber) {
    EXPECT_EQ(refused("x,y\n0.5,0.25\n0.5,abc\n"),
              "input: p.csv:3:5: 'abc' is not a number; expected one such as 0.5 or 1e-3");
    EXPECT_EQ(refused("0.5,nan\n"),
              "input: p.csv:1:5: 'nan' is not finite; expected a finite number");
    EXPECT_EQ(refused("x\n-inf\n"),
              "input: p.csv:2:1: '-inf' is not finite; expected a finite number");
    EXPECT_EQ(refused("1e999 1\n"),
              "input: p.csv:1:1: '1e999' is beyond the largest double, 1.8e308; expected a finite "
              "number");
    EXPECT_EQ(refused("0.1,0.2\n0.1,,\n"), "input: p.csv:2:5: an empty field; expected a number");
    EXPECT_EQ(refused("0.1,0.2 0.3\n"),
              "input: p.csv:1:5: '0.2 0.3' is not a number; expected one such as 0.5 or 1e-3");
    EXPECT_EQ(refused("0.1 0.2 # note\n0.1 0.2\n"),
              "input: p.csv:1:9: '#' is not a number; expected one such as 0.5 or 1e-3");
    EXPECT_EQ(refused("0x10,1\n1,1\n"),
              "input: p.csv:1:1: '0x10' is not a number; expected one such as 0.5 or 1e-3");
    EXPECT_EQ(refused("x,y,pdf\n1,2,nan\n"),
              "input: p.csv:2:5: 'nan' is not finite; expected a finite number");
    EXPECT_EQ(refused("set,x\n0.5,1\n"),
              "input: p.csv:2:1: '0.5' is not the number of a set; expected 0, 1, 2...");
}

TEST(Csv, RefusesRaggedRows) {
    EXPECT_EQ(refused("# c\nx,y\n1,2\n1,2,3\n"),
              "input: p.csv:4:5: the row has 3 fields; expected 2, as line 2 has");
    EXPECT_EQ(refused("1 2\n3\n"),
              "input: p.csv:2:2: the row has 1 field; expected 2, as line 1 has");
    EXPECT_EQ(refused("1,2\n3,4,\n"),
              "input: p.csv:2:5: the row has 3 fields; expected 2, as line 1 has");
    EXPECT_EQ(refused("1,2\n3 4\n"),
              "input: p.csv:2:1: '3 4' is not a number; expected one such as 0.5 or 1e-3");
    EXPECT_EQ(refused("x\ty\n1\t\t2\n"), "input: p.csv:2:3: an empty field; expected a number");
}

TEST(Csv, RefusesWhatHoldsNoPoints) {
    EXPECT_EQ(refused(""), "input: p.csv: the file is empty; expected points, one per line");
    EXPECT_EQ(refused("\n \r\n"),
              "input: p.csv: the file holds only blank lines; expected points, one per line");
    EXPECT_EQ(refused("# a\n\n# b"),
              "input: p.csv: the file holds only comments; expected points, one per line");
    EXPECT_EQ(refused("# a\nx,y\n# b\n"),
              "input: p.csv: the file holds only a header (line 2); expected points below it, one "
              "per line");
    EXPECT_EQ(refused("pdf\n1\n"),
              "input: p.csv:1: no column holds coordinates; the columns are pdf | --column picks "
              "columns by name or number");
}

TEST(Csv, RefusesEmptySets) {
    const char* message = "a set without points; a line such as this separates two sets";
    EXPECT_EQ(refused("0.5\n#\n#\n0.5\n"), std::string("input: p.csv:3:1: ") + message);
    EXPECT_EQ(refused("0.5\n#\n0.5\n# \n"), std::string("input: p.csv:4:1: ") + message);
}

TEST(Csv, RefusesBytesThatAreNoText) {
    using namespace std::string_literals;
    EXPECT_EQ(refused("0.1,0.2\n0.1,\0"s),
              "input: p.csv:2:5: byte 0x00 is not text; expected numbers");
    EXPECT_EQ(refused("\x7F"
                      "ELF\x02\x01\0\0"s),
              "input: p.csv:1:1: byte 0x7F is not text; expected numbers, or the name of a binary "
              "format");
    EXPECT_EQ(
        refused("\x1F\x8B\x08\0"s),
        "input: p.csv: the file is compressed; expected plain points | unpack it: gunzip, zcat");
    EXPECT_EQ(refused("\xFF\xFE"
                      "0\0"s),
              "input: p.csv: the text is in UTF-16; expected ASCII or UTF-8 | iconv -f UTF-16 -t "
              "UTF-8 converts it");
    EXPECT_EQ(refused("1,2\r3,4\n"),
              "input: p.csv:1:4: byte 0x0D is not text; expected numbers, or "
              "the name of a binary format");
}

TEST(Csv, RefusesAnotherDimension) {
    EXPECT_EQ(refused("# c\n1,2,3\n", {.dimension = 2}),
              "input: p.csv:2: points have 3 coordinates; --dimension is 2 | --column picks "
              "columns by name or number");
    EXPECT_EQ(csv("1,2,3\n", {.dimension = 2, .columns = {"1", "3"}}).at(0), points_of({{1, 3}}));
}

TEST(Csv, StopsAndLimitsAreHonoured) {
    const std::string text = long_text(50'000);
    std::stop_source stop;
    stop.request_stop();
    EXPECT_EQ(refusal("csv", text, {}, {.stop = stop.get_token()}), "cancelled: interrupted");
    const std::string error = refusal("csv", text, {}, {.max_memory = 100'000});
    EXPECT_TRUE(error.starts_with("limit: reading p needs")) << error;
}

// As written by spreadsheets in locales with decimal commas.
TEST(Csv, TakesDecimalCommas) {
    const PointSet points = points_of({{0.5, 1}, {-2.25, 1e-3}, {3, 0.125}});
    EXPECT_EQ(csv("0,5;1\n-2,25;1e-3\n3;0,125\n").at(0), points);
    EXPECT_EQ(csv("0,5\t1\n-2,25\t1e-3\n3\t0,125\n").at(0), points);
    EXPECT_EQ(csv("age;income\n0,5;1\n-2,25;1e-3\n3;0,125\n").at(0), points);
    EXPECT_EQ(csv("3;1\n0,5;2\n").at(0), points_of({{3, 1}, {0.5, 2}}));
    EXPECT_EQ(csv("1;2\n0.5;0.25\n").at(0), points_of({{1, 2}, {0.5, 0.25}}));
    EXPECT_EQ(refused("0,5;1\n1.5;2\n"),
              "input: p.csv:2:1: '1.5' has a decimal point; expected a decimal comma, as in the "
              "rows above");
    EXPECT_EQ(refused("0.5;1\n1,5;2\n"),
              "input: p.csv:2:1: '1,5' is not a number; expected a decimal point, as in 0.5");
    EXPECT_EQ(refused("0,5;1\n1,5,0;2\n"),
              "input: p.csv:2:1: '1,5,0' is not a number; expected one such as 0,5");
}

TEST(Csv, KeepsTheNamesOfColumns) {
    const auto names = [](const std::string& text, const ReadOptions& options = {}) {
        return csv(text, options).at(0).provenance.columns;
    };
    using Names = std::vector<std::string>;
    EXPECT_EQ(names("age,income\n1,2\n"), (Names{"age", "income"}));
    EXPECT_EQ(names("x,y\n1,2\n"), Names());
    EXPECT_EQ(names("1,2\n"), Names());
    EXPECT_EQ(names("a,b,c\n1,2,3\n", {.columns = {"c", "a"}}), (Names{"c", "a"}));
    EXPECT_EQ(names("a,b,pdf\n1,2,3\n"), (Names{"a", "b"}));
    EXPECT_EQ(names("set,a\n0,2\n"), Names{"a"});
    // Names that would be read as something else are replaced.
    EXPECT_EQ(names("a,set\n0,2\n"), (Names{"a", "y"}));
    EXPECT_EQ(names("a,b\"c\n0,2\n"), (Names{"a", "y"}));
    EXPECT_EQ(names("a," + std::string(300, 'b') + "\n0,2\n"), (Names{"a", "y"}));
    Layout layout{.dimension = 2};
    layout.provenance.columns = {"age", "wages, gross"};
    const std::string text = written("csv", {points_of({{1, 2}})}, layout);
    EXPECT_EQ(text, "age,\"wages, gross\"\n1,2\n");
    EXPECT_EQ(names(text), layout.provenance.columns);
}

TEST(Csv, SaysWhatAFirstLineMayBe) {
    const auto told = [](std::string_view text) { return notes_of("csv", text); };
    EXPECT_EQ(told("0.5f\n0.25\n"),
              "p: the first line is read as names of columns, though '0.5f' begins like a number");
    EXPECT_EQ(told("0,1\n0.25,0.5\n"),
              "p: the first line is read as a point; remove it if it numbers the columns");
    EXPECT_EQ(told("x;y\n1,234;2\n5,678;9,123\n"), "p: 9,123 is read as 9.123, not as thousands");
    EXPECT_EQ(told("x;y\n1,234;2\n5,678;0,123\n"), "");
    EXPECT_EQ(told("x,2nd\n0.25,0.5\n"), "");
    EXPECT_EQ(told("0,0\n0.25,0.5\n"), "");
    EXPECT_EQ(told("0,1\n2,3\n"), "");
    EXPECT_EQ(told("0,1"), "");
    EXPECT_EQ(told("0\n0.25\n"), "");
}

TEST(Csv, PicksNoneOfColumnsOfOneName) {
    EXPECT_EQ(refusal("csv", "x,x,y\n1,2,3\n", {.columns = {"x"}}),
              "usage: --column: p:1 has 2 columns 'x'; pick one by its number");
    EXPECT_EQ(read_as("csv", "x,x,y\n1,2,3\n", {.columns = {"2", "y"}}).at(0), points_of({{2, 3}}));
}

TEST(Csv, SaysThatWeightsAreNotThoseOfTheDensities) {
    EXPECT_EQ(notes_of("csv", "x,pdf,weight\n0.5,3,2\n", {.densities = true}),
              "p: the column 'weight' is not 1 / pdf, and is not used");
    EXPECT_EQ(notes_of("csv", "x,pdf,weight\n0.5,3,0.3333\n", {.densities = true}), "");
}

TEST(Csv, WeightsHaveADensity) {
    PointSet tiny = read_as("csv", "x,weight\n0.5,1e-310\n", {.densities = true}).at(0);
    EXPECT_EQ(error_of([&] { io::take_densities(tiny); }),
              "input: point 0: its weight is 1e-310; expected a number whose inverse is a double");
}

}  // namespace stipple::testing::csv_test
