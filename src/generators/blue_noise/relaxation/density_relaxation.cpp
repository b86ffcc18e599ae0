// SPDX-License-Identifier: MIT
//
// Moves points of a torus to follow a density, by Gaussian kernels as wide as the local spacing of
// points. With lengths in units of (area / n)^(1/2), n points and a density rho of mean 1,
//
//     f(x) = sum_i K_i(x) - integral rho(y) K_y(x) dy,    K_y(x) = exp(-|x - y|^2 / sigma(y)^2),
//
// is 0 where points and density agree; sigma, near rho^(-1/2), is the local spacing. Points move
// down the gradient of f, smoothed by their own kernel, as in gaussian_relaxation.cpp:
//
//     F_i = sum_j m_j 4 a b / (a + b)^2 (x_i - x_j) exp(-|x_i - x_j|^2 / (a + b)),
//     a = sigma_i^2,  b = sigma_j^2,
//
// over the points (m = 1) and over the leaves of a quadtree that represents the density
// (m = -mass): rectangles that hold at most half a point. sigma^2 is half the area of the square
// about x that holds two points. So rho is smoothed until it varies little over a kernel; otherwise
// the force would not be the gradient of an energy, and points would drift. For a constant density
// this is the force of gaussian_relaxation.cpp.
//
// Shape   2-D; a density of any contrast; the same proportions of sides as in gaussian_relaxation.
// Cost    a step: about 10 times that of relax_gaussian, more if the contrast is high.
// Promise the same bits on every machine and for any number of threads; no point moves to
//         where the density is 0.
// Source  after A. G. M. Ahmed, J. Ren, P. Wonka, "Gaussian blue noise", ACM Trans. Graph. 41(6),
//         260 (2022), doi:10.1145/3550454.3555519, whose kernels adapt to a density, too. The
//         leaves and the force between kernels of different widths are ours.

#include "generators/blue_noise/relaxation/relaxation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/machine/wide.hpp"
#include "core/parallel.hpp"
#include "core/rng.hpp"
#include "math/functions/exponential.hpp"

namespace stipple {
namespace {

constexpr double reach = 5;        // kernel radius in standard deviations; exp(-12.5) = 3.7e-6
constexpr double leaf_mass = 0.5;  // largest mass of a quadtree's leaf, in points
constexpr double window_mass = 2;  // mass of the square that sets sigma, in points
constexpr int deepest = 24;        // largest level of the quadtree

using PlaneSides = std::array<double, 2>;

/// Sides of the torus of area `count`: proportional to `extents`, or equal if that is empty.
PlaneSides sides_of(std::size_t count, std::span<const double> extents) {
    const double side = std::sqrt(static_cast<double>(count));
    if (extents.empty()) return {side, side};
    const double stretch = std::sqrt(extents[0] / extents[1]);
    return {side * stretch, side / stretch};
}

/// Source of a force: another point, or the density in a leaf.
struct Body {
    double x;
    double y;
    double square;  ///< sigma^2
    double mass;
};

/// Bodies, with one array for each of their members.
struct Bodies {
    std::vector<double> x, y, squares, masses;

    explicit Bodies(std::size_t count = 0) { resize(count); }

    void resize(std::size_t count) {
        for (auto* numbers : {&x, &y, &squares, &masses}) numbers->resize(count);
    }
    void put(std::size_t at, const Body& body) {
        x[at] = body.x;
        y[at] = body.y;
        squares[at] = body.square;
        masses[at] = body.mass;
    }
};

/// Bodies near a point, including periodic images.
struct NearBodies {
    std::size_t count = 0;
    Bodies bodies = Bodies(0);

    void take(const Bodies& from, std::size_t first, std::size_t size, double across, double up) {
        if (bodies.x.size() < count + size + sum_lanes)
            bodies.resize(2 * (count + size + sum_lanes));
        for (std::size_t i = 0; i < size; ++i) {
            bodies.x[count + i] = from.x[first + i] + across;
            bodies.y[count + i] = from.y[first + i] + up;
            bodies.squares[count + i] = from.squares[first + i];
            bodies.masses[count + i] = from.masses[first + i];
        }
        count += size;
    }

