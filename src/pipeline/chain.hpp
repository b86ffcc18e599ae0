// SPDX-License-Identifier: MIT
//
// Warps and scrambles one after the other, each on the coordinates that its spec names: disk@4,5.
//
// Shape  rows of the unit cube in, rows of chain.domain() out. A warp whose image has more or fewer
//        numbers than it takes puts them where its first coordinate stood; later specs count the
//        coordinates of the row as it then is.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
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

/// The set whose points go through a chain, as far as scrambles depend on it.
struct ChainSet {
    std::uint64_t seed = 1;
    std::uint64_t count = 1;  ///< points of the whole set
    /// Of the digits of each coordinate, or of all; empty: 2.
    std::vector<std::uint32_t> bases = {};
};

/// The same of the points of a plan.
ChainSet chain_set(const Generator& generator, const Plan& plan, const Values& options);

class WarpChain {
  public:
    /// @param warped coordinates that are on domains of their own already, and stay as they are
    /// @throws Error(usage): unknown warps, coordinates that are not there or no longer uniform.
    WarpChain(std::span<const Spec> specs, std::size_t dimension, const ChainSet& set = {},
              const RunContext& run = {}, std::vector<Factor> warped = {});

    [[nodiscard]] bool empty() const { return steps_.empty(); }
    [[nodiscard]] std::size_t dimension_in() const { return dimension_in_; }
    [[nodiscard]] std::size_t dimension_out() const { return dimension_out_; }
    [[nodiscard]] const DomainPtr& domain() const { return domain_; }

