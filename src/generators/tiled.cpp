// SPDX-License-Identifier: MIT
//
// A tile of blue noise, repeated K x K times and thinned to n points:
//
//     K = least with K^2 T >= n,    the tile has t = ceil(n / K^2) points,    T = --tile-points.
//
// The tile is toroidal Gaussian blue noise (math/gaussian_relaxation.hpp), its points ranked by
// taking away the fullest place, one after the other, as void-and-cluster does. Points i of the set
// stand by rank: those of rank 0 in all tiles, row after row; then those of rank 1, ...; of the
// last rank n - K^2 (t - 1) are there, spread evenly over the tiles: m of K^2, the j-th in tile
// floor(j K^2 / m).
//
// Shape   2-D. A sequence: point i is a function of i, n and the seed; no memory but for the tile.
// Cost    O(t (iterations + t)) once, 1.5 seconds for t = 4096; then 2 ns a point and core.
// Promise no two points are nearer than the nearest of the tile's torus, divided by K; a tile of
//         4096 points keeps them 0.5 / sqrt(n) apart and more.
// Beware  the set is periodic as far as it is not thinned: its spectrum has peaks at multiples of
// K.
//         Larger tiles move them together and down.
// Source  one tile for all: M. F. Cohen, J. Shade, S. Hiller, O. Deussen, "Wang tiles for image and
//         texture generation", ACM Trans. Graph. 22(3) (2003) 287-294,
//         doi:10.1145/882262.882265, of which this is the case of a single tile.

#include <algorithm>
#include <cmath>

#include "core/rng.hpp"
#include "core/wide.hpp"
#include "generators/generator.hpp"
#include "math/exponential.hpp"
#include "math/gaussian_relaxation.hpp"
#include "math/powers.hpp"

namespace stipple::generators {
namespace {

constexpr Param<std::int64_t> tile_points{
    .name = "tile-points",
    .fallback = 4096,
    .low = 16,
    .high = 65536,
    .unit = "points",
    .help = "Largest number of points in the tile; as many as fit n are made"};
constexpr Param<std::int64_t> iterations{.name = "iterations",
                                         .fallback = 250,
                                         .low = 0,
                                         .high = 1'000'000,
                                         .unit = "steps",
                                         .help = "Steps that make the tile even"};

struct Point {
    double x;
    double y;
};

double difference(double a, double b) {
    const double t = std::abs(a - b);
    return std::min(t, 1 - t);
}

/// The order in which points of the unit torus are taken away: each time the one that feels most
/// of those left, by Gaussians that double in width when a quarter is left.
class Ranking {
  public:
    Ranking(std::vector<Point> points, const RunContext& run)
        : points_(std::move(points)), energies_(points_.size()), run_(run) {}

    /// The points, those taken last in front.
    std::vector<Point> ranked() {
        const auto all = static_cast<double>(points_.size());
        std::size_t widen = points_.size();
        double narrow = 0.5 * all / (0.47 * 0.47);  // 1 / (2 sigma^2): 0.47 of the mean distance
        for (std::size_t left = points_.size(); left > 0; --left) {
            run_.tick(points_.size() - left, points_.size());
            if (left == widen) {
                gather(left, narrow);
                sharpness_ = narrow;
                narrow /= 4;
                widen /= 4;
            }
            const auto end = energies_.begin() + static_cast<std::ptrdiff_t>(left);
            const auto fullest = static_cast<std::size_t>(std::max_element(energies_.begin(), end) -
                                                          energies_.begin());
            std::swap(points_[fullest], points_[left - 1]);
            std::swap(energies_[fullest], energies_[left - 1]);
            for (std::size_t i = 0; i + 1 < left; ++i)
                energies_[i] -= felt(points_[i], points_[left - 1], sharpness_);
        }
        return std::move(points_);
    }

  private:
    static double felt(const Point& p, const Point& q, double sharpness) {
        const double x = difference(p.x, q.x);
        const double y = difference(p.y, q.y);
        return exponential(-sharpness * (x * x + y * y));
    }

    void gather(std::size_t left, double sharpness) {
        for (std::size_t i = 0; i < left; ++i) {
            if (i % 64 == 0) run_.check_stop();
            energies_[i] = 0;
            for (std::size_t j = 0; j < left; ++j)
                energies_[i] += felt(points_[i], points_[j], sharpness);
        }
    }

