// SPDX-License-Identifier: MIT
#include "analyzers/l2_carried.hpp"

#include <algorithm>
#include <cmath>

#include "analyzers/l2_factors.hpp"
#include "analyzers/l2_terms.hpp"
#include "core/parallel.hpp"

// Products need their rounding errors: an instruction where there is one, and slow where not.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define STIPPLE_PICKS_VECTORS
#endif

namespace stipple::analyzers::l2 {
namespace {

constexpr std::size_t numbers_of_factor = 4;
constexpr std::size_t group = 4;  ///< points that meet a block together
constexpr std::size_t lines_of_block = block_width / spread;

enum class Form {
    least,
    least_carried,
    bend,
    bend_fine,
    bend_shifted,
    bend_shifted_fine,
    mixture,
    mixture_fine,
    excess
};

/// Blocks of points, column after column in each; behind them one that is 1, and 0 where there are
/// no points.
struct Table {
    Form form = Form::least;
    std::size_t count = 0;
    std::size_t columns = 1;  ///< of a factor
    std::vector<AxisConstants> factors = {};
    std::vector<Line> numbers = {};

    [[nodiscard]] std::size_t height() const { return factors.size() * columns + 1; }
    [[nodiscard]] const double* block(std::size_t b) const {
        return numbers[b * height() * lines_of_block].at;
    }
    void resize() { numbers.resize(block_count(count, block_width) * height() * lines_of_block); }
    double& at(std::size_t i, std::size_t column) {
        const std::size_t line =
            (i / block_width * height() + column) * lines_of_block + i % block_width / spread;
        return numbers[line].at[i % spread];
    }
};

struct Sums {
    double sum[spread] = {};
    double lost[spread] = {};

