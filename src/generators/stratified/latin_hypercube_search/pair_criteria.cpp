// SPDX-License-Identifier: MIT
//
// Criteria that are sums over pairs of points. Every pair has a value: its squared distance, to
// which each coordinate adds a term, or a product, which has a factor for each coordinate. The
// pair's energy is a function of this value. Rows are padded with values of zero energy.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <type_traits>

#include "core/machine/vectors.hpp"
#include "core/machine/wide.hpp"
#include "generators/stratified/latin_hypercube_search/criteria.hpp"

namespace stipple::latin_hypercube_search {
namespace {

constexpr std::size_t lanes = 8;

constexpr std::size_t padded(std::size_t n) { return (n + lanes - 1) / lanes * lanes; }

/// Sum of term(0), ..., term(n - 1) in an order that SIMD vectors of any width can follow.
template <class Term>
STIPPLE_INLINE double lane_sum(std::size_t n, Term term) {
    double sums[lanes]{};
    for (std::size_t j = 0; j < n; j += lanes)
        for (std::size_t l = 0; l < lanes; ++l) sums[l] += term(j + l);
    return ((sums[0] + sums[4]) + (sums[1] + sums[5])) +
           ((sums[2] + sums[6]) + (sums[3] + sums[7]));
}

/// A point that moves along a coordinate: the values of its pairs, and all points' positions x.
template <class Value>
struct Row {
    const Value* pairs;
    const Level* x;
    std::size_t size;
    Level from;
    Level to;
    Level apart;  ///< squared distance of categories, as in an Axis
};

/// Change of a squared distance, (to - x)^2 - (from - x)^2, as shift + slope x.
struct Shift {
    explicit Shift(const Row<Level>& row)
        : shift(row.to * row.to - row.from * row.from), slope(2 * (row.from - row.to)) {}
    STIPPLE_INLINE Level operator()(Level x) const { return shift + slope * x; }
    Level shift;
    Level slope;
};

/// Change of a squared distance along an axis of categories.
struct Change {
    explicit Change(const Row<Level>& row) : apart(row.apart), from(row.from), to(row.to) {}
    STIPPLE_INLINE Level operator()(Level x) const {
        return (to == x ? 0 : apart) - (from == x ? 0 : apart);
    }
    Level apart;
    Level from;
    Level to;
};

template <class Step>
STIPPLE_INLINE std::int64_t shortfall_by(const Row<Level>& row, Level target, Step step) {
    const Level* pairs = row.pairs;
    const Level* x = row.x;
    std::int64_t sum = 0;
    for (std::size_t j = 0; j < row.size; ++j)
        sum += std::max(0, target - (pairs[j] + step(x[j]))) - std::max(0, target - pairs[j]);
    return sum;
}

STIPPLE_WIDE std::int64_t shortfall_change(const Row<Level>& row, Level target) {
    return row.apart == 0 ? shortfall_by(row, target, Shift(row))
                          : shortfall_by(row, target, Change(row));
}

/// Replaces n <= 64 values r by r^(power / 2).
STIPPLE_INLINE void raise(double* r, std::size_t n, int power) {
    double result[64];
    for (std::size_t l = 0; l < n; ++l) result[l] = power % 2 == 1 ? std::sqrt(r[l]) : 1;
    for (int rest = power / 2; rest > 0; rest /= 2) {
        if (rest % 2 == 1)
            for (std::size_t l = 0; l < n; ++l) result[l] *= r[l];
        for (std::size_t l = 0; l < n; ++l) r[l] *= r[l];
    }
    for (std::size_t l = 0; l < n; ++l) r[l] = result[l];
}

/// Returns scale / squared distance; coinciding points (discrete axes) count as half a level apart.
STIPPLE_INLINE double over(double scale, Level square) {
    return scale / std::max(0.25, static_cast<double>(square));
}

template <class Step>
STIPPLE_INLINE double powers_by(const Row<Level>& row, int power, double scale, Step step) {
    constexpr std::size_t some = 64;
    double sum = 0;
    for (std::size_t first = 0; first < row.size; first += some) {
        const std::size_t n = std::min(some, row.size - first);
        const Level* pairs = row.pairs + first;
        const Level* x = row.x + first;
        double now[some];
        double then[some];
        for (std::size_t l = 0; l < n; ++l) {
            now[l] = over(scale, pairs[l]);
            then[l] = over(scale, pairs[l] + step(x[l]));
        }
        raise(now, n, power);
        raise(then, n, power);
        sum += lane_sum(n, [&](std::size_t l) { return then[l] - now[l]; });
    }
    return sum;
}

STIPPLE_WIDE double power_change(const Row<Level>& row, int power, double scale) {
    return row.apart == 0 ? powers_by(row, power, scale, Shift(row))
                          : powers_by(row, power, scale, Change(row));
}

/// Factor 1 + (|z| + |z'| - |z - z'|) / 2 of the centered discrepancy, z = 2 unit a, z' = 2 unit b.
STIPPLE_INLINE double centered_factor(double a, double b, double unit) {
    return 1 + (std::abs(a) + std::abs(b) - std::abs(a - b)) * unit;
}

STIPPLE_WIDE double centered_change(const Row<double>& row, double n) {
    const double unit = 1 / (4 * n);
    const double from = 2 * row.from + 1 - n;
    const double to = 2 * row.to + 1 - n;
    return 2 * lane_sum(row.size, [&](std::size_t j) {
               const double x = 2 * row.x[j] + 1 - n;
               const double now = row.pairs[j];
               return now * centered_factor(to, x, unit) / centered_factor(from, x, unit) - now;
           });
}

/// Distance of two positions (categories: 0 or `far`) plus `more`; at least 0.5, to divide by it.
STIPPLE_INLINE double gap_between(Level a, Level b, double far, double more) {
    const double difference = far == 0 ? std::abs(static_cast<double>(a - b)) : a == b ? 0 : far;
    return std::max(0.5, difference + more);
}

/// @param far distance of two categories; 0: no categories, distances are those of positions
STIPPLE_INLINE double projections_by(const Row<double>& row, double far, double more) {
    return lane_sum(row.size, [&](std::size_t j) {
        const double now = row.pairs[j];
        const double factor =
            gap_between(row.from, row.x[j], far, more) / gap_between(row.to, row.x[j], far, more);
        return now * (factor * factor) - now;
    });
}

STIPPLE_WIDE double projection_change(const Row<double>& row, double more) {
    return row.apart == 0 ? projections_by(row, 0, more)
                          : projections_by(row, std::sqrt(row.apart), more);
}

/// Values of pairs that are squared distances: each coordinate adds a term.
struct Distances {
    using Value = Level;
    static constexpr Level start = 0;
    static constexpr Level neutral = Level{1} << 30;

