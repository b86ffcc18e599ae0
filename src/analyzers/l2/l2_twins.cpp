// SPDX-License-Identifier: MIT
#include "analyzers/l2/l2_twins.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "analyzers/l2/l2_terms.hpp"
#include "core/parallel.hpp"
#include "core/vectors.hpp"

// The vectors never leave a function that is not inlined.

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
constexpr std::size_t width = 64;   ///< points of a block
constexpr std::size_t columns = 3;  ///< of an axis: x, and a in two parts

using Four [[gnu::vector_size(8 * lanes)]] = double;
using Bits [[gnu::vector_size(8 * lanes)]] = std::int64_t;

STIPPLE_INLINE Four load(const double* from) {
    Four v;
    std::memcpy(&v, from, sizeof v);
    return v;
}
STIPPLE_INLINE Four all(double x) { return Four{x, x, x, x}; }

STIPPLE_INLINE Four fused(Four a, Four b, Four c) {
    Four r;
    for (std::size_t l = 0; l < lanes; ++l) r[l] = __builtin_fma(a[l], b[l], c[l]);
    return r;
}

/// high + low, low at most half a unit in the last place of high.
struct Twin {
    Four high;
    Four low;
};

/// Sum of two doubles, exact.
STIPPLE_INLINE Twin sum(Four a, Four b) {
    const Four s = a + b;
    const Four part = s - a;
    return {s, (a - (s - part)) + (b - part)};
}

/// The same where the first is the larger one.
STIPPLE_INLINE Twin renewed(Four a, Four b) {
    const Four s = a + b;
    return {s, b - (s - a)};
}

/// Off by a little of |a| + |b|, not of the sum: terms may cancel.
STIPPLE_INLINE Twin operator+(Twin a, Twin b) {
    const Twin high = sum(a.high, b.high);
    return renewed(high.high, high.low + (a.low + b.low));
}

STIPPLE_INLINE Twin product(Four a, Four b) {
    const Four p = a * b;
    return {p, fused(a, b, -p)};
}

STIPPLE_INLINE Twin operator*(Twin a, Twin b) {
    const Twin high = product(a.high, b.high);
    return renewed(high.high, high.low + fused(a.high, b.low, a.low * b.high));
}

