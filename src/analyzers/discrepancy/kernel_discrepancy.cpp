// SPDX-License-Identifier: MIT
//
// Kernel discrepancy, or maximum mean discrepancy: the largest error of the points' mean among all
// functions of norm 1 in the Hilbert space of a kernel K. With independent y and y' from the
// target,
//
//     squared = E K(y, y')  -  2/n sum_i E K(x_i, y)  +  n^-2 sum_i sum_k K(x_i, x_k),
//     value   = sqrt(squared)                                       (the V-statistic, biased).
//
//     periodic   prod 1 + 2 pi^2 (1/6 - t + t^2), t = |x - y|: squared is the squared diaphony
//     gaussian   exp(-|x - y|^2 / (2 h^2))
//     matern     prod p(a) exp(-a), a = sqrt(2 nu) t / h: a product over the axes, which does not
//                depend on |x - y| alone; p = 1, 1 + a, 1 + a + a^2 / 3 for nu = 1/2, 3/2, 5/2
//     stein      the kernel Stein discrepancy, of the Langevin Stein kernel over the base kernel
//                (1 + |x - y|^2 / h^2)^(-1/2) (math/kernels/stein.cpp); E K(x, y) = 0
//
// The target is one of
//
//     default     the distribution of the points' own domain. For the unit cube expectations have a
//                 closed form. Other domains must have independent coordinates; expectations are
//                 integrals over their distribution functions (math/kernels/domain_kernel.cpp). For
//                 the periodic kernel they must be boxes, which are mapped to the cube
//     --target    the points of a file
//     stein       the density whose scores grad log p follow the coordinates in each row
//
// Shape   points n x d in [0, 1], in any domain, or with --target and stein anywhere; for stein n x
//         2d: first d coordinates, then d scores.
// Units   h is a length. The default is sqrt(d / 6), the root mean square distance of two uniform
//         points of the cube. With --target it is the median distance of all points, over all pairs
//         or, if there are more than 2^22 pairs, over that many random ones. For stein it is 1.
// Cost    n^2 / 2 values of K, with m points of a target (n + m)^2 / 2; each takes 0.5 to 2 ns in
//         few dimensions on one core. The periodic kernel in one or two dimensions: O(n log n) for
//         n > 4096 (math/l2). Domains other than a cube: some 100 us more per point. O(n) memory.
// Promise the same for any number of threads. Values of K are added as integers; `value` is off by
//         at most `error`. It is 0 if the points are those of --target, in any order.
// Beware  values for different kernels, or different h, cannot be compared.
// Source  A. Gretton, K. M. Borgwardt, M. J. Rasch, B. Schoelkopf, A. Smola, J. Mach. Learn. Res.
//         13 (2012) 723-773; J. Gorham, L. Mackey, ICML 2017, arXiv:1703.01717 (stein).

#include <algorithm>
#include <cmath>
#include <optional>

#include "analyzers/analyzer.hpp"
#include "analyzers/outside.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "io/files.hpp"
#include "math/kernels/kernel.hpp"
#include "math/l2/squares.hpp"

