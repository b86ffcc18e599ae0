// SPDX-License-Identifier: MIT
#include "generators/stratified/latin_hypercube_search/search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/rng.hpp"
#include "generators/search_run.hpp"
#include "generators/stratified/latin_hypercube_search/annealing.hpp"

namespace stipple::latin_hypercube_search {
namespace {

/// Annealings of the same length, up to eight in parallel.
struct Round {
    std::size_t annealings;
    double share;    ///< fraction of the stage's trials that each of them takes
    bool from_best;  ///< every other one starts from one of the best designs
};

constexpr Round rounds[] = {{8, 1.0 / 96, false}, {8, 1.0 / 32, false}, {4, 1.0 / 6, true}};
constexpr Round rounds_of_lattices[] = {
    {40, 1.0 / 120, false}, {16, 1.0 / 96, true}, {4, 1.0 / 8, true}};

struct Candidate {
    Design design;
    Score score;
};

/// Whether `one` is lower than `other` by more than rounding errors.
bool is_better(const Score& one, const Score& other) {
    const double room = 1e-12 * std::abs(other.value);
    if (std::abs(one.value - other.value) > room) return one.value < other.value;
    return one.second < other.second - 1e-12 * std::abs(other.second);
}

/// Numbers of trials of a search's stages: few at first, then doubling. A smaller total gives the
/// first stages of a larger one.
std::vector<double> stages_of(double trials, double usual, std::size_t points) {
    constexpr double few = 96;
    std::vector<double> stages{few};
    const double least = std::min(usual / 8, 64 * static_cast<double>(points));
    double sum = usual;  // approximate total after a next stage of sum / 2 trials
    while (sum / 2 >= least) sum /= 2;
    for (; sum <= trials; sum *= 2) stages.push_back(sum / 2);
    return stages;
}

class Rounds {
  public:
    Rounds(const Search& search, const std::string& words, const RunContext& run)
        : search_(search),
          words_(words),
          run_(run),
          inner_(silent(run)),
          rng_(search.seed, stream) {}

    Result best() {
        for (const double trials :
             stages_of(search_.trials, usual_trials(search_.objective, search_.start), points())) {
            if (!run_.best_is_wanted()) go(trials);
            if (best_.empty()) run_.check_stop();
            if (!result_ || is_better(best_.front().score, result_->score)) result_ = best_.front();
        }
        return {.design = result_->design, .stopped = run_.best_is_wanted()};
    }

  private:
    static constexpr std::uint64_t stream = std::uint64_t{1} << 33;  // the generator uses others
    static constexpr std::size_t most_kept = 4;
    static constexpr double cold = 1e-3;  // initial accepted fraction if the start is already good

    [[nodiscard]] std::size_t points() const { return search_.start.points; }

    /// Maximum number of annealings in parallel: few if their pairs take much memory.
    [[nodiscard]] std::size_t most_together() const { return points() > 2000 ? 2 : 8; }

    /// Whether lattices are good starts.
    [[nodiscard]] bool from_lattices() const {
        const Design& start = search_.start;
        return search_.rules.are_none() && search_.objective.kind == Kind::maximin &&
               start.dimension > 1 && start.dimension <= 3 && start.points > 10;
    }

    /// Runs a stage of `trials` trials.
    void go(double trials) {
        trials_ = trials;
        for (const Round& round :
             from_lattices() ? std::span(rounds_of_lattices) : std::span(rounds)) {
            const std::size_t together = std::min(round.annealings, most_together());
            for (std::size_t i = 0; i < round.annealings; i += together)
                if (!run_.best_is_wanted()) anneal(round, i, together);
        }
    }

