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

Parameter number(std::string_view name, double fallback, std::string_view help) {
    return {.name = name, .help = help, .fallback = fallback};
}
Parameter within(double low, double high, Parameter parameter) {
    parameter.low = low;
    parameter.high = high;
    return parameter;
}
Parameter whole(double low, double high, Parameter parameter) {
    parameter.whole = true;
    return within(low, high, parameter);
}
Parameter scale(std::string_view name, double fallback, std::string_view help) {
    return within(1e-100, 1e100, number(name, fallback, help));
}
Parameter location(std::string_view help) {
    return within(-1e100, 1e100, number("location", 0, help));
}

void require_below(const ParameterValues& p, std::string_view low, std::string_view high) {
    if (!(p[low] < p[high]))
        fail(ErrorKind::usage, "{}{}: {} is not below {}{}, {}", p.where, low, p[low], p.where,
             high, p[high]);
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

/// Takes mean and standard deviation of either the logarithm or the number itself.
MarginalPtr lognormal_of(const ParameterValues& p) {
    const auto mean = p.find("mean");
    const auto deviation = p.find("deviation");
    double mu = p.find("mu").value_or(0);
    double sigma = p.find("sigma").value_or(1);
    if (mean || deviation) {
        if (p.find("mu") || p.find("sigma"))
            fail(ErrorKind::usage,
                 "{}mean: {}mu or {}sigma is also given; give mu and sigma, or mean and deviation",
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
    const auto ends = [](double low, double high) {
        return std::pair{number("low", low, "Lower end"), number("high", high, "Upper end")};
    };
    const auto [low, high] = ends(0, 1);
    return {
        {"beta",
         {within(0.05, 1e6, number("a", 2, "First shape parameter, alpha, in [0.05, 1e6]")),
          within(0.05, 1e6, number("b", 2, "Second shape parameter, beta, in [0.05, 1e6]")), low,
          high},
         beta_of},
        {"binomial",
         {whole(1, 1e8, number("trials", 10, "Number of trials, up to 1e8")),
          within(1e-12, 1 - 1e-12,
                 number("probability", 0.5, "Success probability of each trial, between 0 and 1"))},
         [](const auto& p) { return binomial_law(p["trials"], p["probability"]); }},
        {"exponential",
         {within(1e-150, 1e150, number("rate", 1, "Rate lambda, 1 / mean, above 0"))},
         [](const auto& p) { return exponential_law(p["rate"]); }},
        {"gamma",
         {within(0.05, 1e6, number("shape", 2, "Shape k, in [0.05, 1e6]")),
          scale("scale", 1, "Scale theta, above 0: the mean is k theta")},
         [](const auto& p) { return gamma_law(p["shape"], p["scale"]); }},
        {"gumbel",
         {location("Position of the highest density"), scale("scale", 1, "Scale, above 0")},
         [](const auto& p) { return gumbel_law(p["location"], p["scale"]); }},
        {"integers",
         {whole(-most_whole, most_whole, number("low", 1, "The smallest number")),
          whole(-most_whole, most_whole, number("high", 6, "The largest number"))},
         integers_of},
        {"log-uniform",
         {within(1e-150, 1e150, number("low", 1, "Lower end, above 0")),
          within(1e-150, 1e150, number("high", 10, "Upper end"))},
         log_uniform_of},
        {"lognormal",
         {{.name = "mu", .help = "Mean of the logarithm; default: 0", .fallback = {}},
          {.name = "sigma",
           .help = "Standard deviation of the logarithm, above 0; default: 1",
           .fallback = {},
           .low = 0},
          {.name = "mean",
           .help = "Instead of mu and sigma: mean of the number itself, above 0",
           .fallback = {},
           .low = 1e-150},
          {.name = "deviation",
           .help = "With mean: standard deviation of the number itself, above 0",
           .fallback = {},
           .low = 1e-150}},
         lognormal_of},
        {"normal",
         {number("mean", 0, "Mean"),
          within(1e-150, 1e150, number("deviation", 1, "Standard deviation, above 0"))},
         [](const auto& p) { return normal_law(p["mean"], p["deviation"]); }},
        {"poisson",
         {within(1e-12, 1e8, number("mean", 4, "Mean, above 0, up to 1e8"))},
         [](const auto& p) { return poisson_law(p["mean"]); }},
        {"student-t",
         {within(0.5, 1e6, number("degrees", 5, "Degrees of freedom, in [0.5, 1e6]")),
          location("Middle"), scale("scale", 1, "Scale, above 0")},
         [](const auto& p) { return student_t_law(p["degrees"], p["location"], p["scale"]); }},
        {"triangular",
         {low, number("mode", 0.5, "Position of the highest density, from low to high"), high},
         triangular_of},
        {"uniform", {low, high}, uniform_of},
        {"weibull",
         {within(0.05, 1e3, number("shape", 2, "Shape k, in [0.05, 1000]")),
          scale("scale", 1, "Scale, above 0: the quantile at 1 - 1/e")},
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
    fail_with_hint(ErrorKind::usage, suggest(name, known), "there is no distribution '{}'", name);
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
        fail_with_hint(kind, "steps accept repeated numbers",
                       "{}: {} occurs twice; linear needs different numbers", where, *twice);
    if (numbers.size() < 2) fail(kind, "{}: 1 number; linear needs 2 or more", where);
    return interpolated_law(std::move(numbers));
}

}  // namespace stipple
