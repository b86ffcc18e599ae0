// SPDX-License-Identifier: MIT
#include "analyzers/l2/l2_pairs.hpp"

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <cstring>
#include <numbers>

#include "core/parallel.hpp"
#include "core/wide.hpp"

// The vectors never leave a function that is not inlined.

#define STIPPLE_INLINE [[gnu::always_inline]] inline

namespace stipple::analyzers::l2 {
namespace {

using Long = long double;
using Quad = boost::multiprecision::cpp_bin_float_quad;  // where everything cancels

constexpr std::size_t lanes = 4;
constexpr std::size_t width = 96;  ///< points of a block; its columns stay in the nearest cache
constexpr std::size_t tall = 48;   ///< points of a tile that meets blocks
constexpr std::size_t group = 3;   ///< points of a tile that are worked on together

using Four [[gnu::vector_size(8 * lanes)]] = double;
using Bits [[gnu::vector_size(8 * lanes)]] = std::int64_t;

STIPPLE_INLINE Four load(const double* from) {
    Four v;
    std::memcpy(&v, from, sizeof v);
    return v;
}
STIPPLE_INLINE Four least(Four a, Four b) { return a < b ? a : b; }
STIPPLE_INLINE Four magnitude(Four a) { return (Four)((Bits)a & 0x7fff'ffff'ffff'ffff); }

enum class Form { least, excess, bend, mixture };

// A factor of two points with these columns; a and s are constants of the axis.
struct Least {
    static constexpr std::size_t columns = 1;
    STIPPLE_INLINE static Four factor(const Four* x, const Four* y, Four, Four) {
        return least(x[0], y[0]);
    }
};
struct Excess {
    static constexpr std::size_t columns = 2;
    STIPPLE_INLINE static Four factor(const Four* x, const Four* y, Four a, Four) {
        return a + least(x[0], y[0]) * least(x[1], y[1]);
    }
};
struct Bend {
    static constexpr std::size_t columns = 1;
    STIPPLE_INLINE static Four factor(const Four* x, const Four* y, Four a, Four s) {
        const Four t = magnitude(x[0] - y[0]);
        return a + t * (t - s);
    }
};
struct Mixture {
    static constexpr std::size_t columns = 2;
    STIPPLE_INLINE static Four factor(const Four* x, const Four* y, Four, Four s) {
        const Four t = magnitude(x[0] - y[0]);
        return (x[1] + y[1]) + t * (t - s);
    }
};

constexpr std::size_t columns_of(Form form) {
    return form == Form::excess || form == Form::mixture ? 2 : 1;
}

/// Coordinates of all points, block after block and column after column in each, a column of ones
/// behind them that ends with zeros where there are no points.
struct Table {
    Form form = Form::least;
    std::size_t count = 0;
    std::size_t columns = 0;
    std::vector<double> constants = {};  ///< a and s of each axis, four times each
    std::vector<double> numbers = {};

    [[nodiscard]] std::size_t block_size() const { return (columns + 1) * width; }
    [[nodiscard]] const double* block(std::size_t b) const {
        return numbers.data() + b * block_size();
    }
    double& at(std::size_t i, std::size_t column) {
        return numbers[i / width * block_size() + column * width + i % width];
    }
};

/// A sum, with what rounding took from it.
class CarriedSum {
  public:
    void add(Long x) {
        const Long next = sum_ + x;
        const Long part = next - sum_;
        lost_ += (sum_ - (next - part)) + (x - part);
        sum_ = next;
    }
    [[nodiscard]] Quad value() const { return Quad(sum_) + lost_; }

  private:
    Long sum_ = 0;
    Long lost_ = 0;
};

/// Sums of four numbers at a time, with what rounding took from them.
struct Sums {
    double sum[lanes] = {};
    double lost[lanes] = {};
    [[nodiscard]] Quad total() const {
        Quad all = 0;
        for (std::size_t l = 0; l < lanes; ++l) all += Quad(sum[l]) + lost[l];
        return all;
    }
};

/// Some points and twice four points of a block: a number for each pair.
template <std::size_t rows>
struct Pairs {
    Four at[rows][2];
};

/// What meets: points, each number of which is there four times, and a block.
struct Meeting {
    const Table* table;
    const double* points;
    std::size_t count;
    const double* block;
    bool full;  ///< no places without points in the block
};

/// The factors of an axis.
template <class Kernel, std::size_t rows>
STIPPLE_INLINE Pairs<rows> factors(const double* points, const double* columns,
                                   const double* constants) {
    constexpr std::size_t c = Kernel::columns;
    const Four a = load(constants);
    const Four s = load(constants + lanes);
    Four y[2][c];
    for (std::size_t v = 0; v < 2; ++v)
        for (std::size_t q = 0; q < c; ++q) y[v][q] = load(columns + q * width + v * lanes);
    Pairs<rows> out;
    for (std::size_t r = 0; r < rows; ++r) {
        Four x[c];
        for (std::size_t q = 0; q < c; ++q) x[q] = load(points + (q * rows + r) * lanes);
        for (std::size_t v = 0; v < 2; ++v) out.at[r][v] = Kernel::factor(x, y[v], a, s);
    }
    return out;
}

/// Adds the products of `rows` points with a block's.
template <class Kernel, std::size_t rows>
STIPPLE_INLINE void meet(const Meeting& m, const double* points, Sums& sums) {
    constexpr std::size_t c = Kernel::columns;
    const std::size_t axes = m.table->columns / c;
    const double* const constants = m.table->constants.data();
    Four sum = load(sums.sum);
    Four lost = load(sums.lost);
    for (std::size_t k = 0; k < width; k += 2 * lanes) {
        const double* const columns = m.block + k;
        Pairs<rows> p = factors<Kernel, rows>(points, columns, constants);
#pragma GCC unroll 2
        for (std::size_t j = 1; j < axes; ++j) {
            const Pairs<rows> more = factors<Kernel, rows>(
                points + j * c * rows * lanes, columns + j * c * width, constants + j * 2 * lanes);
            for (std::size_t r = 0; r < rows; ++r)
                for (std::size_t v = 0; v < 2; ++v) p.at[r][v] *= more.at[r][v];
        }
        if (!m.full)
            for (std::size_t r = 0; r < rows; ++r)
                for (std::size_t v = 0; v < 2; ++v)
                    p.at[r][v] *= load(columns + axes * c * width + v * lanes);
        Four more = p.at[0][0] + p.at[0][1];
        for (std::size_t r = 1; r < rows; ++r) more += p.at[r][0] + p.at[r][1];
        const Four next = sum + more;
        lost += more - (next - sum);
        sum = next;
    }
    std::memcpy(sums.sum, &sum, sizeof sum);
    std::memcpy(sums.lost, &lost, sizeof lost);
}

/// As many groups of points as there are, then the points left over one by one.
template <class Kernel>
STIPPLE_INLINE void meet_all(const Meeting& m, Sums& sums) {
    const std::size_t point = m.table->columns * lanes;
    std::size_t i = 0;
    for (; i + group <= m.count; i += group) meet<Kernel, group>(m, m.points + i * point, sums);
    for (; i < m.count; ++i) meet<Kernel, 1>(m, m.points + i * point, sums);
}

STIPPLE_WIDE void meet_least(const Meeting& m, Sums& sums) { meet_all<Least>(m, sums); }
STIPPLE_WIDE void meet_excess(const Meeting& m, Sums& sums) { meet_all<Excess>(m, sums); }
STIPPLE_WIDE void meet_bend(const Meeting& m, Sums& sums) { meet_all<Bend>(m, sums); }
STIPPLE_WIDE void meet_mixture(const Meeting& m, Sums& sums) { meet_all<Mixture>(m, sums); }

auto* meeting(Form form) {
    switch (form) {
        case Form::excess:
            return meet_excess;
        case Form::bend:
            return meet_bend;
        case Form::mixture:
            return meet_mixture;
        default:
            return meet_least;
    }
}

/// The numbers of points [first, first + count) of a block, four times each, in the order in which
/// meet() takes them: groups of points, then those left over.
void spread(const Table& table, const double* block, std::size_t first, std::size_t count,
            std::vector<double>& out) {
    out.clear();
    const auto put = [&](std::size_t i, std::size_t rows) {
        for (std::size_t column = 0; column < table.columns; ++column)
            for (std::size_t r = 0; r < rows; ++r)
                out.insert(out.end(), lanes, block[column * width + first + i + r]);
    };
    std::size_t i = 0;
    for (; i + group <= count; i += group) put(i, group);
    for (; i < count; ++i) put(i, 1);
}

/// Sum over all ordered pairs of points.
Quad sum_over_pairs(const Table& table, const RunContext& run) {
    auto* const meet_block = meeting(table.form);
    std::vector<Quad> sums(block_count(table.count, width));
    for_each_block(run, table.count, width, [&](const Block& rows) {
        std::vector<double> tile;
        Sums below;
        Sums own;
        const std::size_t count = rows.last - rows.first;
        for (std::size_t i = 0; i < count; i += tall) {
            const std::size_t size = std::min(tall, count - i);
            spread(table, table.block(rows.index), i, size, tile);
            for (std::size_t b = 0; b <= rows.index; ++b) {
                if (b % 64 == 0) run.check_stop();
                const bool full = (b + 1) * width <= table.count;
                meet_block({&table, tile.data(), size, table.block(b), full},
                           b < rows.index ? below : own);
            }
        }
        sums[rows.index] = 2 * below.total() + own.total();
    });
    Quad total = 0;
    for (const Quad& sum : sums) total += sum;
    return total;
}

/// What K is on an axis: its columns, f and C.
struct Axis {
    double a = 0;
    double s = 0;
    Quad total = 0;
};

struct Columns {
    double g = 0;
    double h = 0;
    Long mean = 0;  ///< f; 1 where f is the same everywhere
};

/// A kind with the weight of an axis; no weight: the kernel k alone instead of 1 + weight k.
class AxisForm {
  public:
    AxisForm(Kind kind, bool alone, double weight) : kind_(kind), alone_(alone), weight_(weight) {
        const Quad w = weight;
        const Quad one = alone ? 0 : 1;
        switch (kind) {
            case Kind::star:
            case Kind::modified:
                axis_.total = one + w / 3;
                break;
            case Kind::extreme:
            case Kind::centered:
                axis_.total = one + w / 12;
                axis_.a = 1;
                break;
            case Kind::periodic:
            case Kind::wraparound:
                bend(one + w / 2, weight);
                break;
            case Kind::diaphony:
                bend(1 + diaphony * w / 6, diaphony * weight);
                break;
            case Kind::mixture:
                scale_ = std::sqrt(weight / 2);
                axis_.s = 1.5 * scale_;
                height_ = static_cast<double>((one + w * 7 / 8) / 2);
                axis_.total = 2 * (height_ - w / 16) - Quad(scale_) * scale_ / 3;
                break;
        }
    }

    [[nodiscard]] const Axis& axis() const { return axis_; }

    [[nodiscard]] Form form() const {
        switch (kind_) {
            case Kind::extreme:
                return alone_ ? Form::least : Form::excess;
            case Kind::periodic:
            case Kind::wraparound:
            case Kind::diaphony:
                return Form::bend;
            case Kind::mixture:
                return Form::mixture;
            default:
                return Form::least;
        }
    }

    /// Columns of the table: of the least form, centered and extreme have two factors on an axis.
    [[nodiscard]] std::size_t columns() const {
        const bool two = kind_ == Kind::extreme || kind_ == Kind::centered;
        return two || kind_ == Kind::mixture ? 2 : 1;
    }

    [[nodiscard]] Columns columns(double x) const {
        switch (kind_) {
            case Kind::star:
            case Kind::modified:
                return falling(1 - x);
            case Kind::extreme:
                return between(x);
            case Kind::centered:
                return from_center(x);
            case Kind::mixture:
                return mixed(x);
            default:
                return {scale_ * x, 0, 1};
        }
    }

  private:
    [[nodiscard]] Long square() const { return static_cast<Long>(scale_) * scale_; }

    void bend(const Quad& at_zero, double curvature) {
        scale_ = std::sqrt(curvature);
        axis_.s = scale_;
        axis_.a = static_cast<double>(at_zero);
        axis_.total = axis_.a - Quad(scale_) * scale_ / 6;
    }

    // The means are those of the coordinates that the rounded columns stand for.
    [[nodiscard]] Columns falling(double z) const {
        if (alone_) return {z, 0, z - static_cast<Long>(z) * z / 2};
        const double g = 1 + weight_ * z;
        const Long u = (static_cast<Long>(g) - 1) / weight_;
        return {g, 0, 1 + weight_ * (u - u * u / 2)};
    }
    [[nodiscard]] Columns between(double x) const {
        const double z = 1 - x;
        if (alone_) return {x, z, static_cast<Long>(x) * z / 2};
        const double g = weight_ * x;
        return {g, z, 1 + static_cast<Long>(g) * z / 2};
    }
    [[nodiscard]] Columns from_center(double x) const {
        const double right = 1 + weight_ * std::max(x - 0.5, 0.0);
        const double left = 1 + weight_ * std::max(0.5 - x, 0.0);
        const Long u = (static_cast<Long>(std::max(left, right)) - 1) / weight_;
        return {right, left, 1 + weight_ * (u - u * u) / 2};
    }
    [[nodiscard]] Columns mixed(double x) const {
        const double u = std::abs(x - 0.5);
        const double h = height_ - 0.25 * weight_ * u;
        const Long away = static_cast<Long>(u) * u;
        const Long mean = h + (height_ - static_cast<Long>(weight_) / 16) +
                          square() * (away + Long{1} / 12) -
                          square() * 3 / 2 * (away + Long{1} / 4);
        return {scale_ * x, h, mean};
    }

    Kind kind_;
    bool alone_;
    double weight_;
    double scale_ = 1;   ///< of the coordinates, so that t (t - s) needs no factor
    double height_ = 0;  ///< h at x = 1/2
    Axis axis_;
};

/// Most roundings in a factor and its product; generous.
double roundings(Kind kind) {
    switch (kind) {
        case Kind::star:
        case Kind::modified:
            return 3;
        case Kind::extreme:
        case Kind::centered:
            return 5;
        default:
            return 8;
    }
}

struct Prepared {
    Table table;
    Quad means = 0;   ///< mean of the products of f
    Quad total = 1;   ///< C
    double most = 1;  ///< no product is larger
};

/// Writes the columns of all points on these axes; gives the sum of the products of f.
Quad fill(Table& table, const PointSet& points, const std::vector<std::size_t>& axes,
          const std::vector<AxisForm>& forms, const RunContext& run) {
    CarriedSum means;
    for (std::size_t i = 0; i < table.count; ++i) {
        if (i % 4096 == 0) run.check_stop();
        Long mean = 1;
        std::size_t column = 0;
        for (std::size_t j = 0; j < axes.size(); ++j) {
            const Columns c = forms[j].columns(points[i][axes[j]] + 0.0);
            mean *= c.mean;
            table.at(i, column++) = c.g;
            if (forms[j].columns() == 2) table.at(i, column++) = c.h;
        }
        table.at(i, column) = 1;
        means.add(mean);
    }
    return means.value();
}

Prepared prepare(const PointSet& points, Kind kind, const std::vector<double>& weights,
                 const RunContext& run) {
    const std::size_t n = points.count();
    const bool alone = weights.empty() && !record_of(kind).projections;
    std::vector<std::size_t> axes;
    std::vector<AxisForm> forms;
    for (std::size_t j = 0; j < points.dimension(); ++j) {
        const double weight = weights.empty() ? 1 : weights[j];
        if (weight == 0) continue;
        axes.push_back(j);
        forms.emplace_back(kind, alone, weight);
    }
    Prepared out;
    if (forms.empty()) return out;
    Table& table = out.table;
    table = {.form = forms[0].form(), .count = n, .columns = forms.size() * forms[0].columns()};
    table.numbers.resize(block_count(n, width) * table.block_size());
    const std::size_t factors = table.columns / columns_of(table.form);
    for (std::size_t f = 0; f < factors; ++f) {
        const Axis& axis = forms[f * forms.size() / factors].axis();
        table.constants.insert(table.constants.end(), lanes, axis.a);
        table.constants.insert(table.constants.end(), lanes, axis.s);
    }
    for (const AxisForm& form : forms) {
        out.total *= form.axis().total;
        out.most *= std::max(1.0, form.axis().a);
    }
    const Quad means = fill(table, points, axes, forms, run);
    out.means = table.form == Form::bend ? out.total : means / n;
    return out;
}

}  // namespace

Square pair_square(const PointSet& points, Kind kind, const std::vector<double>& weights,
                   const RunContext& run) {
    const Prepared set = prepare(points, kind, weights, run);
    if (set.table.count == 0) {  // all weights are 0
        run.tick(1, 1);
        return {0, 0};
    }
    const Quad n = points.count();
    const Quad pairs = sum_over_pairs(set.table, run) / (n * n);
    const Quad squared = set.total - 2 * set.means + pairs;
    require_finite(std::isfinite(set.most) ? static_cast<double>(squared) : set.most, kind,
                   points.dimension());
    const auto axes = static_cast<double>(set.table.columns);
    const auto products = kind == Kind::diaphony ? set.most : static_cast<double>(pairs);
    const double error = 0x1p-53 * (roundings(kind) * axes + 8) * products +
                         0x1p-62 * (axes + 4) * static_cast<double>(set.means);
    return {static_cast<double>(squared), error};
}

}  // namespace stipple::analyzers::l2
