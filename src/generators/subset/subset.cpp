// SPDX-License-Identifier: MIT
//
// Chooses the best n of N points by a discrepancy:
//
//     star        the star discrepancy, by exchanges that break its worst box (star_choice.cpp)
//     l2-star, l2-centered, l2-wraparound, l2-mixture, l2-average
//                 L2 discrepancies, as in l2-discrepancy
//     periodic, gaussian, matern
//                 maximum mean discrepancies from the uniform distribution, as in
//                 kernel-discrepancy; periodic is the diaphony
//     stein       the kernel Stein discrepancy: rows are d coordinates, then d scores grad log p
//
// All except star choose points greedily by a kernel, then exchange some (kernel_choice.cpp).
//
// --split K: partitions all N points into K similarly even sets of N / K points, one set after the
// other (partition.cpp). For star, the partition by l2-star is then improved by exchanges.
//
// The points are those of a file (--from) or of another generator (--of, --candidates of them).
//
// Shape   that of the given points; in [0, 1], for stein anywhere. Rows are those given, to the
//         last bit, in their original order; for stein with their scores.
// Cost    kernels: N n kernel values for the greedy choice, and --effort times up to 2^31 for
//         exchanges: 512 of 2^18 points of the plane in 2.5 s on one core. star: --effort times
//         10 to 40 s, less for few points.
// Promise depends only on the points, the options and the seed, not on the number of threads. The
//         provenance has the value, star_discrepancy or squared: its bounds if a search is too long
//         or the rounding error above 1 in 1000; for several sets the largest and the smallest.
// Source  F. Clement, C. Doerr, L. Paquete, J. Complexity 83 (2024) 101852, arXiv:2306.15276;
//         Y. Chen, M. Welling, A. Smola, UAI 2010, arXiv:1203.3472 (kernel herding).

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "generators/generator.hpp"
#include "generators/given_points.hpp"
#include "generators/subset/choice.hpp"
#include "io/files.hpp"
#include "io/point_stream.hpp"
#include "stipple/generate.hpp"

