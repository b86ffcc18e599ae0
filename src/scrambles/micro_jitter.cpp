// SPDX-License-Identifier: MIT
//
// Micro-jitter: moves every coordinate to a random position in its interval of length 1 / N.
//
//     y = (floor(x N) + u) / N,    u uniform in [0, 1), drawn for each coordinate of each point.
//
// Cost     O(n d).
// Promise  a coordinate stays in its interval [k / N, (k + 1) / N), by exact arithmetic. So N = n
//          keeps the Latin property, and N = b^m the net property of a (t,m,s)-net in base b. A
//          coordinate equal to the rounded lower edge of an interval counts as in that interval.
// Beware   depends on the points' order: u is a function of the point's index.

#include "core/error.hpp"
#include "math/digital/scramble_stream.hpp"
#include "math/digital/stratum.hpp"
#include "scrambles/scramble.hpp"

namespace stipple::scrambles::micro_jitter {
namespace {

constexpr Param<std::int64_t> cells{.name = "cells",
                                    .low = 1,
                                    .high = std::int64_t{1} << 53,
                                    .optional = true,
                                    .help = "Number N of intervals; default: the number of points"};

Randomization make(const Values& options, const ScrambleRequest& request) {
    const std::uint64_t count =
        options.given(cells) ? static_cast<std::uint64_t>(options[cells]) : request.count;
    if (count == 0)
        fail(ErrorKind::usage, "micro-jitter: --cells: needed, as the number of points is unknown");
    return [count, seed = request.seed, which = request.coordinates](std::uint64_t first,
                                                                     std::span<double> rows) {
        // With a fixed stride, u does not depend on which other coordinates are scrambled. A stream
        // has 2^64 numbers, enough for 2^44 points; the next 2^44 points use another stream.
        constexpr std::uint64_t stride = std::uint64_t{1} << 20;
        const auto rng = [seed](std::uint64_t index) {
            const auto stream = static_cast<std::uint64_t>(ScrambleStream::micro_jitter);
            return Rng(seed, stream + (index >> 44 << 32));
        };
        const std::size_t d = which.size();
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const double low = stratum_of(rows[i], static_cast<double>(count));
            const std::uint64_t index = first + i / d;
            rows[i] = rng(index).uniform(index * stride + which[i % d]);
            place_in_strata({.low = {&low, 1}, .parts = count}, &rows[i], 1);
        }
    };
}

}  // namespace

Scramble unit() {
    return {
        .name = "micro-jitter",
        .summary = "Moves every coordinate to a random position in its interval of length 1 / N",
        .source = "Standard construction",
        .options = Schema(cells, scramble_seed),
        .make = make};
}

}  // namespace stipple::scrambles::micro_jitter
