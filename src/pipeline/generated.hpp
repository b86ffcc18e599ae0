// SPDX-License-Identifier: MIT
//
// Sets straight from a generator, warped, with their provenance: those of a sequence in blocks, so
// that their size does not matter; the others in memory, one at a time.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/spec.hpp"
#include "generators/generator.hpp"
#include "pipeline/chain.hpp"
#include "pipeline/stream.hpp"

namespace stipple {

/// Part `index` of `of` contiguous parts.
struct Shard {
    std::uint64_t index = 0;
    std::uint64_t of = 1;
};

/// Sets to make, or a part of one.
struct SetsToMake {
    const Generator* generator = nullptr;
    Values options = {};
    /// Its seed is that of the first set; the next ones have seed + 1, ... Bounds may be those of the
    /// coordinates that no warp takes.
    Request request = {};
    std::uint64_t sets = 1;
    std::vector<Spec> warps = {};
    Shard shard = {};          ///< that is written
    std::string command = {};  ///< for the provenance
};

/// The box of a text "lo..hi,...", with one range for all coordinates, or one for each of the points
/// or of those that the warps leave. It may decide the dimension. @throws Error(usage)
Box bounds_for(const SetsToMake& asked, std::string_view text);

/// All points of a request, in memory, without notes, bounds and provenance.
PointSet make_points(const Generator& generator, const Request& request, const Values& options,
                     const RunContext& run);

/// Some coordinates of points, which go from the unit cube to a box.
struct Scaling {
    Box box;
    std::vector<std::size_t> columns;  ///< of the rows

    /// Moves rows of `width` numbers.
    void apply(std::span<double> rows, std::size_t width) const;
};

class GeneratedSets {
  public:
    /// Tells the user what the generator has to say about the request. @throws Error(usage)
    GeneratedSets(SetsToMake asked, const RunContext& run);

    [[nodiscard]] std::uint64_t sets() const { return asked_.sets; }
    /// 1 where no seed changes the points.
    [[nodiscard]] std::uint64_t different_sets() const;
    [[nodiscard]] const Plan& plan() const { return plan_; }
    [[nodiscard]] std::size_t dimension() const { return chain_->dimension_out(); }
    /// What the points are on in the end.
    [[nodiscard]] const DomainPtr& domain() const { return domain_; }
    /// The warps, with the random choices of the first set.
    [[nodiscard]] const WarpChain& chain() const { return *chain_; }

    /// Points of a set that come in blocks; nothing where sets must be made in memory.
    [[nodiscard]] std::optional<std::uint64_t> streamed() const;

    /// What gives the points [first, last) of such a set, all from the first on by default; one at a
    /// time where they come in order.
    [[nodiscard]] NextRows stream(std::uint64_t set, const RunContext& run, std::uint64_t first = 0,
                                  std::optional<std::uint64_t> last = {}) const;

    /// All points of a set.
    [[nodiscard]] PointSet made(std::uint64_t set, const RunContext& run) const;

    /// Makes the sequence beforehand, if all sets have the same, so that their provenance tells
    /// what a search found.
    void prepare(const RunContext& run) const;

    /// What comes with the sequence that was made last.
    [[nodiscard]] std::vector<SideFile> side_files() const;

    /// Tells the user which words, and which outcomes of a design's levels, no point of a set that
    /// comes in blocks has, if these are few.
    void tell_absent_levels(const RunContext& run) const;

    /// Where a set of so many points comes from.
    [[nodiscard]] Provenance provenance(std::uint64_t set, std::uint64_t count) const;

  private:
    /// The warps with the random choices of one set. @param made number of its points, if the plan
    /// leaves it open
    [[nodiscard]] std::shared_ptr<const WarpChain> chain_for(
        std::uint64_t set, const RunContext& run, std::optional<std::uint64_t> made = {}) const;
    [[nodiscard]] std::shared_ptr<const WarpChain> make_chain(const ChainSet& set,
                                                              const RunContext& run) const;
    /// The points of a set before its warps.
    [[nodiscard]] PointSet raw_points(std::uint64_t set, const Plan& plan,
                                      const RunContext& run) const;
    /// Whether warps drop some points of a sequence, and the next ones take their place.
    [[nodiscard]] bool goes_on() const;
    /// Makes the images of runs that were made before what these were.
    void keep_runs(PointSet& points, const RunContext& run) const;

    struct Images {
        std::vector<double> rows;
        std::uint64_t made;  ///< points that they are the images of, with those that have none
        std::uint64_t kept;  ///< of these, all that have one
    };
    /// As many images as points are asked for, by the points of a sequence that have one: of these
    /// number `start`, start + 1, ... @throws Error(input) where next to none has an image
    [[nodiscard]] Images next_images(std::uint64_t set, const RunContext& run) const;
    /// By a set of more points, little more than it takes; of a set of fixed size, those that there
    /// are. `first` are the points before warps.
    [[nodiscard]] Images images_of_more(std::uint64_t set, const PointSet& first,
                                        const RunContext& run) const;

    /// The points of a set before its warps; the same object for all sets that are the same.
    [[nodiscard]] std::shared_ptr<Sequence> sequence(std::uint64_t set,
                                                     const RunContext& run) const;
    /// The same of another plan.
    [[nodiscard]] std::unique_ptr<Sequence> new_sequence(Plan plan, std::uint64_t set,
                                                         const RunContext& run) const;

    SetsToMake asked_;
    const Generator& generator_;
    Plan plan_;
    std::shared_ptr<const WarpChain> chain_;
    DomainPtr domain_;
    std::optional<Scaling> scaling_;  ///< to the bounds, where the generator does not do it
    std::vector<std::pair<std::string, std::string>> inputs_;
    mutable std::shared_ptr<Sequence> sequence_;  ///< that was made last
};

}  // namespace stipple
