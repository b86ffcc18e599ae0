// SPDX-License-Identifier: MIT
//
// Shared checks of sequences.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "support/units.hpp"

namespace stipple::testing {

/// Sequence of a generator.
inline std::unique_ptr<Sequence> sequence_of(std::string_view name, const Request& request,
                                             const Settings& settings = {}) {
    const Generator& generator = find_generator(name);
    Values values = generator.options.defaults();
    for (const auto& [option, text] : settings) generator.options.set(values, option, text);
    return generator.sequence(plan_for(generator, request, values), values, {});
}

/// Points first, ..., first + count - 1 of a sequence.
inline PointSet stretch(Sequence& sequence, std::size_t dimension, std::uint64_t first,
                        std::size_t count) {
    PointSet points(count, dimension);
    sequence.fill(first, points.flat());
    return points;
}

/// Whether any ranges of points, requested in any order, equal those of the whole set.
inline bool stretches_agree(std::string_view name, const Request& request,
                            const Settings& settings = {}) {
    const auto sequence = sequence_of(name, request, settings);
    const std::size_t d = request.dimension.value();
    const std::size_t n = request.count.value();
    const PointSet whole = stretch(*sequence, d, 0, n);
    for (const std::size_t size : {std::size_t{1}, std::size_t{7}, n / 2, n})
        for (std::size_t first = (n - size) % 5; first + size <= n; first += 1 + 2 * size / 3) {
            const PointSet part = stretch(*sequence, d, n - size - first, size);
            if (!std::ranges::equal(part.flat(),
                                    whole.flat().subspan((n - size - first) * d, size * d)))
                return false;
        }
    return true;
}

}  // namespace stipple::testing
