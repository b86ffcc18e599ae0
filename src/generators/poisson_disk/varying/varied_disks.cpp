// SPDX-License-Identifier: MIT
#include "generators/poisson_disk/varying/varied_disks.hpp"

#include <algorithm>
#include <array>
#include <boost/container/static_vector.hpp>
#include <deque>
#include <span>
#include <tuple>
#include <vector>

#include "core/error.hpp"
#include "core/rng.hpp"
#include "core/text.hpp"
#include "generators/poisson_disk/poisson_counts.hpp"
#include "generators/varied_index.hpp"
#include "math/combinatorics/splitmix64.hpp"

namespace stipple::poisson_disk {
namespace {

using Point = std::array<double, 2>;
using Node = RadiusField::Node;

/// Part of the rectangle that may be uncovered.
struct VariedGap {
    Point low;
    Point high;
    std::uint64_t key;  ///< seed of the gap's random numbers
    Node node;          ///< on level 0, the cell that contains the gap; above, the gap itself
};

using Halves = boost::container::static_vector<VariedGap, 2>;

struct TimedDart {
    Disk disk;
    std::uint64_t time;
};

Rows centers_of(const std::vector<Disk>& disks) {
    Rows rows = Rows::unwritten(disks.size(), 2);
    auto out = rows.numbers().begin();
    for (const Disk& disk : disks) out = std::ranges::copy(disk.at, out).out;
    return rows;
}

class VariedSampler {
  public:
    VariedSampler(const BoxSpace& space, const RadiusField& field, double scale, double dart_scale,
                  std::uint64_t seed, const RunContext& run)
        : field_(field),
          scale_(scale),
          dart_scale_(dart_scale),
          keys_(seed),
          run_(run),
          expected_(expected_varied(field, scale)),
          index_(space, scale * field.least(), static_cast<std::size_t>(expected_)) {
        finest_ = space.largest_coordinate() * 0x1p-48;
    }

    Rows sample() {
        const auto corners = field_.corners(field_.root());
        gaps_.push_back({corners[0], corners[1], keys_.bits(0), field_.root()});
        double thrown = 0;  // darts per area r^2 so far
        for (std::uint64_t round = 1; !gaps_.empty(); ++round) {
            // More than before, and at least most_darts on the gap with the largest rate.
            density_ =
                round == 1 ? first_density : std::max(thrown * growth, most_darts / fastest_);
            thrown += density_;
            round_key_ = keys_.bits(round);
            throw_at_gaps();
            decide();
        }
        return centers_of(index_.disks());
    }

  private:
    static constexpr double first_density = 0.4;
    static constexpr double growth = 3;
    static constexpr double most_darts = 1.5;  ///< largest mean number of darts on a gap
    static constexpr std::size_t often = 256;  ///< gaps, or darts, between two checks for a stop

    /// Throws darts at all gaps: makes pending darts, and the gaps for the next round.
    void throw_at_gaps() {
        std::deque<VariedGap> before;
        before.swap(gaps_);
        fastest_ = 0;
        for (; !before.empty(); before.pop_front()) {
            const VariedGap& gap = before.front();
            if (tried_++ % often == 0) report();
            near_.clear();
            gather(gap);
            throw_at(gap, 0);
        }
    }

    /// Mean number of darts on a gap for a density of 1, if r has its minimum all over the gap.
    [[nodiscard]] double rate(const VariedGap& gap) const {
        const double unit = dart_scale_ * field_.least(gap.node);
        return (gap.high[0] - gap.low[0]) / unit * ((gap.high[1] - gap.low[1]) / unit);
    }

    void keep(const VariedGap& gap) {
        fastest_ = std::max(fastest_, rate(gap));
        gaps_.push_back(gap);
    }

    /// Collects the disks that overlap a gap.
    void gather(const VariedGap& gap) {
        const double most = scale_ * field_.most(gap.node);
        index_.any_near(gap.low, gap.high, most, [&](const Disk& disk) {
            if (reaches(disk, gap, most)) near_.push_back(disk);
            return false;
        });
    }

