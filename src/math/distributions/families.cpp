// SPDX-License-Identifier: MIT
#include "math/distributions/families.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/text.hpp"
#include "math/distributions/laws.hpp"
#include "math/functions/logarithm.hpp"

namespace stipple {
namespace {

using Parameter = MarginalParameter;

void require_below(const ParameterValues& p, std::string_view low, std::string_view high) {
    if (!(p[low] < p[high]))
        fail(ErrorKind::usage, "{}{}: {} is not below {}{}, {}", p.where, low, p[low], p.where,
             high, p[high]);
    require_wide(p.where, low, p[low], p[high]);
}

/// Scale of a distribution, checked against its location.
double resolved(const ParameterValues& p, std::string_view scale, std::string_view location) {
    require_resolved(p.where, location, p[location], scale, p[scale]);
    return p[scale];
}

MarginalPtr uniform_of(const ParameterValues& p) {
    require_below(p, "low", "high");
    return uniform_law(p["low"], p["high"]);
}

MarginalPtr log_uniform_of(const ParameterValues& p) {
    require_below(p, "low", "high");
    return log_uniform_law(p["low"], p["high"]);
}

MarginalPtr triangular_of(const ParameterValues& p) {
    require_below(p, "low", "high");
    if (!(p["mode"] >= p["low"] && p["mode"] <= p["high"]))
        fail(ErrorKind::usage, "{}mode: {} is outside [{}, {}]", p.where, p["mode"], p["low"],
             p["high"]);
    return triangular_law(p["low"], p["mode"], p["high"]);
}

/// Accepts the mean and standard deviation of either the logarithm or the variable itself.
MarginalPtr lognormal_of(const ParameterValues& p) {
    const auto mean = p.find("mean");
    const auto deviation = p.find("deviation");
    double mu = p.find("mu").value_or(0);
    double sigma = p.find("sigma").value_or(1);
    if (mean || deviation) {
        if (p.find("mu") || p.find("sigma"))
            fail(ErrorKind::usage,
                 "{}mean: cannot be combined with {}mu or {}sigma; give mu and sigma, or mean and "
                 "deviation",
                 p.where, p.where, p.where);
        if (!mean || !deviation)
            fail(ErrorKind::usage, "{}{}: {}{} is needed as well", p.where,
                 mean ? "mean" : "deviation", p.where, mean ? "deviation" : "mean");
        const double square = log_1p((*deviation / *mean) * (*deviation / *mean));
        sigma = std::sqrt(square);
        mu = logarithm(*mean) - 0.5 * square;
    }
    if (!(std::abs(mu) + 38 * sigma <= 650 && sigma >= 1e-9))
        fail(ErrorKind::usage,
             "{}sigma: mu = {:.6g} and sigma = {:.6g} give numbers that are too small or too "
             "large; expected sigma of at least 1e-9 and |mu| + 38 sigma of at most 650",
             p.where, mu, sigma);
    return lognormal_law(mu, sigma);
}

MarginalPtr beta_of(const ParameterValues& p) {
    require_below(p, "low", "high");
    return beta_law(p["a"], p["b"], p["low"], p["high"]);
}

MarginalPtr integers_of(const ParameterValues& p) {
    if (!(p["low"] <= p["high"]))
        fail(ErrorKind::usage, "{}low: {} is above {}high, {}", p.where, p["low"], p.where,
             p["high"]);
    return integers_law(p["low"], p["high"]);
}

std::vector<MarginalFamily> all_families() {
    constexpr double most_whole = 1e15;
    const Parameter low{"low", "Lower end", 0};
    const Parameter high{"high", "Upper end", 1};
    const auto scale = [](std::string_view help) {
        return Parameter{"scale", help, 1, 1e-100, 1e100};
    };
    const auto location = [](std::string_view help) {
        return Parameter{"location", help, 0, -1e100, 1e100};
    };
    return {
        {"beta",
         {{"a", "First shape parameter, alpha, in [0.05, 1e6]", 2, 0.05, 1e6},
          {"b", "Second shape parameter, beta, in [0.05, 1e6]", 2, 0.05, 1e6},
          low,
          high},
         beta_of},
        {"binomial",
         {{"trials", "Number of trials, up to 1e8", 10, 1, 1e8, true},
          {"probability", "Success probability of each trial, between 0 and 1", 0.5, 1e-12,
           1 - 1e-12}},
         [](const auto& p) { return binomial_law(p["trials"], p["probability"]); }},
        {"exponential",
         {{"rate", "Rate lambda, 1 / mean, above 0", 1, 1e-150, 1e150}},
         [](const auto& p) { return exponential_law(p["rate"]); }},
        {"gamma",
         {{"shape", "Shape k, in [0.05, 1e6]", 2, 0.05, 1e6},
          scale("Scale theta, above 0: the mean is k theta")},
         [](const auto& p) { return gamma_law(p["shape"], p["scale"]); }},
        {"gumbel",
         {location("Position of the highest density"), scale("Scale, above 0")},
         [](const auto& p) { return gumbel_law(p["location"], resolved(p, "scale", "location")); }},
        {"integers",
         {{"low", "The smallest number", 1, -most_whole, most_whole, true},
          {"high", "The largest number", 6, -most_whole, most_whole, true}},
         integers_of},
        {"log-uniform",
         {{"low", "Lower end, above 0", 1, 1e-150, 1e150},
          {"high", "Upper end", 10, 1e-150, 1e150}},
         log_uniform_of},
        {"lognormal",
         {{"mu", "Mean of the logarithm; default: 0", {}},
          {"sigma", "Standard deviation of the logarithm, above 0; default: 1", {}, 0},
          {"mean", "Instead of mu and sigma: mean of the number itself, above 0", {}, 1e-150},
          {"deviation", "With mean: standard deviation of the number itself, above 0", {}, 1e-150}},
         lognormal_of},
        {"normal",
         {{"mean", "Mean", 0}, {"deviation", "Standard deviation, above 0", 1, 1e-150, 1e150}},
         [](const auto& p) { return normal_law(p["mean"], resolved(p, "deviation", "mean")); }},
        {"poisson",
         {{"mean", "Mean, above 0, up to 1e8", 4, 1e-12, 1e8}},
         [](const auto& p) { return poisson_law(p["mean"]); }},
        {"student-t",
         {{"degrees", "Degrees of freedom, in [0.5, 1e6]", 5, 0.5, 1e6},
          location("Middle"),
          scale("Scale, above 0")},
         [](const auto& p) {
             return student_t_law(p["degrees"], p["location"], resolved(p, "scale", "location"));
         }},
        {"triangular",
         {low, {"mode", "Position of the highest density, from low to high", 0.5}, high},
         triangular_of},
        {"uniform", {low, high}, uniform_of},
        {"weibull",
         {{"shape", "Shape k, in [0.05, 1000]", 2, 0.05, 1e3},
          scale("Scale, above 0: the quantile at 1 - 1/e")},
         [](const auto& p) { return weibull_law(p["shape"], p["scale"]); }},
    };
}

/// Checks range and integrality of a parameter. @throws Error(usage)
void check(const Parameter& parameter, double x, std::string_view where) {
    if (!(x >= parameter.low && x <= parameter.high))
        fail(ErrorKind::usage, "{}{}: {} is outside [{}, {}]", where, parameter.name, x,
             parameter.low, parameter.high);
    if (parameter.whole && std::floor(x) != x)
        fail(ErrorKind::usage, "{}{}: {} is not a whole number", where, parameter.name, x);
}

}  // namespace

std::optional<double> ParameterValues::find(std::string_view name) const {
    const auto at = std::ranges::find(numbers, name, &NamedNumbers::value_type::first);
    return at != numbers.end() ? std::optional(at->second) : std::nullopt;
}

const MarginalParameter& MarginalFamily::parameter(std::string_view wanted) const {
    const auto at = std::ranges::find(parameters, wanted, &Parameter::name);
    if (at != parameters.end()) return *at;
    std::vector<std::string> known;
    for (const Parameter& each : parameters) known.emplace_back(each.name);
    fail_with_hint(ErrorKind::usage, suggest(wanted, known), "{} has no parameter '{}'", name,
                   wanted);
}

const std::vector<MarginalFamily>& marginal_families() {
    static const std::vector<MarginalFamily> families = all_families();
    return families;
}

const MarginalFamily& marginal_family(std::string_view name) {
    std::vector<std::string> known;
    for (const MarginalFamily& family : marginal_families()) {
        if (family.name == name) return family;
        known.emplace_back(family.name);
    }
    fail_with_hint(ErrorKind::usage, suggest(name, known), "there is no distribution {}",
                   shown(name));
}

bool is_resolved(double scale, double place) { return scale > 0x1p-46 * std::abs(place); }

void require_resolved(std::string_view where, std::string_view name, double place,
                      std::string_view what, double scale) {
    if (!is_resolved(scale, place))
        fail(ErrorKind::usage, "{}{}: {} is so far from 0 that a {} of {} is lost in rounding",
             where, name, place, what, scale);
}

void require_wide(std::string_view where, std::string_view name, double low, double high) {
    if (!(high - low >= 1e-300 && is_resolved(high - low, std::max(std::abs(low), std::abs(high)))))
        fail(ErrorKind::usage,
             "{}{}: the range from {} to {} is so narrow that it is lost in rounding", where, name,
             low, high);
}

MarginalPtr make_marginal(std::string_view name, const NamedNumbers& given,
                          std::string_view where) {
    const MarginalFamily& family = marginal_family(name);
    ParameterValues values{where, {}};
    for (const auto& [parameter, x] : given) {
        check(family.parameter(parameter), x, where);
        values.numbers.emplace_back(parameter, x + 0.0);  // avoids -0, which would appear in points
    }
    for (const Parameter& parameter : family.parameters)
        if (parameter.fallback && !values.find(parameter.name))
            values.numbers.emplace_back(parameter.name, *parameter.fallback);
    return family.make(values);
}

MarginalPtr measured_law(std::vector<double> numbers, bool linear, ErrorKind kind,
                         const std::string& where) {
    for (double& x : numbers) {
        if (!(std::abs(x) <= 1e150)) fail(kind, "{}: {} is outside [-1e150, 1e150]", where, x);
        x += 0.0;  // avoids -0, which would appear in points
    }
    if (!linear) return empirical_law(std::move(numbers));
    std::ranges::sort(numbers);
    const auto twice = std::ranges::adjacent_find(numbers);
    if (twice != numbers.end())
        fail_with_hint(kind, "step interpolation accepts repeated numbers",
                       "{}: {} occurs twice; linear interpolation needs distinct numbers", where,
                       *twice);
    if (numbers.size() < 2)
        fail(kind, "{}: only 1 number; linear interpolation needs at least 2", where);
    return interpolated_law(std::move(numbers));
}

}  // namespace stipple
