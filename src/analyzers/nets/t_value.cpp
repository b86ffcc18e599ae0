// SPDX-License-Identifier: MIT
//
// Quality parameter t of b^m points in d dimensions as a (t, m, d)-net in base b: the smallest t
// for which every elementary box of volume b^(t-m),
//
//     prod_k [ a_k / b^q_k, (a_k + 1) / b^q_k ),    q_1 + ... + q_d = m - t,    0 <= a_k < b^q_k,
//
// holds b^t points. Let R be the least number of digits q_1 + ... + q_d for which some boxes hold
// more points than others. It is at most m + 1, since b^m points do not fill b^(m+1) boxes. Then
//
//     t = m - R + 1.
//
// A projection to the coordinates u has its own R_u and t_u. R_u is the smaller one of two numbers:
// the minimum of R_v over all proper subsets v of u, and the least number of digits for which boxes
// cut along all of u hold unequal numbers of points. So projections are analyzed from the smallest
// on. The whole set then needs only boxes that are cut along more than --projections coordinates,
// with fewer digits than the least R of the projections.
//
// Shape   n = b^m points in [0, 1]^d; t in 0..m, smaller is more even; random points are near m.
// Cost    at most C(R+d-1, d-1) divisions, each of n steps or, for a digital net, of R^2 m. 2^14
//         points: d = 2 in 2 ms; Sobol' with d = 10 in 6 ms, by counting 0.4 s on one core.
//         Counting is slow for many points with a small t: 2^20 with d = 5 and t = 5 take 30 s.
// Promise exact, and the same for any number of threads.
// Beware  a coordinate counts as on the edge j / b^m if it is the double nearest to it, since k /
//         b^K may have been rounded to below its edge; 1 belongs to the last box.
// Source  H. Niederreiter, Monatsh. Math. 104 (1987) 273-337, doi:10.1007/BF01294651 (nets; t of
//         digital nets from ranks of matrices).

#include <algorithm>
#include <functional>
#include <mutex>

#include "analyzers/analyzer.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "math/combinatorics/combinations.hpp"
#include "math/digital/equidistribution.hpp"
#include "math/functions/powers.hpp"

namespace stipple::analyzers::t_value {
namespace {

using equidistribution::Matrices;
using equidistribution::Net;
using equidistribution::Probe;

constexpr Param<std::int64_t> base{.name = "base",
                                   .fallback = 2,
                                   .low = 2,
                                   .high = 1'000'000,
                                   .help = "Base b; the number of points must be a power of b"};

constexpr Param<std::int64_t> projections{
    .name = "projections",
    .fallback = 2,
    .low = 1,
    .high = 8,
    .unit = "coordinates",
    .help = "Also compute t of all projections to at most this many coordinates"};

/// Least number of digits for which boxes cut along all of these coordinates hold unequal numbers
/// of points; `most` if there is no smaller one. Equal numbers remain equal with fewer digits.
std::size_t least_unequal(Probe& probe, const Combination& along, std::size_t most) {
    std::size_t equal = along.size() - 1;
    while (equal + 1 < most) {
        const std::size_t middle = (equal + most) / 2;
        (equidistribution::all_equal(probe, along, 0, middle) ? equal : most) = middle;
    }
    return most;
}

/// R (see the top) of all projections to some number of coordinates, by combination_number().
using Unequal = std::vector<std::size_t>;

/// Projections of one size that have the same t as the whole set.
struct Worst {
    std::size_t unequal = 0;  ///< R (see the top) of each of them
    std::vector<Combination> along = {};
};

class Search {
  public:
    Search(const Net& net, const std::optional<Matrices>& matrices)
        : net_(net), matrices_(matrices) {}

    /// R (see the top) of the projections of each size up to `largest`; m + 1 for size 0.
    [[nodiscard]] std::vector<Unequal> projections(std::size_t largest,
                                                   const RunContext& run) const {
        double total = 0;
        for (std::size_t size = 1; size <= largest; ++size) total += choices(size);
        run.need_memory(total * sizeof(std::size_t), "the t of every projection");
        std::vector<Unequal> found{{net_.digits + 1}};
        double done = 0;
        for (std::size_t size = 1; size <= largest; ++size) {
            const double from = done;
            done += choices(size);
            found.push_back(next(found.back(), size, run.stage(from / total, done / total)));
        }
        return found;
    }