    /// Appends copies of disks near_[first], ..., near_[last - 1] that overlap a gap to near_.
    void narrow(std::size_t first, std::size_t last, const VariedGap& gap) {
        const double most = scale_ * field_.most(gap.node);
        for (std::size_t i = first; i < last; ++i)
            if (reaches(near_[i], gap, most)) near_.push_back(near_[i]);
    }

    /// Throws darts at a gap or its halves; only disks near_[first], ... may overlap the gap.
    void throw_at(const VariedGap& gap, std::size_t first) {
        const double least = field_.least(gap.node);
        if (least == RadiusField::closed) return;
        const double r = scale_ * least;
        const std::size_t last = near_.size();
        for (std::size_t i = first; i < last; ++i)
            if (covers(near_[i], gap, r)) return;
        const double mean = density_ * rate(gap);
        if (mean <= most_darts) {
            throw_darts(gap, first, mean, least);
            return keep(gap);
        }
        if (++divided_ % often == 0) run_.check_stop();
        for (const VariedGap& half : halves_of(gap)) {
            narrow(first, last, half);
            throw_at(half, last);
            near_.resize(last);
        }
    }

    /// Halves of a gap, or the children of its node; empty if the gap is too small to matter.
    [[nodiscard]] Halves halves_of(const VariedGap& gap) const {
        Halves halves;
        if (gap.node.level > 0) {
            for (const Node& node : field_.children(gap.node)) {
                const auto corners = field_.corners(node);
                halves.push_back({corners[0], corners[1], 0, node});
            }
        } else {
            const double width = gap.high[0] - gap.low[0];
            const double height = gap.high[1] - gap.low[1];
            if (std::max(width, height) < finest_) return halves;
            const std::size_t k = width >= height ? 0 : 1;
            halves = {gap, gap};
            halves[0].high[k] = halves[1].low[k] = gap.low[k] + (gap.high[k] - gap.low[k]) / 2;
        }
        for (std::size_t i = 0; i < halves.size(); ++i)
            halves[i].key = SplitMix64(gap.key + i).next();
        return halves;
    }

    /// Throws darts at a gap: `mean` on average if f has its minimum all over the gap, else fewer.
    void throw_darts(const VariedGap& gap, std::size_t first, double mean, double least) {
        SplitMix64 mixer(round_key_ ^ gap.key);
        for (std::uint64_t left = counts_.draw(1, mixer); left > 0; --left) {
            TimedDart dart{};
            for (std::size_t k = 0; k < 2; ++k)
                dart.disk.at[k] = gap.low[k] + to_unit(mixer.next()) * (gap.high[k] - gap.low[k]);
            const double chance = to_unit(mixer.next());
            dart.time = mixer.next();
            if (!(dart.disk.at[0] < gap.high[0] && dart.disk.at[1] < gap.high[1]))
                continue;  // the position was rounded up to a side of the gap
            const double f = gap.node.level == 0
                                 ? field_.least(gap.node)
                                 : field_.within(gap.node, dart.disk.at[0], dart.disk.at[1]);
            if (!(chance * most_darts < mean * (least / f) * (least / f))) continue;
            dart.disk.radius = scale_ * f;
            if (!blocked(dart.disk, first)) pending_.push_back(dart);
        }
    }

    [[nodiscard]] bool blocked(const Disk& disk, std::size_t first) const {
        return std::ranges::any_of(std::span(near_).subspan(first),
                                   [&](const Disk& other) { return index_.too_near(disk, other); });
    }

    /// Whether a disk may be too near to a dart in the gap with a radius of at most `most`.
    [[nodiscard]] bool reaches(const Disk& disk, const VariedGap& gap, double most) const {
        const double r = std::min(disk.radius, most) + finest_;
        double sum = 0;
        for (std::size_t k = 0; k < 2; ++k) {
            const double half = (gap.high[k] - gap.low[k]) / 2;
            const double d = index_.apart(k, disk.at[k], gap.low[k] + half) - half;
            if (d > 0) sum += d * d;
        }
        return sum < r * r;
    }

