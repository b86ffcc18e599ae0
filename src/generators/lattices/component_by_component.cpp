// SPDX-License-Identifier: MIT
//
// Fast component-by-component construction. With p_i, the product of the components so far, the
// next component z has the least
//
//     E(z) = sum_i p_i omega(i z / n).
//
// The i that have gcd(i, n) = n / e are n / e times the units modulo e, a group: a product of
// cyclic ones. There, with i and z written as powers of its generators, the sum is a correlation,
// which a Fourier transform of several dimensions gives for all z at once (Rader's permutation,
// divisor by divisor).
//
// Cost     O(d n log n + d n t) for n with t divisors; 60 n bytes.
// Promise  the same vector on every machine. Transforms round differently on different machines,
//          so they only nominate: all components nearer to the best than rounding may bring them
//          are compared by plain sums in a fixed order, of which the first equal to the least
//          counts. The products lose a common power of two when they grow, so they do not overflow
//          in high dimensions, and their mean over each group, which cannot change the choice.
// Source   D. Nuyens, R. Cools, Math. Comp. 75 (2006) 903-920, doi:10.1090/S0025-5718-06-01785-6
//          (n prime); J. Complexity 22 (2006) 4-28, doi:10.1016/j.jco.2005.07.002 (any n).
#include "generators/lattices/component_by_component.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "core/error.hpp"
#include "core/wide.hpp"
#include "generators/lattices/search_progress.hpp"
#include "math/fourier/fftw.hpp"
#include "math/functions/ratio.hpp"

namespace stipple {
namespace {

constexpr double two_pi_squared = 2 * std::numbers::pi * std::numbers::pi;
constexpr std::size_t block = 1024;

/// omega(i z / n) of consecutive i, whole numbers up to 2^24; the same bits for i and n - i.
struct Omega {
    double n;
    double inverse = 1 / n;
    double scale = two_pi_squared / (n * n);

    [[nodiscard]] double operator()(double i, double z) const {
        const double product = i * z;
        double r = product - std::floor(product * inverse) * n;
        r = r < 0 ? r + n : r;
        r = r >= n ? r - n : r;
        return two_pi_squared / 6 - scale * (r * (n - r));
    }
};

/// p[j] *= 1 + weight omega((first + j) z / n).
STIPPLE_WIDE void multiply(const Omega& omega, std::uint64_t first, std::size_t count, double z,
                           double weight, double* p) {
    const auto begin = static_cast<double>(first);
    for (std::size_t j = 0; j < count; ++j) {
        const double i = begin + static_cast<double>(static_cast<std::int32_t>(j));
        p[j] *= 1 + weight * omega(i, z);
    }
}

/// terms[j] = (p[j] - mean) omega((first + j) z / n).
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
    for (std::uint64_t prime = 2; n > 1; ++prime) {
        if (prime * prime > n) prime = n;
        if (n % prime != 0) continue;
        found.push_back({prime, 1});
        for (; n % prime == 0; n /= prime) found.back().power *= prime;
    }
    return found;
}

/// A generator of a cyclic group of units, and the number of its powers.
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

/// The cyclic groups whose product the units modulo a prime power are.
std::vector<Cycle> cycles_of(const PrimePower& q) {
    if (q.power == 2) return {};
    if (q.power == 4) return {{3, 2}};
    if (q.prime == 2) return {{q.power - 1, 2}, {5, q.power / 4}};
    const std::uint64_t order = q.power / q.prime * (q.prime - 1);
    return {{primitive_root(q, order), order}};
}

/// The units modulo e, in the order of the exponents of their generators, the last one fastest.
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

    /// Complex numbers of a real function's spectrum.
    [[nodiscard]] std::size_t halves() const {
        const auto last = static_cast<std::size_t>(shape.back());
        return elements.size() / last * (last / 2 + 1);
    }

  private:
    /// The number that is g modulo q, and 1 modulo the rest of the modulus.
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

/// The part of E that comes from the i with gcd(i, n) = n / e.
class Correlation {
  public:
    Correlation(std::uint64_t n, std::uint64_t e)
        : units_(e),
          step_(n / e),
          halves_(units_.halves()),
          line_(fftw_reals(units_.elements.size())),
          spectrum_(fftw_reals(2 * halves_)),
          kernel_(fftw_reals(2 * halves_)) {
        const int rank = static_cast<int>(units_.shape.size());
        {
            const std::lock_guard lock(fftw_planner());
            forward_ = fftw_plan_dft_r2c(rank, units_.shape.data(), line_.get(),
                                         as_fftw(spectrum_.get()), FFTW_ESTIMATE);
            backward_ = fftw_plan_dft_c2r(rank, units_.shape.data(), as_fftw(spectrum_.get()),
                                          line_.get(), FFTW_ESTIMATE);
        }
        if (forward_ == nullptr || backward_ == nullptr) throw std::bad_alloc();
        const Omega omega{static_cast<double>(e)};
        for (std::size_t a = 0; a < units_.elements.size(); ++a)
            line_[a] = omega(units_.elements[a], 1) / static_cast<double>(units_.elements.size());
        fftw_execute(forward_);
        std::copy_n(spectrum_.get(), 2 * halves_, kernel_.get());
    }
    Correlation(const Correlation&) = delete;
    Correlation& operator=(const Correlation&) = delete;
    ~Correlation() {
        const std::lock_guard lock(fftw_planner());
        fftw_destroy_plan(forward_);
        fftw_destroy_plan(backward_);
    }