    static Level with(const Axis& axis, Level value, Level a, Level b) {
        return value + axis.square(a, b);
    }
    static Level moved(const Axis& axis, Level value, Level from, Level to, Level x) {
        return value + axis.square(to, x) - axis.square(from, x);
    }
};

/// Sum of the amounts by which squared distances fall short of a target.
struct Shortfall : Distances {
    Level target = 1;

    [[nodiscard]] double energy(Level value) const { return std::max(0, target - value); }
    [[nodiscard]] double change(const Axis&, const Row<Level>& row) const {
        return static_cast<double>(shortfall_change(row, target));
    }
};

/// Powers of inverse distances, scaled to 1 at the root mean square distance.
struct Powers : Distances {
    int power = 2;
    double scale = 1;

    [[nodiscard]] double energy(Level value) const {
        double r = over(scale, value);
        raise(&r, 1, power);
        return r;
    }
    [[nodiscard]] double change(const Axis&, const Row<Level>& row) const {
        return power_change(row, power, scale);
    }
};

/// Values of pairs that are products, with a factor for each coordinate.
template <class Factor>
struct Products : Factor {
    using Value = double;
    static constexpr double start = 1;
    static constexpr double neutral = 0;

    [[nodiscard]] double with(const Axis& axis, double value, Level a, Level b) const {
        return value * this->factor(axis, a, b);
    }
    [[nodiscard]] double moved(const Axis& axis, double value, Level from, Level to,
                               Level x) const {
        return value * this->factor(axis, to, x) / this->factor(axis, from, x);
    }
};

struct CenteredFactor {
    double n = 1;

    [[nodiscard]] double energy(double value) const { return 2 * value; }
    [[nodiscard]] double change(const Axis&, const Row<double>& row) const {
        return centered_change(row, n);
    }
    [[nodiscard]] double factor(const Axis&, Level a, Level b) const { return factor(a, b); }
    [[nodiscard]] double factor(Level a, Level b) const {
        return centered_factor(2 * a + 1 - n, 2 * b + 1 - n, 1 / (4 * n));
    }
    /// Mean of factor() over the other point: 1 + z/2 - z^2/2 at the distance z from the middle.
    [[nodiscard]] double mean_factor(Level a) const {
        const double z = std::abs(2 * a + 1 - n) / (2 * n);
        return 1 + (z - z * z) / 2;
    }
};

struct ProjectionFactor {
    double scale = 1;  ///< typical difference of levels
    double n = 1;