    [[nodiscard]] Quad total() const {
        Quad total = 0;
        for (std::size_t l = 0; l < spread; ++l) total += Quad(sum[l]) + lost[l];
        return total;
    }
};

/// A group of points, some of which may be no more than places, and a block.
struct Meeting {
    const Table* table;
    const double* rows;   ///< numbers of each point of the group, `spread` times each
    const double* block;  ///< may be the first of some
    std::size_t blocks;
    bool full;  ///< no places without points
};

/// The products of a group of points with as many of a block's as a vector holds.
template <class Kernel, class V>
STIPPLE_INLINE void products(const Meeting& m, const double* at, Carried<V>* p) {
    constexpr std::size_t columns = Kernel::columns;
    const std::size_t factors = m.table->factors.size();
    const std::size_t row = m.table->height() * spread;
    const AxisConstants* const axes = m.table->factors.data();
#pragma GCC unroll 4
    for (std::size_t r = 0; r < group; ++r)
        p[r] = Kernel::template factor<V>(m.rows + r * row, at, axes[0]);
    for (std::size_t f = 1; f < factors; ++f) {
        const double* const rows = m.rows + f * columns * spread;
        const double* const block = at + f * columns * block_width;
#pragma GCC unroll 4
        for (std::size_t r = 0; r < group; ++r)
            multiply<Kernel>(p[r], Kernel::template factor<V>(rows + r * row, block, axes[f]));
    }
    if (m.full) return;
    const std::size_t last = factors * columns;
#pragma GCC unroll 4
    for (std::size_t r = 0; r < group; ++r) {
        const V there =
            load<V>(at + last * block_width) * load<V>(m.rows + r * row + last * spread);
        p[r].value *= there;
        p[r].lost *= there;
    }
}

template <class V>
STIPPLE_INLINE void add(Carried<V>& total, const Carried<V>& product) {
    const V next = total.value + product.value;
    const V part = next - total.value;
    total.lost += ((total.value - (next - part)) + (product.value - part)) + product.lost;
    total.value = next;
}

/// Adds the products of a group of points with those of blocks, lane by lane the same in vectors of
/// any width.
template <class Kernel, class V>
STIPPLE_INLINE void meet_all(const Meeting& m, Sums& sums) {
    constexpr std::size_t parts = spread / lanes_of<V>;
    const std::size_t block_size = m.table->height() * block_width;
    Carried<V> total[parts];
    for (std::size_t q = 0; q < parts; ++q)
        total[q] = {load<V>(sums.sum + q * lanes_of<V>), load<V>(sums.lost + q * lanes_of<V>)};
    for (std::size_t b = 0; b < m.blocks; ++b)
        for (std::size_t k = 0; k < block_width; k += spread)
#pragma GCC unroll 4
            for (std::size_t q = 0; q < parts; ++q) {
                Carried<V> p[group];
                products<Kernel, V>(m, m.block + b * block_size + k + q * lanes_of<V>, p);
#pragma GCC unroll 4
                for (std::size_t r = 0; r < group; ++r) add(total[q], p[r]);
            }
    for (std::size_t q = 0; q < parts; ++q) {
        std::memcpy(sums.sum + q * lanes_of<V>, &total[q].value, sizeof(V));
        std::memcpy(sums.lost + q * lanes_of<V>, &total[q].lost, sizeof(V));
    }
}

using Meet = void(const Meeting&, Sums&);

template <class Kernel>
void meet_anywhere(const Meeting& m, Sums& sums) {
    meet_all<Kernel, Four>(m, sums);
}

#ifdef STIPPLE_PICKS_VECTORS
template <class Kernel>
[[gnu::target("avx2,fma")]] void meet_fours(const Meeting& m, Sums& sums) {
    meet_all<Kernel, Four>(m, sums);
}
template <class Kernel>
[[gnu::target("avx512f,avx512dq,prefer-vector-width=512")]] void meet_eights(const Meeting& m,
                                                                             Sums& sums) {
    meet_all<Kernel, Eight>(m, sums);
}

Vectors widest_here() {
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq"))
        return Vectors::eights;
    const bool fours = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    return fours ? Vectors::fours : Vectors::anywhere;
}

template <class Kernel>
Meet* meeting_of(Vectors widest) {
    static const Vectors here = widest_here();
    switch (std::min(widest, here)) {
        case Vectors::eights:
            return meet_eights<Kernel>;
        case Vectors::fours:
            return meet_fours<Kernel>;
        default:
            return meet_anywhere<Kernel>;
    }
}
#else
template <class Kernel>
Meet* meeting_of(Vectors) {
    return meet_anywhere<Kernel>;
}
#endif

/// Calls body<Kernel>() for the kernel of a form.
template <class Body>
auto with_kernel(Form form, const Body& body) {
    switch (form) {
        case Form::least:
            return body.template operator()<Least>();
        case Form::least_carried:
            return body.template operator()<LeastCarried>();
        case Form::bend:
            return body.template operator()<Bend<false, true>>();
        case Form::bend_fine:
            return body.template operator()<Bend<true, true>>();
        case Form::bend_shifted:
            return body.template operator()<Bend<false, false>>();
        case Form::bend_shifted_fine:
            return body.template operator()<Bend<true, false>>();
        case Form::mixture:
            return body.template operator()<Mixture<false>>();
        case Form::mixture_fine:
            return body.template operator()<Mixture<true>>();
        default:
            return body.template operator()<Excess>();
    }
}

Meet* meeting(Form form, Vectors widest) {
    return with_kernel(form, [&]<class Kernel>() { return meeting_of<Kernel>(widest); });
}

/// The numbers of points [first, first + group) of a block, `spread` times each.
void spread_rows(const Table& table, const double* block, std::size_t first, Line* to) {
    for (std::size_t r = 0; r < group; ++r)
        for (std::size_t column = 0; column < table.height(); ++column)
            std::ranges::fill((to++)->at, block[column * block_width + first + r]);
}

/// Sum over all ordered pairs of points.
Quad sum_over_pairs(const Table& table, Vectors widest, const RunContext& run) {
    constexpr std::size_t together = 16;  ///< blocks whose sums are doubles
    Meet* const meet = meeting(table.form, widest);
    std::vector<Quad> totals(block_count(table.count, block_width));
    for_each_block(run, table.count, block_width, [&](const Block& block) {
        std::vector<Line> rows(group * table.height());
        const std::size_t count = block.last - block.first;
        const auto sum_of = [&](std::size_t first, std::size_t last) {
            Sums sums;
            const bool full = count == block_width && last * block_width <= table.count;
            for (std::size_t i = 0; i < count; i += group) {
                run.check_stop();
                spread_rows(table, table.block(block.index), i, rows.data());
                meet({&table, rows[0].at, table.block(first), last - first, full}, sums);
            }
            return sums.total();
        };
        Quad below = 0;
        for (std::size_t b = 0; b < block.index; b += together)
            below += sum_of(b, std::min<std::size_t>(b + together, block.index));
        totals[block.index] = 2 * below + sum_of(block.index, block.index + 1);
    });
    Quad total = 0;
    for (const Quad& part : totals) total += part;
    return total;
}

/// high + low is the number.
struct Parts {
    double high;
    double low;
};

Parts parts_of(const Quad& x) {
    const auto high = static_cast<double>(x);
    return {high, static_cast<double>(x - Quad(high))};
}

/// a + x, with a correction of its own rounding alone.
Parts sum_of(const Parts& a, double x) {
    const double high = a.high + x;
    const double part = high - a.high;
    const double low = ((a.high - (high - part)) + (x - part)) + a.low;
    return {high + low, low - ((high + low) - high)};
}

/// The high part a multiple of `step`.
Parts on_grid(const Parts& a, double step) {
    const double high = std::round(a.high / step) * step;
    return {high, (a.high - high) + a.low};
}

/// The factor of an axis over its scale, as numbers of each point.
class AxisForm {
  public:
    AxisForm(Kind kind, bool alone, double weight) : kind_(kind), alone_(alone) {
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
        top_ = parts_of(kind == Kind::centered  ? Quad(inverse_ + 0.5)
                        : kind == Kind::mixture ? Quad(base_ + 0.25)
                                                : Quad(inverse_ + 1));
        bottom_ = parts_of(kind == Kind::mixture ? Quad(base_ - 0.25) : inverse_);
    }

