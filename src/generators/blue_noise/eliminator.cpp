// SPDX-License-Identifier: MIT
#include "generators/blue_noise/eliminator.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <queue>
#include <utility>

#include "core/parallel.hpp"
#include "core/rng.hpp"
#include "math/functions/roots.hpp"
#include "math/geometry/ball_volume.hpp"
#include "math/neighbors/point_grid.hpp"

namespace stipple {
namespace {

constexpr double beta = 0.65;
constexpr double unit = 0x1p40;  ///< weights are integers, in units of 2^-40

/// Term that a pair of points adds to the weights of both.
struct Kernel {
    double nearest;  ///< r_min / r_max: distances below 2 r_min count as 2 r_min

    /// @param inverse 1 / (distance at which the term becomes 0)
    [[nodiscard]] std::uint64_t operator()(double squared_distance, double inverse) const {
        const double t = 1 - std::max(std::sqrt(squared_distance) * inverse, nearest);
        const double t2 = t * t;
        const double t4 = t2 * t2;
        return t > 0 ? static_cast<std::uint64_t>(static_cast<std::int64_t>(t4 * t4 * unit)) : 0;
    }
};

/// Points with neighbour queries, renumbered and sorted into layers. In a layer no radius is more
/// than twice another, so that one grid suits all of its points.
template <std::size_t D>
class LayeredPoints {
  public:
    /// @param shares as for eliminate()
    LayeredPoints(std::span<const double> rows, const BoxSpace& space, double r_max,
                  std::span<const double> shares, const RunContext& run) {
        const std::size_t count = rows.size() / D;
        radii_.assign(count, r_max);
        std::map<int, std::vector<std::uint32_t>> by_size;
        const double most = space.largest_distance();  // no pair is farther apart
        for (std::uint32_t i = 0; i < count; ++i) {
            const double share = shares.empty() ? 1 : std::min(shares[i], most / r_max);
            radii_[i] = r_max * share;
            by_size[std::ilogb(share)].push_back(i);
        }
        for (const auto& [size, members] : by_size) add_layer(members, rows, space, run);
        std::vector<double> sorted;
        for (const std::uint32_t i : originals_) sorted.push_back(radii_[i]);
        radii_ = std::move(sorted);
    }

    [[nodiscard]] std::size_t count() const { return originals_.size(); }
    [[nodiscard]] std::uint32_t original(std::size_t s) const { return originals_[s]; }

    /// Calls visit(t, squared distance, 1 / (distance at which the term becomes 0)) for all points
    /// t that have a term with s, including s itself.
    template <class Visit>
    void visit(std::size_t s, Visit&& visit) const {
        const Layer& layer = layers_[layer_of_[s]];
        this->visit((*layer.points)[s - layer.first], radii_[s], visit);
    }

    /// Removes point s, then calls visit() as above for the other points.
    template <class Visit>
    void visit_without(std::size_t s, Visit&& visit) {
        Layer& layer = layers_[layer_of_[s]];
        std::array<double, D> p;
        std::copy_n((*layer.points)[s - layer.first], D, p.begin());
        layer.points->remove(s - layer.first);
        this->visit(p.data(), radii_[s], visit);
    }

  private:
    struct Layer {
        std::size_t first;  ///< index of the layer's first point
        double largest;     ///< largest radius
        std::optional<SortedPoints<D>> points;
    };

    void add_layer(const std::vector<std::uint32_t>& members, std::span<const double> rows,
                   const BoxSpace& space, const RunContext& run) {
        std::vector<double> some;
        Layer layer{.first = originals_.size(), .largest = 0, .points = {}};
        for (const std::uint32_t i : members) {
            if (some.size() % (65536 * D) == 0) run.check_stop();
            const auto row = rows.begin() + static_cast<std::ptrdiff_t>(i * D);
            some.insert(some.end(), row, row + D);
            layer.largest = std::max(layer.largest, radii_[i]);
        }
        // The number of cells is limited, as small radii may occur in a small part of the box only.
        const GridFrame<D> frame(space.box, space.torus, layer.largest,
                                 1024 + 8 * static_cast<double>(members.size()));
        layer.points.emplace(frame, some, run);
        for (std::size_t t = 0; t < members.size(); ++t)
            originals_.push_back(members[layer.points->original(t)]);
        layer_of_.resize(originals_.size(), static_cast<std::uint8_t>(layers_.size()));
        layers_.push_back(std::move(layer));
    }