    /// Term added to differences along an axis of discrete outcomes; 0 along others.
    [[nodiscard]] double more(const Axis& axis) const {
        return axis.parts > 0 ? n / axis.parts : 0;
    }
    [[nodiscard]] static double energy(double value) { return value; }
    [[nodiscard]] double change(const Axis& axis, const Row<double>& row) const {
        return projection_change(row, more(axis));
    }
    [[nodiscard]] double factor(const Axis& axis, Level a, Level b) const {
        const double f = scale / gap_between(a, b, std::sqrt(axis.apart), more(axis));
        return f * f;
    }
};

using Centered = Products<CenteredFactor>;
using Projections = Products<ProjectionFactor>;

/// Energy of single points: in the centered discrepancy, a point's product with itself, minus 2 n
/// times its mean product.
class Singles {
  public:
    Singles(const Centered& measure, std::size_t points)
        : measure_(measure), own_(points, 1), mean_(points, 1) {}

    void with(std::size_t i, Level x) {
        own_[i] *= measure_.factor(x, x);
        mean_[i] *= measure_.mean_factor(x);
    }
    void move(std::size_t i, Level from, Level to) {
        own_[i] *= own_ratio(from, to);
        mean_[i] *= mean_ratio(from, to);
    }
    [[nodiscard]] double change(std::size_t i, Level from, Level to) const {
        return own_[i] * (own_ratio(from, to) - 1) -
               2 * measure_.n * mean_[i] * (mean_ratio(from, to) - 1);
    }
    [[nodiscard]] double energy() const {
        double sum = 0;
        for (std::size_t i = 0; i < own_.size(); ++i) sum += own_[i] - 2 * measure_.n * mean_[i];
        return sum;
    }

  private:
    [[nodiscard]] double own_ratio(Level from, Level to) const {
        return measure_.factor(to, to) / measure_.factor(from, from);
    }
    [[nodiscard]] double mean_ratio(Level from, Level to) const {
        return measure_.mean_factor(to) / measure_.mean_factor(from);
    }

    Centered measure_;
    std::vector<double> own_;
    std::vector<double> mean_;
};

/// Replaces Singles in measures without energies of single points.
class NoSingles {
  public:
    template <class Measure>
    NoSingles(const Measure&, std::size_t) {}
    void with(std::size_t, Level) {}
    void move(std::size_t, Level, Level) {}
    static double change(std::size_t, Level, Level) { return 0; }
    static double energy() { return 0; }
};

template <class Measure>
class PairCriterion final : public Criterion {
  public:
    PairCriterion(Measure measure, const Design& design, const Rules& rules, RunContext run)
        : measure_(std::move(measure)),
          rules_(rules),
          run_(std::move(run)),
          points_(design.points),
          fixed_(rules.fixed),
          stride_(padded(design.rows)),
          width_(padded(design.points)),
          dimension_(design.dimension),
          places_(stride_ * dimension_),
          singles_(measure_, points_) {
        for (std::size_t k = 0; k < dimension_; ++k)
            for (std::size_t i = 0; i < design.rows; ++i)
                places_[k * stride_ + i] = rules.axis(k).place(design.along(k)[i]);
        pairs_.reserve(points_ * width_);
        for (std::size_t i = 0; i < points_; ++i) {
            run_.check_stop();  // filling large memory may take a second
            pairs_.resize((i + 1) * width_, Measure::neutral);
        }
        rebuild();
    }

    double change(std::size_t k, std::size_t a, std::size_t b) override {
        const Level from = places(k)[a];
        const Level to = places(k)[b];
        if (b >= points_) return change_of(k, a, from, to);
        const Value between = at(a, b);
        at(a, b) = at(b, a) = Measure::neutral;
        const double sum = change_of(k, a, from, to) + change_of(k, b, to, from);
        at(a, b) = at(b, a) = between;
        return sum;
    }

    void exchange(std::size_t k, std::size_t a, std::size_t b, double change) override {
        const Level from = places(k)[a];
        const Level to = places(k)[b];
        move(k, a, b, from, to);
        if (b < points_) move(k, b, a, to, from);
        std::swap(places(k)[a], places(k)[b]);
        energy_ += change;
        largest_ = std::max(largest_, std::abs(energy_));
        constexpr std::uint64_t often = 1 << 14;  // exchanges between removals of rounding errors
        if (++exchanges_ % often == 0) rebuild();
    }

    [[nodiscard]] double energy() const override { return energy_; }

    [[nodiscard]] bool reached() const override {
        return std::is_same_v<Measure, Shortfall> && energy_ == 0;
    }

    bool aim(double target) override {
        if constexpr (std::is_same_v<Measure, Shortfall>) {
            if (target <= 0) target = std::ceil(mean_nearest());
            measure_.target = static_cast<Level>(std::clamp(target, 1.0, 0x1p29));
            energy_ = sum();
            return true;
        }
        return false;
    }