    /// Whether a disk is too near to every dart on the gap; darts have radii of at least `least`.
    [[nodiscard]] bool covers(const Disk& disk, const VariedGap& gap, double least) const {
        const double r = std::min(disk.radius, least);
        double sum = 0;
        for (std::size_t k = 0; k < 2; ++k) {
            const double half = (gap.high[k] - gap.low[k]) / 2;
            double d = index_.apart(k, disk.at[k], gap.low[k] + half) + half;
            if (index_.torus()) d = std::min(d, index_.side(k) / 2);
            sum += d * d;
        }
        return sum < r * r;
    }

    /// Decides the pending darts in the order of their times.
    void decide() {
        std::ranges::sort(pending_, {},
                          [](const TimedDart& d) { return std::tie(d.time, d.disk.at); });
        for (const TimedDart& d : pending_) {
            if (tried_++ % often == 0) report();
            if (!index_.blocks(d.disk)) index_.add(d.disk);
        }
        pending_.clear();
    }

    void report() const {
        const auto expected = static_cast<std::uint64_t>(expected_);
        run_.tick(std::min<std::uint64_t>(index_.disks().size(), expected), expected);
    }

    const RadiusField& field_;
    double scale_;
    double dart_scale_;
    Rng keys_;
    const RunContext& run_;
    double expected_;
    VariedIndex index_;
    double finest_ = 0;   ///< length below which gaps do not matter
    double density_ = 0;  ///< darts per area r^2, with r from dart_scale_
    double fastest_ = 0;  ///< largest rate of a gap
    std::uint64_t round_key_ = 0;
    PoissonCounts counts_{most_darts, 1};
    std::deque<VariedGap> gaps_;
    std::vector<Disk> near_;
    std::size_t divided_ = 0;
    std::size_t tried_ = 0;
    std::vector<TimedDart> pending_;
};

/// @throws Error(limit) if the minimum radius is too small for the coordinates or the memory limit
void check_size(const BoxSpace& space, const RadiusField& field, double scale,
                const RunContext& run) {
    constexpr double bytes = 300;  // per point
    const double radius = scale * field.least();
    space.check_resolution(radius, "a minimum radius");
    const double points = expected_varied(field, scale);
    const std::string what = fmt::format("a minimum radius of {}, with about {:.3g} points,",
                                         format_number(radius), points);
    run.need_memory(bytes * points, what);
    if (points >= 0x1p31)
        fail(ErrorKind::limit, "{} is too small; at most 2^31 points are possible", what);
}

}  // namespace

double expected_varied(const RadiusField& field, double scale) {
    const double unit = scale * field.unit();
    return saturated_density[2] * field.darts() / unit / unit + 1;
}

Rows varied_disks(const BoxSpace& space, const RadiusField& field, double scale, double dart_scale,
                  std::uint64_t seed, const RunContext& run) {
    check_size(space, field, scale, run);
    return VariedSampler(space, field, scale, dart_scale, seed, run).sample();
}

Rows spread_varied(std::span<const double> rows, const BoxSpace& space, const RadiusField& field,
                   double scale, const RunContext& run) {
    constexpr double step = 0.8408964152537145;  // 2^(-1/4)
    constexpr std::size_t often = 1024;
    std::vector<Disk> left;
    for (std::size_t i = 0; i < rows.size(); i += 2)
        left.push_back({{rows[i], rows[i + 1]}, field.at(rows[i], rows[i + 1])});
    std::vector<Disk> chosen;
    std::size_t asked = 0;
    for (double s = space.largest_distance() / field.least(); !left.empty(); s *= step) {
        VariedIndex index(space, s * field.least(), chosen.size());
        for (std::size_t i = 0; i < chosen.size(); ++i) {
            if (i % often == 0) run.check_stop();
            index.add({chosen[i].at, s * chosen[i].radius});
        }
        std::erase_if(left, [&](const Disk& disk) {
            if (asked++ % often == 0) run.tick(chosen.size(), rows.size() / 2);
            const Disk scaled{disk.at, s * disk.radius};
            // Once s <= scale, none of the remaining points is too near.
            if (s > scale && index.blocks(scaled)) return false;
            index.add(scaled);
            chosen.push_back(disk);
            return true;
        });
    }
    return centers_of(chosen);
}

}  // namespace stipple::poisson_disk