    template <class Visit>
    void visit(const double* p, double radius, Visit& visit) const {
        for (const Layer& layer : layers_)
            layer.points->visit(p, radius + layer.largest, [&](std::size_t t, double squared) {
                visit(layer.first + t, squared, 1 / (radius + radii_[layer.first + t]));
            });
    }

    std::vector<Layer> layers_;
    std::vector<std::uint32_t> originals_;
    std::vector<double> radii_;
    std::vector<std::uint8_t> layer_of_;
};

/// Heap entry, possibly outdated.
struct Candidate {
    std::uint64_t weight;
    std::uint32_t original;
    std::uint32_t sorted;

    bool operator<(const Candidate& other) const {
        return weight != other.weight ? weight < other.weight : original > other.original;
    }
};

template <std::size_t D>
std::vector<std::uint64_t> weights_of(const LayeredPoints<D>& points, const Kernel& kernel,
                                      const RunContext& run) {
    std::vector<std::uint64_t> weights(points.count());
    for_each_block(run, points.count(), 2048, [&](const Block& b) {
        for (std::size_t s = b.first; s < b.last; ++s) {
            std::uint64_t sum = 0;
            points.visit(s, [&](std::size_t t, double squared, double inverse) {
                if (t != s) sum += kernel(squared, inverse);
            });
            weights[s] = sum;
        }
    });
    return weights;
}

template <std::size_t D>
std::vector<std::uint32_t> eliminate_from(LayeredPoints<D> points, std::uint64_t kept,
                                          const RunContext& run) {
    const double share = static_cast<double>(kept) / static_cast<double>(points.count());
    const Kernel kernel{beta * (1 - share * std::sqrt(share))};
    auto weights = weights_of(points, kernel, run.stage(0, 0.3));  // by index in `points`
    std::vector<Candidate> all;
    all.reserve(points.count());
    for (std::size_t s = 0; s < points.count(); ++s)
        all.push_back({weights[s], points.original(s), static_cast<std::uint32_t>(s)});
    std::priority_queue<Candidate> heaviest_first({}, std::move(all));
    std::vector<std::uint32_t> gone;
    const std::size_t wanted = points.count() - kept;
    const RunContext rest = run.stage(0.3, 1);
    for (std::uint64_t step = 0; gone.size() < wanted; ++step) {
        if (step % 1024 == 0) rest.tick(gone.size(), wanted);
        Candidate top = heaviest_first.top();
        heaviest_first.pop();
        if (top.weight != weights[top.sorted]) {
            top.weight = weights[top.sorted];
            heaviest_first.push(top);
            continue;
        }
        gone.push_back(top.original);
        points.visit_without(top.sorted, [&](std::size_t t, double squared, double inverse) {
            weights[t] -= kernel(squared, inverse);
        });
    }
    return gone;
}

}  // namespace

double packing_radius(double count, std::size_t dimension, double measure) {
    const double share = measure / count;
    if (dimension == 1) return share / 2;
    if (dimension == 2) return std::sqrt(share / (2 * std::sqrt(3.0)));
    if (dimension == 3) return nth_root(share / (4 * std::sqrt(2.0)), 3);
    return nth_root(share / unit_ball_volume(dimension), dimension);
}

double elimination_memory(double points, std::size_t dimension, bool with_shares) {
    return points * (8 * static_cast<double>(dimension) + (with_shares ? 80 : 40));
}

std::vector<std::uint32_t> eliminate(std::span<const double> rows, const BoxSpace& space,
                                     double r_max, std::uint64_t kept, const RunContext& run,
                                     std::span<const double> shares) {
    return with_dimension<most_directions>(space.box.dimension(), [&]<std::size_t D>() {
        return eliminate_from(LayeredPoints<D>(rows, space, r_max, shares, run), kept, run);
    });
}

namespace {

constexpr std::size_t most_points = 65'536;
constexpr std::size_t most_balls = 256;
constexpr std::size_t fewest = 24;  ///< minimum number of points for an estimate

/// Squared distance from a point to its k-th neighbour; and the mean squared distance to its 4k
/// nearest neighbours, divided by that to its k nearest.
struct Ball {
    double square;
    double growth;
};

/// One random index from each of `some` equal ranges of [0, all).
std::vector<std::size_t> spread_numbers(std::size_t all, std::size_t some) {
    const Rng rng(0, 0);
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < some; ++i) {
        const std::size_t first = i * all / some;
        numbers.push_back(first + rng.below(i, (i + 1) * all / some - first));
    }
    return numbers;
}

double quantile(std::vector<double> values, double share) {
    const double at = share * static_cast<double>(values.size());
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(at);
    std::ranges::nth_element(values, place);
    return *place;
}

std::vector<Ball> balls_of(std::span<const double> rows, std::size_t directions,
                           std::span<const std::size_t> others, std::size_t inner,
                           const RunContext& run) {
    const auto centres = spread_numbers(others.size(), std::min(others.size(), most_balls));
    std::vector<double> squares(others.size());
    std::vector<Ball> balls;
    for (const std::size_t centre : centres) {
        run.check_stop();
        const double* from = rows.data() + others[centre] * directions;
        for (std::size_t i = 0; i < others.size(); ++i) {
            squares[i] = 0;
            for (std::size_t k = 0; k < directions; ++k) {
                const double step = rows[others[i] * directions + k] - from[k];
                squares[i] += step * step;
            }
        }
        const auto far = squares.begin() + static_cast<std::ptrdiff_t>(4 * inner);
        std::ranges::nth_element(squares, far);
        const auto near = squares.begin() + static_cast<std::ptrdiff_t>(inner);
        std::nth_element(squares.begin(), near, far);
        std::sort(squares.begin(), far + 1);  // makes sums independent of the library's nth_element
        const double within = std::accumulate(squares.begin(), near + 1, 0.0);
        const double all = std::accumulate(near + 1, far + 1, within);
        if (*near > 0) balls.push_back({*near, all / (4 * within)});
    }
    return balls;
}

/// Dimension d for which 16^(1/d), the growth of a squared distance, is nearest to `growth`.
std::size_t dimension_for(double growth, std::size_t most) {
    // Limits between d and d + 1: 16^(1 / (d + 1/2)).
    constexpr std::array<double, 5> between = {6.3496, 3.0314, 2.2082, 1.8517, 1.6556};
    std::size_t d = 1;
    while (d < most && growth < between[d - 1]) ++d;
    return d;
}

}  // namespace

