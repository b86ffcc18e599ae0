// SPDX-License-Identifier: MIT
//
// Report pages: marks of the best values, remarks in words, and equality of the page and its data.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <regex>

#include "page/figures.hpp"
#include "page/html.hpp"
#include "page/measures.hpp"
#include "pipeline/chain.hpp"
#include "plot/drawing/html_text.hpp"
#include "support/units.hpp"

namespace stipple::testing::page_test {

using namespace page;
using plot::html_text;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

using Compared = std::vector<std::optional<Known>>;

Known exactly(double x) { return {x, x, x}; }

Set page_set(const std::string& name, const PointSet& points, std::int64_t work = 1'000'000) {
    return finished_set({.name = name, .source = name}, points, {.words = name, .bounds = true},
                        work, 0, false, {});
}

Page page_of(std::vector<Set> sets) {
    return {.title = "title", .version = "1", .command = "stipple report", .sets = std::move(sets)};
}

const Measure& measure_of(const Set& set, const std::string& name) {
    return *std::ranges::find(set.measures, name, &Measure::name);
}

}  // namespace

TEST(Best, IsTheLowestOrTheHighestByTheMeasure) {
    const Compared values = {exactly(2), exactly(1), exactly(3)};
    EXPECT_THAT(best_of(values, Better::lower), ElementsAre(false, true, false));
    EXPECT_THAT(best_of(values, Better::higher), ElementsAre(false, false, true));
    EXPECT_THAT(best_of(values, Better::neither), ElementsAre(false, false, false));
}

TEST(Best, TiesAreBothMarkedButNotWhereAllAreTheSame) {
    EXPECT_THAT(best_of(Compared{exactly(1), exactly(2), exactly(1)}, Better::lower),
                ElementsAre(true, false, true));
    EXPECT_THAT(best_of(Compared{exactly(1), exactly(1)}, Better::lower),
                ElementsAre(false, false));
    EXPECT_THAT(best_of(Compared{exactly(infinity), exactly(1)}, Better::higher),
                ElementsAre(true, false));
}

TEST(Best, NeedsSomethingToCompareWith) {
    EXPECT_THAT(best_of(Compared{exactly(1)}, Better::lower), ElementsAre(false));
    EXPECT_THAT(best_of(Compared{exactly(1), std::nullopt}, Better::lower),
                ElementsAre(false, false));
    EXPECT_THAT(best_of(Compared{exactly(1), std::nullopt, exactly(2)}, Better::lower),
                ElementsAre(true, false, false));
}

// Overlapping bounds leave the better set undecided.
TEST(Best, IsCertain) {
    EXPECT_THAT(best_of(Compared{Known{1, 1, 3}, exactly(2)}, Better::lower),
                ElementsAre(false, false));
    EXPECT_THAT(best_of(Compared{Known{1, 1, 2}, exactly(2)}, Better::lower),
                ElementsAre(true, false));
    EXPECT_THAT(best_of(Compared{Known{1, 1, 2}, Known{3, 3, 4}}, Better::lower),
                ElementsAre(true, false));
}

TEST(Comparison, SetsOfDifferentSizesAreMarkedOnlyWhereThatDoesNotMatter) {
    const std::vector<Set> sets = {page_set("a", make("halton", points(64, 2))),
                                   page_set("b", make("halton", points(128, 2)))};
    std::size_t marked = 0;
    for (const Row& row : compare_sets(sets))
        for (const bool best : row.best) {
            EXPECT_TRUE(!best || row.key.any_count) << row.key.key;
            marked += best ? 1 : 0;
        }
    EXPECT_GT(marked, 0U);
    EXPECT_THAT(notes_on(sets), ElementsAre(HasSubstr("different numbers of points")));
}

TEST(Comparison, SaysWhichSetsAreTheSamePoints) {
    const std::vector<Set> sets = {page_set("a", make("halton", points(64, 2))),
                                   page_set("b", make("sobol", points(64, 2))),
                                   page_set("c", make("halton", points(64, 2)))};
    EXPECT_THAT(notes_on(sets), ElementsAre("a and c are the same points in the same order."));
}