namespace stipple::generators::subset {
namespace {

constexpr Param<Path> from{
    {.name = "from",
     .unit = "file",
     .help = "File of points to choose from; default count: a sixteenth of them"}};

constexpr Param<Text> of{{.name = "of",
                          .unit = "generator",
                          .help = "Generator of the points to choose from if --from is not given, "
                                  "such as 'sobol:scramble=owen'; default: random"}};

constexpr Param<std::int64_t> candidates{
    .name = "candidates",
    .low = 1,
    .high = 1'000'000'000'000,
    .optional = true,
    .unit = "points",
    .help = "Number of points of --of to choose from; default: 16 per point of the result"};

constexpr Param<Choice> by{
    .name = "by",
    .fallback = "periodic",
    .choices =
        "star|l2-star|l2-centered|l2-wraparound|l2-mixture|l2-average|periodic|gaussian|"
        "matern|stein",
    .help =
        "Discrepancy to minimize. For stein, rows of --from hold d coordinates, then d scores (the "
        "gradient of log p), and are written whole"};

constexpr Param<double> bandwidth{
    .name = "bandwidth",
    .low = 1e-100,
    .high = 1e100,
    .optional = true,
    .unit = "length",
    .help = "Length scale of gaussian, matern and stein; default: sqrt(d/6), or 1 for stein"};

constexpr Param<Choice> smoothness{
    .name = "smoothness", .choices = "0.5|1.5|2.5", .help = "Parameter nu of matern; default: 2.5"};

constexpr Param<std::int64_t> split{
    .name = "split",
    .fallback = 1,
    .low = 1,
    .high = 1'000'000,
    .unit = "sets",
    .help =
        "Number of sets. Above 1, all points are split into sets of equal size, about equally "
        "even, one after the other; --count is then the number of all points"};

constexpr Param<double> effort{.name = "effort",
                               .fallback = 1,
                               .low = 1e-6,
                               .high = 1e6,
                               .help = "Search steps as a multiple of the default: some seconds"};

bool is_stein(const Values& options) { return options[by] == "stein"; }

void check_options(const Values& options) {
    const std::string name = options[by];
    const bool has_length = name == "gaussian" || name == "matern" || name == "stein";
    if (options.given(bandwidth) && !has_length)
        fail(ErrorKind::usage,
             "--bandwidth: {} has no length scale; gaussian, matern and stein have one", name);
    if (options.given(smoothness) && name != "matern")
        fail(ErrorKind::usage, "--smoothness applies to --by matern only; --by is {}", name);
    if (is_stein(options) && !options.given(from))
        fail(ErrorKind::usage, "--by stein needs rows with scores; give their file by --from");
    if (options.given(from) && options.given(of))
        fail(ErrorKind::usage, "--from contradicts --of; give one of them");
    if (options.given(from) && options.given(candidates))
        fail(ErrorKind::usage,
             "--candidates applies to --of only; --from chooses from all points of the file");
}

/// @throws Error(usage) if `all` points cannot be split into sets of equal size
void check_split(std::uint64_t all, std::uint64_t sets, const std::string& whose) {
    if (all % sets != 0)
        fail(ErrorKind::usage,
             "--split: the {} points{} cannot be split into {} sets of equal size", all, whose,
             sets);
}

/// Number of points to choose among those of --from, all of them if they are split.
std::uint64_t count_of_file(std::uint64_t asked, std::uint64_t all, const Values& options) {
    const auto sets = static_cast<std::uint64_t>(options[split]);
    if (sets == 1)
        return chosen_count(asked, std::max<std::uint64_t>(1, all / 16), all, options[from]);
    const std::uint64_t count = asked > 0 ? asked : all;
    check_split(all, sets, " of " + options[from]);
    if (count != all)
        fail(ErrorKind::usage,
             "--count: {}, but --split writes all {} points of {}; leave --count out", count, all,
             options[from]);
    return count;
}

/// Plan for a file. Only its first rows are read, so without a requested count the count is 0.
Plan plan_for_file(const Request& request, const Values& options) {
    const std::size_t d = io::width_of_given(from.name, options[from]);
    if (request.dimension.value_or(d) != d)
        fail(ErrorKind::usage, "--dimension: {}, but {} has rows of {} numbers", *request.dimension,
             options[from], d);
    if (is_stein(options) && d % 2 != 0)
        fail(ErrorKind::input,
             "{}: rows of {} number{}; --by stein takes d coordinates and d scores", options[from],
             d, d == 1 ? "" : "s");
    Plan plan = default_plan(request, 1, d);
    if (!request.count) plan.count = 0;
    return plan;
}

/// Number of points to generate by --of.
std::uint64_t candidates_for(std::uint64_t count, const Values& options) {
    if (options.given(candidates)) return static_cast<std::uint64_t>(options[candidates]);
    return options[split] > 1 ? count : 16 * count;
}

Plan plan(const Request& request, const Values& options) {
    check_options(options);
    if (request.bounds)
        fail(ErrorKind::usage,
             "--bounds: subset chooses among points of the unit cube; scale them before or after");
    if (options.given(from)) return plan_for_file(request, options);
    const auto sets = static_cast<std::uint64_t>(options[split]);
    Request complete = request;
    if (sets > 1 && !request.count && options.given(candidates))
        complete.count = candidates_for(0, options);
    const Plan plan = default_plan(complete, sets > 1 ? 64 * sets : 64);
    if (plan.count > std::uint64_t{1} << 48) return plan;  // fails later, for lack of memory
    const std::uint64_t all = candidates_for(plan.count, options);
    if (sets > 1 && plan.count != all)
        fail(ErrorKind::usage,
             "--count: {}, but --split writes all {} candidates; leave one of them out", plan.count,
             all);
    if (sets > 1) check_split(all, sets, "");
    if (plan.count > all)
        fail(ErrorKind::usage, "--count: {} points cannot be chosen from {} candidates", plan.count,
             all);
    return plan;
}

PointSet points_for(const Plan& plan, const Values& options, const RunContext& run) {
    const auto needed = [&](double count) {
        const auto d = static_cast<double>(plan.dimension);
        run.need_memory(count * 24 * d + choice_memory(count) +
                            (options[by] == "star" ? star_memory(count) : 0),
                        fmt::format("choosing from {:.4g} points", count));
    };
    if (options.given(from)) {
        PointSet points = io::read_given(from.name, options[from], {}, run);
        needed(static_cast<double>(points.count()));
        if (!is_stein(options))
            require_in_cube(points, options[from], "--by stein takes points outside the cube");
        return points;
    }
    const std::uint64_t all = candidates_for(plan.count, options);
    needed(static_cast<double>(all));
    return stipple::generate(options.given(of) ? options[of] : "random",
                             {.count = all, .dimension = plan.dimension, .seed = plan.seed}, {},
                             silent(run));
}

kernels::KernelPtr kernel_of(const Values& options, const kernels::Columns& points) {
    const std::string name = options[by];
    const std::size_t d = is_stein(options) ? points.width() / 2 : points.width();
    const double usual = is_stein(options) ? 1 : kernels::uniform_distance(d);
    const double h = options.given(bandwidth) ? options[bandwidth] : usual;
    if (name == "periodic") return kernels::periodic(d);
    if (name == "gaussian") return kernels::gaussian(d, h);
    if (name == "stein") {
        kernels::require_stein(points, d, h);
        return kernels::stein(d, h);
    }
    if (name == "matern") {
        const std::string nu = options[smoothness];
        return kernels::matern(d, h, nu == "0.5" ? 0 : nu == "1.5" ? 1 : 2);
    }
    constexpr std::string_view prefix = "l2-";
    const auto kinds = l2::parse_kinds(name == "star" ? name : name.substr(prefix.size()));
    return kernels::of_l2(d, kinds.front());
}

/// Points to choose from, and the parameters of the choice.
struct Task {
    const PointSet& points;
    kernels::Columns columns;
    kernels::KernelPtr kernel;
    std::size_t sets;
    std::size_t n;  ///< points per set
    bool star;
    std::uint64_t seed;
    double effort;

