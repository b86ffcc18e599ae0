// SPDX-License-Identifier: MIT
//
// Fast component-by-component construction. Let p_i be the product of the factors (1 + weight_k
// omega(i z_k / n)) over the components so far. The next component z minimises
//
//     E(z) = sum_i p_i omega(i z / n).
//
// The i with gcd(i, n) = n / e are n / e times the units modulo e, a group that is a product of
// cyclic ones. With i and z written as powers of its generators, the sum is a correlation, which a
// Fourier transform of several dimensions gives for all z at once (Rader's permutation, divisor by
// divisor).
//
// Cost     O(d n log n + d n t) for n with t divisors; 60 n bytes.
// Promise  the same vector on every machine, also in high dimensions, where a common power of two
//          is taken out of the products before they overflow (component_search.hpp).
// Source   D. Nuyens, R. Cools, Math. Comp. 75 (2006) 903-920, doi:10.1090/S0025-5718-06-01785-6
//          (n prime); J. Complexity 22 (2006) 4-28, doi:10.1016/j.jco.2005.07.002 (any n).
#include "generators/lattices/component_by_component.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>

#include "core/error.hpp"
#include "core/machine/wide.hpp"
#include "generators/lattices/component_search.hpp"
#include "math/arithmetic/quotient.hpp"
#include "math/arithmetic/ratio.hpp"
#include "math/combinatorics/primes.hpp"

namespace stipple {
namespace {

constexpr double two_pi_squared = 2 * std::numbers::pi * std::numbers::pi;
constexpr DoubleDouble pi_squared_third{0x1.a51a6625307d3p+1, 0x1.1873d8912200cp-54};
constexpr std::size_t rows_at_once = 1024;

/// omega(i z / n) for integers i and z up to 2^24; the same bits for i and n - i.
struct Omega {
    double n;
    double inverse = 1 / n;
    double scale = two_pi_squared / (n * n);

    /// The product i z modulo n.
    [[nodiscard]] double remainder(double product) const {
        double r = product - std::floor(product * inverse) * n;
        r = r < 0 ? r + n : r;
        return r >= n ? r - n : r;
    }
    [[nodiscard]] double operator()(double i, double z) const {
        const double r = remainder(i * z);
        return two_pi_squared / 6 - scale * (r * (n - r));
    }
};

/// Replaces each p[j] by p[j] (1 + t) + one t, with t = weight omega((first + j) z / n).
STIPPLE_WIDE void multiply(const Omega& omega, std::uint64_t first, std::size_t count, double z,
                           double weight, double one, double* p) {
    const auto begin = static_cast<double>(first);
    for (std::size_t j = 0; j < count; ++j) {
        const double i = begin + static_cast<double>(static_cast<std::int32_t>(j));
        const double t = weight * omega(i, z);
        p[j] = p[j] * (1 + t) + one * t;
    }
}

/// Sets high + low to scale times the integers n^2 omega((first + j) z / n) 3 / pi^2.
STIPPLE_WIDE void whole_terms(const Omega& omega, std::uint64_t first, std::size_t count, double z,
                              DoubleDouble scale, double* high, double* low) {
    const auto begin = static_cast<double>(first);
    for (std::size_t j = 0; j < count; ++j) {
        const double i = begin + static_cast<double>(static_cast<std::int32_t>(j));
        const double r = omega.remainder(i * z);
        const double whole = omega.n * omega.n - 6 * (r * (omega.n - r));
        const DoubleDouble term = split_product(whole, scale.high);
        high[j] = term.high;
        low[j] = term.low + whole * scale.low;
    }
}

/// Sets terms[j] to (p[j] - mean) omega((first + j) z / n).
STIPPLE_WIDE void weigh(const Omega& omega, std::uint64_t first, std::size_t count, double z,
                        double mean, const double* p, double* terms) {
    const auto begin = static_cast<double>(first);
    for (std::size_t j = 0; j < count; ++j) {
        const double i = begin + static_cast<double>(static_cast<std::int32_t>(j));
        terms[j] = (p[j] - mean) * omega(i, z);
    }
}

std::uint64_t power_modulo(std::uint64_t base, std::uint64_t exponent, std::uint64_t n) {
    std::uint64_t result = 1 % n;
    for (Wide square = base % n; exponent > 0; exponent /= 2, square = square * square % n)
        if (exponent % 2 != 0) result = static_cast<std::uint64_t>(result * square % n);
    return result;
}

struct PrimePower {
    std::uint64_t prime;
    std::uint64_t power;
};

std::vector<PrimePower> factors(std::uint64_t n) {
    std::vector<PrimePower> found;
    while (n > 1) {
        found.push_back({smallest_factor(n), 1});
        const auto prime = found.back().prime;
        for (; n % prime == 0; n /= prime) found.back().power *= prime;
    }
    return found;
}

/// Generator of a cyclic group of units, and the group's order.
struct Cycle {
    std::uint64_t generator;
    std::uint64_t order;
};

std::uint64_t primitive_root(const PrimePower& odd, std::uint64_t order) {
    const auto parts = factors(order);
    for (std::uint64_t g = 2;; ++g) {
        const bool all = std::ranges::all_of(parts, [&](const PrimePower& part) {
            return power_modulo(g, order / part.prime, odd.power) != 1;
        });
        if (g % odd.prime != 0 && all) return g;
    }
}

/// Cyclic groups whose product is the group of units modulo a prime power.
std::vector<Cycle> cycles_of(const PrimePower& q) {
    if (q.power == 2) return {};
    if (q.power == 4) return {{3, 2}};
    if (q.prime == 2) return {{q.power - 1, 2}, {5, q.power / 4}};
    const std::uint64_t order = q.power / q.prime * (q.prime - 1);
    return {{primitive_root(q, order), order}};
}

/// Units modulo e, ordered by the exponents of the generators, the last exponent fastest.
struct Units {
    std::uint64_t modulus;
    std::vector<int> shape;
    std::vector<std::uint32_t> elements;

