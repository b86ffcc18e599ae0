// SPDX-License-Identifier: MIT
//
// Unit square onto a box of the plane, with the density given by a formula f(x, y): first the
// marginal, then the conditional distribution,
//
//     p(x) = integral of p(x, y) dy from xi0,    p(y | x) = p(x, y) / p(x) from xi1,
//
// of a table of f that is bilinear on patches (math/densities/strip_table.hpp); both are inverted
// exactly.
//
// Shape   2 unit coordinates, 2 coordinates in the box.
// Strata  xi0 and xi1 are used directly: small xi0 is left and, at each x, small xi1 is at the
//         bottom. Strata of xi0 are vertical strips of equal mass.
// Cost    about 100 ns a point. At the default tolerance the table takes 40 ms for a smooth f, 0.5
//         s if f jumps along an oblique line; the time is proportional to 1 / tolerance.
// Promise no probability is off by more than about the tolerance, to which the table approximates
//         f. The points' density is the table's, up to rounding; the domain's is f over its
//         integral by quadrature. A round trip returns xi within 1e-13. If f is 0 on one side of a
//         jump, no points fall there, unless the 9 values sampled per patch miss the zeros.
// Beware  F(x, y) / F(x, y_max) would be wrong: it is the distribution of y given X <= x.

#include <array>
#include <memory>
#include <span>

#include "core/error.hpp"
#include "core/spec.hpp"
#include "math/densities/strip_table.hpp"
#include "warps/densities/formula_box.hpp"
#include "warps/row_mapping.hpp"

namespace stipple::warps::expression_2d {
namespace {

constexpr Param<Text> density{
    {.name = "density",
     .help = "Formula in x and y (stipple help formulas), not negative; its integral need not be "
             "1: 'x + y', "
             "'x + y < 1 ? 1 : 0'. It is evaluated at 393 216 points or more: features that "
             "contain a disk 1/256 as wide as the ranges are found, with a mass right to 3 %; "
             "smaller ones may be missed"}};
constexpr Param<Text> bounds{{.name = "bounds",
                              .fallback = "0..1,0..1",
                              .help = "Ranges of x and y: lo..hi,lo..hi, or one for both"}};
constexpr Param<double> tolerance{
    .name = "tolerance",
    .fallback = 3e-4,
    .low = 1e-7,
    .high = 0.1,
    .help =
        "Largest error of any probability; the columns pdf and weight are those of the actual "
        "points, so that estimates from them have no such error"};

struct ByTable {
    std::shared_ptr<const StripTable> table;

    std::array<double, 2> forward(const std::array<double, 2>& xi) const {
        return table->quantile(xi[0], xi[1]);
    }
    std::array<double, 2> inverse(std::span<const double> point) const {
        return table->fraction(point[0], point[1]);
    }
    double density(std::span<const double> point) const {
        return table->density(point[0], point[1]);
    }
};

std::unique_ptr<Mapping> make(const WarpRequest& want) {
    if (!want.options.given(density))
        fail(ErrorKind::usage,
             "--density: no formula given; expected one in x and y, such as 'x + y'");
    const Box box = parse_box(want.options[bounds], 2);
    Expression f(density.name, want.options[density], 2);
    Values plain = want.options;  // the spec shows the formula without blanks
    plain.put(density.name, f.text());
    const auto domain = std::make_shared<FormulaBox>(
        format_spec(want.warp.name, plain, want.warp.options), std::move(f), box);
    const Expression& formula = domain->formula();
    const auto table = std::make_shared<const StripTable>(tabulate_strips(
        "--density: " + formula.text(),
        [&](std::span<const double> at, std::span<double> values) { formula.evaluate(at, values); },
        box, want.options[tolerance], want.run));
    return row_mapping(domain, ByTable{table});
}

}  // namespace

Warp unit() {
    return {.name = "expression-2d",
            .summary = "Box of the plane with a density given by a formula in x and y",
            .source =
                "Marginal, then conditional: M. Rosenblatt 1952, "
                "doi:10.1214/aoms/1177729394",
            .related = {"density"},
            .strata =
                "xi1 is the fraction of the mass left of x, xi2 the fraction of the mass at that x "
                "below y; both are used directly",
            .traits = {.tabulated = true},
            .options = Schema(density, bounds, tolerance),
            .aliases = {"formula-2d"},
            .stream_version = 3,
            .mapping = make};
}

}  // namespace stipple::warps::expression_2d
