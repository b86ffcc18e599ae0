// SPDX-License-Identifier: MIT
#include "study/work_queue.hpp"

#include <algorithm>
#include <cmath>

namespace stipple {
namespace {

constexpr double once = 2e-5;  // what every set and every measure costs, however small

/// A set of a cell with all its measures.
double set_cost(const Sweep& sweep, const Cell& cell) {
    double seconds = generate_cost(sweep, cell);
    for (std::size_t m = 0; m < sweep.measures().size(); ++m)
        seconds += measure_cost(sweep, cell, m);
    return seconds;
}

}  // namespace

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

double generate_cost(const Sweep& sweep, const Cell& cell) {
    const auto& generator = *sweep.generators()[cell.generator].unit;
    const auto n = static_cast<double>(cell.count);
    const auto d = static_cast<double>(cell.dimension);
    const double warps = 5e-8 * n * d * static_cast<double>(sweep.warps().size());
    if (generator.cost) return once + generator.cost(n, d) + warps;
    if (generator.traits.sequence) return once + 3e-8 * n * d + warps;
    return once + 3e-5 * n * std::pow(5.0, std::max(0.0, d - 2)) + warps;
}

double measure_cost(const Sweep& sweep, const Cell& cell, std::size_t measure) {
    const Analyzer& analyzer = *sweep.measures()[measure].unit;
    const auto n = static_cast<double>(cell.count);
    const auto d = static_cast<double>(cell.dimension);
    return once + (analyzer.cost ? analyzer.cost(n, d) : 5e-7 * n * d);
}

WorkLeft::WorkLeft(const Sweep& sweep, const std::vector<UnitRange>& done)
    : sweep_(sweep), parts_(sweep.generators().size() * sweep.request().dimensions.size()) {
    for (std::uint64_t c = 0; c < sweep.cells(); ++c) {
        const Cell cell = sweep.cell(c);
        const auto seeds = static_cast<double>(sweep.request().seeds);
        part_of(c).left += (sweep.seeded(cell.generator) ? seeds : 1) * set_cost(sweep, cell);
    }
    finish(done, std::nullopt);
}

WorkLeft::Part& WorkLeft::part_of(std::uint64_t cell) {
    return parts_[static_cast<std::size_t>(cell / sweep_.request().counts.size())];
}

void WorkLeft::finish(const std::vector<UnitRange>& ranges, std::optional<double> seconds) {
    std::vector<std::pair<Part*, double>> costs;
    double all = 0;
    const std::uint64_t per_cell = sweep_.units_per_cell();
    for (const auto& [begin, end] : ranges)
        for (std::uint64_t first = begin; first < end;) {
            const std::uint64_t index = first / per_cell;
            const std::uint64_t last = std::min(end, (index + 1) * per_cell);
            const Cell cell = sweep_.cell(index);
            // Ranges that begin or end inside a set count for their share of it.
            const std::uint64_t units_of_set =
                sweep_.seeded(cell.generator) ? sweep_.measures().size() : per_cell;
            const double sets =
                static_cast<double>(last - first) / static_cast<double>(units_of_set);
            costs.emplace_back(&part_of(index), sets * set_cost(sweep_, cell));
            all += costs.back().second;
            first = last;
        }
    for (const auto& [part, cost] : costs) {
        part->left = std::max(0.0, part->left - cost);
        if (!seconds) continue;
        part->modelled += cost;
        part->spent += *seconds * cost / all;
    }
}

double WorkLeft::seconds() const {
    double modelled = 0;
    double spent = 0;
    for (const Part& part : parts_) {
        modelled += part.modelled;
        spent += part.spent;
    }
    double left = 0;
    for (const Part& part : parts_)
        left += part.left * (part.modelled > 0 ? part.spent / part.modelled
                             : modelled > 0    ? spent / modelled
                                               : 1);
    return left;
}

WorkQueue::WorkQueue(const Sweep& sweep, std::vector<UnitRange> done, std::size_t workers)
    : sweep_(sweep), done_(std::move(done)) {
    constexpr double longest = 1;      // seconds of a piece
    constexpr double shortest = 2e-3;  // less would be spent on handing out
    constexpr double pieces_of_worker = 32;
    const double left = WorkLeft(sweep, done_).seconds();
    const double share = left / (pieces_of_worker * static_cast<double>(workers));
    const double grain = std::clamp(share, shortest, longest);
    for (std::uint64_t cell = 0; cell < sweep.cells(); ++cell) {
        cuts_.push_back(cut_of(cell, grain));
        pieces_left_ += cuts_.back().pieces;
    }
    std::ranges::stable_sort(cuts_, std::ranges::greater{}, [&](const Cut& cut) {
        return cut.cost > 1.001 * grain ? cut.cost : 0;
    });
}

WorkQueue::Cut WorkQueue::cut_of(std::uint64_t index, double grain) const {
    const Cell cell = sweep_.cell(index);
    const std::uint64_t measures = sweep_.measures().size();
    const double made = generate_cost(sweep_, cell);
    const double measured = set_cost(sweep_, cell) - made;
    Cut cut{.cell = index};
    if (!sweep_.seeded(cell.generator)) {  // one set is all, but its rows must find room
        constexpr std::uint64_t most_sets = 1 << 16;
        cut.units = measures * std::min(sweep_.request().seeds, most_sets);
        cut.cost = made + measured;
    } else if (made + measured > 2 * grain && measured > 2 * made && measures > 1) {
        cut.cost = made + measured / static_cast<double>(measures);
    } else {
        const double sets = std::floor(std::clamp(grain / (made + measured), 1.0,
                                                  static_cast<double>(sweep_.request().seeds)));
        cut.units = measures * static_cast<std::uint64_t>(sets);
        cut.cost = sets * (made + measured);
    }
    cut.pieces = (sweep_.units_per_cell() + cut.units - 1) / cut.units;
    return cut;
}

std::optional<std::vector<UnitRange>> WorkQueue::pull() {
    while (cut_ < cuts_.size()) {
        const Cut& cut = cuts_[cut_];
        const std::uint64_t begin = cut.cell * sweep_.units_per_cell();
        const std::uint64_t first = begin + piece_ * cut.units;
        const std::uint64_t last = std::min(first + cut.units, begin + sweep_.units_per_cell());
        --pieces_left_;
        if (++piece_ == cut.pieces) {
            piece_ = 0;
            ++cut_;
        }
        auto ranges = missing(done_, {first, last});
        if (!ranges.empty()) return ranges;
    }
    return std::nullopt;
}

}  // namespace stipple
