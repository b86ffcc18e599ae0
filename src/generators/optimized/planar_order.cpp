// SPDX-License-Identifier: MIT
#include "generators/optimized/planar_order.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/machine/wide.hpp"
#include "core/rng.hpp"
#include "math/functions/logarithm.hpp"

namespace stipple {
namespace {

constexpr double slack = 1e-13;      ///< relative tolerance of bounds
constexpr std::size_t lanes = 64;    ///< bounds tested at once
constexpr std::uint64_t entry = 32;  ///< steps counted for the overhead of a row of bounds

/// Writes the indices k < size with (counts[k] - level) * scale > values[k] * reach to `hits` and
/// returns their number. With negated level, scale and reach it finds those with (counts[k] +
/// level) * scale < values[k] * reach.
STIPPLE_WIDE std::size_t beyond(const float* counts, double level, double scale,
                                const double* values, double reach, std::size_t size,
                                std::uint32_t* hits) {
    std::size_t found = 0;
    for (std::size_t first = 0; first < size; first += lanes) {
        const std::size_t last = std::min(first + lanes, size);
        std::int64_t any = 0;
        for (std::size_t k = first; k < last; ++k)
            any |=
                std::int64_t{(static_cast<double>(counts[k]) - level) * scale > values[k] * reach};
        for (std::size_t k = first; any != 0 && k < last; ++k)
            if ((static_cast<double>(counts[k]) - level) * scale > values[k] * reach)
                hits[found++] = static_cast<std::uint32_t>(k);
    }
    return found;
}

}  // namespace

PlanarOrder::PlanarOrder(const Ranks& ranks, const RunContext& run)
    : run_(run),
      n_(ranks.size()),
      stride_(n_ + 2),
      rank_(n_ + 1),
      place_(n_ + 1),
      x_(n_ + 2, 1),
      y_(n_ + 2, 1),
      from_(2 * n_ + 1),
      by_order_(2 * n_ + 1),
      moved_in_(2 * n_ + 1),
      queue_(2 * n_ + 2),
      queued_(2 * n_ + 1),
      hits_(n_ + 2) {
    for (std::size_t i = 1; i <= n_; ++i) {
        rank_[i] = ranks[i - 1] + 1;
        place_[rank_[i]] = i;
        x_[i] = y_[i] = (static_cast<double>(i) - 0.5) / static_cast<double>(n_);
    }
    for (std::vector<float>* counts : {&counts_, &transposed_}) {
        counts->reserve((n_ + 1) * stride_);
        counts->resize(stride_);
    }
    for (std::size_t i = 1; i <= n_; ++i) {
        run_.check_stop();  // with many points, the first touch of so much memory takes seconds
        counts_.resize((i + 1) * stride_);
        transposed_.resize((i + 1) * stride_);
        for (std::size_t j = 1; j <= n_ + 1; ++j) {
            counts_[i * stride_ + j] = count(i - 1, j) + (rank_[i] <= j ? 1.0F : 0.0F);
            transposed_[i * stride_ + j] =
                transposed_[(i - 1) * stride_ + j] + (place_[i] <= j ? 1.0F : 0.0F);
        }
    }
    level_ = 0.3;  // below the level of any points: n D* exceeds 1/2
    begin();
    push_all();
    settle(std::numeric_limits<double>::infinity());
}

PlanarOrder::Ranks PlanarOrder::ranks() const {
    Ranks ranks;
    for (std::size_t i = 1; i <= n_; ++i) ranks.push_back(static_cast<std::uint32_t>(rank_[i] - 1));
    return ranks;
}

std::vector<double> PlanarOrder::points() const {
    const double one = x_[n_ + 1];  // x_{n+1} = 1 / y_{n+1}; both are scaled to 1
    std::vector<double> rows;
    for (std::size_t i = 1; i <= n_; ++i)
        for (const double value : {x_[i] / one, y_[rank_[i]] * one})
            rows.push_back(std::clamp(value, 0.0, one_minus_ulp));
    return rows;
}

// ---------------------------------------------------------------- the order

void PlanarOrder::change(std::size_t i, std::size_t j, float by) {
    counts_[i * stride_ + j] += by;
    transposed_[j * stride_ + i] += by;
}

void PlanarOrder::exchange(const Swap& swap) {
    const auto [by_x, p] = swap;
    auto& along = by_x ? rank_ : place_;
    auto& across = by_x ? place_ : rank_;
    const auto [low, high] = std::minmax(along[p], along[p + 1]);
    const float by = along[p] < along[p + 1] ? -1 : 1;
    for (std::size_t k = low; k < high; ++k) by_x ? change(p, k, by) : change(k, p, by);
    std::swap(along[p], along[p + 1]);
    across[along[p]] = p;
    across[along[p + 1]] = p + 1;
}

/// Whether the swap changes the count of a box on the cycle.
bool PlanarOrder::is_critical(const Swap& swap) const {
    const auto& along = swap.by_x ? rank_ : place_;
    const auto [low, high] = std::minmax(along[swap.at], along[swap.at + 1]);
    return std::ranges::any_of(cycle_, [&, first = low, last = high](const Bound& bound) {
        const std::size_t here = swap.by_x ? bound.i : bound.j;
        const std::size_t there = swap.by_x ? bound.j : bound.i;
        return here == swap.at && there >= first && there < last;
    });
}

std::optional<PlanarOrder::Swap> PlanarOrder::critical_swap(SplitMix64& draws) const {
    const Bound& bound = cycle_[draws.below(cycle_.size())];
    const bool by_x = draws.below(2) == 0;
    const std::size_t at = by_x ? bound.i : bound.j;
    if (at < 1 || at >= n_) return std::nullopt;
    return Swap{by_x, at};
}

// ---------------------------------------------------------------- coordinates and their bounds

double PlanarOrder::value(Node node) const {
    return node == 0 ? x_[n_ + 1] : node <= n_ ? x_[node] : y_[node - n_];
}

void PlanarOrder::put(Node node, double value) {
    if (node == 0) {
        x_[n_ + 1] = value;
        y_[n_ + 1] = 1 / value;
    } else if (node <= n_) {
        x_[node] = value;
    } else {
        y_[node - n_] = value;
    }
}

/// Moves `node` to a bound that `from` sets. Returns true if that closes a cycle of bounds.
bool PlanarOrder::move(Node node, Node from, bool by_order, double value) {
    if (trying_) undo_.push_back({node, this->value(node)});
    put(node, value);
    from_[node] = from;
    by_order_[node] = static_cast<std::uint8_t>(by_order);
    moved_in_[node] = era_;
    push(node);
    Node before = from;
    while (before != node && moved_in_[before] == era_) before = from_[before];
    if (before == node) met_ = node;
    return before == node;
}

void PlanarOrder::push(Node node) {
    if (queued_[node] != 0) return;
    queued_[node] = 1;
    queue_[last_] = node;
    if (++last_ == queue_.size()) last_ = 0;
}

void PlanarOrder::push_all() {
    for (Node node = 0; node <= 2 * n_; ++node) push(node);
}

PlanarOrder::Node PlanarOrder::pop() {
    const Node node = queue_[first_];
    if (++first_ == queue_.size()) first_ = 0;
    queued_[node] = 0;
    return node;
}

/// Starts a new era, in which an entry of from_ is valid only once its node has moved.
void PlanarOrder::begin() {
    if (++era_ != 0) return;
    std::ranges::fill(moved_in_, 0);
    era_ = 1;
}

/// Enforces the bounds of closed boxes that x_i sets for all y. True if that closes a cycle.
bool PlanarOrder::relax_x(std::size_t i, Node node) {
    const double scale = 1 / (static_cast<double>(n_) * x_[i]);
    const float* counts = &counts_[std::min(i, n_) * stride_];
    const std::size_t end = i > n_ ? n_ + 1 : n_ + 2;
    steps_ += end + entry;
    const std::size_t hits =
        beyond(counts + 1, level_, scale, &y_[1], 1 + slack, end - 1, hits_.data());
    for (std::size_t h = 0; h < hits; ++h) {
        const std::size_t j = hits_[h] + std::size_t{1};
        const double least = (static_cast<double>(counts[j]) - level_) * scale;
        if (j <= n_ ? move(static_cast<Node>(n_ + j), node, false, least)
                    : move(0, node, false, 1 / least))
            return true;
    }
    return i > 1 && x_[i - 1] > x_[i] * (1 + slack) &&
           move(static_cast<Node>(i - 1), node, true, x_[i]);
}

/// Enforces the bounds of open boxes that y_j sets for all x. True if that closes a cycle.
bool PlanarOrder::relax_y(std::size_t j, Node node) {
    const double scale = 1 / (static_cast<double>(n_) * y_[j]);
    const float* counts = &transposed_[(j - 1) * stride_];
    const std::size_t end = j > n_ ? n_ + 1 : n_ + 2;
    steps_ += end + entry;
    const std::size_t hits =
        beyond(counts, -level_, -scale, &x_[1], slack - 1, end - 1, hits_.data());
    for (std::size_t h = 0; h < hits; ++h) {
        const std::size_t i = hits_[h] + std::size_t{1};
        const double most = (static_cast<double>(counts[i - 1]) + level_) * scale;
        if (move(static_cast<Node>(i <= n_ ? i : 0), node, false, most)) return true;
    }
    if (j > n_ || y_[j + 1] >= y_[j] * (1 - slack)) return false;
    return j < n_ ? move(static_cast<Node>(n_ + j + 1), node, true, y_[j])
                  : move(0, node, true, 1 / y_[j]);
}

/// Moves coordinates until all bounds hold, a cycle of bounds closes or an attempt is given up.
PlanarOrder::Outcome PlanarOrder::relax() {
    constexpr std::uint64_t turns_at_a_time = 64;
    while (first_ != last_) {
        if (++turns_ % turns_at_a_time == 0) run_.check_stop();
        const Node node = pop();
        const bool closed = node == 0    ? relax_x(n_ + 1, 0) || relax_y(n_ + 1, 0)
                            : node <= n_ ? relax_x(node, node)
                                         : relax_y(node - n_, node);
        if (closed) {
            push(node);
            return Outcome::cycle;
        }
        if (trying_ && undo_.size() > n_) return Outcome::given_up;
    }
    return Outcome::feasible;
}

// ---------------------------------------------------------------- the level

/// Collects the bounds on the cycle through met_.
void PlanarOrder::take_cycle() {
    cycle_.clear();
    Node node = met_;
    do {
        const Node from = from_[node];
        const bool is_x = node >= 1 && node <= n_;
        const bool from_x = from >= 1 && from <= n_;
        if (by_order_[node] == 0) {
            if (is_x)
                cycle_.push_back({true, node - std::size_t{1}, from == 0 ? n_ : from - n_ - 1});
            else if (node > n_)
                cycle_.push_back({false, from == 0 ? n_ : from, node - n_});
            else if (from_x)
                cycle_.push_back({false, from, n_});
            else
                cycle_.push_back({true, n_, from - n_ - 1});
        }
        node = from;
    } while (node != met_);
}

/// Lowest level F at which the cycle's bounds are consistent: the product of (c + F) / n over the
/// open boxes, with counts c, equals that of (c - F) / n over the closed ones.
double PlanarOrder::level_of_cycle() const {
    double low = 0;
    double high = std::numeric_limits<double>::infinity();
    for (const auto& [open, i, j] : cycle_)
        if (!open) high = std::min<double>(high, count(i, j));
    double level = level_ < high ? level_ : high * 0.999999;
    const auto n = static_cast<double>(n_);
    for (int iteration = 0; iteration < 100; ++iteration) {
        double sum = 0;
        double product = 1;
        double slope = 0;
        for (const auto& [open, i, j] : cycle_) {
            const double factor = open ? count(i, j) + level : count(i, j) - level;
            product = open ? product * (factor / n) : product / (factor / n);
            slope += 1 / factor;
            if (product > 1e-100 && product < 1e100) continue;
            sum += logarithm(product);
            product = 1;
        }
        sum += logarithm(product);
        (sum > 0 ? high : low) = level;
        double next = level - sum / slope;
        if (!(next > low && next < high)) next = 0.5 * (low + std::min(high, 2 * n));
        if (std::abs(next - level) <= 1e-15 * level) return next;
        level = next;
    }
    return level;
}

/// Raises the level until the contradictory cycle is consistent.
void PlanarOrder::raise() {
    take_cycle();
    // Because of the slack, a cycle may close that is already consistent; the level rises anyway.
    level_ = std::max(level_of_cycle(), level_ * (1 + 2 * slack));
    begin();
}

/// Raises the level until the bounds have a solution; false above `limit` or if relax() gives up.
bool PlanarOrder::settle(double limit) {
    for (;;) {
        const Outcome outcome = relax();
        if (outcome != Outcome::cycle) return outcome == Outcome::feasible;
        raise();
        if (level_ > limit) return false;
    }
}

/// Lowers the level to the smallest one at which the bounds have a solution.
void PlanarOrder::lower() {
    for (double step = 0.004;; step *= 2) {
        level_ *= std::max(1 - step, 0.5);
        begin();
        push_all();
        const Outcome outcome = relax();
        if (outcome == Outcome::feasible) continue;
        raise();
        settle(std::numeric_limits<double>::infinity());
        return;
    }
}

// ---------------------------------------------------------------- swaps

/// Enforces the bounds that a swap has tightened: those of closed boxes if the changed boxes hold
/// more points, those of open boxes if fewer.
void PlanarOrder::tighten(const Swap& swap, bool more) {
    const auto [by_x, p] = swap;
    if (by_x == more) return push(static_cast<Node>(by_x ? p : n_ + p + 1));
    // In the other two cases, several coordinates of one axis bound one coordinate of the other.
    const auto [low, high] =
        by_x ? std::minmax(rank_[p], rank_[p + 1]) : std::minmax(place_[p], place_[p + 1]);
    const auto n = static_cast<double>(n_);
    const Node node = static_cast<Node>(by_x ? p + 1 : n_ + p);
    double value = this->value(node);
    Node from = node;
    for (std::size_t k = low; k < high; ++k) {
        const double bound =
            by_x ? (count(p, k) + level_) / (n * y_[k + 1]) : (count(k, p) - level_) / (n * x_[k]);
        if (by_x ? bound >= value * (1 - slack) : bound <= value * (1 + slack)) continue;
        value = bound;
        from = static_cast<Node>(by_x ? n_ + k + 1 : k);
    }
    if (from != node) move(node, from, false, value);
}

void PlanarOrder::restore() {
    while (first_ != last_) pop();
    for (; !undo_.empty(); undo_.pop_back()) put(undo_.back().node, undo_.back().value);
}

bool PlanarOrder::attempt(const Swap& swap, double limit, bool critical) {
    const bool hit = is_critical(swap);
    if (critical && !hit) return false;
    const auto& along = swap.by_x ? rank_ : place_;
    const bool more = along[swap.at] > along[swap.at + 1];
    exchange(swap);
    const double before = level_;
    const double of_cycle = hit ? level_of_cycle() : before;
    if (of_cycle > limit || (critical && of_cycle >= before)) {
        exchange(swap);
        return false;
    }
    saved_ = cycle_;
    const double least = std::max(before, of_cycle);
    level_ = least;
    undo_.clear();
    trying_ = true;
    begin();
    tighten(swap, more);
    const bool fits = settle(limit);
    trying_ = false;
    if (!fits) {
        restore();
        exchange(swap);
        level_ = before;
        cycle_ = saved_;
        return false;
    }
    if (level_ == least && of_cycle < before)
        lower();
    else if (level_ == least)
        cycle_ = saved_;
    constexpr double sunk = 1e-3;
    if (x_[n_ + 1] < sunk) normalise();
    return true;
}

/// Rescales so that x_{n+1} and y_{n+1} are 1.
void PlanarOrder::normalise() {
    const double one = x_[n_ + 1];
    for (double& x : x_) x /= one;
    for (double& y : y_) y *= one;
    x_[n_ + 1] = y_[n_ + 1] = 1;
}

}  // namespace stipple
