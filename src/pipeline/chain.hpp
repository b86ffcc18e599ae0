// SPDX-License-Identifier: MIT
//
// Warps and scrambles applied one after the other, each to the coordinates that its spec names:
// disk@4,5.
//
// Shape  rows of the unit cube in, rows of chain.domain() out. If a warp changes the number of
//        coordinates, those of its image are consecutive, from the position of the first one taken;
//        later specs refer to the changed row.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/point_set.hpp"
#include "core/spec.hpp"
#include "generators/generator.hpp"
#include "pipeline/domains.hpp"
#include "scrambles/scramble.hpp"
#include "warps/warp.hpp"

namespace stipple {

/// Properties of a set of points on which its images depend.
struct ChainSet {
    std::uint64_t seed = 1;
    std::uint64_t count = 1;  ///< number of points of the whole set; 0: not known
    /// Base of the digits of each coordinate, or one base for all; empty if all bases are 2.
    std::vector<std::uint32_t> bases = {};
    /// Range of each coordinate. Coordinates that no warp takes are scaled to it after the chain.
    std::optional<Box> bounds = {};
};

ChainSet chain_set(const Generator& generator, const Plan& plan, const Values& options);

struct ChainTraits {
    bool drops = false;            ///< some points may have no image
    bool refills = false;          ///< other points replace those without an image
    bool needs_whole_set = false;  ///< the image of a point depends on all points of its set
    bool seeded = false;           ///< the images depend on the set's seed
};

/// Warps and scrambles as stored in the provenance.
struct ChainRecord {
    std::vector<std::string> specs = {};  ///< without options that have their default value
    std::vector<std::string> files = {};  ///< files that the warps and scrambles read
    /// Names of units whose stream version is above 1, with that version.
    std::vector<std::pair<std::string, std::uint64_t>> stream_versions = {};
};

class WarpChain {
  public:
    /// @param warped domains of already warped coordinates, which the chain must not change
    /// @throws Error(usage) for unknown warps, and for missing or already warped coordinates
    WarpChain(std::span<const Spec> specs, std::size_t dimension, const ChainSet& set = {},
              const RunContext& run = {}, std::vector<Factor> warped = {});

    [[nodiscard]] bool empty() const { return steps_.empty(); }
    [[nodiscard]] std::size_t dimension_in() const { return dimension_in_; }
    [[nodiscard]] std::size_t dimension_out() const { return from_.size(); }
    [[nodiscard]] const DomainPtr& domain() const { return domain_; }
    [[nodiscard]] const ChainTraits& traits() const { return traits_; }
    [[nodiscard]] const ChainRecord& record() const { return record_; }

