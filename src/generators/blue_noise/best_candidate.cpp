// SPDX-License-Identifier: MIT
//
// Best candidate: of m points uniform in the box, the one farthest from all earlier points becomes
// the next point, where m grows with the number i of earlier points:
//
//     m = max(1, c i),    c = --candidates.
//
// In up to 3 dimensions only a few of the m candidates are made. The box is divided into cells,
// each with an upper bound of the distance from its positions to the nearest point. The cells with
// the highest bounds are open. The number of candidates in open cells is drawn from a binomial
// distribution, and these are made. While the distance of the best of them is below the highest
// bound of a closed cell, that bound is recomputed. If the bound stays the same, the cell is halved
// or, once small, opened; another binomial draw gives the number of remaining candidates in it.
// Candidates in cells that stay closed cannot win and are never made.
//
// In more dimensions cells exclude too little, so all candidates are made.
//
// Shape   d = 1, ..., 32; distances are those in the box of --bounds, across its faces (torus) or
//         bounded.
// Cost    10^5 points in 2-D take 6 s on one core and 0.14 GB, most of the time waiting for memory;
//         the time per point grows slowly with their number and with c, and is about ten times as
//         long in 3-D. c n^3 steps in more dimensions: 20 s for 10^4 points in 5-D with c = 1.
// Promise the distribution of the points is exactly that of Mitchell's method, with all m
//         candidates made. Point i does not depend on the number of points.
// Source  D. P. Mitchell, Comput. Graph. (SIGGRAPH) 25 (1991) 157-164, doi:10.1145/122718.122736.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <span>

#include "core/machine/wide.hpp"
#include "core/rng.hpp"
#include "core/text.hpp"
#include "generators/box_space.hpp"
#include "generators/generator.hpp"
#include "math/combinatorics/splitmix64.hpp"
#include "math/functions/powers.hpp"
#include "math/functions/roots.hpp"
#include "math/neighbors/covering_bound.hpp"
#include "math/neighbors/point_grid.hpp"

namespace stipple::generators::best_candidate {
namespace {

constexpr Param<double> candidates{
    .name = "candidates",
    .fallback = 1,
    .low = 0,
    .high = 1e6,
    .low_open = true,
    .unit = "per point",
    .help = "Number of candidates for a point, as a multiple of the number of earlier points"};

/// Stream of uniform numbers for one point, a function of the seed and the point's index.
class PointDraws {
  public:
    PointDraws(const Rng& rng, std::uint64_t point) : stream_(rng.bits(point)) {}
    double next() { return to_unit(stream_.next()); }

    /// Binomially distributed number of hits among m trials of probability p.
    std::uint64_t binomial(std::uint64_t m, double p) {
        if (p >= 1) return m;
        // Splits the trials in two, because the probability of no hit could underflow.
        if (m > 1 && static_cast<double>(m) * p > 16)
            return binomial(m / 2, p) + binomial(m - m / 2, p);
        double chance = whole_power(1 - p, m);  // probability of k hits, for k = 0, 1, ...
        double u = next();
        std::uint64_t k = 0;
        for (; k < m && u >= chance; ++k) {
            u -= chance;
            chance *= static_cast<double>(m - k) / static_cast<double>(k + 1) * (p / (1 - p));
        }
        return k;
    }

  private:
    SplitMix64 stream_;
};

/// Entry of a closed cell in the heap, which is ordered by bounds.
struct Waiting {
    double bound;
    std::uint32_t cell;
    bool operator<(const Waiting& other) const {
        return bound != other.bound ? bound < other.bound : cell > other.cell;
    }
};

/// The box divided into cells. Cells with the highest bounds are open: enough of them to receive a
/// few candidates, which are drawn for all open cells together. The other cells are in a heap.
template <std::size_t D>
class LazySearch {
  public:
    using Point = typename GridFrame<D>::Point;

