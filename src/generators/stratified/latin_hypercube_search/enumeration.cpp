// SPDX-License-Identifier: MIT
#include "generators/stratified/latin_hypercube_search/enumeration.hpp"

#include <algorithm>
#include <limits>

#include "generators/search_run.hpp"

namespace stipple::latin_hypercube_search {
namespace {

/// First half of the plain changes of n things: p stands for an exchange of places p and p + 1.
/// Ends before the two things that are first at the start would change their order.
std::vector<std::uint8_t> half_of_plain_changes(std::size_t n) {
    if (n < 3) return {};
    const std::vector<std::uint8_t> fewer = half_of_plain_changes(n - 1);
    std::vector<std::uint8_t> changes;
    for (std::size_t i = 0; i <= fewer.size(); ++i) {
        const bool down = i % 2 == 0;  // direction of the last thing
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
    std::vector<std::size_t> done_;  ///< number of changes made, by coordinate
    std::vector<bool> back_;         ///< whether the coordinate undoes its changes
};

}  // namespace

double designs_to_try(const Design& start) {
    constexpr std::size_t most_points = 11;  // whose changes take 20 MB
    if (start.dimension == 1) return 1;
    if (start.points > most_points) return std::numeric_limits<double>::infinity();
    double orders = 1;
    for (std::size_t i = 3; i <= start.points; ++i) orders *= static_cast<double>(i);
    double all = 1;
    for (std::size_t k = 1; k < start.dimension; ++k) all *= orders;
    return all;
}

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

}  // namespace stipple::latin_hypercube_search
