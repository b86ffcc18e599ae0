// SPDX-License-Identifier: MIT
#include "math/discrepancy/star/strips.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/machine/large_pages.hpp"
#include "core/machine/wide.hpp"

namespace stipple::discrepancy::star {
namespace {

using Floats = float __attribute__((vector_size(32)));
using Doubles = double __attribute__((vector_size(32)));

/// Loads a vector from unaligned numbers; store() writes it back.
template <class Vector, class T>
[[gnu::always_inline]] inline Vector load(const T* from) {
    Vector vector;
    std::memcpy(&vector, from, sizeof vector);
    return vector;
}
template <class T, class Vector>
[[gnu::always_inline]] inline void store(T* to, const Vector& vector) {
    std::memcpy(to, &vector, sizeof vector);
}

/// The lines of strips and blocks, the braces in strips.hpp, are w z - c, |w| <= 2 B, |c| <= B and
/// 0 <= z <= 1. They are stored in single precision, in rows padded to whole vectors.
constexpr std::size_t lanes = sizeof(Floats) / sizeof(float);

std::size_t padded(std::size_t size) { return (size + lanes - 1) / lanes * lanes; }

/// Exceeds the rounding error of any term of a bound, such as a chord; in numbers of points.
constexpr double margin = 0x1p-8;

/// Value of c for padding: its line stays far below all others, even after points are added.
constexpr float no_line = 1e30F;

/// Points in a group, divided by n^(1/3); found by trial.
constexpr double group_factor = 1;

constexpr std::size_t checks_apart = 1 << 16;  // points between checks of the stop token

struct Heights {
    double low;
    double high;
};

/// Maxima of all lines w z - c at z_low and at z_high.
STIPPLE_WIDE Heights highest(const float* w, const float* c, std::size_t size, float z_low,
                             float z_high) {
    Floats low = Floats{} - no_line;
    Floats high = low;
    for (std::size_t i = 0; i < size; i += lanes) {
        const auto weight = load<Floats>(w + i);
        const auto points = load<Floats>(c + i);
        const Floats at_low = weight * z_low - points;
        const Floats at_high = weight * z_high - points;
        low = at_low > low ? at_low : low;
        high = at_high > high ? at_high : high;
    }
    Heights top{low[0], high[0]};
    for (std::size_t k = 1; k < lanes; ++k) {
        top.low = std::max(top.low, double{low[k]});
        top.high = std::max(top.high, double{high[k]});
    }
    return top;
}

/// Returns the maximum of p y + x slope + height, and then adds `add` to all heights.
STIPPLE_WIDE double pass(double* height, const double* y, const double* slope, std::size_t size,
                         double p, double x, double add) {
    constexpr std::size_t wide = sizeof(Doubles) / sizeof(double);
    Doubles best = Doubles{} - std::numeric_limits<double>::infinity();
    std::size_t i = 0;
    for (; i + wide <= size; i += wide) {
        const auto before = load<Doubles>(height + i);
        const Doubles here = load<Doubles>(y + i) * p + load<Doubles>(slope + i) * x + before;
        best = here > best ? here : best;
        store(height + i, before + add);
    }
    double top = std::max(std::max(best[0], best[1]), std::max(best[2], best[3]));
    for (; i < size; ++i) {
        top = std::max(top, p * y[i] + x * slope[i] + height[i]);
        height[i] += add;
    }
    return top;
}

STIPPLE_WIDE void add_to_vectors(float* c, std::size_t size, float by) {
    for (std::size_t i = 0; i < size; i += lanes) store(c + i, load<Floats>(c + i) + by);
}

/// Adds `by` to c[from], ..., c[size - 1]; `size` is a multiple of the vector length.
void add_from(float* c, std::size_t from, std::size_t size, float by) {
    const std::size_t whole = padded(from);
    for (std::size_t i = from; i < whole; ++i) c[i] += by;
    add_to_vectors(c + whole, size - whole, by);
}

/// Adds `by` to c[0], ..., c[to - 1].
void add_before(float* c, std::size_t to, float by) {
    const std::size_t whole = to / lanes * lanes;
    add_to_vectors(c, whole, by);
    for (std::size_t i = whole; i < to; ++i) c[i] += by;
}

/// A linear upper bound on all lines between z_low and z_high, from the maxima at both.
struct Chord {
    double height;  ///< at z = 0
    double slope;
};

Chord chord(const Heights& ends, double z_low, double z_high) {
    constexpr double near = 1e-6;  // shorter ranges get slope 0, as rounding would distort it
    const auto [low, high] = ends;
    if (z_high - z_low < near) return {std::max(low, high) + margin, 0};
    const double slope = (high - low) / (z_high - z_low);
    return {low - slope * z_low + margin, slope};
}

template <Side side>
class Sweep {
  public:
    Sweep(const Plane& plane, std::size_t from, WorstBox& worst, const RunContext& run)
        : plane_(plane),
          xs_(plane.grid->values[0]),
          ys_(plane.grid->values[1]),
          worst_(worst),
          y_(plane.blocks.count()),
          slope_(y_.size()),
          height_(y_.size()),
          raised_(y_.size()),
          row_(y_.size() + 1) {
        for (std::size_t u = 0; u < y_.size(); ++u)
            row_[u + 1] = row_[u] + padded(size_of(plane.blocks, u));
        fill_with_zeros(weight_, row_.back());
        fill_with_zeros(points_, row_.back());
        std::ranges::fill(points_, no_line);
        for (std::size_t u = 0; u < y_.size(); ++u) fill_block(u);
        start(from, run);
    }