    /// Makes the i-th annealing of a round.
    Annealing start(const Round& round, std::size_t i) const {
        constexpr double beyond[] = {1, 1.005, 1.01, 1.02};
        SplitMix64 draws(rng_.bits(tasks_ + i));
        Schedule schedule{.trials = std::ceil(round.share * trials_)};
        if (!best_.empty()) schedule.target = 1 - beyond[i / 2 % 4] * best_.front().score.value;
        if (round.from_best && i % 2 == 1) {
            schedule.first_share = cold;
            return {search_.objective,
                    best_[i / 2 % best_.size()].design,
                    search_.rules,
                    schedule,
                    draws,
                    inner_};
        }
        const Design& given = search_.start;
        if (i % 4 != 2 && from_lattices()) {
            schedule.first_share = cold;
            return {search_.objective,
                    lattice_start(given.points, given.dimension, draws),
                    search_.rules,
                    schedule,
                    draws,
                    inner_};
        }
        Exchanges exchanges(given, search_.rules);
        exchanges.shuffle(draws, 3, inner_);
        return {search_.objective, exchanges.design(), search_.rules, schedule, draws, inner_};
    }

    void anneal(const Round& round, std::size_t first, std::size_t count) {
        const double of_one = round.share * trials_;
        const double slices =
            std::floor(std::clamp(of_one / static_cast<double>(points()), 1.0, 20.0));
        std::vector<std::optional<Annealing>> all(count);
        const double trials = std::ceil(of_one / slices);
        for (int slice = 0; slice < slices && !run_.best_is_wanted(); ++slice) {
            for_each_block(until_best_is_wanted(inner_), count, 1, [&](const Block& block) {
                auto& one = all[block.index];
                unless_best_is_wanted(run_, [&] {
                    inner_.check_stop();
                    if (!one) one.emplace(start(round, first + block.index));
                    one->advance(trials, inner_);
                });
            });
            if (run_.best_is_wanted()) break;
            spent_ += trials * static_cast<double>(count);
            report(all);
        }
        tasks_ += round.annealings;
        for_each_block(until_best_is_wanted(inner_), count, 1, [&](const Block& block) {
            if (auto& one = all[block.index])
                unless_best_is_wanted(run_, [&] { one->settle(inner_); });
        });
        for (auto& one : all)
            if (one) best_.push_back({one->best(), one->score()});
        std::ranges::stable_sort(best_, {}, &Candidate::score);
        if (best_.size() > most_kept) best_.erase(best_.begin() + most_kept, best_.end());
    }

    void report(const std::vector<std::optional<Annealing>>& all) {
        const Score now =
            std::ranges::min_element(all, {}, [](const auto& one) { return one->score(); })
                ->value()
                .score();
        const Score least = best_.empty() ? now : std::min(now, best_.front().score);
        const Design& design = search_.start;
        const auto shown = [&](const Score& score) {
            return reported(search_.objective, score, design.points, design.dimension);
        };
        report_search(run_, spent_ / search_.trials, words_, shown(now), shown(least));
    }

    const Search& search_;
    const std::string& words_;
    const RunContext& run_;
    RunContext inner_;
    Rng rng_;
    std::uint64_t tasks_ = 0;
    double trials_ = 0;  ///< number of trials of the current stage
    double spent_ = 0;
    std::vector<Candidate> best_;
    std::optional<Candidate> result_;
};

// Few points have so few Latin hypercubes that all can be visited. The first coordinate numbers the
// points. The levels of every other one take all orders except mirror images, which are the same to
// every criterion, by plain changes: exchanges of two neighbouring levels, back and forth like the
// digits of a reflected Gray code. So consecutive designs differ by one exchange. There are
// (n! / 2)^(d - 1) designs, O(n^2) each, and n! / 2 bytes are needed (D. E. Knuth, The Art of
// Computer Programming 4A (2011), 7.2.1.1 algorithm H, 7.2.1.2 algorithm P).

/// First half of the plain changes of n items: p exchanges the items at positions p and p + 1. Ends
/// before the items at the initial positions 0 and 1 would change their order.
std::vector<std::uint8_t> half_of_plain_changes(std::size_t n) {
    if (n < 3) return {};
    const std::vector<std::uint8_t> fewer = half_of_plain_changes(n - 1);
    std::vector<std::uint8_t> changes;
    for (std::size_t i = 0; i <= fewer.size(); ++i) {
        const bool down = i % 2 == 0;  // the last item moves to lower positions
        for (std::size_t p = 0; p + 1 < n; ++p)
            changes.push_back(static_cast<std::uint8_t>(down ? n - 2 - p : p));
        if (i < fewer.size())
            changes.push_back(static_cast<std::uint8_t>(fewer[i] + (down ? 1 : 0)));
    }
    return changes;
}

/// Steps a design through all Latin hypercubes.
class Designs {
  public:
    Designs(const Objective& objective, const Design& start)
        : design_(start),
          criterion_(make_criterion(objective, start, rules_)),
          changes_(start.dimension == 1 ? std::vector<std::uint8_t>()
                                        : half_of_plain_changes(start.points)),
          done_(start.dimension),
          back_(start.dimension) {}

