// SPDX-License-Identifier: MIT
//
// Box-Behnken design with three levels. Each block of an incomplete block design gives all
// combinations of the lowest and highest levels of its factors, while the other factors stay at the
// middle level. Runs at the centre follow.
//
//     factors     3   4   5   6   7    9   10   11   12   16
//     block size  2   2   2   3   3    3    4    5    4    4      (size 5: E = ABCD, 16 runs)
//     runs       12  24  40  48  56  120  160  176  192  384      plus those at the centre
//
// Shape   (runs above + --center) x k for these k.
// Source  G. E. P. Box, D. W. Behnken, Technometrics 2 (1960) 455-475,
//         doi:10.1080/00401706.1960.10489912.

#include <algorithm>
#include <bit>

#include "core/error.hpp"
#include "experiments/designs/embedded_table.hpp"
#include "experiments/designs/levels.hpp"

namespace stipple::generators::box_behnken {
namespace {

struct Blocks {
    std::size_t factors;
    std::string_view list;  ///< factors of each block, as digits in base 17
};

constexpr Blocks published[] = {
    {3, "12 13 23"},
    {4, "12 34 14 23 13 24"},
    {5, "12 34 25 13 45 23 14 35 15 24"},
    {6, "124 235 346 145 256 136"},
    {7, "456 167 257 124 347 135 236"},
    {9, "147 258 369 123 456 789 159 348 267 168 249 357 147 258 369"},
    {10, "267a 125a 2378 2469 189a 345a 1478 3579 1369 4568"},
    {11, "3789b 1489a 259ab 136ab 1247b 12358 23469 3457a 4568b 15679 2678a"},
    {12, "1257 2368 3479 458a 569b 67ac 178b 289c 139a 24ab 35bc 146c"},
    {16,
     "1269 348b 5ade 7cfg 237a 145c 6bef 89dg 256d 478f 19ae 3bcg 367e 158g 2abf 49cd 13df 24eg "
     "579b 68ac 46ag 359f 17bd 28ce"}};

/// Blocks of the published design for so many factors. @throws Error(usage) if none is published
const Blocks& blocks_for(std::size_t factors) {
    const auto* const blocks = std::ranges::lower_bound(published, factors, {}, &Blocks::factors);
    if (blocks->factors != factors)
        fail(ErrorKind::usage,
             "--dimension: no Box-Behnken design of {} factors is published; {} and {} are the "
             "nearest",
             factors, (blocks - 1)->factors, blocks->factors);
    return *blocks;
}

/// Index of each factor within each block, -1 for factors outside the block.
using Places = std::vector<std::vector<int>>;

Places places_of(const Blocks& blocks) {
    Places places;
    for (const std::string_view block : split(blocks.list, ' ')) {
        auto& of_factor = places.emplace_back(blocks.factors, -1);
        for (std::size_t j = 0; j < block.size(); ++j)
            of_factor[number_of(block.substr(j, 1), 17) - 1] = static_cast<int>(j);
    }
    return places;
}

/// Binary logarithm of the runs per block: the number of its factors, but 4 for five factors.
std::size_t log_runs(const Blocks& blocks) {
    return std::min<std::size_t>(4, blocks.list.find(' '));
}

Plan plan(const Request& request, const Values& options) {
    const std::size_t k = request.dimension.value_or(3);
    const Blocks& blocks = blocks_for(k);
    const std::uint64_t runs = places_of(blocks).size() << log_runs(blocks);
    return plan_with_center(request, options, runs, k,
                            fmt::format("the Box-Behnken design of {} factors", k));
}

std::unique_ptr<Sequence> make(const Plan& plan, const Values& options, const RunContext&) {
    const Blocks& blocks = blocks_for(plan.dimension);
    const bool ends = options[ends_option];
    return level_sequence(
        plan, level_places(3, ends),
        [places = places_of(blocks), log = log_runs(blocks)](std::uint64_t run,
                                                             std::size_t factor) -> std::size_t {
            const std::uint64_t block = run >> log;
            const int at = block < places.size() ? places[block][factor] : -1;
            if (at < 0) return 1;
            const auto bits = static_cast<unsigned>(run & ((std::uint64_t{1} << log) - 1));
            if (at < 4) return (bits >> at & 1) != 0 ? 2 : 0;
            return std::popcount(bits) % 2 == 0 ? 2 : 0;  // level of the fifth factor, E = ABCD
        },
        {{"coded_bounds", coded_range(3, ends)}});
}

}  // namespace

Generator unit() {
    return {
        .name = "box-behnken",
        .summary = "Three-level design without corners, for quadratic models, by Box and Behnken",
        .source = "Box, Behnken 1960, doi:10.1080/00401706.1960.10489912",
        .related = {"doe", "experiment", "response-surface", "rsm", "bbdesign", "quadratic"},
        .traits = level_traits(3, 16),
        .options = Schema(center_option, ends_option),
        .aliases = {"bbd"},
        .plan = plan,
        .sequence = make};
}

}  // namespace stipple::generators::box_behnken
