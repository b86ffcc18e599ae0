// SPDX-License-Identifier: MIT
#include "pipeline/domains.hpp"

#include <algorithm>
#include <memory>
#include <numeric>

#include "core/error.hpp"
#include "core/product_domain.hpp"
#include "core/text.hpp"
#include "pipeline/units.hpp"

namespace stipple {

std::vector<std::size_t> all_coordinates(std::size_t dimension) {
    std::vector<std::size_t> all(dimension);
    std::iota(all.begin(), all.end(), std::size_t{0});
    return all;
}

std::vector<std::size_t> other_coordinates(std::size_t width, std::span<const std::size_t> taken) {
    std::vector<std::size_t> rest;
    for (std::size_t k = 0; k < width; ++k)
        if (std::ranges::find(taken, k) == taken.end()) rest.push_back(k);
    return rest;
}

std::vector<std::size_t> named_or_all(const Spec& spec, std::size_t dimension) {
    return spec.coordinates.empty() ? all_coordinates(dimension) : spec.coordinates;
}

DomainPtr filled_up(std::vector<Factor> factors, std::size_t dimension) {
    std::vector<std::size_t> taken;
    for (const Factor& factor : factors)
        taken.insert(taken.end(), factor.coordinates.begin(), factor.coordinates.end());
    const auto rest = other_coordinates(dimension, taken);
    if (!rest.empty()) factors.push_back({unit_cube(rest.size()), rest});
    const bool whole = factors.size() == 1 && factors[0].coordinates == all_coordinates(dimension);
    return whole ? factors[0].domain : product_domain(std::move(factors));
}

void multiply_densities(std::span<double> densities, std::span<const double> rows,
                        std::span<const std::size_t> coordinates, const Domain& domain,
                        const Mapping* mapping) {
    const std::size_t width = densities.empty() ? 0 : rows.size() / densities.size();
    std::vector<double> point;
    for (std::size_t i = 0; i < densities.size(); ++i) {
        point.clear();
        for (const std::size_t k : coordinates) point.push_back(rows[i * width + k]);
        densities[i] *= mapping != nullptr ? mapping->density(point) : domain.density(point);
    }
}

std::vector<Factor> warped_factors(const DomainPtr& domain, std::span<const std::size_t> boxless) {
    std::vector<Factor> warped;
    for (Factor& factor : factors_of(domain)) {
        const std::string name = parse_spec(factor.domain->spec()).name;
        if (name == "unit-cube") continue;
        if (name != "box") {
            warped.push_back(std::move(factor));
            continue;
        }
        const Box box = factor.domain->bounding_box();
        for (std::size_t k = 0; k < box.dimension(); ++k)
            if (std::ranges::find(boxless, factor.coordinates[k]) == boxless.end())
                warped.push_back(
                    {box_domain({{box.low[k]}, {box.high[k]}}), {factor.coordinates[k]}});
    }
    return warped;
}

namespace {

/// Returns the warp whose domain has this name. @throws Error(usage)
const Warp& warp_of_domain(const std::string& name) {
    std::vector<std::string> names = {"unit-cube", "box"};
    for (const Warp& warp : warps::all()) {
        if (warp.name == name || std::ranges::count(warp.aliases, name) > 0) return warp;
        names.push_back(warp.name);
    }
    const bool range = name.find("..") != std::string::npos;
    fail_with_hint(
        ErrorKind::usage,
        range ? fmt::format("a box is written box:bounds=[{}]", name) : suggest(name, names),
        "unknown domain '{}'", name);
}

}  // namespace

std::vector<Factor> parse_factors(std::string_view text, std::size_t dimension,
                                  const RunContext& run) {
    std::vector<Factor> factors;
    for (const auto part : split_outside("[]", text, " x ")) {
        Spec spec = parse_spec(part);
        const std::size_t given = spec.coordinates.empty() ? dimension : spec.coordinates.size();
        DomainPtr domain;
        if (spec.name == "unit-cube") {
            domain = unit_cube(given);
        } else if (spec.name == "box") {
            if (spec.settings.size() != 1 || spec.settings[0].first != "bounds")
                fail(ErrorKind::usage, "domain box: write box:bounds=[lo..hi,lo..hi]");
            domain = box_domain(parse_box(spec.settings[0].second, given));
        } else {
            const Warp& warp = warp_of_domain(spec.name);
            domain = warp.make(spec.values(warp.options), given, run)->domain();
        }
        factors.push_back({std::move(domain), named_or_all(spec, dimension)});
    }
    return factors;
}

DomainPtr parse_domain(std::string_view text, std::size_t dimension, const RunContext& run) {
    auto factors = parse_factors(text, dimension, run);
    std::vector<std::size_t> covered;
    for (const auto& [domain, coordinates] : factors) {
        if (domain->dimension() != coordinates.size())
            fail(ErrorKind::input, "the domain {} has dimension {}; the points have {}",
                 domain->title(), domain->dimension(), coordinates.size());
        covered.insert(covered.end(), coordinates.begin(), coordinates.end());
    }
    std::ranges::sort(covered);
    if (covered != all_coordinates(dimension))
        fail(ErrorKind::input, "the domain does not cover each of the {} coordinates once",
             dimension);
    return filled_up(std::move(factors), dimension);
}

namespace {

/// A factor of a domain, with the mapping that determines the density of points on it.
struct FactorLaw {
    Factor factor;
    std::unique_ptr<Mapping> mapping = {};  ///< null: the density is that of the factor
};

bool may_be_biased(const std::string& step) {
    return std::ranges::any_of(warps::all(), [&](const Warp& warp) {
        return (warp.traits.biased || warp.traits.tabulated) &&
               step.find(warp.name) != std::string::npos;
    });
}

/// Gives each factor of the domain the mapping of the step that made it, if that may be biased.
/// Warns of a biased step without a factor: later steps changed its points, or it was an inverse.
std::vector<FactorLaw> factor_laws(std::span<const std::string> steps, const DomainPtr& domain,
                                   const RunContext& run) {
    std::vector<FactorLaw> laws;
    for (Factor& factor : warped_factors(domain)) laws.push_back({std::move(factor)});
    for (const std::string& step : steps) {
        if (!may_be_biased(step)) continue;
        const bool back = step.starts_with(inverse_of);
        const Spec spec = parse_spec(std::string_view(step).substr(back ? inverse_of.size() : 0));
        const Warp& warp = find_warp(spec.name);
        auto mapping = warp.make(spec.values(warp.options), domain->dimension(), run);
        const auto made = std::ranges::find_if(laws, [&](const FactorLaw& law) {
            return !law.mapping && law.factor.domain->spec() == mapping->domain()->spec();
        });
        if (!back && made != laws.end())
            made->mapping = std::move(mapping);
        else if (mapping->biased())
            run.notify(
                fmt::format("the points come from {}, which is biased; their density on the domain "
                            "{} is not known, and the domain's is used instead",
                            short_specs({&step, 1}), domain->title()));
    }
    return laws;
}

}  // namespace

std::vector<double> biased_densities(const PointSet& points, const RunContext& run) {
    const auto& steps = points.provenance.warps;
    if (std::ranges::none_of(steps, may_be_biased)) return {};
    std::vector<FactorLaw> laws;
    try {
        laws = factor_laws(steps, points.domain, run);
    } catch (const Error& e) {  // the error is in the file, not in the call
        if (e.kind() != ErrorKind::usage) throw;
        throw Error(ErrorKind::input, fmt::format("its warps: {}", e.what()), e.hint());
    }
    const auto biased = [](const FactorLaw& law) { return law.mapping && law.mapping->biased(); };
    if (std::ranges::none_of(laws, biased)) return {};
    std::vector<double> densities(points.count(), 1);
    for (const auto& [factor, mapping] : laws)
        multiply_densities(densities, points.flat(), factor.coordinates, *factor.domain,
                           mapping.get());
    return densities;
}

}  // namespace stipple