CrowdExtent crowd_extent(std::span<const double> rows, std::size_t directions,
                         std::size_t dimension, const RunContext& run, std::uint64_t kept) {
    const std::size_t all = rows.size() / directions;
    if (all < fewest) return {};
    const auto others = spread_numbers(all, std::min(all, most_points));
    const double each = kept > 0 ? static_cast<double>(all) / static_cast<double>(kept) : 16;
    const auto inner = static_cast<std::size_t>(
        std::min(std::max(1.5 * each, 6.0), static_cast<double>(others.size() / 12)));
    const auto balls = balls_of(rows, directions, others, inner, run);
    if (balls.empty()) return {};
    std::vector<double> growth;
    for (const Ball& ball : balls) growth.push_back(ball.growth);
    const std::size_t d =
        dimension > 0 ? dimension : dimension_for(quantile(std::move(growth), 0.5), directions);
    std::vector<double> volumes;
    for (const Ball& ball : balls) {
        double volume = unit_ball_volume(d) * (d % 2 == 1 ? std::sqrt(ball.square) : 1);
        for (std::size_t k = 0; k < d / 2; ++k) volume *= ball.square;
        volumes.push_back(volume);
    }
    const double points = static_cast<double>(inner) - 1.0 / 3;  // median ball's volume, in points
    constexpr double inside = 0.4;  // quantile; balls this small rarely cross the set's boundary
    return {d, quantile(std::move(volumes), inside) * static_cast<double>(others.size()) / points};
}

}  // namespace stipple
