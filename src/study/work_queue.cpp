// SPDX-License-Identifier: MIT
#include "study/work_queue.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace stipple {

std::vector<UnitRange> missing(std::span<const UnitRange> done, UnitRange range) {
    std::vector<UnitRange> gaps;
    auto it = std::ranges::upper_bound(done, range.first, {}, &UnitRange::last);
    for (; it != done.end() && it->first < range.last; ++it) {
        if (range.first < it->first) gaps.push_back({range.first, it->first});
        range.first = it->last;
    }
    if (range.first < range.last) gaps.push_back(range);
    return gaps;
}

SetCost set_cost(const Sweep& sweep, const Cell& cell) {
    constexpr double once = 2e-5;  // seconds that each set and each measure takes at least
    const auto& generator = *sweep.generators()[cell.generator].unit;
    const auto n = static_cast<double>(cell.count);
    const auto d = static_cast<double>(cell.dimension);
    const std::size_t warps = sweep.warps_of(cell.generator).all.size();
    SetCost cost{.make = once + 5e-8 * n * d * static_cast<double>(warps)};
    cost.make += generator.cost              ? generator.cost(n, d)
                 : generator.traits.sequence ? 3e-8 * n * d
                                             : 3e-5 * n * std::pow(5.0, std::max(0.0, d - 2));
    for (const auto& measure : sweep.measures())
        cost.measure += once + (measure.unit->cost ? measure.unit->cost(n, d) : 5e-7 * n * d);
    return cost;
}

WorkQueue::WorkQueue(const Sweep& sweep, std::vector<UnitRange> done, std::size_t workers)
    : sweep_(sweep), done_(std::move(done)), workers_(static_cast<double>(workers)) {
    const auto seeds = static_cast<double>(sweep.request().seeds);
    for (std::uint64_t c = 0; c < sweep.cells(); ++c) {
        const Cell cell = sweep.cell(c);
        const double sets = sweep.seeded(cell.generator) ? seeds : 1;
        work_.push_back({.left = sets * set_cost(sweep, cell).all()});
        cells_.push_back(c);
    }
    take_out(done_, std::nullopt);
    early_ = workers == 1 ? HUGE_VAL : 0.05 * seconds_left();  // limits the delay of the end
    sort();
}

double WorkQueue::measured_ratio(const CellWork& work) const {
    if (work.finished > 0) return work.spent / work.finished;
    return all_.finished > 0 ? all_.spent / all_.finished : 1;
}

double WorkQueue::seconds_left() const {
    double left = 0;
    for (const CellWork& work : work_) left += work.left * measured_ratio(work);
    return left;
}

WorkQueue::Piece WorkQueue::piece_of(std::uint64_t index) const {
    const Cell cell = sweep_.cell(index);
    const SetCost cost = set_cost(sweep_, cell);
    const double set = cost.all() * measured_ratio(work_[index]);
    const std::uint64_t measures = sweep_.measures().size();
    const std::uint64_t seeds = sweep_.request().seeds;
    if (!sweep_.seeded(cell.generator)) {  // one set serves all seeds
        constexpr std::uint64_t most_sets = 1 << 16;
        return {measures * std::min(seeds, most_sets), set};
    }
    if (set > 2 * grain_ && cost.measure > 2 * cost.make && measures > 1)
        return {1, set * (cost.make + cost.measure / static_cast<double>(measures)) / cost.all()};
    const double sets = std::floor(std::clamp(grain_ / set, 1.0, static_cast<double>(seeds)));
    return {measures * static_cast<std::uint64_t>(sets), sets * set};
}