    /// Coordinates of the points that no warp takes, in order, each with its position in the
    /// images.
    [[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> kept() const;

    /// Discrete outcomes (such as levels) of each input coordinate. A coordinate counts as
    /// continuous if its outcomes depend on others, or if it is scrambled before the warp.
    [[nodiscard]] std::vector<OutcomeAxis> outcome_axes() const;

    /// Returns the names of the coordinates of the images or, with `back`, of the preimages.
    /// Coordinates that a warp maps are named by its domain, others as in `before`; the remaining
    /// ones get default names. Empty if all names are default names.
    /// @param before names before the mapping; empty: default names
    [[nodiscard]] std::vector<std::string> names(std::vector<std::string> before = {},
                                                 bool back = false) const;

    /// Returns the images of rows first, first + 1, ... of the set. Coordinates that warps take
    /// must be in the unit cube. If points may be dropped, there may be fewer images than rows.
    [[nodiscard]] std::vector<double> forward(std::vector<double> rows,
                                              std::uint64_t first = 0) const;

    /// Returns the preimages of rows. Their coordinates that warps take are in [0, 1).
    /// @throws Error(usage) if a step has no inverse; Error(input) for points outside the domain
    [[nodiscard]] std::vector<double> inverse(std::vector<double> rows) const;

    /// Runs forward() or, with `back`, inverse() on all threads. The first row is row `first` of
    /// the set. @throws the errors of forward() and inverse(); Error(cancelled), Error(limit)
    [[nodiscard]] std::vector<double> mapped(std::span<const double> rows, bool back,
                                             std::uint64_t first, const RunContext& run) const;

    /// Density at each row that forward() returned, with respect to the measure of domain().
    [[nodiscard]] std::vector<double> density(std::span<const double> rows) const;

    /// Warns of the first row whose infinite image forward() has replaced by a finite one; once in
    /// the lifetime of the chain.
    void tell_infinite(const RunContext& run) const;

  private:
    /// A mapping (warp), a randomization (scramble), or neither: then it only sets the domain of
    /// coordinates that the chain does not change. A coordinate has at most one mapping, the last
    /// of its steps.
    struct Step {
        DomainPtr domain = {};  ///< domain of the step's output; null for a randomization
        std::unique_ptr<Mapping> mapping = {};
        Mapping::SetStep set_step = {};  ///< applied to whole sets before the mapping
        Randomization randomization = {};
        std::vector<std::size_t> coordinates = {};  ///< coordinates taken from the input row
        std::vector<std::size_t> rest = {};         ///< other coordinates of the input row
        std::vector<std::size_t> at = {};           ///< positions of the image in the output row
        std::vector<std::size_t> others = {};       ///< positions of `rest` in the output row
        std::vector<std::size_t> from = {};   ///< positions of `coordinates` in the chain's input
        std::vector<std::size_t> image = {};  ///< positions of the image in the chain's output
        std::size_t width_in = 0;             ///< numbers in the input row
        std::size_t width_out = 0;            ///< numbers in the output row
    };

    /// Applies the steps [from, to) to rows. If step `from` reorders whole sets, apply_set_step()
    /// must have been called for it.
    [[nodiscard]] std::vector<double> through(std::vector<double> rows, std::uint64_t first,
                                              std::size_t from, std::size_t to) const;

    /// Indices of the steps that reorder whole sets, in order, and then the number of steps.
    [[nodiscard]] std::vector<std::size_t> stops() const;

    /// Applies a step's set_step to the coordinates that it takes, in all rows of a set.
    static void apply_set_step(const Step& step, std::span<double> rows, const RunContext& run);

    /// Records in infinite_ the lowest index of a row that a step maps to infinity.
    /// @param cube coordinates that the step maps, of several rows
    /// @param first index of the first of these rows
    void note_infinite(const Step& step, std::span<const double> cube, std::uint64_t first) const;

    /// Adds a step that only sets the domain of some coordinates.
    void set_domain(Factor factor);
    void set_bases(Values& values, const Scramble& scramble,
                   std::span<const std::size_t> coordinates,
                   const std::vector<std::uint32_t>& bases) const;
    void add_scramble(const Scramble& scramble, const Spec& spec, const ChainSet& set);
    void add_warp(const Warp& warp, const Spec& spec, const RunContext& run);
    template <class Unit>
    void remember(const Unit& unit, const Spec& spec, const Values& values);
    /// Returns a step for the coordinates that a spec names, or for all.
    /// @throws Error(usage) if one is missing, or already has a domain other than the unit cube
    [[nodiscard]] Step step_of(const Spec& spec) const;

    std::vector<Step> steps_;
    ChainTraits traits_;
    ChainRecord record_;
    std::size_t dimension_in_;
    /// Input coordinate that each output coordinate was before scrambles; `none` if a warp made it.
    std::vector<std::size_t> from_;
    DomainPtr domain_;
    mutable std::atomic<std::uint64_t> infinite_ = none;  ///< row to warn of, `none` or `told`
    static constexpr std::uint64_t none = ~std::uint64_t{0};
    static constexpr std::uint64_t told = none - 1;
};

/// Level names of categorical coordinates in the images, from the warps' domains.
Levels levels_of(const WarpChain& chain);

/// Domain of the preimages of points that are on the domain `after`.
DomainPtr domain_before(const WarpChain& chain, const DomainPtr& after);

/// Returns the images of all points; they are on chain.domain() and keep the provenance. Warns of
/// points without an image, and multiplies the efficiency in the provenance by the fraction of
/// points that have one.
/// @param start index of the first point
/// @throws Error(input) for points of another dimension, and if none has an image; the errors of
/// WarpChain::mapped()
PointSet image_of(const PointSet& points, const WarpChain& chain, const RunContext& run,
                  std::uint64_t start = 0);

/// Returns the preimages of all points, with their provenance. Coordinates that no warp takes keep
/// their domain.
/// @throws Error(input) for points of another dimension; the errors of WarpChain::mapped()
PointSet preimage_of(const PointSet& points, const WarpChain& chain, const RunContext& run);

/// Warns if points were dropped, so that only `kept` of `count` points remain.
/// @throws Error(input) if none remains
void tell_kept(const WarpChain& chain, std::uint64_t count, std::uint64_t kept,
               const RunContext& run);

/// Returns the selected columns of all rows, as shorter rows.
std::vector<double> gather(std::span<const double> rows, std::size_t width,
                           std::span<const std::size_t> columns);

/// Returns the input files that options name, including those in nested specs, in order.
/// @param written options that name output files
std::vector<std::string> files_of(const Schema& schema, const Values& values,
                                  std::span<const std::string> written = {});

/// Returns the input files that a generator's options and its warps name.
std::vector<std::string> files_of(const Generator& generator, const Values& values,
                                  std::span<const Spec> warps);

/// Returns the input files in specs of warps or, with `generators`, of generators; skips bad specs.
std::vector<std::string> files_in(std::string_view specs, std::string_view separator,
                                  bool generators = false);

/// Recorded instead of a fingerprint for input that cannot be read again, such as a pipe.
inline constexpr std::string_view not_kept = "not kept";

/// Returns the names of files with the fingerprints of their bytes. @throws Error(io)
std::vector<std::pair<std::string, std::string>> fingerprints(std::span<const std::string> files,
                                                              const RunContext& run);

}  // namespace stipple
