// SPDX-License-Identifier: MIT
#include "math/discrepancy/star/search.hpp"

#include <array>
#include <mutex>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "math/discrepancy/star/strips.hpp"

namespace stipple::discrepancy::star {
namespace {

constexpr std::size_t ticks_apart = 256;  // points between progress reports

}  // namespace

SearchResult sweep_1d(const BoxGrid& grid, const RunContext& run) {
    WorstBox worst(grid);
    const auto& values = grid.values[0];
    const auto points = points_at(grid, 0);
    std::uint64_t below = 0;
    for (std::uint32_t a = 0; a < values.size(); ++a) {
        worst.offer(Side::open, std::array{a}, below);
        below += points[a];
        worst.offer(Side::closed, std::array{a}, below);
        if (a % ticks_apart == 0) run.tick(a, values.size());
    }
    run.tick(1, 1);
    return {worst, worst.value(), Ending::complete};
}

namespace {

/// Thrown if a sweep is out of time or stopped.
struct Halt {};

/// Sweeps all strips in worst.size() / 2 parts; part i offers open boxes to worst[2 i], closed ones
/// to worst[2 i + 1].
void sweep_parts(const Plane& points, std::vector<WorstBox>& worst, const SearchLimits& limits,
                 const RunContext& run) {
    const std::size_t n = points.grid->count;
    const std::size_t strips = points.strips.count();
    const std::size_t parts = worst.size() / 2;
    std::mutex reporting;
    std::uint64_t done = 0;
    const auto report = [&](std::uint64_t dots) {
        const std::lock_guard lock(reporting);
        run.tick(done += dots, 2 * n);
    };
    for_each_block(silent(worth_threads(run, 3e-7 * static_cast<double>(n))), worst.size(), 1,
                   [&](const Block& block) {
                       const std::size_t part = block.index / 2;
                       std::uint64_t passed = 0;
                       sweep_strips(points, block.index % 2 == 0 ? Side::open : Side::closed,
                                    {strips * part / parts, strips * (part + 1) / parts},
                                    worst[block.index], run, [&](std::uint64_t dots) {
                                        passed += dots;
                                        if (passed < ticks_apart) return;
                                        if (limits.over(run)) throw Halt{};
                                        report(std::exchange(passed, 0));
                                    });
                       report(passed);
                   });
}

void need_memory_of_sweep(const BoxGrid& grid, const RunContext& run) {
    const double each = 24 + 12 * std::min(4.0, static_cast<double>(run.thread_count()));
    run.need_memory(each * static_cast<double>(grid.count), "the sweep over the square");
}

/// Number of parts; few, because each part first adds all points to its left, and starts without
/// the worst boxes of the others.
std::size_t parts_of_sweep(const BoxGrid& grid) { return grid.count < 100'000 ? 1 : 2; }

}  // namespace

SearchResult sweep_2d(const BoxGrid& grid, const SearchLimits& limits, const RunContext& run) {
    need_memory_of_sweep(grid, run);
    const std::size_t parts = parts_of_sweep(grid);
    std::vector<WorstBox> worst(2 * parts, WorstBox(grid));
    bool complete = true;
    try {
        offer_axis_boxes(grid, worst[0]);
        worst.assign(2 * parts, WorstBox(worst[0]));
        sweep_parts(plane(grid, run), worst, limits, run);
    } catch (const Halt&) {
        complete = false;
    } catch (const Error& e) {
        if (e.kind() != ErrorKind::cancelled) throw;
        complete = false;
    }
    for (std::size_t i = 1; i < worst.size(); ++i) worst[0].offer(worst[i]);
    return result_of_sweep(worst[0], complete, limits, run);
}

WorstOfSides worst_of_sides_2d(const BoxGrid& grid, const RunContext& run) {
    need_memory_of_sweep(grid, run);
    WorstOfSides found{.open = WorstBox(grid), .closed = WorstBox(grid)};
    offer_axis_boxes(grid, found.open, found.closed);
    std::vector<WorstBox> worst;
    for (std::size_t part = 0; part < parts_of_sweep(grid); ++part) {
        worst.push_back(found.open);
        worst.push_back(found.closed);
    }
    try {
        sweep_parts(plane(grid, run), worst, {}, run);
    } catch (const Halt&) {  // there is no deadline, so a stop was requested
        run.check_stop();
    }
    for (std::size_t i = 0; i < worst.size(); ++i)
        (i % 2 == 0 ? found.open : found.closed).offer(worst[i]);
    return found;
}

}  // namespace stipple::discrepancy::star
