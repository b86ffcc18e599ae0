// SPDX-License-Identifier: MIT
//
// Points of a torus that descend the energy of Gaussian kernels,
//
//     E = sum over pairs i < j of  exp(-|x_i - x_j|^2 / 2),     lengths in units of (V / n)^(1/d),
//
// where V is the volume of the torus, and the sum has all images of each pair nearer than 6 units.
// A step moves every point by s F + b (last step), F = sum_j (x_i - x_j) exp(-|x_i - x_j|^2 / 2);
// s = (2 pi)^(1 - d/2) / 4, for which the stiffest mode of an even set moves 1.16 times the
// distance to its equilibrium. b is Nesterov's 1 - 3 / (k + 2), restarted at k = 1 whenever the
// step is against the force. So the soft modes, whose wavelengths are near the distance of
// neighbours, take about a hundred steps, instead of ten thousand.
//
// Shape   d = 1 ... 4; sides of any proportions up to largest_proportion. If a side is shorter than
//         a unit, points are repelled most by their own images, and stay irregular.
// Cost    a step: O(n (14^d)), 1 microsecond a point and core in 2-D, 14 in 3-D; beyond 2-D, while
//         no side is longer than 6 units (216 points in 3-D, 1296 in 4-D), O(n^2 d).
// Promise the same bits on every machine and for any number of threads.
// Source  A. G. M. Ahmed, J. Ren, P. Wonka, "Gaussian blue noise", ACM Trans. Graph. 41(6), 260
//         (2022), doi:10.1145/3550454.3555519: the energy and the plain step.

#include "generators/blue_noise/relaxation/relaxation.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/machine/first_touch.hpp"
#include "core/machine/wide.hpp"
#include "core/parallel.hpp"
#include "core/rng.hpp"
#include "math/functions/exponential.hpp"

namespace stipple {
namespace {

constexpr double kernel_reach = 6;  // distance at which kernels are cut off; exp(-6^2 / 2) = 1.5e-8
constexpr double cell_side = 1.75;  // approximate side of a cell; the fastest of those measured
constexpr double nowhere = 1e6;

/// count^(1/dimension) by Newton's method, from above.
double side_length(double count, std::size_t dimension) {
    const auto d = static_cast<double>(dimension);
    double side = count;
    for (int i = 0; i < 2000; ++i) {
        double power = 1;
        for (std::size_t k = 1; k < dimension; ++k) power *= side;
        const double next = ((d - 1) * side + count / power) / d;
        if (!(next < side)) break;
        side = next;
    }
    return side;
}

using Sides = std::array<double, relaxation_dimensions>;

/// Sides of the torus of volume `count`: proportional to `extents`, or equal if that is empty.
Sides sides_of(std::size_t count, std::size_t dimension, std::span<const double> extents) {
    Sides sides{};
    sides.fill(side_length(static_cast<double>(count), dimension));
    if (extents.empty()) return sides;
    const double shortest = std::ranges::min(extents);
    double volume = 1;
    for (const double extent : extents) volume *= extent / shortest;
    const double mean = side_length(volume, dimension);
    for (std::size_t k = 0; k < dimension; ++k) sides[k] *= extents[k] / shortest / mean;
    return sides;
}

/// Coordinates of the points that may be near a cell's points, padded with far ones.
struct Candidates {
    std::array<std::vector<double>, relaxation_dimensions> places = {};
    std::vector<double> weights = {};