    void pass_strip(std::size_t strip) {
        open_strip(strip);
        std::size_t block = 0;
        for (entered_ = 0; entered_ < entering_.size(); ++entered_) {
            const std::size_t from = entering_[entered_].block + (side == Side::open ? 1 : 0);
            if (from > block) pass_blocks(block, from);
            block = std::max(block, from);
            enter_strip(entering_[entered_].dot);
        }
        if (block < y_.size()) pass_blocks(block, y_.size());
        if (strip + 1 < plane_.strips.count()) enter_blocks(strip);
    }

  private:
    struct Entering {
        std::uint32_t block;
        std::uint32_t dot;
    };

    struct Line {
        std::uint32_t index;  ///< of the line in its strip or block
        double height;
    };

    static std::size_t size_of(const Groups& groups, std::size_t g) {
        return groups.first[g + 1] - groups.first[g];
    }

    [[nodiscard]] double strip_x(std::size_t strip) const {
        return xs_[plane_.strips.first[strip]];
    }

    /// Sets up the lines of a block, before any points are added to it.
    void fill_block(std::size_t u) {
        const std::size_t first = plane_.blocks.first[u];
        const std::size_t size = size_of(plane_.blocks, u);
        y_[u] = side == Side::open ? ys_[first] : ys_[first + size - 1];
        for (std::size_t j = 0; j < size; ++j) {
            weight_[row_[u] + j] =
                static_cast<float>(plane_.count * std::abs(ys_[first + j] - y_[u]));
            points_[row_[u] + j] = 0;
        }
    }

    /// Adds all points to the left of a strip to their blocks.
    void start(std::size_t strip, const RunContext& run) {
        std::vector<std::uint64_t> points_in(y_.size());
        std::vector<std::uint32_t> until = plane_.first;
        for (std::size_t i = 0; i < plane_.dots_from[strip]; ++i) {
            if (i % checks_apart == 0) run.check_stop();
            const Dot& dot = plane_.dots[i];
            ++points_in[dot.block];
            until[dot.block] = plane_.next[i];
            if (size_of(plane_.blocks, dot.block) > 1)
                ++points_[row_[dot.block] + dot.second - plane_.blocks.first[dot.block]];
        }
        std::uint64_t below = 0;
        for (std::size_t u = 0; u < y_.size(); ++u) {
            sum_block(u);
            const std::uint64_t up_to = below + points_in[u];
            height_[u] =
                side == Side::open ? -static_cast<double>(below) : static_cast<double>(up_to);
            below = up_to;
        }
        run.check_stop();
        for (std::size_t u = 0; u < y_.size(); ++u) bound_block(u, strip, until[u]);
    }

    /// Converts a block's points_ from the numbers of points at its ranks to the numbers before
    /// (open) or after them (closed).
    void sum_block(std::size_t u) {
        const auto line = std::span(points_).subspan(row_[u], size_of(plane_.blocks, u));
        float sum = 0;
        for (std::size_t k = 0; k < line.size(); ++k) {
            float& here = line[side == Side::open ? k : line.size() - 1 - k];
            sum += std::exchange(here, sum);
        }
    }

    [[nodiscard]] Heights block_heights(std::size_t u, double low, double high) const {
        return highest(&weight_[row_[u]], &points_[row_[u]], row_[u + 1] - row_[u],
                       static_cast<float>(low), static_cast<float>(high));
    }