void WorkQueue::sort() {
    constexpr double longest = 1;      // seconds of a piece
    constexpr double shortest = 2e-3;  // shorter pieces are not worth handing out
    constexpr double pieces_of_worker = 32;
    grain_ = std::clamp(seconds_left() / (pieces_of_worker * workers_), shortest, longest);
    pieces_left_ = 0;
    // Sort keys of cells. While pieces are early: n d, so that all generators begin with sets of
    // the same sizes. Later: the seconds of the cell's next piece if above grain_, else 0.
    std::vector<double> sizes(work_.size());
    for (const std::uint64_t cell : cells_) {
        const Piece piece = piece_of(cell);
        const std::uint64_t units = sweep_.units_per_cell() - work_[cell].pulled;
        pieces_left_ += (units + piece.units - 1) / piece.units;
        const Cell set = sweep_.cell(cell);
        if (early_ > 0)
            sizes[cell] = static_cast<double>(set.count) * static_cast<double>(set.dimension);
        else if (piece.seconds > 1.001 * grain_)
            sizes[cell] = piece.seconds;
    }
    within_grain_ = static_cast<std::size_t>(
        std::ranges::count(cells_, 0.0, [&](std::uint64_t cell) { return sizes[cell]; }));
    std::ranges::sort(cells_, [&](std::uint64_t a, std::uint64_t b) {
        return sizes[a] != sizes[b] ? (sizes[a] < sizes[b]) == (early_ <= 0) : a > b;
    });
}

std::optional<std::vector<UnitRange>> WorkQueue::pull() {
    while (!cells_.empty()) {
        const bool shortest = early_ <= 0 && ahead_ < 0;
        const std::size_t at =
            shortest ? std::max<std::size_t>(within_grain_, 1) - 1 : cells_.size() - 1;
        const std::uint64_t cell = cells_[at];
        std::uint64_t& pulled = work_[cell].pulled;
        auto [units, seconds] = piece_of(cell);
        if (early_ > 0 && (early_ -= seconds / measured_ratio(work_[cell])) <= 0) {
            sort();
            continue;
        }
        if (early_ <= 0) ahead_ += shortest ? seconds : -seconds;
        if (units > 1) units -= pulled % sweep_.measures().size();  // keeps sets whole
        units = std::min(units, sweep_.units_per_cell() - pulled);
        const std::uint64_t first = cell * sweep_.units_per_cell() + pulled;
        pulled += units;
        if (pulled == sweep_.units_per_cell()) {
            cells_.erase(cells_.begin() + static_cast<std::ptrdiff_t>(at));
            if (at < within_grain_) --within_grain_;
        }
        pieces_left_ = cells_.empty() ? 0 : std::max<std::uint64_t>(pieces_left_, 2) - 1;
        auto ranges = missing(done_, {first, first + units});
        if (!ranges.empty()) return ranges;
    }
    return std::nullopt;
}

void WorkQueue::finish(const std::vector<UnitRange>& ranges, double seconds) {
    take_out(ranges, seconds);
    if (std::has_single_bit(++finished_)) sort();
}

void WorkQueue::take_out(std::span<const UnitRange> ranges, std::optional<double> seconds) {
    std::vector<std::pair<CellWork*, double>> costs;
    double sum = 0;
    const std::uint64_t per_cell = sweep_.units_per_cell();
    for (const auto& [begin, end] : ranges)
        for (std::uint64_t first = begin; first < end;) {
            const std::uint64_t index = first / per_cell;
            const std::uint64_t last = std::min(end, (index + 1) * per_cell);
            const Cell cell = sweep_.cell(index);
            // A range that contains only some units of a set counts as a fraction of the set.
            const bool seeded = sweep_.seeded(cell.generator);
            const double sets = static_cast<double>(last - first) /
                                static_cast<double>(seeded ? sweep_.measures().size() : per_cell);
            costs.emplace_back(&work_[index], sets * set_cost(sweep_, cell).all());
            sum += costs.back().second;
            first = last;
        }
    for (const auto& [work, cost] : costs) {
        work->left = std::max(0.0, work->left - cost);
        if (!seconds) continue;
        for (CellWork* w : {work, &all_}) {
            w->finished += cost;
            w->spent += *seconds * cost / sum;
        }
    }
}

}  // namespace stipple