STIPPLE_INLINE Twin magnitude(Twin a) {
    const Bits sign = (Bits)a.high & std::int64_t{-0x7fff'ffff'ffff'ffff - 1};
    return {(Four)((Bits)a.high ^ sign), (Four)((Bits)a.low ^ sign)};
}

/// What is the same for all points on an axis.
struct AxisConstants {
    DoubleDouble product;   ///< p
    DoubleDouble distance;  ///< s
};

/// Blocks of points, column after column in each; behind them one that is 1, and 0 where there are
/// no points.
struct Table {
    std::size_t count = 0;
    std::vector<AxisConstants> axes = {};
    std::vector<double> numbers = {};

    [[nodiscard]] std::size_t height() const { return axes.size() * columns + 1; }
    [[nodiscard]] const double* block(std::size_t b) const {
        return numbers.data() + b * height() * width;
    }
    double& at(std::size_t i, std::size_t column) {
        return numbers[(i / width * height() + column) * width + i % width];
    }
    [[nodiscard]] double at(std::size_t i, std::size_t column) const {
        return block(i / width)[column * width + i % width];
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

/// The factor of a point, its numbers in `row`, and four of a block on an axis.
STIPPLE_INLINE Twin factor(const double* row, const double* block, const AxisConstants& axis) {
    const Four x = all(row[0]);
    const Four y = load(block);
    const Twin t = magnitude(sum(x, -y));
    const Twin own{all(row[1]), all(row[2])};
    const Twin theirs{load(block + width), load(block + 2 * width)};
    const Twin p{all(axis.product.high), all(axis.product.low)};
    const Twin s{all(axis.distance.high), all(axis.distance.low)};
    return (own + theirs) + (p * product(x, y) + s * t);
}

/// Adds the products of a point with a block's.
STIPPLE_FUSED void meet(const Table& table, const double* row, const double* block, Sums& sums) {
    const std::size_t axes = table.axes.size();
    Four total = load(sums.sum);
    Four lost = load(sums.lost);
    const auto add = [&](const Twin& value, const double* presence) {
        const Four there = load(presence);
        const Twin next = sum(total, value.high * there);
        total = next.high;
        lost += next.low + value.low * there;
    };
    for (std::size_t k = 0; k < width; k += 2 * lanes) {  // two at a time: they need not wait
        Twin one = factor(row, block + k, table.axes[0]);
        Twin two = factor(row, block + k + lanes, table.axes[0]);
        for (std::size_t j = 1; j < axes; ++j) {
            const double* const own = row + j * columns;
            const double* const theirs = block + j * columns * width + k;
            one = one * factor(own, theirs, table.axes[j]);
            two = two * factor(own, theirs + lanes, table.axes[j]);
        }
        const double* const presence = block + axes * columns * width + k;
        add(one, presence);
        add(two, presence + lanes);
    }
    std::memcpy(sums.sum, &total, sizeof total);
    std::memcpy(sums.lost, &lost, sizeof lost);
}

/// The products of a point with the blocks [first, last).
Quad sum_of_blocks(const Table& table, const double* row, std::size_t first, std::size_t last) {
    constexpr std::size_t together = 16;  // so few that what they lose is summed well enough
    Quad total = 0;
    for (std::size_t b = first; b < last;) {
        Sums sums;
        const std::size_t end = std::min(last, b + together);
        for (; b < end; ++b) meet(table, row, table.block(b), sums);
        total += sums.total();
    }
    return total;
}

/// Sum over all ordered pairs of points.
Quad sum_over_pairs(const Table& table, const RunContext& run) {
    std::vector<Quad> sums(block_count(table.count, width));
    const std::size_t height = table.height() - 1;
    for_each_block(run, table.count, width, [&](const Block& rows) {
        Quad below = 0;
        Quad own = 0;
        std::vector<double> row(height);
        for (std::uint64_t i = rows.first; i < rows.last; ++i) {
            run.check_stop();
            for (std::size_t column = 0; column < height; ++column)
                row[column] = table.at(i, column);
            below += sum_of_blocks(table, row.data(), 0, rows.index);
            own += sum_of_blocks(table, row.data(), rows.index, rows.index + 1);
        }
        sums[rows.index] = 2 * below + own;
    });
    Quad total = 0;
    for (const Quad& part : sums) total += part;
    return total;
}

struct Prepared {
    Table table;
    Quad means = 0;    ///< mean of the products of the factors' means
    Quad total = 1;    ///< product of the means of these
    double terms = 0;  ///< sum of the largest terms
    double most = 1;   ///< product of the largest factors
};

/// Writes the columns of all points on these axes; gives the mean of the products of means.
Quad fill(Table& table, const PointSet& points, const std::vector<std::size_t>& axes,
          const std::vector<AxisTerms>& terms, const RunContext& run) {
    Quad means = 0;
    for (std::size_t i = 0; i < table.count; ++i) {
        if (i % 256 == 0) run.check_stop();
        Quad mean = 1;
        for (std::size_t j = 0; j < axes.size(); ++j) {
            const double x = points[i][axes[j]] + 0.0;
            const DoubleDouble own = to_double_double(terms[j].own(x));
            table.at(i, j * columns) = x;
            table.at(i, j * columns + 1) = own.high;
            table.at(i, j * columns + 2) = own.low;
            mean *= terms[j].mean(x);
        }
        table.at(i, axes.size() * columns) = 1;
        means += mean;
    }
    return means / table.count;
}

Prepared prepare(const PointSet& points, Kind kind, const std::vector<double>& weights,
                 const RunContext& run) {
    const KindRecord& record = record_of(kind);
    const bool alone = weights.empty() && !record.projections;
    Prepared out;
    std::vector<std::size_t> axes;
    std::vector<AxisTerms> terms;
    for (std::size_t j = 0; j < points.dimension(); ++j) {
        const double weight = weights.empty() ? 1 : weights[j];
        if (weight == 0) continue;
        axes.push_back(j);
        terms.emplace_back(record, alone, weight);
        AxisConstants axis;
        axis.product = to_double_double(terms.back().product());
        axis.distance = to_double_double(terms.back().distance());
        out.table.axes.push_back(axis);
        out.total *= terms.back().total();
        out.terms += terms.back().terms();
        out.most *= std::max(1.0, terms.back().most());
    }
    if (axes.empty()) return out;
    out.table.count = points.count();
    const std::size_t blocks = block_count(points.count(), width);
    out.table.numbers.resize(blocks * out.table.height() * width);
    out.means = fill(out.table, points, axes, terms, run);
    return out;
}

}  // namespace

bool twins_are_quick(std::size_t count, std::size_t dimension) {
    const auto n = static_cast<double>(count);
    return n * n * static_cast<double>(dimension) <= 1e8;
}

Square twin_square(const PointSet& points, Kind kind, const std::vector<double>& weights,
                   const RunContext& run) {
    const Prepared set = prepare(points, kind, weights, run);
    if (set.table.count == 0) {  // all weights are 0
        run.tick(1, 1);
        return {0, 0};
    }
    const Quad n = points.count();
    const Quad pairs = sum_over_pairs(set.table, run) / (n * n);
    const Quad squared = set.total - 2 * set.means + pairs;
    require_finite(static_cast<double>(squared), kind, points.dimension());
    // Factors of at least 1 lose by their terms relative to themselves, others to the largest.
    const bool above_one =
        kind != Kind::diaphony && (record_of(kind).projections || !weights.empty());
    const double products = above_one ? static_cast<double>(pairs) : set.most;
    const double error = (0x1p-97 * set.terms + 0x1p-90) * std::max(products, 1.0) +
                         0x1p-53 * std::abs(static_cast<double>(squared));
    return {static_cast<double>(squared), error};
}

}  // namespace stipple::analyzers::l2
