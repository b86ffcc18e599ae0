// SPDX-License-Identifier: MIT
#include "experiments/parameters/linear_correlation.hpp"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "math/functions/exponential.hpp"
#include "math/functions/jacobi_eigen.hpp"
#include "math/functions/logarithm.hpp"
#include "math/functions/normal_distribution.hpp"
#include "math/functions/radians.hpp"

namespace stipple::parameters {
namespace {

using Increment = Scored::Increment;

constexpr double farthest = 37;  // largest score; Phi(-37) is about 1e-300
constexpr double panel = 1.0 / 8;

double normal_density(double z) {
    return exponential(-z * z / 2) / std::sqrt(2 * std::numbers::pi);
}

/// Integral of f from low to high, by Gauss's rule with n nodes.
template <std::size_t n, class F>
double by_gauss(double low, double high, const F& f) {
    using Rule = boost::math::quadrature::gauss<double, n>;
    const double half = (high - low) / 2;
    const double middle = low + half;
    double sum = 0;
    for (std::size_t i = Rule::abscissa().size(); i-- > 0;) {
        const double away = half * Rule::abscissa()[i];
        const double values = away == 0 ? f(middle) : f(middle - away) + f(middle + away);
        sum += Rule::weights()[i] * values;
    }
    return half * sum;
}

/// Mean of f over the normal distribution; f must be smooth between consecutive `cuts`.
template <class F>
double normal_mean(std::vector<double> cuts, const F& f) {
    for (double z = -farthest; z <= farthest; z += 0.5) cuts.push_back(z);
    std::ranges::sort(cuts);
    double sum = 0;
    for (std::size_t i = 1; i < cuts.size(); ++i)
        if (cuts[i] > cuts[i - 1])
            sum += by_gauss<10>(cuts[i - 1], cuts[i],
                                [&](double z) { return f(z) * normal_density(z); });
    return sum;
}

/// Normal score with the probabilities `below` and `above` it.
double score_of(double below, double above) {
    const double m = std::max(std::min(below, above), 1e-300);
    return detail::normal_quantile(below < above ? below - 0.5 : 0.5 - above, m);
}

/// Reduces increments to at most four with the same moments up to order seven, added to `out`.
void gather(std::span<const Increment> many, std::vector<Increment>& out) {
    constexpr std::size_t nodes = 4;
    if (many.size() <= nodes) {
        out.insert(out.end(), many.begin(), many.end());
        return;
    }
    const double middle = (many.front().at + many.back().at) / 2;
    const double half = (many.back().at - many.front().at) / 2;
    std::vector<double> before(many.size(), 0), p(many.size(), 1);  // orthogonal polynomials
    std::vector<double> jacobi(nodes * nodes);
    double total = 0, last = 0;
    std::size_t n = 0;
    for (; n < nodes; ++n) {
        double norm = 0, first = 0;
        for (std::size_t i = 0; i < many.size(); ++i) {
            const double w = many[i].size * p[i] * p[i];
            norm += w;
            first += half > 0 ? w * (many[i].at - middle) / half : 0;
        }
        if (n == 0) total = norm;
        if (!(norm > 1e-14 * total)) break;
        const double alpha = first / norm;
        const double beta = n == 0 ? 0 : norm / last;
        jacobi[n * nodes + n] = alpha;
        if (n > 0) jacobi[n * nodes + n - 1] = jacobi[(n - 1) * nodes + n] = std::sqrt(beta);
        for (std::size_t i = 0; i < many.size(); ++i) {
            const double t = half > 0 ? (many[i].at - middle) / half : 0;
            const double next = (t - alpha) * p[i] - beta * before[i];
            before[i] = p[i];
            p[i] = next;
        }
        last = norm;
    }
    std::vector<double> matrix(n * n);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) matrix[i * n + j] = jacobi[i * nodes + j];
    const auto [values, vectors] = jacobi_eigen(std::move(matrix), n);
    std::vector<Increment> few;
    for (std::size_t i = 0; i < n; ++i)
        few.push_back({middle + half * values[i], total * vectors[i] * vectors[i]});
    std::ranges::sort(few, {}, &Increment::at);
    out.insert(out.end(), few.begin(), few.end());
}

std::vector<Increment> mirrored(std::vector<Increment> increments) {
    std::ranges::reverse(increments);
    for (Increment& increment : increments) increment.at = -increment.at;
    return increments;
}

/// S(t) of linear_correlation.hpp. @param c, s cosine and sine of t
double slope(const std::vector<Increment>& a, const std::vector<Increment>& b, double c, double s) {
    const double reach = 12 * c;
    const double exponent = -0.5 / (c * c);
    double sum = 0;
    auto from = b.begin();
    for (const auto& [z, size] : a) {
        const double centre = z * s;
        while (from != b.end() && from->at < centre - reach) ++from;
        double inner = 0;
        for (auto w = from; w != b.end() && w->at <= centre + reach; ++w)
            inner += w->size * exponential(exponent * (w->at - centre) * (w->at - centre));
        sum += size * exponential(-z * z / 2) * inner;
    }
    return sum / (2 * std::numbers::pi);
}

/// Legendre series of S on an interval of angles, with its integral.
class Part {
  public:
    template <class Slope>
    Part(double low, double high, const Slope& slope) : low_(low), high_(high) {
        for (std::size_t i = 0; i < order; ++i) {
            const double y = slope((low + high) / 2 + (high - low) / 2 * node(i));
            auto p = legendre(node(i));
            for (std::size_t k = 0; k < order; ++k)
                series_[k] += (static_cast<double>(k) + 0.5) * weight(i) * y * p[k];
        }
    }

