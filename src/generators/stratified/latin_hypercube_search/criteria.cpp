// SPDX-License-Identifier: MIT
#include "generators/stratified/latin_hypercube_search/criteria.hpp"

#include <algorithm>
#include <cmath>

#include "core/point_set.hpp"
#include "core/text.hpp"
#include "math/functions/exponential.hpp"
#include "math/functions/logarithm.hpp"
#include "math/l2/squares.hpp"

namespace stipple::latin_hypercube_search {
namespace {

double root(double value, double degree) {
    if (std::isinf(value)) return value;
    return value > 0 ? exponential(logarithm(value) / degree) : 0;
}

double pairs_of(std::size_t points) {
    const auto n = static_cast<double>(points);
    return n * (n - 1) / 2;
}

/// Positions (Axis::place) of the points along all coordinates, point after point.
std::vector<Level> placed(const Design& design, const Rules& rules) {
    std::vector<Level> x;
    for (std::size_t i = 0; i < design.points; ++i)
        for (std::size_t k = 0; k < design.dimension; ++k)
            x.push_back(rules.axis(k).place(design.along(k)[i]));
    return x;
}

/// Calls take(row, row) for every pair of points.
void for_pairs(const std::vector<Level>& x, std::size_t d, const RunContext& run, auto take) {
    for (std::size_t i = 0; i < x.size(); i += d) {
        run.check_stop();
        for (std::size_t j = 0; j < i; j += d) take(&x[i], &x[j]);
    }
}

double square_between(const Level* a, const Level* b, std::size_t d, const Rules& rules) {
    double sum = 0;
    for (std::size_t k = 0; k < d; ++k) sum += rules.axis(k).square(a[k], b[k]);
    return sum;
}

using Found = std::vector<std::pair<std::string, std::string>>;

Found described_distances(const std::vector<Level>& x, std::size_t d, const Rules& rules,
                          const RunContext& run) {
    double least = 0x1p62;
    std::uint64_t count = 0;
    for_pairs(x, d, run, [&](const Level* a, const Level* b) {
        const double square = square_between(a, b, d, rules);
        count = square < least ? 1 : count + (square == least);
        least = std::min(least, square);
    });
    return {{"squared_distance", format_number(least)}, {"pairs", std::to_string(count)}};
}

double power_sum(const std::vector<Level>& x, std::size_t d, const Rules& rules, int power,
                 const RunContext& run) {
    double sum = 0;
    for_pairs(x, d, run, [&](const Level* a, const Level* b) {
        const double square = square_between(a, b, d, rules);
        double term = power % 2 == 1 ? 1 / std::sqrt(square) : 1;
        for (int i = 0; i < power / 2; ++i) term /= square;
        sum += term;
    });
    return sum;
}

double maxpro_of(const std::vector<Level>& x, std::size_t d, const Rules& rules,
                 const RunContext& run) {
    const std::size_t points = x.size() / d;
    const auto n = static_cast<double>(points);
    const double scale = usual_difference(points);
    double sum = 0;
    for_pairs(x, d, run, [&](const Level* a, const Level* b) {
        double term = 1;
        for (std::size_t k = 0; k < d; ++k) {
            const Axis& axis = rules.axis(k);
            const double more = axis.parts > 0 ? n / axis.parts : 0;
            const double factor = scale / (std::sqrt(axis.square(a[k], b[k])) + more);
            term *= factor * factor;
        }
        sum += term;
    });
    const double ratio = n / scale;
    return ratio * ratio * root(sum / pairs_of(points), static_cast<double>(d));
}

Found described_l2(const std::vector<Level>& x, std::size_t d, const RunContext& run) {
    PointSet points(x.size() / d, d);
    const auto n = static_cast<double>(points.count());
    for (std::size_t i = 0; i < x.size(); ++i) points.flat()[i] = (2 * x[i] + 1) / (2 * n);
    const double squared =
        d <= 2 ? l2::plane_square(l2::plane_sums(points, run), d, l2::Kind::centered, {})
               : l2::pair_square(points, l2::Kind::centered, {}, run).squared;
    return {{"squared", format_number(squared)},
            {"l2_centered_discrepancy", format_number(std::sqrt(std::max(0.0, squared)))}};
}

/// Pearson correlation of two coordinates.
double correlation_of(const std::vector<Level>& x, std::size_t d, std::size_t k, std::size_t l) {
    const auto n = static_cast<double>(x.size() / d);
    double a = 0, b = 0, aa = 0, bb = 0, ab = 0;
    for (std::size_t i = 0; i < x.size(); i += d) {
        const double p = x[i + k];
        const double q = x[i + l];
        a += p, b += q, aa += p * p, bb += q * q, ab += p * q;
    }
    const double both = (n * aa - a * a) * (n * bb - b * b);
    return both > 0 ? (n * ab - a * b) / std::sqrt(both) : 0;
}

Found described_correlations(const std::vector<Level>& x, std::size_t d) {
    double largest = 0;
    double squares = 0;
    for (std::size_t k = 0; k < d; ++k)
        for (std::size_t l = 0; l < k; ++l) {
            const double r = correlation_of(x, d, k, l);
            largest = std::max(largest, std::abs(r));
            squares += r * r;
        }
    const double mean = squares / std::max(1.0, pairs_of(d));
    return {{"largest_correlation", format_number(largest)},
            {"root_mean_square_correlation", format_number(std::sqrt(mean))}};
}

/// Correlation criterion, from integer sums of products, one sum for every two coordinates. An
/// exchange changes d - 1 of these sums.
class CorrelationCriterion final : public Criterion {
  public:
    CorrelationCriterion(const Design& design, const Rules& rules)
        : points_(design.points), dimension_(design.dimension), x_(design.rows * dimension_) {
        const std::size_t d = dimension_;
        for (std::size_t k = 0; k < d; ++k) {
            double squares = 0;  // sum over all levels, some of them in spare rows
            for (std::size_t l = 0; l < points_; ++l) {
                const auto x =
                    static_cast<double>(twice_from_middle(static_cast<Level>(l), k, rules));
                squares += x * x;
            }
            lengths_.push_back(std::sqrt(squares));
            for (std::size_t i = 0; i < design.rows; ++i)
                x_[i * d + k] = twice_from_middle(design.along(k)[i], k, rules);
        }
        products_.resize(d * d);
        for (std::size_t i = 0; i < points_; ++i)
            for (std::size_t k = 0; k < d; ++k)
                for (std::size_t l = 0; l < d; ++l)
                    products_[k * d + l] += x_[i * d + k] * x_[i * d + l];
    }

