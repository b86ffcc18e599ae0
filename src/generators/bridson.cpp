// SPDX-License-Identifier: MIT
#include "generators/bridson.hpp"

#include "core/error.hpp"
#include "core/text.hpp"
#include "math/spaced_points.hpp"

namespace stipple {
namespace {

/// Numbers 0, 1, 2, ... of a stream, made in batches.
class Draws {
  public:
    explicit Draws(const Rng& rng) : rng_(rng) {}
    double operator()() {
        if (used_ == batch_.size()) {
            rng_.fill(next_, batch_);
            next_ += batch_.size();
            used_ = 0;
        }
        return batch_[used_++];
    }
    /// One of 0, ..., size - 1.
    std::size_t below(std::size_t size) {
        return static_cast<std::size_t>((*this)() * static_cast<double>(size));
    }

  private:
    Rng rng_;
    std::array<double, 256> batch_{};
    std::size_t used_ = batch_.size();
    std::uint64_t next_ = 0;
};

template <std::size_t D>
class Bridson {
  public:
    using Point = typename SpacedPoints<D>::Point;

    Bridson(const DiskSpace& space, double radius, const Rng& rng, const RunContext& run)
        : space_(space),
          radius_(radius),
          run_(run),
          draw_(rng),
          points_(space.box, space.torus, radius, run),
          expected_(static_cast<std::uint64_t>(expected_disks(space, radius)) + 1) {}

    std::vector<double> fill() {
        start();
        while (!active_.empty()) grow();
        run_.tick(1, 1);
        return points_.take();
    }

  private:
    void add(const Point& p) {
        active_.push_back(static_cast<std::uint32_t>(points_.count()));
        points_.add(p);
    }

    void start() {
        Point p;
        do {
            for (std::size_t k = 0; k < D; ++k)
                p[k] = space_.box.low[k] + draw_() * space_.box.extent(k);
        } while (!inside(p));
        add(p);
    }

    /// Whether rounding has kept p off the upper faces.
    bool inside(const Point& p) const {
        for (std::size_t k = 0; k < D; ++k)
            if (!(p[k] >= space_.box.low[k] && p[k] < space_.box.high[k])) return false;
        return true;
    }

    /// Throws candidates around an active point until one fits or the attempts are used up.
    void grow() {
        const std::size_t slot = draw_.below(active_.size());
        const double* center = points_[active_[slot]];
        // Near the walls and in a box smaller than the shell few throws may hit the shell at all.
        std::int64_t misses = 8 * space_.attempts;
        for (std::int64_t left = space_.attempts; left > 0 && misses > 0;) {
            if (++throws_ % 8192 == 0) run_.tick(std::min(points_.count(), expected_), expected_);
            Point p;
            if (!throw_near(center, p)) {
                --misses;
                continue;
            }
            if (points_.fits(p)) return add(p);
            --left;
        }
        active_[slot] = active_.back();
        active_.pop_back();
    }

    /// Uniform in the part of the cube [-2r, 2r] about the center that is in the box, or on the
    /// torus nearest to the center. False when it is outside the shell.
    bool throw_near(const double* center, Point& p) {
        double squared = 0;
        for (std::size_t k = 0; k < D; ++k) {
            const double low = space_.box.low[k];
            const double high = space_.box.high[k];
            const double side = space_.box.extent(k);
            const double most = space_.torus ? std::min(2 * radius_, side / 2) : 2 * radius_;
            const double from = space_.torus ? -most : std::max(-most, low - center[k]);
            const double to = space_.torus ? most : std::min(most, high - center[k]);
            const double step = from + draw_() * (to - from);
            squared += step * step;
            p[k] = center[k] + step;
            if (space_.torus && p[k] < low) p[k] += side;
            if (space_.torus && p[k] >= high) p[k] -= side;
        }
        return squared >= radius_ * radius_ && squared <= 4 * radius_ * radius_ && inside(p);
    }

    const DiskSpace& space_;
    double radius_;
    const RunContext& run_;
    Draws draw_;
    SpacedPoints<D> points_;
    std::vector<std::uint32_t> active_;
    std::uint64_t expected_;
    std::uint64_t throws_ = 0;
};

/// @throws Error(limit) when the radius is so small that rounding moves points by more than a
/// thousandth of it.
void check_resolution(const Box& box, double radius) {
    double largest = 0;
    for (std::size_t k = 0; k < box.dimension(); ++k)
        largest = std::max({largest, std::abs(box.low[k]), std::abs(box.high[k])});
    const double finest = largest * 0x1p-52 * 1024;
    if (radius < finest)
        fail(ErrorKind::limit,
             "a radius of {} is too fine for coordinates near {}, which tell {:.5g} from each "
             "other well",
             format_number(radius), format_number(largest), finest);
}

/// @throws Error(limit) when the points for this radius do not fit the memory, or the indices.
void check_size(const DiskSpace& space, double radius, const RunContext& run) {
    double cells = 1;
    for (const double along : cells_along(space.box, radius)) cells *= along;
    const double points = expected_disks(space, radius);
    // The grid, the points and their copy, the active list.
    const double bytes = cells * 4 + points * (16 * static_cast<double>(space.box.dimension()) + 8);
    run.need_memory(bytes, fmt::format("a radius of {}, with about {:.3g} points,",
                                       format_number(radius), points));
    if (cells >= 0xffff'fffe)
        fail(ErrorKind::limit,
             "a radius of {} makes about {:.3g} points, and {:.3g} cells to find them by; at most "
             "2^32 cells are possible",
             format_number(radius), points, cells);
}

}  // namespace

double expected_disks(const DiskSpace& space, double radius) {
    double places = 0.75;
    for (std::size_t k = 0; k < space.box.dimension(); ++k) {
        const double along = space.box.extent(k) / radius;
        places *= space.torus ? std::max(along, 1.0) : along + 1;
    }
    return places + 1;
}

std::vector<double> bridson(const DiskSpace& space, double radius, const Rng& rng,
                            const RunContext& run) {
    check_resolution(space.box, radius);
    check_size(space, radius, run);
    return space.box.dimension() == 2 ? Bridson<2>(space, radius, rng, run).fill()
                                      : Bridson<3>(space, radius, rng, run).fill();
}

}  // namespace stipple