    [[nodiscard]] std::size_t size() const { return places[0].size(); }
};

/// Adds (x - places[j])^2 to weights[j], for every j.
STIPPLE_WIDE void add_squares(const double* places, double x, double* weights, std::size_t count) {
    for (std::size_t j = 0; j < count; ++j) {
        const double t = places[j] - x;
        weights[j] += t * t;
    }
}

/// Replaces squared distances by values of the kernel.
STIPPLE_WIDE void to_kernels(double* weights, std::size_t count) {
    for (std::size_t j = 0; j < count; ++j) {
        const double kernel = exponential(-0.5 * weights[j]);
        weights[j] = weights[j] < kernel_reach * kernel_reach ? kernel : 0;
    }
}

/// Returns the sum over j of (x - places[j]) weights[j].
STIPPLE_WIDE double pull(const double* places, double x, const double* weights, std::size_t count) {
    double parts[sum_lanes] = {};
    for (std::size_t j = 0; j < count; j += sum_lanes)
        for (std::size_t l = 0; l < sum_lanes; ++l)
            parts[l] += (x - places[j + l]) * weights[j + l];
    return sum_of_lanes(parts);
}

/// Adds the kernels of all images of `places` along one axis, and the kernels times the distances.
STIPPLE_WIDE void add_images(const double* places, double x, double side, int images,
                             std::size_t count, double* kernels, double* pulls) {
    for (int image = -images; image <= images; ++image)
        for (std::size_t j = 0; j < count; ++j) {
            const double t = x - (places[j] + image * side);
            const double kernel = exponential(-0.5 * (t * t));
            kernels[j] += kernel;
            pulls[j] += t * kernel;
        }
}

using Factors = std::array<const double*, relaxation_dimensions>;

/// Returns the sum over j of the product of the j-th factors of all axes.
STIPPLE_WIDE double sum_of_products(const Factors& factors, std::size_t dimension,
                                    std::size_t count) {
    double parts[sum_lanes] = {};
    for (std::size_t j = 0; j < count; j += sum_lanes)
        for (std::size_t l = 0; l < sum_lanes; ++l) {
            double product = factors[0][j + l];
            for (std::size_t k = 1; k < dimension; ++k) product *= factors[k][j + l];
            parts[l] += product;
        }
    return sum_of_lanes(parts);
}

/// `x` shifted into [0, side) by a multiple of `side`; fastest if one side is enough.
double wrapped(double x, double side) {
    if (x < 0) x += side;
    if (x >= side) x -= side;
    if (x >= 0 && x < side) return x;
    x -= side * std::floor(x / side);
    return x >= 0 && x < side ? x : 0;
}

/// For one point and every other: sums over the other's images on each axis; padded with zeros.
struct AxisSums {
    std::array<std::vector<double>, relaxation_dimensions> kernels = {};
    std::array<std::vector<double>, relaxation_dimensions> pulls = {};

    void clear(std::size_t dimension, std::size_t count) {
        for (std::size_t k = 0; k < dimension; ++k) {
            kernels[k].assign(count, 0);
            pulls[k].assign(count, 0);
        }
    }
};

/// Buffers of one thread.
struct Workspace {
    Candidates near;
    AxisSums sums;
};

/// Points of a torus, sorted into cells.
class Kernels {
  public:
    Kernels(std::span<const double> rows, std::size_t dimension, std::span<const double> extents)
        : d_(dimension),
          n_(rows.size() / dimension),
          sides_(sides_of(n_, dimension, extents)),
          places_(rows.begin(), rows.end()),
          by_axes_(dimension > 2),
          cell_of_(n_),
          sorted_(n_) {
        std::size_t cells = 1;
        for (std::size_t k = 0; k < d_; ++k) {
            along_[k] = std::max<std::size_t>(1, static_cast<std::size_t>(sides_[k] / cell_side));
            widths_[k] = sides_[k] / static_cast<double>(along_[k]);
            cells *= along_[k];
            by_axes_ = by_axes_ && sides_[k] <= kernel_reach;
        }
        for (std::size_t i = 0; i < places_.size(); ++i) places_[i] *= sides_[i % d_];
        starts_.resize(cells + 1);
    }

    [[nodiscard]] const Sides& sides() const { return sides_; }
    [[nodiscard]] std::span<double> places() { return places_; }
    [[nodiscard]] std::size_t cells() const { return starts_.size() - 1; }

    void sort(const RunContext& run) {
        constexpr std::size_t often = 65536;
        std::ranges::fill(starts_, 0U);
        for (std::size_t i = 0; i < n_; ++i) {
            if (i % often == 0) run.check_stop();
            std::size_t cell = 0;
            for (std::size_t k = d_; k-- > 0;) {
                const auto c = static_cast<std::size_t>(places_[i * d_ + k] / widths_[k]);
                cell = cell * along_[k] + std::min(c, along_[k] - 1);
            }
            cell_of_[i] = static_cast<std::uint32_t>(cell);
            ++starts_[cell + 1];
        }
        for (std::size_t c = 0; c < cells(); ++c) starts_[c + 1] += starts_[c];
        std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
        for (std::size_t i = 0; i < n_; ++i) {
            if (i % often == 0) run.check_stop();
            sorted_[next[cell_of_[i]]++] = static_cast<std::uint32_t>(i);
        }
        for (std::size_t k = 0; k < d_; ++k) {
            by_cell_[k].resize(n_);
            for (std::size_t s = 0; s < n_; ++s) {
                if (s % often == 0) run.check_stop();
                by_cell_[k][s] = places_[sorted_[s] * d_ + k];
            }
        }
    }