namespace stipple::analyzers::kernel_discrepancy {
namespace {

constexpr Param<Choice> kernel{
    .name = "kernel",
    .fallback = "periodic",
    .choices = "periodic|gaussian|matern|stein",
    .help =
        "periodic: that of the diaphony; gaussian, and matern (a product over the axes), with "
        "length scale --bandwidth; stein: each row holds d coordinates, then the d scores grad log "
        "p of the target"};

constexpr Param<Path> target{
    {.name = "target",
     .unit = "file",
     .help = "File of points to compare with; default: the distribution of the points' own domain, "
             "if its coordinates are independent"}};

constexpr Param<double> bandwidth{
    .name = "bandwidth",
    .low = 1e-100,
    .high = 1e100,
    .optional = true,
    .unit = "length",
    .help =
        "Length scale h of gaussian, matern and stein; default: sqrt(d/6), the root mean square "
        "distance of two uniform points of the unit cube; with --target the median distance of all "
        "points; for stein 1"};

constexpr Param<Choice> smoothness{.name = "smoothness",
                                   .fallback = "2.5",
                                   .choices = "0.5|1.5|2.5",
                                   .help = "Smoothness parameter nu of the kernel matern"};

/// Limit beyond practical run times; integer sums over all pairs of so many points fit 128 bits.
constexpr std::size_t max_count = std::size_t{1} << 26;

/// Points to analyze, and the bandwidth of the kernel.
struct Setting {
    kernels::Columns points;
    std::size_t dimension;
    std::optional<double> h = {};
    const char* rule = "";    ///< how h was chosen
    std::uint64_t pairs = 0;  ///< number of pairs whose median distance is h
    const char* method = "all-pairs";
};

void check_options(const Values& options) {
    const std::string name = options[kernel];
    if (options.given(bandwidth) && name == "periodic")
        fail(ErrorKind::usage,
             "--bandwidth: the kernel periodic has no length scale; expected gaussian, matern or "
             "stein");
    if (options.given(smoothness) && name != "matern")
        fail(ErrorKind::usage, "--smoothness applies to --kernel matern only; this is {}", name);
    if (options.given(target) && name == "stein")
        fail(ErrorKind::usage,
             "--target: the kernel stein gets its target from the scores in each row; omit "
             "--target, or choose another kernel");
}

/// @throws Error(input) if points are outside their domain
void require_inside(const PointSet& points) {
    const Domain& domain = *points.domain;
    Outside outside;
    for (std::size_t i = 0; i < points.count(); ++i)
        if (!domain.contains(points[i])) outside.add(i, points[i]);
    if (outside.count > 0)
        refuse(outside, points.count(), domain,
               outside_hint(domain) + "; --target accepts points anywhere");
}

bool is_unit_cube(const Domain& domain) { return domain.spec() == unit_cube(1)->spec(); }

/// @throws Error(input) if coordinates of the domain depend on each other
void require_independent_axes(const PointSet& points) {
    const Domain& domain = *points.domain;
    if (!kernels::has_independent_axes(domain, points.flat()))
        fail_with_hint(ErrorKind::input, "--target accepts points to compare with",
                       "kernel-discrepancy cannot compute the mean of its kernels over {}; "
                       "expected a domain whose coordinates are independent and continuous",
                       domain.title());
}

/// Maps points of a box to the unit cube. @throws Error(input) for points of other domains
PointSet on_cube(const PointSet& points) {
    const Domain& domain = *points.domain;
    PointSet cube = points;
    if (is_unit_cube(domain)) return cube;
    const std::size_t d = points.dimension();
    const Box box = domain.bounding_box();
    bool straight = domain.even() && domain.cube_dimension() == d &&
                    std::abs(volume_of(box) - domain.measure()) <= 1e-12 * domain.measure();
    for (std::size_t i = 0; straight && i < points.count(); ++i) {
        domain.to_cube(points[i], cube[i]);
        for (std::size_t k = 0; k < d; ++k) {
            const double place = (points[i][k] - box.low[k]) / box.extent(k);
            straight = straight && std::abs(cube[i][k] - place) <= 1e-9;
            cube[i][k] = std::clamp(cube[i][k], 0.0, 1.0);
        }
    }
    if (!straight)
        fail_with_hint(ErrorKind::input,
                       "--kernel gaussian and matern accept domains of independent coordinates; "
                       "warp --inverse maps points back to the cube",
                       "kernel-discrepancy with the kernel periodic requires points of the unit "
                       "cube or a box; the domain is {}",
                       domain.title());
    return cube;
}

/// Sets h to --bandwidth if given, otherwise to `fallback`; `rule` names the rule of the fallback.
void set_bandwidth(Setting& setting, const Values& options, double fallback, const char* rule) {
    const bool given = options.given(bandwidth);
    setting.h = given ? options[bandwidth] : fallback;
    setting.rule = given ? "given" : rule;
}

unsigned order_of(const Values& options) {
    const std::string nu = options[smoothness];
    return nu == "0.5" ? 0 : nu == "1.5" ? 1 : 2;
}

kernels::KernelPtr kernel_of(const Setting& setting, const Values& options) {
    const std::string name = options[kernel];
    if (name == "periodic") return kernels::periodic(setting.dimension);
    if (name == "gaussian") return kernels::gaussian(setting.dimension, *setting.h);
    if (name == "stein") return kernels::stein(setting.dimension, *setting.h);
    return kernels::matern(setting.dimension, *setting.h, order_of(options));
}

/// Largest error of sqrt(squared), if `squared` is off by at most `error`.
double error_of_root(double squared, double error) {
    if (squared > error) return std::sqrt(squared) - std::sqrt(squared - error);
    return std::sqrt(squared + error);
}

Report report_of(const Setting& setting, const kernels::SquaredDiscrepancy& found,
                 const char* compared, const Values& options) {
    const double squared = std::max(found.squared, 0.0);
    Report report;
    report.add("value", std::sqrt(squared));
    report.add("squared", squared);
    report.add("expected_squared", found.expected);
    report.add("error", error_of_root(squared, found.error));
    report.add("kernel", options[kernel]);
    if (setting.h) {
        report.add("bandwidth", *setting.h);
        report.add("bandwidth_rule", setting.rule);
    }
    if (setting.pairs > 0) report.add("bandwidth_pairs", setting.pairs);
    report.add("target", compared);
    report.add("method", setting.method);
    return report;
}

/// Squared discrepancy by exact sums: for the periodic kernel, d <= 2 and many points; or nullopt.
std::optional<kernels::SquaredDiscrepancy> by_exact_sums(const PointSet& cube,
                                                         const Values& options,
                                                         const RunContext& run) {
    constexpr std::size_t few = 4096;
    const std::size_t d = cube.dimension();
    if (options[kernel] != "periodic" || d > 2 || cube.count() <= few) return std::nullopt;
    run.need_memory(static_cast<double>(cube.count()) * 48, "the sums of kernel-discrepancy");
    const double squared = l2::plane_square(l2::plane_sums(cube, run), d, l2::Kind::diaphony, {});
    const double one_point = kernels::periodic(d)->mean_diagonal() - 1;
    return kernels::SquaredDiscrepancy{squared, 0x1p-50 * squared,
                                       one_point / static_cast<double>(cube.count())};
}

/// Kernel, with its expectations for the distribution of the points' domain.
kernels::KernelPtr kernel_over_domain(const PointSet& points, const Setting& setting,
                                      const Values& options, const RunContext& run) {
    if (options[kernel] == "periodic" || is_unit_cube(*points.domain))
        return kernel_of(setting, options);
    require_independent_axes(points);
    const auto order =
        options[kernel] == "matern" ? std::optional(order_of(options)) : std::nullopt;
    return kernels::of_domain(points.domain, *setting.h, order, run);
}

Report against_domain(const PointSet& points, const Values& options, const RunContext& run) {
    require_inside(points);
    const bool periodic = options[kernel] == "periodic";
    const PointSet on = periodic ? on_cube(points) : points;
    const std::size_t d = on.dimension();
    Setting setting{.points = {on.flat(), d}, .dimension = d};
    if (!periodic) set_bandwidth(setting, options, kernels::uniform_distance(d), "uniform");
    const char* compared = is_unit_cube(*points.domain) ? "uniform" : "domain";
    if (const auto found = by_exact_sums(on, options, run)) {
        setting.method = "exact-sums";
        return report_of(setting, *found, compared, options);
    }
    const auto known = kernel_over_domain(points, setting, options, run);
    return report_of(setting, kernels::squared_from_mean(*known, setting.points, run), compared,
                     options);
}

/// @throws Error(input) for points outside the unit cube, where the periodic kernel is defined
void require_cube(const PointSet& points, const std::string& what) {
    for (std::size_t i = 0; i < points.count(); ++i)
        for (const double x : points[i])
            if (!(x >= 0 && x <= 1))
                fail_with_hint(ErrorKind::input,
                               "--kernel gaussian and matern accept points anywhere",
                               "{}: point {} is outside the unit cube, to which the kernel "
                               "periodic is limited; it has a coordinate {}",
                               what, i, format_number(x));
}

Report against_file(const PointSet& points, const Values& options, const RunContext& run) {
    const std::string file = options[target];
    const std::size_t d = points.dimension();
    const PointSet others = io::read_given(target.name, file, {}, run);
    if (others.dimension() != d)
        fail(ErrorKind::input, "{}: points of dimension {}; the points to compare have {}", file,
             others.dimension(), d);
    if (others.count() > max_count)
        fail(ErrorKind::limit, "kernel-discrepancy accepts up to {} points; {} has {}", max_count,
             file, others.count());
    require_finite(points);
    if (options[kernel] == "periodic") {
        require_cube(points, "the points");
        require_cube(others, file);
    }
    Setting setting{.points = {points.flat(), d}, .dimension = d};
    const kernels::Columns columns(others.flat(), d);
    if (options[kernel] != "periodic" && !options.given(bandwidth)) {
        const auto median = kernels::median_distance(setting.points, columns, d, run);
        setting.h = median.value;
        setting.pairs = median.pairs;
        setting.rule = median.of_all ? "median" : "median-of-sample";
        if (!(*setting.h >= bandwidth.low && *setting.h <= bandwidth.high))
            fail_with_hint(ErrorKind::input, "--bandwidth sets the length scale",
                           "the median distance of the points and those of {} is {}, which cannot "
                           "be a length scale",
                           file, format_number(*setting.h));
    } else if (options[kernel] != "periodic") {
        set_bandwidth(setting, options, 0, "");
    }
    const auto found =
        kernels::squared_from_points(*kernel_of(setting, options), setting.points, columns, run);
    return report_of(setting, found, "file", options);
}

Report against_scores(const PointSet& points, const Values& options, const RunContext& run) {
    const std::size_t width = points.dimension();
    if (width % 2 != 0)
        fail(ErrorKind::input,
             "--kernel stein requires rows of d coordinates and d scores (grad log p); these have "
             "{} number{}",
             width, width == 1 ? "" : "s");
    require_finite(points);
    Setting setting{.points = {points.flat(), width}, .dimension = width / 2};
    set_bandwidth(setting, options, 1, "unit");
    kernels::require_stein(setting.points, setting.dimension, *setting.h);
    const auto found =
        kernels::squared_from_mean(*kernel_of(setting, options), setting.points, run);
    return report_of(setting, found, "scores", options);
}

Report analyze(const PointSet& points, const Values& options, const RunContext& run) {
    check_options(options);
    if (points.count() > max_count)
        fail(ErrorKind::limit, "kernel-discrepancy accepts up to {} points; these are {}",
             max_count, points.count());
    const auto numbers = static_cast<double>(points.count() * points.dimension());
    run.need_memory(16 * numbers, "the columns of kernel-discrepancy");
    if (options[kernel] == "stein") return against_scores(points, options, run);
    return options.given(target) ? against_file(points, options, run)
                                 : against_domain(points, options, run);
}

}  // namespace

Analyzer unit() {
    return {
        .name = "kernel-discrepancy",
        .summary =
            "Maximum mean discrepancy of a kernel: from uniform, from given points, or from scores "
            "(Stein)",
        .source = "Gretton et al. 2012, J. Mach. Learn. Res. 13, 723-773",
        .related = {"mmd", "maximum-mean-discrepancy", "ksd", "stein", "discrepancy", "diaphony",
                    "two-sample"},
        .traits = {.max_dimension = 10'000, .unit_cube = false},
        .options = Schema(kernel, target, bandwidth, smoothness),
        .results =
            {{"value", "the discrepancy; 0 if the points match the target"},
             {"squared",
              "its square, the V-statistic: all pairs count, including each point with itself"},
             {"expected_squared",
              "mean of `squared` for as many independent points of the target (stein: if these are "
              "such points)"},
             {"error", "bound on the rounding error of the value"},
             {"kernel", "periodic, gaussian, matern or stein", true,
              "periodic|gaussian|matern|stein"},
             {"bandwidth", "the length scale h; absent for the kernel periodic", false},
             {"bandwidth_rule",
              "given: by --bandwidth; uniform: sqrt(d/6); median: median distance of all pairs of "
              "points; median-of-sample: of randomly drawn pairs; unit: 1",
              false, "given|uniform|median|median-of-sample|unit"},
             {"bandwidth_pairs", "number of pairs of points whose median distance was taken",
              false},
             {"target",
              "distribution compared with: uniform: on the unit cube; domain: of the points' own "
              "domain; file: the points of --target; scores: the density with these scores",
              true, "uniform|domain|file|scores"},
             {"method",
              "all-pairs, or exact-sums for the periodic kernel and many points in one and two "
              "dimensions",
              true, "all-pairs|exact-sums"}},
        .analyze = analyze,
        .cost = [](double n, double d) { return 0.5e-9 * n * n * d; }};
}

}  // namespace stipple::analyzers::kernel_discrepancy
