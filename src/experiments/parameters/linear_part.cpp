// SPDX-License-Identifier: MIT
#include "experiments/parameters/linear_part.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "math/densities/affine.hpp"

namespace stipple::parameters {

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

bool LinearPart::allowed(std::span<const double> row) const {
    return std::ranges::all_of(
        constraints_, [&](const Expression& constraint) { return constraint.at(row) != 0; });
}

void LinearPart::move_inside(std::span<double> row) const {
    const std::vector<double>& middle = polytope_.moments().mean;
    for (double step = 0x1p-52; step < 1 && !allowed(row); step *= 2)
        for (std::size_t i = 0; i < coordinates_.size(); ++i) {
            double& x = row[coordinates_[i]];
            x += step * (middle[i] - x);
        }
}

namespace {

/// Half-spaces of an affine constraint; nullopt if it is not affine, or has more variables than a
/// polytope may have.
std::optional<std::vector<HalfSpace>> half_spaces(const Expression& constraint) {
    constexpr std::size_t most = 12;
    VariableNames own = constraint.variables();
    if (own.size() > most) return std::nullopt;
    for (std::size_t i = 0; i < own.size(); ++i) own[i].second = i;
    auto all = affine_inequalities(constraint.plain(), own, own.size());
    for (std::size_t i = 0; all && i < all->size(); ++i) {
        HalfSpace& half = (*all)[i];
        std::vector<double> normal(constraint.dimension());
        for (std::size_t j = 0; j < own.size(); ++j)
            normal[constraint.variables()[j].second] += half.normal[j];
        half.normal = std::move(normal);
        half.text = constraint.text();
    }
    return all;
}

}  // namespace

std::optional<LinearPart> take_linear_part(const std::vector<UniformRange>& ranges,
                                           std::vector<Expression>& constraints) {
    const std::size_t d = ranges.size();
    std::vector<HalfSpace> cuts;
    std::vector<Expression> taken, left;
    std::vector<bool> joined(d);
    for (const Expression& constraint : constraints) {
        const auto some = half_spaces(constraint);
        std::vector<bool> used(d);
        for (std::size_t i = 0; some && i < some->size(); ++i)
            for (std::size_t k = 0; k < d; ++k) used[k] = used[k] || (*some)[i].normal[k] != 0;
        bool belongs = some.has_value();
        for (std::size_t k = 0; k < d; ++k) belongs = belongs && (!used[k] || ranges[k]);
        (belongs ? taken : left).push_back(constraint);
        if (!belongs) continue;
        cuts.insert(cuts.end(), some->begin(), some->end());
        for (std::size_t k = 0; k < d; ++k) joined[k] = joined[k] || used[k];
    }
    std::vector<std::size_t> coordinates;
    Box box;
    for (std::size_t k = 0; k < d; ++k) {
        if (!joined[k]) continue;
        coordinates.push_back(k);
        box.low.push_back(ranges[k]->first);
        box.high.push_back(ranges[k]->second);
    }
    if (coordinates.empty()) return std::nullopt;
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

}  // namespace stipple::parameters
