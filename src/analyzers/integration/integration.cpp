// SPDX-License-Identifier: MIT
//
// Integrals of known functions, estimated by the points of a set. With p the density of the points,
//
//     estimate = (1 / n) sum_i f(x_i) / p(x_i),        error = estimate - exact
//
// p is the domain's density (1 / measure if it is uniform), unless the points follow another one:
// that of a column pdf or weight = 1 / pdf, or of a deliberately biased warp in their provenance.
//
// --mean estimates the mean of f under the points' distribution instead, (1 / n) sum_i f(x_i).
//
// Integrands of the unit cube apply to any box, with any density: the function is stretched to the
// box and its integral multiplied by the volume.
//
// Standard error: for one set, sqrt(variance of f / p over n) is right only for independent points,
// and far too large for low-discrepancy ones. It is reported if the set is known to be from a
// generator of independent points. For R sets (--average) it is the spread of their estimates,
//
//     standard_error = sqrt(sum_r (estimate_r - mean)^2 / (R (R - 1))),
//
// and the interval mean +- t standard_error contains the exact value with probability 0.95
// (Student's t, R - 1 degrees of freedom), if the sets are independent and unbiased.
//
// --compare adds the estimate by uniform sampling to that by importance sampling with density p.
// Uniform points come from the same points of the cube: x_i is mapped back to the cube by the
// domain's coordinates, in which p is uniform, and from there uniformly to the box, hemisphere or
// sphere. Variances are those of single samples, f / p and measure x f, over the set. Their ratio
// is the factor by which more independent uniform points would be needed.
//
// If the density is 0 on a part of the domain, the estimate and `exact` are those of the integral
// over the density's support. Then `exact` of `measure` is the support's measure, if known; that of
// others is found by quadrature, within exact_error, if the support consists of known boxes in one
// or two dimensions.
//
// If the density is constant, on any domain, both estimates use the same points. If the domain has
// no coordinates in which p is uniform (mixtures, formulas, supports with gaps), or p is not the
// domain's density, the variance of uniform points is computed from the weights of the points,
//
//     n / (n - 1) (measure mean(f^2 / p) - mean(f / p)^2),
//
// which converges to the same number; the uniform estimate is then that by importance sampling.
//
// Shape   points n x d on any domain; --integrand and --compare need one of finite measure.
// Cost    O(n d) for each integrand; about 10 to 50 ns per point in 2-D on one core.
// Promise sums are compensated for rounding; results are the same for any number of threads.
// Beware  if p approaches 0 and f does not, f / p may have no finite variance (`measure` on the
//         cosine hemisphere): its standard error then does not bound the error.
// Source  A. B. Owen, "Monte Carlo theory, methods and examples" (2013), chapters 9 (importance
//         sampling) and 17 (error estimates by replication).

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "analyzers/analyzer.hpp"
#include "analyzers/integration/region_view.hpp"
#include "analyzers/integration/tally.hpp"
#include "analyzers/outside.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/spec.hpp"
#include "core/text.hpp"
#include "math/densities/expression.hpp"
#include "math/densities/quadrature.hpp"
#include "math/functions/distributions.hpp"
#include "math/functions/powers.hpp"
#include "math/integrands/integrands.hpp"

