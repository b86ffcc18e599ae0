// SPDX-License-Identifier: MIT
#include "generators/lattices/product_weights.hpp"

#include <cmath>

#include "core/error.hpp"

namespace stipple {

void check_weights(const Values& options, bool searches, std::string_view searching,
                   std::string_view rule) {
    const bool given = options.given(product_weights);
    const bool decays = options.given(weight_decay);
    if (!searches && (given || decays))
        fail(ErrorKind::usage, "--{}: is of {}; the rule here is {}",
             given ? product_weights.name : weight_decay.name, searching, rule);
    if (given && decays)
        fail(ErrorKind::usage, "--weights and --decay: either gives the weights; leave one out");
}

std::vector<std::uint64_t> given_components(const std::vector<double>& numbers,
                                            std::size_t dimension, double least, double most,
                                            std::string_view range) {
    std::vector<std::uint64_t> components;
    for (const double z : numbers) {
        if (!(z >= least && z <= most && z == std::floor(z)))
            fail(ErrorKind::usage, "--vector: {} is not {}", z, range);
        components.push_back(static_cast<std::uint64_t>(z));
    }
    if (components.size() < dimension)
        fail(ErrorKind::usage, "--vector: {} components are too few; dimension {} needs as many",
             components.size(), dimension);
    components.resize(dimension);
    return components;
}

std::vector<double> weights_of(const Values& options, std::size_t dimension) {
    std::vector<double> found = options[product_weights];
    // By divisions, which round alike everywhere; the library's pow need not.
    for (std::size_t j = 1; !options.given(product_weights) && j <= dimension; ++j) {
        found.push_back(1);
        for (std::int64_t e = 0; e < options[weight_decay]; ++e)
            found.back() /= static_cast<double>(j);
    }
    if (found.size() < dimension)
        fail(ErrorKind::usage, "--weights: {} numbers for {} coordinates; give one for each",
             found.size(), dimension);
    for (const double weight : found)
        if (!(weight > 0 && weight <= 1e6))
            fail(ErrorKind::usage, "--weights: {} is outside (0, 1000000]", weight);
    found.resize(dimension);
    return found;
}

}  // namespace stipple