    LazySearch(const BoxSpace& space, std::uint64_t seed, double factor)
        : space_(space),
          factor_(factor),
          rng_(seed),
          points_(space.box, space.torus),
          tiles_(space.box, space.torus, infinity) {
        Cell whole{.low = {}, .bound = infinity};
        for (std::size_t k = 0; k < D; ++k) {
            sides_[0][k] = space.box.extent(k);
            whole.low[k] = space.box.low[k];
        }
        for (std::size_t depth = 1; depth <= most_halvings; ++depth) {
            sides_[depth] = sides_[depth - 1];
            *std::ranges::max_element(sides_[depth]) /= 2;
            shares_[depth] = shares_[depth - 1] / 2;
        }
        for (std::size_t depth = 0; depth <= most_halvings; ++depth)
            for (std::size_t k = 0; k < D; ++k) halves_[depth][k] = sides_[depth][k] / 2;
        cells_.push_back(whole);
        heap_.push({infinity, 0});
        tile_cells_.resize(1);
    }

    /// Adds the next point: the best of its candidates.
    void add() {
        PointDraws draws(rng_, points_.count());
        best_ = -1;
        all_ = std::max(1.0, std::floor(factor_ * static_cast<double>(points_.count())));
        // Larger cells are halved: open ones are to be as small as the region of better candidates.
        // For few candidates, this size would be far too small.
        constexpr double fine = 64;
        open_size_ = std::clamp(fine * factor_ * nth_root(all_, D + 1) / all_, 0x1p-14, 0.25);
        while (!heap_.empty() && all_ * open_share_ < eager) pull();
        crowded_ = all_ * open_share_ > 4 * eager;
        auto left = static_cast<std::uint64_t>(all_);
        const std::uint64_t hits = heap_.empty() ? left : draws.binomial(left, open_share_);
        for (std::uint64_t i = 0; i < hits; ++i) {
            const Open& open = open_cell(draws.next() * open_share_);
            try_candidate(open, draws);
        }
        left -= hits;
        while (!heap_.empty() && best_ < heap_.top().bound && left > 0) left -= go_on(left, draws);
        points_.add(winner_.data());
        tidy();
    }

    [[nodiscard]] const std::vector<double>& rows() const { return points_.rows(); }

  private:
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    static constexpr std::uint32_t most_halvings = 50;
    static constexpr std::uint32_t closed = 0xffff'ffff;
    static constexpr double eager = 64;  ///< minimum expected number of candidates in open cells

    struct Cell {
        Point low;
        double bound;                 ///< upper bound of distances to the nearest point
        std::uint32_t depth = 0;      ///< number of halvings; the cell is 2^-depth of the box
        std::uint32_t points = 0;     ///< number of points when the bound was computed
        std::uint32_t slot = closed;  ///< index in the list of open cells of its depth
    };

    struct Open {
        Point low;
        double bound;
        std::uint32_t cell;
        std::uint32_t depth;
        std::uint32_t size = 0;  ///< number of entries of `points` in use
        /// Points near the cell, relative to `low`; they reject most candidates.
        std::array<Point, D + 1> points{};
    };

    /// Updates the bound of the heap's cell of highest bound; if it is unchanged, halves or opens
    /// the cell. Returns whether it was opened.
    bool pull() {
        const std::uint32_t id = heap_.top().cell;
        heap_.pop();
        const double before = cells_[id].bound;
        bound(cells_[id]);
        if (cells_[id].bound < before) {
            heap_.push({cells_[id].bound, id});
            return false;
        }
        if (worth_a_cut(cells_[id].depth, open_size_)) {
            for (const std::uint32_t half : halves(id)) heap_.push({cells_[half].bound, half});
            return false;
        }
        open(id);
        return true;
    }

    [[nodiscard]] bool worth_a_cut(std::uint32_t depth, double size) const {
        return all_ * shares_[depth] > size && depth < most_halvings;
    }

    void open(std::uint32_t id) {
        Cell& cell = cells_[id];
        auto& list = open_[cell.depth];
        cell.slot = static_cast<std::uint32_t>(list.size());
        list.push_back({cell.low, cell.bound, id, cell.depth});
        note_points(list.back());
        open_share_ += shares_[cell.depth];
        newest_ = id;
        tile_cells_[tiles_.cell_of(center(cell).data())].push_back(id);
    }

