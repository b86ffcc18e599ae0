// SPDX-License-Identifier: MIT
//
// Interface of a warp: its record, and the mapping that it makes for given options.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/domain.hpp"
#include "core/options.hpp"
#include "core/outcome_axis.hpp"
#include "stipple/run.hpp"

namespace stipple {

/// A map from the unit cube [0, 1)^cube_dimension() to a domain; safe to use from several threads.
class Mapping {
  public:
    Mapping(const Mapping&) = delete;
    Mapping& operator=(const Mapping&) = delete;
    virtual ~Mapping() = default;

    /// The space of the images, which have domain()->dimension() numbers per point. Its density is
    /// the intended one; images of biased methods follow another density.
    [[nodiscard]] const DomainPtr& domain() const { return domain_; }

    /// Unit coordinates per point.
    [[nodiscard]] virtual std::size_t cube_dimension() const { return domain_->cube_dimension(); }

    /// Maps rows: `cube` holds count x cube_dimension() numbers, `image` receives count x
    /// domain()->dimension(). If drops(), sets keep[i] = 0 for points without an image; otherwise
    /// `keep` is not accessed.
    virtual void forward(std::span<const double> cube, std::span<double> image,
                         std::span<std::uint8_t> keep) const = 0;

    /// Whether some points may have no image.
    [[nodiscard]] virtual bool drops() const { return false; }

    /// For each unit coordinate, its discrete outcomes. Empty if all coordinates are continuous, or
    /// if outcomes depend on several of them.
    [[nodiscard]] virtual std::vector<OutcomeAxis> outcome_axes() const { return {}; }

    /// Changes all points of a set in place: count x cube_dimension() numbers. @throws Error(input)
    /// for unsuitable points; Error(limit), Error(cancelled)
    using SetStep = std::function<void(std::span<double> cube, const RunContext& run)>;

    /// Step that needs the whole set and precedes forward(); empty if points are mapped one by one.
    [[nodiscard]] virtual SetStep set_step() const { return {}; }

    /// Whether the image of a row of the cube is infinite and replaced by a finite one. Called only
    /// if the domain's measure is infinite.
    [[nodiscard]] virtual bool infinite(std::span<const double> /*row*/) const { return false; }

    /// Inverse, into the closed unit cube: the domain's to_cube(), unless a method has its own.
    /// @throws Error(usage) if there is none; Error(input) naming a point outside the domain
    virtual void inverse(std::span<const double> image, std::span<double> cube) const;

    /// Whether density() differs from the domain's, deliberately or by the error of a table.
    [[nodiscard]] virtual bool biased() const { return false; }

    /// Density of the image of a uniform point with respect to the domain's measure: the domain's
    /// own density, unless biased().
    [[nodiscard]] virtual double density(std::span<const double> point) const {
        return domain_->density(point);
    }

  protected:
    /// @param no_way_back why there is no inverse; empty if there is one
    explicit Mapping(DomainPtr domain, std::string no_way_back = {})
        : domain_(std::move(domain)), no_way_back_(std::move(no_way_back)) {}

    /// @throws Error(usage) if there is no inverse
    void check_way_back() const;
    /// Like check_way_back(), and checks that the domain contains all points.
    void expect_inside(std::span<const double> image) const;
    [[noreturn]] void refuse_outside(std::span<const double> point) const;

  private:
    DomainPtr domain_;
    std::string no_way_back_;
};

struct Warp;

/// Arguments for making a mapping.
struct WarpRequest {
    const Warp& warp;
    const Values& options;
    std::size_t given;  ///< number of available coordinates
    const RunContext& run;

    /// Spec of the domain, with all options.
    [[nodiscard]] std::string spec() const;
    /// Spec of the domain, with only these options; others affect only how points are made.
    [[nodiscard]] std::string spec(std::initializer_list<std::string_view> which) const;
};

struct WarpTraits {
    bool invertible = true;
    bool drops = false;      ///< some options drop points
    bool refills = false;    ///< replaces dropped points, so that sets are as large as requested
    bool biased = false;     ///< some options are deliberately wrong; their help says so
    bool tabulated = false;  ///< points follow a table that approximates the domain's density
    bool needs_whole_set = false;  ///< mappings have a set_step() for some options
    bool discrete = false;         ///< points are outcomes, with probabilities instead of a density
};

struct Warp {
    std::string name;
    std::string summary;
    std::string source;
    std::string family = {};  ///< family name, set by the registry from the folder
    /// Search words: kind, uses; no names of other analyzers, warps or generators.
    std::vector<std::string> related = {};
    std::string strata;  ///< images of the strata, and whether xi or 1 - xi is used
    WarpTraits traits = {};
    Schema options;
    std::vector<std::string> aliases = {};  ///< other names that users may type

    /// Incremented when the images for equal options and seed change (tests/contract/golden.txt).
    std::uint64_t stream_version = 1;

    std::function<std::unique_ptr<Mapping>(const WarpRequest&)> mapping;

    /// For warps described by a file: reads their domain from it. The domain's spec is the warp's,
    /// with the contents of the file. Empty for other warps. @throws Error(input) naming the
    /// position in the file; Error(io)
    std::function<DomainPtr(const std::string& path, const RunContext& run)> read = {};

    /// Makes the mapping for these options. `given` is the number of available coordinates; warps
    /// of fixed dimension ignore it. @throws Error(usage); for warps that read a file, also errors
    /// of reading, and Error(limit)
    std::unique_ptr<Mapping> make(const Values& values, std::size_t given,
                                  const RunContext& run) const;
};

namespace warps {

/// Option of warps that other programs define with other orders or directions of xi.
inline constexpr Param<Numbers> orientation{
    {.name = "orientation",
     .help = "Order in which the unit coordinates are used, with a minus sign for 1 - xi: 2,1 "
             "swaps the two; default: 1,2"}};

/// All warps, in alphabetical order.
const std::vector<Warp>& all();
}  // namespace warps

}  // namespace stipple