    explicit Units(std::uint64_t e) : modulus(e), elements{1} {
        for (const PrimePower& q : factors(e))
            for (const Cycle& cycle : cycles_of(q))
                extend(lift(cycle.generator, q.power), cycle.order);
        if (shape.empty()) shape.push_back(1);
    }

  private:
    /// Number that is congruent to g modulo q, and to 1 modulo modulus / q.
    [[nodiscard]] std::uint64_t lift(std::uint64_t g, std::uint64_t q) const {
        const std::uint64_t rest = modulus / q;
        std::uint64_t number = 1;
        while (number % q != g) number += rest;
        return number;
    }

    void extend(std::uint64_t generator, std::uint64_t order) {
        shape.push_back(static_cast<int>(order));
        std::vector<std::uint32_t> longer;
        longer.reserve(elements.size() * order);
        for (std::uint64_t unit : elements)
            for (std::uint64_t k = 0; k < order; ++k, unit = unit * generator % modulus)
                longer.push_back(static_cast<std::uint32_t>(unit));
        elements = std::move(longer);
    }
};

/// Part of E(z) that sums over the i with gcd(i, n) = n / e.
class Part {
  public:
    Part(std::uint64_t n, std::uint64_t e) : units_(e), step_(n / e), correlation_(units_.shape) {
        const Omega omega{static_cast<double>(e)};
        for (std::size_t a = 0; a < units_.elements.size(); ++a)
            correlation_.values()[a] = omega(units_.elements[a], 1);
        correlation_.take_kernel();
    }

    /// Adds this part of E(z), up to a constant, to every total[z]; correct only for z prime to n.
    void add(std::span<const double> p, std::vector<double>& total) {
        gather(p);
        correlation_.correlate();
        std::vector<double> residues(units_.modulus);
        for (std::size_t a = 0; a < units_.elements.size(); ++a)
            residues[units_.elements[a]] = correlation_.values()[a];
        for (std::size_t z = 0; z < total.size(); z += units_.modulus) {
            const std::size_t count = std::min<std::size_t>(units_.modulus, total.size() - z);
            for (std::size_t j = 0; j < count; ++j) total[z + j] += residues[j];
        }
    }

  private:
    /// Collects the products minus their mean; subtracting it does not affect the choice.
    void gather(std::span<const double> p) {
        const std::span<double> line = correlation_.values();
        double sum = 0;
        for (std::size_t a = 0; a < line.size(); ++a)
            sum += line[a] = p[units_.elements[a] * step_];
        const double mean = sum / static_cast<double>(line.size());
        for (double& value : line) value -= mean;
    }

