// SPDX-License-Identifier: MIT
//
// Compares results with their definitions, and with the same computed in shards or by several
// threads.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "fuzz.hpp"
#include "io/format.hpp"
#include "pipeline/produce.hpp"
#include "pipeline/reproduction.hpp"
#include "pipeline/units.hpp"
#include "stipple/stipple.hpp"

namespace stipple::fuzz {
namespace {

using Bytes = std::string_view;

FuzzedDataProvider provider(Bytes bytes) {
    return {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
}

// Coordinates are multiples of 1/64, so that ties, 0 and 1 are common.
constexpr std::int64_t steps = 64;

/// Up to `most[d]` points of d coordinates.
PointSet lattice_points(FuzzedDataProvider& input, const std::vector<std::size_t>& most) {
    const auto d = input.ConsumeIntegralInRange<std::size_t>(1, most.size());
    const auto n = input.ConsumeIntegralInRange<std::size_t>(1, most[d - 1]);
    PointSet points(n, d);
    for (double& x : points.flat())
        x = static_cast<double>(input.ConsumeIntegralInRange<std::int64_t>(0, steps)) / steps;
    return points;
}

struct InBox {
    std::int64_t open = 0;
    std::int64_t closed = 0;
};

InBox count(const PointSet& points, const std::vector<double>& corner) {
    InBox inside;
    for (std::size_t i = 0; i < points.count(); ++i) {
        bool open = true;
        bool closed = true;
        for (std::size_t k = 0; k < corner.size(); ++k) {
            open = open && points[i][k] < corner[k];
            closed = closed && points[i][k] <= corner[k];
        }
        inside.open += open;
        inside.closed += closed;
    }
    return inside;
}

/// Largest n steps^d |fraction - volume| over all corners made of coordinates and 1, in integers.
std::int64_t worst_box(const PointSet& points, std::vector<double>& corner) {
    if (corner.size() == points.dimension()) {
        std::int64_t volume = static_cast<std::int64_t>(points.count());
        std::int64_t whole = 1;
        for (const double x : corner) {
            volume *= std::llround(x * steps);
            whole *= steps;
        }
        const InBox inside = count(points, corner);
        return std::max(volume - whole * inside.open, whole * inside.closed - volume);
    }
    std::int64_t worst = 0;
    for (std::size_t i = 0; i <= points.count(); ++i) {
        corner.push_back(i < points.count() ? points[i][corner.size()] : 1.0);
        worst = std::max(worst, worst_box(points, corner));
        corner.pop_back();
    }
    return worst;
}

void star(Bytes bytes) {
    FuzzedDataProvider input = provider(bytes);
    const PointSet points = lattice_points(input, {40, 24, 12, 8});
    std::vector<double> corner;
    const double expected = static_cast<double>(worst_box(points, corner)) /
                            (static_cast<double>(points.count()) *
                             std::pow(steps, static_cast<double>(points.dimension())));
    const RunContext run = small_run();
    const Report found = analyze("star-discrepancy", points, {}, run);
    if (run.stop.stop_requested()) return;  // the search ended early, with a bound
    require(found.number("value") == expected, "another star discrepancy");
}

/// Factors of one axis in a squared L2 discrepancy: prod none - 2/n sum prod point + 1/n^2 sum prod
/// pair.
struct Kernel {
    const char* name;
    long double (*pair)(long double, long double);
    long double (*point)(long double);
    long double none;
};

const Kernel kernels[] = {
    {"star", [](long double x, long double y) { return 1 - std::max(x, y); },
     [](long double x) { return (1 - x * x) / 2; }, 1.0L / 3},
    {"extreme", [](long double x, long double y) { return std::min(x, y) - x * y; },
     [](long double x) { return x * (1 - x) / 2; }, 1.0L / 12},
    {"periodic",
     [](long double x, long double y) {
         const long double t = std::abs(x - y);
         return 0.5L - t + t * t;
     },
     [](long double) { return 1.0L / 3; }, 1.0L / 3},
    {"centered",
     [](long double x, long double y) {
         return 1 + (std::abs(x - 0.5L) + std::abs(y - 0.5L) - std::abs(x - y)) / 2;
     },
     [](long double x) {
         const long double t = std::abs(x - 0.5L);
         return 1 + (t - t * t) / 2;
     },
     13.0L / 12},
    {"wraparound",
     [](long double x, long double y) {
         const long double t = std::abs(x - y);
         return 1.5L - t + t * t;
     },
     [](long double) { return 4.0L / 3; }, 4.0L / 3},
    {"symmetric", [](long double x, long double y) { return 2 - 2 * std::abs(x - y); },
     [](long double x) { return 1 + 2 * x * (1 - x); }, 4.0L / 3},
};

long double square_by_pairs(const PointSet& points, const Kernel& kernel) {
    const std::size_t n = points.count();
    long double square = 1;
    for (std::size_t k = 0; k < points.dimension(); ++k) square *= kernel.none;
    for (std::size_t i = 0; i < n; ++i) {
        long double single = -2.0L / static_cast<long double>(n);
        for (const double x : points[i]) single *= kernel.point(x);
        square += single;
        for (std::size_t j = 0; j < n; ++j) {
            long double pair = 1.0L / static_cast<long double>(n * n);
            for (std::size_t k = 0; k < points.dimension(); ++k)
                pair *= kernel.pair(points[i][k], points[j][k]);
            square += pair;
        }
    }
    return square;
}

void l2(Bytes bytes) {
    FuzzedDataProvider input = provider(bytes);
    const bool ties = input.ConsumeBool();
    PointSet points = lattice_points(input, {30, 60, 30, 12, 9});
    if (!ties)
        for (double& x : points.flat()) x = x * input.ConsumeProbability<double>();
    const Report found =
        analyze("l2-discrepancy", points, {{"kind", "star,extreme,periodic,centered,wraparound"}},
                small_run());
    for (const Kernel& kernel : kernels) {
        const long double expected = square_by_pairs(points, kernel);
        const double square = found.number(std::string(kernel.name) + ".squared");
        const bool close = std::abs(square - expected) <= 1e-15L * (1 + std::abs(expected)) * 8;
        require(close, std::string("another L2 discrepancy: ") + kernel.name);
    }
}

/// Any generator with any of its options, and few points.
SetsToMake production(FuzzedDataProvider& input) {
    const auto& all = generators::all();
    SetsToMake made;
    made.generator = &all[input.ConsumeIntegralInRange<std::size_t>(0, all.size() - 1)];
    made.options = quick_options(*made.generator);
    made.request.count = input.ConsumeIntegralInRange<std::uint64_t>(1, 70);
    made.request.dimension = input.ConsumeIntegralInRange<std::size_t>(1, 4);
    made.request.seed = input.ConsumeIntegral<std::uint8_t>();
    made.request.start = input.ConsumeBool() ? input.ConsumeIntegral<std::uint16_t>() : 0;
    made.sets = input.ConsumeIntegralInRange<std::uint64_t>(1, 3);
    std::vector<Option> options = made.generator->options.options();
    std::erase_if(options, [](const Option& option) {
        return option.type == "file" || option.name == "effort";
    });
    while (!options.empty() && input.remaining_bytes() > 0) {
        const Option& option =
            options[input.ConsumeIntegralInRange<std::size_t>(0, options.size() - 1)];
        std::string text = input.ConsumeRandomLengthString(12);
        if (option.type == "flag") text = "true";
        if (!option.choices.empty()) text = option.choices[text.size() % option.choices.size()];
        accepted([&] { made.generator->options.set(made.options, option.name, text); });
    }
    return made;
}

/// The points as CSV, made with limited resources.
std::string text_of(const SetsToMake& production, unsigned threads) {
    RunContext run = small_run();
    run.threads = threads;
    const auto make = [&](const stipple::Target& target) { produce(production, target, run); };
    return bytes_of(make, {.format = &io::format_named("txt")});
}

void shards(Bytes bytes) {
    FuzzedDataProvider input = provider(bytes);
    SetsToMake made = production(input);
    const std::string whole = text_of(made, 1);
    require(text_of(made, 3) == whole, "other points on several threads");
    made.sets = 1;
    const std::string first = text_of(made, 1);
    made.shard.of = 3;
    std::string joined;
    std::size_t empty = 0;
    for (made.shard.index = 0; made.shard.index < made.shard.of; ++made.shard.index)
        if (!accepted([&] { joined += text_of(made, 1); })) ++empty;
    require(joined == first || empty > 0, "other points in shards");
}

/// Runs any analyzer on few points; several threads must give the same report as one.
void threads(Bytes bytes) {
    FuzzedDataProvider input = provider(bytes);
    const auto& all = analyzers::all();
    const Analyzer& analyzer = all[input.ConsumeIntegralInRange<std::size_t>(0, all.size() - 1)];
    const PointSet points = lattice_points(input, {40, 40, 20, 9, 9});
    if (analyzer.name == "periodogram" && points.dimension() > 2) return;  // slow
    RunContext run = small_run();
    const Report one = analyze(analyzer.name, points, {}, run);
    run.threads = 3;
    const Report several = analyze(analyzer.name, points, {}, run);
    if (run.stop.stop_requested()) return;  // searches then return bounds
    require(to_text(several) == to_text(one),
            analyzer.name + ": another report on several threads");
}

}  // namespace

std::vector<Target> comparison_targets() {
    return {{"star", star}, {"l2", l2}, {"shards", shards}, {"threads", threads}};
}

}  // namespace stipple::fuzz