TEST(Comparison, KnowsThatHaltonIsMoreEvenThanChance) {
    const std::vector<Set> sets = {page_set("halton", make("halton", points(256, 2))),
                                   page_set("random", make("random", points(256, 2)))};
    for (const Row& row : compare_sets(sets))
        if (std::string(row.key.key) == "star-discrepancy.value") {
            EXPECT_THAT(row.best, ElementsAre(true, false));
        }
    EXPECT_THAT(verdict_in_words(measure_of(sets[0], "chi-square")),
                HasSubstr("more evenly than by independent points"));
    EXPECT_THAT(verdict_in_words(measure_of(sets[1], "chi-square")),
                HasSubstr("as expected by chance"));
    EXPECT_EQ(verdict_in_words(measure_of(sets[0], "dispersion")), "");
}

// The mean and its standard error, which is exactly 0 for equal numbers.
TEST(Comparison, MeansHaveErrors) {
    const auto set_of = [](const std::vector<double>& values) {
        Set set;
        const auto report = [](double value) {
            return Report().add("value", value).add("error", -value);
        };
        set.measures.push_back(
            {.name = "m", .title = "", .analyzer = "", .results = report(values[0])});
        for (std::size_t i = 1; i < values.size(); ++i)
            set.replications.push_back(Report().add("m", report(values[i])));
        return set;
    };
    const auto mean = *known_under(set_of({1, 2, 6}), {"m.value", "", ""});
    EXPECT_DOUBLE_EQ(mean.value, 3);
    EXPECT_DOUBLE_EQ(mean.error, std::sqrt(7.0 / 3));  // variance (4 + 1 + 9) / 2
    const auto root = *known_under(set_of({3, 4}), {"m.error", "", ""});
    EXPECT_DOUBLE_EQ(root.value, std::sqrt(12.5));
    EXPECT_DOUBLE_EQ(root.error, 3.5 / (2 * std::sqrt(12.5)));
    EXPECT_EQ(known_under(set_of({0.1, 0.1, 0.1}), {"m.value", "", ""})->error, 0);
    EXPECT_EQ(known_under(set_of({1, NAN}), {"m.value", "", ""}), std::nullopt);
    // Means are considered different if two standard errors apart.
    EXPECT_THAT(best_of(Compared{Known{1, 1, 1, 0.1}, Known{1.3, 1.3, 1.3, 0.1}}, Better::lower),
                ElementsAre(false, false));
    EXPECT_THAT(best_of(Compared{Known{1, 1, 1, 0.1}, Known{1.5, 1.5, 1.5, 0.1}}, Better::lower),
                ElementsAre(true, false));
}

TEST(Comparison, PValuesTooSmallToTellAreSaidToBe) {
    EXPECT_EQ(shown_number(1e-40, "chi-square.p_value"), "< 1e-16");
    EXPECT_EQ(shown_number(1e-40, "kolmogorov-smirnov.p_lower[1]"), "< 1e-16");
    EXPECT_EQ(shown_number(0.25, "chi-square.p_value"), "0.25");
    EXPECT_NE(shown_number(1e-40, "star-discrepancy.value"), "< 1e-16");
}

TEST(Comparison, EveryKeyIsOneOfTheMeasures) {
    const Set set = page_set("a", make("sobol", points(64, 2)));
    for (const Key& key : compared_keys()) EXPECT_TRUE(known_under(set, key)) << key.key;
    EXPECT_FALSE(known_under(set, {"star-discrepancy", "", ""}));
    EXPECT_FALSE(known_under(set, {"star-discrepancy.method", "", ""}));
    EXPECT_FALSE(known_under(set, {"nonsense.value", "", ""}));
}

// Commands name the analyzer, the input and every option that is not the default.
TEST(Measures, TellHowToMeasureAgain) {
    const Set set = page_set("p.csv", make("halton", points(32, 2)), 12345);
    EXPECT_EQ(measure_of(set, "extreme-discrepancy").command,
              "stipple analyze star-discrepancy p.csv --kind extreme --max-work 12345");
    EXPECT_EQ(measure_of(set, "l2-discrepancy").command, "stipple analyze l2-discrepancy p.csv");
}

