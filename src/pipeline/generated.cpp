// SPDX-License-Identifier: MIT
#include "pipeline/generated.hpp"

#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "core/parallel.hpp"

namespace stipple {
GeneratedSets::GeneratedSets(const Generator& generator, Values options, Request request,
                             std::uint64_t sets, std::vector<Spec> warps, const RunContext& run)
    : generator_(generator),
      options_(std::move(options)),
      request_(std::move(request)),
      sets_(sets),
      warps_(std::move(warps)),
      plan_(plan_for(generator, request_, options_)),
      chain_(std::make_shared<WarpChain>(warps_, plan_.dimension, ChainSet{}, run)) {
    if (sets_ - 1 > ~plan_.seed)
        fail(ErrorKind::usage, "--seed: {} and {} sets go beyond the 64 bits of a seed", plan_.seed,
             sets_);
    if (sets_ > 1 && !uses_seed(generator_, options_) && !chain_->seeded())
        run.tell(fmt::format("{} does not use the seed: all {} sets are the same", generator_.name,
                             sets_));
    tell_notes(generator_, request_, options_, run);
}

std::optional<std::uint64_t> GeneratedSets::streamed() const {
    if (!generator_.traits.sequence || chain_->drops()) return std::nullopt;
    return plan_.count;
}

std::shared_ptr<const WarpChain> GeneratedSets::chain_for(std::uint64_t set,
                                                          const RunContext& run) const {
    if (!chain_->seeded()) return chain_;
    return std::make_shared<WarpChain>(
        warps_, plan_.dimension,
        ChainSet{.seed = plan_.seed + set, .count = request_.start + plan_.count}, run);
}

NextRows GeneratedSets::stream(std::uint64_t set, const RunContext& run, std::uint64_t from) const {
    Plan plan = plan_;
    plan.seed += set;
    const std::shared_ptr<Sequence> sequence = generator_.sequence(plan, options_, run);
    walk_to(*sequence, request_.start + from, plan.dimension, run);
    RunContext lane = run;
    lane.progress = {};
    if (!sequence->random_access()) lane.threads = 1;
    const auto at = std::make_shared<std::uint64_t>(from);
    return [=, chain = chain_for(set, run), start = request_.start,
            count = plan.count](std::span<double> rows) {
        const std::size_t in = chain->dimension_in();
        const std::size_t out = chain->dimension_out();
        const std::uint64_t first = start + *at;
        const auto some =
            static_cast<std::size_t>(std::min<std::uint64_t>(count - *at, rows.size() / out));
        const std::size_t block = std::max<std::size_t>(1, 8192 / in);
        for_each_block(lane, some, block, [&](const Block& b) {
            const auto place = rows.subspan(b.first * out, (b.last - b.first) * out);
            if (chain->empty()) return sequence->fill(first + b.first, place);
            std::vector<double> raw((b.last - b.first) * in);
            sequence->fill(first + b.first, raw);
            std::ranges::copy(chain->forward(std::move(raw), first + b.first), place.begin());
        });
        *at += some;
        return some;
    };
}

PointSet GeneratedSets::made(std::uint64_t set, const RunContext& run) const {
    Request request = request_;
    request.seed += set;
    PointSet points = make_points(generator_, request, options_, run);
    if (!chain_->empty()) {
        RunContext silent = run;
        silent.progress = {};
        points = chain_for(set, run)->image(points, silent, request_.start);
        points.provenance = {};  // that of points of the cube
    }
    points.domain = chain_->domain();
    points.provenance.generator = generator_.name;
    return points;
}

}  // namespace stipple