    /// Adds to total[z], z = 0, 1, ..., this part of E(z), up to a constant; z prime to n.
    void add(const std::vector<double>& p, std::vector<double>& total) {
        gather(p);
        fftw_execute(forward_);
        for (std::size_t k = 0; k < halves_; ++k) {  // times the conjugate
            const double re = spectrum_[2 * k];
            const double im = spectrum_[2 * k + 1];
            const double kernel_re = kernel_[2 * k];
            const double kernel_im = kernel_[2 * k + 1];
            spectrum_[2 * k] = re * kernel_re + im * kernel_im;
            spectrum_[2 * k + 1] = re * kernel_im - im * kernel_re;
        }
        fftw_execute(backward_);
        std::vector<double> residues(units_.modulus);
        for (std::size_t a = 0; a < units_.elements.size(); ++a)
            residues[units_.elements[a]] = line_[a];
        for (std::size_t z = 0; z < total.size(); z += units_.modulus) {
            const std::size_t count = std::min<std::size_t>(units_.modulus, total.size() - z);
            for (std::size_t j = 0; j < count; ++j) total[z + j] += residues[j];
        }
    }

  private:
    void gather(const std::vector<double>& p) {
        double sum = 0;
        for (std::size_t a = 0; a < units_.elements.size(); ++a) {
            line_[a] = p[units_.elements[a] * step_];
            sum += line_[a];
        }
        const double mean = sum / static_cast<double>(units_.elements.size());
        for (std::size_t a = 0; a < units_.elements.size(); ++a) line_[a] -= mean;
    }

    Units units_;
    std::uint64_t step_;
    std::size_t halves_;
    FftwReals line_;
    FftwReals spectrum_;
    FftwReals kernel_;
    fftw_plan forward_ = nullptr;
    fftw_plan backward_ = nullptr;
};

/// The products p_i and the choice of the next component.
class Construction {
  public:
    Construction(std::uint64_t n, const RunContext& run)
        : run_(run), n_(n), omega_{static_cast<double>(n)}, p_(n, 1.0) {
        for (std::uint64_t e = 2; e <= n; ++e) {
            if (n % e != 0) continue;
            run_.check_stop();
            parts_.push_back(std::make_unique<Correlation>(n, e));
        }
        for (std::uint64_t i = 1; i < n; ++i) {
            const double w = omega_(static_cast<double>(i), 1);
            kernel_square_ += w * w;
        }
    }

    void multiply_by(std::uint64_t z, double weight) {
        double largest = 0;
        for (std::uint64_t i = 0; i < n_; i += block) {
            const std::size_t count = std::min<std::size_t>(block, n_ - i);
            multiply(omega_, i, count, static_cast<double>(z), weight, &p_[i]);
            for (std::size_t j = i == 0 ? 1 : 0; j < count; ++j)
                largest = std::max(largest, std::abs(p_[i + j]));
        }
        p_[0] = 0;  // the origin is in every lattice
        const int exponent = std::ilogb(largest);
        if (largest == 0 || std::abs(exponent) < 64) return;
        for (double& p : p_) p = std::ldexp(p, -exponent);
    }

    [[nodiscard]] std::uint64_t next() {
        std::vector<double> error(n_ / 2 + 1, 0.0);
        for (const auto& part : parts_) {
            run_.check_stop();
            part->add(p_, error);
        }
        double least = std::numeric_limits<double>::infinity();
        for (std::uint64_t z = 1; z < error.size(); ++z)
            if (std::gcd(z, n_) == 1) least = std::min(least, error[z]);
        const double mean = std::accumulate(p_.begin(), p_.end(), 0.0) / static_cast<double>(n_);
        const double margin = rounding(mean);
        std::vector<std::uint64_t> nominees;
        for (std::uint64_t z = 1; z < error.size() && nominees.size() < most_nominees; ++z)
            if (error[z] <= least + margin && std::gcd(z, n_) == 1) nominees.push_back(z);
        return nominees.size() == 1 ? nominees.front() : first_of_best(nominees, mean, margin / 4);
    }

