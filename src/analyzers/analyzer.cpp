// SPDX-License-Identifier: MIT
#include "analyzers/analyzer.hpp"

#include "core/error.hpp"

namespace stipple {

void check_dimension(const Analyzer& analyzer, std::size_t dimension) {
    const auto& traits = analyzer.traits;
    if (dimension >= traits.min_dimension && dimension <= traits.max_dimension) return;
    if (traits.min_dimension == traits.max_dimension)
        fail(ErrorKind::input, "{} takes points of dimension {}; these have {}", analyzer.name,
             traits.min_dimension, dimension);
    fail(ErrorKind::input, "{} takes points of dimension {} to {}; these have {}", analyzer.name,
         traits.min_dimension, traits.max_dimension, dimension);
}

}  // namespace stipple
