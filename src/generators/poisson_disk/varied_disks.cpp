// SPDX-License-Identifier: MIT
#include "generators/poisson_disk/varied_disks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <vector>

#include "core/error.hpp"
#include "core/rng.hpp"
#include "core/text.hpp"
#include "generators/poisson_disk/disk_shower.hpp"
#include "generators/varied_index.hpp"
#include "math/functions/exponential.hpp"
#include "math/functions/splitmix64.hpp"

namespace stipple {
namespace {

using Point = std::array<double, 2>;
using Node = RadiusField::Node;

/// Points to integral dx / r^2, when no place is left, and a little more.
constexpr double jammed = 0.70;

/// A part of the rectangle in which something may be uncovered yet.
struct Window {
    Point low;
    Point high;
    std::uint64_t key;  ///< its own, whoever asks
    Node node;          ///< of level 0: a part of this cell; else just this node
};

struct Candidate {
    Disk disk;
    std::uint64_t time;
};

class Rain {
  public:
    Rain(const BoxSpace& space, const RadiusField& field, double scale, double dart_scale,
         std::uint64_t seed, const RunContext& run)
        : field_(field),
          scale_(scale),
          dart_scale_(dart_scale),
          keys_(seed),
          run_(run),
          expected_(expected_varied(field, scale)),
          index_(space, scale * field.least(), static_cast<std::size_t>(expected_)),
          slots_(slot_count) {
        finest_ = space.largest_coordinate() * 0x1p-48;
        double none = exponential(-most_darts);
        double sum = none;
        for (std::size_t k = 1; sum < one_minus_ulp && k < 40; ++k) {
            at_most_.push_back(sum);
            none *= most_darts / static_cast<double>(k);
            sum += none;
        }
    }

    Rows fill() {
        const auto corners = field_.corners(field_.root());
        windows_.push_back({corners[0], corners[1], keys_.bits(0), field_.root()});
        double fallen = 0;  // darts to r^2
        for (std::uint64_t shower = 1; !windows_.empty(); ++shower) {
            // As hard as before and harder, so that the fastest window gets something at least.
            density_ =
                shower == 1 ? first_density : std::max(fallen * growth, most_darts / fastest_);
            fallen += density_;
            shower_key_ = keys_.bits(shower);
            fall();
            settle();
        }
        Rows rows = Rows::unwritten(2 * index_.disks().size());
        auto out = rows.numbers().begin();
        for (const Disk& disk : index_.disks()) out = std::ranges::copy(disk.at, out).out;
        return rows;
    }

  private:
    static constexpr double first_density = 0.4;
    static constexpr double growth = 3;
    static constexpr double most_darts = 1.5;  ///< mean on a window
    static constexpr std::size_t slot_count = 1024;
    static constexpr double together = 1.5;    ///< width of a group of windows, in radii
    static constexpr std::size_t often = 256;  ///< windows between two questions for a stop

    /// Rain on all windows: candidates, and the windows for the next shower. Neighbours in the list
    /// are neighbours in the rectangle, and share the search for disks.
    void fall() {
        std::deque<Window> before;
        before.swap(windows_);
        fastest_ = 0;
        while (!before.empty()) {
            if (groups_++ % often == 0) report();
            std::size_t count = 1;
            if (is_spared(before[0]))
                keep(before[0]);
            else
                count = fall_on_group(before);
            before.erase(before.begin(), before.begin() + static_cast<std::ptrdiff_t>(count));
        }
    }

    /// Rain on the first windows that are near together; how many these are.
    std::size_t fall_on_group(const std::deque<Window>& windows) {
        Window group = windows[0];
        double most = scale_ * field_.most(group.node);
        const double widest = together * scale_ * field_.least(group.node);
        std::size_t count = 1;
        for (; count < windows.size() && include(windows[count], widest, group); ++count)
            most = std::max(most, scale_ * field_.most(windows[count].node));
        gather(group, most);
        const std::size_t found = near_.size();
        for (std::size_t w = 0; w < count; ++w) {
            if (count > 1) narrow(0, found, windows[w]);
            fall_on(windows[w], count > 1 ? found : 0);
            near_.resize(found);
        }
        return count;
    }

    /// Darts on a window to a density of 1, where r is the least all over it.
    [[nodiscard]] double rate(const Window& window) const {
        const double unit = dart_scale_ * field_.least(window.node);
        return (window.high[0] - window.low[0]) / unit * ((window.high[1] - window.low[1]) / unit);
    }

    void keep(const Window& window) {
        fastest_ = std::max(fastest_, rate(window));
        windows_.push_back(window);
    }

