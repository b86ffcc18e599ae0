// SPDX-License-Identifier: MIT
//
// Latin hypercube of n points: along every coordinate, each of the n strata [k/n, (k+1)/n) holds
// exactly one point, anywhere in it or in its middle.
//
//     strength 1   coordinate k of point i is in stratum pi_k(i), the pi_k being independent random
//                  permutations (math/combinatorics/permutation.hpp)
//     strength 2   for n = p^2, p prime, and d <= p + 1: a Latin hypercube in which also, for any
//                  two coordinates, each of the p x p squares holds exactly one point. It is made
//                  from an orthogonal array (orthogonal_points.hpp).
//     --sliced     n = m K points in K slices, one after the other, each a Latin hypercube of m
//                  strata. In coordinate k, point j of slice s is in the stratum  K c + phi_kc(s)
//                  of n,  c = pi_ks(j)  being its stratum of m; pi and phi are independent random
//                  permutations, of m strata and of K slices
//     --nested     the first N1 of n = N1 t points are a Latin hypercube. In coordinate k they are
//                  in the strata  t c + o_kc,  c = pi_k(i),  with random o in {0, ..., t - 1}; the
//                  other points are in the remaining strata, in random order
//     --extend     new points in the strata [l/n, (l+1)/n) that given ones leave empty. If no two
//                  given ones share a stratum, as in a Latin hypercube whose number of points
//                  divides n, the result is a Latin hypercube; else one stratum stays empty for
//                  each surplus point
//     --optimize   the permutations are the best that a search finds for a criterion
//                  (latin_hypercube_search); it keeps slices, nested and given points, and takes
//                  named parameters into account (latin_destination.hpp)
//
// Cost    O(n d); point i is found without the others, in constant memory. A search takes by
//         default about 20 s of one core, less for few points, and up to 64 n^2 bytes: 256 MB at
//         n = 2000.
// Promise each stratum holds one point in exact arithmetic, and also as computed by floor(x n)
//         (math/digital/stratum.hpp). A search's result is a function of the request and options,
//         for any number of threads, and never worse with more effort. The provenance has the value
//         for points in the middles of strata, and a certificate if all designs were tried.
// Source  M. D. McKay, R. J. Beckman, W. J. Conover, Technometrics 21 (1979) 239-245,
//         doi:10.1080/00401706.1979.10489755; B. Tang, J. Amer. Stat. Assoc. 88 (1993) 1392-1397,
//         doi:10.1080/01621459.1993.10476423; P. Z. G. Qian, J. Amer. Statist. Assoc. 107 (2012)
//         393-399, doi:10.1080/01621459.2011.644132 (sliced); P. Z. G. Qian, Biometrika 96 (2009)
//         957-970, doi:10.1093/biomet/asp045 (nested); C. J. Sallaberry, J. C. Helton, S. C. Hora,
//         Reliab. Eng. Syst. Saf. 93 (2008) 1047-1059, doi:10.1016/j.ress.2007.04.005 (extension).

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "generators/given_points.hpp"
#include "generators/stratified/latin_destination.hpp"
#include "generators/stratified/latin_hypercube_search/search.hpp"
#include "generators/stratified/orthogonal_points.hpp"
#include "io/files.hpp"
#include "math/combinatorics/permutation.hpp"
#include "math/combinatorics/splitmix64.hpp"
#include "math/digital/stratum.hpp"