    [[nodiscard]] double total() const { return integral(1); }
    [[nodiscard]] double end_slope() const {
        double sum = 0;
        for (const double c : series_) sum += c;  // all Legendre polynomials are 1 at the end
        return sum;
    }
    /// The angle at which the integral from the interval's start is `value`.
    [[nodiscard]] double reaching(double value) const {
        double low = -1, high = 1;
        for (int step = 0; step < 60; ++step) {
            const double middle = (low + high) / 2;
            (integral(middle) < value ? low : high) = middle;
        }
        return (low_ + high_) / 2 + (high_ - low_) / 2 * (low + high) / 2;
    }

  private:
    static constexpr std::size_t order = 15;
    using Rule = boost::math::quadrature::gauss<double, order>;
    static double node(std::size_t i) {
        return i < order / 2 ? -Rule::abscissa()[order / 2 - i] : Rule::abscissa()[i - order / 2];
    }
    static double weight(std::size_t i) {
        return Rule::weights()[i < order / 2 ? order / 2 - i : i - order / 2];
    }
    static std::array<double, order + 1> legendre(double x) {
        std::array<double, order + 1> p{1, x};
        for (std::size_t k = 1; k < order; ++k) {
            const auto n = static_cast<double>(k);
            p[k + 1] = ((2 * n + 1) * x * p[k] - n * p[k - 1]) / (n + 1);
        }
        return p;
    }
    /// Integral of S from the interval's start to x; -1 and 1 denote the interval's ends.
    [[nodiscard]] double integral(double x) const {
        const auto p = legendre(x);
        double sum = series_[0] * (x + 1);
        for (std::size_t k = 1; k < order; ++k)
            sum += series_[k] * (p[k + 1] - p[k - 1]) / static_cast<double>(2 * k + 1);
        return sum * (high_ - low_) / 2;
    }

    double low_;
    double high_;
    std::array<double, order> series_{};
};

}  // namespace

Scored::Scored(MarginalPtr law, Of of) : law_(std::move(law)), ranks_(of == Of::ranks) {
    constexpr double most = 1 << 17;
    const MarginalMoments moments = law_->moments();
    if (ranks_ && law_->outcomes() == 1)
        fail(ErrorKind::usage, "a parameter with a single outcome has no rank correlation");
    if (law_->outcomes() == 1 ||
        (!ranks_ && !(std::isfinite(moments.variance) && moments.variance > 0)))
        fail(ErrorKind::usage,
             "a parameter whose variance is 0 or infinite has no linear correlation");
    if (!ranks_) {
        mean_ = moments.mean;
        deviation_ = std::sqrt(moments.variance);
    }
    if (law_->discrete() && law_->outcomes() <= most)
        take_steps();
    else if (law_->discrete())
        take_cells();
    else
        take_panels();
    deviation_ = std::sqrt(normal_mean(cuts_, [this](double z) { return at(z) * at(z); }));
    if (!ranks_ && !(std::abs(deviation_ * deviation_ / moments.variance - 1) < 1e-6))
        fail(
            ErrorKind::usage,
            "a parameter has no computable linear correlation if its tails are so heavy that much "
            "of its variance lies beyond probabilities of 1e-300, or if its values are so close to "
            "each other that float64 rounds them");
}

double Scored::number(double z) const {
    if (stepped_) {
        const auto after = std::ranges::upper_bound(increments_, z, {}, &Increment::at);
        return levels_[static_cast<std::size_t>(after - increments_.begin())];
    }
    const Tail tail = z < 0 ? Tail::lower : Tail::upper;
    const double p = normal_distribution(-std::abs(z));
    if (ranks_) return z < 0 ? p - 0.5 : 0.5 - p;
    return law_->quantile(p, tail);
}

double Scored::at(double z) const { return number(z) - mean_; }

void Scored::take_steps() {
    stepped_ = true;
    double x = law_->quantile(0);
    double below = 0;
    for (;;) {
        const double to = law_->probability(x, Tail::lower);
        const double above = law_->probability(x, Tail::upper);
        levels_.push_back(ranks_ ? (below + to - 1) / 2 : x);
        if (!(above > 0)) break;
        const double next =
            to < above ? law_->quantile(to, Tail::lower) : law_->quantile(above, Tail::upper);
        if (!(next > x)) break;
        increments_.push_back({score_of(to, above), 0});
        below = to;
        x = next;
    }
    for (std::size_t i = 0; i < increments_.size(); ++i) {
        increments_[i].size = levels_[i + 1] - levels_[i];
        cuts_.push_back(increments_[i].at);
    }
}

