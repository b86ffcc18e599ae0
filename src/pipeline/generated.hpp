// SPDX-License-Identifier: MIT
//
// Generated and warped sets with their provenance. Points of a sequence are made in blocks, so that
// a set need not fit in memory; other sets are made in memory, one at a time.
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

/// Part number `index`, from 0, of a set that is cut into `of` contiguous parts.
struct Shard {
    std::uint64_t index = 0;
    std::uint64_t of = 1;
};

/// A job: sets to generate and warp, or one shard of a set.
struct SetsToMake {
    const Generator* generator = nullptr;
    Values options = {};
    /// request.seed is the seed of the first set; later sets have seed + 1, ... With warps,
    /// request.bounds may have ranges for only those coordinates that no warp takes.
    Request request = {};
    std::uint64_t sets = 1;
    std::vector<Spec> warps = {};
    Shard shard = {};
    std::string command = {};  ///< command line, for the provenance
};

/// Returns the command line that makes the same sets, for a job made by function calls.
std::string command_of(const SetsToMake& asked);

/// Parses a box "lo..hi,...": one range for all coordinates, one for each coordinate of the points,
/// or one for each coordinate that no warp takes. The number of ranges may determine the dimension.
/// @throws Error(usage)
Box bounds_for(const SetsToMake& asked, std::string_view text);

/// Maps some coordinates of points from the unit cube to a box.
struct Scaling {
    Box box;
    std::vector<std::size_t> columns;  ///< coordinates to map, one for each axis of the box

    /// Maps rows of `width` numbers in place.
    void apply(std::span<double> rows, std::size_t width) const;
};

class GeneratedSets {
  public:
    /// Completes the job. Warns with the generator's notes on the request. @throws Error(usage)
    GeneratedSets(SetsToMake asked, const RunContext& run);

    [[nodiscard]] std::uint64_t sets() const { return asked_.sets; }
    /// Number of sets that differ: 1 if the points do not depend on the seed.
    [[nodiscard]] std::uint64_t different_sets() const;
    [[nodiscard]] const Plan& plan() const { return plan_; }
    [[nodiscard]] std::size_t dimension() const { return chain_->dimension_out(); }
    /// Domain of the points after all warps and scaling.
    [[nodiscard]] const DomainPtr& domain() const { return domain_; }
    /// Warps and scrambles with the properties that all sets share. Not for mapping points of a
    /// set: its scrambles do not have the set's seed.
    [[nodiscard]] const WarpChain& chain() const { return *chain_; }

    /// Number of points of a set, if sets can be made in blocks; nullopt if they must be made in
    /// memory.
    [[nodiscard]] std::optional<std::uint64_t> streamed() const;

    /// Returns a reader of the points [first, last) of a set that is made in blocks; by default, of
    /// all its points. Without random access to the sequence, use only one reader at a time.
    [[nodiscard]] NextRows stream(std::uint64_t set, const RunContext& run, std::uint64_t first = 0,
                                  std::optional<std::uint64_t> last = {}) const;

    /// Makes all points of a set in memory.
    [[nodiscard]] PointSet made(std::uint64_t set, const RunContext& run) const;

    /// Makes the sequence in advance if all sets share it, so that provenance() includes the
    /// results of its search.
    void prepare(const RunContext& run) const;

    /// Side files of the sequence that was made last.
    [[nodiscard]] std::vector<SideFile> side_files() const;

    /// Warns of categories, and of levels of a design, that no point of the first set has. Does
    /// nothing unless sets are made in blocks and have at most 2^16 points.
    void tell_absent_levels(const RunContext& run) const;

    /// Provenance of a set with `count` points.
    [[nodiscard]] Provenance provenance(std::uint64_t set, std::uint64_t count) const;

  private:
    /// The warps and scrambles for one set.
    /// @param made number of points before the warps, if it is not that of the plan
    [[nodiscard]] std::shared_ptr<const WarpChain> chain_for(
        std::uint64_t set, const RunContext& run, std::optional<std::uint64_t> made = {}) const;
    [[nodiscard]] std::shared_ptr<const WarpChain> make_chain(const ChainSet& set,
                                                              const RunContext& run) const;
    /// Generates the points of a set, before its warps.
    [[nodiscard]] PointSet raw_points(std::uint64_t set, const Plan& plan,
                                      const RunContext& run) const;
    /// If the set extends the runs of an experiment, its first points are images of these runs:
    /// replaces them by the exact numbers in the file of the runs.
    void keep_runs(PointSet& points, const RunContext& run) const;

    struct Images {
        std::vector<double> rows;
        std::uint64_t made;  ///< points generated, including those without an image
        std::uint64_t kept;  ///< number of generated points that have an image
    };
    /// Returns the requested number of images of a sequence's points. Points without an image are
    /// skipped; request.start counts only points that have one.
    /// @throws Error(input) if almost no point has an image
    [[nodiscard]] Images next_images(std::uint64_t set, const RunContext& run) const;
    /// Generates slightly larger sets until enough points have an image. If the generator has no
    /// larger sets, returns the images of `first`, which may be fewer than requested.
    /// @param first points of a set of the requested size, before warps
    [[nodiscard]] Images images_of_more(std::uint64_t set, const PointSet& first,
                                        const RunContext& run) const;

    /// The sequence of a set, before its warps; all sets share one object if the seed does not
    /// matter.
    [[nodiscard]] std::shared_ptr<Sequence> sequence(std::uint64_t set,
                                                     const RunContext& run) const;
    [[nodiscard]] std::unique_ptr<Sequence> new_sequence(Plan plan, std::uint64_t set,
                                                         const RunContext& run) const;

    SetsToMake asked_;
    const Generator& generator_;
    Plan plan_;
    std::shared_ptr<const WarpChain> chain_;
    DomainPtr domain_;
    std::optional<Scaling> scaling_;  ///< nullopt without bounds, or if the generator applies them
    std::vector<std::pair<std::string, std::string>> inputs_;
    mutable std::shared_ptr<Sequence> sequence_;  ///< the sequence made last
};

}  // namespace stipple