TEST(Measures, LeaveOutWhatTheyDoNotTakeAndSayWhy) {
    PointSet disk = points_of({{0.5, 0.5}, {-0.5, 0}, {0, -0.25}});
    disk.domain = parse_domain("disk", 2);
    const Set set = page_set("disk", disk);
    EXPECT_EQ(measure_of(set, "star-discrepancy").left_out,
              "it requires points of the unit cube; these are on disk");
    EXPECT_TRUE(measure_of(set, "nearest-neighbor").results);
    const Set outside = page_set("far", points_of({{3, 4}, {0, 0}}));
    EXPECT_THAT(measure_of(outside, "star-discrepancy").left_out, HasSubstr("outside"));
    EXPECT_THAT(to_html(page_of({set})), HasSubstr("Left out"));
}

TEST(Measures, MapABoxToTheUnitCube) {
    PointSet wide = make("halton", points(50, 2));
    const Set plain = page_set("p", wide);
    for (std::size_t i = 0; i < wide.count(); ++i) {
        wide[i][0] = 4 * wide[i][0] - 2;
        wide[i][1] = 8 * wide[i][1];
    }
    wide.domain = box_domain({.low = {-2, 0}, .high = {2, 8}});
    const Set boxed = page_set("p", wide);
    EXPECT_EQ(*boxed.results("star-discrepancy"), *plain.results("star-discrepancy"));
    EXPECT_THAT(measure_of(boxed, "star-discrepancy").command, HasSubstr(" --bounds -2..2,0..8"));
    EXPECT_THAT(measure_of(boxed, "nearest-neighbor").command, Not(HasSubstr("--bounds")));
    EXPECT_THAT(point_figures(wide, boxed).front(), HasSubstr("<g class=\"box star\">"));
}

TEST(Measures, LimitedSearchesGiveCertainBounds) {
    const Set set = page_set("a", make("random", points(300, 6)), 20000);
    const auto known = known_under(set, {"star-discrepancy.value", "", ""});
    ASSERT_TRUE(known);
    EXPECT_LT(known->lower, known->upper);
    EXPECT_THAT(shown_known(*known), HasSubstr(" to "));
}

// The limit depends on n and d, not on the time: 50 50 9 steps exceed 5 times 4000.
TEST(Measures, LeaveOutWhatWouldTakeLong) {
    const Set set = page_set("a", make("random", points(50, 9)), 4000);
    EXPECT_THAT(measure_of(set, "nearest-neighbor").left_out, HasSubstr("all pairs of 50 points"));
    EXPECT_TRUE(measure_of(set, "l2-discrepancy").results);
    const Set plane = page_set("a", make("random", points(50, 2)), 1);
    EXPECT_TRUE(measure_of(plane, "l2-discrepancy").results);
}

