// SPDX-License-Identifier: MIT
//
// Sets straight from a generator, one after the other, without files: those of a sequence come in
// blocks, so that their size does not matter; the others are made in memory, one at a time.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/spec.hpp"
#include "generators/generator.hpp"
#include "pipeline/chain.hpp"
#include "pipeline/pipeline.hpp"

namespace stipple {

class GeneratedSets {
  public:
    /// @param request its seed is that of the first set; the next ones have seed + 1, ...
    /// @throws Error(usage)
    GeneratedSets(const Generator& generator, Values options, Request request, std::uint64_t sets,
                  std::vector<Spec> warps, const RunContext& run);

    [[nodiscard]] std::uint64_t sets() const { return sets_; }
    [[nodiscard]] std::size_t dimension() const { return chain_->dimension_out(); }
    [[nodiscard]] const DomainPtr& domain() const { return chain_->domain(); }

    /// Points of a set that come in blocks; nothing where sets must be made in memory.
    [[nodiscard]] std::optional<std::uint64_t> streamed() const;

    /// What gives the points of such a set, from the one of this number on.
    [[nodiscard]] NextRows stream(std::uint64_t set, const RunContext& run,
                                  std::uint64_t from = 0) const;

    /// All points of a set.
    [[nodiscard]] PointSet made(std::uint64_t set, const RunContext& run) const;

  private:
    [[nodiscard]] std::shared_ptr<const WarpChain> chain_for(std::uint64_t set,
                                                             const RunContext& run) const;

    const Generator& generator_;
    Values options_;
    Request request_;
    std::uint64_t sets_;
    std::vector<Spec> warps_;
    Plan plan_;
    std::shared_ptr<const WarpChain> chain_;
};

}  // namespace stipple