namespace stipple::analyzers::integration {
namespace {

constexpr Param<Text> integrand{
    {.name = "integrand",
     .help = "What to integrate: NAME[:OPT=V,...], several separated by commas; default: all that "
             "fit the points. On a box: genz-oscillatory, genz-product-peak, genz-corner-peak, "
             "genz-gaussian, genz-continuous, genz-discontinuous (:seed=S,difficulty=D), "
             "smooth-gaussian (:width=W), owen (:order=K), sobol-g (:a=[A,A,...]); in 2-D "
             "disk-indicator, half-plane-indicator, soft-shadow (:seed=S), zone-plate (:phase=K); "
             "on a hemisphere: sky-radiance; on any domain: measure, its length, area or volume"}};

constexpr Param<Text> expression{
    {.name = "expression",
     .help = "Formula to integrate, besides or instead of --integrand, in the points' coordinates "
             "x, y, z or x1, x2, ...: 'exp(-x*y)'; functions: stipple help formulas"}};

constexpr Param<double> exact{.name = "exact",
                              .optional = true,
                              .help =
                                  "Exact integral of the expression over the domain (over the part "
                                  "of positive density, if that is smaller), or with --mean its "
                                  "exact mean, if known"};

constexpr Param<bool> as_mean{
    .name = "mean",
    .help =
        "Estimate the mean of the expression over the points' distribution, such as an expected "
        "value, instead of its integral over the domain"};

constexpr Param<bool> compare{.name = "compare",
                              .help =
                                  "Also integrate by uniform points, made from the same points of "
                                  "the cube, and compare the variances; if these cannot be made, "
                                  "estimate the variance of uniform points from the weights"};

struct Task {
    std::string name;
    Region region;
    std::function<double(std::span<const double>)> value;
    std::optional<Estimate> exact;  ///< exact value over the density's support; empty: unknown
    bool mean = false;              ///< whether the mean of f is estimated, not its integral
};

const char* words(Region region) {
    if (region == Region::cube) return "a box";
    return region == Region::hemisphere ? "a hemisphere" : "a domain of finite measure";
}

/// @throws Error(input) if the integrand does not accept points of this domain
void require_fit(const IntegrandKind& kind, const Domain& domain, const RegionView& view) {
    const std::size_t d = domain.dimension();
    if (!view.has(kind.region))
        fail(ErrorKind::input, "--integrand: {} requires points of {}; the domain is {}", kind.name,
             words(kind.region), domain.title());
    if (d >= kind.min_dimension && d <= kind.max_dimension) return;
    const std::string range = kind.min_dimension == kind.max_dimension
                                  ? std::to_string(kind.min_dimension)
                                  : fmt::format("{} to {}", kind.min_dimension, kind.max_dimension);
    fail(ErrorKind::input, "--integrand: {} requires points of dimension {}; these have {}",
         kind.name, range, d);
}

bool fits(const IntegrandKind& kind, const Domain& domain, const RegionView& view) {
    return view.has(kind.region) && domain.dimension() >= kind.min_dimension &&
           domain.dimension() <= kind.max_dimension;
}

/// An integrand of --integrand, with its options.
struct Named {
    const IntegrandKind& kind;
    Values values;
};

/// Parses the spec of an integrand. @throws Error(usage) with the name of the integrand
Named named(const std::string& text) {
    std::string where = "--integrand";
    try {
        const Spec spec = parse_spec(text);
        if (!spec.coordinates.empty())
            fail(ErrorKind::usage, "'{}': coordinates after @ are for warps only", text);
        const IntegrandKind& kind = integrand_kind(spec.name);
        where += ": " + kind.name;
        return {kind, spec.values(kind.options)};
    } catch (const Error& e) {
        throw Error(e.kind(), fmt::format("{}: {}", where, e.what()), e.hint());
    }
}

/// Integral of the task's function over boxes of one or two dimensions, where the density is above 0
/// or anywhere.
Estimate integral_over(const std::vector<Box>& boxes, bool anywhere, const Effort& effort,
                       const Domain& domain, const RegionView& view, const Task& task) {
    std::vector<double> seen(domain.dimension());
    const auto f = [&](std::span<const double> point) {
        if (!anywhere && !(domain.density(point) > 0)) return 0.0;
        view.see(task.region, point, seen);
        return task.value(seen);
    };
    Estimate sum;
    for (const Box& box : boxes) sum += integrate_box(f, box, effort);
    return sum;
}

/// The parts of the box outside all of these boxes.
std::vector<Box> gaps_of(const Box& whole, const std::vector<Box>& boxes) {
    std::vector<Box> gaps{whole};
    for (const Box& box : boxes) {
        std::vector<Box> left;
        for (Box gap : gaps) {
            bool apart = false;
            for (std::size_t k = 0; k < gap.dimension(); ++k)
                apart = apart || box.high[k] <= gap.low[k] || box.low[k] >= gap.high[k];
            for (std::size_t k = 0; !apart && k < gap.dimension(); ++k) {  // cuts off what is left
                Box below = gap, above = gap;
                below.high[k] = gap.low[k] = std::max(gap.low[k], box.low[k]);
                above.low[k] = gap.high[k] = std::min(gap.high[k], box.high[k]);
                for (const Box& part : {below, above})
                    if (part.extent(k) > 0) left.push_back(part);
            }
            if (apart) left.push_back(gap);
        }
        gaps = std::move(left);
    }
    return gaps;
}

/// Integral over the support; nullopt if its boxes are unknown, above two dimensions, or if
/// quadrature over the whole box does not give its integral `known`: it does not see peaks that
/// are narrower than the distance of its nodes.
std::optional<Estimate> integral_over(const Support& support, double known, const Domain& domain,
                                      const RegionView& view, const Task& task) {
    const std::size_t d = domain.dimension();
    if (support.boxes.empty() || d > 2) return std::nullopt;
    const std::vector<Effort> efforts =
        d == 1 ? std::vector<Effort>{{1e-12, 1000}, {1e-12, 20'000, 4001}}
               : std::vector<Effort>{{1e-7, 40}};
    std::vector<Box> whole = gaps_of(domain.bounding_box(), support.boxes);
    whole.insert(whole.end(), support.boxes.begin(), support.boxes.end());
    for (const Effort& effort : efforts) {
        const Estimate all = integral_over(whole, true, effort, domain, view, task);
        if (std::abs(all.value - known) <= 10 * all.error + 1e-9 * std::abs(known))
            return integral_over(support.boxes, false, effort, domain, view, task);
    }
    return std::nullopt;
}

Task task_of(const IntegrandKind& kind, const Values& values, const Domain& domain,
             const RegionView& view, const Support& support) {
    const Integrand function = kind.make(domain.dimension(), values);
    Task task{kind.name, kind.region, function.value, std::nullopt};
    if (support.whole)
        task.exact = Estimate{function.exact * view.scale(kind.region), 0};
    else if (kind.region == Region::anywhere && support.measure)
        task.exact = Estimate{function.exact * support.measure->value,
                              std::abs(function.exact) * support.measure->error};
    else
        task.exact =
            integral_over(support, function.exact * view.scale(kind.region), domain, view, task);
    return task;
}

/// Makes names unique: a second genz-gaussian becomes genz-gaussian-2.
void tell_apart(std::vector<Task>& tasks) {
    for (std::size_t i = tasks.size(); i-- > 0;) {
        const auto same =
            std::count_if(tasks.begin(), tasks.begin() + static_cast<std::ptrdiff_t>(i),
                          [&](const Task& t) { return t.name == tasks[i].name; });
        if (same > 0) tasks[i].name += fmt::format("-{}", same + 1);
    }
}

/// All integrands that accept points of the domain. @throws Error(input) if there is none
std::vector<Task> tasks_that_fit(const Domain& domain, const RegionView& view,
                                 const Support& support) {
    std::vector<Task> tasks;
    for (const IntegrandKind& kind : integrand_kinds())
        if (fits(kind, domain, view))
            tasks.push_back(task_of(kind, kind.options.defaults(), domain, view, support));
    if (tasks.empty())
        fail_with_hint(
            ErrorKind::input, "--expression accepts any domain",
            "no integrand is defined on {}, which is neither a box nor of finite measure",
            domain.title());
    return tasks;
}

/// Integrands of --integrand. @throws Error(usage), Error(input)
std::vector<Task> tasks_named(const std::string& list, const Domain& domain, const RegionView& view,
                              const Support& support) {
    std::vector<Task> tasks;
    for (const std::string& text : split_specs(list, "--integrand")) {
        const auto [kind, values] = named(text);
        require_fit(kind, domain, view);
        tasks.push_back(task_of(kind, values, domain, view, support));
    }
    tell_apart(tasks);
    return tasks;
}

Task formula(const Domain& domain, const Values& options) {
    const Expression f("expression", options[expression], domain.dimension());
    Task task{"expression", Region::anywhere, [f](auto x) { return f.at(x); }, std::nullopt};
    if (options.given(exact)) task.exact = Estimate{options[exact], 0};
    task.mean = options[as_mean];
    return task;
}

/// All integrands requested by the options. @throws Error(usage), Error(input)
std::vector<Task> tasks_of(const Domain& domain, const RegionView& view, const Support& support,
                           const Values& options) {
    const bool typed = options.given(expression);
    if (options.given(exact) && !typed)
        fail(ErrorKind::usage, "--exact: requires --expression, which is not given");
    if (options[as_mean] && (!typed || options.given(integrand) || options[compare]))
        fail(ErrorKind::usage,
             "--mean: is for --expression, without --integrand and --compare, which integrate");
    std::vector<Task> tasks;
    if (options.given(integrand))
        tasks = tasks_named(options[integrand], domain, view, support);
    else if (!typed)
        tasks = tasks_that_fit(domain, view, support);
    if (typed) tasks.push_back(formula(domain, options));
    return tasks;
}

// ---------------------------------------------------------------- sums

/// Density that point i was sampled from.
double density_of(const PointSet& points, std::size_t i) {
    return points.densities.empty() ? points.domain->density(points[i]) : points.densities[i];
}

/// A value that is not finite, and the point where it occurred.
struct Fault {
    std::uint64_t point = std::numeric_limits<std::uint64_t>::max();
    std::size_t task = 0;
    double value = 0;
    double density = 0;
    bool uniform = false;  ///< whether the value is at the uniform point made from `point`

    void add(const Fault& other) {
        if (other.point < point) *this = other;
    }
};

/// Sums over one block, or over all blocks.
struct Sums {
    std::vector<Tally> weighted;  ///< f / p, for each integrand
    std::vector<Tally> uniform;   ///< measure * f at uniform points; if weighed, measure * f^2 / p
    Outside outside;
    Fault fault;

    void add(const Sums& other) {
        weighted.resize(other.weighted.size());
        uniform.resize(other.uniform.size());
        for (std::size_t k = 0; k < weighted.size(); ++k) weighted[k].add(other.weighted[k]);
        for (std::size_t k = 0; k < uniform.size(); ++k) uniform[k].add(other.uniform[k]);
        outside.add(other.outside);
        fault.add(other.fault);
    }
};

/// How to sample uniformly for --compare.
struct Uniform {
    enum How {
        none,
        remade,       ///< uniform points, made from the coordinates of the given points in the cube
        as_they_are,  ///< the given points; their density is constant
        weighed,      ///< none are made: their variance is computed from measure * f^2 / p
    };
    How how = none;
    double measure = 0;  ///< measure of the domain's support, known or estimated
    /// Estimate of `measure` from the points' weights, if it is not known.
    std::optional<Tally> found = {};
};

/// Sums the values of all integrands at points of the domain.
class Evaluation {
  public:
    Evaluation(const PointSet& points, const RegionView& view, const std::vector<Task>& tasks,
               const Uniform& beside)
        : points_(points), domain_(*points.domain), view_(view), tasks_(tasks), beside_(beside) {
        sums_.weighted.resize(tasks.size());
        if (beside.how != Uniform::none) sums_.uniform.resize(tasks.size());
    }

    void add(std::uint64_t i) {
        const auto point = points_[i];
        if (!domain_.contains(point)) {
            sums_.outside.add(i, point);
            return;
        }
        const double density = density_of(points_, i);
        each(point, [&](std::size_t k, double value) {
            const double weight = value == 0 || tasks_[k].mean ? value : value / density;
            if (!std::isfinite(weight)) {
                sums_.fault.add({i, k, value, density, false});
                return;
            }
            sums_.weighted[k].add(weight);
            if (beside_.how == Uniform::weighed)
                sums_.uniform[k].add(beside_.measure * value * weight);
        });
        if (beside_.how == Uniform::remade || beside_.how == Uniform::as_they_are)
            add_uniform(i, point);
    }

    [[nodiscard]] const Sums& sums() const { return sums_; }

  private:
    template <class Take>
    void each(std::span<const double> point, const Take& take) {
        seen_.resize(point.size());
        for (std::size_t k = 0; k < tasks_.size(); ++k) {
            const Task& task = tasks_[k];
            if (k == 0 || task.region != tasks_[k - 1].region) view_.see(task.region, point, seen_);
            take(k, task.value(seen_));
        }
    }

    void add_uniform(std::uint64_t i, std::span<const double> point) {
        cube_.resize(domain_.cube_dimension());
        even_.assign(point.begin(), point.end());
        if (beside_.how == Uniform::remade) {
            domain_.to_cube(point, cube_);
            view_.uniform(cube_, even_);
        }
        const double measure = beside_.measure;
        each(even_, [&](std::size_t k, double value) {
            if (std::isfinite(measure * value))
                sums_.uniform[k].add(measure * value);
            else
                sums_.fault.add({i, k, value, 1 / measure, true});
        });
    }

    const PointSet& points_;
    const Domain& domain_;
    const RegionView& view_;
    const std::vector<Task>& tasks_;
    Uniform beside_;
    Sums sums_;
    std::vector<double> seen_, cube_, even_;
};

[[noreturn]] void refuse(const Fault& fault, const std::vector<Task>& tasks, const Domain& domain) {
    const std::string& name = tasks[fault.task].name;
    if (fault.uniform)
        fail(ErrorKind::input,
             "--compare: at the uniform point made from point {}, {} is {}; expected a finite "
             "number",
             fault.point, name, fault.value);
    fail(ErrorKind::input, "at point {} the integrand {} is {} and the density of {} is {}",
         fault.point, name, fault.value, domain.title(), fault.density);
}

/// @throws Error(input) for points outside the domain and for values that are not finite
Sums sums_over(const PointSet& points, const RegionView& view, const std::vector<Task>& tasks,
               const Uniform& uniform, const RunContext& run) {
    const Domain& domain = *points.domain;
    const std::size_t size = std::max<std::size_t>(1, 4096 / points.dimension());
    std::vector<Sums> parts(block_count(points.count(), size));
    for_each_block(run, points.count(), size, [&](const Block& block) {
        Evaluation evaluation(points, view, tasks, uniform);
        for (std::uint64_t i = block.first; i < block.last; ++i) evaluation.add(i);
        parts[block.index] = evaluation.sums();
    });
    Sums all;
    for (const Sums& part : parts) all.add(part);
    if (all.outside.count > 0) refuse(all.outside, points.count(), domain, outside_hint(domain));
    if (all.fault.point < points.count()) refuse(all.fault, tasks, domain);
    return all;
}

// ---------------------------------------------------------------- results

double ratio_of(double uniform, double importance) {
    return uniform == importance ? 1 : uniform / importance;  // avoids 0 / 0 if f is constant
}

/// Variance of measure * f at uniform points, from the mean of measure * f^2 / p.
double variance_by_weights(const Tally& importance, const Tally& squares) {
    const double n = static_cast<double>(importance.count());
    const double square = importance.mean() * importance.mean();
    const double off = squares.mean() - square;
    return off > 1e-13 * square ? off * n / (n - 1) : 0;  // smaller differences are due to rounding
}

/// @throws Error(input) if the square of a mean or a deviation leaves float64
void require_square(double root, const std::string& name) {
    if (root != 0 && !(root * root > 1e-290 && std::isfinite(root * root)))
        fail_with_hint(ErrorKind::input, "multiply the integrand by a number, or use other units",
                       "--compare: float64 cannot hold the square of {}, a mean or a deviation of "
                       "{}",
                       format_number(root), name);
}

Report comparison(const std::vector<Task>& tasks, const Sums& sums, bool weighed) {
    Report all;
    for (std::size_t k = 0; k < tasks.size(); ++k) {
        const Tally& importance = sums.weighted[k];
        const Tally& uniform = sums.uniform[k];
        const double mean = weighed ? importance.mean() : uniform.mean();
        for (const double root : {importance.deviation(), weighed ? mean : uniform.deviation()})
            require_square(root, tasks[k].name);
        const double variance =
            weighed ? variance_by_weights(importance, uniform) : uniform.variance();
        Report one;
        one.add("importance_estimate", importance.mean());
        one.add("importance_variance", importance.variance());
        one.add("uniform_estimate", mean).add("uniform_variance", variance);
        one.add("variance_ratio", ratio_of(variance, importance.variance()));
        all.add(tasks[k].name, std::move(one));
    }
    return all;
}

/// Measure of the region covered by the points, estimated as the integral of 1.
Tally measure_of(const PointSet& points) {
    Tally inverse;
    for (std::size_t i = 0; i < points.count(); ++i) inverse.add(1 / density_of(points, i));
    return inverse;
}

/// Whether the densities given with the points are those of their domain.
bool follows_domain(const PointSet& points) {
    for (std::size_t i = 0; i < points.densities.size(); ++i)
        if (std::abs(points.domain->density(points[i]) / points.densities[i] - 1) > 1e-12)
            return false;
    return true;
}

/// Chooses how --compare makes its uniform estimate. @throws Error(input) if that is impossible
Uniform uniform_for(const PointSet& points, const RegionView& view, const Support& support) {
    if (points.count() < 2) fail(ErrorKind::input, "--compare: needs at least 2 points, not 1");
    const Domain& domain = *points.domain;
    if (!support.finite)
        fail(ErrorKind::input,
             "--compare: there are no uniform points on {}, because its measure is infinite",
             domain.title());
    if (!support.measure) {
        const Tally found = measure_of(points);
        return {Uniform::weighed, found.mean(), found};
    }
    if (support.whole && view.has_uniform() && follows_domain(points))
        return {Uniform::remade, domain.measure()};
    const double measure = support.measure->value;
    for (std::size_t i = 0; i < points.count(); ++i)
        if (std::abs(density_of(points, i) * measure - 1) > 1e-12)
            return {Uniform::weighed, measure};
    return {Uniform::as_they_are, measure};
}

/// Reports the support, to which the estimates apply, unless it is the whole domain.
void tell_support(const Support& support, Report& report) {
    if (support.whole) return;
    Report part;
    part.add("whole", false);
    if (support.measure)
        part.add("measure", support.measure->value).add("measure_error", support.measure->error);
    part.add("meaning",
             "the density is 0 on a part of the domain: estimates, and exact values if given, are "
             "integrals over the rest");
    report.add("support", std::move(part));
}

/// Reports that the measure used for uniform points is an estimate.
void tell_measure(const Tally& found, const PointSet& points, Report& report) {
    Report part;
    if (const auto* item = report.find("support")) part = std::get<Report>(*item);
    part.add("measure", found.mean());
    if (points.provenance.independent) part.add("measure_error", found.standard_error());
    part.add("measure_is_estimate", true);
    report.add("support", std::move(part));
}

Report analyze(const PointSet& points, const Values& options, const RunContext& run) {
    const Domain& domain = *points.domain;
    if (domain.dimension() != points.dimension())
        fail(ErrorKind::input, "points of the domain {} have dimension {}; these have {}",
             domain.title(), domain.dimension(), points.dimension());
    if (!options[as_mean] && domain.measure() < std::numeric_limits<double>::min())
        fail(ErrorKind::input, "the measure of {} is too small for float64; use other units",
             domain.title());
    const Support support = domain.support();
    const RegionView view(domain, support);
    const std::vector<Task> tasks = tasks_of(domain, view, support, options);
    const bool comparing = options[compare];
    const Uniform uniform = comparing ? uniform_for(points, view, support) : Uniform();
    const Sums sums = sums_over(points, view, tasks, uniform, run);
    Report report;
    if (!options[as_mean]) tell_support(support, report);
    if (options.given(expression) && !options[as_mean] && !support.finite)
        run.notify("the estimate is of the integral over all of " + domain.title() +
                   "; for the mean of the expression, such as an expected value, add --mean");
    const std::string& columns = points.provenance.density_column;
    const std::string column = columns.substr(0, columns.find(','));
    if (!points.densities.empty() && !options[as_mean])
        report.add("density", column.empty() ? "warps" : column);
    for (std::size_t k = 0; k < tasks.size(); ++k) {
        const Tally& values = sums.weighted[k];
        if (!std::isfinite(values.mean()))
            fail(ErrorKind::input, "the sum of {} over the points is too large for float64",
                 tasks[k].name);
        Report one;
        one.add("estimate", values.mean());
        if (const auto known = tasks[k].exact) {
            one.add("exact", known->value).add("error", values.mean() - known->value);
            if (known->error > 0) one.add("exact_error", known->error);
        }
        if (points.provenance.independent && points.count() > 1)
            one.add("standard_error", values.standard_error());
        report.add(tasks[k].name, std::move(one));
    }
    if (comparing) report.add("compare", comparison(tasks, sums, uniform.how == Uniform::weighed));
    if (uniform.found) tell_measure(*uniform.found, points, report);
    return report;
}

/// Squares are taken in units of a power of two, so that none overflows, and not all underflow.
double root_mean_square(const std::vector<double>& numbers) {
    const double unit = unit_for(numbers);
    Tally squares;
    for (const double x : numbers) squares.add(x / unit * (x / unit));
    return std::sqrt(squares.mean()) * unit;
}

/// Adds the standard error, confidence interval and root mean square error over several sets.
void replicate(Report& mean, const std::string& name, std::span<const Report> sets) {
    Tally estimates;
    std::vector<double> errors;
    for (const Report& set : sets) {
        estimates.add(set.number(name + ".estimate"));
        if (set.find(name + ".error")) errors.push_back(set.number(name + ".error"));
    }
    const double spread = estimates.standard_error();
    const double reach = spread * student_quantile(0.025, estimates.count() - 1);
    const double middle = estimates.mean();
    mean.add("standard_error", spread);
    mean.add("interval_low", middle - reach).add("interval_high", middle + reach);
    if (!errors.empty()) mean.add("rms_error", root_mean_square(errors));
}

/// Adds the root mean square error for a single set: the absolute value of its error.
void combine_one(Report& mean) {
    for (auto& entry : mean.entries()) {
        auto* group = std::get_if<Report>(&entry.value);
        if (group != nullptr && group->find("error"))
            group->add("rms_error", std::abs(group->number("error")));
    }
}

void combine(Report& mean, std::span<const Report> sets, const Values&) {
    if (sets.size() < 2) return combine_one(mean);
    for (auto& [name, value, unit] : mean.entries()) {
        auto* group = std::get_if<Report>(&value);
        if (group == nullptr || name == "support") continue;
        if (name != "compare") {
            replicate(*group, name, sets);
            continue;
        }
        for (auto& inner : group->entries()) {
            auto& one = std::get<Report>(inner.value);
            one.add("variance_ratio",
                    ratio_of(one.number("uniform_variance"), one.number("importance_variance")));
        }
    }
}

std::vector<ResultKey> results() {
    return {
        {"INTEGRAND.estimate",
         "mean of f / p, where p is the density of the points: from a column pdf or weight (1 / "
         "pdf), or of a biased warp in the provenance; otherwise that of the domain. With --mean, "
         "the mean of f"},
        {"INTEGRAND.exact", "exact integral; for an expression, the value of --exact"},
        lower({"INTEGRAND.error", "estimate - exact"}),
        {"INTEGRAND.exact_error", "bound on the error of exact, if computed by quadrature", false},
        {"density",
         "origin of the density, if it is not the domain's: pdf or weight: that column; warps: the "
         "warps in the provenance",
         false, "pdf|weight|warps"},
        {"support.whole",
         "false if the density is 0 on a part of the domain: all results then apply to the rest",
         false, true_or_false},
        {"support.measure", "measure of that rest, if known", false},
        {"support.measure_error",
         "error bound of the measure; one standard error if it is an estimate", false},
        {"support.measure_is_estimate",
         "true: --compare estimated the measure from the points' weights, because it is not known",
         false, true_or_false},
        {"support.meaning", "explanation in words", false},
        {"INTEGRAND.standard_error",
         "standard error of the estimate: for several sets (--average) from the spread between "
         "them; for one set only if its provenance names a generator of independent points",
         false},
        {"INTEGRAND.interval_low",
         "lower end of the 95 % confidence interval from several sets (--average), by Student's t",
         false},
        {"INTEGRAND.interval_high", "upper end of that interval", false},
        {"INTEGRAND.rms_error", "root mean square error of several sets (--average)", false},
        {"compare.INTEGRAND.importance_estimate", "--compare: estimate by importance sampling",
         false},
        {"compare.INTEGRAND.importance_variance", "variance of f / p over the points", false},
        {"compare.INTEGRAND.uniform_estimate", "estimate by uniform points", false},
        {"compare.INTEGRAND.uniform_variance",
         "variance of f times the measure of the domain, over uniform points", false},
        {"compare.INTEGRAND.variance_ratio",
         "uniform_variance / importance_variance: above 1, importance sampling pays", false}};
}

}  // namespace

Analyzer unit() {
    return {.name = "integration",
            .summary = "Integrals of functions with known integrals, and their errors",
            .source = "Genz 1984; Owen 2003",
            .related = {"convergence", "rmse", "mse", "genz"},
            .traits = {.max_dimension = 10'000, .unit_cube = false, .densities = true},
            .options = Schema(integrand, expression, exact, as_mean, compare),
            .results = results(),
            .part = PagePart::integration,
            .page = {{"Integration",
                      {{"genz-gaussian.error", "Error of a smooth integrand"},
                       {"genz-continuous.error", "Error of an integrand with a kink"},
                       {"genz-discontinuous.error", "Error of an integrand with a jump"}},
                      {{"integrand", "genz-gaussian,genz-continuous,genz-discontinuous"}}}},
            .analyze = analyze,
            .combine = combine};
}

}  // namespace stipple::analyzers::integration
