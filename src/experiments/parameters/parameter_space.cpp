// SPDX-License-Identifier: MIT
#include "experiments/parameters/parameter_space.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/error.hpp"
#include "math/densities/affine.hpp"

namespace stipple::parameters {
namespace {

/// Quantile; an infinite one is replaced by the quantile at the smallest random number.
double place(const Marginal& law, const Share& share) {
    const Tail tail = share.below <= share.above ? Tail::lower : Tail::upper;
    const double x = law.quantile(std::min(share.below, share.above), tail);
    return std::isfinite(x) ? x : law.quantile(0x1p-54, tail);
}

/// Probabilities below and above x; for a discrete x, half of its own probability is in each.
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

/// Range of a parameter that can be a coordinate of the polytope; nullopt if it cannot.
using UniformRange = std::optional<std::pair<double, double>>;

/// Half-spaces of an affine constraint; nullopt if it is not affine or has too many variables.
std::optional<std::vector<HalfSpace>> half_spaces(const Expression& constraint) {
    constexpr std::size_t most = 12;
    std::set<std::size_t> used;
    for (const FormulaStep& step : constraint.steps())
        if (step.kind == FormulaStep::coordinate) used.insert(step.index);
    return used.size() > most ? std::nullopt : affine_inequalities(constraint);
}

/// Makes a polytope from the linear constraints and removes them from the list; nullopt if there
/// are none, or if the polytope is too large. @throws Error(usage) if no parameters satisfy them
std::optional<LinearPart> take_linear_part(const std::vector<UniformRange>& ranges,
                                           std::vector<Expression>& constraints) {
    std::vector<HalfSpace> cuts;
    std::vector<Expression> taken, left;
    std::set<std::size_t> joined;
    for (const Expression& constraint : constraints) {
        const auto some = half_spaces(constraint);
        std::set<std::size_t> used;
        for (std::size_t i = 0; some && i < some->size(); ++i)
            for (std::size_t k = 0; k < ranges.size(); ++k)
                if ((*some)[i].normal[k] != 0) used.insert(k);
        const bool belongs =
            some && std::ranges::all_of(used, [&](std::size_t k) { return ranges[k].has_value(); });
        (belongs ? taken : left).push_back(constraint);
        if (!belongs) continue;
        cuts.insert(cuts.end(), some->begin(), some->end());
        joined.insert(used.begin(), used.end());
    }
    if (joined.empty()) return std::nullopt;
    std::vector<std::size_t> coordinates(joined.begin(), joined.end());
    Box box;
    for (const std::size_t k : coordinates) {
        box.low.push_back(ranges[k]->first);
        box.high.push_back(ranges[k]->second);
    }
    for (HalfSpace& cut : cuts) {
        std::vector<double> own;
        for (const std::size_t k : coordinates) own.push_back(cut.normal[k]);
        cut.normal = std::move(own);
    }
    try {
        LinearPart part(std::move(coordinates), box, cuts, std::move(taken));
        constraints = std::move(left);
        return part;
    } catch (const Error& e) {
        if (e.kind() != ErrorKind::limit) throw;
        return std::nullopt;  // the polytope is too large: rejection is used instead
    }
}

}  // namespace

LinearPart::LinearPart(std::vector<std::size_t> coordinates, const Box& ranges,
                       const std::vector<HalfSpace>& cuts, std::vector<Expression> constraints)
    : coordinates_(std::move(coordinates)),
      polytope_(ranges, cuts),
      share_(polytope_.volume() / volume_of(ranges)),
      constraints_(std::move(constraints)) {}

bool LinearPart::holds(std::size_t k) const {
    return std::ranges::find(coordinates_, k) != coordinates_.end();
}

void LinearPart::from_cube(std::span<const double> cube, std::span<double> rows,
                           std::size_t dimension) const {
    constexpr std::size_t some_rows = 512;
    const std::size_t size = coordinates_.size();
    const std::size_t count = rows.size() / dimension;
    std::vector<double> own(std::min(count, some_rows) * size), points(own.size());
    for (std::size_t first = 0; first < count; first += some_rows) {
        const std::size_t some = std::min(some_rows, count - first);
        for (std::size_t i = 0; i < some; ++i)
            for (std::size_t k = 0; k < size; ++k)
                own[i * size + k] = cube[(first + i) * dimension + coordinates_[k]];
        polytope_.from_cube(std::span(own).first(some * size),
                            std::span(points).first(some * size));
        for (std::size_t i = 0; i < some; ++i) {
            const auto row = rows.subspan((first + i) * dimension, dimension);
            for (std::size_t k = 0; k < size; ++k) row[coordinates_[k]] = points[i * size + k];
            move_inside(row);
        }
    }
}

void LinearPart::to_cube(std::span<const double> row, std::span<double> cube) const {
    std::vector<double> own, numbers(coordinates_.size());
    for (const std::size_t k : coordinates_) own.push_back(row[k]);
    polytope_.to_cube(own, numbers);
    for (std::size_t i = 0; i < coordinates_.size(); ++i) cube[coordinates_[i]] = numbers[i];
}

void LinearPart::move_inside(std::span<double> row) const {
    const std::vector<double>& middle = polytope_.moments().mean;
    for (double step = 0x1p-52; step < 1 && !hold(constraints_, row); step *= 2)
        for (std::size_t i = 0; i < coordinates_.size(); ++i) {
            double& x = row[coordinates_[i]];
            x += step * (middle[i] - x);
        }
}

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
        const bool uniform = parameter.law && parameter.uniform;
        ranges.push_back(alone && uniform ? UniformRange(parameter.law->support()) : std::nullopt);
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