TEST(Measures, DoNotDependOnThreads) {
    const PointSet set = make("random", points(500, 3));
    const auto measured = [&](unsigned threads) {
        Set page = page_set("a", points_of({{0.5}}));
        page.measures =
            measure_set(set, {.words = "a", .bounds = true}, 100'000, {.threads = threads});
        return to_json(page_of({page}));
    };
    EXPECT_EQ(measured(1), measured(3));
}

TEST(Figures, BlocksKeepTheCentreAndTheMean) {
    Grid grid{.rows = 7, .columns = 7, .values = std::vector<double>(49, 0)};
    grid.values[24] = 9;
    EXPECT_EQ(in_blocks(grid, 7), grid);
    const Grid small = in_blocks(grid, 3);
    ASSERT_EQ(small.rows, 1U);  // blocks at the edge would be incomplete
    EXPECT_EQ(small.values, std::vector<double>{1});
    Grid wide{.rows = 9, .columns = 9, .values = std::vector<double>(81, 2)};
    wide.values[0] = 11;
    const Grid nine = in_blocks(wide, 3);
    ASSERT_EQ(nine.values.size(), 9U);
    for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(nine.values[i], i == 0 ? 3.0 : 2.0, 1e-12) << i;
}

TEST(Figures, EveryPointIsAMarkAndManyAreAPicture) {
    const PointSet few = make("halton", points(100, 2));
    const std::string marks = point_figures(few, page_set("a", few)).front();
    std::size_t dots = 0;
    for (auto at = marks.find("h0"); at != std::string::npos; at = marks.find("h0", at + 1)) ++dots;
    EXPECT_EQ(dots, 100U);
    PointSet lots = make("random", points(most_dots + 1, 2));
    const Set bare{.name = "lots",
                   .source = "lots",
                   .count = lots.count(),
                   .dimension = 2,
                   .domain = "unit-cube"};
    EXPECT_THAT(point_figures(lots, bare).front(), HasSubstr("data:image/png;base64,"));
}

TEST(Figures, BoxesAreDrawnWhereTheyAre) {
    // One point in the middle: the worst box is the closed [0, 1/2]^2, with discrepancy 1 - 1/4.
    const PointSet one = points_of({{0.5, 0.5}});
    const Set set = page_set("one", one);
    const auto boxes = worst_boxes(set);
    ASSERT_FALSE(boxes.empty());
    EXPECT_EQ(boxes[0].kind, "star");
    EXPECT_EQ(boxes[0].high, (std::vector<double>{0.5, 0.5}));
    EXPECT_EQ(boxes[0].label, "worst box from the origin: 1 of the points in 0.25 of the volume");
    // The box extends from the frame's lower left corner to the point.
    const std::string figure = point_figures(one, set).front();
    std::smatch dot;
    ASSERT_TRUE(std::regex_search(figure, dot, std::regex("d=\"M([0-9.]+) ([0-9.]+)h0")));
    const std::string box = figure.substr(figure.find("<g class=\"box star\">"));
    std::smatch corners;
    ASSERT_TRUE(std::regex_search(
        box, corners,
        std::regex("d=\"M([0-9.]+) ([0-9.]+)L([0-9.]+) ([0-9.]+)L([0-9.]+) ([0-9.]+)L")));
    EXPECT_NEAR(std::stod(corners[5]), std::stod(dot[1]), 0.06);
    EXPECT_NEAR(std::stod(corners[6]), std::stod(dot[2]), 0.06);
    EXPECT_NEAR(std::stod(corners[3]) - std::stod(corners[1]),
                std::stod(corners[2]) - std::stod(corners[6]), 1);
}

// 64 points of the plane are measured up to frequency 16.
TEST(Figures, SpectraHaveAFrameThatTellsTheFrequencies) {
    const std::string figure = spectrum_figure(page_set("a", make("halton", points(64, 2))));
    for (const char* words : {"<image x=", "data:image/png;base64,", ">−10</text>", ">10</text>",
                              ">frequency along x</text>", "Power at frequencies −16 to 16: "})
        EXPECT_THAT(figure, HasSubstr(words));
    EXPECT_EQ(spectrum_figure(page_set("a", make("halton", points(64, 3)))), "");
}

TEST(Figures, BoxesOfMoreAxesAreSaidToBeProjections) {
    for (const std::size_t d : {2, 3, 5}) {
        const PointSet set = make("random", points(20, d));
        const std::string figure = point_figures(set, page_set("a", set, 1000)).back();
        const auto has = [&](const char* words) { return figure.find(words) != std::string::npos; };
        EXPECT_EQ(has("drawn as its projections"), d > 2) << d;
        EXPECT_EQ(has(" checked>"), d == 2) << d;
    }
}

TEST(Page, SaysInWordsWherePointsLive) {
    PointSet set = make("random", points(20, 2));
    for (double& x : set.flat()) x *= 0.5;
    for (const auto& [domain, words] :
         {std::pair{"unit-cube", "on the unit cube<"},
          {"disk", "on the disk<"},
          {"disk:center=[1,1]", "on the domain disk:center=[1,1]<"}}) {
        set.domain = parse_domain(domain, 2);
        EXPECT_THAT(to_html(page_of({page_set("a", set)})),
                    HasSubstr(std::string("20 points in 2 dimensions ") + words));
    }
}

TEST(Figures, EveryDimensionHasOne) {
    for (const std::size_t d : {1, 2, 3, 4, 9}) {
        const PointSet set = make("halton", points(50, d));
        std::string all;
        for (const auto& figure : point_figures(set, page_set("a", set))) all += figure;
        std::size_t drawings = 0;
        for (auto at = all.find("<svg"); at != std::string::npos; at = all.find("<svg", at + 1))
            ++drawings;
        EXPECT_EQ(drawings, d == 3 ? 2U : 1U) << d;
        EXPECT_THAT(all, HasSubstr("aria-label=\"50 points of a")) << d;
    }
}

TEST(Charts, SaveTheNumbersThatTheyDraw) {
    const std::vector<Set> sets = {page_set("a", make("halton", points(64, 2))),
                                   page_set("b</script>", make("random", points(64, 2)))};
    const std::vector<std::size_t> both = {0, 1};
    const std::string figure = curve_figures(sets, both);
    std::smatch found;
    ASSERT_TRUE(
        std::regex_search(figure, found, std::regex("application/json\">([^<]*)</script>")));
    const auto data = nlohmann::json::parse(found[1].str());
    ASSERT_EQ(data["curves"].size(), 2U);
    EXPECT_EQ(data["curves"][1]["name"], "b</script>");
    const auto& power = sets[0].results("periodogram")->curve("radial.power");
    for (std::size_t i = 0; i < power.size(); ++i)
        EXPECT_NEAR(data["curves"][0]["y"][i].get<double>(), power[i], 1e-3 * std::abs(power[i]))
            << i;
    EXPECT_THAT(figure, HasSubstr("white noise, 95 %"));
    EXPECT_THAT(figure, HasSubstr("<g data-set=\"1\">"));
    EXPECT_THAT(curve_figures(std::vector<Set>{page_set("c", make("halton", points(9, 5)))},
                              std::vector<std::size_t>{0}),
                Not(HasSubstr("radial power")));
}

TEST(PageHtml, SaysTheSameNumbersAsTheData) {
    const Page page = page_of({page_set("a", make("halton", points(100, 2))),
                               page_set("b", make("sobol", points(100, 2)))});
    const std::string html = to_html(page);
    const auto json = nlohmann::json::parse(to_json(page));
    EXPECT_EQ(json["format"], "stipple.comparison");
    std::size_t projected = 0;
    for (const auto& row : json["comparison"])
        for (std::size_t i = 0; i < 2; ++i) {
            const auto& value = row["values"][i];
            if (value.is_null() || row.contains("lower")) continue;
            const auto at = html.find("<tr data-key=\"" + row["key"].get<std::string>() + "\"");
            ASSERT_NE(at, std::string::npos) << row["key"];
            const std::string cells = html.substr(at, html.find("</tr>", at) - at);
            std::regex cell("data-set=\"" + std::to_string(i) + "\" title=\"([^\",]*)");
            std::smatch found;
            ASSERT_TRUE(std::regex_search(cells, found, cell)) << cells;
            EXPECT_EQ(std::stod(found[1].str()), value.get<double>()) << row["key"];
            ++projected;
        }
    EXPECT_GT(projected, 30U);
    for (const auto& set : json["sets"])
        for (const auto& measure : set["measures"]) {
            const char* said = measure.contains("results") ? "command" : "left_out";
            EXPECT_THAT(html, HasSubstr(html_text(measure[said].get<std::string>())));
        }
}

TEST(PageHtml, EscapesNames) {
    Set set = page_set("<img src=x onerror=alert(1)>\"&", make("halton", points(10, 2)));
    set.command = "stipple generate '<b>'";
    Page page = page_of({set});
    page.title = set.name;
    const std::string html = to_html(page);
    EXPECT_THAT(html, Not(HasSubstr("<img src=x")));
    EXPECT_THAT(html, Not(HasSubstr("<b>")));
    EXPECT_THAT(html, HasSubstr("&lt;img src=x onerror=alert(1)&gt;&quot;&amp;"));
}

TEST(PageHtml, NeedsNothingFromElsewhere) {
    const std::string html = to_html(page_of({page_set("a", make("halton", points(64, 2)))}));
    std::string rest = html;
    EXPECT_THAT(rest, Not(HasSubstr("http://")));
    EXPECT_THAT(rest, Not(HasSubstr("https://")));
    EXPECT_THAT(rest, HasSubstr("default-src 'none'"));
    EXPECT_THAT(rest, HasSubstr("prefers-color-scheme:dark"));
    EXPECT_THAT(rest, HasSubstr("@media print"));
}

TEST(PageHtml, TakesTheSmallestSets) {
    for (const std::size_t d : {1, 2, 3}) {
        const Set set = page_set("one", points_of({std::vector<double>(d, 0.25)}));
        EXPECT_THAT(to_html(page_of({set})), HasSubstr("1 point in"));
    }
    const Set twins = page_set("twins", points_of({{0, 0}, {0, 0}, {1, 1}}));
    EXPECT_THAT(to_html(page_of({twins, twins})), HasSubstr("twins"));
}

}  // namespace stipple::testing::page_test
