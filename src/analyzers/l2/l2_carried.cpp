// SPDX-License-Identifier: MIT
#include "analyzers/l2/l2_carried.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "analyzers/l2/l2_meetings.hpp"
#include "core/parallel.hpp"

namespace stipple::analyzers::l2 {
namespace {

/// Of a factor: see AxisForm::put.
constexpr std::size_t numbers_of_factor = 5;

/// The nearest multiple of 2^-53.
double whole(double x) { return std::round(x * 0x1p53) * 0x1p-53; }

/// The high part a multiple of `step`.
DoubleDouble on_grid(const DoubleDouble& a, double step) {
    const double high = std::round(a.high / step) * step;
    return {high, (a.high - high) + a.low};
}

/// The factor of an axis over its scale, as numbers of each point.
class AxisForm {
  public:
    /// @param around whether the two minima of the centered kernel are one factor
    AxisForm(Kind kind, bool alone, bool around, double weight)
        : kind_(kind), alone_(alone), around_(around) {
        const Quad curve = kind == Kind::diaphony ? Quad(diaphony) * weight : Quad(weight);
        inverse_ = alone ? Quad(0) : Quad(1) / curve;
        scale_ = alone ? Quad(1) : curve;
        if (kind == Kind::centered) scale_ *= curve;
        if (kind == Kind::mixture) scale_ /= 2;
        const Quad top = kind == Kind::diaphony ? Quad(1) / 6 : Quad(1) / 2;
        if (bends()) base_ = inverse_ + top - Quad(1) / 4;
        if (kind == Kind::extreme) base_ = inverse_;
        if (kind == Kind::mixture) {
            base_ = inverse_ + Quad(7) / 8 - Quad(9) / 32;
            const double twice = 2 * static_cast<double>(base_);
            step_ = std::ldexp(1.0, std::ilogb(twice) - 52);
        }
        top_ = to_double_double(kind == Kind::centered  ? Quad(inverse_ + 0.5)
                                : kind == Kind::mixture ? Quad(base_ + 0.25)
                                                        : Quad(inverse_ + 1));
        bottom_ = to_double_double(kind == Kind::mixture ? Quad(base_ - 0.25) : inverse_);
    }

    [[nodiscard]] const Quad& scale() const { return scale_; }
    [[nodiscard]] bool bends() const {
        return kind_ == Kind::periodic || kind_ == Kind::wraparound || kind_ == Kind::diaphony;
    }
    [[nodiscard]] bool is_around() const { return around_; }
    [[nodiscard]] bool is_excess() const { return kind_ == Kind::extreme && !alone_; }

    /// Factors on the axis.
    [[nodiscard]] std::size_t factors() const {
        const bool two = kind_ == Kind::centered || (kind_ == Kind::extreme && alone_);
        return two && !around_ ? 2 : 1;
    }

    /// What is added to a factor and taken off again, lest it come near 0 before.
    [[nodiscard]] double shift() const {
        const bool small = (bends() && base_ < Quad(0.25)) || (is_excess() && base_ < Quad(0.5));
        return small ? 1 : 0;
    }

    [[nodiscard]] AxisConstants constants() const {
        AxisConstants axis;
        if (!bends() && !is_excess()) return axis;
        const DoubleDouble base = to_double_double(base_ + shift());
        axis.base = base.high;
        axis.shift = shift();
        axis.lost = base.low;
        return axis;
    }

    /// More than the factors over the scale.
    [[nodiscard]] double most() const {
        if (kind_ == Kind::mixture) return static_cast<double>(2 * inverse_ + Quad(7) / 4);
        if (bends()) return static_cast<double>(base_ + 0.25);
        const auto one = static_cast<double>(inverse_ + 1);
        return factors() == 2 ? one * one : one;
    }