    void close(std::uint32_t id) {
        Cell& cell = cells_[id];
        auto& list = open_[cell.depth];
        cells_[list.back().cell].slot = cell.slot;
        list[cell.slot] = list.back();
        list.pop_back();
        cell.slot = closed;
        open_share_ -= shares_[cell.depth];
    }

    /// Calls pull(). If that opens a cell, draws how many of the `left` remaining candidates are in
    /// it, makes them and returns their number; otherwise returns 0.
    std::uint64_t go_on(std::uint64_t left, PointDraws& draws) {
        const double rest = 1 - open_share_;
        if (!pull()) return 0;
        const Cell& cell = cells_[newest_];
        const Open open = open_[cell.depth][cell.slot];
        const std::uint64_t hits =
            heap_.empty() ? left : draws.binomial(left, shares_[cell.depth] / rest);
        for (std::uint64_t i = 0; i < hits; ++i) try_candidate(open, draws);
        return hits;
    }

    /// Open cell at position `place` if the open cells are joined end to end, ordered by depth;
    /// `place` is a volume, as a fraction of the box.
    [[nodiscard]] const Open& open_cell(double place) const {
        std::uint32_t last = 0;
        for (std::uint32_t depth = 0; depth <= most_halvings; ++depth) {
            const double share = static_cast<double>(open_[depth].size()) * shares_[depth];
            if (share > 0) last = depth;
            if (place < share) break;
            if (share > 0) place -= share;
        }
        const auto& list = open_[last];
        const auto index = static_cast<std::size_t>(std::max(0.0, place) / shares_[last]);
        return list[std::min(index, list.size() - 1)];
    }

    /// Updates the bounds of open cells that are near the new point or had a candidate that did not
    /// become the best; closes or halves some of them.
    void tidy() {
        if (points_.count() > 2 * tiles_.size()) make_tiles();
        const double level = crowded_ || heap_.empty() ? best_ : heap_.top().bound;
        for (const std::uint32_t id : missed_)
            if (cells_[id].slot != closed && !closes(id, level) &&
                worth_a_cut(cells_[id].depth, open_size_ / 4))
                cut(id, level);
        missed_.clear();
        if (points_.count() == 1) return;
        tiles_.visit(winner_.data(), best_, [&](std::size_t first, std::size_t last) {
            for (std::size_t t = first; t < last; ++t) tidy_tile(t, level);
            return true;
        });
    }

    void tidy_tile(std::size_t tile, double level) {
        auto& list = tile_cells_[tile];
        std::size_t kept = 0;
        for (const std::uint32_t id : list)
            if (cells_[id].slot != closed && cells_[id].points < points_.count() &&
                !closes(id, level))
                list[kept++] = id;
        list.resize(kept);
    }

    /// Updates an open cell's bound, and closes the cell if it is below `level`; true if closed.
    bool closes(std::uint32_t id, double level) {
        Cell& cell = cells_[id];
        const double before = cell.bound;
        bound(cell);
        if (cell.bound >= level) {
            if (cell.bound < before) note_points(open_[cell.depth][cell.slot]);
            return false;
        }
        close(id);
        heap_.push({cells_[id].bound, id});
        return true;
    }

    void cut(std::uint32_t id, double level) {
        close(id);
        for (const std::uint32_t half : halves(id))
            if (cells_[half].bound < level)
                heap_.push({cells_[half].bound, half});
            else
                open(half);
    }

    /// Makes a new grid of about one tile per point, to find the open cells near a point.
    void make_tiles() {
        double longest = 0;
        for (const double side : sides_[0]) longest = std::max(longest, side);
        const auto wanted = static_cast<double>(points_.count());
        double side = longest;
        while (GridFrame<D>(space_.box, space_.torus, side).size() < points_.count() / 2 &&
               side > longest / (4 * wanted))
            side /= 1.25;
        tiles_ = GridFrame<D>(space_.box, space_.torus, side);
        tile_cells_.assign(tiles_.size(), {});
        for (const auto& list : open_)
            for (const Open& open : list)
                tile_cells_[tiles_.cell_of(center(cells_[open.cell]).data())].push_back(open.cell);
    }