    /// Budget of kernel evaluations.
    [[nodiscard]] double values() const {
        const double few = 0x1p13 * static_cast<double>(points.count()) * static_cast<double>(n);
        const double times = star ? std::min(effort, 1.0) : effort;
        return std::ceil(times * std::min(few, 0x1p31 / (1 + 0.5 * width())));
    }
    /// Number of star discrepancies to compute, of sets of n points.
    [[nodiscard]] std::uint64_t measures() const {
        const double seconds =
            2e-4 + 5e-8 * std::pow(static_cast<double>(n), width() < 8 ? 1 + width() / 4 : 3);
        const double few = 40 * static_cast<double>(points.count()) * static_cast<double>(n);
        return static_cast<std::uint64_t>(
            std::max(1.0, effort * std::min(few, std::clamp(20 / seconds, 200.0, 20'000.0))));
    }
    [[nodiscard]] double width() const { return static_cast<double>(columns.width()); }
};

std::vector<Rows> choose(const Task& task, const RunContext& run) {
    // Fraction of the kernel evaluations that is spent if star measurements follow.
    constexpr double start = 0.05;
    const double share = task.star ? start : 1;
    const RunContext first = run.stage(0, share);
    const RunContext second = run.stage(share, 1);
    const double values = share * task.values();
    if (task.sets > 1) {
        auto sets = part_by_kernel(*task.kernel, task.columns, task.sets, values, task.seed, first);
        if (task.star) even_out_by_star(task.points, sets, task.measures(), task.seed, second);
        return sets;
    }
    Rows rows = choose_by_kernel(*task.kernel, task.columns, task.n, values, task.seed, first);
    if (task.star)
        rows = choose_by_star(task.points, std::move(rows), task.measures(), task.seed, second);
    return {rows};
}

using Found = std::vector<std::pair<std::string, std::string>>;

/// Discrepancies of the sets, for the provenance.
Found found_of(const Task& task, const std::vector<Rows>& sets, const RunContext& run) {
    std::vector<StarBounds> values;
    for (const Rows& rows : sets) {
        if (task.star) {
            values.push_back(star_discrepancy(task.points, rows, silent(run)));
            continue;
        }
        const auto [squared, error, expected] = kernels::squared_from_mean(
            *task.kernel, columns_of(task.columns, rows, run), silent(run));
        const double off = error > 1e-3 * squared ? error : 0;
        values.push_back({std::max(squared - off, 0.0), squared + off});
    }
    const std::string name = task.star ? "star_discrepancy" : "squared";
    const double lower = std::ranges::max(values, {}, &StarBounds::lower).lower;
    const double upper = std::ranges::max(values, {}, &StarBounds::upper).upper;
    Found found;
    if (lower == upper) {
        found.emplace_back(name, format_number(lower));
    } else {
        found.emplace_back(name + "_lower", format_number(lower));
        found.emplace_back(name + "_upper", format_number(upper));
    }
    if (sets.size() > 1)
        found.emplace_back("smallest",
                           format_number(std::ranges::min(values, {}, &StarBounds::lower).lower));
    return found;
}

PointSet make(const Plan& plan, const Values& options, const RunContext& outside) {
    const RunContext run = outside.rising();
    run.tick(0, 1);
    const PointSet points = points_for(plan, options, run);
    const auto sets = static_cast<std::size_t>(options[split]);
    const std::uint64_t count =
        options.given(from) ? count_of_file(plan.count, points.count(), options) : plan.count;
    kernels::Columns columns(points.flat(), points.dimension());
    kernels::KernelPtr kernel = kernel_of(options, columns);
    const Task task{.points = points,
                    .columns = std::move(columns),
                    .kernel = std::move(kernel),
                    .sets = sets,
                    .n = static_cast<std::size_t>(count) / sets,
                    .star = options[by] == "star",
                    .seed = plan.seed,
                    .effort = options[effort]};
    const std::vector<Rows> chosen = choose(task, run.stage(0, 0.99));
    PointSet result(count, points.dimension());
    std::size_t at = 0;
    for (const Rows& rows : chosen)
        for (const std::size_t i : rows) std::ranges::copy(points[i], result[at++].begin());
    result.provenance.found = found_of(task, chosen, run);
    run.tick(1, 1);
    return result;
}

double seconds(double n, double d) { return 2 + 16e-9 * n * n * d; }

}  // namespace

Generator unit() {
    return {.name = "subset",
            .summary = "Points chosen from a file or another generator to minimize a discrepancy",
            .source =
                "Clement, Doerr, Paquete 2024, arXiv:2306.15276; Chen, Welling, Smola 2010, "
                "arXiv:1203.3472",
            .related = {"subset-selection", "thinning", "kernel-herding", "kernel-thinning",
                        "stein-thinning", "support-points", "low-discrepancy-set", "halving",
                        "compression", "coreset"},
            .traits = {.sequence = false, .prefix = false},
            .options = Schema(from, of, candidates, by, bandwidth, smoothness, split, effort),
            .plan = plan,
            .set = make,
            .cost = seconds};
}

}  // namespace stipple::generators::subset