    /// Adds bodies of mass 0 up to a multiple of sum_lanes.
    void pad() {
        for (; count % sum_lanes != 0; ++count) bodies.put(count, {0, 0, 1, 0});
    }
};

/// Force on a body at (x, y) with sigma^2 = a.
STIPPLE_WIDE std::array<double, 2> force_at(double x, double y, double a, const NearBodies& near) {
    const double* xs = near.bodies.x.data();
    const double* ys = near.bodies.y.data();
    const double* squares = near.bodies.squares.data();
    const double* masses = near.bodies.masses.data();
    double fx[sum_lanes] = {};
    double fy[sum_lanes] = {};
    for (std::size_t j = 0; j < near.count; j += sum_lanes) {
        double weights[sum_lanes];
        for (std::size_t l = 0; l < sum_lanes; ++l) {
            const double dx = x - xs[j + l];
            const double dy = y - ys[j + l];
            const double per_sum = 1 / (a + squares[j + l]);
            const double share = 4 * a * squares[j + l] * per_sum * per_sum;
            const double r2 = (dx * dx + dy * dy) * per_sum;
            const double kernel = exponential(-r2);
            weights[l] = r2 < reach * reach / 2 ? masses[j + l] * share * kernel : 0;
        }
        for (std::size_t l = 0; l < sum_lanes; ++l) {
            fx[l] += (x - xs[j + l]) * weights[l];
            fy[l] += (y - ys[j + l]) * weights[l];
        }
    }
    return {sum_of_lanes(fx), sum_of_lanes(fy)};
}

/// Bodies of the torus with sigma^2 in [2^e, 2^(e+1)), sorted into cells about sigma wide.
class Octave {
  public:
    Octave(const PlaneSides& sides, int exponent, const std::vector<Body>& bodies)
        : sides_(sides), most_(std::ldexp(1.0, exponent + 1)), sorted_(bodies.size()) {
        for (std::size_t k = 0; k < 2; ++k) {
            const auto cells = static_cast<std::size_t>(sides[k] / std::sqrt(most_));
            along_[k] = std::clamp<std::size_t>(cells, 1, 4096);
            widths_[k] = sides[k] / static_cast<double>(along_[k]);
        }
        starts_.resize(along_[0] * along_[1] + 1);
        for (const Body& body : bodies) ++starts_[cell_of(body) + 1];
        for (std::size_t c = 0; c + 1 < starts_.size(); ++c) starts_[c + 1] += starts_[c];
        std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
        for (const Body& body : bodies) sorted_.put(next[cell_of(body)]++, body);
    }

    /// Adds all bodies within reach of a body at (x, y) with sigma^2 = a, including images.
    void gather(double x, double y, double a, NearBodies& near) const {
        const double far = reach * std::sqrt((a + most_) / 2);
        const auto row_of = [&](double c) { return static_cast<std::int64_t>(c / widths_[1]); };
        for (std::int64_t row = row_of(y - far) - 1; row <= row_of(y + far) + 1; ++row) {
            // The farther a row of cells is from y, the shorter is its segment within reach.
            const double below = static_cast<double>(row) * widths_[1] - y;
            const double gap = std::max({0.0, below, -below - widths_[1]});
            if (gap >= far) continue;
            const double wide = std::sqrt(far * far - gap * gap);
            add_row(row, static_cast<std::int64_t>(std::floor((x - wide) / widths_[0])),
                    static_cast<std::int64_t>(std::floor((x + wide) / widths_[0])), near);
        }
    }

  private:
    [[nodiscard]] std::size_t cell_of(const Body& body) const {
        const auto i = std::min(along_[0] - 1, static_cast<std::size_t>(body.x / widths_[0]));
        const auto j = std::min(along_[1] - 1, static_cast<std::size_t>(body.y / widths_[1]));
        return j * along_[0] + i;
    }

    void add_row(std::int64_t row, std::int64_t first, std::int64_t last, NearBodies& near) const {
        const auto columns = static_cast<std::int64_t>(along_[0]);
        const auto rows = static_cast<std::int64_t>(along_[1]);
        const auto turns_of = [](std::int64_t c, std::int64_t period) {
            return c >= 0 ? c / period : -((period - 1 - c) / period);
        };
        const std::int64_t up = turns_of(row, rows);
        const auto base = static_cast<std::size_t>((row - up * rows) * columns);
        while (first <= last) {
            const std::int64_t across = turns_of(first, columns);
            const std::int64_t column = first - across * columns;
            const std::int64_t run = std::min(last - first + 1, columns - column);
            const std::size_t begin = base + static_cast<std::size_t>(column);
            const std::size_t from = starts_[begin];
            const std::size_t count = starts_[begin + static_cast<std::size_t>(run)] - from;
            near.take(sorted_, from, count, sides_[0] * static_cast<double>(across),
                      sides_[1] * static_cast<double>(up));
            first += run;
        }
    }

