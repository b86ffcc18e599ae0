// SPDX-License-Identifier: MIT
#include "generators/optimized/coordinate_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.hpp"
#include "core/rng.hpp"
#include "generators/search_run.hpp"
#include "math/functions/exponential.hpp"
#include "math/functions/logarithm.hpp"
#include "stipple/generate.hpp"

namespace stipple::optimized {
namespace {

double turned(double x) { return std::min(x - std::floor(x), one_minus_ulp); }

/// Term of a lattice's squared wraparound discrepancy that depends on its generating vector.
double wraparound_sum(std::size_t count, const std::vector<std::size_t>& vector) {
    std::vector<std::size_t> at(vector.size());
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
        double product = 1;
        for (std::size_t j = 0; j < vector.size(); ++j) {
            const double x = static_cast<double>(at[j]) / static_cast<double>(count);
            product *= 1.5 - x * (1 - x);
            at[j] = (at[j] + vector[j]) % count;
        }
        sum += product;
    }
    return sum;
}

/// Number of random vectors to try; grows with the number of distinct vectors, so that few repeat.
std::size_t vectors_to_draw(std::size_t count, std::size_t dimension) {
    double all = 1;
    for (std::size_t j = 1; j < dimension; ++j) all *= static_cast<double>(count);
    return static_cast<std::size_t>(std::clamp(all / 50, 10.0, 1000.0));
}

/// Rows of a lattice of rank 1: i times its generating vector over n, plus a shift, modulo 1.
std::vector<double> rank1_rows(std::size_t count, std::span<const std::size_t> vector,
                               std::span<const double> shift) {
    const auto n = static_cast<double>(count);
    std::vector<double> rows;
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = 0; j < vector.size(); ++j)
            rows.push_back(turned(static_cast<double>(i * vector[j] % count) / n + shift[j]));
    return rows;
}

/// Geometric sequence from one value to another, with a given number of terms.
class Geometric {
  public:
    Geometric(double from, double to, std::size_t steps)
        : value_(from),
          factor_(steps > 1 ? exponential(logarithm(to / from) / static_cast<double>(steps - 1))
                            : 1) {}
    double next() {
        const double now = value_;
        value_ *= factor_;
        return now;
    }

  private:
    double value_;
    double factor_;
};

/// Adam: steps scaled by moving averages of the gradient and of its square.
class Adam {
  public:
    explicit Adam(std::size_t size) : mean_(size), square_(size) {}

    /// Moves coordinates from index `first` on by at most about `rate` each, within the unit cube.
    void step(std::span<double> x, std::span<const double> gradient, double rate,
              std::size_t first) {
        mean_left_ *= memory;
        square_left_ *= long_memory;
        const double mean_part = 1 / (1 - mean_left_);
        const double square_part = 1 / (1 - square_left_);
        for (std::size_t i = first; i < x.size(); ++i) {
            const double g = gradient[i];
            mean_[i] = memory * mean_[i] + (1 - memory) * g;
            square_[i] = long_memory * square_[i] + (1 - long_memory) * (g * g);
            const double size = std::sqrt(square_[i] * square_part);
            if (size > 0) x[i] -= rate * (mean_[i] * mean_part) / size;
            x[i] = std::clamp(x[i], 0.0, one_minus_ulp);
        }
    }

