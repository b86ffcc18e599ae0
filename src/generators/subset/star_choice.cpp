// SPDX-License-Identifier: MIT
//
// Chooses n of N points with a small star discrepancy, by exchanges of chosen points for others
// that lower it. Every box [0, c) or [0, c] bounds the discrepancy of every subset from below:
//
//     D*(S)  >=  | #(S in the box) / n  -  volume |,
//
// so the worst boxes of all measured subsets are kept, each with its points as bits. They rule out
// most exchanges quickly, for all N possible replacements of a member at once. The most promising
// of the remaining exchanges are measured by the exact search. The best is made if it improves the
// set; the worst boxes of the other resulting sets are kept, too. If no exchange remains, some
// random ones are made that keep all boxes nearly as good. The search continues from there, or from
// the best set if that leads nowhere.
//
// Cost    the measurements: in 6-D 2 to 50 ms each for 30 to 240 points. Some 2^12 N / 8 bytes.
// Promise depends only on the points, the start, the seed and the number of measurements.
// Beware  the exact search bounds cells by the C library's logarithms. Values do not depend on
//         them, but which of several equally bad boxes is kept may differ between machines.
// Source  F. Clement, C. Doerr, L. Paquete, "Heuristic approaches to obtain low-discrepancy point
//         sets via subset selection", J. Complexity 83 (2024) 101852, arXiv:2306.15276 (exchanges
//         that break the worst box). Keeping boxes is this program's own idea.

#include "generators/subset/choice.hpp"

#include <algorithm>
#include <bit>
#include <optional>

#include <fmt/format.h>

#include "core/parallel.hpp"
#include "core/rng.hpp"
#include "core/text.hpp"
#include "math/discrepancy/coordinate_ascent.hpp"
#include "math/discrepancy/star/search.hpp"

namespace stipple::generators::subset {
namespace {

using discrepancy::Side;

/// A set of rows, one bit each.
using Bits = std::vector<std::uint64_t>;

bool has(const Bits& bits, std::size_t i) { return (bits[i / 64] >> (i % 64) & 1) != 0; }
void flip(Bits& bits, std::size_t i) { bits[i / 64] ^= std::uint64_t{1} << (i % 64); }

/// Star discrepancy of a set, and its worst box.
struct Measured {
    double value = 1;
    bool exact = false;  ///< false: `value` may be only a lower bound
    Side side = Side::closed;
    std::vector<double> corner = {};
};

bool is_inside(std::span<const double> x, const Measured& box) {
    for (std::size_t k = 0; k < x.size(); ++k)
        if (box.side == Side::closed ? x[k] > box.corner[k] : x[k] >= box.corner[k]) return false;
    return true;
}

PointSet set_of(const PointSet& points, const Rows& rows) {
    PointSet set(rows.size(), points.dimension());
    for (std::size_t s = 0; s < rows.size(); ++s)
        std::ranges::copy(points[rows[s]], set[s].begin());
    return set;
}

/// Coordinate comparisons allowed for one measurement; if it needs more, it gives a lower bound.
constexpr std::uint64_t work_of_measure = std::uint64_t{1} << 30;

/// Finds the worst box, or stops at a box whose value is at least `enough`.
Measured measure(const PointSet& set, double enough, const RunContext& run) {
    const auto grid = discrepancy::box_grid(set, discrepancy::Family::anchored, run);
    const auto told = [](const discrepancy::WorstBox& worst, bool exact) {
        return Measured{worst.value(), exact, worst.closed() ? Side::closed : Side::open,
                        worst.corner(&discrepancy::Interval::upper)};
    };
    discrepancy::WorstBox worst(grid);
    if (grid.dimension() > 2) {
        const std::uint64_t some = 2000 * set.count() * set.dimension();
        worst = discrepancy::ascend(grid, {.work = some}, run).worst;
        if (worst.value() >= enough) return told(worst, false);
    }
    const auto found =
        discrepancy::star::sweep_or_search(grid, std::move(worst), {.work = work_of_measure}, run);
    run.check_stop();
    return told(found.worst, found.ending == discrepancy::Ending::complete);
}

/// Worst boxes of the sets measured so far, with their excess for the current set.
class BadBoxes {
  public:
    BadBoxes(const PointSet& points, std::size_t n, const RunContext& run)
        : points_(points),
          n_(static_cast<double>(n)),
          words_((points.count() + 63) / 64),
          run_(run) {}

