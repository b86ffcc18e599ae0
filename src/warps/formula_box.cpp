// SPDX-License-Identifier: MIT
#include "warps/formula_box.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/text.hpp"
#include "math/line_table.hpp"
#include "math/quadrature.hpp"

namespace stipple::warps {
namespace {

// One coordinate inside the other: in three, what is affordable is less.
Effort effort_for(std::size_t dimension) {
    if (dimension <= 1) return {1e-12, 2000};
    if (dimension == 2) return {1e-9, 150};
    return {1e-5, 12};
}

Effort effort_in_cell(std::size_t dimension) {
    if (dimension <= 1) return {1e-10, 200};
    if (dimension == 2) return {1e-6, 40};
    return {1e-4, 5};
}

}  // namespace

FormulaBox::FormulaBox(std::string spec, Expression f, Box box)
    : spec_(std::move(spec)), f_(std::move(f)), box_(std::move(box)) {}

Estimate FormulaBox::integral() const {
    std::call_once(once_, [this] {
        const std::string what = "--density: " + f_.text();
        integral_ = integrate_box(
            [&](std::span<const double> point) {
                const double value = f_.at(point);
                require_density(what, point, value);
                return value;
            },
            box_, effort_for(dimension()));
        if (!(integral_.value > 0))
            fail(ErrorKind::usage, "{} is 0 wherever it was looked at in {}", what,
                 format_box(box_));
    });
    return integral_;
}

double FormulaBox::measure() const {
    double volume = 1;
    for (std::size_t k = 0; k < dimension(); ++k) volume *= box_.extent(k);
    return volume;
}

bool FormulaBox::contains(std::span<const double> point) const {
    for (std::size_t k = 0; k < dimension(); ++k)
        if (!(point[k] >= box_.low[k] && point[k] <= box_.high[k])) return false;
    return true;
}

double FormulaBox::density(std::span<const double> point) const {
    return contains(point) ? f_.at(point) / integral().value : 0;
}

void FormulaBox::to_cube(std::span<const double> point, std::span<double> cube) const {
    for (std::size_t k = 0; k < dimension(); ++k)
        cube[k] = std::clamp((point[k] - box_.low[k]) / box_.extent(k), 0.0, 1.0);
}

Estimate FormulaBox::probability(const Box& cell) const {
    Box part = box_;
    for (std::size_t k = 0; k < dimension(); ++k) {
        part.low[k] = box_.low[k] + cell.low[k] * box_.extent(k);
        part.high[k] =
            cell.high[k] < 1 ? box_.low[k] + cell.high[k] * box_.extent(k) : box_.high[k];
    }
    const Estimate mass = integrate_box([&](std::span<const double> point) { return f_.at(point); },
                                        part, effort_in_cell(dimension()));
    const Estimate whole = integral();
    const double share = mass.value / whole.value;
    return {share, (mass.error + share * whole.error) / whole.value};
}

std::vector<std::string> FormulaBox::cube_axes() const {
    std::vector<std::string> names;
    for (std::size_t k = 0; k < dimension(); ++k) names.push_back(fmt::format("x{}", k + 1));
    return names;
}

void FormulaBox::require(std::span<const double> point) const {
    if (!contains(point))
        fail(ErrorKind::input, "the point ({}) is outside the box of {}", fmt::join(point, ", "),
             spec_);
}

Box formula_bounds(const std::string& text, std::size_t most) {
    const std::size_t ranges = split(text, ',').size();
    if (ranges > most)
        fail(ErrorKind::usage, "--bounds: {} ranges; {} are allowed at most", ranges, most);
    return parse_box(text, std::max<std::size_t>(ranges, 1));
}

}  // namespace stipple::warps