    /// Numbers of a point: of a factor its place in the order, the place less the parabola's
    /// corner, the place's rest, its value and the correction.
    void put(double x, double* to) const {
        const auto write = [&](double place, const DoubleDouble& number) {
            const bool split = bends() || kind_ == Kind::mixture;
            const double at = split ? whole(place) : place;
            *to++ = at;
            *to++ = at - (bends() ? corner_of_bend : corner_of_mixture);
            *to++ = place - at;
            *to++ = number.high;
            *to++ = number.low;
        };
        if (around_) return write(x, {x - 0.5, 0.5 - x});
        switch (kind_) {
            case Kind::star:
            case Kind::modified:
                return write(-x, top_ + DoubleDouble{-x, 0});
            case Kind::extreme:
                if (alone_) write(x, {x, 0});
                return write(alone_ ? -x : x, DoubleDouble{1, 0} + DoubleDouble{-x, 0});
            case Kind::centered:
                write(x, bottom_ + DoubleDouble{std::max(x - 0.5, 0.0), 0});
                return write(-x, x < 0.5 ? top_ + DoubleDouble{-x, 0} : bottom_);
            case Kind::mixture:
                return write(x, on_grid(x < 0.5 ? bottom_ + DoubleDouble{x / 2, 0}
                                                : top_ + DoubleDouble{-x / 2, 0},
                                        step_));
            default:
                return write(x, {0, 0});
        }
    }

  private:
    Kind kind_;
    bool alone_;
    bool around_;
    Quad inverse_;  ///< 1 over the weight
    Quad scale_;
    Quad base_ = 0;
    double step_ = 0;
    DoubleDouble top_ = {};     ///< what coordinates are taken from
    DoubleDouble bottom_ = {};  ///< what they are added to
};

/// The axes that have a weight.
struct Axes {
    std::vector<std::size_t> places;
    std::vector<AxisForm> forms;
    std::vector<AxisTerms> terms;
};

Axes axes_of(std::size_t dimension, Kind kind, const std::vector<double>& weights, bool around) {
    const bool alone = weights.empty() && !record_of(kind).projections;
    Axes axes;
    for (std::size_t j = 0; j < dimension; ++j) {
        const double weight = weights.empty() ? 1 : weights[j];
        if (weight == 0) continue;
        axes.places.push_back(j);
        axes.forms.emplace_back(kind, alone, around, weight);
        axes.terms.emplace_back(record_of(kind), alone, weight);
    }
    return axes;
}

/// Whether the two minima of the centered kernel are what is more than 1 of one factor, exactly.
bool is_around(const PointSet& points, Kind kind, const std::vector<double>& weights) {
    if (kind != Kind::centered || std::ranges::any_of(weights, [](double w) { return w != 1; }))
        return false;
    return std::ranges::all_of(points.flat(), [](double x) { return x == whole(x); });
}

/// What of the numbers is not 0.
struct Needs {
    bool rests = false;
    bool corrections = false;
    bool constants = false;  ///< shifts or corrections of axes
};

Form form_of(const AxisForm& form, Kind kind, const Needs& needs) {
    if (form.is_around()) return Form::around;
    if (form.is_excess()) return Form::excess;
    if (form.bends() && needs.constants)
        return needs.rests ? Form::bend_shifted_fine : Form::bend_shifted;
    if (form.bends()) return needs.rests ? Form::bend_fine : Form::bend;
    if (kind == Kind::mixture) return needs.rests ? Form::mixture_fine : Form::mixture;
    return needs.corrections ? Form::least_carried : Form::least;
}

/// Which of the numbers of AxisForm::put are columns.
std::vector<std::size_t> columns_from(Form form) {
    switch (form) {
        case Form::least:
            return {3};
        case Form::around:
            return {3, 4};
        case Form::bend:
        case Form::bend_shifted:
            return {0, 1};
        case Form::bend_fine:
        case Form::bend_shifted_fine:
            return {0, 1, 2};
        case Form::mixture:
            return {0, 1, 3, 4};
        case Form::mixture_fine:
            return {0, 1, 2, 3, 4};
        default:
            return {0, 3, 4};
    }
}

/// Sums of the products of the factors' means.
class Means {
  public:
    explicit Means(const std::vector<AxisTerms>& axes) {
        for (const AxisTerms& axis : axes) {
            auto& terms = axes_.emplace_back();
            std::ranges::transform(axis.mean_terms(), terms.begin(), to_double_double);
        }
    }