    void forces_in(std::size_t cell, Workspace& work, std::span<double> forces) const {
        if (starts_[cell] == starts_[cell + 1]) return;
        if (by_axes_) return forces_by_axes(cell, work.sums, forces);
        Candidates& near = work.near;
        gather(cell, near);
        const std::size_t count = near.size();
        for (std::uint32_t s = starts_[cell]; s < starts_[cell + 1]; ++s) {
            std::fill_n(near.weights.data(), count, 0.0);
            for (std::size_t k = 0; k < d_; ++k)
                add_squares(near.places[k].data(), by_cell_[k][s], near.weights.data(), count);
            to_kernels(near.weights.data(), count);
            for (std::size_t k = 0; k < d_; ++k)
                forces[sorted_[s] * d_ + k] =
                    pull(near.places[k].data(), by_cell_[k][s], near.weights.data(), count);
        }
    }

  private:
    using Offsets = std::array<std::int64_t, relaxation_dimensions>;

    /// forces_in() on a small torus with many images: the kernel of two points, summed over all
    /// images, is the product of the sums along each axis.
    void forces_by_axes(std::size_t cell, AxisSums& sums, std::span<double> forces) const {
        const std::size_t count = (n_ + sum_lanes - 1) / sum_lanes * sum_lanes;
        for (std::uint32_t s = starts_[cell]; s < starts_[cell + 1]; ++s) {
            sums.clear(d_, count);
            Factors factors{};
            for (std::size_t k = 0; k < d_; ++k) {
                const int images = static_cast<int>(std::ceil(kernel_reach / sides_[k]));
                add_images(by_cell_[k].data(), by_cell_[k][s], sides_[k], images, n_,
                           sums.kernels[k].data(), sums.pulls[k].data());
                factors[k] = sums.kernels[k].data();
            }
            for (std::size_t k = 0; k < d_; ++k) {
                Factors pulled = factors;
                pulled[k] = sums.pulls[k].data();
                forces[sorted_[s] * d_ + k] = sum_of_products(pulled, d_, count);
            }
        }
    }

    /// Collects the points of all cells within reach of this one, including images.
    void gather(std::size_t cell, Candidates& near) const {
        for (auto& places : near.places) places.clear();
        Offsets center{};
        Offsets most{};
        Offsets offset{};
        for (std::size_t k = 0; k < d_; ++k) {
            center[k] = static_cast<std::int64_t>(cell % along_[k]);
            cell /= along_[k];
            most[k] = static_cast<std::int64_t>(kernel_reach / widths_[k]) + 1;
            offset[k] = -most[k];
        }
        for (;;) {
            add_row(center, offset, most[0], near);
            std::size_t k = 1;
            for (; k < d_ && offset[k] == most[k]; ++k) offset[k] = -most[k];
            if (k >= d_) break;
            ++offset[k];
        }
        while (near.size() % sum_lanes != 0)
            for (std::size_t k = 0; k < d_; ++k) near.places[k].push_back(nowhere);
        if (near.weights.size() < near.size()) near.weights.resize(near.size());
    }

    /// Adds the points of a row of cells along axis 0 that has the given offsets on the other axes.
    void add_row(const Offsets& center, const Offsets& offset, std::int64_t most,
                 Candidates& near) const {
        double left = kernel_reach * kernel_reach;
        std::size_t base = 0;
        std::array<double, relaxation_dimensions> shift{};
        for (std::size_t k = d_; k-- > 1;) {
            const auto between = std::max<std::int64_t>(0, std::abs(offset[k]) - 1);
            const double gap = widths_[k] * static_cast<double>(between);
            left -= gap * gap;
            const std::int64_t at = center[k] + offset[k];
            const std::int64_t turns = floor_quotient(at, period(k));
            shift[k] = sides_[k] * static_cast<double>(turns);
            base = (base + static_cast<std::size_t>(at - turns * period(k))) * along_[k - 1];
        }
        if (left <= 0) return;
        const double width = widths_[0];
        while (most > 1 && static_cast<double>((most - 1) * (most - 1)) * width * width >= left)
            --most;
        for (std::int64_t at = center[0] - most; at <= center[0] + most;) {
            const std::int64_t turns = floor_quotient(at, period(0));
            const std::int64_t first = at - turns * period(0);
            const std::int64_t run = std::min(center[0] + most - at + 1, period(0) - first);
            shift[0] = sides_[0] * static_cast<double>(turns);
            const std::size_t begin = base + static_cast<std::size_t>(first);
            for (std::size_t k = 0; k < d_; ++k)
                for (std::uint32_t s = starts_[begin];
                     s < starts_[begin + static_cast<std::size_t>(run)]; ++s)
                    near.places[k].push_back(by_cell_[k][s] + shift[k]);
            at += run;
        }
    }

