// SPDX-License-Identifier: MIT
//
// Independent uniform random points: number j = i d + k of the engine, from 0 on, is coordinate k
// of point i.
//
//     engine       a number, from the raw output x              seeds
//     philox       53 high bits of Philox 4x32-10, block j / 2  64 bits
//     mt19937-64   53 high bits of std::mt19937_64              64 bits
//     drand48      x / 2^48 of srand48(seed)                    0 to 2^32 - 1
//     ranlux48     x / 2^48 of std::ranlux48                    0 to 2147483562; 0 acts as 19780503
//     ranmar       x / 2^24 of RANMAR(ij, kl)                   30082 ij + kl < 31329 * 30082
//     random       x / 2^31 of the C library's srandom(seed)    0 to 2^32 - 1; 0 acts as 1
//
// Cost     O(n d). philox and drand48 jump to any index; the others draw all earlier numbers.
// Beware   the legacy engines reproduce the numbers of old programs; their quality is low. ranmar
//          and random have so few bits that equal coordinates are frequent.
// Source   see core/rng.hpp and math/digital/legacy_engines.hpp; the C++ standard, [rand.predef].

#include <fmt/format.h>

#include "core/rng.hpp"
#include "generators/generator.hpp"
#include "math/digital/legacy_engines.hpp"

namespace stipple::generators::random {
namespace {

constexpr Param<Choice> engine{
    .name = "rng",
    .fallback = "philox",
    .choices = "philox|mt19937-64|drand48|ranlux48|ranmar|random",
    .help =
        "Random number engine; philox or a legacy one. Legacy engines except drand48 are "
        "sequential: one thread, and --start and --shard draw all earlier numbers"};

/// Sequence of an engine that can only move forward.
template <class Engine>
std::unique_ptr<Sequence> sequential(const Plan& plan) {
    const Engine seeded(plan.seed);
    const auto fill = [=, numbers = seeded, next = std::uint64_t{0}, d = plan.dimension](
                          std::uint64_t first, std::span<double> rows) mutable {
        if (first < next) {
            numbers = seeded;
            next = 0;
        }
        for (; next < first; ++next)
            for (std::size_t k = 0; k < d; ++k) numbers.next();
        for (double& x : rows) x = numbers.next();
        next += rows.size() / d;
    };
    return sequence_of(fill, false);
}

std::unique_ptr<Sequence> make(const Plan& plan, const Values& options, const RunContext&) {
    const std::string name = options[engine];
    const std::uint64_t d = plan.dimension;
    if (name == "mt19937-64") return sequential<MersenneTwister>(plan);
    if (name == "drand48")
        return sequence_of(
            [seeded = Drand48(plan.seed), d](std::uint64_t first, std::span<double> rows) {
                Drand48 numbers = seeded;
                numbers.discard(first * d);
                for (double& x : rows) x = numbers.next();
            });
    if (name == "ranlux48") return sequential<Ranlux48>(plan);
    if (name == "ranmar") return sequential<Ranmar>(plan);
    if (name == "random") return sequential<AdditiveFeedback>(plan);
    return sequence_of([rng = Rng(plan.seed), d](std::uint64_t first, std::span<double> rows) {
        rng.fill(first * d, rows);
    });
}

std::uint64_t max_seed(const Values& options) {
    const std::string name = options[engine];
    if (name == "drand48") return Drand48::max_seed;
    if (name == "ranlux48") return Ranlux48::max_seed;
    if (name == "ranmar") return Ranmar::max_seed;
    if (name == "random") return AdditiveFeedback::max_seed;
    return ~std::uint64_t{0};
}

std::vector<std::string> notes(const Request& /*request*/, const Plan& plan,
                               const Values& options) {
    const std::string name = options[engine];
    if (plan.seed > 0 || (name != "random" && name != "ranlux48")) return {};
    return {fmt::format("the engine {} takes seed 0 for {}: both give the same points", name,
                        name == "random" ? 1 : 19780503)};
}

}  // namespace

Generator unit() {
    return {
        .name = "random",
        .summary = "Independent uniform random points, by a counter or by older engines",
        .source = "Salmon et al. 2011, doi:10.1145/2063384.2063405",
        .related = {"monte-carlo", "pseudorandom", "mersenne-twister", "mt19937", "white", "rand"},
        .traits = {.independent = true},
        .options = Schema(engine),
        .aliases = {"uniform", "independent", "white-noise"},
        .sequence = make,
        .notes = notes,
        .max_seed = max_seed};
}

}  // namespace stipple::generators::random