  private:
    static constexpr double memory = 0.9;
    static constexpr double long_memory = 0.99;
    std::vector<double> mean_;
    std::vector<double> square_;
    double mean_left_ = 1;
    double square_left_ = 1;
};

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Returns the best set at the end of a round of a descent or, if a stop ends the first round and
/// the run keeps the best, the best set so far. If the first round ends above `enough`, the result
/// has no rows and its value may be too small, because certain_value() is not called.
OptimizedRows descend(std::vector<double> rows, const CoordinateSearch& search,
                      const Schedule& schedule, double enough, const RunContext& run) {
    const std::unique_ptr<Objective> objective = search.objective();
    OptimizedRows best{{}, infinity};
    OptimizedRows passed{{}, infinity, true, false};
    std::vector<double> gradient(rows.size());
    Geometric rate(schedule.first_rate, schedule.last_rate, schedule.steps);
    Geometric sharpness(schedule.first_sharpness, schedule.last_sharpness, schedule.steps);
    Adam adam(rows.size());
    constexpr double near = 1.001;
    // One round of `steps` steps. True if the descent is over: its value exceeds `enough`, or no
    // box is much worse than those that the descent has used.
    const auto go = [&](std::size_t steps, auto next_rate, auto next_sharpness) {
        for (std::size_t step = 0; step < steps; ++step) {
            run.check_stop();
            const double here = objective->value(rows, next_sharpness(), gradient, run);
            if (run.keeps_best && here < passed.value) {
                passed.rows = rows;
                passed.value = here;
            }
            adam.step(rows, gradient, next_rate(), search.kept * search.dimension);
        }
        const double known = objective->value(rows, 1e6, gradient, run);
        if (known > enough) {
            if (best.rows.empty()) best.value = known;
            return true;
        }
        const double value = objective->certain_value(rows, known, run);
        if (value < best.value) best = {rows, value};
        return value <= near * known;
    };
    const bool ended = unless_best_is_wanted(run, [&] {
        bool over = go(
            schedule.steps, [&] { return rate.next(); }, [&] { return sharpness.next(); });
        for (int round = 0; round < 6 && !over; ++round)
            over = go(
                10, [&] { return schedule.last_rate; }, [&] { return schedule.last_sharpness; });
    });
    return ended || !best.rows.empty() ? best : passed;
}

bool better(const OptimizedRows& a, const OptimizedRows& b) {
    return a.certain != b.certain ? a.certain : a.value < b.value;
}

class Population {
  public:
    Population(const CoordinateSearch& search, const std::string& words, const RunContext& run)
        : search_(search),
          words_(words),
          rng_(search.seed),
          objective_(search.objective()),
          run_(run),
          most_sets_(sets_for(search.budget / objective_->steps())),
          inner_(silent(run)) {
        need_memory();
    }

    /// @throws Error(cancelled), also if a stop request comes before there is a best set
    OptimizedRows best() {
        unless_best_is_wanted(run_, [&] { search(); });
        keep_best(1);
        if (all_.empty() || all_.front().rows.empty()) run_.check_stop();
        all_.front().stopped = run_.best_is_wanted();
        return all_.front();
    }

  private:
    void search() {
        const double hop_cost = cost(search_.from_hop);
        make_starts();
        while (spent_ + hop_cost * static_cast<double>(all_.size()) <=
               (1 - polish_share) * search_.budget) {
            const double done = spent_ / search_.budget;
            const std::size_t part = done < 0.5 ? 1 : done < 0.75 ? 2 : done < 0.9 ? 4 : most_sets_;
            keep_best(std::max<std::size_t>(most_sets_ / part, 1));
            hop();
            run_.check_stop();
        }
        keep_best(1);
        polish();
    }

    /// Requires memory for the sets kept, their successors and the descents.
    void need_memory() const {
        const auto sets = static_cast<double>(most_sets_);
        const double at_once = std::min(sets, static_cast<double>(run_.thread_count()));
        constexpr double a_descent = 9;  // doubles per coordinate in one descent
        run_.need_memory(8 * static_cast<double>(search_.count * search_.dimension) *
                             (2 * sets + a_descent * at_once),
                         "the search for coordinates");
    }

    static constexpr double starts_share = 0.4;
    static constexpr double polish_share = 0.05;

    /// Largest number of sets for a budget of `values` objective values, so that each can improve.
    static std::size_t sets_for(double values) {
        return static_cast<std::size_t>(std::clamp(values / 3000, 2.0, 16.0));
    }

    [[nodiscard]] double cost(const Schedule& schedule) const {
        return objective_->steps() * static_cast<double>(schedule.steps + 1);
    }
    [[nodiscard]] SplitMix64 draws() { return SplitMix64(rng_.bits(tasks_++)); }

    /// Descends from several starts or, if the budget is small, from one with most of the budget.
    void make_starts() {
        constexpr double few = 1500;
        const double values = search_.budget / objective_->steps();
        if (search_.one_start) add_given();
        if (values < few) {
            Schedule longer = search_.from_start;
            longer.steps = static_cast<std::size_t>(std::max(0.6 * values, 2.0));
            return add_starts(1, longer);
        }
        const double starts = starts_share * search_.budget / cost(search_.from_start);
        add_starts(search_.one_start ? 1 : static_cast<std::size_t>(std::clamp(starts, 1.0, 1e4)),
                   search_.from_start);
    }

