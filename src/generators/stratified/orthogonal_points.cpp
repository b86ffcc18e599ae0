// SPDX-License-Identifier: MIT
#include "generators/stratified/orthogonal_points.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "math/combinatorics/permutation.hpp"
#include "math/combinatorics/primes.hpp"
#include "math/functions/powers.hpp"

namespace stipple::generators {
namespace {

class OrthogonalPoints {
  public:
    OrthogonalPoints(const Plan& plan, const ArrayShape& shape, Substrata substrata)
        : shape_(shape), substrata_(substrata) {
        for (std::size_t l = 0; l <= shape.strength; ++l)
            powers_.push_back(saturating_power(shape.levels, l));
        const std::size_t d = plan.dimension;
        levels_ = PermutationFamily(shape.levels, d, stratified_numbers(plan, 0));
        if (substrata != Substrata::none)
            within_ = PermutationFamily(powers_[shape.strength - 1],
                                        substrata == Substrata::shared ? d : d * shape.levels,
                                        stratified_numbers(plan, 1));
    }

    std::uint64_t operator()(std::size_t coordinate, std::span<const double> index,
                             std::span<double> low) const {
        const std::uint64_t parts = substrata_ == Substrata::none ? shape_.levels : powers_.back();
        for (std::size_t j = 0; j < index.size(); ++j) {
            const Entry at = entry(coordinate, static_cast<std::uint64_t>(index[j]));
            std::uint64_t stratum = levels_(coordinate, at.level) * (parts / shape_.levels);
            if (substrata_ == Substrata::independent)
                stratum += within_(coordinate * shape_.levels + at.level, at.rest);
            else if (substrata_ == Substrata::shared)
                stratum += within_(coordinate, at.rest);
            low[j] = static_cast<double>(stratum);
        }
        return parts;
    }

  private:
    /// Level of a row in a column, and the rank of the row among the rows of that level, from 0.
    struct Entry {
        std::uint64_t level;
        std::uint64_t rest;
    };

    [[nodiscard]] std::uint64_t value(std::size_t column, std::uint64_t row) const {
        const std::uint64_t s = shape_.levels;
        const std::size_t t = shape_.strength;
        if (shape_.columns == Columns::digits) return row / powers_[column] % s;
        if (column == 0) return row % s;
        if (column == 1) return row / powers_[t - 1];
        const std::uint64_t x = column - 1;
        std::uint64_t sum = 0;
        for (std::size_t l = t; l-- > 0; row %= powers_[l]) sum = (sum * x + row / powers_[l]) % s;
        return sum;
    }

    [[nodiscard]] Entry entry(std::size_t column, std::uint64_t row) const {
        const std::uint64_t level = value(column, row);
        const std::uint64_t s = shape_.levels;
        if (shape_.columns == Columns::digits) {
            const std::uint64_t before = powers_[column];
            return {level, row % before + row / before / s * before};
        }
        if (shape_.strength == 2) {
            // Columns 0 and 1, 2 and 3, ... are partners: one's rank is the other's level, so that
            // together they are a multi-jittered set in the plane.
            const std::size_t partner = (column ^ 1) <= s ? column ^ 1 : 0;
            return {level, value(partner, row)};
        }
        // The rank has all base-s digits of the row except one, which they and the level determine.
        return {level, column == 1 ? row % powers_[shape_.strength - 1] : row / s};
    }

    ArrayShape shape_;
    Substrata substrata_;
    std::vector<std::uint64_t> powers_;  ///< s^0, ..., s^t
    PermutationFamily levels_;           ///< permutation of levels for each column
    PermutationFamily within_;           ///< permutations of the points of a level
};

}  // namespace

std::unique_ptr<Sequence> orthogonal_points(const Plan& plan, const StratifiedStyle& style,
                                            const ArrayShape& shape, Substrata substrata) {
    return stratified_sequence(plan, style, OrthogonalPoints(plan, shape, substrata));
}

std::uint64_t prime_root(std::uint64_t count, std::size_t strength, const std::string& who) {
    std::uint64_t below = floor_root(count, strength);
    if (is_prime(below) && saturating_power(below, strength) == count) return below;
    const std::uint64_t above = saturating_power(next_prime(below + 1), strength);
    while (below >= 2 && !is_prime(below)) --below;
    refuse_count(count, fmt::format("p^{} for a prime p", strength), who,
                 below < 2 ? 0 : saturating_power(below, strength), above);
}

Plan plan_by_polynomials(const Request& request, std::size_t strength, const std::string& who) {
    const std::size_t d = request.dimension.value_or(2);
    const std::uint64_t least = next_prime(d < 3 ? 2 : d - 1);
    const std::uint64_t least_count = saturating_power(least, strength);
    if (least_count > std::uint64_t{1} << 53)
        fail(ErrorKind::usage, "--dimension: {} needs more than 2^53 points at strength {}", d,
             strength);
    if (!request.count) {
        std::uint64_t p = least;
        for (std::uint64_t q = p; saturating_power(q, strength) < 2048; q = next_prime(q + 1)) {
            const auto distance = [&](std::uint64_t levels) {
                const std::uint64_t count = saturating_power(levels, strength);
                return count > 1024 ? count - 1024 : 1024 - count;
            };
            if (distance(q) < distance(p)) p = q;
        }
        return default_plan(request, saturating_power(p, strength), d);
    }
    const std::uint64_t p = prime_root(*request.count, strength, who);
    if (d > p + 1)
        fail(ErrorKind::usage,
             "--dimension: {} is outside [1, {}], the range of {} points at strength {}; it needs "
             "at least {} points",
             d, p + 1, *request.count, strength, least_count);
    return default_plan(request, *request.count, d);
}

}  // namespace stipple::generators
