// SPDX-License-Identifier: MIT
#include "generators/stratified/latin_hypercube_search/annealing.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/error.hpp"
#include "core/rng.hpp"
#include "math/functions/exponential.hpp"
#include "math/functions/logarithm.hpp"

namespace stipple::latin_hypercube_search {
namespace {

constexpr double piece = 1024;  // number of trials between two changes of the accepted fraction
constexpr double gain = 0.02;   // change of the temperature's logarithm per accepted trial
// Polishing: the last trials of maximin; their target is 1 above the squared distance reached.
constexpr double polish_from = 0.8;    // fraction of the trials before polishing
constexpr double polish_share = 2e-3;  // accepted fraction at the start of polishing

}  // namespace

Exchanges::Exchanges(Design design, const Rules& rules)
    : design_(std::move(design)), rules_(rules), row_(design_.dimension) {
    if (rules.groups.empty()) return;
    for (std::uint32_t g = 0; g < rules.groups.size(); ++g) group_.resize(rules.groups[g], g);
    row_at_.resize(design_.levels.size());
    for (std::size_t k = 0; k < design_.dimension; ++k)
        for (std::uint32_t i = 0; i < design_.points; ++i)
            row_at_[k * design_.points + static_cast<std::size_t>(design_.along(k)[i])] = i;
}

/// Random row to exchange with row a: of its group, or with a level in the same coarse stratum;
/// a itself if there is no other.
std::size_t Exchanges::partner(SplitMix64& draws, std::size_t k, std::size_t a) const {
    const auto other = [&](std::size_t first, std::size_t last, std::size_t but) {
        const std::size_t drawn = first + draws.below(last - first - 1);
        return last - first == 1 ? but : drawn + (drawn >= but);
    };
    if (group_.empty()) return other(rules_.fixed, design_.rows, a);
    if (draws.below(2) == 0) {
        const std::size_t g = group_[a];
        return other(g == 0 ? 0 : rules_.groups[g - 1], rules_.groups[g], a);
    }
    const auto level = static_cast<std::size_t>(design_.along(k)[a]);
    const auto coarse = static_cast<std::size_t>(rules_.coarse);
    const std::size_t first = level / coarse * coarse;
    return row_at_[k * design_.points + other(first, first + coarse, level)];
}

bool Exchanges::draw(SplitMix64& draws, Exchange& exchange) const {
    exchange.coordinate = draws.below(design_.dimension);
    exchange.a = rules_.fixed + draws.below(design_.points - rules_.fixed);
    exchange.b = partner(draws, exchange.coordinate, exchange.a);
    return possible(exchange);
}

bool Exchanges::possible(const Exchange& exchange) const {
    return exchange.a != exchange.b && design_.along(exchange.coordinate)[exchange.b] >= 0;
}

bool Exchanges::fits(std::size_t row) { return fits(row, 0, design_.along(0)[row]); }

bool Exchanges::fits(std::size_t row, std::size_t k, Level level) {
    if (row >= design_.points) return true;
    for (std::size_t l = 0; l < design_.dimension; ++l) row_[l] = design_.along(l)[row];
    row_[k] = level;
    return rules_.feasible(row, row_);
}

int Exchanges::infeasible(const Exchange& exchange) {
    const auto [k, a, b] = exchange;
    if (!rules_.feasible) return 0;
    return !fits(a, k, design_.along(k)[b]) + !fits(b, k, design_.along(k)[a]);
}

void Exchanges::make(const Exchange& exchange) {
    const auto [k, a, b] = exchange;
    const auto levels = design_.along(k);
    std::swap(levels[a], levels[b]);
    if (row_at_.empty()) return;
    for (const std::size_t row : {a, b})
        row_at_[k * design_.points + static_cast<std::size_t>(levels[row])] =
            static_cast<std::uint32_t>(row);
}

void Exchanges::make_fit(SplitMix64& draws, std::size_t row) {
    constexpr int tries = 30;
    for (int i = 0; i < tries && !fits(row); ++i) {
        Exchange one{draws.below(design_.dimension), row, 0};
        one.b = partner(draws, one.coordinate, row);
        if (!possible(one)) continue;
        const int before = 1 + !fits(one.b);
        if (infeasible(one) <= before) make(one);
    }
}

std::size_t Exchanges::make_feasible(SplitMix64& draws, const RunContext& run) {
    if (!rules_.feasible) return 0;
    constexpr int rounds = 300;
    std::size_t wrong = 1;
    for (int i = 0; i < rounds && wrong > 0; ++i) {
        wrong = 0;
        for (std::size_t row = rules_.fixed; row < design_.points; ++row) {
            run.check_stop();
            if (fits(row)) continue;
            ++wrong;
            make_fit(draws, row);
        }
    }
    if (wrong == 0) return 0;
    wrong = 0;  // counted again, since the last pass repaired some
    for (std::size_t row = rules_.fixed; row < design_.points; ++row) wrong += !fits(row);
    return wrong;
}

void Exchanges::shuffle(SplitMix64& draws, std::size_t times, const RunContext& run) {
    const std::size_t all = times * design_.points * design_.dimension;
    if (const std::size_t wrong = make_feasible(draws, run); wrong > 0)
        fail(ErrorKind::limit,
             "latin-hypercube: no feasible design was found; {} of {} points violate the "
             "constraints",
             wrong, design_.points);
    Exchange one{};
    constexpr std::size_t often = 4096;
    for (std::size_t i = 0; i < all; ++i) {
        if (i % often == 0) run.check_stop();
        if (draw(draws, one) && infeasible(one) == 0) make(one);
    }
}

void Trail::made(const Exchange& exchange) {
    if (left_) return;
    steps_.push_back(exchange);
    if (steps_.size() <= best_.levels.size()) return;
    go_to_mark();
}

void Trail::mark(const Design& now) {
    mark_ = steps_.size();
    if (left_) best_ = now;
    left_ = false;
}

void Trail::go_to_mark() {
    for (const auto& [k, a, b] : std::span(steps_).first(mark_))
        std::swap(best_.along(k)[a], best_.along(k)[b]);
    left_ = left_ || mark_ < steps_.size();
    steps_.clear();
    mark_ = 0;
}

const Design& Trail::best() {
    go_to_mark();
    return best_;
}

Annealing::Annealing(const Objective& objective, const Design& start, const Rules& rules,
                     const Schedule& schedule, SplitMix64 draws, const RunContext& run)
    : objective_(objective),
      rules_(rules),
      schedule_(schedule),
      draws_(draws),
      exchanges_(start, rules),
      trail_(start),
      criterion_(make_criterion(objective, start, rules, run)),
      share_(schedule.first_share),
      score_(criterion_->score()) {
    run.check_stop();
    const double pieces = std::max(1.0, schedule.trials / piece);
    cooling_ = exponential(logarithm(schedule.last_share / schedule.first_share) / pieces);
    if (!criterion_->aim(schedule.target)) polishing_ = true;
    over_ = polishing_ && criterion_->reached();
    run.check_stop();
    constexpr int some = 64;
    Exchange one{};
    for (int i = 0; i < some; ++i)
        if (exchanges_.draw(draws_, one))
            temperature_ += std::abs(criterion_->change(one.coordinate, one.a, one.b)) / some;
    temperature_ *= schedule.first_share;
}

/// Cost of visiting all pairs, in trials; 0 for up to 1000 points, where it is negligible.
double Annealing::pass() const {
    const std::size_t points = exchanges_.design().points;
    return points > 1000 ? static_cast<double>(points / 4) : 0;
}

void Annealing::aim_next() {
    done_ += pass();
    if (!criterion_->aim(1 - criterion_->score().value)) over_ = criterion_->reached();
}

void Annealing::note() {
    done_ += pass();
    const Score score = criterion_->score();
    if (!(score < score_)) return;
    score_ = score;
    trail_.mark(exchanges_.design());
}

bool Annealing::accepts(double change) {
    if (change <= 0) return true;
    constexpr double never = 40;
    const bool accepted = change < never * temperature_ &&
                          to_unit(draws_.next()) < exponential(-change / temperature_);
    temperature_ *= accepted ? 1 - gain : 1 + gain * share_;
    return accepted;
}

void Annealing::trial() {
    Exchange one{};
    if (!exchanges_.draw(draws_, one)) return;
    const double change = criterion_->change(one.coordinate, one.a, one.b);
    if (!accepts(change) || exchanges_.infeasible(one) > 0) return;
    criterion_->exchange(one.coordinate, one.a, one.b, change);
    exchanges_.make(one);
    trail_.made(one);
    if (const Score now = criterion_->score_below(score_); now < score_) {
        score_ = now;
        trail_.mark(exchanges_.design());
    }
    if (!criterion_->reached()) return;
    done_ += pass();
    aim_next();
}

void Annealing::advance(double trials, const RunContext& run) {
    const double last = std::min(schedule_.trials, done_ + trials);
    constexpr std::uint64_t often = 64;
    std::uint64_t made = 0;
    for (; done_ < last && !over_; ++done_) {
        if (made++ % often == 0 && run.stop.stop_requested()) {
            if (run.keeps_best) note();
            run.check_stop();
        }
        trial();
        if (done_ < next_) continue;
        next_ = done_ + piece;
        share_ *= cooling_;
        if (polishing_ || done_ < polish_from * schedule_.trials) continue;
        polishing_ = true;
        note();
        aim_next();
        share_ = std::min(polish_share, schedule_.first_share);
        cooling_ = exponential(logarithm(schedule_.last_share / share_) /
                               std::max(1.0, (1 - polish_from) * schedule_.trials / piece));
    }
    note();
}

void Annealing::settle(const RunContext& run) {
    criterion_.reset();  // frees its memory before the next one takes its own
    criterion_ = make_criterion(objective_, trail_.best(), rules_, run);
    score_ = criterion_->score();
}

}  // namespace stipple::latin_hypercube_search