    /// Projections with the smallest R, of any size; `known` has R of all those up to some size.
    [[nodiscard]] Worst worst(const std::vector<Unequal>& known, const RunContext& run) const {
        const Worst small = worst_of(known);
        const auto levels = levels_above(known.size() - 1, small.unequal);
        double total = 0;
        for (const Level& level : levels) total += work(level);
        double done = 0;
        for (const Level& level : levels) {
            const double from = done;
            done += work(level);
            Worst found = unequal(level, run.stage(from / total, done / total));
            if (!found.along.empty()) return found;
        }
        return small;
    }

  private:
    /// Boxes cut along `size` coordinates with `digits` digits in total.
    struct Level {
        std::size_t size;
        std::size_t digits;
    };

    [[nodiscard]] std::vector<Level> levels_above(std::size_t largest, std::size_t limit) const {
        std::vector<Level> levels;
        for (std::size_t digits = largest + 1; digits < limit; ++digits)
            for (std::size_t size = largest + 1; size <= std::min(digits, net_.dimension); ++size)
                levels.push_back({size, digits});
        return levels;
    }

    [[nodiscard]] double choices(std::size_t size) const {
        return static_cast<double>(binomial(net_.dimension, size));
    }

    [[nodiscard]] double work(const Level& level) const {
        return choices(level.size) *
               static_cast<double>(binomial(level.digits - 1, level.size - 1));
    }

    [[nodiscard]] static Worst worst_of(const std::vector<Unequal>& known) {
        Worst worst;
        for (std::size_t size = 1; size < known.size(); ++size) {
            const std::size_t least = std::ranges::min(known[size]);
            if (size > 1 && least >= worst.unequal) continue;
            worst = {.unequal = least};
            for (std::size_t i = 0; i < known[size].size(); ++i)
                if (known[size][i] == least) worst.along.push_back(combination(i, size));
        }
        return worst;
    }

    [[nodiscard]] Unequal next(const Unequal& smaller, std::size_t size,
                               const RunContext& run) const {
        Unequal found(binomial(net_.dimension, size));
        for_each(size, 1, run, [&](const Combination& along, std::size_t, Probe& probe) {
            std::size_t most = net_.digits + 1;
            for (std::size_t k = 0; k < size; ++k) {
                Combination inside = along;
                inside.erase(inside.begin() + static_cast<std::ptrdiff_t>(k));
                most = std::min(most, smaller[combination_number(inside)]);
            }
            found[combination_number(along)] = least_unequal(probe, along, most);
        });
        return found;
    }

    [[nodiscard]] Worst unequal(const Level& level, const RunContext& run) const {
        Worst found{.unequal = level.digits};
        std::mutex finding;
        // The first coordinate gets 1 to `ways` of the digits; the others share the remaining ones.
        const std::size_t ways = level.digits - level.size + 1;
        for_each(level.size, ways, run,
                 [&](const Combination& along, std::size_t way, auto& probe) {
                     probe.cut(0, along[0], 1 + way);
                     if (equidistribution::all_equal(probe, along, 1, level.digits - 1 - way))
                         return;
                     const std::lock_guard lock(finding);
                     found.along.push_back(along);
                 });
        std::ranges::sort(found.along, {}, combination_number);
        found.along.erase(std::unique(found.along.begin(), found.along.end()), found.along.end());
        return found;
    }

    using Body = std::function<void(const Combination& along, std::size_t way, Probe& probe)>;

    /// Calls body for all choices of `size` coordinates, each with way < `ways`, on all threads.
    void for_each(std::size_t size, std::size_t ways, const RunContext& run,
                  const Body& body) const {
        const std::uint64_t count = binomial(net_.dimension, size) * ways;
        const double each = matrices_ ? 1e-5 : 5e-8 * static_cast<double>(net_.count);  // seconds
        const RunContext part = worth_threads(run, each * static_cast<double>(count));
        for_each_block(part, count, 1 + count / 256, [&](const Block& block) {
            const auto probe = equidistribution::probe_of(net_, matrices_, run);
            Combination along = combination(block.first / ways, size);
            for (std::uint64_t i = block.first; i < block.last; ++i) {
                run.check_stop();
                body(along, i % ways, *probe);
                if (i % ways == ways - 1) next_combination(along);
            }
        });
    }