    [[nodiscard]] const Quad& scale() const { return scale_; }
    [[nodiscard]] bool bends() const {
        return kind_ == Kind::periodic || kind_ == Kind::wraparound || kind_ == Kind::diaphony;
    }
    [[nodiscard]] bool is_excess() const { return kind_ == Kind::extreme && !alone_; }

    /// Factors on the axis.
    [[nodiscard]] std::size_t factors() const {
        return kind_ == Kind::centered || (kind_ == Kind::extreme && alone_) ? 2 : 1;
    }

    /// What is added to a factor and taken off again, lest it come near 0 before.
    [[nodiscard]] double shift() const {
        const bool small = (bends() && base_ < Quad(0.25)) || (is_excess() && base_ < Quad(0.5));
        return small ? 1 : 0;
    }

    [[nodiscard]] AxisConstants constants() const {
        AxisConstants axis;
        if (!bends() && !is_excess()) return axis;
        const Parts base = parts_of(base_ + shift());
        std::ranges::fill(axis.base.at, base.high);
        std::ranges::fill(axis.shift.at, shift());
        std::ranges::fill(axis.lost.at, base.low);
        return axis;
    }

    /// More than the factors over the scale.
    [[nodiscard]] double most() const {
        if (kind_ == Kind::mixture) return static_cast<double>(2 * inverse_ + Quad(7) / 4);
        if (bends()) return static_cast<double>(base_ + 0.25);
        const auto one = static_cast<double>(inverse_ + 1);
        return factors() == 2 ? one * one : one;
    }

    /// Numbers of a point: of a factor its place in the order and the place's rest, its value and
    /// the correction.
    void put(double x, double* to) const {
        const auto write = [&](double place, const Parts& number) {
            const bool split = bends() || kind_ == Kind::mixture;
            const double at = split ? std::round(place * 0x1p53) * 0x1p-53 : place;
            *to++ = at;
            *to++ = place - at;
            *to++ = number.high;
            *to++ = number.low;
        };
        switch (kind_) {
            case Kind::star:
            case Kind::modified:
                return write(-x, sum_of(top_, -x));
            case Kind::extreme:
                if (alone_) write(x, {x, 0});
                return write(alone_ ? -x : x, sum_of({1, 0}, -x));
            case Kind::centered:
                write(x, sum_of(bottom_, std::max(x - 0.5, 0.0)));
                return write(-x, x < 0.5 ? sum_of(top_, -x) : bottom_);
            case Kind::mixture:
                return write(
                    x, on_grid(x < 0.5 ? sum_of(bottom_, x / 2) : sum_of(top_, -x / 2), step_));
            default:
                return write(x, {0, 0});
        }
    }

