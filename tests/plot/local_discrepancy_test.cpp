// SPDX-License-Identifier: MIT
//
// The image of the local discrepancy is compared with counts of points by the definition, and its
// worst boxes with those of the analyzer.
#include "plot/local_discrepancy.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "plot/text_picture.hpp"
#include "support/units.hpp"

namespace stipple::testing::local_discrepancy_test {

using namespace plot;

using ::testing::HasSubstr;

namespace {

/// delta(c) by the definition, for the open or the closed box.
double delta(const PointSet& points, double x, double y, bool closed = false) {
    double inside = 0;
    for (std::size_t i = 0; i < points.count(); ++i)
        inside +=
            closed ? points[i][0] <= x && points[i][1] <= y : points[i][0] < x && points[i][1] < y;
    return inside / static_cast<double>(points.count()) - x * y;
}

/// Minimum of delta over open boxes and maximum over closed ones, for all corners.
std::pair<double, double> extremes(const PointSet& points) {
    std::vector<double> xs = {1};
    std::vector<double> ys = {1};
    for (std::size_t i = 0; i < points.count(); ++i) {
        xs.push_back(points[i][0]);
        ys.push_back(points[i][1]);
    }
    std::pair<double, double> found;
    for (const double x : xs)
        for (const double y : ys) {
            found.first = std::min(found.first, delta(points, x, y));
            found.second = std::max(found.second, delta(points, x, y, true));
        }
    return found;
}

/// Points on the border and at pixel centres, and equal ones.
std::vector<PointSet> hard_sets() {
    std::vector<PointSet> sets = {
        points_of({{0.5, 0.25}}),
        points_of({{0, 0}}),
        points_of({{1, 1}}),
        points_of({{0, 1}, {1, 0}, {1, 0.5}, {0.5, 1}, {0, 0.5}}),
        points_of({{0.3, 0.3}, {0.3, 0.3}, {0.3, 0.7}, {0.7, 0.3}, {0.3, 0.9}}),
        points_of({{0.1, 0.1}, {0.05, 0.15}, {0.35, 0.5}, {0.95, 0.95}, {0.45, 0.05}}),
        make("sobol", {64, 2}),
        make("hammersley", {50, 2})};
    for (std::uint64_t seed = 1; seed <= 20; ++seed)
        sets.push_back(make("random", {3 * seed, 2}, {}, {.seed = seed}));
    return sets;
}

template <class S>
std::vector<const S*> shapes_of(const Drawing& drawing) {
    std::vector<const S*> found;
    for (const Shape& shape : drawing.shapes)
        if (const auto* s = std::get_if<S>(&shape)) found.push_back(s);
    return found;
}

Drawing drawn(const PointSet& points, bool bar = true) {
    const WorstBoxes worst = worst_boxes_of(points, {});
    return draw_local_discrepancy(
        points, worst, {.title = "t", .subtitle = "s", .largest = worst.star(), .bar = bar}, {},
        {});
}

}  // namespace

// One point in the middle, 2 x 2 pixels with centres 1/4 and 3/4.
TEST(LocalDiscrepancy, OfOnePointByHand) {
    const Grid grid = local_discrepancy(points_of({{0.5, 0.5}}), 2, 2, {});
    EXPECT_EQ(grid, (Grid{2, 2, {-1. / 16, -3. / 16, -3. / 16, 1 - 9. / 16}}));
    const WorstBoxes worst = worst_boxes_of(points_of({{0.5, 0.25}}), {});
    EXPECT_EQ(worst.open->corner, (Position{0.5, 1}));
    EXPECT_EQ(worst.open->value, -0.5);
    EXPECT_EQ(worst.closed->corner, (Position{0.5, 0.25}));
    EXPECT_EQ(worst.closed->value, 0.875);
    EXPECT_EQ(worst.star(), 0.875);
}

TEST(LocalDiscrepancy, PixelsHaveTheValuesAtTheirMiddles) {
    for (const PointSet& points : hard_sets())
        for (const auto& [columns, rows] : {std::pair<std::size_t, std::size_t>{1, 1},
                                            {2, 3},
                                            {10, 10},
                                            {7, 5},
                                            {33, 31},
                                            {49, 100}}) {
            const Grid grid = local_discrepancy(points, columns, rows, {});
            ASSERT_EQ(grid.values.size(), columns * rows);
            for (std::size_t row = 0; row < rows; ++row)
                for (std::size_t column = 0; column < columns; ++column) {
                    const double x =
                        (static_cast<double>(column) + 0.5) / static_cast<double>(columns);
                    const double y = (static_cast<double>(row) + 0.5) / static_cast<double>(rows);
                    EXPECT_EQ(grid.values[row * columns + column], delta(points, x, y))
                        << points.count() << " points, pixel " << column << ", " << row << " of "
                        << columns << " x " << rows;
                }
        }
}

TEST(LocalDiscrepancy, WorstBoxesOfBothSidesAreThoseOfAllCorners) {
    for (const PointSet& points : hard_sets()) {
        const WorstBoxes worst = worst_boxes_of(points, {});
        const auto [least, largest] = extremes(points);
        EXPECT_NEAR(worst.open ? worst.open->value : 0, least, 1e-14);
        EXPECT_NEAR(worst.closed ? worst.closed->value : 0, largest, 1e-14);
        const auto at = [&](const std::optional<AnchoredBox>& box, bool closed) {
            return box ? delta(points, box->corner.x, box->corner.y, closed) : 0;
        };
        EXPECT_NEAR(at(worst.open, false), least, 1e-14);
        EXPECT_NEAR(at(worst.closed, true), largest, 1e-14);
    }
}

// Also with so many points that the sweep is split in two.
TEST(LocalDiscrepancy, TheGreaterOfTheWorstBoxesIsTheAnalyzers) {
    std::vector<PointSet> sets = hard_sets();
    sets.push_back(make("random", {100'001, 2}));
    sets.push_back(make("halton", {3000, 2}));
    for (const PointSet& points : sets) {
        const WorstBoxes worst = worst_boxes_of(points, {});
        const Report report = analyze("star-discrepancy", points);
        EXPECT_EQ(worst.star(), report.number("value")) << points.count();
        const bool closed = std::get<bool>(*report.find("worst_box.closed"));
        const auto& box = closed ? worst.closed : worst.open;
        EXPECT_EQ(std::abs(box->value), worst.star());
        const auto& corner = report.curve("worst_box.corner");
        EXPECT_EQ(box->corner, (Position{corner[0], corner[1]})) << points.count();
    }
}

// With all points at the origin no box has too few; with all in the opposite corner none has too
// many.
TEST(LocalDiscrepancy, MayBeOfOneSignAlone) {
    const WorstBoxes low = worst_boxes_of(points_of({{0, 0}, {0, 0}}), {});
    EXPECT_FALSE(low.open);
    EXPECT_EQ(low.closed->value, 1);
    const WorstBoxes high = worst_boxes_of(points_of({{1, 1}}), {});
    EXPECT_FALSE(high.closed);
    EXPECT_EQ(high.open->value, -1);
    EXPECT_EQ(drawn(points_of({{1, 1}})).title, "t");
    EXPECT_THAT(svg_bytes(drawn(points_of({{0, 0}})), 1), HasSubstr("too few: in no box"));
    // A box with 1/49 of the points has an area of 1/49 that is rounded.
    PointSet cells(49, 2);
    for (std::size_t i = 0; i < 49; ++i) {
        cells[i][0] = static_cast<double>(i % 7) / 7;
        cells[i][1] = static_cast<double>(i / 7) / 7;
    }
    EXPECT_FALSE(worst_boxes_of(cells, {}).open);
}

TEST(LocalDiscrepancy, ADrawingHasTheImageThePointsAndBothBoxes) {
    const PointSet points = make("random", {40, 2}, {}, {.seed = 3});
    const WorstBoxes worst = worst_boxes_of(points, {});
    const Drawing drawing = drawn(points);
    const auto images = shapes_of<PixelImage>(drawing);
    ASSERT_EQ(images.size(), 2U);  // with the bar of colours
    const Area area = images[0]->area;
    EXPECT_EQ(images[0]->columns, static_cast<std::size_t>(2 * area.width));
    ASSERT_EQ(shapes_of<Disks>(drawing).size(), 1U);
    EXPECT_EQ(shapes_of<Disks>(drawing)[0]->centres.size(), 40U);
    // Upper right corner of the outlines, solid and dashed.
    for (const auto& box : {std::pair{worst.closed, Dash::none}, {worst.open, Dash::dashed}})
        EXPECT_TRUE(std::ranges::any_of(shapes_of<Line>(drawing), [&](const Line* line) {
            const auto corner = box.first->corner;
            return line->vertices.size() == 5 && line->dash == box.second &&
                   std::abs(line->vertices[2].x - area.left - corner.x * area.width) < 1e-9 &&
                   std::abs(line->vertices[2].y - area.bottom() + corner.y * area.height) < 1e-9;
        }));
    const std::string svg = svg_bytes(drawing, 1);
    EXPECT_THAT(svg, HasSubstr(text_of(*worst.closed, 4)));
    EXPECT_THAT(svg, HasSubstr(text_of(*worst.open, 4)));
}

// The first row of pixels is at the top; blue means too few, orange too many.
TEST(LocalDiscrepancy, ColoursHaveTheSignsOfTheValues) {
    const Drawing drawing = drawn(points_of({{0.75, 0.25}}));
    const PixelImage& image = *shapes_of<PixelImage>(drawing)[0];
    const auto at = [&](double x, double y) {
        const auto column = static_cast<std::size_t>(x * static_cast<double>(image.columns));
        const auto row = static_cast<std::size_t>((1 - y) * static_cast<double>(image.rows));
        return image.pixels[row * image.columns + column];
    };
    EXPECT_GT(at(0.7, 0.9).blue, at(0.7, 0.9).red);
    EXPECT_GT(at(0.8, 0.3).red, at(0.8, 0.3).blue);
    EXPECT_EQ(at(0.0, 0.01), light_theme.background);
}

TEST(LocalDiscrepancy, AnotherSetIsAnotherPicture) {
    PointSet points = make("sobol", {16, 2});
    const std::string right = svg_bytes(drawn(points), 1);
    EXPECT_EQ(svg_bytes(drawn(points), 1), right);
    points[7][1] = std::nextafter(points[7][1], 1.0) + 0.01;
    EXPECT_NE(svg_bytes(drawn(points), 1), right);
}

TEST(LocalDiscrepancy, PointsThatWouldCoverTheImageAreLeftOut) {
    EXPECT_EQ(shapes_of<Disks>(drawn(make("random", {10'000, 2}))).size(), 1U);
    EXPECT_EQ(shapes_of<Disks>(drawn(make("random", {50'000, 2}))).size(), 0U);
}

TEST(LocalDiscrepancy, TheBarIsSymmetricAboutZero) {
    const Drawing drawing = drawn(make("random", {5000, 2}, {}, {.seed = 2}));
    const std::string svg = svg_bytes(drawing, 1);
    EXPECT_THAT(svg, HasSubstr(">too many<"));
    EXPECT_THAT(svg, HasSubstr(">too few<"));
    const PixelImage& bar = *shapes_of<PixelImage>(drawing)[1];
    EXPECT_EQ(bar.pixels.front(), light_theme.series_colour(1));
    EXPECT_EQ(bar.pixels.back(), light_theme.series_colour(0));
    EXPECT_EQ(shapes_of<PixelImage>(drawn(make("random", {9, 2}), false)).size(), 1U);
    // Small numbers are shown with a power of ten.
    EXPECT_THAT(svg_bytes(drawn(make("sobol", {4096, 2})), 1), HasSubstr("(×10⁻³)"));
}

TEST(LocalDiscrepancy, InLettersTheSignsDiffer) {
    const PointSet points = points_of({{0.75, 0.25}});
    const WorstBoxes worst = worst_boxes_of(points, {});
    const std::string text = local_discrepancy_as_text(points, worst, worst.star(), {60, 20}, {});
    EXPECT_TRUE(text.starts_with("┌────"));
    for (const char* part :
         {"O", "█", "\nstar discrepancy 0.8125\n", "few ·:oO [0,0.75)×[0,1):−0.75\n",
          "many ░▒▓█ [0,0.75]×[0,0.25]:0.8125\n"})
        EXPECT_THAT(text, HasSubstr(part));
}

TEST(LocalDiscrepancy, RefusesWhatHasNone) {
    const auto message = [](const PointSet& points) {
        return error_of([&] { worst_boxes_of(points, {}); });
    };
    EXPECT_THAT(
        message(make("random", {5, 3})),
        HasSubstr(
            "input: the local discrepancy can be drawn for points of 2 coordinates; these have 3"));
    EXPECT_THAT(message(make("random", {5, 1})), HasSubstr("of 2 coordinates; these have 1"));
    EXPECT_THAT(message(PointSet(0, 2)), HasSubstr("input: an empty set"));
    EXPECT_THAT(message(points_of({{0.5, 0.5}, {0.5, 1.5}})),
                HasSubstr("input: 1 of 2 points are outside the unit cube"));
}

}  // namespace stipple::testing::local_discrepancy_test