    double change(std::size_t k, std::size_t a, std::size_t b) override {
        double sum = 0;
        for (std::size_t l = 0; l < dimension_; ++l)
            if (l != k)
                sum += fourth(k, l, products_[k * dimension_ + l] + growth(k, l, a, b)) -
                       fourth(k, l, products_[k * dimension_ + l]);
        return sum;
    }

    void exchange(std::size_t k, std::size_t a, std::size_t b, double) override {
        for (std::size_t l = 0; l < dimension_; ++l)
            if (l != k)
                products_[l * dimension_ + k] = products_[k * dimension_ + l] += growth(k, l, a, b);
        std::swap(x_[a * dimension_ + k], x_[b * dimension_ + k]);
    }

    [[nodiscard]] double energy() const override {
        double sum = 0;
        for_pairs([&](std::size_t k, std::size_t l) {
            sum += fourth(k, l, products_[k * dimension_ + l]);
        });
        return sum;
    }

    [[nodiscard]] bool reached() const override { return energy() == 0; }

    [[nodiscard]] Score score() const override {
        double largest = 0;
        for_pairs([&](std::size_t k, std::size_t l) {
            largest =
                std::max(largest, std::abs(over_lengths(k, l, products_[k * dimension_ + l])));
        });
        return {largest, energy()};
    }

    Score score_below(const Score&) override { return score(); }

  private:
    [[nodiscard]] std::int64_t twice_from_middle(Level level, std::size_t k,
                                                 const Rules& rules) const {
        return 2 * std::int64_t{rules.axis(k).place(level)} + 1 -
               static_cast<std::int64_t>(points_);
    }