    static std::int64_t floor_quotient(std::int64_t a, std::int64_t b) {
        return a >= 0 ? a / b : -((b - 1 - a) / b);
    }

    [[nodiscard]] std::int64_t period(std::size_t k) const {
        return static_cast<std::int64_t>(along_[k]);
    }

    std::size_t d_;
    std::size_t n_;
    Sides sides_;
    std::array<std::size_t, relaxation_dimensions> along_{};  ///< cells along each side
    Sides widths_{};                                          ///< sides of a cell
    std::vector<double> places_;
    bool by_axes_;  ///< whether sums over images are taken axis by axis
    std::array<std::vector<double>, relaxation_dimensions> by_cell_;  ///< coordinates by cell
    std::vector<std::uint32_t> cell_of_;
    std::vector<std::uint32_t> sorted_;
    std::vector<std::uint32_t> starts_;
};

void all_forces(Kernels& kernels, std::span<double> forces, const RunContext& run) {
    kernels.sort(run);
    constexpr std::uint64_t size = 64;  // cells in a block
    for_each_block(silent(run), kernels.cells(), size, [&](const Block& block) {
        Workspace work;
        for (std::uint64_t c = block.first; c < block.last; ++c) kernels.forces_in(c, work, forces);
    });
}

/// Run context for one step: with one thread if the step is short.
RunContext for_step(const RunContext& run, std::size_t count, std::size_t dimension) {
    constexpr double seconds[] = {1e-7, 5e-7, 1e-5, 1e-4};
    return worth_threads(run, static_cast<double>(count) * seconds[dimension - 1]);
}

}  // namespace

std::span<double> Descent::step(std::span<const double> forces, double length) {
    double along = 0;
    for (std::size_t i = 0; i < ways_.size(); ++i) along += forces[i] * ways_[i];
    k_ = along < 0 ? 1 : k_ + 1;
    const double kept = k_ > 1 ? 1 - 3 / (k_ + 2) : 0;
    for (std::size_t i = 0; i < ways_.size(); ++i) ways_[i] = length * forces[i] + kept * ways_[i];
    return ways_;
}

double relaxation_bytes(std::uint64_t count, std::size_t dimension) {
    return static_cast<double>(count) * static_cast<double>(40 * dimension + 12);
}

void relax_gaussian(std::span<double> rows, std::size_t dimension, std::uint64_t steps,
                    const RunContext& run, std::span<const double> extents) {
    const std::size_t n = rows.size() / dimension;
    const RunContext part = for_step(run, n, dimension);
    Kernels kernels(rows, dimension, extents);
    constexpr double stable[] = {0.6266570686577501, 0.25, 0.09973557010035818,
                                 0.039788735772973836};
    const double length = stable[dimension - 1];
    const std::span<double> places = kernels.places();
    std::vector<double> forces;
    grow(forces, rows.size(), run);
    Descent descent(rows.size());
    for (std::uint64_t step = 0; step < steps; ++step) {
        run.tick(step, steps);
        all_forces(kernels, forces, part);
        const auto ways = descent.step(forces, length);
        for (std::size_t i = 0; i < ways.size(); ++i)
            places[i] = wrapped(places[i] + ways[i], kernels.sides()[i % dimension]);
    }
    for (std::size_t i = 0; i < rows.size(); ++i)
        rows[i] = std::min(places[i] / kernels.sides()[i % dimension], one_minus_ulp);
    run.tick(1, 1);
}

}  // namespace stipple