    /// Moves to the next design; false after the last.
    bool next() {
        for (std::size_t k = 1; k < design_.dimension; ++k) {
            if (done_[k] != (back_[k] ? 0 : changes_.size())) {
                exchange(k, changes_[back_[k] ? --done_[k] : done_[k]++]);
                return true;
            }
            back_[k] = !back_[k];
        }
        return false;
    }

    [[nodiscard]] const Design& design() const { return design_; }
    [[nodiscard]] Score score() const { return criterion_->score(); }

  private:
    void exchange(std::size_t k, Level level) {
        const auto levels = design_.along(k);
        const auto row_of = [&](Level x) {
            return static_cast<std::size_t>(std::ranges::find(levels, x) - levels.begin());
        };
        const std::size_t a = row_of(level);
        const std::size_t b = row_of(level + 1);
        criterion_->exchange(k, a, b, criterion_->change(k, a, b));
        std::swap(levels[a], levels[b]);
    }

    Design design_;
    Rules rules_;
    std::unique_ptr<Criterion> criterion_;
    std::vector<std::uint8_t> changes_;
    std::vector<std::size_t> done_;  ///< position of each coordinate in changes_
    std::vector<bool> back_;         ///< whether the coordinate goes backwards through changes_
};

/// Returns the best of all designs, or the best so far if the run is stopped and keeps it.
Result best_of_all(const Objective& objective, const Design& start, const RunContext& run) {
    constexpr std::uint64_t some = 1 << 14;
    const auto all = static_cast<std::uint64_t>(designs_to_try(start));
    run.need_memory(criterion_memory(objective, start), "trying all Latin hypercubes");
    Designs designs(objective, start);
    Result best{.design = start, .optimal = true};
    Score least = designs.score();
    for (std::uint64_t tried = 1; designs.next(); ++tried) {
        if (const Score score = designs.score(); score < least) {
            least = score;
            best.design = designs.design();
        }
        if (tried % some != 0) continue;
        until_best_is_wanted(run).tick(tried, all);
        if (!run.best_is_wanted()) continue;
        best.stopped = true;
        best.optimal = false;
        break;
    }
    return best;
}

}  // namespace

double designs_to_try(const Design& start) {
    constexpr std::size_t most_points = 11;  // 11! / 2 plain changes take 20 MB
    if (start.dimension == 1) return 1;
    if (start.points > most_points) return std::numeric_limits<double>::infinity();
    double orders = 1;
    for (std::size_t i = 3; i <= start.points; ++i) orders *= static_cast<double>(i);
    double all = 1;
    for (std::size_t k = 1; k < start.dimension; ++k) all *= orders;
    return all;
}

Result best_design(const Search& search, const std::string& words, const RunContext& run) {
    if (search.rules.are_none() && designs_to_try(search.start) <= search.trials)
        return best_of_all(search.objective, search.start, run);
    const double together = search.start.points > 2000 ? 2 : 8;
    run.need_memory(together * criterion_memory(search.objective, search.start),
                    "the search for a Latin hypercube");
    return Rounds(search, words, run).best();
}

double usual_trials(const Objective& objective, const Design& design) {
    const auto n = static_cast<double>(design.points);
    const auto d = static_cast<double>(design.dimension);
    // Slowdown of maximin above 200 points: its n^2 distances are no longer in the fastest caches,
    // and each new target takes a sum over all of them.
    const double crowded = std::max(1.0, n / 200);
    const double seconds = objective.kind == Kind::correlation ? 1e-8 * (3 + d)
                           : objective.kind == Kind::maximin   ? 3e-8 + 3e-10 * n * crowded
                                                               : 5e-8 + 3e-9 * n;
    return std::min(20 / seconds, 1e6 * n * d);
}

}  // namespace stipple::latin_hypercube_search
