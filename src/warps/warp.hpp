// SPDX-License-Identifier: MIT
//
// What a warp is: its record, and the map it makes for given options.
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
#include "stipple/run.hpp"

namespace stipple {

/// A map from the unit cube [0, 1)^cube_dimension() to a domain; safe to use from several threads.
class Mapping {
  public:
    Mapping(const Mapping&) = delete;
    Mapping& operator=(const Mapping&) = delete;
    virtual ~Mapping() = default;

    /// What the image lives on. The image's numbers a point are domain()->dimension(). Its density
    /// is the one that the warp is for; a biased method makes another.
    [[nodiscard]] const DomainPtr& domain() const { return domain_; }

    /// Unit coordinates that make one point.
    [[nodiscard]] virtual std::size_t cube_dimension() const { return domain_->cube_dimension(); }

    /// Maps point after point: `cube` holds count x cube_dimension() numbers, `image` takes
    /// count x domain()->dimension(). Where drops(), keep[i] = 0 marks a point that has no image;
    /// else `keep` is not touched.
    virtual void forward(std::span<const double> cube, std::span<double> image,
                         std::span<std::uint8_t> keep) const = 0;

    /// Whether some points may have no image.
    [[nodiscard]] virtual bool drops() const { return false; }

    /// Whether a set shall have as many points as are asked for, in spite of those that have none.
    [[nodiscard]] virtual bool refills() const { return false; }

    /// Of each unit coordinate what it becomes by itself; empty: all are continuous, or the outcomes
    /// depend on others.
    [[nodiscard]] virtual std::vector<OutcomeAxis> outcome_axes() const { return {}; }

    /// Whether the numbers of each coordinate are first given out anew among the points of a set, so
    /// that forward() takes what reorder() has made of the whole set.
    [[nodiscard]] virtual bool reorders() const { return false; }

    /// Does so in place, for all points of a set: count x cube_dimension() numbers.
    /// @throws Error(input) for points that cannot be reordered; Error(limit), Error(cancelled)
    virtual void reorder(std::span<double> /*cube*/, const RunContext& /*run*/) const {}

    /// Whether the image of a row of the cube is infinitely far, and a finite one stands for it:
    /// asked where the domain's measure is infinite.
    [[nodiscard]] virtual bool infinite(std::span<const double> /*row*/) const { return false; }

    /// The way back, into the closed unit cube: the domain's own to_cube(), unless a method has
    /// another. @throws Error(usage) where there is none; Error(input) naming a point outside
    virtual void inverse(std::span<const double> image, std::span<double> cube) const;

    /// Whether the density is not the domain's, on purpose or by the tolerance of a table.
    [[nodiscard]] virtual bool biased() const { return false; }

    /// Density of the image of a uniform point with respect to the domain's measure: the domain's,
    /// unless biased().
    [[nodiscard]] virtual double density(std::span<const double> point) const {
        return domain_->density(point);
    }

  protected:
    /// @param no_way_back why there is no inverse; empty where there is one
    explicit Mapping(DomainPtr domain, std::string no_way_back = {})
        : domain_(std::move(domain)), no_way_back_(std::move(no_way_back)) {}

    /// @throws Error(usage) where there is no way back.
    void check_way_back() const;
    /// The same, and holds that the domain contains all points.
    void expect_inside(std::span<const double> image) const;
    [[noreturn]] void refuse_outside(std::span<const double> point) const;

  private:
    DomainPtr domain_;
    std::string no_way_back_;
};

struct Warp;

/// What a mapping is made from.
struct WarpRequest {
    const Warp& warp;
    const Values& options;
    std::size_t given;  ///< coordinates at hand
    const RunContext& run;

    /// The spec of a domain that the options decide on.
    [[nodiscard]] std::string spec() const;
    /// The same for those of them that do; all others are how points are made.
    [[nodiscard]] std::string spec(std::initializer_list<std::string_view> which) const;
};

struct WarpTraits {
    bool invertible = true;
    bool drops = false;   ///< with some options, some points have no image
    bool biased = false;  ///< with some options, deliberately wrong; the option's help says which
    bool tabulated = false;  ///< points follow a table, near the domain's density
    bool reorders = false;   ///< with some options, a set is reordered before it is mapped
    bool discrete = false;   ///< points are outcomes, each with a probability, and have no density
};

struct Warp {
    std::string name;
    std::string summary;
    std::string source;
    std::string family = {};  ///< "blue noise"; the registry gives it, by the folder
    /// Words that lead to it and are no names of it: what it is a kind, a part or a use of.
    std::vector<std::string> related = {};
    std::string strata;  ///< what becomes of each unit coordinate, and whether it is xi or 1 - xi
    WarpTraits traits = {};
    Schema options;
    std::vector<std::string> aliases = {};  ///< other names that users of the field would type

    /// Raised with every change of the images that the same options and seed give (see
    /// tests/contract/golden.txt).
    std::uint64_t stream_version = 1;

    std::function<std::unique_ptr<Mapping>(const WarpRequest&)> mapping;

    /// The map for these options. `given` is the number of coordinates at hand: a warp of fixed
    /// dimension ignores it. @throws Error(usage); of warps that read a file, also what reading
    /// throws, and Error(limit)
    std::unique_ptr<Mapping> make(const Values& values, std::size_t given,
                                  const RunContext& run) const;
};

namespace warps {

/// For warps of which other programs have the same map with the angle first, or from another corner.
inline constexpr Param<Numbers> orientation{
    {.name = "orientation",
     .help = "Unit coordinates in the order in which they are taken, with a minus sign where "
             "1 - xi is: 2,1 takes the angle first where it is last; default: 1,2"}};

/// All warps, in alphabetical order.
const std::vector<Warp>& all();
}  // namespace warps

}  // namespace stipple
