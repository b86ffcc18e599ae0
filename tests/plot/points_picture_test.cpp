// SPDX-License-Identifier: MIT
//
// Pictures of points: in the plane, in space, in pairs of coordinates, with characters.
#include "plot/points_picture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/text.hpp"
#include "pipeline/chain.hpp"
#include "plot/drawing/dot_matrix.hpp"
#include "plot/drawing/letters.hpp"
#include "plot/text_picture.hpp"
#include "stipple/warp.hpp"
#include "support/units.hpp"

namespace stipple::testing::points_picture_test {

using namespace plot;

using ::testing::HasSubstr;

namespace {

PointsPicture picture_of(const std::vector<const PointSet*>& sets) {
    PointsPicture picture{.sets = sets, .names = {}, .title = "t"};
    for (std::size_t i = 0; i < sets.size(); ++i) picture.names.push_back(std::to_string(i));
    return picture;
}

template <class S>
std::vector<const S*> shapes_of(const Drawing& drawing) {
    std::vector<const S*> found;
    for (const Shape& shape : drawing.shapes)
        if (const auto* s = std::get_if<S>(&shape)) found.push_back(s);
    return found;
}

std::vector<Position> marks_of(const Drawing& drawing) {
    std::vector<Position> all;
    for (const Disks* disks : shapes_of<Disks>(drawing))
        all.insert(all.end(), disks->centres.begin(), disks->centres.end());
    return all;
}

/// Area enclosed by closed lines.
double area_of(const std::vector<std::vector<Position>>& lines) {
    double sum = 0;
    for (const auto& line : lines)
        for (std::size_t i = 0; i < line.size(); ++i) {
            const Position a = line[i];
            const Position b = line[(i + 1) % line.size()];
            sum += (a.x * b.y - b.x * a.y) / 2;
        }
    return sum;
}

}  // namespace

TEST(PointsPicture, HasADiskForEachPointWhereItIs) {
    const PointSet points = points_of({{0, 0}, {1, 1}, {0.5, 0.25}});
    const Drawing drawing = draw_points(picture_of({&points}), {}, {});
    const auto marks = marks_of(drawing);
    ASSERT_EQ(marks.size(), 3U);
    const double side = marks[1].x - marks[0].x;
    EXPECT_NEAR(marks[0].y - marks[1].y, side, 1e-9);
    EXPECT_NEAR(marks[2].x, marks[0].x + side / 2, 1e-9);
    EXPECT_NEAR(marks[2].y, marks[0].y - side / 4, 1e-9);
    EXPECT_GT(side, 400);
}

// A box that wraps around along both axes has a part in each corner.
TEST(PointsPicture, BoxesAcrossTheRimHaveSeveralParts) {
    const PointSet points = points_of({{0.5, 0.5}});
    PointsPicture picture = picture_of({&points});
    picture.boxes = {{.kind = "periodic", .low = {0.25, 0.25}, .high = {0.5, 0.75}},
                     {.kind = "periodic", .low = {0.75, 0.75}, .high = {0.5, 0.25}}};
    const Drawing drawing = draw_points(picture, {}, {});
    const auto parts = shapes_of<Patch>(drawing);
    ASSERT_EQ(parts.size(), 1U + 4U);
    const auto width_of = [](const Patch& p) { return p.vertices[1].x - p.vertices[0].x; };
    const double unit = 4 * width_of(*parts[0]);
    EXPECT_NEAR(width_of(*parts[1]), unit / 2, 1e-9);  // 0 to 0.5
    EXPECT_NEAR(width_of(*parts[3]), unit / 4, 1e-9);  // 0.75 to 1
    EXPECT_NEAR(parts[3]->vertices[0].x - parts[1]->vertices[0].x, 0.75 * unit, 1e-9);
}

// One point, equal points, points on a line: still a picture with axes.
TEST(PointsPicture, DrawsDegenerateSets) {
    for (const PointSet& points :
         {points_of({{0.5, 0.5}}), points_of({{7, -3}}), points_of({{7, 3}, {7, 3}, {7, 3}}),
          points_of({{5, 2}, {6, 2}, {9, 2}}), points_of({{0.3}}), points_of({{4}, {4}}),
          points_of({{1, 2, 3}}), points_of({{1, 2, 3, 4, 5}})})
        for (const double width : {260.0, 0.0}) {
            const Drawing drawing =
                draw_points(picture_of({&points}), {.width = width, .height = width}, {});
            EXPECT_GT(drawing.height, 0);
            for (const Position& mark : marks_of(drawing))
                EXPECT_TRUE(std::isfinite(mark.x) && std::isfinite(mark.y));
            EXPECT_FALSE(svg_bytes(drawing, 1).find("nan") != std::string::npos);
            EXPECT_FALSE(svg_bytes(drawing, 1).find("inf") != std::string::npos);
            EXPECT_FALSE(points_as_text(picture_of({&points}), {}).empty());
        }
}

// Points of a file without a domain are shown in their own bounding box.
TEST(PointsPicture, ShowsTheBoxOfPointsOutsideOfTheCube) {
    const PointSet far = points_of({{1000, 5}, {1001, 7}});
    const PointSet near = points_of({{0.4, 0.5}, {0.5, 0.6}});
    const PointSet* const far_set[] = {&far};
    const PointSet* const near_set[] = {&near};
    EXPECT_EQ(shown_box(far_set), (Box{{1000, 5}, {1001, 7}}));
    EXPECT_EQ(shown_box(near_set), (Box{{0, 0}, {1, 1}}));
}

TEST(PointsPicture, SetsHaveColoursAndALegend) {
    const PointSet a = points_of({{0.1, 0.1}, {0.2, 0.2}});
    const PointSet b = points_of({{0.3, 0.3}});
    PictureStyle dark{.theme = &dark_theme};
    const Drawing drawing = draw_points(picture_of({&a, &b}), dark, {});
    EXPECT_EQ(drawing.background, dark_theme.background);
    std::vector<Colour> colours;
    std::size_t marks = 0;
    for (const Disks* disks : shapes_of<Disks>(drawing)) {
        colours.push_back(disks->colour);
        marks += disks->centres.size();
    }
    EXPECT_EQ(marks, 3U + 2U);  // two of them in the legend
    EXPECT_EQ(colours.front(), dark_theme.series[0]);
    EXPECT_EQ(colours.back(), dark_theme.series[1]);
}

TEST(PointsPicture, ManyPointsAreADensityThatCountsThemAll) {
    const PointSet points = make("random", {400'000, 2});
    const Drawing drawing = draw_points(picture_of({&points}), {}, {});
    EXPECT_TRUE(marks_of(drawing).empty());
    EXPECT_EQ(shapes_of<PixelImage>(drawing).size(), 2U);  // with the bar of colours
    EXPECT_LT(svg_bytes(drawing, 1).size(), 400'000U);
    const PointSet fewer = make("random", {50'000, 2});
    const Drawing pixels_of_points = draw_points(picture_of({&fewer}), {}, {});
    const PixelImage& raster = *shapes_of<PixelImage>(pixels_of_points).at(0);
    std::size_t dark = 0;
    for (const Colour& pixel : raster.pixels) dark += pixel != light_theme.background ? 1 : 0;
    EXPECT_GT(dark, 45'000U);  // some share a pixel
    EXPECT_LE(dark, 50'000U);
}

// The viewer is at high x, low y and high z.
TEST(PointsPicture, SpaceIsSeenFromAFixedPlace) {
    const Box box{{0, 0, 0}, {1, 1, 1}};
    const auto projected = [&](double x, double y, double z) {
        const std::array<double, 3> point = {x, y, z};
        return project(box, point);
    };
    EXPECT_GT(projected(1, 0, 0).right, projected(0, 0, 0).right);
    EXPECT_GT(projected(0, 1, 0).right, projected(0, 0, 0).right);
    EXPECT_GT(projected(0, 0, 1).up, projected(0, 0, 0).up);
    EXPECT_GT(projected(1, 0, 1).depth, projected(0, 1, 0).depth);
    // Equal lengths have equal images in all directions perpendicular to the view.
    const Projected a = projected(1, 0, 0);
    EXPECT_NEAR(a.right * a.right + a.up * a.up + a.depth * a.depth, 1, 1e-12);
    const PointSet points = make("random", {500, 3});
    EXPECT_EQ(marks_of(draw_points(picture_of({&points}), {}, {})).size(), 500U);
}

TEST(PointsPicture, EveryPairOfCoordinatesHasAPanel) {
    const PointSet points = make("random", {10, 5});
    EXPECT_EQ(marks_of(draw_points(picture_of({&points}), {}, {})).size(), 100U);
    const PointSet more = make("random", {10, 12});
    EXPECT_EQ(marks_of(draw_points(picture_of({&more}), {}, {})).size(), 280U);  // pairs of 8
}

// One scale for all panels: panels with a coordinate that is concentrated are darker.
TEST(PointsPicture, PairsOfManyPointsAreDensitiesInOneScale) {
    PointSet points = make("random", {100'000, 4});
    for (std::size_t i = 0; i < points.count(); ++i)
        for (std::size_t k = 0; k < 2; ++k) points.flat()[4 * i + k] *= 0.25;
    const Drawing drawing = draw_points(picture_of({&points}), {}, {});
    EXPECT_TRUE(marks_of(drawing).empty());
    const auto rasters = shapes_of<PixelImage>(drawing);
    ASSERT_EQ(rasters.size(), 7U);  // six pairs and the bar of colours
    const auto darkest = [&](std::size_t panel) {
        int least = 255;
        for (const Colour& pixel : rasters[panel]->pixels) least = std::min<int>(least, pixel.blue);
        return least;
    };
    EXPECT_LT(darkest(0), 60);   // both are concentrated: 16 times as dense
    EXPECT_GT(darkest(5), 180);  // none does
}

// 1, 10 and 100 on a logarithmic axis are at its start, middle and end; x and y have no common scale.
TEST(PointsPicture, LogarithmicAxesAreEvenInPowers) {
    const PointSet points = points_of({{1, 1}, {10, 2}, {100, 3}});
    PointsPicture picture = picture_of({&points});
    picture.log = {true, false};
    const auto marks = marks_of(draw_points(picture, {}, {}));
    ASSERT_EQ(marks.size(), 3U);
    EXPECT_NEAR(marks[1].x - marks[0].x, marks[2].x - marks[1].x, 0.01);
    EXPECT_NEAR(marks[0].y - marks[1].y, marks[1].y - marks[2].y, 0.01);
    EXPECT_NEAR(marks[2].x - marks[0].x, marks[0].y - marks[2].y, 2);  // a square
    EXPECT_TRUE(is_positive(picture.sets, 0));
    const PointSet zero = points_of({{0, 1}, {10, 2}});
    EXPECT_FALSE(is_positive({{&zero}}, 0));
    // A histogram has bins of equal width on the axis, and counts each value.
    const PointSet parts = points_of({{1.5, 1}, {10, 2}, {100, 3}});
    picture.sets = {&parts};
    const Chart chart = histogram_chart(picture);
    const Bars& bars = chart.panels[0].bars[0];
    EXPECT_TRUE(chart.panels[0].log_x);
    EXPECT_NEAR(bars.edges[1] / bars.edges[0], bars.edges[2] / bars.edges[1], 1e-9);
    double sum = 0;
    for (std::size_t i = 0; i < bars.heights.size(); ++i)
        sum += bars.heights[i] * std::log(bars.edges[i + 1] / bars.edges[i]);
    EXPECT_NEAR(sum, 1, 1e-9);
    // Three coordinates are drawn as pairs then, as a view in space has linear axes.
    const PointSet three = points_of({{1, 1, 1}, {10, 2, 2}, {100, 3, 3}});
    PointsPicture space = picture_of({&three});
    EXPECT_TRUE(is_space(space));
    space.log = {true, false, false};
    EXPECT_EQ(marks_of(draw_points(space, {}, {})).size(), 9U);
}

// Each of 16 x 16 cells contains its lower and left edge: one point (i / 16, j / 16).
TEST(PointsPicture, CellsOfADensityAreHalfOpenUpwards) {
    PointSet grid(256, 2);
    for (std::size_t i = 0; i < grid.count(); ++i) {
        grid[i][0] = static_cast<double>(i % 16) / 16;
        grid[i][1] = static_cast<double>(i / 16) / 16;
    }
    const auto cells_of = [](const PointSet& set, double width) {
        PointsPicture picture = picture_of({&set});
        picture.marking = Marking::density;
        return *shapes_of<PixelImage>(draw_points(picture, {.width = width}, {})).at(0);
    };
    std::size_t tried = 0;
    for (double width = 300; width < 400; ++width) {
        const PixelImage cells = cells_of(grid, width);
        if (cells.columns != 16 || cells.rows != 16) continue;
        ++tried;
        for (const Colour& pixel : cells.pixels)
            ASSERT_EQ(pixel.blue, cells.pixels[0].blue) << "width " << width;
        // A point on the upper border is in the last row.
        for (const auto& [y, row] : {std::pair{0.0, 15U}, {0.5, 7U}, {1.0, 0U}}) {
            const PixelImage one = cells_of(points_of({{0.25, y}}), width);
            EXPECT_NE(one.pixels[row * 16 + 4].blue, one.pixels[row * 16 + 5].blue) << y;
        }
    }
    EXPECT_GT(tried, 0U);
}

// Values of 0 and less are counted and left out; the others have bins that are equal on the axis.
TEST(PointsPicture, LogarithmicHistogramsCountWhatTheyLeaveOut) {
    PointSet points(200, 1);
    for (std::size_t i = 0; i < 200; ++i)
        points[i][0] = i < 12 ? -0.5 * static_cast<double>(i % 2) : std::exp2(0.1 * double(i));
    PointsPicture picture = picture_of({&points});
    picture.log = {true};
    const ChartPanel panel = histogram_chart(picture).panels.at(0);
    EXPECT_EQ(panel.values, 200U);
    EXPECT_EQ(panel.off_axis, 12U);
    EXPECT_EQ(panel.rug.size(), 188U);
    EXPECT_THAT(panel.y_name, HasSubstr("density of ln "));
    const Bars& bars = panel.bars.at(0);
    EXPECT_DOUBLE_EQ(bars.edges.front(), std::exp2(1.2));
    double sum = 0;
    for (std::size_t i = 0; i < bars.heights.size(); ++i) {
        const double width = std::log(bars.edges[i + 1] / bars.edges[i]);
        EXPECT_NEAR(width, std::log(bars.edges[1] / bars.edges[0]), 1e-9);
        EXPECT_NEAR(bars.heights[i] * 18.7 * std::log(2), 1, 0.1) << "equal heights";
        sum += bars.heights[i] * width;
    }
    EXPECT_NEAR(sum, 1, 1e-9);
    for (std::size_t i = 0; i < 200; ++i) points[i][0] = -points[i][0] * points[i][0];
    EXPECT_THAT(error_of([&] { histogram_chart(picture); }), HasSubstr("no value is above 0"));
    // Outcomes have a bar each.
    for (std::size_t i = 0; i < 200; ++i) points[i][0] = static_cast<double>(i % 13);
    const ChartPanel whole = histogram_chart(picture).panels.at(0);
    EXPECT_EQ(whole.off_axis, 16U);
    ASSERT_EQ(whole.bars[0].edges.size(), 13U);
    for (std::size_t i = 0; i < 13; ++i) EXPECT_EQ(whole.bars[0].edges[i], 0.5 + double(i));
}

// Each whole number has a bar or, if there are many, each bar has equally many; the density is that
// of the numbers.
TEST(PointsPicture, HistogramBarsOfWholeNumbersHoldEquallyMany) {
    const auto bars_of = [](const char* domain, int low, int numbers, std::size_t n) {
        PointSet points(n, 1);
        for (std::size_t i = 0; i < n; ++i)
            points[i][0] = low + static_cast<int>(i % static_cast<std::size_t>(numbers));
        points.domain = domain_named(domain, 1);
        const ChartPanel panel = histogram_chart(picture_of({&points})).panels.at(0);
        EXPECT_EQ(panel.whole_x, low > 0) << "no numbers such as 0.5 on the axis";
        return panel.bars.at(0);
    };
    for (const char* domain : {"integers:low=3,high=12", "unit-cube"}) {
        const Bars bars = bars_of(domain, 3, 10, 1000);
        ASSERT_EQ(bars.heights.size(), 10U) << domain;
        for (std::size_t i = 0; i < 10; ++i) {
            EXPECT_EQ(bars.edges[i], 2.5 + static_cast<double>(i));
            EXPECT_NEAR(bars.heights[i], 0.1, 1e-12);
        }
        EXPECT_EQ(bars.edges[10], 12.5);
    }
    // 52 numbers in bars of 3; the last holds one.
    const Bars many = bars_of("integers:low=1,high=52", 1, 52, 520);
    ASSERT_EQ(many.heights.size(), 18U);
    for (const double height : many.heights) EXPECT_NEAR(height, 1.0 / 52, 1e-12);
    EXPECT_EQ(many.edges[1] - many.edges[0], 3);
    EXPECT_EQ(many.edges.back(), 52.5);
    // On a log axis, whole numbers have equal heights relative to 1 / x, which is their density.
    PointSet wide(8191, 1);
    for (std::size_t i = 0; i < wide.count(); ++i)
        wide[i][0] = std::floor(std::exp2(13 * (static_cast<double>(i) + 0.5) / 8191));
    wide.domain = domain_named("integers:low=1,high=8191", 1);
    PointsPicture picture = picture_of({&wide});
    picture.log = {true};
    const Bars bars = histogram_chart(picture).panels.at(0).bars.at(0);
    EXPECT_EQ(bars.edges.front(), 0.5);
    EXPECT_EQ(bars.edges.back(), 8191.5);
    for (std::size_t i = 0; i < bars.heights.size(); ++i) {
        EXPECT_EQ(bars.edges[i], std::floor(bars.edges[i]) + 0.5);
        EXPECT_NEAR(bars.heights[i] * std::log(8192), 1, bars.edges[i] > 20 ? 0.05 : 0.5);
    }
    // The corners of the unit cube are not numbers of a discrete distribution.
    EXPECT_EQ(bars_of("unit-cube", 0, 2, 100).edges.front(), 0);
}

TEST(PointsPicture, NoTextLeavesThePicture) {
    const PointSet wide = points_of({{0, 0}, {100000.5, 1}});
    const PointSet five = make("random", {100, 5});
    const PointSet three = make("random", {100, 3});
    for (const PointSet* points : {&wide, &five, &three})
        for (const double width : {300.0, 800.0}) {
            const Drawing drawing = draw_points(picture_of({points}), {.width = width}, {});
            for (const Label* label : shapes_of<Label>(drawing)) {
                EXPECT_TRUE(label->at.x >= 0 && label->at.x <= drawing.width) << label->text;
                EXPECT_TRUE(label->at.y >= 0 && label->at.y <= drawing.height) << label->text;
            }
        }
}

TEST(DistanceChart, CountsEveryPoint) {
    const PointSet points = make("random", {1000, 2});
    const PointSet* const sets[] = {&points};
    const Chart chart = distance_chart(sets, {"a"}, false, {});
    const Bars& bars = chart.panels.at(0).bars.at(0);
    double sum = 0;
    for (const double height : bars.heights) sum += height * (bars.edges[1] - bars.edges[0]);
    EXPECT_NEAR(sum, 1, 1e-9);
    // The density for independent points has its maximum at 1 / sqrt(2 pi n).
    const Guide& guide = chart.panels[0].guides.at(0);
    const auto top = std::ranges::max_element(guide.y) - guide.y.begin();
    EXPECT_NEAR(guide.x[static_cast<std::size_t>(top)], 1 / std::sqrt(2 * std::numbers::pi * 1000),
                1e-3);
    const PointSet one = points_of({{0.5, 0.5}});
    const PointSet* const single[] = {&one};
    EXPECT_THROW(distance_chart(single, {"a"}, false, {}), Error);
    const PointSet same = points_of({{0.5, 0.5}, {0.5, 0.5}});
    const PointSet* const equal[] = {&same};
    EXPECT_THROW(distance_chart(equal, {"a"}, false, {}), Error);
}

// The density of ln r, r p(r), integrates to 1 over ln r.
TEST(DistanceChart, HasBinsOfLogarithmsOnALogAxis) {
    PointSet points = make("random", {1000, 2});
    for (std::size_t k = 0; k < 2; ++k) points[1][k] = points[0][k];
    const PointSet* const sets[] = {&points};
    const ChartPanel panel = distance_chart(sets, {"a"}, true, {}).panels.at(0);
    EXPECT_EQ(panel.off_axis, 2U);
    const Bars& bars = panel.bars.at(0);
    double sum = 0;
    for (std::size_t i = 0; i < bars.heights.size(); ++i) {
        const double width = std::log(bars.edges[i + 1] / bars.edges[i]);
        EXPECT_NEAR(width, std::log(bars.edges[1] / bars.edges[0]), 1e-9);
        sum += bars.heights[i] * width;
    }
    EXPECT_NEAR(sum, 1, 1e-9);
    const Guide& guide = panel.guides.at(0);
    double area = 0;
    for (std::size_t i = 1; i < guide.x.size(); ++i)
        area += (guide.y[i] + guide.y[i - 1]) / 2 * std::log(guide.x[i] / guide.x[i - 1]);
    EXPECT_NEAR(area, 1, 0.01);
}

// ---------------------------------------------------------------- rims

TEST(DomainOutline, GoesRoundTheDomainsArea) {
    const auto area = [](const char* spec) { return area_of(outline_of(*parse_domain(spec, 2))); };
    EXPECT_NEAR(area("disk"), std::numbers::pi, 1e-4);
    EXPECT_NEAR(area("disk:radius=2"), 4 * std::numbers::pi, 4e-4);
    EXPECT_NEAR(area("triangle:vertices=[0,0 1,0 0,1]"), 0.5, 1e-4);
    EXPECT_NEAR(area("annulus:inner=0.5"), 0.75 * std::numbers::pi, 1e-4);  // a hole
}

// The corner of a triangle is drawn, not cut off.
TEST(DomainOutline, HasCorners) {
    double nearest = 1;
    for (const auto& line : outline_of(*parse_domain("triangle:vertices=[0,0 1,0 0,1]", 2)))
        for (const Position& position : line)
            nearest = std::min(nearest, std::hypot(position.x - 1, position.y));
    EXPECT_LT(nearest, 1e-3);
}

TEST(DomainOutline, IsNoneForALineInThePlane) {
    EXPECT_TRUE(outline_of(*parse_domain("circle", 2)).empty());
    EXPECT_TRUE(outline_of(*unit_cube(3)).empty());
}

// ---------------------------------------------------------------- characters

// Dots of a Braille character, by hand: the left column is 1 2 3 7, the right one 4 5 6 8.
namespace {

std::size_t dots_in(const DotMatrix& matrix) {
    std::size_t sum = 0;
    for (std::size_t row = 0; row < matrix.height() / 4; ++row)
        for (const char32_t letter : code_points(matrix.row(row)))
            sum += static_cast<std::size_t>(
                std::popcount(static_cast<std::uint32_t>(letter) - 0x2800U));
    return sum;
}

}  // namespace

TEST(DotMatrix, DotsAreWhereBrailleHasThem) {
    DotMatrix dots(1, 1);
    dots.set(0, 1);
    EXPECT_EQ(dots.row(0), "⠁");
    dots.set(1, 0);
    EXPECT_EQ(dots.row(0), "⢁");
    dots.set(0.1, 0.1);
    dots.set(0.9, 0.9);
    EXPECT_EQ(dots.row(0), "⣉");
    dots.set(0.1, 0.6);
    EXPECT_EQ(dots.row(0), "⣋");
    EXPECT_EQ(dots_in(dots), 5U);
    dots.set(1.01, 0.5);
    dots.set(std::nan(""), 0.5);
    EXPECT_EQ(dots_in(dots), 5U);
    dots.draw(0, 0, 1, 1);
    EXPECT_EQ(DotMatrix(0, 0).row(0), "⠀");
}

TEST(DotMatrix, LinesHaveNoGaps) {
    DotMatrix dots(10, 5);
    dots.draw(0, 0.5, 1, 0.5);
    EXPECT_EQ(dots_in(dots), 20U);
    DotMatrix diagonal(2, 1);
    diagonal.draw(0, 1, 1, 0);
    EXPECT_EQ(diagonal.row(0), "⠑⢄");
    DotMatrix rising(2, 1);
    rising.draw(0, 0, 1, 1);
    EXPECT_EQ(rising.row(0), "⡠⠊");
}

// Cells have their lower edges, whatever rounds.
TEST(DotMatrix, PointsOnEdgesAreInTheCellAbove) {
    for (const double n : {4, 5, 8, 10, 20}) {
        DotMatrix grid(10, 5), moved(10, 5);
        for (double i = 0; i < n; ++i)
            for (double j = 0; j < n; ++j) {
                grid.set(i / n, j / n);
                moved.set((i + 0.01) / n, (j + 0.01) / n);
            }
        EXPECT_EQ(dots_in(grid), static_cast<std::size_t>(n * n));
        for (std::size_t row = 0; row < 5; ++row) EXPECT_EQ(grid.row(row), moved.row(row));
    }
    DotMatrix bar(1, 10);
    bar.draw(0, 0, 0, 1);
    EXPECT_EQ(dots_in(bar), 40U);
    bar.set(1 + 1e-12, -1e-12);  // corners of projected boxes
    EXPECT_EQ(dots_in(bar), 41U);
}

// 200 bins in 60 columns of dots.
TEST(TextPicture, NarrowBarsAreThere) {
    ChartPanel panel{.x_name = "x", .y_name = "y", .from_zero = true};
    panel.bars.push_back(histogram_of(std::vector(1, 0.3), 0, 1, 200));
    for (double& height : panel.bars[0].heights) height = std::max(height, 1.0);
    const std::string text =
        chart_as_text({.title = "", .panels = {panel}}, {}, {.columns = 36, .rows = 14});
    const std::size_t below = text.rfind("│", text.rfind("│") - 1);
    const std::string row = text.substr(below, text.rfind("│") - below);
    EXPECT_EQ(row.find("⠀"), row.npos) << text;  // the lowest row has no gap
    const std::size_t left = text.find("│");
    std::string top = text.substr(left, text.find("│", left + 1) - left);
    replace_all(top, "⠀", "");
    EXPECT_NE(top, "│") << text;  // the high bar
}

TEST(TextPicture, HasADotForEachPoint) {
    const PointSet points = points_of({{0, 0}, {1, 1}, {0, 1}, {1, 0}, {0.5, 0.5}});
    const std::string text = points_as_text(picture_of({&points}), {.columns = 26, .rows = 14});
    EXPECT_THAT(text, HasSubstr("│⠁"));  // the point at the upper left
    EXPECT_THAT(text, HasSubstr("⢀│"));  // at the lower right
    EXPECT_THAT(text, HasSubstr("⡀"));
    EXPECT_THAT(text, HasSubstr("⠈│"));
    std::size_t longest = 0;
    std::size_t rows = 0;
    for (std::size_t at = 0; at < text.size(); ++rows) {
        const auto end = text.find('\n', at);
        std::size_t letters = 0;
        for (std::size_t i = at; i < end; ++i) letters += (text[i] & 0xC0) != 0x80 ? 1 : 0;
        longest = std::max(longest, letters);
        at = end + 1;
    }
    EXPECT_LE(longest, 26U);
    EXPECT_LT(rows, 14U);
}

TEST(TextPicture, DrawsInAnyRoom) {
    const PointSet points = make("random", {100, 2});
    const PointSet line = make("random", {100, 1});
    const PointSet space = make("random", {100, 3});
    for (const std::size_t columns : {0U, 1U, 20U, 500U})
        for (const PointSet* set : {&points, &line, &space})
            EXPECT_FALSE(
                points_as_text(picture_of({set}), {.columns = columns, .rows = 0}).empty());
    const Grid power{.rows = 9, .columns = 9, .values = std::vector<double>(81, 1.0)};
    EXPECT_THAT(spectrum_as_text(power, {.columns = 30, .rows = 20}), HasSubstr("▒▒"));
}

}  // namespace stipple::testing::points_picture_test