    [[nodiscard]] Point center(const Cell& cell) const {
        Point c;
        for (std::size_t k = 0; k < D; ++k) c[k] = cell.low[k] + sides_[cell.depth][k] / 2;
        return c;
    }

    /// Updates a cell's bound from all points that may be the nearest to a location in it.
    void bound(Cell& cell) {
        if (cell.points == points_.count()) return;
        cell.points = static_cast<std::uint32_t>(points_.count());
        gather(center(cell), reach_of(cell));
        if (covering_.empty()) return;
        constexpr double safety = 1 + 1e-12;  // factor far above the rounding errors of a bound
        cell.bound =
            std::min(cell.bound, std::sqrt(covering_.squared(halves_[cell.depth])) * safety);
    }

    /// Distance from the cell's centre beyond which a point is nearest to no location in the cell.
    [[nodiscard]] double reach_of(const Cell& cell) const {
        double squared = 0;
        for (const double half : halves_[cell.depth]) squared += half * half;
        return cell.bound + std::sqrt(squared);
    }

    /// Collects all points within `reach` of `middle`, as offsets from `middle`.
    void gather(const Point& middle, double reach) {
        covering_.clear();
        points_.visit(middle.data(), reach, [&](std::size_t, double, const double* q) {
            covering_.add(shift(middle, q));
            return true;
        });
    }

    /// Stores in an open cell the points that determine its bound.
    void note_points(Open& open) {
        Cell& cell = cells_[open.cell];
        open.bound = cell.bound;
        open.size = 0;
        gather(center(cell), reach_of(cell));
        if (covering_.empty()) return;
        const Point& half = halves_[cell.depth];
        covering_.squared(half);
        covering_.visit_basis([&](const Point& q) {
            Point& noted = open.points[open.size++];
            for (std::size_t k = 0; k < D; ++k) noted[k] = q[k] + half[k];
        });
    }

    /// Vector from p to the nearest image of q.
    [[nodiscard]] Point shift(const Point& p, const double* q) const {
        Point way;
        for (std::size_t k = 0; k < D; ++k) {
            way[k] = q[k] - p[k];
            if (!space_.torus) continue;
            const double side = sides_[0][k];
            way[k] = way[k] > side / 2    ? way[k] - side
                     : way[k] < -side / 2 ? way[k] + side
                                          : way[k];
        }
        return way;
    }

    /// Splits a cell into halves; the first keeps its index. Returns both indices.
    std::array<std::uint32_t, 2> halves(std::uint32_t id) {
        const auto other = static_cast<std::uint32_t>(cells_.size());
        cells_.push_back(cells_[id]);
        const Point& side = sides_[cells_[id].depth];
        for (std::size_t k = 0; k < D; ++k)
            cells_[other].low[k] += side[k] - sides_[cells_[id].depth + 1][k];
        for (const std::uint32_t half : {id, other}) {
            ++cells_[half].depth;
            cells_[half].points = 0;
            bound(cells_[half]);
        }
        return {id, other};
    }

    /// Draws a candidate in the cell and keeps it if it is the best so far.
    void try_candidate(const Open& open, PointDraws& draws) {
        Point place;  // candidate, relative to the cell's corner
        Point p;
        for (std::size_t k = 0; k < D; ++k) {
            const double high = space_.box.high[k];
            do {
                place[k] = draws.next() * sides_[open.depth][k];
                p[k] = open.low[k] + place[k];
            } while (p[k] >= high && open.low[k] < high);
            // The cell's corner may be rounded up to the face.
            if (p[k] >= high) p[k] = std::nextafter(high, space_.box.low[k]);
        }
        for (std::size_t i = 0; i < open.size && best_ > 0; ++i) {
            double squared = 0;
            for (std::size_t k = 0; k < D; ++k)
                squared += (place[k] - open.points[i][k]) * (place[k] - open.points[i][k]);
            if (squared <= best_ * best_) {
                if ((crowded_ && open.bound < best_) || worth_a_cut(open.depth, open_size_ / 4))
                    missed_.push_back(open.cell);
                return;
            }
        }
        const double distance = distance_of(p, open.bound);
        if (distance <= best_) {
            missed_.push_back(open.cell);
            return;
        }
        best_ = distance;
        winner_ = p;
    }