    /// Growth of the sum of products of coordinates k and l if rows a and b exchange coordinate k.
    [[nodiscard]] std::int64_t growth(std::size_t k, std::size_t l, std::size_t a,
                                      std::size_t b) const {
        const std::int64_t* of_a = &x_[a * dimension_];
        const std::int64_t* of_b = &x_[b * dimension_];
        return (of_b[k] - of_a[k]) * (of_a[l] - (b < points_ ? of_b[l] : 0));
    }
    [[nodiscard]] double over_lengths(std::size_t k, std::size_t l, std::int64_t product) const {
        const double both = lengths_[k] * lengths_[l];
        return both > 0 ? static_cast<double>(product) / both : 0;
    }
    [[nodiscard]] double fourth(std::size_t k, std::size_t l, std::int64_t product) const {
        const double r = over_lengths(k, l, product);
        return (r * r) * (r * r);
    }
    void for_pairs(auto take) const {
        for (std::size_t k = 0; k < dimension_; ++k)
            for (std::size_t l = 0; l < k; ++l) take(k, l);
    }

    std::size_t points_;
    std::size_t dimension_;
    std::vector<std::int64_t> x_;  ///< twice a level's distance from the middle, row after row
    std::vector<std::int64_t> products_;  ///< sums of x_k x_l over all points, for all k and l
    std::vector<double> lengths_;         ///< Euclidean norm of each coordinate
};

}  // namespace

double usual_difference(std::size_t points) {
    return std::max(1.0, 0.3 * static_cast<double>(points));
}

double usual_square(std::size_t points, std::size_t dimension) {
    const auto n = static_cast<double>(points);
    return n * (n + 1) * static_cast<double>(dimension) / 6;
}

std::unique_ptr<Criterion> make_criterion(const Objective& objective, const Design& design,
                                          const Rules& rules, const RunContext& run) {
    return objective.kind == Kind::correlation
               ? std::make_unique<CorrelationCriterion>(design, rules)
               : pair_criterion(objective, design, rules, run);
}

double criterion_memory(const Objective& objective, const Design& design) {
    const auto n = static_cast<double>(design.points);
    const double rows = 24 * static_cast<double>(design.rows * design.dimension);
    if (objective.kind == Kind::correlation) return rows;
    const bool whole = objective.kind != Kind::centered_l2 && objective.kind != Kind::maxpro;
    return rows + n * (n + 8) * (whole ? sizeof(Level) : sizeof(double));
}

double reported(const Objective& objective, const Score& score, std::size_t points,
                std::size_t dimension) {
    const auto n = static_cast<double>(points);
    const auto d = static_cast<double>(dimension);
    switch (objective.kind) {
        case Kind::maximin:
            return -score.value;
        case Kind::phi_p:
            return root(score.value, objective.power) / std::sqrt(usual_square(points, dimension));
        case Kind::audze_eglais:
            return score.value / usual_square(points, dimension);
        case Kind::centered_l2: {
            double constant = 1;
            for (std::size_t k = 0; k < dimension; ++k) constant *= 13 / 12.0;
            return constant + score.value / (n * n);
        }
        case Kind::maxpro: {
            const double ratio = n / usual_difference(points);
            return ratio * ratio * root(score.value / pairs_of(points), d);
        }
        default:
            return score.value;
    }
}

Found described(const Objective& objective, const Design& design, const Rules& rules,
                const RunContext& run) {
    const std::vector<Level> x = placed(design, rules);
    const std::size_t d = design.dimension;
    if (objective.kind == Kind::centered_l2) return described_l2(x, d, run);
    if (objective.kind == Kind::correlation) return described_correlations(x, d);
    if (design.points < 2) return {};
    if (objective.kind == Kind::maximin) return described_distances(x, d, rules, run);
    const auto named = [](const char* name, double value) {
        return std::isfinite(value) ? Found{{name, format_number(value)}} : Found();
    };
    if (objective.kind == Kind::maxpro) return named("maxpro", maxpro_of(x, d, rules, run));
    const int power = objective.kind == Kind::phi_p ? objective.power : 2;
    const double sum = power_sum(x, d, rules, power, run);
    if (power == 2 && objective.kind == Kind::audze_eglais) return named("audze_eglais", sum);
    return named("phi_p", std::isfinite(sum) ? root(sum, power) : sum);
}

}  // namespace stipple::latin_hypercube_search
