// SPDX-License-Identifier: MIT
#include "experiments/parameters/parameter_space.hpp"

#include <algorithm>
#include <cmath>

namespace stipple::parameters {
namespace {

/// Quantile. Replaces an infinite one by the quantile at the smallest random number.
double place(const Marginal& law, const Share& share) {
    const Tail tail = share.below <= share.above ? Tail::lower : Tail::upper;
    const double x = law.quantile(std::min(share.below, share.above), tail);
    return std::isfinite(x) ? x : law.quantile(0x1p-54, tail);
}

/// Probabilities below and above x; if the distribution is discrete, below and above the middle of
/// x's interval.
Share share_of(const Marginal& law, double x) {
    const Share at{law.probability(x, Tail::lower), law.probability(x, Tail::upper)};
    if (!law.discrete()) return at;
    const double half = law.density(x) / 2;
    return {at.below - half, at.above + half};
}

bool hold(const std::vector<Expression>& constraints, std::span<const double> row) {
    return std::ranges::all_of(constraints, [&](const Expression& constraint) {
        const double holds = constraint.at(row);
        return holds != 0 && holds == holds;
    });
}

UniformRange uniform_range(const Parameter& parameter) {
    if (!parameter.law || !parameter.uniform) return std::nullopt;
    return parameter.law->support();
}

}  // namespace

ParameterSpace::ParameterSpace(std::vector<Parameter> parameters, std::optional<Copula> copula,
                               std::vector<Expression> constraints,
                               std::optional<Reordering> reordering)
    : parameters_(std::move(parameters)),
      copula_(std::move(copula)),
      constraints_(std::move(constraints)),
      reordering_(std::move(reordering)),
      others_(constraints_) {
    std::vector<UniformRange> ranges;
    for (const Parameter& parameter : parameters_) {
        conditional_ |= !parameter.law;
        discrete_ |= parameter.law && parameter.law->discrete();
        const bool alone = !copula_ || !copula_->joins(ranges.size());
        ranges.push_back(alone ? uniform_range(parameter) : std::nullopt);
    }
    if (!reordering_) linear_ = take_linear_part(ranges, others_);
}

std::vector<std::string> ParameterSpace::names() const {
    std::vector<std::string> names;
    for (const Parameter& parameter : parameters_) names.push_back(parameter.name);
    return names;
}

Levels ParameterSpace::levels() const {
    Levels levels;
    for (const Parameter& parameter : parameters_)
        if (!parameter.levels.empty()) levels.emplace_back(parameter.name, parameter.levels);
    return levels;
}

const Marginal& ParameterSpace::law(std::size_t k, std::span<const double> row,
                                    MarginalPtr& held) const {
    const Parameter& parameter = parameters_[k];
    if (parameter.law) return *parameter.law;
    held = parameter.law_given(row.first(k));
    return *held;
}

bool ParameterSpace::from_cube(std::span<const double> cube, std::span<double> row) const {
    std::vector<Share> shares(cube.size());
    for (std::size_t k = 0; k < cube.size(); ++k) shares[k] = {cube[k], 1 - cube[k]};
    if (copula_) copula_->forward(shares);
    const bool maps = maps_linear();
    if (maps) linear_->from_cube(cube, row, row.size());
    MarginalPtr held;
    for (std::size_t k = 0; k < row.size(); ++k)
        if (!maps || !in_linear(k)) row[k] = place(law(k, row, held), shares[k]);
    return hold(maps ? others_ : constraints_, row);
}

std::vector<Share> ParameterSpace::shares(std::span<const double> row) const {
    std::vector<Share> shares(row.size());
    MarginalPtr held;
    for (std::size_t k = 0; k < row.size(); ++k) shares[k] = share_of(law(k, row, held), row[k]);
    return shares;
}

void ParameterSpace::to_cube(std::span<const double> row, std::span<double> cube) const {
    auto at = shares(row);
    if (copula_) copula_->inverse(at);
    for (std::size_t k = 0; k < row.size(); ++k) {
        const auto [below, above] = at[k];
        cube[k] = std::clamp(above < below ? 1 - above : below, 0.0, 1.0);
    }
}

bool ParameterSpace::contains(std::span<const double> row) const {
    MarginalPtr held;
    for (std::size_t k = 0; k < row.size(); ++k) {
        const Marginal& of = law(k, row, held);
        const auto [low, high] = of.support();
        if (!(row[k] >= low && row[k] <= high) || (of.discrete() && !(of.density(row[k]) > 0)))
            return false;
    }
    return hold(constraints_, row);
}

double ParameterSpace::density(std::span<const double> row) const {
    double product = copula_ ? copula_->density(shares(row)) : 1;
    if (linear_) product /= linear_->polytope().volume();
    MarginalPtr held;
    for (std::size_t k = 0; k < row.size(); ++k)
        if (!in_linear(k)) product *= law(k, row, held).density(row[k]);
    return product;
}

}  // namespace stipple::parameters
