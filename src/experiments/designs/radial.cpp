// SPDX-License-Identifier: MIT
#include "experiments/designs/radial.hpp"

#include <algorithm>
#include <vector>

#include "core/error.hpp"
#include "stipple/generate.hpp"

namespace stipple::generators {
namespace {

void fill(const Sampler& base, const RadialShape& shape, const RadialRun& write_run,
          std::uint64_t first, std::span<double> rows) {
    constexpr std::uint64_t together = 256;
    const std::size_t d = shape.dimension;
    std::vector<double> points;
    for (std::uint64_t i = first / shape.runs; !rows.empty(); i += together) {
        const std::uint64_t left = (first % shape.runs + rows.size() / d - 1) / shape.runs + 1;
        const std::uint64_t count = std::min(together, left);
        points.resize((count + shape.ahead) * 2 * d);
        base.fill(i, points);
        for (; !rows.empty() && first / shape.runs < i + count; ++first, rows = rows.subspan(d)) {
            const double* a = points.data() + (first / shape.runs - i) * 2 * d;
            std::copy_n(a, d, rows.begin());
            write_run(first % shape.runs, std::span(a + (2 * shape.ahead + 1) * d, d),
                      rows.first(d));
        }
    }
}

}  // namespace

std::unique_ptr<Sequence> radial_sequence(const RadialShape& shape, const std::string& base,
                                          std::uint64_t seed, RadialRun write_run) {
    Request request{.dimension = 2 * shape.dimension, .seed = seed};
    const auto points = std::make_shared<const Sampler>(base, request);
    request.start = 1;  // makes Sampler fail unless the base is a sequence
    try {
        Sampler(base, request);
    } catch (const Error&) {
        fail(ErrorKind::usage,
             "--base: the points of {} depend on their number; expected an infinite sequence such "
             "as sobol, halton or random",
             base);
    }
    return sequence_of([points, shape, write_run = std::move(write_run)](std::uint64_t first,
                                                                         std::span<double> rows) {
        fill(*points, shape, write_run, first, rows);
    });
}

}  // namespace stipple::generators