    void add(const Measured& found, const Bits& set) {
        constexpr std::size_t most = 4096;
        if (boxes_.size() == most) forget();
        Box box{found.side, 1, Bits(words_)};
        for (const double c : found.corner) box.volume *= c;
        for (std::size_t i = 0; i < points_.count(); ++i)
            if (is_inside(points_[i], found)) flip(box.members, i);
        count(box, set);
        boxes_.push_back(std::move(box));
    }

    /// Makes another set the current one: counts its points in all boxes.
    void take(const Bits& set) {
        for (Box& box : boxes_) count(box, set);
    }

    /// Selects the boxes whose excess may become `most` or more by one exchange.
    void look_at(double most) {
        critical_.clear();
        for (std::size_t b = 0; b < boxes_.size(); ++b)
            if (boxes_[b].excess + 1 >= most) {
                critical_.push_back(b);
                boxes_[b].used = ++clock_;
            }
    }

    /// Points that may replace point i so that the excess of each selected box stays below `most`.
    [[nodiscard]] Bits allowed(const Bits& set, std::size_t i, double most) const {
        Bits points(words_);
        for (std::size_t w = 0; w < words_; ++w) points[w] = ~set[w];
        if (points_.count() % 64 != 0)
            points.back() &= (std::uint64_t{1} << (points_.count() % 64)) - 1;
        for (const std::size_t b : critical_) {
            run_.check_stop();
            const Box& box = boxes_[b];
            const bool closed = box.side == Side::closed;
            const double change = has(box.members, i) ? (closed ? -1 : 1) : 0;
            const double least = box.excess + change - (closed ? 0 : 1);
            if (least >= most) return Bits(words_);
            if (least + 1 < most) continue;
            // The new point must be outside a too full closed box and inside a too empty open one.
            for (std::size_t w = 0; w < words_; ++w)
                points[w] &= closed ? ~box.members[w] : box.members[w];
        }
        return points;
    }

    /// Largest excess of the selected boxes after i is exchanged for j.
    [[nodiscard]] double excess_after(std::size_t i, std::size_t j) const {
        double most = 0;
        for (const std::size_t b : critical_) {
            const Box& box = boxes_[b];
            const double change = (has(box.members, j) ? 1 : 0) - (has(box.members, i) ? 1 : 0);
            most = std::max(most, box.excess + (box.side == Side::closed ? change : -change));
        }
        return most;
    }

  private:
    struct Box {
        Side side;
        double volume;
        Bits members;
        double excess = 0;  ///< signed discrepancy of the current set, times n
        std::uint64_t used = 0;
    };

    void count(Box& box, const Bits& set) const {
        run_.check_stop();
        int inside = 0;
        for (std::size_t w = 0; w < words_; ++w) inside += std::popcount(box.members[w] & set[w]);
        const double excess = inside - n_ * box.volume;
        box.excess = box.side == Side::closed ? excess : -excess;
    }

    /// Drops the half of the boxes that were selected least recently.
    void forget() {
        std::ranges::stable_sort(boxes_, std::ranges::greater(), &Box::used);
        boxes_.resize(boxes_.size() / 2);
    }

    const PointSet& points_;
    double n_;
    std::size_t words_;
    const RunContext& run_;
    std::vector<Box> boxes_;
    std::vector<std::size_t> critical_;
    std::uint64_t clock_ = 0;
};

struct Exchange {
    std::size_t place;  ///< index in `members` of the row to remove
    std::size_t row;    ///< row to insert
    double excess;      ///< largest excess in the selected boxes after the exchange
};

struct Present {
    Rows members;
    double value = 1;
};

class StarExchanges {
  public:
    StarExchanges(const PointSet& points, Rows start, std::uint64_t measures, std::uint64_t seed,
                  const RunContext& run)
        : points_(points),
          n_(start.size()),
          measures_(measures),
          rng_(seed, 2),
          run_(run),
          boxes_(points, n_, run),
          now_{std::move(start)} {}

    Rows search() {
        settle();
        best_ = now_;
        while (done_ < measures_) {
            if (step()) continue;
            if (now_.value < best_.value)
                best_ = now_;
            else
                now_ = best_;
            perturb();
        }
        Present& found = now_.value < best_.value ? now_ : best_;
        std::ranges::sort(found.members);
        return found.members;
    }