    /// The mean of an axis's factor over the other point.
    [[nodiscard]] DoubleDouble of(std::size_t axis, double x) const {
        const auto& terms = axes_[axis];
        DoubleDouble mean = terms[0];
        if (terms[2].high != 0)
            mean = mean + (terms[1] + terms[2] * DoubleDouble{x, 0}) * DoubleDouble{x, 0};
        else if (terms[1].high != 0)
            mean = mean + terms[1] * DoubleDouble{x, 0};
        const DoubleDouble place = exact_sum(x, -0.5);
        const double sign = place.high < 0 ? -1 : 1;
        if (terms[3].high != 0)
            mean = mean + terms[3] * DoubleDouble{sign * place.high, sign * place.low};
        return mean;
    }

  private:
    std::vector<std::array<DoubleDouble, 4>> axes_;
};

/// What AxisForm::put gives for all points, and what there is to heed.
struct Numbers {
    std::vector<double> of;
    std::size_t factors = 0;
    Quad means = 0;  ///< mean of the products of the factors' means
    Needs needs;
};

Numbers numbers_of(const PointSet& points, const Axes& axes, const RunContext& run) {
    constexpr std::size_t stretch = 256;  ///< of points whose means are summed in pairs of doubles
    const Means means(axes.terms);
    Numbers numbers;
    for (const AxisForm& form : axes.forms) numbers.factors += form.factors();
    numbers.of.resize(points.count() * numbers.factors * numbers_of_factor);
    double* to = numbers.of.data();
    for (std::size_t first = 0; first < points.count(); first += stretch) {
        run.check_stop();
        DoubleDouble sum;
        for (std::size_t i = first; i < std::min(first + stretch, points.count()); ++i) {
            DoubleDouble mean = {1, 0};
            for (std::size_t j = 0; j < axes.places.size(); ++j) {
                const double x = points[i][axes.places[j]] + 0.0;
                axes.forms[j].put(x, to);
                for (std::size_t f = 0; f < axes.forms[j].factors(); ++f, to += numbers_of_factor) {
                    numbers.needs.rests = numbers.needs.rests || to[2] != 0;
                    numbers.needs.corrections = numbers.needs.corrections || to[4] != 0;
                }
                mean = mean * means.of(j, x);
            }
            sum = sum + mean;
        }
        numbers.means += Quad(sum.high) + sum.low;
    }
    numbers.means /= points.count();
    return numbers;
}

/// An order of the points in which blocks of them lie beside each other on as many axes as may be:
/// parts are halved along one axis after the other, the first time in the middle of the cube if
/// sides of it matter.
class Halving {
  public:
    Halving(const PointSet& points, const Axes& axes, bool sides)
        : points_(points), axes_(axes), sides_(sides), order_(points.count()) {
        std::iota(order_.begin(), order_.end(), std::size_t{0});
        halve(0, order_.size(), 0);
    }

    [[nodiscard]] const std::vector<std::size_t>& order() const { return order_; }

