// SPDX-License-Identifier: MIT
#include "generators/generator.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "math/functions/powers.hpp"

namespace stipple {
namespace {

void check_dimension(const Generator& generator, std::size_t dimension, const Values& options) {
    const auto& traits = generator.traits;
    const std::string& more = traits.more_dimensions;
    const bool unlimited = !more.empty() && options.find(more).given;
    if (dimension >= traits.min_dimension && (dimension <= traits.max_dimension || unlimited))
        return;
    fail_with_hint(ErrorKind::usage, more.empty() ? "" : fmt::format("--{} allows more", more),
                   "--dimension: {} is outside [{}, {}], the range of {}", dimension,
                   traits.min_dimension, traits.max_dimension, generator.name);
}

void check_indices(const Generator& generator, const Request& request, std::uint64_t count,
                   std::size_t dimension) {
    const auto& traits = generator.traits;
    if (request.start > 0 && !traits.prefix)
        fail(ErrorKind::usage,
             "--start: the points of {} depend on the count, so a set cannot start later; leave "
             "--start out",
             generator.name);
    if (request.start == 0 && count > traits.max_index)
        fail(ErrorKind::usage, "--count: {} is outside [1, {}], the range of {}", count,
             traits.max_index, generator.name);
    if (request.start > traits.max_index || count > traits.max_index - request.start)
        fail(ErrorKind::usage, "--start {} and {} points go beyond index {}, the last of {}",
             request.start, count, traits.max_index - 1, generator.name);
    const auto numbers =
        static_cast<double>(request.start + count) * static_cast<double>(dimension);
    if (numbers >= 0x1p63)
        fail(ErrorKind::usage, "{} points of dimension {} have more than 2^63 coordinates",
             request.start + count, dimension);
}

}  // namespace

Values quick_options(const Generator& generator) {
    Values values = generator.options.defaults();
    for (const Option& option : generator.options.options())
        if (option.name == "effort") values.put(option.name, option.low, false);
    return values;
}

Plan default_plan(const Request& request, std::uint64_t count, std::size_t dimension) {
    return {.count = request.count.value_or(count),
            .dimension = request.dimension.value_or(dimension),
            .seed = request.seed,
            .bounds = request.bounds,
            .start = request.start};
}

Plan plan_for(const Generator& generator, const Request& request, const Values& options) {
    if (request.count == std::uint64_t{0})
        fail(ErrorKind::usage, "--count: 0 is outside [1, 2^53]; a set has at least one point");
    if (request.dimension) check_dimension(generator, *request.dimension, options);
    const Plan plan = generator.plan ? generator.plan(request, options) : default_plan(request);
    check_dimension(generator, plan.dimension, options);
    check_indices(generator, request, plan.count, plan.dimension);
    if (generator.max_seed && plan.seed > generator.max_seed(options))
        fail(ErrorKind::usage, "--seed: {} is outside [0, {}], the range of this generator's seeds",
             plan.seed, generator.max_seed(options));
    return plan;
}

bool uses_seed(const Generator& generator, const Values& options) {
    return generator.uses_seed ? generator.uses_seed(options) : generator.traits.seeded;
}

void refuse_count(std::uint64_t count, const std::string& what, const std::string& who,
                  std::uint64_t below, std::uint64_t above) {
    const std::string nearest = below == 0 ? fmt::format("{} is the least", above)
                                : above > std::uint64_t{1} << 53
                                    ? fmt::format("{} is the nearest", below)
                                    : fmt::format("{} and {} are the nearest", below, above);
    fail(ErrorKind::usage, "--count: {} is not {}, as {} needs; {}", count, what, who, nearest);
}

std::uint64_t exact_root(std::uint64_t count, std::size_t dimension, const std::string& who) {
    const std::uint64_t k = floor_root(count, dimension);
    const std::uint64_t below = saturating_power(k, dimension);
    if (below == count) return k;
    refuse_count(count, fmt::format("k^{}", dimension), who, below,
                 saturating_power(k + 1, dimension));
}

Plan plan_of_cubes(const Request& request, const std::string& who) {
    const std::size_t dimension = request.dimension.value_or(2);
    const Plan plan = default_plan(request, nearest_power(1024, dimension), dimension);
    exact_root(plan.count, dimension, who);
    return plan;
}

}  // namespace stipple