    Units units_;
    std::uint64_t step_;
    CyclicCorrelation correlation_;
};

class Construction {
  public:
    Construction(std::uint64_t n, const RunContext& run)
        : run_(run), n_(n), omega_{static_cast<double>(n)}, products_(n) {
        for (std::uint64_t e = 2; e <= n; ++e) {
            if (n % e != 0) continue;
            run_.check_stop();
            parts_.push_back(std::make_unique<Part>(n, e));
        }
        double square = 0;
        for (std::uint64_t i = 1; i < n; ++i) {
            const double w = omega_(static_cast<double>(i), 1);
            square += w * w;
        }
        kernel_norm_ = std::sqrt(square);
    }

    void multiply_by(std::uint64_t z, double weight) {
        const std::span<double> p = products_.all();
        for (std::uint64_t i = 0; i < n_; i += rows_at_once)
            multiply(omega_, i, std::min<std::size_t>(rows_at_once, n_ - i), static_cast<double>(z),
                     weight, products_.one(), &p[i]);
        p[0] = 0;  // left out: the origin adds the same to E for all vectors
        products_.keep_in_range();
        p[0] = 0;  // keep_in_range() may have added one()
    }

    [[nodiscard]] std::uint64_t next(std::span<const std::uint64_t> vector) {
        std::vector<double> error(n_ / 2 + 1, 0.0);
        for (const auto& part : parts_) {
            run_.check_stop();
            part->add(products_.all(), error);
        }
        for (std::uint64_t z = 0; z < error.size(); ++z)
            if (std::gcd(z, n_) != 1) error[z] = std::numeric_limits<double>::infinity();
        leave_out(vector, error);
        const double mean = products_.mean();
        const double margin = products_.rounding(kernel_norm_);
        return best_component(
            error.size(), [&](std::uint64_t z) { return error[z]; }, margin,
            [&](std::uint64_t z) { return error_by_sum(static_cast<double>(z), mean); },
            margin / 4);
    }

  private:
    [[nodiscard]] double error_by_sum(double z, double mean) const {
        run_.check_stop();
        std::vector<double> terms(rows_at_once);
        double sum = 0;
        for (std::uint64_t i = 0; i < n_; i += rows_at_once) {
            const std::size_t count = std::min<std::size_t>(rows_at_once, n_ - i);
            weigh(omega_, i, count, z, mean, &products_.all()[i], terms.data());
            sum += std::accumulate(terms.begin(),
                                   terms.begin() + static_cast<std::ptrdiff_t>(count), 0.0);
        }
        return sum;
    }

    const RunContext& run_;
    std::uint64_t n_;
    Omega omega_;
    double kernel_norm_ = 0;
    Products products_;
    std::vector<std::unique_ptr<Part>> parts_;
};

/// Sum over points first, ..., last - 1 of the product of all factors, minus 1.
DoubleDouble excess(std::uint64_t n, std::span<const std::uint64_t> vector,
                    std::span<const double> weights, std::uint64_t first, std::uint64_t last) {
    const Omega omega{static_cast<double>(n)};
    const DoubleDouble unit = quotient(pi_squared_third, {omega.n * omega.n, 0});
    return sum_of_excess(
        first, last, vector.size(), [&](std::size_t k, std::uint64_t i, auto high, auto low) {
            whole_terms(omega, i, high.size(), static_cast<double>(vector[k] % n),
                        unit * DoubleDouble{weights[k], 0}, high.data(), low.data());
        });
}

/// excess() of all points except the origin; points i and n - i have the same factors.
DoubleDouble excess_beyond_origin(std::uint64_t n, std::span<const std::uint64_t> vector,
                                  std::span<const double> weights) {
    const DoubleDouble half = excess(n, vector, weights, 1, (n + 1) / 2);
    const DoubleDouble both{2 * half.high, 2 * half.low};
    return n % 2 == 1 ? both : both + excess(n, vector, weights, n / 2, n / 2 + 1);
}

/// A multiplier with e^2 n, computed in doubles, and a bound on its rounding error.
struct Tried {
    std::uint64_t multiplier;
    double error;
    double rounding;
    std::optional<double> beyond_origin = {};  ///< in twice the precision, without point 0
};

class Multipliers {
  public:
    Multipliers(std::uint64_t n, std::span<const double> weights) : n_(n), weights_(weights) {}