    const Net& net_;
    const std::optional<Matrices>& matrices_;
};

/// Returns m with b^m = n. @throws Error(input) naming the nearest powers
std::size_t exact_logarithm(std::uint64_t n, std::uint64_t b) {
    std::size_t m = 0;
    while (saturating_power(b, m + 1) <= n) ++m;
    const std::uint64_t below = saturating_power(b, m);
    if (below != n)
        fail(ErrorKind::input,
             "t-value requires b^m points; {} is not a power of {} (--base); {} and {} are the "
             "nearest",
             n, b, below, saturating_power(b, m + 1));
    return m;
}

Net checked_net(const PointSet& points, std::int64_t b, const RunContext& run) {
    constexpr std::size_t most = std::size_t{1} << 30;
    if (points.count() > most)
        fail(ErrorKind::limit, "t-value accepts up to {} points; these are {}", most,
             points.count());
    const std::size_t m = exact_logarithm(points.count(), static_cast<std::uint64_t>(b));
    const auto n = static_cast<double>(points.count());
    const auto d = static_cast<double>(points.dimension());
    // Number of arrays of n indices that each thread needs for counting.
    const double cuts = std::min(d, static_cast<double>(m)) + 2;
    run.need_memory(4 * n * (d + cuts * run.thread_count()), "the t-value");
    return equidistribution::net_of(points, static_cast<std::uint32_t>(b), m, run);
}

Report projection_report(const std::vector<Unequal>& known, const Worst& worst, std::size_t m) {
    Report report;
    Report::Integers largest;
    for (std::size_t size = 1; size < known.size(); ++size) {
        Report::Integers t;
        for (const std::size_t unequal : known[size])
            t.push_back(static_cast<std::int64_t>(m + 1 - unequal));
        largest.push_back(std::ranges::max(t));
        report.add(fmt::format("t_{}d", size), std::move(t));
    }
    Report::Integers coordinates;
    for (const Combination& along : worst.along)
        for (const std::size_t k : along) coordinates.push_back(static_cast<std::int64_t>(k + 1));
    report.add("largest", std::move(largest));
    report.add("worst_size", std::uint64_t{worst.along.front().size()});
    report.add("worst", std::move(coordinates));
    return report;
}

Report analyze(const PointSet& points, const Values& options, const RunContext& run) {
    const Net net = checked_net(points, options[base], run.stage(0, 0.1));
    const auto matrices = equidistribution::matrices_of(net, run);
    const Search search(net, matrices);
    const auto largest = std::min(static_cast<std::size_t>(options[projections]), net.dimension);
    const auto known = search.projections(largest, run.stage(0.1, 0.5));
    const Worst worst = search.worst(known, run.stage(0.5, 1));
    run.tick(1, 1);
    Report results;
    results.add("t", std::uint64_t{net.digits + 1 - worst.unequal});
    results.add("m", std::uint64_t{net.digits});
    results.add("base", options[base]);
    results.add("method", matrices ? "rank" : "counting");
    results.add("projections", projection_report(known, worst, net.digits));
    return results;
}

}  // namespace

Analyzer unit() {
    return {
        .name = "t-value",
        .summary = "Quality parameter t of b^m points as a (t,m,d)-net, and of their projections",
        .source = "Niederreiter 1987, doi:10.1007/BF01294651",
        .related = {"t-parameter", "net-quality", "t-m-s"},
        .traits = {.max_dimension = 10'000},
        .options = Schema(base, projections),
        .results = {lower({"t", "smallest t for which the points are a (t,m,d)-net in base b"}),
                    {"m", "exponent m of the number of points, b^m"},
                    {"base", "the base b"},
                    {"method", "rank, if the points are a digital net; otherwise counting", true,
                     "rank|counting"},
                    {"projections.t_1d", "t of each coordinate"},
                    {"projections.t_2d",
                     "t of each pair of coordinates: (1,2), (1,3), (2,3), (1,4), (2,4), (3,4)..."},
                    {"projections.largest", "largest t of a projection to 1, 2, ... coordinates"},
                    {"projections.worst_size",
                     "smallest number of coordinates of a projection whose t equals that of all "
                     "coordinates"},
                    {"projections.worst", "coordinates, from 1, of all such projections"}},
        .curves = {{"projections.t_2d", "", "", "quality parameter t"}},
        .part = PagePart::gaps,
        .page = {{"t-value", {{"t", "t-value in base 2"}}}},
        .analyze = analyze};
}

}  // namespace stipple::analyzers::t_value
