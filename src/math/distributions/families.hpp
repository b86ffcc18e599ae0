// SPDX-License-Identifier: MIT
//
// Distributions on the line by name, with their parameters:
//
//     MarginalPtr law = make_marginal("gamma", {{"shape", 2}, {"scale", 0.5}});
//
// and distributions of measured numbers.
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
    std::optional<double> fallback;  ///< nullopt: the parameter is optional
    double low = -1e150;
    double high = 1e150;
    bool whole = false;  ///< true if only integers are allowed
};

/// True if 64 or more doubles near `place` are within one `scale`: points of a narrower distribution
/// would be rounded to few numbers.
bool is_resolved(double scale, double place);

/// @throws Error(usage) that begins with `where` and `name`, unless is_resolved()
void require_resolved(std::string_view where, std::string_view name, double place,
                      std::string_view what, double scale);

/// The same for a range of points, which must also have a width of 1e-300 or more.
void require_wide(std::string_view where, std::string_view name, double low, double high);

using NamedNumbers = std::vector<std::pair<std::string, double>>;

/// Input of a family: all parameters that were given or have defaults, checked for their ranges.
struct ParameterValues {
    std::string_view where;
    NamedNumbers numbers;

    [[nodiscard]] std::optional<double> find(std::string_view name) const;
    /// Value of a parameter that was given or has a default.
    [[nodiscard]] double operator[](std::string_view name) const { return find(name).value(); }
};

struct MarginalFamily {
    std::string_view name;
    std::vector<MarginalParameter> parameters;
    std::function<MarginalPtr(const ParameterValues&)> make;

    [[nodiscard]] const MarginalParameter& parameter(std::string_view wanted) const;
};

/// All families, in alphabetical order.
const std::vector<MarginalFamily>& marginal_families();

/// Returns the family with this name. @throws Error(usage) if there is none
const MarginalFamily& marginal_family(std::string_view name);

/// @param where prefix of parameter names in messages: "--", "x3: "
/// @throws Error(usage) for unknown names, numbers out of range or inconsistent parameters
MarginalPtr make_marginal(std::string_view family, const NamedNumbers& given,
                          std::string_view where = {});

/// Distribution of measured numbers by their frequencies, or interpolated if `linear`.
/// @param where name of the numbers in messages
/// @throws Error(kind) for numbers outside [-1e150, 1e150], or unsuitable for interpolation
MarginalPtr measured_law(std::vector<double> numbers, bool linear, ErrorKind kind,
                         const std::string& where);

}  // namespace stipple