    /// Bounds a block by a chord from strip `from` to `to`, without points of it in between.
    void bound_block(std::size_t u, std::size_t from, std::size_t to) {
        constexpr double parts = 4096;  // keeps heights exact multiples of 1 / parts
        const double low = strip_x(from);
        const double high = strip_x(to);
        const Heights ends = block_heights(u, low, high);
        const Chord over = chord(ends, low, high);
        const double raised = std::ceil(over.height * parts) / parts;
        slope_[u] = over.slope;
        height_[u] += raised - std::exchange(raised_[u], raised);
    }

    /// Sets up the lines of a strip, and its points in order of their blocks.
    void open_strip(std::size_t strip) {
        strip_ = strip;
        first_ = plane_.strips.first[strip];
        const std::size_t size = size_of(plane_.strips, strip);
        x_ = strip_x(strip);
        strip_weight_.assign(padded(size), 0);
        strip_points_.assign(padded(size), no_line);
        for (std::size_t a = 0; a < size; ++a) {
            const auto weight = static_cast<float>(plane_.count * (xs_[first_ + a] - x_));
            strip_weight_[a] = side == Side::open ? weight : -weight;
            strip_points_[a] = 0;
        }
        const double width = plane_.count * (xs_[first_ + size - 1] - x_);
        corner_ = width * plane_.widest + margin;
        entering_.clear();
        for (auto i = plane_.dots_from[strip]; i < plane_.dots_from[strip + 1]; ++i)
            entering_.push_back({plane_.dots[i].block, i});
        std::ranges::sort(entering_, {}, &Entering::block);
    }

    void enter_strip(std::uint32_t dot) {
        const std::size_t size = size_of(plane_.strips, strip_);
        if (size == 1) return;
        const std::size_t from = plane_.dots[dot].first - first_ + (side == Side::open ? 1 : 0);
        if (from < size)
            add_from(strip_points_.data(), from, strip_points_.size(),
                     side == Side::open ? 1.0F : -1.0F);
    }

    /// Prefetches the lines of a block, which are rarely in the cache, shortly before their use.
    void fetch(std::size_t u) const {
        constexpr std::size_t together = 64 / sizeof(float);  // numbers per cache line
        for (std::size_t k = row_[u]; k < row_[u + 1]; k += together) {
            __builtin_prefetch(&points_[k], 1);
            __builtin_prefetch(&weight_[k]);
        }
    }

    /// Adds the strip's points to their blocks.
    void enter_blocks(std::size_t strip) {
        for (std::size_t i = 0; i < entering_.size(); ++i) {
            constexpr std::size_t ahead = 3;
            if (i + ahead < entering_.size()) fetch(entering_[i + ahead].block);
            const auto [u, dot] = entering_[i];
            const std::size_t size = size_of(plane_.blocks, u);
            const std::size_t at = plane_.dots[dot].second - plane_.blocks.first[u];
            if (size > 1 && side == Side::open)
                add_from(&points_[row_[u]], at + 1, row_[u + 1] - row_[u], 1.0F);
            else if (size > 1)
                add_before(&points_[row_[u]], at, 1.0F);
            if (i + 1 == entering_.size() || entering_[i + 1].block != u)
                bound_block(u, strip + 1, plane_.next[dot]);
        }
    }

    [[nodiscard]] double level() const { return plane_.count * worst_.threshold(); }

    /// For a strip of a single rank: number of its entered points inside a box that ends there.
    [[nodiscard]] double all_entered() const {
        return side == Side::open ? 0 : static_cast<double>(entered_);
    }

    [[nodiscard]] Heights strip_heights(double low, double high) const {
        if (size_of(plane_.strips, strip_) > 1)
            return highest(strip_weight_.data(), strip_points_.data(), strip_weight_.size(),
                           static_cast<float>(low), static_cast<float>(high));
        return {all_entered(), all_entered()};
    }

    void pass_blocks(std::size_t from, std::size_t to) {
        const double low = y_[from];
        const double high = y_[to - 1];
        const Chord over = chord(strip_heights(low, high), low, high);
        const double up = plane_.count * x_;
        const double p = side == Side::open ? up + over.slope : over.slope - up;
        const double entered = static_cast<double>(entered_);
        const double add = side == Side::open ? -entered : entered;
        const double rest = over.height + corner_;
        const double top =
            pass(&height_[from], &y_[from], &slope_[from], to - from, p, x_, add) + rest;
        if (top < level()) return;
        for (std::size_t u = from; u < to; ++u)
            if (p * y_[u] + x_ * slope_[u] + (height_[u] - add) + rest >= level())
                look_at(u, height_[u] - add - raised_[u]);
    }