namespace stipple::generators::latin_hypercube {
namespace {

namespace search = stipple::latin_hypercube_search;

constexpr Param<std::int64_t> strength{
    .name = "strength",
    .fallback = 1,
    .low = 1,
    .high = 2,
    .help =
        "1: one point in each of n strata along each axis; 2: also one in each of n squares for "
        "each pair of axes (n is the square of a prime)"};
constexpr Param<Choice> optimize{
    .name = "optimize",
    .choices = "maximin|phi-p|audze-eglais|centered-l2|maxpro|correlation",
    .help =
        "Search the strata of up to 10000 points by this criterion: maximize the minimum distance, "
        "or minimize the sum of d^-p or d^-2 over pairs, the centered L2 discrepancy, the MaxPro "
        "measure, or the largest correlation"};
constexpr Param<std::int64_t> power{
    .name = "p", .fallback = 15, .low = 1, .high = 50, .help = "Exponent p of --optimize phi-p"};
constexpr Param<double> effort{
    .name = "effort",
    .fallback = 1,
    .low = 1e-6,
    .high = 1e6,
    .help =
        "Trials of --optimize as a multiple of the default: some 20 seconds of one core, less for "
        "few points. Rounded down to a power of 2, so that more is never worse"};
constexpr Param<std::int64_t> sliced{
    .name = "sliced",
    .low = 1,
    .high = 1'000'000'000,
    .optional = true,
    .unit = "slices",
    .help = "Number of slices of equal size, one after the other, each a Latin hypercube itself"};
constexpr Param<Numbers> nested{
    {.name = "nested",
     .unit = "N1,N2",
     .help = "N2 points whose first N1 are a Latin hypercube themselves; N1 divides N2"}};
constexpr Param<Path> extend{
    {.name = "extend",
     .unit = "file",
     .help = "Start with the points of a file, unchanged, and add others in strata that they leave "
             "empty; each axis has as many strata as the result has points"}};
constexpr Param<std::int64_t> add{.name = "add",
                                  .low = 1,
                                  .high = 1'000'000'000,
                                  .optional = true,
                                  .unit = "points",
                                  .help = "Number of points that --extend adds"};
constexpr Param<Numbers> levels{
    {.name = "levels",
     .help = "Number m of levels of each axis, such as 0,3,8. --optimize then measures distances "
             "between the levels floor(x m); 0: between the coordinates themselves"}};

/// Strata of the plain hypercube: a permutation per coordinate. `index` must be consecutive.
StrataOf permuted_strata(const Plan& plan) {
    return [n = plan.count, keys = stratified_numbers(plan, 0)](
               std::size_t coordinate, std::span<const double> index, std::span<double> low) {
        Permutation(n, keys.bits(coordinate)).fill(static_cast<std::uint64_t>(index[0]), low);
        return n;
    };
}

/// Streams of random numbers for --sliced and --nested; stream 0 belongs to the plain hypercube.
constexpr std::uint64_t first_keys = 1;
constexpr std::uint64_t second_keys = 2;

/// Strata given by a function: stratum(coordinate, index) returns a number below `parts`.
StrataOf strata_by(std::uint64_t parts, auto stratum) {
    return [=](std::size_t coordinate, std::span<const double> index, std::span<double> low) {
        for (std::size_t j = 0; j < index.size(); ++j)
            low[j] = static_cast<double>(stratum(coordinate, static_cast<std::uint64_t>(index[j])));
        return parts;
    };
}

/// @param slices divides the plan's count
StrataOf sliced_strata(const Plan& plan, std::uint64_t slices) {
    const std::uint64_t n = plan.count;
    const std::uint64_t m = n / slices;
    const PermutationFamily in_slice(m, plan.dimension * slices,
                                     stratified_numbers(plan, first_keys));
    const PermutationFamily to_slices(slices, plan.dimension * m,
                                      stratified_numbers(plan, second_keys));
    return strata_by(n, [=](std::uint64_t k, std::uint64_t i) {
        const std::uint64_t s = i / m;
        const std::uint64_t coarse = in_slice(k * slices + s, i % m);
        return slices * coarse + to_slices(k * m + coarse, s);
    });
}

/// @param first divides the plan's count
StrataOf nested_strata(const Plan& plan, std::uint64_t first) {
    const std::uint64_t n = plan.count;
    const std::uint64_t t = n / first;
    const PermutationFamily of_first(first, plan.dimension, stratified_numbers(plan, first_keys));
    const PermutationFamily of_rest(std::max<std::uint64_t>(1, n - first), plan.dimension,
                                    stratified_numbers(plan, first_keys + 2));
    const Rng offsets = stratified_numbers(plan, second_keys);
    return strata_by(n, [=](std::uint64_t k, std::uint64_t i) {
        const auto offset = [&](std::uint64_t coarse) {
            return offsets.below(k * first + coarse, t);
        };
        if (i < first) {
            const std::uint64_t coarse = of_first(k, i);
            return t * coarse + offset(coarse);
        }
        const std::uint64_t rank = of_rest(k, i - first);
        const std::uint64_t coarse = rank / (t - 1);
        const std::uint64_t fine = rank % (t - 1);
        return t * coarse + fine + (fine >= offset(coarse));
    });
}

constexpr const char* strong = "latin-hypercube of strength 2";

/// @throws Error(usage) if options contradict each other
void check_options(const Values& options) {
    const auto only_with = [](std::string_view name, bool given, bool fits, std::string_view what) {
        if (given && !fits)
            fail(ErrorKind::usage, "--{} applies to {} only; give that too", name, what);
    };
    const bool searches = options.given(optimize);
    only_with("levels", options.given(levels), searches, "--optimize");
    only_with("p", options.given(power), options[optimize] == "phi-p", "--optimize phi-p");
    only_with("add", options.given(add), options.given(extend), "--extend");
    std::vector<std::string> forms;
    if (options[strength] == 2) forms.emplace_back("--strength 2");
    if (options.given(sliced)) forms.emplace_back("--sliced");
    if (options.given(nested)) forms.emplace_back("--nested");
    if (options.given(extend)) forms.emplace_back("--extend");
    if (forms.size() > 1)
        fail(ErrorKind::usage, "{} and {} contradict each other; give one of them", forms[0],
             forms[1]);
    if (options[strength] == 2 && searches)
        fail(ErrorKind::usage,
             "--strength 2 and --optimize contradict each other: exchanging strata would break the "
             "squares");
}

std::uint64_t whole_of(const Values& options, std::size_t i) {
    return static_cast<std::uint64_t>(options[nested][i]);
}

Plan plan_nested(const Request& request, const Values& options) {
    const std::vector<double> counts = options[nested];
    const std::string text = format_value(Value(counts));
    for (const double count : counts)
        if (!(count >= 1 && count <= 0x1p53 && count == std::floor(count)))
            fail(ErrorKind::usage, "--nested: {} is not a number of points", format_number(count));
    if (counts.size() != 2 || whole_of(options, 1) % whole_of(options, 0) != 0)
        fail(ErrorKind::usage,
             "--nested: {} is not N1,N2 where N1 divides N2; expected, for example, 10,30", text);
    if (request.count.value_or(whole_of(options, 1)) != whole_of(options, 1))
        fail(ErrorKind::usage, "--count: {} contradicts --nested {}, which has {} points",
             *request.count, text, whole_of(options, 1));
    return default_plan(request, whole_of(options, 1));
}

Plan plan_sliced(const Request& request, const Values& options) {
    const auto slices = static_cast<std::uint64_t>(options[sliced]);
    const Plan plan = default_plan(request, std::max<std::uint64_t>(1, 1024 / slices) * slices);
    if (plan.count % slices == 0) return plan;
    refuse_count(plan.count, fmt::format("a multiple of {}", slices),
                 fmt::format("--sliced {}", slices), plan.count / slices * slices,
                 (plan.count / slices + 1) * slices);
}

PointSet given_points(const Plan& plan, const Values& options, const RunContext& run) {
    if (plan.destination && plan.destination->given.count() > 0) return plan.destination->given;
    PointSet points = io::read_given(extend.name, options[extend], {}, run);
    require_in_cube(points, options[extend], "--extend takes designs in [0, 1)");
    return points;
}

/// @throws Error(usage) if no points would be added
void require_more(std::uint64_t count, const PointSet& given, const Values& options) {
    if (count <= given.count())
        fail(ErrorKind::usage, "--count: {} is not more than the {} points of {}", count,
             given.count(), options[extend]);
}

Plan plan_extended(const Request& request, const Values& options) {
    if (request.bounds)
        fail(ErrorKind::usage,
             "--bounds: --extend does not scale the given points; scale all points afterwards");
    if (!options.given(add) && !request.count)
        fail(ErrorKind::usage, "--extend: the number of new points is missing; give --add");
    if (!options.given(add) && request.dimension) return default_plan(request);  // no file to read
    const PointSet points = given_points({}, options, {});
    require_dimension(request, points.dimension(), options[extend]);
    const std::uint64_t count = options.given(add)
                                    ? points.count() + static_cast<std::uint64_t>(options[add])
                                    : *request.count;
    if (request.count.value_or(count) != count)
        fail(ErrorKind::usage,
             "--count: {} is not {}, the sum of the {} points of {} and those of --add",
             *request.count, count, points.count(), options[extend]);
    require_more(count, points, options);
    return default_plan(request, count, points.dimension());
}

Plan plan_by_form(const Request& request, const Values& options) {
    if (options[strength] == 2) return plan_by_polynomials(request, 2, strong);
    if (options.given(nested)) return plan_nested(request, options);
    if (options.given(sliced)) return plan_sliced(request, options);
    if (options.given(extend)) return plan_extended(request, options);
    return default_plan(request, options.given(optimize) ? 64 : 1024);
}

void check_search(const Plan& plan, const Values& options) {
    constexpr std::uint64_t most = 10'000;
    constexpr std::size_t most_axes = 100;
    if (plan.count > most)
        fail(ErrorKind::usage, "--count: {} is outside [1, {}], the range of --optimize",
             plan.count, most);
    if (plan.dimension > most_axes)
        fail(ErrorKind::usage, "--dimension: {} is outside [1, {}], the range of --optimize",
             plan.dimension, most_axes);
    const double reach = static_cast<double>(plan.count) * static_cast<double>(plan.count);
    if (reach * static_cast<double>(plan.dimension) >= 0x1p31)
        fail(ErrorKind::usage,
             "--count: {} points in {} dimensions are more than --optimize can search; at most {}",
             plan.count, plan.dimension,
             std::floor(std::sqrt(0x1p31 / static_cast<double>(plan.dimension))));
    if (!options.given(levels)) return;
    const std::vector<double> parts = options[levels];
    if (parts.size() != plan.dimension)
        fail(ErrorKind::usage, "--levels: {} numbers for {} coordinates; give one for each",
             parts.size(), plan.dimension);
    for (const double m : parts)
        if (!(m >= 0 && m <= static_cast<double>(most) && m == std::floor(m)))
            fail(ErrorKind::usage, "--levels: {} is not a whole number in [0, {}]",
                 format_number(m), most);
}

Plan plan(const Request& request, const Values& options) {
    check_options(options);
    const Plan plan = plan_by_form(request, options);
    if (options.given(optimize)) check_search(plan, options);
    return plan;
}

StrataOf strata_of(const Plan& plan, const Values& options) {
    if (options.given(sliced))
        return sliced_strata(plan, static_cast<std::uint64_t>(options[sliced]));
    if (options.given(nested)) return nested_strata(plan, whole_of(options, 0));
    return permuted_strata(plan);
}

/// Number of given points in each stratum.
std::vector<std::size_t> held(const PointSet& given, std::size_t coordinate, std::size_t count) {
    std::vector<std::size_t> points(count);
    for (std::size_t i = 0; i < given.count(); ++i)
        ++points[static_cast<std::size_t>(
            stratum_of(given[i][coordinate], static_cast<double>(count)))];
    return points;
}

/// Design of `count` points: first the given ones, then others at random in empty strata. Rows
/// after the points (spare rows) hold the strata that stay empty.
search::Design extended(const PointSet& given, std::size_t count, const Rng& rng) {
    const std::size_t d = given.dimension();
    std::vector<std::vector<search::Level>> empty(d);
    std::size_t rows = count;
    for (std::size_t k = 0; k < d; ++k) {
        const auto points = held(given, k, count);
        for (std::size_t l = 0; l < count; ++l)
            if (points[l] == 0) empty[k].push_back(static_cast<search::Level>(l));
        SplitMix64 draws(rng.bits(k));
        for (std::size_t l = empty[k].size(); l > 1; --l)
            std::swap(empty[k][l - 1], empty[k][draws.below(l)]);
        rows = std::max(rows, given.count() + empty[k].size());
    }
    search::Design design(count, rows, d);
    for (std::size_t k = 0; k < d; ++k) {
        const auto axis = design.along(k);
        for (std::size_t i = 0; i < given.count(); ++i)
            axis[i] =
                static_cast<search::Level>(stratum_of(given[i][k], static_cast<double>(count)));
        std::ranges::copy(empty[k], axis.subspan(given.count()).begin());
    }
    return design;
}

/// Number of strata along a coordinate with two or more points; x = 1 is in the last stratum.
std::size_t crowded_strata(const PointSet& given, std::size_t coordinate, std::size_t count) {
    return static_cast<std::size_t>(std::ranges::count_if(
        held(given, coordinate, count), [](std::size_t points) { return points > 1; }));
}

search::Design design_of(const Plan& plan, const StrataOf& strata) {
    search::Design design(plan.count, plan.count, plan.dimension);
    std::vector<double> index(plan.count);
    std::vector<double> low(plan.count);
    for (std::size_t i = 0; i < index.size(); ++i) index[i] = static_cast<double>(i);
    for (std::size_t k = 0; k < plan.dimension; ++k) {
        strata(k, index, low);
        for (std::size_t i = 0; i < low.size(); ++i)
            design.along(k)[i] = static_cast<search::Level>(low[i]);
    }
    return design;
}

search::Rules rules_of(const Plan& plan, const Values& options, std::size_t given) {
    search::Rules rules{.fixed = given};
    for (const double m : options[levels])
        rules.axes.push_back(search::even_parts(plan.count, static_cast<search::Level>(m)));
    if (options.given(sliced)) {
        const auto slices = static_cast<std::size_t>(options[sliced]);
        for (std::size_t s = 1; s <= slices; ++s) rules.groups.push_back(plan.count / slices * s);
        rules.coarse = static_cast<search::Level>(slices);
    }
    if (options.given(nested)) {
        const std::size_t first = whole_of(options, 0);
        rules.groups = {first, plan.count};
        rules.coarse = static_cast<search::Level>(plan.count / first);
    }
    return rules;
}

search::Objective objective_of(const Values& options) {
    using search::Kind;
    constexpr std::pair<const char*, Kind> kinds[] = {{"maximin", Kind::maximin},
                                                      {"phi-p", Kind::phi_p},
                                                      {"audze-eglais", Kind::audze_eglais},
                                                      {"centered-l2", Kind::centered_l2},
                                                      {"maxpro", Kind::maxpro},
                                                      {"correlation", Kind::correlation}};
    const std::string name = options[optimize];
    return {std::ranges::find(kinds, name, &std::pair<const char*, Kind>::first)->second,
            static_cast<int>(options[power])};
}

/// The points to extend, if any, followed by points in the strata of the design's other rows.
std::unique_ptr<Sequence> points_of(std::shared_ptr<const LatinPlaces> places,
                                    search::Design design, PointSet given) {
    return sequence_of([places = std::move(places), design = std::move(design),
                        given = std::move(given)](std::uint64_t first, std::span<double> rows) {
        const std::size_t d = design.dimension;
        for (std::size_t j = 0; j < rows.size(); ++j) {
            const std::uint64_t i = first + j / d;
            rows[j] =
                i < given.count() ? given[i][j % d] : places->at(j % d, i, design.along(j % d)[i]);
        }
    });
}

/// Points that --extend starts from; empty without it. @throws Error(usage), Error(input)
PointSet points_to_extend(const Plan& plan, const Values& options, const RunContext& run) {
    if (!options.given(extend)) return {};
    PointSet given = given_points(plan, options, run);
    require_dimension({.dimension = plan.dimension}, given.dimension(), options[extend]);
    require_more(plan.count, given, options);
    std::size_t most = 0;
    for (std::size_t k = 0; k < plan.dimension; ++k)
        most = std::max(most, crowded_strata(given, k, plan.count));
    if (most > 0)
        run.notify(fmt::format(
            "latin-hypercube: all {0} points together are not a Latin hypercube: points of {1} "
            "share up to {2} of the {0} strata along an axis; new points share none",
            plan.count, options[extend], most));
    return given;
}

/// Makes sets that are computed as a whole: by a search, or as an extension of given points.
std::unique_ptr<Sequence> make_design(const Plan& plan, const Values& options,
                                      const RunContext& run) {
    const PointSet given = points_to_extend(plan, options, run);
    run.need_memory(16 * static_cast<double>(plan.count) * static_cast<double>(plan.dimension),
                    "the design");
    const auto places = std::make_shared<LatinPlaces>(plan, options[centered_option]);
    search::Search task{.objective = {},
                        .rules = rules_of(plan, options, given.count()),
                        .start = options.given(extend)
                                     ? extended(given, plan.count, stratified_numbers(plan, 0))
                                     : design_of(plan, strata_of(plan, options)),
                        .seed = plan.seed};
    if (!options.given(optimize)) return points_of(places, std::move(task.start), given);
    const std::vector<double> parts = options[levels];
    for (std::size_t k = 0; k < parts.size(); ++k)  // where edges of levels cut strata
        if (parts[k] > 0 && plan.count % static_cast<std::uint64_t>(parts[k]) != 0)
            places->put_in_middles(k);
    for (std::size_t i = 0; i < given.count() && plan.destination; ++i)
        if (!plan.destination->has_image(i, given[i]))
            fail(ErrorKind::input, "--extend: point {} of {} violates the constraints", i,
                 options[extend]);
    if (plan.destination) aim_at_destination(plan, places, task, run);
    task.objective = objective_of(options);
    task.trials = options[effort] * search::usual_trials(task.objective, task.start);
    const search::Result result = search::best_design(task, options[optimize], run);
    // After a stop, a large design is not described, since that may take a second.
    constexpr double few = 2e7;
    const bool soon = static_cast<double>(plan.count * plan.count * plan.dimension) <= few;
    if (result.stopped)
        run.notify(fmt::format("interrupted: this is the best design so far{}",
                               soon ? "" : ", without its value"));
    std::vector<std::pair<std::string, std::string>> found;
    if (!result.stopped || soon)
        found = search::described(task.objective, result.design, task.rules,
                                  result.stopped ? unstopped(run) : run);
    if (result.stopped) found.emplace_back(interrupted);
    if (result.optimal) found.emplace_back("certificate", "optimal");
    auto points = points_of(places, result.design, given);
    points->set_found([found] { return found; });
    return points;
}

bool is_whole(const Values& options) { return options.given(optimize) || options.given(extend); }

std::unique_ptr<Sequence> make(const Plan& plan, const Values& options, const RunContext& run) {
    const bool centered = options[centered_option];
    if (is_whole(options)) return make_design(plan, options, run);
    if (options[strength] == 1)
        return stratified_sequence(plan, {.centered = centered, .shuffled = false},
                                   strata_of(plan, options));
    const ArrayShape shape{.levels = prime_root(plan.count, 2, strong),
                           .strength = 2,
                           .columns = Columns::polynomials};
    return orthogonal_points(plan, {.centered = centered, .shuffled = true}, shape,
                             Substrata::independent);
}

}  // namespace

Generator unit() {
    return {.name = "latin-hypercube",
            .summary = "Latin hypercube: one point in each of n strata along every axis",
            .source =
                "McKay, Beckman, Conover 1979, doi:10.1080/00401706.1979.10489755; strength "
                "2: Tang 1993, doi:10.1080/01621459.1993.10476423",
            .related = {"latin", "maximin", "lhd", "lhsdesign", "maxpro", "audze-eglais", "morris",
                        "experiment", "doe", "space-filling", "design-augmentation"},
            .traits = {.prefix = false},
            .options = Schema(centered_option, strength, optimize, power, effort, sliced, nested,
                              extend, add, levels),
            .aliases = {"lhs", "n-rooks", "nrooks"},
            .stream_version = 3,
            .plan = plan,
            .sequence = make,
            .whole = is_whole};
}

}  // namespace stipple::generators::latin_hypercube