    /// Whether few darts are due on a window, and none of them falls: then it stays as it is, and
    /// nothing has to be known of it.
    [[nodiscard]] bool is_spared(const Window& window) const {
        const double mean = density_ * rate(window);
        if (mean > most_darts / 16) return false;
        SplitMix64 mixer(shower_key_ ^ window.key);
        const double u = to_unit(mixer.next());
        for (std::size_t i = 0; i < at_most_.size() && u >= at_most_[i]; ++i) {
            for (std::size_t k = 0; k < 2; ++k) mixer.next();
            if (to_unit(mixer.next()) * most_darts < mean) return false;
            mixer.next();
        }
        return true;
    }

    /// Makes the group hold the window, too, unless that makes it wider than allowed.
    static bool include(const Window& window, double widest, Window& group) {
        Window larger = group;
        for (std::size_t k = 0; k < 2; ++k) {
            larger.low[k] = std::min(group.low[k], window.low[k]);
            larger.high[k] = std::max(group.high[k], window.high[k]);
            if (larger.high[k] - larger.low[k] > widest) return false;
        }
        group = larger;
        return true;
    }

    void gather(const Window& window, double most) {
        near_.clear();
        index_.any_near(window.low, window.high, most, [&](const Disk& disk) {
            if (reaches(disk, window, most)) near_.push_back(disk);
            return false;
        });
    }

    /// Adds to near_ those from the first up to the last that reach a window.
    void narrow(std::size_t first, std::size_t last, const Window& window) {
        const double most = scale_ * field_.most(window.node);
        for (std::size_t i = first; i < last; ++i)
            if (reaches(near_[i], window, most)) near_.push_back(near_[i]);
    }

    /// Rain on a window, or its halves, where only disks of near_ from the `first` on may reach it.
    void fall_on(const Window& window, std::size_t first) {
        const double least = field_.least(window.node);
        if (least == RadiusField::closed) return;
        const double r = scale_ * least;
        const std::size_t last = near_.size();
        for (std::size_t i = first; i < last; ++i)
            if (covers(near_[i], window, r)) return;
        const double mean = density_ * rate(window);
        if (mean <= most_darts) {
            throw_darts(window, first, mean, least);
            return keep(window);
        }
        std::array<Window, 2> parts;
        const std::size_t count = divide(window, parts);
        if (++divided_ % often == 0) run_.check_stop();
        for (std::size_t p = 0; p < count; ++p) {
            narrow(first, last, parts[p]);
            fall_on(parts[p], last);
            near_.resize(last);
        }
    }

    /// Halves of a window, or what its node joins; none of one that is too small to matter.
    std::size_t divide(const Window& window, std::array<Window, 2>& parts) const {
        std::size_t count = 0;
        if (window.node.level > 0) {
            for (const Node& node : field_.children(window.node)) {
                const auto corners = field_.corners(node);
                parts[count] = {corners[0], corners[1], SplitMix64(window.key + count).next(),
                                node};
                ++count;
            }
            return count;
        }
        const double width = window.high[0] - window.low[0];
        const double height = window.high[1] - window.low[1];
        if (std::max(width, height) < finest_) return 0;
        const std::size_t k = width >= height ? 0 : 1;
        const double middle = window.low[k] + (window.high[k] - window.low[k]) / 2;
        parts = {window, window};
        parts[0].high[k] = parts[1].low[k] = middle;
        for (Window& part : parts) part.key = SplitMix64(window.key + count++).next();
        return count;
    }

    /// Darts of the window: `mean` of them where f is the least all over it, fewer where it is
    /// more.
    void throw_darts(const Window& window, std::size_t first, double mean, double least) {
        SplitMix64 mixer(shower_key_ ^ window.key);
        const double u = to_unit(mixer.next());
        for (std::size_t i = 0; i < at_most_.size() && u >= at_most_[i]; ++i) {
            Candidate dart{};
            for (std::size_t k = 0; k < 2; ++k)
                dart.disk.at[k] =
                    window.low[k] + to_unit(mixer.next()) * (window.high[k] - window.low[k]);
            const double chance = to_unit(mixer.next());
            dart.time = mixer.next();
            if (!(dart.disk.at[0] < window.high[0] && dart.disk.at[1] < window.high[1]))
                continue;  // rounded up
            const double f = window.node.level == 0
                                 ? field_.least(window.node)
                                 : field_.within(window.node, dart.disk.at[0], dart.disk.at[1]);
            if (!(chance * most_darts < mean * (least / f) * (least / f))) continue;
            dart.disk.radius = scale_ * f;
            if (!blocked(dart.disk, first)) slots_[dart.time >> 54].push_back(dart);
        }
    }

    [[nodiscard]] bool blocked(const Disk& disk, std::size_t first) const {
        for (std::size_t i = first; i < near_.size(); ++i) {
            const double r = std::min(disk.radius, near_[i].radius);
            if (index_.squared(disk.at, near_[i].at) < r * r) return true;
        }
        return false;
    }