    std::vector<Point> points_;
    std::vector<double> energies_;
    double sharpness_ = 0;
    const RunContext& run_;
};

std::vector<Point> make_tile(std::size_t count, std::uint64_t steps, std::uint64_t seed,
                             const RunContext& run) {
    constexpr double grain = 0x1p28;  // coordinates are multiples of its inverse: sums are exact
    run.need_memory(relaxation_bytes(count, 2) + 56 * static_cast<double>(count), "the tile");
    std::vector<double> rows(2 * count);
    Rng(seed).fill(0, rows);
    relax_gaussian(rows, 2, steps, run.stage(0, 0.7));
    std::vector<Point> points(count);
    for (std::size_t i = 0; i < count; ++i)
        points[i] = {std::floor(rows[2 * i] * grain) / grain,
                     std::floor(rows[2 * i + 1] * grain) / grain};
    return Ranking(std::move(points), run.stage(0.7, 0.99)).ranked();
}

/// row[j] = ((column + j + x) / side, y) for j < count.
STIPPLE_WIDE void place_row(double* row, std::size_t count, double column, double x, double y,
                            double side) {
    for (std::size_t j = 0; j < count; ++j) {
        row[2 * j] = ((column + static_cast<double>(j)) + x) / side;
        row[2 * j + 1] = y;
    }
}

class Tiles final : public Sequence {
  public:
    Tiles(std::vector<Point> tile, std::uint64_t side, std::uint64_t count)
        : tile_(std::move(tile)),
          side_(side),
          last_begin_(side * side * (tile_.size() - 1)),
          last_count_(count - last_begin_) {}

    void fill(std::uint64_t first, std::span<double> rows) override {
        double* out = rows.data();
        std::uint64_t left = rows.size() / 2;
        while (left > 0) {
            const std::uint64_t done = first < last_begin_ ? fill_row(first, left, out)
                                                           : fill_last(first - last_begin_, out);
            first += done;
            left -= done;
            out += 2 * done;
        }
    }

  private:
    /// Points of one rank in one row of tiles; returns their number.
    std::uint64_t fill_row(std::uint64_t first, std::uint64_t most, double* out) const {
        const std::uint64_t row = first / side_;
        const std::uint64_t column = first % side_;
        const Point& point = tile_[row / side_];
        const std::uint64_t count = std::min(most, side_ - column);
        const auto side = static_cast<double>(side_);
        const double y = (static_cast<double>(row % side_) + point.y) / side;
        place_row(out, count, static_cast<double>(column), point.x, y, side);
        return count;
    }

    /// Point j of the last rank.
    std::uint64_t fill_last(std::uint64_t j, double* out) const {
        __extension__ using Product = unsigned __int128;
        const auto place = static_cast<std::uint64_t>(Product{j} * (side_ * side_) / last_count_);
        const auto side = static_cast<double>(side_);
        out[0] = (static_cast<double>(place % side_) + tile_.back().x) / side;
        out[1] = (static_cast<double>(place / side_) + tile_.back().y) / side;
        return 1;
    }

    std::vector<Point> tile_;
    std::uint64_t side_;
    std::uint64_t last_begin_;  ///< index of the first point of the last rank
    std::uint64_t last_count_;
};

std::unique_ptr<Sequence> make(const Plan& plan, const Values& options, const RunContext& run) {
    const auto most = static_cast<std::uint64_t>(options[tile_points]);
    const std::uint64_t full = (plan.count - 1) / most;  // K^2 > full
    const std::uint64_t side = full == 0 ? 1 : floor_root(full, 2) + 1;
    const std::uint64_t points = (plan.count - 1) / (side * side) + 1;
    return std::make_unique<Tiles>(
        make_tile(static_cast<std::size_t>(points), static_cast<std::uint64_t>(options[iterations]),
                  plan.seed, run),
        side, plan.count);
}

}  // namespace

Generator tiled() {
    return {.name = "tiled",
            .summary = "One tile of blue noise, repeated and thinned to any number of points",
            .source = "Cohen, Shade, Hiller, Deussen 2003, doi:10.1145/882262.882265",
            .traits = {.min_dimension = 2, .max_dimension = 2, .prefix = false},
            .options = Schema(tile_points, iterations),
            .sequence = make};
}

}  // namespace stipple::generators