  private:
    void halve(std::size_t first, std::size_t last, std::size_t depth) {
        const auto from = order_.begin() + static_cast<std::ptrdiff_t>(first);
        const auto to = order_.begin() + static_cast<std::ptrdiff_t>(last);
        if (last - first <= block_width) return std::sort(from, to);
        const std::size_t axis = axes_.places[depth % axes_.places.size()];
        const auto at = [&](std::size_t i) { return points_[i][axis]; };
        std::size_t middle = 0;
        if (sides_ && depth < axes_.places.size()) {
            const auto half = std::partition(from, to, [&](std::size_t i) { return at(i) < 0.5; });
            middle = static_cast<std::size_t>(half - order_.begin());
        } else {
            const std::size_t blocks = block_count(last - first, block_width);
            middle = first + blocks / 2 * block_width;
            std::nth_element(from, order_.begin() + static_cast<std::ptrdiff_t>(middle), to,
                             [&](std::size_t i, std::size_t j) {
                                 return at(i) != at(j) ? at(i) < at(j) : i < j;
                             });
        }
        halve(first, middle, depth + 1);
        halve(middle, last, depth + 1);
    }

    const PointSet& points_;
    const Axes& axes_;
    bool sides_;
    std::vector<std::size_t> order_;
};

Table table_of(Form form, const Numbers& numbers, const std::vector<AxisConstants>& factors,
               const std::vector<std::size_t>& order) {
    Table table(form, order.size(), factors);
    const std::vector<std::size_t> from = columns_from(form);
    std::vector<double> columns(from.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        for (std::size_t f = 0; f < numbers.factors; ++f) {
            const std::size_t at = (order[i] * numbers.factors + f) * numbers_of_factor;
            for (std::size_t c = 0; c < from.size(); ++c) columns[c] = numbers.of[at + from[c]];
            table.put(i, f, columns.data(), numbers.of[at] + numbers.of[at + 2]);
        }
    return table;
}

}  // namespace

bool carries(std::size_t dimension, Kind kind, const std::vector<double>& weights) {
    constexpr std::size_t most_axes = 400;
    constexpr double most_binades = 500;
    if (dimension > most_axes) return false;
    double binades = 0;
    for (const AxisForm& form : axes_of(dimension, kind, weights, false).forms)
        binades += std::abs(std::log2(static_cast<double>(form.scale()))) +
                   std::log2(std::max(form.most(), 1.0));
    return binades <= most_binades;
}

Square carried_square(const PointSet& points, Kind kind, const std::vector<double>& weights,
                      const RunContext& run, Vectors widest) {
    const bool around = is_around(points, kind, weights);
    const Axes axes = axes_of(points.dimension(), kind, weights, around);
    if (axes.places.empty()) {  // all weights are 0
        run.tick(1, 1);
        return {0, 0};
    }
    Numbers numbers = numbers_of(points, axes, run);
    std::vector<AxisConstants> factors;
    Quad total = 1;
    Quad scale = 1;
    Quad most = 1;
    bool shifted = false;
    for (std::size_t j = 0; j < axes.places.size(); ++j) {
        const AxisForm& form = axes.forms[j];
        const AxisConstants constants = form.constants();
        factors.insert(factors.end(), form.factors(), constants);
        shifted = shifted || form.shift() != 0;
        numbers.needs.constants = numbers.needs.constants || shifted || constants.lost != 0;
        total *= axes.terms[j].total();
        scale *= form.scale();
        most *= form.scale() * form.most();
    }
    const Table table = table_of(form_of(axes.forms[0], kind, numbers.needs), numbers, factors,
                                 Halving(points, axes, kind == Kind::centered).order());
    const Quad n = points.count();
    const Quad pairs = scale * sum_over_pairs(table, widest, run) / (n * n);
    const Quad squared = total - 2 * numbers.means + pairs;
    require_finite(static_cast<double>(squared), kind, points.dimension());
    // Where factors come near 0, they lose by what is largest.
    const double products = static_cast<double>(shifted ? most : pairs);
    const auto chain = static_cast<double>(factors.size() + 8);
    const double error = (0x1p-80 + 0x1p-98 * chain * chain) * products +
                         0x1p-88 * static_cast<double>(total + numbers.means) +
                         0x1p-53 * std::abs(static_cast<double>(squared));
    return {static_cast<double>(squared), error};
}

}  // namespace stipple::analyzers::l2