    /// Offers the boxes of the current strip and block u. `signed_points` is minus the number of
    /// points with r < a0 and t < j0 (open), or the number with r < a0 and t < j1 (closed).
    void look_at(std::size_t u, double signed_points) {
        const auto y = static_cast<float>(y_[u]);
        const double best_a = strip_heights(y, y).low;
        const double best_j = block_heights(u, x_, x_).low;
        const double area = plane_.count * x_ * y_[u];
        const double base = signed_points + (side == Side::open ? area : -area);
        const double room = base + best_a + best_j + corner_ + margin - level();
        if (room < 0) return;
        gather(&weight_[row_[u]], &points_[row_[u]], size_of(plane_.blocks, u),
               static_cast<float>(x_), best_j - room, of_block_);
        of_strip_.assign(1, {0, best_a});
        if (const std::size_t size = size_of(plane_.strips, strip_); size > 1)
            gather(strip_weight_.data(), strip_points_.data(), size, y, best_a - room, of_strip_);
        const auto first = std::ranges::lower_bound(entering_, u, {}, &Entering::block);
        const auto last = std::ranges::upper_bound(entering_, u, {}, &Entering::block);
        const auto corner_points = static_cast<std::uint64_t>(std::abs(signed_points));
        const double least = best_a + best_j - room;
        for (const auto& [a, height_a] : of_strip_)
            for (const auto& [j, height_j] : of_block_)
                if (height_a + height_j >= least) offer(u, a, j, corner_points, {first, last});
    }

    /// Finds the lines with heights of at least `least` at z. The highest comes first: once its box
    /// is offered, others rarely need an exact comparison.
    static void gather(const float* w, const float* c, std::size_t size, float z, double least,
                       std::vector<Line>& lines) {
        lines.clear();
        for (std::uint32_t i = 0; i < size; ++i) {
            const double height = w[i] * z - c[i];
            if (height < least) continue;
            lines.push_back({i, height});
            if (height > lines.front().height) std::swap(lines.front(), lines.back());
        }
    }

    void offer(std::size_t u, std::uint32_t a, std::uint32_t j, std::uint64_t corner_points,
               std::span<const Entering> inside) {
        const bool single = size_of(plane_.strips, strip_) == 1;
        const double of_strip = single ? all_entered() : std::abs(strip_points_[a]);
        const auto in_strip = static_cast<std::uint64_t>(of_strip);
        const auto in_block = static_cast<std::uint64_t>(points_[row_[u] + j]);
        const std::array corner{first_ + a, plane_.blocks.first[u] + j};
        std::uint64_t both = 0;
        for (const Entering& e : inside) {
            const Dot& dot = plane_.dots[e.dot];
            both += side == Side::open ? dot.first < corner[0] && dot.second < corner[1]
                                       : dot.first <= corner[0] && dot.second > corner[1];
        }
        worst_.offer(side, corner,
                     side == Side::open ? corner_points + in_strip + in_block + both
                                        : corner_points + in_strip - in_block - both);
    }

    const Plane& plane_;
    const std::vector<double>& xs_;
    const std::vector<double>& ys_;
    WorstBox& worst_;

    // State of the blocks; y_ to row_ have one element per block.
    std::vector<double> y_;         ///< Y_j0 (open) or Y_J (closed) of strips.hpp
    std::vector<double> slope_;     ///< slope of the chord as a function of x
    std::vector<double> height_;    ///< height of the chord plus signed points of look_at()
    std::vector<double> raised_;    ///< height of the chord alone
    std::vector<std::size_t> row_;  ///< index of the block's first line
    std::vector<float> weight_;     ///< w of each line
    std::vector<float> points_;     ///< c of each line

