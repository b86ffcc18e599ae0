// SPDX-License-Identifier: MIT
#include "study/work_queue.hpp"

#include <algorithm>
#include <cmath>

#include "study/work_cost.hpp"

namespace stipple {

void UnitSet::add(UnitRange range) {
    if (range.first >= range.last) return;
    auto it = parts_.upper_bound(range.first);
    if (it != parts_.begin() && std::prev(it)->second >= range.first) --it;
    while (it != parts_.end() && it->first <= range.last) {
        range.first = std::min(range.first, it->first);
        range.last = std::max(range.last, it->second);
        it = parts_.erase(it);
    }
    parts_.emplace(range.first, range.last);
}

std::vector<UnitRange> UnitSet::missing(UnitRange range) const {
    std::vector<UnitRange> gaps;
    auto it = parts_.upper_bound(range.first);
    if (it != parts_.begin()) range.first = std::max(range.first, std::prev(it)->second);
    for (; it != parts_.end() && it->first < range.last; ++it) {
        if (range.first < it->first) gaps.push_back({range.first, it->first});
        range.first = std::max(range.first, it->second);
    }
    if (range.first < range.last) gaps.push_back(range);
    return gaps;
}

std::vector<UnitRange> UnitSet::ranges() const {
    std::vector<UnitRange> all;
    for (const auto& [first, last] : parts_) all.push_back({first, last});
    return all;
}

WorkQueue::WorkQueue(const Sweep& sweep, UnitSet done, std::size_t workers)
    : sweep_(sweep), done_(std::move(done)) {
    constexpr double longest = 1;      // seconds of a piece
    constexpr double shortest = 2e-3;  // less would be spent on handing out
    constexpr double pieces_of_worker = 32;
    WorkLeft left(sweep);
    left.forget(done_.ranges());
    const double share = left.seconds() / (pieces_of_worker * static_cast<double>(workers));
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
    double measured = 0;
    for (std::size_t m = 0; m < measures; ++m) measured += measure_cost(sweep_, cell, m);
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
        auto ranges = done_.missing({first, last});
        if (!ranges.empty()) return ranges;
    }
    return std::nullopt;
}

}  // namespace stipple
