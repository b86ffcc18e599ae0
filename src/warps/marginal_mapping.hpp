// SPDX-License-Identifier: MIT
//
// Mappings onto coordinates that are independent of each other, each by a distribution of
// math/distributions; and options for the parameters of its families:
//
//     .options = Schema(parameter("gamma", "shape"), parameter("gamma", "scale")),
//     .mapping = family_mapping
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "math/distributions/families.hpp"
#include "warps/warp.hpp"

namespace stipple::warps {

/// A parameter of a family as an option: one number for all coordinates, or one for each.
struct ParameterOption {
    const MarginalParameter& of;
};
Option describe(const ParameterOption& parameter);
ParameterOption parameter(std::string_view family, std::string_view name);

/// Of a family, by name: one number for all coordinates, or one for each.
using ParameterLists = std::vector<std::pair<std::string, std::vector<double>>>;

/// One distribution for all coordinates, or one for each. @throws Error(usage)
std::vector<MarginalPtr> family_members(std::string_view family, const ParameterLists& lists);

/// The mapping of d coordinates by one distribution for all, or by one for each.
std::unique_ptr<Mapping> marginal_mapping(const std::vector<MarginalPtr>& marginals, std::size_t d,
                                          std::string spec);

/// Of a warp that is named like a family, and whose options are its parameters.
std::unique_ptr<Mapping> family_mapping(const WarpRequest& want);

}  // namespace stipple::warps