    [[nodiscard]] Tried tried(std::uint64_t a) const {
        const auto vector = powers_modulo(a, weights_.size(), n_);
        const Omega omega{static_cast<double>(n_)};
        std::vector<double> p(rows_at_once);
        Tried result{.multiplier = a, .error = 0, .rounding = 0};
        for (std::uint64_t i = 0; i < n_; i += rows_at_once) {
            const std::size_t count = std::min<std::size_t>(rows_at_once, n_ - i);
            std::fill_n(p.begin(), count, 1.0);
            for (std::size_t k = 0; k < vector.size(); ++k)
                multiply(omega, i, count, static_cast<double>(vector[k]), weights_[k], 0, p.data());
            double part = 0;
            for (std::size_t j = 0; j < count; ++j) {
                part += p[j] - 1;
                result.rounding += std::abs(p[j]);
            }
            result.error += part;
        }
        result.rounding *= 1e-15 * static_cast<double>(10 + vector.size());
        return result;
    }

    /// If rounding hides the difference, compares sums without the origin in twice the precision.
    bool is_better(Tried& one, Tried& other) const {
        if (std::abs(one.error - other.error) > std::max(one.rounding, other.rounding))
            return one.error < other.error;
        const double a = beyond_origin(one);
        const double b = beyond_origin(other);
        return std::abs(a - b) > 1e-12 * std::abs(b) ? a < b : one.error < other.error;
    }

  private:
    double beyond_origin(Tried& one) const {
        if (!one.beyond_origin) {
            const auto vector = powers_modulo(one.multiplier, weights_.size(), n_);
            const double sum = excess_beyond_origin(n_, vector, weights_).high;
            one.beyond_origin = std::isfinite(sum) ? sum : std::numeric_limits<double>::max();
        }
        return *one.beyond_origin;
    }

    std::uint64_t n_;
    std::span<const double> weights_;
};

}  // namespace

double squared_lattice_error(std::uint64_t n, std::span<const std::uint64_t> vector,
                             std::span<const double> weights) {
    const DoubleDouble sum =
        excess(n, vector, weights, 0, 1) + excess_beyond_origin(n, vector, weights);
    const double error = quotient(sum, {static_cast<double>(n), 0}).high;
    return std::isfinite(error) ? error : std::numeric_limits<double>::infinity();
}

std::vector<std::uint64_t> component_by_component(std::uint64_t n, std::span<const double> weights,
                                                  const RunContext& run) {
    if (n < 4 || weights.size() == 1) return std::vector<std::uint64_t>(weights.size(), 1);
    run.need_memory(60 * static_cast<double>(n), "the search for a vector");
    return grow_vector(Construction(n, run), weights, run);
}

std::vector<std::uint64_t> powers_modulo(std::uint64_t a, std::size_t count, std::uint64_t n) {
    std::vector<std::uint64_t> powers{1 % n};
    while (powers.size() < count)
        powers.push_back(static_cast<std::uint64_t>(Wide{powers.back()} * (a % n) % n));
    return powers;
}

std::uint64_t korobov_multiplier(std::uint64_t n, std::span<const double> weights,
                                 std::uint64_t tries, const RunContext& run) {
    const std::uint64_t range = korobov_range(n);
    tries = std::min(tries, range);
    const Multipliers multipliers(n, weights);
    std::optional<Tried> best;
    for (std::uint64_t t = 0; t < tries; ++t) {
        search_tick(run, t, tries);
        // Tries all multipliers if `tries` is enough for them; otherwise multiples of the golden
        // ratio modulo 1, scaled to the range, because these are spread evenly.
        const std::uint64_t turn = t * 0x9E3779B97F4A7C15;
        std::uint64_t a =
            1 + (tries == range ? t : static_cast<std::uint64_t>(Wide{turn} * range >> 64));
        while (tries != range && std::gcd(a, n) != 1) ++a;
        if (std::gcd(a, n) != 1) continue;
        Tried tried = multipliers.tried(a);
        if (!best || multipliers.is_better(tried, *best)) best = tried;
    }
    return best ? best->multiplier : 1;
}

}  // namespace stipple