    /// Coordinates of the points that no warp takes, in order, each with its place in the images.
    [[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> kept() const;

    /// Says what such coordinates of the images are on in the end.
    void put_on(const std::vector<Factor>& factors);

    /// The specs, with what differs from the defaults.
    [[nodiscard]] const std::vector<std::string>& specs() const { return specs_; }

    /// Files that its units read.
    [[nodiscard]] const std::vector<std::string>& files() const { return files_; }

    /// Units whose rules are of a later version than the first, each with it.
    [[nodiscard]] const std::vector<std::pair<std::string, std::uint64_t>>& stream_versions()
        const {
        return stream_versions_;
    }

    /// Whether some points may have no image.
    [[nodiscard]] bool drops() const;

    /// Whether a set shall have as many images as points are asked for.
    [[nodiscard]] bool refills() const;

    /// What each coordinate of the points becomes by itself.
    [[nodiscard]] std::vector<OutcomeAxis> outcome_axes() const;

    /// Whether the image of a point depends on all points of its set: rows are then always those of a
    /// whole set.
    [[nodiscard]] bool needs_whole_set() const;

    /// Whether the images depend on the set's seed.
    [[nodiscard]] bool seeded() const { return seeded_; }

    /// Images of rows first, first + 1, ... of the set, whose coordinates that are taken are in the
    /// unit cube; with drops(), fewer rows may come out than went in.
    [[nodiscard]] std::vector<double> forward(std::vector<double> rows,
                                              std::uint64_t first = 0) const;

    /// Back to the unit cube, below 1. @throws Error(usage) where a warp has no inverse,
    /// Error(input) for points off the domain.
    [[nodiscard]] std::vector<double> inverse(std::vector<double> rows) const;

    /// Names of the coordinates of images of points whose coordinates have these (none: the usual
    /// ones) or, with `back`, of what they are the images of. What a warp gives has the names that
    /// its domain has, else the usual ones. Empty: all are usual.
    [[nodiscard]] std::vector<std::string> names(std::vector<std::string> before, bool back) const;

    /// What numbers of the images stand for, as the warps' domains tell.
    [[nodiscard]] Levels levels() const;

    /// What forward() or, with `back`, inverse() gives, on all threads; the first row is row `first`
    /// of the set. @throws as these do; Error(cancelled), Error(limit)
    [[nodiscard]] std::vector<double> mapped(std::span<const double> rows, bool back,
                                             std::uint64_t first, const RunContext& run) const;

    /// Images of all points; the first one has the index `start`. They are on domain(), and keep the
    /// provenance. Tells the user how many points have none, and multiplies the efficiency by the
    /// share of the others.
    /// @throws Error(input) for points of another dimension, and where none has an image; as mapped()
    [[nodiscard]] PointSet image(const PointSet& points, const RunContext& run,
                                 std::uint64_t start = 0) const;

    /// What all points are the images of, in the same way; what else is not of the unit cube, stays
    /// on the domain that it has.
    [[nodiscard]] PointSet preimage(const PointSet& points, const RunContext& run) const;

    /// Tells the user how many of `count` points were kept, where some may be dropped.
    /// @throws Error(input) when none was
    void tell_kept(std::uint64_t count, std::uint64_t kept, const RunContext& run) const;

    /// What preimages of points on `after` are on.
    [[nodiscard]] DomainPtr domain_before(const DomainPtr& after) const;

    /// Tells the user, once, of the first row that forward() was given a finite image for though its
    /// own is infinitely far.
    void tell_infinite(const RunContext& run) const;

    /// Density of each row that forward() gave, with respect to the measure of domain().
    [[nodiscard]] std::vector<double> density(std::span<const double> rows) const;

  private:
    /// Either a mapping or a randomization; or what was before, which changes nothing.
    struct Step {
        DomainPtr domain = {};  ///< of the step's output; null for a randomization
        std::unique_ptr<Mapping> mapping = {};
        Mapping::SetStep set_step = {};  ///< of the mapping, before it
        bool refills = false;            ///< the points that the mapping drops are replaced
        Randomization randomization = {};
        std::vector<std::size_t> coordinates = {};  ///< taken from the row before
        std::vector<std::size_t> rest = {};         ///< of the row before
        std::vector<std::size_t> at = {};           ///< where its numbers stand in the row after
        std::vector<std::size_t> others = {};       ///< where the rest stands there
        std::vector<std::size_t> image = {};        ///< where its numbers stand in the last row
        std::size_t width_in = 0;                   ///< numbers of the row before
        std::size_t width_out = 0;                  ///< and after
    };

    /// Rows through the steps [from, to), none of which looks at the whole set.
    [[nodiscard]] std::vector<double> through(std::vector<double> rows, std::uint64_t first,
                                              std::size_t from, std::size_t to) const;

    /// The steps that take all rows of a set together, in order, and the number of steps.
    [[nodiscard]] std::vector<std::size_t> stops() const;

    /// Applies a step's set_step to the coordinates that it takes, in all rows of a set.
    static void apply_set_step(const Step& step, std::span<double> rows, const RunContext& run);

    /// Remembers the first of some rows of a step's cube whose image is infinitely far.
    void note_infinite(const Step& step, std::span<const double> cube, std::uint64_t first) const;

    [[nodiscard]] DomainPtr domain_of_steps() const;
    void set_bases(Values& values, const Scramble& scramble,
                   std::span<const std::size_t> coordinates,
                   const std::vector<std::uint32_t>& bases) const;
    void add_scramble(const Scramble& scramble, const Spec& spec, const ChainSet& set);
    void add_warp(const Warp& warp, const Spec& spec, const RunContext& run);
    template <class Unit>
    void remember(const Unit& unit, const Spec& spec, const Values& values);
    [[nodiscard]] std::vector<std::size_t> coordinates_of(const Spec& spec) const;

    std::vector<Step> steps_;
    std::vector<std::string> specs_;
    std::vector<std::string> files_;
    std::vector<std::pair<std::string, std::uint64_t>> stream_versions_;
    bool seeded_ = false;
    std::size_t dimension_in_;
    std::size_t dimension_out_;
    DomainPtr domain_;
    mutable std::atomic<std::uint64_t> infinite_ = none;  ///< row
    static constexpr std::uint64_t none = ~std::uint64_t{0};
    static constexpr std::uint64_t told = none - 1;
};

/// Columns of rows as rows of their own.
std::vector<double> gather(std::span<const double> rows, std::size_t width,
                           std::span<const std::size_t> columns);

/// Files that options name, for reading; in order.
std::vector<std::string> files_of(const Schema& schema, const Values& values,
                                  std::span<const std::string> written = {});

/// In place of a fingerprint, for a pipe.
inline constexpr std::string_view not_kept = "not kept";

/// Files with the fingerprints of their bytes. @throws Error(io)
std::vector<std::pair<std::string, std::string>> fingerprints(std::span<const std::string> files,
                                                              const RunContext& run);

}  // namespace stipple
