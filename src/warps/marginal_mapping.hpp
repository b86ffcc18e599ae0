// SPDX-License-Identifier: MIT
//
// Mappings onto independent coordinates with distributions from math/distributions; and options for
// the parameters of families of distributions:
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

/// A family's parameter as an option: one number for all coordinates, or one for each.
struct ParameterOption {
    const MarginalParameter& of;
};
Option describe(const ParameterOption& parameter);
ParameterOption parameter(std::string_view family, std::string_view name);

/// Parameters of a family by name; each is one number for all coordinates, or one for each.
using ParameterLists = std::vector<std::pair<std::string, std::vector<double>>>;

/// Members of the family: one for all coordinates, or one for each. @throws Error(usage)
std::vector<MarginalPtr> family_members(std::string_view family, const ParameterLists& lists);

/// Mapping of d coordinates, with one distribution for all or one for each.
std::unique_ptr<Mapping> marginal_mapping(const std::vector<MarginalPtr>& marginals, std::size_t d,
                                          std::string spec);

/// Mapping of a warp whose name is a family and whose options are its parameters.
std::unique_ptr<Mapping> family_mapping(const WarpRequest& want);

}  // namespace stipple::warps
