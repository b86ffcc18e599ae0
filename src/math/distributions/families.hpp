// SPDX-License-Identifier: MIT
//
// Distributions on the line by name, with their parameters:
//
//     MarginalPtr law = make_marginal("gamma", {{"shape", 2}, {"scale", 0.5}});
//
// and those of numbers that were measured.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "math/distributions/marginal.hpp"
#include "stipple/error.hpp"

namespace stipple {

struct MarginalParameter {
    std::string_view name;
    std::string_view help;
    std::optional<double> fallback;  ///< none: it may be left out
    double low = -1e150;
    double high = 1e150;
    bool whole = false;  ///< a whole number
};

/// Parameters with their values.
using NamedNumbers = std::vector<std::pair<std::string, double>>;

/// What a family is made from: all parameters that were given or have defaults, in their ranges.
struct ParameterValues {
    std::string_view where;
    NamedNumbers numbers;

    [[nodiscard]] std::optional<double> find(std::string_view name) const;
    /// Of a parameter that has a value.
    [[nodiscard]] double operator[](std::string_view name) const { return find(name).value(); }
};

struct MarginalFamily {
    std::string_view name;
    std::vector<MarginalParameter> parameters;
    std::function<MarginalPtr(const ParameterValues&)> make;

    [[nodiscard]] const MarginalParameter& parameter(std::string_view wanted) const;
};

/// In alphabetical order.
const std::vector<MarginalFamily>& marginal_families();

/// @throws Error(usage) for a name that none has
const MarginalFamily& marginal_family(std::string_view name);

/// @param where what stands before a parameter's name in messages: "--", "x3: "
/// @throws Error(usage): unknown names, numbers out of range or that do not go together
MarginalPtr make_marginal(std::string_view family, const NamedNumbers& given,
                          std::string_view where = {});

/// Each of these numbers as often as it stands there or, with `linear`, straight between them.
/// @param where what messages call the numbers
/// @throws Error(kind) "WHERE: 3 stands twice; ..."
MarginalPtr measured_law(std::vector<double> numbers, bool linear, ErrorKind kind,
                         const std::string& where);

}  // namespace stipple