    [[nodiscard]] Score score() const override {
        if constexpr (!std::is_same_v<Measure, Shortfall>) return {sum(), 0};
        const double least = this->least();
        double count = 0;
        for_pairs([&](Value value) { count += static_cast<double>(value) == least; });
        return {-least, count};
    }

    Score score_below(const Score& other) override {
        if constexpr (std::is_same_v<Measure, Shortfall>) return reached() ? score() : other;
        constexpr double rounding = 1e-12;  // error of a sum relative to its largest value
        if (energy_ - rounding * largest_ < other.value && largest_ > 1e3 * std::abs(other.value))
            rebuild();
        return {std::min(energy_, other.value), 0};
    }

  private:
    using Value = typename Measure::Value;

    Level* places(std::size_t k) { return &places_[k * stride_]; }
    Value& at(std::size_t a, std::size_t b) { return pairs_[a * width_ + b]; }

    double change_of(std::size_t k, std::size_t a, Level from, Level to) {
        const Axis& axis = rules_.axis(k);
        const Row<Value> row{&at(a, 0), places(k), width_, from, to, axis.apart};
        return measure_.change(axis, row) + singles_.change(a, from, to);
    }

    void move(std::size_t k, std::size_t a, std::size_t except, Level from, Level to) {
        const Level* x = places(k);
        for (std::size_t j = 0; j < points_; ++j)
            if (j != a && j != except)
                at(a, j) = at(j, a) = measure_.moved(rules_.axis(k), at(a, j), from, to, x[j]);
        singles_.move(a, from, to);
    }

    void for_pairs(auto take) const {
        for (std::size_t i = fixed_; i < points_; ++i)
            for (std::size_t j = 0; j < i; ++j) take(pairs_[i * width_ + j]);
    }

    [[nodiscard]] double least() const {
        Value least = Measure::neutral;
        for_pairs([&](Value value) { least = std::min(least, value); });
        return static_cast<double>(least);
    }

    /// Mean squared distance of a point to its nearest neighbour.
    [[nodiscard]] double mean_nearest() const {
        double sum = 0;
        for (std::size_t i = fixed_; i < points_; ++i)
            sum += static_cast<double>(
                *std::min_element(&pairs_[i * width_], &pairs_[i * width_] + points_));
        return sum / static_cast<double>(points_ - fixed_);
    }

    /// Energy, summed anew: without rounding errors of former, possibly huge values.
    [[nodiscard]] double sum() const {
        double sum = singles_.energy();
        for_pairs([&](Value value) { sum += measure_.energy(value); });
        return sum;
    }

    void rebuild() {
        singles_ = {measure_, points_};
        for (std::size_t i = 0; i < points_; ++i) {
            run_.check_stop();
            for (std::size_t k = 0; k < dimension_; ++k) singles_.with(i, places(k)[i]);
            for (std::size_t j = 0; i >= fixed_ && j < i; ++j) {
                Value value = Measure::start;
                for (std::size_t k = 0; k < dimension_; ++k)
                    value = measure_.with(rules_.axis(k), value, places(k)[i], places(k)[j]);
                at(i, j) = at(j, i) = value;
            }
        }
        energy_ = sum();
        largest_ = std::abs(energy_);
    }

    Measure measure_;
    Rules rules_;
    RunContext run_;
    std::size_t points_;
    std::size_t fixed_;
    std::size_t stride_;  ///< length of a row of places_
    std::size_t width_;   ///< length of a row of pairs_
    std::size_t dimension_;
    std::vector<Level> places_;
    std::vector<Value> pairs_;
    std::conditional_t<std::is_same_v<Measure, Centered>, Singles, NoSingles> singles_;
    double energy_ = 0;
    double largest_ = 0;  ///< largest absolute energy since rebuild()
    std::uint64_t exchanges_ = 0;
};

template <class Measure>
std::unique_ptr<Criterion> criterion_by(Measure measure, const Design& design, const Rules& rules,
                                        const RunContext& run) {
    return std::make_unique<PairCriterion<Measure>>(std::move(measure), design, rules, run);
}

}  // namespace

std::unique_ptr<Criterion> pair_criterion(const Objective& objective, const Design& design,
                                          const Rules& rules, const RunContext& run) {
    const auto n = static_cast<double>(design.points);
    switch (objective.kind) {
        case Kind::maximin:
            return criterion_by(Shortfall(), design, rules, run);
        case Kind::centered_l2:
            return criterion_by(Centered{{n}}, design, rules, run);
        case Kind::maxpro:
            return criterion_by(Projections{{usual_difference(design.points), n}}, design, rules,
                                run);
        default: {
            Powers measure;
            measure.power = objective.kind == Kind::phi_p ? objective.power : 2;
            measure.scale = usual_square(design.points, design.dimension);
            return criterion_by(measure, design, rules, run);
        }
    }
}

}  // namespace stipple::latin_hypercube_search