    // State of the current strip.
    std::size_t strip_ = 0;
    std::uint32_t first_ = 0;  ///< first rank of the strip
    double x_ = 0;
    double corner_ = 0;  ///< maximum of the last line of the formula in strips.hpp
    std::vector<float> strip_weight_;
    std::vector<float> strip_points_;
    std::vector<Entering> entering_;
    std::size_t entered_ = 0;  ///< number of points of entering_ added to the strip's lines
    /// Lines of the strip and of a block that may give a worse box than the worst so far.
    std::vector<Line> of_strip_;
    std::vector<Line> of_block_;
};

Groups groups_of(const std::vector<double>& values, const std::vector<std::uint32_t>& points_at,
                 std::size_t most, double widest) {
    Groups groups;
    std::size_t points = 0;
    for (std::uint32_t a = 0; a < values.size(); ++a) {
        points += points_at[a];
        if (a == 0 || points > most || values[a] - values[groups.first.back()] > widest) {
            groups.first.push_back(a);
            points = points_at[a];
        }
    }
    groups.first.push_back(static_cast<std::uint32_t>(values.size()));
    return groups;
}

/// Fills plane.dots, sorted by first rank, and plane.dots_from.
void sort_dots(const BoxGrid& grid, std::vector<std::uint32_t> points, Plane& plane,
               const RunContext& run) {
    std::uint32_t before = 0;
    for (auto& at : points) before += std::exchange(at, before);
    std::vector<std::uint32_t> block_of;
    fill_with_zeros(block_of, grid.values[1].size());
    for (std::uint32_t u = 0; u < plane.blocks.count(); ++u)
        std::fill(block_of.begin() + plane.blocks.first[u],
                  block_of.begin() + plane.blocks.first[u + 1], u);
    fill_with_zeros(plane.dots, grid.count);
    constexpr std::size_t ahead = 16;
    for (std::size_t i = 0; i < grid.count; ++i) {
        if (i % checks_apart == 0) run.check_stop();
        if (i + 2 * ahead < grid.count) {  // the elements to be read and written are rarely cached
            __builtin_prefetch(&points[grid.ranks[0][i + 2 * ahead]], 1);
            __builtin_prefetch(&block_of[grid.ranks[1][i + ahead]]);
            __builtin_prefetch(&plane.dots[points[grid.ranks[0][i + ahead]]], 1);
        }
        const std::uint32_t first = grid.ranks[0][i];
        const std::uint32_t second = grid.ranks[1][i];
        plane.dots[points[first]++] = {first, second, block_of[second]};
    }
    // Now points[r] is the index of the first dot of rank r + 1.
    plane.dots_from.push_back(0);
    for (std::size_t s = 1; s < plane.strips.first.size(); ++s)
        plane.dots_from.push_back(points[plane.strips.first[s] - 1]);
}

void find_next(Plane& plane, const RunContext& run) {
    fill_with_zeros(plane.next, plane.dots.size());
    const auto last = static_cast<std::uint32_t>(plane.strips.count() - 1);
    auto& next = plane.first;
    next.assign(plane.blocks.count(), last);
    for (std::size_t s = plane.strips.count(); s-- > 0;) {
        if (s % 256 == 0) run.check_stop();
        const auto from = plane.dots_from[s];
        const auto to = plane.dots_from[s + 1];
        for (auto i = from; i < to; ++i) plane.next[i] = next[plane.dots[i].block];
        for (auto i = from; i < to; ++i) next[plane.dots[i].block] = static_cast<std::uint32_t>(s);
    }
}

template <Side side>
void sweep(const Plane& plane, StripRange strips, WorstBox& worst, const RunContext& run,
           const std::function<void(std::uint64_t)>& passed) {
    Sweep<side> sweep(plane, strips.first, worst, run);
    for (std::size_t strip = strips.first; strip < strips.last; ++strip) {
        sweep.pass_strip(strip);
        passed(plane.dots_from[strip + 1] - plane.dots_from[strip]);
    }
}

}  // namespace

Plane plane(const BoxGrid& grid, const RunContext& run) {
    Plane plane;
    plane.grid = &grid;
    plane.count = static_cast<double>(grid.count);
    const double most = std::max(8.0, std::round(group_factor * std::cbrt(plane.count)));
    plane.widest = 2 * most / plane.count;
    const auto most_points = static_cast<std::size_t>(most);
    auto on_first = points_at(grid, 0);
    plane.strips = groups_of(grid.values[0], on_first, most_points, plane.widest);
    plane.blocks = groups_of(grid.values[1], points_at(grid, 1), most_points, plane.widest);
    run.check_stop();
    sort_dots(grid, std::move(on_first), plane, run);
    find_next(plane, run);
    return plane;
}

void sweep_strips(const Plane& plane, Side side, StripRange strips, WorstBox& worst,
                  const RunContext& run, const std::function<void(std::uint64_t)>& passed) {
    if (side == Side::open)
        sweep<Side::open>(plane, strips, worst, run, passed);
    else
        sweep<Side::closed>(plane, strips, worst, run, passed);
}

}  // namespace stipple::discrepancy::star