  private:
    static constexpr std::size_t at_once = 8;

    /// Measures the current set and counts its points in the boxes.
    void settle() {
        in_.assign((points_.count() + 63) / 64, 0);
        for (const std::size_t i : now_.members) flip(in_, i);
        boxes_.take(in_);
        const Measured found = measure(set_of(points_, now_.members), 2, silent(run_));
        ++done_;
        now_.value = found.value;
        boxes_.add(found, in_);
    }

    /// Tries promising exchanges; makes the best if it lowers the value. False if there are none.
    bool step() {
        const double bound = now_.value * static_cast<double>(n_) * (1 - 1e-12);
        boxes_.look_at(bound);
        const std::vector<Exchange> tries = promising(bound);
        if (tries.empty()) return false;
        std::vector<Measured> found(tries.size());
        for_each_block(silent(run_), tries.size(), 1, [&](const Block& block) {
            Rows members = now_.members;
            members[tries[block.index].place] = tries[block.index].row;
            RunContext one = silent(run_);
            one.threads = 1;
            found[block.index] = measure(set_of(points_, members), now_.value, one);
        });
        done_ += tries.size();
        std::optional<std::size_t> best;
        for (std::size_t t = 0; t < tries.size(); ++t) {
            boxes_.add(found[t], in_);
            if (found[t].exact && found[t].value < (best ? found[*best].value : now_.value))
                best = t;
        }
        if (best) make(tries[*best], found[*best].value);
        const double least = std::min(now_.value, best_.value);
        run_.tick(std::min(done_, measures_), measures_ + 1,
                  fmt::format("star discrepancy {:.6g}", least));
        return true;
    }

    void make(const Exchange& exchange, double value) {
        flip(in_, now_.members[exchange.place]);
        flip(in_, exchange.row);
        now_.members[exchange.place] = exchange.row;
        now_.value = value;
        boxes_.take(in_);
    }

    /// Some exchanges that no box rules out: those with the least excess in the boxes.
    std::vector<Exchange> promising(double bound) {
        constexpr std::size_t some = 16 * at_once;
        std::vector<Exchange> found;
        const std::size_t from = draw(n_);
        for (std::size_t s = 0; s < n_ && found.size() < some; ++s) {
            const std::size_t place = (from + s) % n_;
            const std::size_t i = now_.members[place];
            const Bits points = boxes_.allowed(in_, i, bound);
            for (const std::size_t j : drawn_from(points, 4))
                found.push_back({place, j, boxes_.excess_after(i, j)});
        }
        std::ranges::stable_sort(found, {}, &Exchange::excess);
        if (found.size() > at_once) found.resize(at_once);
        return found;
    }

    /// Up to `most` of the rows, beginning at a random position.
    std::vector<std::size_t> drawn_from(const Bits& rows, std::size_t most) {
        std::vector<std::size_t> drawn;
        const std::size_t from = draw(rows.size());
        for (std::size_t s = 0; s < rows.size() && drawn.size() < most; ++s) {
            const std::size_t w = (from + s) % rows.size();
            for (std::uint64_t left = rows[w]; left != 0 && drawn.size() < most; left &= left - 1)
                drawn.push_back(w * 64 + static_cast<std::size_t>(std::countr_zero(left)));
        }
        return drawn;
    }

    /// Makes some random exchanges, if possible without making a box much worse than the worst one.
    void perturb() {
        const std::size_t some = 1 + draw(3);
        const double bound = now_.value * static_cast<double>(n_) + 0.5;
        in_.assign((points_.count() + 63) / 64, 0);
        for (const std::size_t i : now_.members) flip(in_, i);
        for (std::size_t k = 0; k < some; ++k) {
            boxes_.take(in_);
            boxes_.look_at(bound);
            const std::size_t place = draw(n_);
            const Bits points = boxes_.allowed(in_, now_.members[place], bound);
            const auto drawn = drawn_from(points, 1);
            std::size_t j = drawn.empty() ? draw(points_.count()) : drawn.front();
            if (has(in_, j)) continue;
            flip(in_, now_.members[place]);
            flip(in_, j);
            now_.members[place] = j;
        }
        settle();
    }

    std::size_t draw(std::size_t below) {
        return static_cast<std::size_t>(rng_.below(drawn_++, below));
    }