    void add_given() {
        SplitMix64 own = draws();
        OptimizedRows given{search_.start(0, own), 0};
        std::vector<double> gradient(given.rows.size());
        const double known = objective_->value(given.rows, 1, gradient, inner_);
        given.value = objective_->certain_value(given.rows, known, inner_);
        all_.push_back(std::move(given));
    }

    /// Rows of the best of several candidates for start number `start`.
    [[nodiscard]] std::vector<double> first_rows(std::size_t start, SplitMix64 draws) const {
        const std::size_t sets = search_.one_start ? 1 : search_.sets_a_start;
        OptimizedRows least{{}, infinity};
        std::vector<double> gradient(search_.count * search_.dimension);
        for (std::size_t k = 0; k < sets; ++k) {
            std::vector<double> rows = search_.start(start * sets + k, draws);
            const double value = search_.objective()->value(rows, 1e3, gradient, inner_);
            if (value < least.value) least = {std::move(rows), value};
        }
        return std::move(least.rows);
    }

    void add_starts(std::size_t count, const Schedule& schedule) {
        for (std::size_t first = 0; first < count; first += most_sets_) {
            std::vector<std::vector<double>> rows(std::min(most_sets_, count - first));
            std::vector<SplitMix64> streams;
            while (streams.size() < rows.size()) streams.push_back(draws());
            for_each_block(inner_, rows.size(), 1, [&](const Block& block) {
                rows[block.index] = first_rows(first + block.index, streams[block.index]);
            });
            const double enough = all_.size() < most_sets_ ? infinity : all_.back().value;
            auto found = descended(std::move(rows), schedule, [&](std::size_t) { return enough; });
            std::ranges::move(found, std::back_inserter(all_));
            keep_best(most_sets_);
            run_.check_stop();
        }
    }

    /// Moves about half of the points, each coordinate by at most search_.hop.
    void disturb(std::vector<double>& rows, SplitMix64& draws) const {
        const double reach = search_.hop * to_unit(draws.next());
        for (std::size_t i = search_.kept; i < search_.count; ++i) {
            if (draws.below(2) == 0) continue;
            for (double& x : std::span(rows).subspan(i * search_.dimension, search_.dimension))
                x = std::clamp(x + reach * (2 * to_unit(draws.next()) - 1), 0.0, one_minus_ulp);
        }
    }

    void hop() {
        std::vector<std::vector<double>> rows;
        for (const OptimizedRows& one : all_) {
            SplitMix64 own = draws();
            rows.push_back(one.rows);
            disturb(rows.back(), own);
        }
        auto found = descended(std::move(rows), search_.from_hop,
                               [&](std::size_t i) { return all_[i].value; });
        for (std::size_t i = 0; i < all_.size(); ++i)
            if (!better(all_[i], found[i])) all_[i] = std::move(found[i]);
    }

    /// Descends from the best set with smaller and smaller steps, finer than those after hops.
    void polish() {
        const Schedule& hop = search_.from_hop;
        const double values = search_.budget / objective_->steps();
        const auto steps = static_cast<std::size_t>(std::clamp(polish_share * values, 2.0, 300.0));
        auto found = descended({all_.front().rows},
                               {steps, hop.last_rate, 0.01 * hop.last_rate, hop.last_sharpness,
                                100 * hop.last_sharpness},
                               [&](std::size_t) { return all_.front().value; });
        if (better(found.front(), all_.front())) all_.front() = std::move(found.front());
    }

    /// Results of descents from several sets; for the i-th set, values above enough(i) are useless.
    std::vector<OptimizedRows> descended(std::vector<std::vector<double>> rows,
                                         const Schedule& schedule, auto enough) {
        std::vector<OptimizedRows> found(rows.size());
        for_each_block(until_best_is_wanted(inner_), rows.size(), 1, [&](const Block& block) {
            found[block.index] = descend(std::move(rows[block.index]), search_, schedule,
                                         enough(block.index), inner_);
        });
        if (run_.best_is_wanted()) return found;
        spent_ += cost(schedule) * static_cast<double>(rows.size());
        const double value = std::ranges::min_element(found, better)->value;
        least_ = std::min(least_, value);
        report_search(run_, spent_ / search_.budget, words_, objective_->reported(value),
                      objective_->reported(least_));
        return found;
    }

    void keep_best(std::size_t most) {
        std::ranges::stable_sort(all_, better);
        if (all_.size() > most) all_.resize(most);
    }

