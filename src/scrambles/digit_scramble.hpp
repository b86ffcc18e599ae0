// SPDX-License-Identifier: MIT
//
// Shared code of the scrambles that work on digits: every coordinate has a base and a random map of
// its digits in that base. Maps of base 2 have separate classes, which map up to most_moved points
// per call.
#pragma once

#include <array>
#include <variant>
#include <vector>

#include "math/digital/base_scramble.hpp"
#include "math/digital/binary_scramble.hpp"
#include "scrambles/scramble.hpp"

namespace stipple {

/// Returns the function for Scramble::make.
/// @tparam Binary map of base 2: apply(fractions), in place (math/digital/binary_scramble.hpp)
/// @tparam General map of another base: of(digits) is the image (math/digital/base_scramble.hpp)
/// Both are constructed from a seed and a coordinate's index, General also from its base.
/// @param base the option --base, which must outlive the scramble
/// @param prime whether bases must be primes
template <class Binary, class General>
auto digit_scramble(const Param<Numbers>& base, bool prime) {
    return [&base, prime](const Values& options, const ScrambleRequest& request) {
        const auto bases = bases_for(options[base], request.coordinates.size(), prime);
        std::vector<std::variant<Binary, General>> maps;
        for (std::size_t k = 0; k < bases.size(); ++k) {
            const std::size_t coordinate = request.coordinates[k];
            if (bases[k] == 2)
                maps.emplace_back(Binary(request.seed, coordinate));
            else
                maps.emplace_back(General(request.seed, coordinate, bases[k]));
        }
        return coordinate_wise(bases.size(), [bases, maps](std::size_t k, std::span<double> x) {
            if (const auto* binary = std::get_if<Binary>(&maps[k])) {
                std::array<std::uint64_t, most_moved> fractions;
                for (std::size_t i = 0; i < x.size(); ++i) fractions[i] = unit_to_fraction(x[i]);
                binary->apply(std::span(fractions).first(x.size()));
                for (std::size_t i = 0; i < x.size(); ++i) x[i] = fraction_to_unit(fractions[i]);
                return;
            }
            const General& map = std::get<General>(maps[k]);
            for (double& value : x) value = map.of(reversed_digits(value, bases[k]));
        });
    };
}

}  // namespace stipple
