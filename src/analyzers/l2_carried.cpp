// SPDX-License-Identifier: MIT
#include "analyzers/l2_carried.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "analyzers/l2_terms.hpp"
#include "core/parallel.hpp"

// The vectors never leave a function that is not inlined.
#pragma GCC diagnostic ignored "-Wpsabi"

#define STIPPLE_INLINE [[gnu::always_inline]] inline

// Products need their rounding errors: an instruction where there is one, and slow where not.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define STIPPLE_FUSED [[gnu::target_clones("fma", "default")]]
#else
#define STIPPLE_FUSED
#endif

namespace stipple::analyzers::l2 {
namespace {

constexpr std::size_t lanes = 4;
constexpr std::size_t width = 64;  ///< points of a block
constexpr std::size_t numbers_of_factor = 3;

using Four [[gnu::vector_size(8 * lanes)]] = double;
using Bits [[gnu::vector_size(8 * lanes)]] = std::int64_t;

STIPPLE_INLINE Four load(const double* from) {
    Four v;
    std::memcpy(&v, from, sizeof v);
    return v;
}
STIPPLE_INLINE Four all(double x) { return Four{x, x, x, x}; }
STIPPLE_INLINE Four least(Four a, Four b) { return a < b ? a : b; }
STIPPLE_INLINE Bits sign(Four a) { return (Bits)a & (std::int64_t{1} << 63); }
STIPPLE_INLINE Four flipped(Four a, Bits by) { return (Four)((Bits)a ^ by); }

/// a b + c, rounded once.
STIPPLE_INLINE Four fused(Four a, Four b, Four c) {
    Four r;
    for (std::size_t l = 0; l < lanes; ++l) r[l] = __builtin_fma(a[l], b[l], c[l]);
    return r;
}

/// A number and its correction.
struct Carried {
    Four value;
    Four lost;
};

/// Sum of two doubles, exact.
STIPPLE_INLINE Carried sum(Four a, Four b) {
    const Four s = a + b;
    const Four part = s - a;
    return {s, (a - (s - part)) + (b - part)};
}

/// |x - y|; its correction is 0 for multiples of 2^-53.
template <bool fine>
STIPPLE_INLINE Carried distance(Four x, Four y) {
    if constexpr (fine) {
        const Carried t = sum(x, -y);
        const Bits negative = sign(t.value);
        return {flipped(t.value, negative), flipped(t.lost, negative)};
    } else {
        const Four t = x - y;
        return {flipped(t, sign(t)), all(0)};
    }
}

/// What is the same for all points on an axis: base = a + shift, where a factor may come near 0.
struct AxisConstants {
    double base = 0;
    double shift = 0;
    double lost = 0;  ///< of base
};

/// base + a b, less the shift: the base is at least twice as large as |a b|, or the product is
/// positive.
STIPPLE_INLINE Carried raised(Four a, Four b, Four base, Four shift, Four lost) {
    const Four high = fused(a, b, base);
    return {high - shift, fused(a, b, base - high) + lost};
}

// The factors of a point, whose numbers are in `row`, and of four of a block.

/// One minimum, of numbers without corrections.
struct Least {
    static constexpr std::size_t columns = 1;
    static constexpr bool exact = true;
    STIPPLE_INLINE static Carried factor(const double* row, const double* block, AxisConstants) {
        return {least(all(row[0]), load(block)), all(0)};
    }
};

/// One minimum: of the numbers of the point that comes first in the order of column 0.
struct LeastCarried {
    static constexpr std::size_t columns = 3;
    static constexpr bool exact = false;
    STIPPLE_INLINE static Carried factor(const double* row, const double* block, AxisConstants) {
        const auto mine = all(row[0]) < load(block);
        return {mine ? all(row[1]) : load(block + width),
                mine ? all(row[2]) : load(block + 2 * width)};
    }
};

template <bool fine>
struct Bend {
    static constexpr std::size_t columns = 1;
    static constexpr bool exact = false;
    STIPPLE_INLINE static Carried factor(const double* row, const double* block,
                                         AxisConstants axis) {
        const auto [t, lost] = distance<fine>(all(row[0]), load(block));
        const Four u = t - 1;
        Four rest = all(axis.lost);
        if constexpr (fine) rest += fused(t, t - (u + 1), lost * (t + u));
        return raised(t, u, all(axis.base), all(axis.shift), rest);
    }
};

template <bool fine>
struct Mixture {
    static constexpr std::size_t columns = 3;
    static constexpr bool exact = false;
    STIPPLE_INLINE static Carried factor(const double* row, const double* block, AxisConstants) {
        const auto [t, lost] = distance<fine>(all(row[0]), load(block));
        const Four base = all(row[1]) + load(block + width);  // exact: they have a bit to spare
        const Four u = t - 1.5;
        Four rest = all(row[2]) + load(block + 2 * width) + t * (t - (u + 1.5));
        if constexpr (fine) rest += lost * (t + u);
        return raised(t, u, base, all(0), rest);
    }
};

struct Excess {
    static constexpr std::size_t columns = 3;
    static constexpr bool exact = false;
    STIPPLE_INLINE static Carried factor(const double* row, const double* block,
                                         AxisConstants axis) {
        const Four x = all(row[0]);
        const Four y = load(block);
        const auto below = x < y;
        const Four lower = below ? x : y;
        const Four room = below ? load(block + width) : all(row[1]);
        const Four lost = below ? load(block + 2 * width) : all(row[2]);
        return raised(lower, room, all(axis.base), all(axis.shift),
                      fused(lower, lost, all(axis.lost)));
    }
};

template <class Form>
STIPPLE_INLINE void multiply(Carried& product, const double* row, const double* block,
                             const AxisConstants& axis) {
    const Carried by = Form::factor(row, block, axis);
    const Four next = product.value * by.value;
    const Four rounded = fused(product.value, by.value, -next);
    product.lost = fused(product.lost, by.value, rounded);
    if constexpr (!Form::exact) product.lost = fused(product.value, by.lost, product.lost);
    product.value = next;
}

enum class Form { least, least_carried, bend, bend_fine, mixture, mixture_fine, excess };

/// Blocks of points, column after column in each; behind them one that is 1, and 0 where there are
/// no points.
struct Table {
    Form form = Form::least;
    std::size_t count = 0;
    std::size_t columns = 1;  ///< of a factor
    std::vector<AxisConstants> factors = {};
    std::vector<double> numbers = {};