    const CoordinateSearch& search_;
    const std::string& words_;
    Rng rng_;
    std::unique_ptr<Objective> objective_;
    const RunContext& run_;
    std::size_t most_sets_;  ///< number of sets kept in the first half of the budget
    RunContext inner_;       ///< context of descents, without progress
    std::uint64_t tasks_ = 0;
    double spent_ = 0;
    double least_ = infinity;
    std::vector<OptimizedRows> all_;
};

std::vector<double> korobov_rows(std::size_t count, std::size_t dimension, std::size_t g) {
    std::vector<std::size_t> vector(dimension, 1 % count);
    for (std::size_t j = 1; j < dimension; ++j) vector[j] = vector[j - 1] * g % count;
    return rank1_rows(count, vector, std::vector<double>(dimension));
}

}  // namespace

std::vector<double> golden_rows(std::size_t count, std::size_t dimension, SplitMix64& draws) {
    constexpr double step = 0.61803398874989485;
    const double shift[] = {to_unit(draws.next()), to_unit(draws.next())};
    std::vector<double> rows;
    for (std::size_t i = 0; i < count; ++i) {
        const auto at = static_cast<double>(i);
        if (dimension == 2) rows.push_back((at + shift[0]) / static_cast<double>(count));
        rows.push_back(turned(at * step + shift[1]));
    }
    return rows;
}

std::vector<double> lattice_rows(std::size_t count, std::size_t dimension, SplitMix64& draws,
                                 const RunContext& run) {
    std::vector<std::size_t> best;
    double least = std::numeric_limits<double>::infinity();
    std::vector<std::size_t> vector(dimension, 1);
    for (std::size_t k = vectors_to_draw(count, dimension); k > 0; --k) {
        run.check_stop();
        for (std::size_t j = 1; j < dimension; ++j) vector[j] = draws.below(count);
        const double sum = wraparound_sum(count, vector);
        if (sum >= least) continue;
        least = sum;
        best = vector;
    }
    std::vector<double> shift;
    while (shift.size() < dimension) shift.push_back(to_unit(draws.next()));
    return rank1_rows(count, best, shift);
}

std::vector<double> net_rows(std::size_t count, std::size_t dimension, SplitMix64& draws) {
    const double shift = to_unit(draws.next());
    const PointSet net = generate(
        "sobol:scramble=owen", {.count = count, .dimension = dimension - 1, .seed = draws.next()});
    std::vector<double> rows;
    for (std::size_t i = 0; i < count; ++i) {
        rows.push_back((static_cast<double>(i) + shift) / static_cast<double>(count));
        rows.insert(rows.end(), net[i].begin(), net[i].end());
    }
    return rows;
}

OptimizedRows search_coordinates(const CoordinateSearch& search, const std::string& words,
                                 const RunContext& run) {
    return Population(search, words, run).best();
}

OptimizedRows least_lattice(std::size_t count, std::size_t dimension,
                            const std::function<std::unique_ptr<Objective>()>& objective,
                            const std::string& words, const RunContext& run) {
    constexpr std::size_t together = 16;
    const RunContext inner = silent(run);
    const std::size_t last = count / 2 + 1;
    OptimizedRows best{{}, infinity};
    const auto named = objective();
    const auto look_at_some = [&](std::size_t first) {
        std::vector<OptimizedRows> found(std::min(together, last + 1 - first));
        for_each_block(inner, found.size(), 1, [&](const Block& block) {
            OptimizedRows& one = found[block.index];
            one = {korobov_rows(count, dimension, first + block.index), 0};
            std::vector<double> gradient(one.rows.size());
            const auto measure = objective();
            one.value = measure->value(one.rows, 1e3, gradient, inner);
            if (one.value < best.value)
                one.value = measure->certain_value(one.rows, one.value, inner);
        });
        const double value = std::ranges::min_element(found, {}, &OptimizedRows::value)->value;
        for (OptimizedRows& one : found)
            if (one.value < best.value) best = std::move(one);
        report_search(run,
                      static_cast<double>(first + found.size()) / static_cast<double>(last + 1),
                      words, named->reported(value), named->reported(best.value));
    };
    unless_best_is_wanted(run, [&] {
        for (std::size_t first = 1; first <= last; first += together) {
            run.check_stop();
            look_at_some(first);
        }
    });
    if (best.rows.empty()) run.check_stop();
    best.stopped = run.best_is_wanted();
    return best;
}

}  // namespace stipple::optimized