    const PointSet& points_;
    std::size_t n_;
    std::uint64_t measures_;
    Rng rng_;
    const RunContext& run_;
    std::uint64_t drawn_ = 0;
    std::uint64_t done_ = 0;  ///< number of measured sets
    BadBoxes boxes_;
    Bits in_;  ///< members of the current set
    Present now_;
    Present best_;
};

/// Sets that together hold all points; the worst one trades with the others.
class StarTrades {
  public:
    StarTrades(const PointSet& points, std::vector<Rows>& sets, std::uint64_t seed,
               const RunContext& run)
        : points_(points), sets_(sets), rng_(seed, 3), quiet_(silent(run)) {
        for (const Rows& set : sets) found_.push_back(measured(set, 2));
    }

    [[nodiscard]] double largest() const { return found_[worst()].value; }

    /// Exchanges a point of the worst set for one of another set so that its worst box improves.
    /// Undoes the exchange if either set would be as bad as before.
    void trade() {
        const std::size_t mine = worst();
        const std::size_t other = (mine + 1 + draw(sets_.size() - 1)) % sets_.size();
        const double bound = found_[mine].value;
        const bool full = found_[mine].side == Side::closed;
        std::size_t& goes = drawn_from(sets_[mine], found_[mine], full);
        std::size_t& comes = drawn_from(sets_[other], found_[mine], !full);
        std::swap(goes, comes);
        Measured first = measured(sets_[mine], bound);
        Measured second = first.value < bound ? measured(sets_[other], bound) : Measured();
        if (std::max(first.value, second.value) < bound) {
            found_[mine] = std::move(first);
            found_[other] = std::move(second);
        } else {
            std::swap(goes, comes);
        }
    }

  private:
    [[nodiscard]] std::size_t worst() const {
        return static_cast<std::size_t>(std::ranges::max_element(found_, {}, &Measured::value) -
                                        found_.begin());
    }

    [[nodiscard]] Measured measured(const Rows& set, double enough) const {
        return measure(set_of(points_, set), enough, quiet_);
    }

    /// Random row of the set with its point inside the box (or outside); any row if these are rare.
    std::size_t& drawn_from(Rows& set, const Measured& box, bool inside) {
        constexpr int most_draws = 64;
        std::size_t at = draw(set.size());
        for (int k = 0; k < most_draws && is_inside(points_[set[at]], box) != inside; ++k)
            at = draw(set.size());
        return set[at];
    }

    std::size_t draw(std::size_t below) {
        return static_cast<std::size_t>(rng_.below(drawn_++, below));
    }

    const PointSet& points_;
    std::vector<Rows>& sets_;
    Rng rng_;
    RunContext quiet_;
    std::uint64_t drawn_ = 0;
    std::vector<Measured> found_;
};

}  // namespace

StarBounds star_discrepancy(const PointSet& points, const Rows& rows, const RunContext& run) {
    constexpr std::uint64_t work = std::uint64_t{1} << 37;
    const PointSet set = set_of(points, rows);
    const auto grid = discrepancy::box_grid(set, discrepancy::Family::anchored, run);
    discrepancy::WorstBox worst(grid);
    if (grid.dimension() > 2) worst = discrepancy::ascend(grid, {}, run).worst;
    const auto found =
        discrepancy::star::sweep_or_search(grid, std::move(worst), {.work = work}, run);
    run.check_stop();
    const bool known = found.ending == discrepancy::Ending::complete;
    return {found.worst.value(), known ? found.worst.value() : found.upper};
}

Rows choose_by_star(const PointSet& points, Rows start, std::uint64_t measures, std::uint64_t seed,
                    const RunContext& run) {
    if (start.size() == points.count()) return start;
    return StarExchanges(points, std::move(start), measures, seed, run).search();
}

void even_out_by_star(const PointSet& points, std::vector<Rows>& sets, std::uint64_t measures,
                      std::uint64_t seed, const RunContext& run) {
    StarTrades trades(points, sets, seed, run);
    for (std::uint64_t done = 0; done < measures; done += 2) {  // two measurements per trade
        run.tick(done, measures + 1,
                 fmt::format("largest star discrepancy {:.6g}", trades.largest()));
        trades.trade();
    }
    for (Rows& set : sets) std::ranges::sort(set);
}

double star_memory(double points) { return 4096 * (points / 8 + 64); }

}  // namespace stipple::generators::subset
