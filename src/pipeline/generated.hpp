// SPDX-License-Identifier: MIT
//
// Sets straight from a generator, warped, with their provenance: those of a sequence in blocks, so
// that their size does not matter; the others in memory, one at a time.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/spec.hpp"
#include "generators/generator.hpp"
#include "pipeline/chain.hpp"

namespace stipple {

/// Gives a set's next points, as many as fit; fewer only at its end.
using NextRows = std::function<std::size_t(std::span<double> rows)>;

/// Takes a sequential engine to point `start`, in steps between which it may be told to stop; a
/// sequence with random access needs no walk.
void walk_to(Sequence& sequence, std::uint64_t start, std::size_t dimension, const RunContext& run);

/// All points of a request, in memory, without notes, bounds and provenance.
PointSet make_points(const Generator& generator, const Request& request, const Values& options,
                     const RunContext& run);

class GeneratedSets {
  public:
    /// Tells the user what the generator has to say about the request.
    /// @param request its seed is that of the first set; the next ones have seed + 1, ...
    /// @throws Error(usage)
    GeneratedSets(const Generator& generator, Values options, Request request, std::uint64_t sets,
                  std::vector<Spec> warps, const RunContext& run);

    [[nodiscard]] std::uint64_t sets() const { return sets_; }
    [[nodiscard]] const Plan& plan() const { return plan_; }
    [[nodiscard]] std::size_t dimension() const { return chain_->dimension_out(); }
    /// What the points are on in the end.
    [[nodiscard]] const DomainPtr& domain() const { return domain_; }
    /// What scales the unit cube before any warp, where the generator does not do it itself.
    [[nodiscard]] const std::optional<Box>& bounds() const { return bounds_; }

    /// The warps, with the random choices of the first set.
    [[nodiscard]] const WarpChain& chain() const { return *chain_; }
    /// The warps with the random choices of one set.
    [[nodiscard]] std::shared_ptr<const WarpChain> chain_for(std::uint64_t set,
                                                             const RunContext& run) const;

    /// Points of a set that come in blocks; nothing where sets must be made in memory.
    [[nodiscard]] std::optional<std::uint64_t> streamed() const;

    /// The points of such a set before its warps.
    [[nodiscard]] std::unique_ptr<Sequence> sequence(std::uint64_t set,
                                                     const RunContext& run) const;

    /// What gives the points of such a set, from the one of this number on.
    [[nodiscard]] NextRows stream(std::uint64_t set, const RunContext& run,
                                  std::uint64_t from = 0) const;

    /// All points of a set.
    [[nodiscard]] PointSet made(std::uint64_t set, const RunContext& run) const;

    /// Where a set of so many points comes from.
    [[nodiscard]] Provenance provenance(std::uint64_t set, std::uint64_t count) const;

  private:
    const Generator& generator_;
    Values options_;
    Request request_;
    std::uint64_t sets_;
    std::vector<Spec> warps_;
    Plan plan_;
    std::shared_ptr<const WarpChain> chain_;
    DomainPtr domain_;
    std::optional<Box> bounds_;
    std::vector<std::pair<std::string, std::string>> inputs_;
};

}  // namespace stipple