    [[nodiscard]] std::size_t height() const { return factors.size() * columns + 1; }
    [[nodiscard]] const double* block(std::size_t b) const {
        return numbers.data() + b * height() * width;
    }
    double& at(std::size_t i, std::size_t column) {
        return numbers[(i / width * height() + column) * width + i % width];
    }
};

struct Sums {
    double sum[lanes] = {};
    double lost[lanes] = {};

    [[nodiscard]] Quad total() const {
        Quad total = 0;
        for (std::size_t l = 0; l < lanes; ++l) total += Quad(sum[l]) + lost[l];
        return total;
    }
};

/// Two points, the second of which may be no more than a place, and blocks [first, last).
struct Meeting {
    const Table* table;
    const double* one;
    const double* two;
    std::size_t first;
    std::size_t last;
};

STIPPLE_INLINE void add(Carried& total, const Carried& product, Four there) {
    const Carried next = sum(total.value, product.value * there);
    total.value = next.value;
    total.lost += next.lost + product.lost * there;
}

/// Adds the products of two points with a block's.
template <class Kernel>
STIPPLE_INLINE void meet_block(const Meeting& m, const double* block, Carried& total) {
    const std::size_t factors = m.table->factors.size();
    const AxisConstants* const axes = m.table->factors.data();
    constexpr std::size_t c = Kernel::columns;
    const double* const presence = block + factors * c * width;
    for (std::size_t k = 0; k < width; k += 2 * lanes) {
        const double* at = block + k;
        Carried p[4] = {Kernel::factor(m.one, at, axes[0]), Kernel::factor(m.two, at, axes[0]),
                        Kernel::factor(m.one, at + lanes, axes[0]),
                        Kernel::factor(m.two, at + lanes, axes[0])};
        for (std::size_t f = 1; f < factors; ++f) {
            at += c * width;
            multiply<Kernel>(p[0], m.one + f * c, at, axes[f]);
            multiply<Kernel>(p[1], m.two + f * c, at, axes[f]);
            multiply<Kernel>(p[2], m.one + f * c, at + lanes, axes[f]);
            multiply<Kernel>(p[3], m.two + f * c, at + lanes, axes[f]);
        }
        const Four there = load(presence + k);
        const Four there_too = load(presence + k + lanes);
        const double second = m.two[factors * c];
        add(total, p[0], there);
        add(total, p[1], there * second);
        add(total, p[2], there_too);
        add(total, p[3], there_too * second);
    }
}

template <class Kernel>
STIPPLE_INLINE void meet_all(const Meeting& m, Sums& sums) {
    Carried total{load(sums.sum), load(sums.lost)};
    for (std::size_t b = m.first; b < m.last; ++b) meet_block<Kernel>(m, m.table->block(b), total);
    std::memcpy(sums.sum, &total.value, sizeof total.value);
    std::memcpy(sums.lost, &total.lost, sizeof total.lost);
}

STIPPLE_FUSED void meet_least(const Meeting& m, Sums& s) { meet_all<Least>(m, s); }
STIPPLE_FUSED void meet_least_carried(const Meeting& m, Sums& s) { meet_all<LeastCarried>(m, s); }
STIPPLE_FUSED void meet_bend(const Meeting& m, Sums& s) { meet_all<Bend<false>>(m, s); }
STIPPLE_FUSED void meet_bend_fine(const Meeting& m, Sums& s) { meet_all<Bend<true>>(m, s); }
STIPPLE_FUSED void meet_mixture(const Meeting& m, Sums& s) { meet_all<Mixture<false>>(m, s); }
STIPPLE_FUSED void meet_mixture_fine(const Meeting& m, Sums& s) { meet_all<Mixture<true>>(m, s); }
STIPPLE_FUSED void meet_excess(const Meeting& m, Sums& s) { meet_all<Excess>(m, s); }

auto* meeting(Form form) {
    switch (form) {
        case Form::least:
            return meet_least;
        case Form::least_carried:
            return meet_least_carried;
        case Form::bend:
            return meet_bend;
        case Form::bend_fine:
            return meet_bend_fine;
        case Form::mixture:
            return meet_mixture;
        case Form::mixture_fine:
            return meet_mixture_fine;
        default:
            return meet_excess;
    }
}

constexpr std::size_t together = 64;  ///< blocks whose sums are doubles

/// The products of two points with the blocks [first, last).
Quad sum_of_blocks(Meeting m, std::size_t first, std::size_t last) {
    auto* const meet = meeting(m.table->form);
    Quad total = 0;
    for (std::size_t b = first; b < last; b += together) {
        Sums sums;
        m.first = b;
        m.last = std::min(last, b + together);
        meet(m, sums);
        total += sums.total();
    }
    return total;
}

/// Sum over all ordered pairs of points.
Quad sum_over_pairs(const Table& table, const RunContext& run) {
    std::vector<Quad> sums(block_count(table.count, width));
    const std::size_t height = table.height();
    for_each_block(run, table.count, width, [&](const Block& rows) {
        Quad below = 0;
        Quad own = 0;
        std::vector<double> two_rows(2 * height);
        const double* const block = table.block(rows.index);
        for (std::size_t i = 0; i < rows.last - rows.first; i += 2) {
            run.check_stop();
            for (std::size_t column = 0; column < height; ++column)
                for (std::size_t r = 0; r < 2; ++r)
                    two_rows[r * height + column] = block[column * width + i + r];
            const Meeting m{&table, two_rows.data(), two_rows.data() + height, 0, 0};
            below += sum_of_blocks(m, 0, rows.index);
            own += sum_of_blocks(m, rows.index, rows.index + 1);
        }
        sums[rows.index] = 2 * below + own;
    });
    Quad total = 0;
    for (const Quad& part : sums) total += part;
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

/// The high part a multiple of `step`.
Parts parts_of(const Quad& x, double step) {
    const double high = std::round(static_cast<double>(x) / step) * step;
    return {high, static_cast<double>(x - Quad(high))};
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
        if (bends()) base_ = inverse_ + top;
        if (kind == Kind::extreme) base_ = inverse_;
        if (kind == Kind::mixture) {
            const double twice = 2 * static_cast<double>(inverse_ + Quad(7) / 8);
            step_ = std::ldexp(1.0, std::ilogb(twice) - 52);
        }
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

    [[nodiscard]] AxisConstants constants() const {
        if (!bends() && !is_excess()) return {};
        const double shift = base_ < Quad(0.5) ? 1 : 0;
        const Parts base = parts_of(base_ + shift);
        return {base.high, shift, base.low};
    }

    /// More than the factors over the scale.
    [[nodiscard]] double most() const {
        if (kind_ == Kind::mixture) return static_cast<double>(2 * inverse_ + Quad(7) / 4);
        if (bends()) return static_cast<double>(base_);
        const auto one = static_cast<double>(inverse_ + 1);
        return factors() == 2 ? one * one : one;
    }

    /// Numbers of a point: of a factor its place in the order, its value, and the correction.
    void put(double x, double* to) const {
        const Quad q = x;
        const auto write = [&](double place, const Parts& number) {
            *to++ = place;
            *to++ = number.high;
            *to++ = number.low;
        };
        switch (kind_) {
            case Kind::star:
            case Kind::modified:
                return write(-x, parts_of(inverse_ + 1 - q));
            case Kind::extreme:
                if (alone_) write(x, {x, 0});
                return write(alone_ ? -x : x, parts_of(1 - q));
            case Kind::centered:
                write(x, parts_of(inverse_ + std::max(x - 0.5, 0.0)));
                return write(-x, parts_of(inverse_ + (x < 0.5 ? Quad(0.5) - q : Quad(0))));
            case Kind::mixture:
                return write(x, parts_of(inverse_ + Quad(7) / 8 - abs(Quad(q - 0.5)) / 2, step_));
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
};

/// Whether differences of such coordinates may need rounding.
bool is_fine(double x) { return x * 0x1p53 != std::floor(x * 0x1p53); }

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

/// The form that these points take: with corrections where there are any.
Form form_of(const AxisForm& form, Kind kind, bool fine, bool corrected) {
    if (form.is_excess()) return Form::excess;
    if (form.bends()) return fine ? Form::bend_fine : Form::bend;
    if (kind == Kind::mixture) return fine ? Form::mixture_fine : Form::mixture;
    return corrected ? Form::least_carried : Form::least;
}

/// What AxisForm::put gives for all points, three numbers a factor, and what there is to heed.
struct Rows {
    std::vector<double> numbers;
    std::size_t factors = 0;
    Quad means = 0;  ///< mean of the products of the factors' means
    bool fine = false;
    bool corrected = false;
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
            rows.fine = rows.fine || is_fine(x);
            axes.forms[j].put(x, to);
            for (std::size_t f = 0; f < axes.forms[j].factors(); ++f, to += numbers_of_factor)
                rows.corrected = rows.corrected || to[2] != 0;
            mean *= axes.terms[j].mean(x);
        }
        rows.means += mean;
    }
    rows.means /= points.count();
    return rows;
}

/// The numbers that the form needs, for all points and places.
void fill(Table& table, const Rows& rows) {
    table.columns =
        table.form == Form::least || table.form == Form::bend || table.form == Form::bend_fine
            ? 1
            : numbers_of_factor;
    const std::size_t from = table.form == Form::least ? 1 : 0;
    table.numbers.resize(block_count(table.count, width) * table.height() * width);
    const double* at = rows.numbers.data();
    for (std::size_t i = 0; i < table.count; ++i) {
        std::size_t column = 0;
        for (std::size_t f = 0; f < rows.factors; ++f, at += numbers_of_factor)
            for (std::size_t q = 0; q < table.columns; ++q) table.at(i, column++) = at[from + q];
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
                      const RunContext& run) {
    const Axes axes = axes_of(points.dimension(), kind, weights);
    if (axes.places.empty()) {  // all weights are 0
        run.tick(1, 1);
        return {0, 0};
    }
    const Rows rows = rows_of(points, axes, run);
    Table table{.form = form_of(axes.forms[0], kind, rows.fine, rows.corrected),
                .count = points.count()};
    Quad total = 1;
    Quad scale = 1;
    Quad most = 1;
    for (std::size_t j = 0; j < axes.places.size(); ++j) {
        const AxisForm& form = axes.forms[j];
        table.factors.insert(table.factors.end(), form.factors(), form.constants());
        total *= axes.terms[j].total();
        scale *= form.scale();
        most *= form.scale() * form.most();
    }
    fill(table, rows);
    const Quad n = points.count();
    const Quad pairs = scale * sum_over_pairs(table, run) / (n * n);
    const Quad squared = total - 2 * rows.means + pairs;
    require_finite(static_cast<double>(squared), kind, points.dimension());
    // Where factors come near 0, they lose by what is largest.
    const bool near_zero = std::ranges::any_of(
        table.factors, [](const AxisConstants& axis) { return axis.shift != 0; });
    const double products = static_cast<double>(near_zero ? most : pairs);
    const auto chain = static_cast<double>(table.factors.size() + 4);
    const double error = (0x1p-80 + 0x1p-98 * chain * chain) * products +
                         0x1p-88 * static_cast<double>(total + rows.means) +
                         0x1p-53 * std::abs(static_cast<double>(squared));
    return {static_cast<double>(squared), error};
}

}  // namespace stipple::analyzers::l2