void Scored::take_cells() {
    constexpr int per_one = 256;
    constexpr int reach = 17 * per_one / 2;
    double x = number(static_cast<double>(-reach) / per_one);
    for (int i = -reach; i < reach; ++i) {
        const double next = number(static_cast<double>(i + 1) / per_one);
        if (next > x) increments_.push_back({(i + 0.5) / per_one, next - x});
        x = next;
    }
}

void Scored::take_panels() {
    const auto matters = [&](double z) {  // whether increments beyond the score z matter
        const double size = at(z) / deviation_;
        return normal_distribution(-std::abs(z)) * std::max(1.0, size * size) > 1e-13;
    };
    double low = -8, high = 8;
    while (low > -farthest && matters(low)) --low;
    while (high < farthest && matters(high)) ++high;
    const int count = static_cast<int>((high - low) / panel);
    double x = number(low);
    for (int i = 0; i < count; ++i) {
        const double from = low + i * panel;
        const double next = number(from + panel);
        add_panel(from, from + panel, x, next);
        x = next;
    }
}

void Scored::add_panel(double low, double high, double x_low, double x_high) {
    constexpr double least = 1.0 / 2048;
    if (!(x_high > x_low)) return;
    std::vector<Increment> nodes;
    const double sum = by_gauss<10>(low, high, [&](double z) {
        const double density = normal_density(z);
        const double x = number(z);
        const double rate = ranks_ ? density : density / law_->density(x);
        nodes.push_back({z, rate});
        return rate;
    });
    const double gained = x_high - x_low;
    const bool told = std::abs(sum - gained) <= 1e-9 * gained + 1e-11 * deviation_;
    if (!told && high - low > least) {
        const double middle = low + (high - low) / 2;
        const double x = number(middle);
        add_panel(low, middle, x_low, x);
        return add_panel(middle, high, x, x_high);
    }
    cuts_.push_back(low);
    cuts_.push_back(high);
    if (!(sum > 0 && std::isfinite(sum))) {
        increments_.push_back({(low + high) / 2, gained});
        return;
    }
    // Weights of Gauss's rule, in the order in which by_gauss() evaluates the nodes.
    using Rule = boost::math::quadrature::gauss<double, 10>;
    for (std::size_t i = 0; i < nodes.size(); ++i)
        nodes[i].size *=
            (high - low) / 2 * Rule::weights()[Rule::weights().size() - 1 - i / 2] * (gained / sum);
    std::ranges::sort(nodes, {}, &Increment::at);
    increments_.insert(increments_.end(), nodes.begin(), nodes.end());
}

std::vector<Increment> Scored::gathered(double width) const {
    std::vector<Increment> few;
    for (auto from = increments_.begin(); from != increments_.end();) {
        const double cell = std::floor(from->at / width);
        const auto to = std::find_if(from, increments_.end(), [&](const Increment& increment) {
            return std::floor(increment.at / width) != cell;
        });
        gather(std::span(from, to), few);
        from = to;
    }
    return few;
}

double Scored::extreme(const Scored& other, double sign) const {
    std::vector<double> cuts = cuts_;
    for (const double z : other.cuts_) cuts.push_back(sign * z);
    const double covariance =
        normal_mean(std::move(cuts), [&](double z) { return at(z) * other.at(sign * z); });
    return covariance / (deviation_ * other.deviation_);
}

double Scored::scores_for(const Scored& other, double r) const {
    const double sign = r < 0 ? -1 : 1;
    const double end = std::abs(extreme(other, sign));
    if (!(std::abs(r) < end))
        fail(ErrorKind::usage,
             "{} is not attainable: these two parameters have correlations in [{:.6f}, {:.6f}]", r,
             extreme(other, -1), extreme(other, 1));
    const double size = deviation_ * other.deviation_;
    const double wanted = std::abs(r);
    // Each octave halves the angle's cosine. Only exact steps resolve more than four octaves.
    const int octaves = stepped_ && other.stepped_ ? 21 : 4;
    double low = 0, reached = 0, rate = 0;
    for (int octave = 0; octave < octaves; ++octave) {
        const double width = 1.0 / (2 << octave);
        const double high = arc_cosine(width);
        const auto a = gathered(width);
        const auto b = sign > 0 ? other.gathered(width) : mirrored(other.gathered(width));
        const Part part(low, high, [&](double angle) {
            const auto [c, s] = cos_sin_radians(angle);
            return slope(a, b, c, s) / size;
        });
        if (reached + part.total() >= wanted)
            return sign * cos_sin_radians(part.reaching(wanted - reached)).sin;
        reached += part.total();
        rate = part.end_slope();
        low = high;
    }
    // Approximates the rest, up to pi / 2, by a power of the remaining angle with slope `rate`.
    const double width = std::numbers::pi / 2 - low;
    const double power = std::max(1.0, rate * width / (end - reached));
    const double left = exponential(logarithm((end - wanted) / (end - reached)) / power) * width;
    return sign * std::min(cos_sin_radians(left).cos, 1 - 1e-13);
}

}  // namespace stipple::parameters
