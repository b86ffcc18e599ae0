// SPDX-License-Identifier: MIT
//
// Unit cube onto a box of d dimensions, with any bounded density given by a formula. A point of the
// box, determined by xi0 ... xi(d-1), is kept if
//
//     xi_d * bound  <  f(point).
//
// The fraction kept, the efficiency, is the integral of f divided by bound times the box's volume.
//
// Shape   d + 1 unit coordinates, where d = 1 to 3 is the number of ranges in --bounds; d
//         coordinates.
// Strata  coordinates keep their strata, except for the points dropped; the last coordinate decides
//         which points these are.
// Cost    one evaluation of f per point, about 100 ns.
// Promise exact for any f below the bound. A value above the bound is an error that reports the
//         point and the value. density() is f over its integral by quadrature.
// Beware  values of f above the bound go unnoticed if no point falls there.
// Source  J. von Neumann, "Various techniques used in connection with random digits", NBS Applied
//         Mathematics Series 12 (1951) 36-38.

#include <cmath>

#include "core/error.hpp"
#include "core/spec.hpp"
#include "core/text.hpp"
#include "math/densities/line_table.hpp"
#include "warps/densities/formula_box.hpp"
#include "warps/warp.hpp"

namespace stipple::warps::rejection {
namespace {

constexpr Param<Text> density{
    {.name = "density",
     .help = "Formula (stipple help formulas) in as many of x, y, z as "
             "--bounds has ranges, not negative; its integral need not be 1"}};
constexpr Param<double> bound{
    .name = "bound",
    .fallback = 1,
    .low = 0,
    .low_open = true,
    .help = "Upper bound of the formula's values; a larger one is an error"};
constexpr Param<Text> bounds{
    {.name = "bounds",
     .fallback = "0..1,0..1",
     .help = "Box: lo..hi,lo..hi, a range for each of 1 to 3 coordinates"}};

class Rejection final : public Mapping {
  public:
    Rejection(const std::shared_ptr<const FormulaBox>& box, double top)
        : Mapping(box, "this warp has no inverse"), density_(*box), bound_(top) {}

    std::size_t cube_dimension() const override { return density_.dimension() + 1; }
    bool drops() const override { return true; }

    void forward(std::span<const double> cube, std::span<double> image,
                 std::span<std::uint8_t> keep) const override {
        const std::size_t d = density_.dimension();
        const Box& box = density_.box();
        for (std::size_t i = 0; i < keep.size(); ++i)
            for (std::size_t k = 0; k < d; ++k) {
                const double x = box.low[k] + cube[i * (d + 1) + k] * box.extent(k);
                image[i * d + k] = x < box.high[k] ? x : std::nextafter(box.high[k], box.low[k]);
            }
        std::vector<double> values(keep.size());
        density_.formula().evaluate(image.first(d * keep.size()), values);
        for (std::size_t i = 0; i < keep.size(); ++i) {
            check(image.subspan(i * d, d), values[i]);
            keep[i] = cube[i * (d + 1) + d] * bound_ < values[i];
        }
    }

  private:
    void check(std::span<const double> place, double value) const {
        if (value >= 0 && value <= bound_) return;
        require_density("--density: " + density_.formula().text(), place, value);
        if (value > bound_)
            fail(ErrorKind::usage, "--bound: the density is {} at {}, above the bound {}", value,
                 place_text(place), bound_);
    }

    const FormulaBox& density_;
    double bound_;
};

std::unique_ptr<Mapping> make(const WarpRequest& want) {
    if (!want.options.given(density))
        fail(ErrorKind::usage,
             "--density: no formula given; expected one such as 'exp(-x*x - y*y)'");
    const Box box = formula_bounds(want.options[bounds], 3);
    Expression f(density.name, want.options[density], box.dimension());
    Values law = want.warp.options.defaults();  // the domain's spec leaves out --bound
    law.put(density.name, f.text());
    law.put(bounds.name, want.options[bounds]);
    return std::make_unique<Rejection>(
        std::make_shared<FormulaBox>(format_spec(want.warp.name, law, want.warp.options),
                                     std::move(f), box),
        want.options[bound]);
}

}  // namespace

Warp unit() {
    return {.name = "rejection",
            .summary = "Box with a density given by any formula, by dropping points",
            .source = "von Neumann 1951, NBS Applied Mathematics Series 12, 36-38",
            .related = {"accept-reject"},
            .strata =
                "coordinates keep their strata, except for the points dropped; the last unit "
                "coordinate decides which",
            .traits = {.invertible = false, .drops = true},
            .options = Schema(density, bound, bounds),
            .mapping = make};
}

}  // namespace stipple::warps::rejection