  private:
    Kind kind_;
    bool alone_;
    Quad inverse_;  ///< 1 over the weight
    Quad scale_;
    Quad base_ = 0;
    double step_ = 0;
    Parts top_ = {};     ///< what coordinates are taken from
    Parts bottom_ = {};  ///< what they are added to
};

/// The axes that have a weight.
struct Axes {
    std::vector<std::size_t> places;
    std::vector<AxisForm> forms;
    std::vector<AxisTerms> terms;
};

Axes axes_of(std::size_t dimension, Kind kind, const std::vector<double>& weights) {
    const bool alone = weights.empty() && !record_of(kind).projections;
    Axes axes;
    for (std::size_t j = 0; j < dimension; ++j) {
        const double weight = weights.empty() ? 1 : weights[j];
        if (weight == 0) continue;
        axes.places.push_back(j);
        axes.forms.emplace_back(kind, alone, weight);
        axes.terms.emplace_back(record_of(kind), alone, weight);
    }
    return axes;
}

/// What of the numbers is not 0.
struct Needs {
    bool rests = false;
    bool corrections = false;
    bool constants = false;  ///< shifts or corrections of axes
};

Form form_of(const AxisForm& form, Kind kind, const Needs& needs) {
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
            return {2};
        case Form::bend:
        case Form::bend_shifted:
            return {0};
        case Form::bend_fine:
        case Form::bend_shifted_fine:
            return {0, 1};
        case Form::mixture_fine:
            return {0, 1, 2, 3};
        default:
            return {0, 2, 3};
    }
}

/// What AxisForm::put gives for all points, and what there is to heed.
struct Rows {
    std::vector<double> numbers;
    std::size_t factors = 0;
    Quad means = 0;  ///< mean of the products of the factors' means
    Needs needs;
};

Rows rows_of(const PointSet& points, const Axes& axes, const RunContext& run) {
    Rows rows;
    for (const AxisForm& form : axes.forms) rows.factors += form.factors();
    rows.numbers.resize(points.count() * rows.factors * numbers_of_factor);
    double* to = rows.numbers.data();
    for (std::size_t i = 0; i < points.count(); ++i) {
        if (i % 256 == 0) run.check_stop();
        Quad mean = 1;
        for (std::size_t j = 0; j < axes.places.size(); ++j) {
            const double x = points[i][axes.places[j]] + 0.0;
            axes.forms[j].put(x, to);
            for (std::size_t f = 0; f < axes.forms[j].factors(); ++f, to += numbers_of_factor) {
                rows.needs.rests = rows.needs.rests || to[1] != 0;
                rows.needs.corrections = rows.needs.corrections || to[3] != 0;
            }
            mean *= axes.terms[j].mean(x);
        }
        rows.means += mean;
    }
    rows.means /= points.count();
    return rows;
}

/// The columns of the form, for all points and places.
void fill(Table& table, const Rows& rows) {
    const std::vector<std::size_t> from = columns_from(table.form);
    table.columns = from.size();
    table.resize();
    const double* at = rows.numbers.data();
    for (std::size_t i = 0; i < table.count; ++i) {
        std::size_t column = 0;
        for (std::size_t f = 0; f < rows.factors; ++f, at += numbers_of_factor)
            for (const std::size_t q : from) table.at(i, column++) = at[q];
        table.at(i, column) = 1;
    }
}

}  // namespace

bool carries(std::size_t dimension, Kind kind, const std::vector<double>& weights) {
    constexpr std::size_t most_axes = 400;
    constexpr double most_binades = 500;
    if (dimension > most_axes) return false;
    double binades = 0;
    for (const AxisForm& form : axes_of(dimension, kind, weights).forms)
        binades += std::abs(std::log2(static_cast<double>(form.scale()))) +
                   std::log2(std::max(form.most(), 1.0));
    return binades <= most_binades;
}

Square carried_square(const PointSet& points, Kind kind, const std::vector<double>& weights,
                      const RunContext& run, Vectors widest) {
    const Axes axes = axes_of(points.dimension(), kind, weights);
    if (axes.places.empty()) {  // all weights are 0
        run.tick(1, 1);
        return {0, 0};
    }
    Rows rows = rows_of(points, axes, run);
    Table table{.count = points.count()};
    Quad total = 1;
    Quad scale = 1;
    Quad most = 1;
    bool shifted = false;
    for (std::size_t j = 0; j < axes.places.size(); ++j) {
        const AxisForm& form = axes.forms[j];
        const AxisConstants constants = form.constants();
        table.factors.insert(table.factors.end(), form.factors(), constants);
        shifted = shifted || form.shift() != 0;
        rows.needs.constants = rows.needs.constants || shifted || constants.lost.at[0] != 0;
        total *= axes.terms[j].total();
        scale *= form.scale();
        most *= form.scale() * form.most();
    }
    table.form = form_of(axes.forms[0], kind, rows.needs);
    fill(table, rows);
    const Quad n = points.count();
    const Quad pairs = scale * sum_over_pairs(table, widest, run) / (n * n);
    const Quad squared = total - 2 * rows.means + pairs;
    require_finite(static_cast<double>(squared), kind, points.dimension());
    // Where factors come near 0, they lose by what is largest.
    const double products = static_cast<double>(shifted ? most : pairs);
    const auto chain = static_cast<double>(table.factors.size() + 4);
    const double error = (0x1p-80 + 0x1p-98 * chain * chain) * products +
                         0x1p-88 * static_cast<double>(total + rows.means) +
                         0x1p-53 * std::abs(static_cast<double>(squared));
    return {static_cast<double>(squared), error};
}

}  // namespace stipple::analyzers::l2