    /// Distance from p to its nearest point; 0 if it is below the best distance so far.
    /// @param bound known upper bound of the distance
    [[nodiscard]] double distance_of(const Point& p, double bound) const {
        if (best_ > 0 && points_.any_nearer(p.data(), best_)) return 0;
        const double guess = bound < infinity ? bound : space_.largest_distance();
        return std::sqrt(points_.nearest_squared(p.data(), guess));
    }

    const BoxSpace& space_;
    double factor_;
    Rng rng_;
    GrowingPoints<D> points_;
    std::array<Point, most_halvings + 1> sides_{};     ///< sides of cells, by depth
    std::array<Point, most_halvings + 1> halves_{};    ///< half of sides_
    std::array<double, most_halvings + 1> shares_{1};  ///< a cell's fraction of the box, by depth
    std::vector<Cell> cells_;
    std::priority_queue<Waiting> heap_;
    std::array<std::vector<Open>, most_halvings + 1> open_;  ///< open cells
    bool crowded_ = false;                                   ///< more cells are open than needed
    double open_share_ = 0;     ///< fraction of the box in open cells, without rounding errors
    std::uint32_t newest_ = 0;  ///< cell opened last
    GridFrame<D> tiles_;
    /// Open cells, in a list for each tile; some may have been closed since.
    std::vector<std::vector<std::uint32_t>> tile_cells_;
    std::vector<std::uint32_t> missed_;  ///< cells with a candidate that did not become the best
    CoveringBound<D> covering_;
    double open_size_ = 1;  ///< cells with more expected candidates are halved, not opened
    double all_ = 1;        ///< number of candidates for the current point
    double best_ = 0;       ///< distance of the best candidate so far to its nearest point
    Point winner_{};
};

/// Bytes per point that cells take with c = 1, by dimension; each factor of ten in c adds half as
/// much. Measured for 3000 to 300 000 points.
constexpr std::array<double, 3> cell_bytes{700, 1500, 5800};

/// Largest dimension with cells; above it, making all candidates is faster up to 10^4.5 points.
constexpr std::size_t most_lazy = cell_bytes.size();

template <std::size_t D>
std::vector<double> lazily(const BoxSpace& space, const Plan& plan, double factor,
                           std::uint64_t wanted, const RunContext& run) {
    const auto number = static_cast<double>(wanted);
    const double more = 1 + std::log10(std::max(1.0, factor)) / 2;
    run.need_memory(GrowingPoints<D>::memory(number) + number * cell_bytes[D - 1] * more,
                    fmt::format("{} points", wanted));
    if (number >= 2e7)
        fail(ErrorKind::limit,
             "--count: {} points are too many for cells with 32-bit numbers; expected fewer than "
             "2e7",
             wanted);
    LazySearch<D> search(space, plan.seed, factor);
    for (std::uint64_t i = 0; i < wanted; ++i) {
        if (i % 16 == 0) run.tick(i, wanted);
        search.add();
    }
    return search.rows();
}

constexpr std::size_t together = 32;  ///< points tested at once
constexpr double out_of_reach = 1e300;

/// Least squared distance from p to the points. Stops and returns `enough` once a squared distance
/// is at most `enough`.
/// @param along coordinates of the points by axis, padded to a multiple of `together`
STIPPLE_WIDE double least_squared(std::span<const std::vector<double>> along,
                                  std::span<const double> turns, const double* p, double enough) {
    std::array<double, together> least;
    least.fill(std::numeric_limits<double>::infinity());
    for (std::size_t first = 0; first < along[0].size(); first += together) {
        std::array<double, together> squared{};
        for (std::size_t k = 0; k < along.size(); ++k) {
            const double* const q = &along[k][first];
            for (std::size_t i = 0; i < together; ++i) {
                const double straight = std::abs(q[i] - p[k]);
                const double around = turns[k] - straight;
                const double shorter = around < straight ? around : straight;
                squared[i] += shorter * shorter;
            }
        }
        std::int64_t near = 0;
        for (std::size_t i = 0; i < together; ++i) {
            near |= squared[i] <= enough ? 1 : 0;
            least[i] = squared[i] < least[i] ? squared[i] : least[i];
        }
        if (near != 0) return enough;
    }
    return std::ranges::min(least);
}

/// Returns the one of `all` candidates that is farthest from the points so far.
std::vector<double> farthest(const BoxSpace& space, std::span<const std::vector<double>> along,
                             std::span<const double> turns, std::uint64_t all, SplitMix64 stream,
                             const RunContext& run) {
    std::vector<double> winner(along.size());
    std::vector<double> p(along.size());
    double best = -1;
    for (std::uint64_t candidate = 0; candidate < all; ++candidate) {
        if (candidate % 0x10000 == 0xffff) run.check_stop();
        for (std::size_t k = 0; k < along.size(); ++k) do
                p[k] = space.box.low[k] + to_unit(stream.next()) * space.box.extent(k);
            while (p[k] >= space.box.high[k]);
        const double squared = least_squared(along, turns, p.data(), best);
        if (squared <= best) continue;
        best = squared;
        winner = p;
    }
    return winner;
}

/// Makes all candidates of the first `wanted` points. A candidate is dropped once a point is as
/// near to it as the best candidate's nearest point.
std::vector<double> all_candidates(const BoxSpace& space, std::uint64_t seed, double factor,
                                   std::uint64_t wanted, const RunContext& run) {
    const std::size_t d = space.box.dimension();
    run.need_memory(static_cast<double>(wanted) * 2 * sizeof(double) * static_cast<double>(d),
                    fmt::format("{} points", wanted));
    std::vector<double> turns;  // period along each axis; infinite if bounded
    for (std::size_t k = 0; k < d; ++k)
        turns.push_back(space.torus ? space.box.extent(k)
                                    : std::numeric_limits<double>::infinity());
    const Rng rng(seed);
    std::vector<double> rows;
    std::vector<std::vector<double>> along(d);  // coordinates by axis, padded with far points
    for (std::uint64_t i = 0; i < wanted; ++i) {
        if (i % 16 == 0) run.tick(i, wanted);
        const double all = std::max(1.0, std::floor(factor * static_cast<double>(i)));
        const std::vector<double> point = farthest(
            space, along, turns, static_cast<std::uint64_t>(all), SplitMix64(rng.bits(i)), run);
        rows.insert(rows.end(), point.begin(), point.end());
        for (std::size_t k = 0; k < d; ++k) {
            if (i % together == 0) along[k].resize(i + together, out_of_reach);
            along[k][i] = point[k];
        }
    }
    return rows;
}

std::vector<double> rows_in(const BoxSpace& space, const Plan& plan, double factor,
                            const RunContext& run) {
    const std::uint64_t wanted = plan.start + plan.count;
    if (plan.dimension > most_lazy) return all_candidates(space, plan.seed, factor, wanted, run);
    return with_dimension<most_lazy>(plan.dimension, [&]<std::size_t D>() {
        return lazily<D>(space, plan, factor, wanted, run);
    });
}

PointSet make(const Plan& plan, const Values& options, const RunContext& run) {
    const BoxSpace space = space_of(plan, !options[bounded_option]);
    PointSet points = set_in_box(rows_in(space, plan, options[candidates], run), plan);
    run.tick(1, 1);
    points.provenance.options = {{"candidates", format_number(options[candidates])},
                                 {space.torus ? "torus" : "bounded", "true"}};
    return points;
}

}  // namespace

Generator unit() {
    return {.name = "best-candidate",
            .summary =
                "Each point is the random candidate farthest from all earlier points; the number "
                "of candidates grows",
            .source = "Mitchell 1991, doi:10.1145/122718.122736",
            .traits = {.max_dimension = 32, .sequence = false, .boxed = true},
            .options = Schema(candidates, torus_option, bounded_option),
            .aliases = {"mitchell"},
            .plan = plan_in_box,
            .set = make};
}

}  // namespace stipple::generators::best_candidate