    PlaneSides sides_;
    double most_;                         ///< upper bound of sigma^2 of all bodies
    std::array<std::size_t, 2> along_{};  ///< cells along each side
    PlaneSides widths_{};                 ///< sides of a cell
    std::vector<std::uint32_t> starts_;
    Bodies sorted_;
};

/// Sorts bodies into octaves of sigma^2.
std::vector<Octave> octaves(const PlaneSides& sides, const std::vector<Body>& bodies) {
    constexpr int lowest = -60;
    constexpr int highest = 60;
    std::vector<std::vector<Body>> split(highest - lowest + 1);
    for (const Body& body : bodies) {
        const int octave = std::clamp(std::ilogb(body.square), lowest, highest);
        split[static_cast<std::size_t>(octave - lowest)].push_back(body);
    }
    std::vector<Octave> result;
    for (std::size_t i = 0; i < split.size(); ++i)
        if (!split[i].empty()) result.emplace_back(sides, static_cast<int>(i) + lowest, split[i]);
    return result;
}

/// Integrals of a density over rectangles, exact up to rounding.
class Masses {
  public:
    explicit Masses(const DensityMap& map)
        : width_(map.width()), height_(map.height()), sums_((width_ + 1) * (height_ + 1)) {
        const auto cells = static_cast<double>(width_ * height_);
        for (std::size_t j = 0; j < height_; ++j) {
            double row = 0;
            for (std::size_t i = 0; i < width_; ++i) {
                row += map.values()[j * width_ + i] / cells;
                sums_[(j + 1) * (width_ + 1) + i + 1] = sums_[j * (width_ + 1) + i + 1] + row;
            }
        }
    }

    [[nodiscard]] double of(double x0, double x1, double y0, double y1) const {
        return (below(x1, y1) - below(x0, y1)) - (below(x1, y0) - below(x0, y0));
    }

  private:
    /// Mass of [0, x) x [0, y) for the density repeated beyond the unit square.
    [[nodiscard]] double below(double x, double y) const {
        const double across = std::floor(x);
        const double up = std::floor(y);
        const double s = x - across;
        const double t = y - up;
        return across * up + across * inside(1, t) + up * inside(s, 1) + inside(s, t);
    }

    /// below() for x and y in [0, 1].
    [[nodiscard]] double inside(double x, double y) const {
        const double u = x * static_cast<double>(width_);
        const double v = y * static_cast<double>(height_);
        const std::size_t i = std::min(width_ - 1, static_cast<std::size_t>(u));
        const std::size_t j = std::min(height_ - 1, static_cast<std::size_t>(v));
        const double s = u - static_cast<double>(i);
        const double t = v - static_cast<double>(j);
        const double* at = sums_.data() + j * (width_ + 1) + i;
        const double lower = at[0] + s * (at[1] - at[0]);
        const double upper = at[width_ + 1] + s * (at[width_ + 2] - at[width_ + 1]);
        return lower + t * (upper - lower);
    }

    std::size_t width_;
    std::size_t height_;
    std::vector<double> sums_;
};

/// Rectangles of the density that hold at most leaf_mass points each, except at the deepest level.
class Quadtree {
  public:
    Quadtree(const DensityMap& map, double count, const PlaneSides& sides, const RunContext& run)
        : masses_(map),
          count_(count),
          sides_(sides),
          longest_(std::max(sides[0], sides[1])),
          run_(run) {
        // A long box has several roots side by side, each nearly square.
        const double columns = std::max(1.0, std::floor(sides[0] / sides[1] + 0.5));
        const double rows = std::max(1.0, std::floor(sides[1] / sides[0] + 0.5));
        for (double j = 0; j < rows; ++j)
            for (double i = 0; i < columns; ++i)
                split({i / columns, j / rows, 1 / columns, 1 / rows}, 0);
    }

    [[nodiscard]] const std::vector<Body>& leaves() const { return leaves_; }

