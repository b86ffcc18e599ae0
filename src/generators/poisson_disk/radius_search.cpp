// SPDX-License-Identifier: MIT
#include "generators/poisson_disk/radius_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.hpp"
#include "core/rng.hpp"

namespace stipple::poisson_disk {
namespace {

/// Searches for the radius at which the darts of one seed leave exactly `count` points.
class Search {
  public:
    Search(const SearchGoal& goal, const Pack& pack, const RunContext& run)
        : goal_(goal), pack_(pack), run_(run), dimension_(goal.dimension), count_(goal.count) {}

    /// Tries several random streams of a seed until one gives exactly the count. If none does,
    /// removes surplus points from the set with the largest radius and adds a note.
    Packing find(std::uint64_t seed) {
        constexpr std::uint64_t streams = 8;
        for (std::uint64_t stream = 0; stream < streams; ++stream)
            if (found_in(stream == 0 ? seed : Rng(seed, stream).bits(0))) return std::move(best_);
        if (best_.radius == 0)
            fail(ErrorKind::limit, "--count: no radius was found that gives {} points", count_);
        trim(seed);
        run_.notify(
            fmt::format("no radius was found that gives exactly {} points; points were removed "
                        "from a larger set, so more would fit",
                        count_));
        return std::move(best_);
    }

  private:
    bool found_in(std::uint64_t seed) {
        constexpr int tries = 60;
        double r = goal_.typical;
        cells_ = 0.9 * r;
        enough_ = 0;
        few_ = std::nextafter(goal_.largest, 2 * goal_.largest);
        for (int i = 0; i < tries && few_ > enough_ * (1 + 1e-9); ++i) {
            const std::uint64_t found = attempt(r, seed);
            if (found == count_) return true;
            r = next(r, found);
        }
        return false;
    }

    /// Makes the points for a radius. Keeps them if their number is `count`, or if it is larger and
    /// the radius is the largest of such sets so far. Returns their number.
    std::uint64_t attempt(double r, std::uint64_t seed) {
        constexpr double typical = 8;  // typical number of tries
        cells_ = std::min(cells_, r);
        const double part = (1 - done_) / typical;
        Rows rows = pack_(r, cells_, seed, run_.stage(done_, done_ + part));
        done_ += part;
        const std::uint64_t found = rows.numbers().size() / dimension_;
        (found >= count_ ? enough_ : few_) = r;
        if (found == count_ || (found > count_ && r > best_.radius)) best_ = {std::move(rows), r};
        return found;
    }

    /// Next radius to try: an estimate, or the middle of the known bounds if that is outside them.
    [[nodiscard]] double next(double r, std::uint64_t found) const {
        const double ratio = static_cast<double>(found) / static_cast<double>(count_);
        const double step = (ratio - 1) / static_cast<double>(dimension_);
        const double guess = r * (1 + std::clamp(step, -0.3, 0.3));
        const double low = enough_ > 0 ? enough_ : few_ / 2;
        return guess > low && guess < few_ ? guess : (low + few_) / 2;
    }

    /// Removes random points, all equally likely, down to the count.
    void trim(std::uint64_t seed) {
        const Rng rng(seed, ~std::uint64_t{0});
        const auto rows = best_.rows.numbers();
        std::vector<double> left(rows.begin(), rows.end());
        for (std::uint64_t i = 0; left.size() > count_ * dimension_; ++i) {
            const auto victim =
                static_cast<std::ptrdiff_t>(rng.below(i, left.size() / dimension_) * dimension_);
            const auto last = left.end() - static_cast<std::ptrdiff_t>(dimension_);
            std::copy(last, left.end(), left.begin() + victim);
            left.erase(last, left.end());
        }
        best_.rows = Rows(std::move(left));
    }

    const SearchGoal& goal_;
    const Pack& pack_;
    const RunContext& run_;
    std::size_t dimension_;
    std::uint64_t count_;
    double cells_ = 0;   ///< radius that cells are made for, if possible the same for all tries
    double enough_ = 0;  ///< last radius that left enough points
    double few_ = 0;     ///< last radius that left too few points
    double done_ = 0;    ///< estimated fraction of the work that is done
    Packing best_;
};

}  // namespace

Packing search_radius(const SearchGoal& goal, std::uint64_t seed, const Pack& pack,
                      const RunContext& run) {
    return Search(goal, pack, run).find(seed);
}

}  // namespace stipple::poisson_disk