  private:
    static constexpr std::size_t most_nominees = 64;

    /// More than transforms and sums are wrong by: they round relatively to the norms.
    [[nodiscard]] double rounding(double mean) const {
        double square = 0;
        for (const double p : p_) square += (p - mean) * (p - mean);
        return 1e-13 * std::sqrt(square * kernel_square_);
    }

    [[nodiscard]] std::uint64_t first_of_best(const std::vector<std::uint64_t>& nominees,
                                              double mean, double margin) const {
        std::vector<double> errors;
        for (const std::uint64_t z : nominees) {
            run_.check_stop();
            errors.push_back(error_by_sum(static_cast<double>(z), mean));
        }
        const double least = std::ranges::min(errors);
        const auto first =
            std::ranges::find_if(errors, [&](double error) { return error <= least + margin; });
        return nominees[static_cast<std::size_t>(first - errors.begin())];
    }

    [[nodiscard]] double error_by_sum(double z, double mean) const {
        std::vector<double> terms(block);
        double sum = 0;
        for (std::uint64_t i = 0; i < n_; i += block) {
            const std::size_t count = std::min<std::size_t>(block, n_ - i);
            weigh(omega_, i, count, z, mean, &p_[i], terms.data());
            sum += std::accumulate(terms.begin(),
                                   terms.begin() + static_cast<std::ptrdiff_t>(count), 0.0);
        }
        return sum;
    }

    const RunContext& run_;
    std::uint64_t n_;
    Omega omega_;
    double kernel_square_ = 0;
    std::vector<double> p_;
    std::vector<std::unique_ptr<Correlation>> parts_;
};

}  // namespace

double squared_lattice_error(std::uint64_t n, std::span<const std::uint64_t> vector,
                             std::span<const double> weights) {
    const Omega omega{static_cast<double>(n)};
    std::vector<double> p(block);
    double sum = 0;
    for (std::uint64_t i = 0; i < n; i += block) {
        const std::size_t count = std::min<std::size_t>(block, n - i);
        std::fill_n(p.begin(), count, 1.0);
        for (std::size_t k = 0; k < vector.size(); ++k)
            multiply(omega, i, count, static_cast<double>(vector[k] % n), weights[k], p.data());
        double part = 0;
        for (std::size_t j = 0; j < count; ++j) part += p[j] - 1;
        sum += part;
    }
    const double error = sum / static_cast<double>(n);
    return std::isfinite(error) ? error : std::numeric_limits<double>::infinity();
}

std::vector<std::uint64_t> component_by_component(std::uint64_t n, std::span<const double> weights,
                                                  const RunContext& run) {
    std::vector<std::uint64_t> vector{1};
    if (n < 4 || weights.size() == 1) return std::vector<std::uint64_t>(weights.size(), 1);
    run.need_memory(60 * static_cast<double>(n), "the search for a vector");
    Construction construction(n, run);
    for (std::size_t k = 1; k < weights.size(); ++k) {
        search_tick(run, k, weights.size());
        construction.multiply_by(vector.back(), weights[k - 1]);
        vector.push_back(construction.next());
    }
    return vector;
}

std::vector<std::uint64_t> powers_modulo(std::uint64_t a, std::size_t count, std::uint64_t n) {
    std::vector<std::uint64_t> powers{1 % n};
    while (powers.size() < count)
        powers.push_back(static_cast<std::uint64_t>(Wide{powers.back()} * (a % n) % n));
    return powers;
}

std::uint64_t korobov_multiplier(std::uint64_t n, std::span<const double> weights,
                                 const RunContext& run) {
    const std::uint64_t most = korobov_work / (n * weights.size());
    if (most < 8)
        fail(ErrorKind::usage,
             "--rule: korobov's search takes at most {} coordinates of points; {} points of "
             "dimension {} are more. Give its --multiplier",
             korobov_work / 8, n, weights.size());
    const std::uint64_t range = std::max<std::uint64_t>(n / 2, 1);
    const std::uint64_t tries = std::min(most, range);
    std::uint64_t best = 1;
    double least = std::numeric_limits<double>::infinity();
    for (std::uint64_t t = 0; t < tries; ++t) {
        search_tick(run, t, tries);
        // Multiples of the golden ratio spread over the range; every number, where there is time.
        const std::uint64_t turn = t * 0x9E3779B97F4A7C15;
        std::uint64_t a =
            1 + (tries == range ? t : static_cast<std::uint64_t>(Wide{turn} * range >> 64));
        while (tries != range && std::gcd(a, n) != 1) ++a;
        if (std::gcd(a, n) != 1) continue;
        const double error = squared_lattice_error(n, powers_modulo(a, weights.size(), n), weights);
        if (error < least) {
            least = error;
            best = a;
        }
    }
    return best;
}

}  // namespace stipple