    /// sigma^2 at (x, y), given in fractions of the box's sides: the area per point of a square
    /// window, centred there, that holds window_mass points.
    [[nodiscard]] double square_at(double x, double y) const {
        double low = 0;
        double high = 0.5;
        for (int i = 0; i < 60 && high - low > 1e-7 * high; ++i) {
            const double half = (low + high) / 2;
            const double across = half * (longest_ / sides_[0]);
            const double up = half * (longest_ / sides_[1]);
            const double mass = count_ * masses_.of(x - across, x + across, y - up, y + up);
            (mass > window_mass ? high : low) = half;
        }
        const double size = (low + high) * longest_;
        return size * size / std::min(window_mass, count_);
    }

  private:
    struct Part {
        double x, y, width, height;
    };

    void split(const Part& s, int depth) {
        run_.check_stop();
        const double mass = count_ * masses_.of(s.x, s.x + s.width, s.y, s.y + s.height);
        constexpr double nothing = 1e-9;  // a smaller mass is a rounding error of 0
        if (mass < nothing) return;
        if (mass > leaf_mass && depth < deepest) {
            const double width = s.width / 2;
            const double height = s.height / 2;
            for (const double y : {s.y, s.y + height})
                for (const double x : {s.x, s.x + width}) split({x, y, width, height}, depth + 1);
            return;
        }
        const double x = s.x + s.width / 2;
        const double y = s.y + s.height / 2;
        leaves_.push_back({x * sides_[0], y * sides_[1], square_at(x, y), -mass});
    }

    Masses masses_;
    double count_;
    PlaneSides sides_;
    double longest_;
    const RunContext& run_;
    std::vector<Body> leaves_;
};

/// Forces on all points, from each other and from the density.
void all_forces(const std::vector<Body>& points, const std::vector<Octave>& density,
                const PlaneSides& sides, std::span<double> forces, const RunContext& run) {
    const std::vector<Octave> moving = octaves(sides, points);
    for_each_block(silent(run), points.size(), 32, [&](const Block& block) {
        NearBodies near;
        for (std::uint64_t i = block.first; i < block.last; ++i) {
            const Body& point = points[i];
            near.count = 0;
            for (const auto* group : {&moving, &density})
                for (const Octave& octave : *group)
                    octave.gather(point.x, point.y, point.square, near);
            near.pad();
            const auto [fx, fy] = force_at(point.x, point.y, point.square, near);
            forces[2 * i] = fx;
            forces[2 * i + 1] = fy;
        }
    });
}

}  // namespace

double density_relaxation_bytes(std::uint64_t count, const DensityMap& map) {
    // Bytes of a point with its force and step, and of up to 12 nodes of the quadtree per point.
    return static_cast<double>(count) * (130 + 12 * 100) +
           8 * static_cast<double>(map.values().size());
}

void relax_to_density(std::span<double> rows, const DensityMap& map, std::uint64_t steps,
                      const RunContext& run, std::span<const double> extents) {
    const std::size_t n = rows.size() / 2;
    const PlaneSides sides = sides_of(n, extents);
    const Quadtree tree(map, static_cast<double>(n), sides, run);
    const std::vector<Octave> density = octaves(sides, tree.leaves());
    const RunContext part = worth_threads(run, 3e-6 * static_cast<double>(n));
    std::vector<Body> points(n);
    std::vector<double> forces(2 * n);
    Descent descent(2 * n);
    for (std::uint64_t step = 0; step < steps; ++step) {
        run.tick(step, steps);
        for (std::size_t i = 0; i < n; ++i)
            points[i] = {rows[2 * i] * sides[0], rows[2 * i + 1] * sides[1],
                         tree.square_at(rows[2 * i], rows[2 * i + 1]), 1};
        all_forces(points, density, sides, forces, part);
        const auto ways = descent.step(forces, 0.25);
        for (std::size_t i = 0; i < 2 * n; i += 2) {
            std::array<double, 2> to{};
            for (std::size_t c = 0; c < 2; ++c) {
                const double x = rows[i + c] + ways[i + c] / sides[c];
                to[c] = std::min(x - std::floor(x), one_minus_ulp);
            }
            if (map.at(to[0], to[1]) > 0)
                std::ranges::copy(to, rows.begin() + static_cast<std::ptrdiff_t>(i));
            else
                ways[i] = ways[i + 1] = 0;
        }
    }
    run.tick(1, 1);
}

}  // namespace stipple