    /// Whether a dart on the window could be too near, where no radius is above `most`.
    [[nodiscard]] bool reaches(const Disk& disk, const Window& window, double most) const {
        const double r = std::min(disk.radius, most) + finest_;
        double sum = 0;
        for (std::size_t k = 0; k < 2; ++k) {
            const double half = (window.high[k] - window.low[k]) / 2;
            const double d = index_.apart(k, disk.at[k], window.low[k] + half) - half;
            if (d > 0) sum += d * d;
        }
        return sum < r * r;
    }

    /// Whether no dart on the window could keep the rule, where no radius is below `least`.
    [[nodiscard]] bool covers(const Disk& disk, const Window& window, double least) const {
        const double r = std::min(disk.radius, least);
        double sum = 0;
        for (std::size_t k = 0; k < 2; ++k) {
            const double half = (window.high[k] - window.low[k]) / 2;
            double d = index_.apart(k, disk.at[k], window.low[k] + half) + half;
            if (index_.torus()) d = std::min(d, index_.side(k) / 2);
            sum += d * d;
        }
        return sum < r * r;
    }

    /// Candidates come in the order of their times.
    void settle() {
        for (std::vector<Candidate>& slot : slots_) {
            std::ranges::sort(slot, [](const Candidate& a, const Candidate& b) {
                return a.time != b.time ? a.time < b.time : a.disk.at < b.disk.at;
            });
            for (const Candidate& c : slot)
                if (!index_.blocks(c.disk)) index_.add(c.disk);
            slot.clear();
            report();
        }
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
    double finest_ = 0;   ///< a length that nobody can tell from none
    double density_ = 0;  ///< darts to r^2, r by dart_scale_
    double fastest_ = 0;  ///< the largest rate of the windows
    std::uint64_t shower_key_ = 0;
    std::vector<double> at_most_;  ///< probability of at most so many darts, their mean most_darts
    std::deque<Window> windows_;
    std::vector<Disk> near_;
    std::size_t divided_ = 0;
    std::size_t groups_ = 0;
    std::vector<std::vector<Candidate>> slots_;  ///< by the first bits of their times
};

/// @throws Error(limit) when the least radius is too small for the coordinates, or the memory.
void check_size(const BoxSpace& space, const RadiusField& field, double scale,
                const RunContext& run) {
    constexpr double bytes = 300;  // to a point
    const double radius = scale * field.least();
    space.check_resolution(radius, "a least radius");
    const double points = expected_varied(field, scale);
    const std::string what = fmt::format("a least radius of {}, with about {:.3g} points,",
                                         format_number(radius), points);
    run.need_memory(bytes * points, what);
    if (points >= 0x1p31)
        fail(ErrorKind::limit, "{} is too small; at most 2^31 points are possible", what);
}

}  // namespace

double expected_varied(const RadiusField& field, double scale) {
    return jammed * field.darts() / scale / scale + 1;
}

Rows varied_disks(const BoxSpace& space, const RadiusField& field, double scale, double dart_scale,
                  std::uint64_t seed, const RunContext& run) {
    check_size(space, field, scale, run);
    return Rain(space, field, scale, dart_scale, seed, run).fill();
}

Rows spread_varied(std::span<const double> rows, const BoxSpace& space, const RadiusField& field,
                   double scale, const RunContext& run) {
    constexpr double step = 0.8408964152537145;  // 2^(-1/4)
    constexpr std::size_t often = 1024;
    std::vector<Disk> left;
    for (std::size_t i = 0; i < rows.size(); i += 2)
        left.push_back({{rows[i], rows[i + 1]}, field.at(rows[i], rows[i + 1])});
    std::vector<Disk> chosen;
    for (double s = space.largest_distance() / field.least(); !left.empty(); s *= step) {
        const bool all = s <= scale;  // nothing that is left is too near
        VariedIndex index(space, s * field.least(), chosen.size());
        for (std::size_t i = 0; i < chosen.size(); ++i) {
            if (i % often == 0) run.check_stop();
            index.add({chosen[i].at, s * chosen[i].radius});
        }
        std::size_t kept = 0;
        for (std::size_t i = 0; i < left.size(); ++i) {
            if (i % often == 0) run.tick(chosen.size(), rows.size() / 2);
            const Disk scaled{left[i].at, s * left[i].radius};
            if (!all && index.blocks(scaled)) {
                left[kept++] = left[i];
                continue;
            }
            if (!all) index.add(scaled);
            chosen.push_back(left[i]);
        }
        left.resize(kept);
    }
    Rows out = Rows::unwritten(rows.size());
    auto to = out.numbers().begin();
    for (const Disk& disk : chosen) to = std::ranges::copy(disk.at, to).out;
    return out;
}

}  // namespace stipple
