// SPDX-License-Identifier: MIT
#include "pipeline/generated.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/rng.hpp"
#include "core/text.hpp"
#include "io/files.hpp"
#include "math/distributions/families.hpp"
#include "pipeline/units.hpp"

namespace stipple {
namespace {

// Options of experimental designs. Their levels come from named parameters; earlier runs come from
// a file, in the units of the parameters.

constexpr const char* extend_option = "extend";
constexpr const char* add_option = "add";
constexpr const char* levels_of_factors = "levels";

bool given(const Values& options, const char* option) {
    const auto* item = options.try_find(option);
    return item != nullptr && item->given;
}

/// Whether the options extend a design whose runs are in a file, in the units of the parameters.
bool goes_on_from_runs(const Values& options, const WarpChain& chain) {
    return given(options, extend_option) && !chain.empty() && !chain.names().empty();
}

/// Spreads points with the same discrete outcome evenly over its interval in the unit cube; the
/// inverse of a warp puts all of them in the middle.
void spread(PointSet& cube, const std::vector<OutcomeAxis>& axes) {
    for (std::size_t k = 0; k < axes.size(); ++k) {
        const auto ends = outcome_ends(axes[k], 100'000);
        std::map<double, std::vector<std::size_t>> together;
        for (std::size_t i = 0; i < cube.count() && !ends.empty(); ++i)
            together[cube[i][k]].push_back(i);
        for (const auto& [x, points] : together) {
            const auto end = std::ranges::upper_bound(ends, x);
            if (points.size() == 1 || end == ends.begin() || end == ends.end()) continue;
            const double low = *(end - 1);
            const auto count = static_cast<double>(points.size());
            for (std::size_t j = 0; j < points.size(); ++j)
                cube[points[j]][k] = low + (*end - low) * (static_cast<double>(j) + 0.5) / count;
        }
    }
}

std::string file_of_runs(const Values& options) {
    return std::get<std::string>(options.find(extend_option).value);
}

PointSet read_runs(const Values& options, const WarpChain& chain, const RunContext& run) {
    const std::string path = file_of_runs(options);
    PointSet runs = io::read_given(extend_option, path,
                                   {.expected = chain.names(), .levels = levels_of(chain)}, run);
    if (runs.dimension() != chain.dimension_out())
        fail(ErrorKind::input, "{}: {} columns; the parameters are {}", path, runs.dimension(),
             chain.dimension_out());
    return runs;
}

void count_with_runs(const WarpChain& chain, Request& request, Values& options,
                     const RunContext& run) {
    if (!goes_on_from_runs(options, chain)) return;
    if (chain.traits().needs_whole_set)
        fail(
            ErrorKind::usage,
            "--extend: the parameters of a whole set are reordered; earlier points would not stay");
    request.dimension = chain.dimension_in();
    if (!given(options, add_option)) return;
    const auto more =
        static_cast<std::uint64_t>(std::get<std::int64_t>(options.find(add_option).value));
    const std::uint64_t before = read_runs(options, chain, run).count();
    if (request.count.value_or(before + more) != before + more)
        fail(ErrorKind::usage, "--count: {} is not {}, the {} points of {} and those of --add",
             *request.count, before + more, before, file_of_runs(options));
    request.count = before + more;
    options.put(add_option, std::int64_t{0}, false);
}

void take_levels(const WarpChain& chain, Values& options) {
    std::vector<double> levels;
    for (const OutcomeAxis& axis : chain.outcome_axes()) {
        const auto ends = level_ends(axis);
        levels.push_back(ends.empty() ? 2 : static_cast<double>(ends.size() - 1));
    }
    if (std::ranges::any_of(levels, [](double m) { return m != 2; }))
        options.put(levels_of_factors, std::move(levels));
}

/// Preimages, in the unit cube, of the runs to extend. Runs with the same discrete outcome get
/// different preimages, spread evenly over the interval of the outcome.
/// @throws Error(input) for missing columns, and for points outside the parameters' domain
PointSet preimages_of_runs(const Values& options, const WarpChain& chain, const RunContext& run) {
    const RunContext quiet = silent(run);
    const PointSet runs = read_runs(options, chain, quiet);
    try {
        PointSet cube(chain.mapped(runs.flat(), true, 0, quiet), chain.dimension_in());
        spread(cube, chain.outcome_axes());
        if (chain.mapped(cube.flat(), false, 0, quiet).size() != runs.flat().size())
            fail(ErrorKind::input, "a point breaks the constraints");
        return cube;
    } catch (const Error& e) {
        throw Error(ErrorKind::input, fmt::format("{}: {}", file_of_runs(options), e.what()),
                    e.hint());
    }
}

/// Completes a request from the parameters: sets the number of points, earlier runs included, and
/// the levels of a factorial design if the options give none.
void take_parameters(const Generator& generator, std::span<const Spec> warps, Request& request,
                     Values& options, const RunContext& run) {
    const auto* levels = options.try_find(levels_of_factors);
    const bool extends = given(options, extend_option);
    const bool takes_levels = generator.traits.levels && levels != nullptr &&
                              std::holds_alternative<std::vector<double>>(levels->value) &&
                              !levels->given && !request.count;
    if (!extends && !takes_levels) return;
    const std::size_t d =
        request.dimension ? *request.dimension : plan_for(generator, request, options).dimension;
    const WarpChain chain(warps, d, {}, run);
    if (extends)
        count_with_runs(chain, request, options, run);
    else
        take_levels(chain, options);
}

/// Warns of categories, and of levels of a design, that none of the points has.
void warn_of_absent_levels(std::span<const double> rows, const Generator& generator,
                           const WarpChain& chain, const RunContext& run) {
    const auto axes = chain.outcome_axes();
    const auto names = chain.names();
    const Levels words = levels_of(chain);
    if (names.size() != axes.size()) return;
    for (std::size_t k = 0; k < axes.size(); ++k) {
        if (!axes[k].categories && !generator.traits.levels) continue;
        const auto ends = level_ends(axes[k]);
        std::set<double> outcomes;
        for (std::size_t l = 0; l + 1 < ends.size(); ++l) outcomes.insert(axes[k].outcome(ends[l]));
        std::set<double> absent = outcomes;
        bool known = true;  // false if the column has numbers that are no outcomes
        for (std::size_t at = k; at < rows.size() && known; at += axes.size()) {
            known = outcomes.contains(rows[at]);
            absent.erase(rows[at]);
        }
        if (!known || absent.empty()) continue;
        const auto own = std::ranges::find(words, names[k], &Levels::value_type::first);
        std::vector<std::string> told;
        for (const double x : absent)
            told.push_back(own == words.end() ? format_number(x)
                                              : own->second[static_cast<std::size_t>(x)]);
        run.notify(fmt::format("{}: {} {} in none of the {} points", names[k], join(told, ", "),
                               told.size() == 1 ? "is" : "are", rows.size() / axes.size()));
    }
}

/// Advances a sequence without random access to point `start`, checking between steps whether to
/// stop. Does nothing for a sequence with random access.
void walk_to(Sequence& sequence, std::uint64_t start, std::size_t dimension,
             const RunContext& run) {
    if (sequence.random_access()) return;
    const std::uint64_t step = 1 + 1'000'000 / dimension;
    std::vector<double> row(dimension);
    for (std::uint64_t i = step; i < start; i += step) {
        run.check_stop();
        sequence.fill(i, row);
    }
}

/// Fills `rows` with the points of a sequence from `first` on, warped by the chain and scaled;
/// block by block, on all threads if the sequence has random access.
void fill_rows(const Sequence& sequence, std::uint64_t first, const WarpChain& chain,
               const std::optional<Scaling>& scaling, std::span<double> rows, RunContext run) {
    const std::size_t in = chain.dimension_in();
    const std::size_t out = chain.dimension_out();
    if (!sequence.random_access()) run.threads = 1;
    const std::size_t block = std::max<std::size_t>(1, 8192 / in);
    for_each_block(run, rows.size() / out, block, [&](const Block& b) {
        const auto place = rows.subspan(b.first * out, (b.last - b.first) * out);
        if (chain.empty()) {
            sequence.fill(first + b.first, place);
        } else {
            std::vector<double> raw((b.last - b.first) * in);
            sequence.fill(first + b.first, raw);
            std::ranges::copy(chain.forward(std::move(raw), first + b.first), place.begin());
        }
        if (scaling) scaling->apply(place, out);
    });
    chain.tell_infinite(run);
}

void need_memory_of(const Plan& plan, const RunContext& run) {
    run.need_memory(8 * static_cast<double>(plan.count) * static_cast<double>(plan.dimension),
                    "the point set");
}

/// Generates plan.count points of a sequence in memory, from index `start` on.
PointSet points_of(Sequence& sequence, const Plan& plan, std::uint64_t start,
                   const RunContext& run) {
    const std::size_t d = plan.dimension;
    need_memory_of(plan, run);
    PointSet points(Rows::unwritten(plan.count, d), d);
    const RunContext rest = run.best_is_wanted() ? unstopped(run) : run;
    walk_to(sequence, start, d, rest);
    fill_rows(sequence, start, WarpChain({}, d), {}, points.flat(), rest);
    return points;
}

}  // namespace

void Scaling::apply(std::span<double> rows, std::size_t width) const {
    if (columns.size() == width) return scale_into(box, rows);
    std::vector<double> part = gather(rows, width, columns);
    scale_into(box, part);
    const std::size_t some = columns.size();
    for (std::size_t i = 0; i < rows.size() / width; ++i)
        for (std::size_t k = 0; k < some; ++k) rows[i * width + columns[k]] = part[i * some + k];
}

namespace {

/// Dimension of the generator's points, and the indices of the coordinates that no warp uses.
std::pair<std::size_t, std::vector<std::size_t>> left_by_warps(const SetsToMake& asked) {
    Request request = asked.request;
    request.bounds.reset();
    const std::size_t d = plan_for(*asked.generator, request, asked.options).dimension;
    std::vector<std::size_t> left;
    for (const auto& [from, at] : WarpChain(asked.warps, d).kept()) left.push_back(from);
    return {d, std::move(left)};
}

/// Checks bounds. @throws Error(usage) unless low < high, and points on every side can differ
void require_box(const Box& box) {
    const std::size_t d = box.dimension();
    bool good = d > 0 && box.high.size() == d;
    for (std::size_t k = 0; good && k < d; ++k)
        good = box.low[k] < box.high[k] && std::isfinite(box.extent(k));
    if (!good) fail(ErrorKind::usage, "--bounds: expected finite low < high for each coordinate");
    for (std::size_t k = 0; k < d; ++k) require_wide("--", "bounds", box.low[k], box.high[k]);
}

/// Completes a job: adds the settings that follow from named parameters, and expands the bounds to
/// a range for each coordinate of the generator's points, [0, 1) for those that warps take.
/// @throws Error(usage)
SetsToMake completed(SetsToMake asked, const RunContext& run) {
    if (!asked.warps.empty())
        take_parameters(*asked.generator, asked.warps, asked.request, asked.options, run);
    auto& bounds = asked.request.bounds;
    if (bounds) require_box(*bounds);
    if (!bounds || asked.warps.empty()) return asked;
    const auto [d, kept] = left_by_warps(asked);
    Box all{std::vector<double>(d, 0), std::vector<double>(d, 1)};
    if (kept.empty())
        fail(ErrorKind::usage,
             "--bounds: the warps take all coordinates, and none is left to scale");
    if (bounds->dimension() != kept.size() && bounds->dimension() != d)
        fail(ErrorKind::usage, "--bounds: {} ranges; the warps leave {} of {} coordinates",
             bounds->dimension(), kept.size(), d);
    for (std::size_t i = 0; i < kept.size(); ++i) {
        const std::size_t k = kept[i];
        const std::size_t range = bounds->dimension() == d ? k : i;
        all.low[k] = bounds->low[range];
        all.high[k] = bounds->high[range];
    }
    if (asked.generator->traits.boxed)
        for (const Spec& spec : asked.warps)
            if (scramble_named(spec.name) != nullptr)
                fail(ErrorKind::usage,
                     "--bounds: {} measures its distances in the box, and {} would change them",
                     asked.generator->name, spec.name);
    bounds = std::move(all);
    return asked;
}

/// Refuses a scramble that the generator applies itself, with the same seed: digits would cancel.
void refuse_same_scramble(const SetsToMake& asked) {
    const Values::Item* own = asked.options.try_find("scramble");
    if (own == nullptr) return;
    const auto has_seed = [](const auto& item) { return item.first == scramble_seed.name; };
    for (const Spec& spec : asked.warps)
        if (spec.name == format_value(own->value) && std::ranges::none_of(spec.settings, has_seed))
            fail(ErrorKind::usage,
                 "warp {0}: it would undo a part of --scramble {0}, which has the same seed; give "
                 "it another, such as {0}:seed=...",
                 spec.name);
}

}  // namespace

std::string command_of(const SetsToMake& asked) {
    const auto& [generator, options, request, sets, warps, shard, known] = asked;
    if (request.bounds) require_box(*request.bounds);
    std::string text =
        "stipple generate " + shell_word(format_spec(generator->name, options, generator->options));
    if (request.count) text += fmt::format(" --count {}", *request.count);
    if (request.dimension) text += fmt::format(" --dimension {}", *request.dimension);
    if (request.start > 0) text += fmt::format(" --start {}", request.start);
    if (request.bounds) text += " --bounds " + shell_word(format_box(*request.bounds));
    for (const Spec& warp : warps) text += " --warp " + shell_word(format_spec(warp));
    if (sets > 1) text += fmt::format(" --sets {}", sets);
    return text + fmt::format(" --seed {}", request.seed);
}

Box bounds_for(const SetsToMake& asked, std::string_view text) {
    const auto ranges = static_cast<std::size_t>(1 + std::ranges::count(text, ','));
    if (!asked.warps.empty()) {
        const auto [d, left] = left_by_warps(asked);
        return parse_box(text, ranges == d ? d : std::max<std::size_t>(left.size(), 1));
    }
    Request request = asked.request;
    request.bounds = parse_box(text, request.dimension.value_or(std::max<std::size_t>(ranges, 2)));
    return parse_box(text, plan_for(*asked.generator, request, asked.options).dimension);
}

GeneratedSets::GeneratedSets(SetsToMake asked, const RunContext& run)
    : asked_(completed(std::move(asked), run)),
      generator_(*asked_.generator),
      plan_(plan_for(generator_, asked_.request, asked_.options)),
      chain_(make_chain({}, run)),
      domain_(chain_->empty() && asked_.request.bounds ? box_domain(*asked_.request.bounds)
                                                       : chain_->domain()) {
    if (const auto& box = asked_.request.bounds; box && box->dimension() != plan_.dimension)
        fail(ErrorKind::usage, "--bounds: {} ranges for {} coordinates", box->dimension(),
             plan_.dimension);
    if (generator_.settle) generator_.settle(asked_.options);
    auto files = files_of(generator_.options, asked_.options, generator_.writes);
    files.insert(files.end(), chain_->record().files.begin(), chain_->record().files.end());
    inputs_ = fingerprints(files, run);
    if (const auto& bounds = asked_.request.bounds; bounds && !generator_.traits.boxed) {
        scaling_.emplace();
        for (const auto& [k, at] : chain_->kept()) {
            scaling_->box.low.push_back(bounds->low[k]);
            scaling_->box.high.push_back(bounds->high[k]);
            scaling_->columns.push_back(at);
        }
    }
    if (asked_.sets - 1 > ~plan_.seed)
        fail(ErrorKind::usage, "--seed: {} and {} sets go beyond the 64 bits of a seed", plan_.seed,
             asked_.sets);
    if (generator_.max_seed && asked_.sets - 1 > generator_.max_seed(asked_.options) - plan_.seed)
        fail(ErrorKind::usage, "--seed: {} and {} sets go beyond {}, the last seed of {}",
             plan_.seed, asked_.sets, generator_.max_seed(asked_.options), generator_.name);
    refuse_same_scramble(asked_);
    if (different_sets() < asked_.sets)
        run.notify(fmt::format("{} does not use the seed: all {} sets are the same",
                               generator_.name, asked_.sets));
    if (generator_.notes)
        for (const auto& note : generator_.notes(asked_.request, plan_, asked_.options))
            run.notify(note);
}

std::optional<std::uint64_t> GeneratedSets::streamed() const {
    const bool whole = generator_.whole && generator_.whole(asked_.options);
    if (!generator_.traits.sequence || whole || chain_->traits().drops ||
        chain_->traits().needs_whole_set)
        return std::nullopt;
    return plan_.count;
}

std::shared_ptr<const WarpChain> GeneratedSets::chain_for(std::uint64_t set, const RunContext& run,
                                                          std::optional<std::uint64_t> made) const {
    if (!chain_->traits().seeded) return chain_;
    const std::uint64_t count = asked_.request.start + made.value_or(plan_.count);
    return make_chain({.seed = plan_.seed + set, .count = count}, run);
}

std::shared_ptr<const WarpChain> GeneratedSets::make_chain(const ChainSet& set,
                                                           const RunContext& run) const {
    ChainSet in_bases = set;
    const bool scrambled = std::ranges::any_of(
        asked_.warps, [](const Spec& spec) { return scramble_named(spec.name) != nullptr; });
    if (scrambled) in_bases.bases = chain_set(generator_, plan_, asked_.options).bases;
    in_bases.bounds = asked_.request.bounds;
    return std::make_shared<WarpChain>(asked_.warps, plan_.dimension, in_bases, run);
}

std::shared_ptr<Sequence> GeneratedSets::sequence(std::uint64_t set, const RunContext& run) const {
    if (sequence_ && !uses_seed(generator_, asked_.options)) return sequence_;
    Plan plan = plan_;
    plan.seed += set;
    return sequence_ = new_sequence(plan, set, run);
}

std::unique_ptr<Sequence> GeneratedSets::new_sequence(Plan plan, std::uint64_t set,
                                                      const RunContext& run) const {
    const bool whole = generator_.whole && generator_.whole(asked_.options);
    if (!chain_->empty() &&
        (whole || std::ranges::any_of(chain_->outcome_axes(), &OutcomeAxis::discrete))) {
        const auto chain = chain_for(set, run);
        Destination destination{
            .has_image =
                [chain](std::uint64_t i, std::span<const double> row) {
                    return !chain->forward({row.begin(), row.end()}, i).empty();
                },
            .drops = chain->traits().refills && !chain->traits().needs_whole_set,
            .axes = chain->outcome_axes()};
        if (goes_on_from_runs(asked_.options, *chain))
            destination.given = preimages_of_runs(asked_.options, *chain, run);
        plan.destination = std::make_shared<Destination>(std::move(destination));
    }
    return generator_.sequence(plan, asked_.options, run);
}

std::uint64_t GeneratedSets::different_sets() const {
    return uses_seed(generator_, asked_.options) || chain_->traits().seeded ? asked_.sets : 1;
}

NextRows GeneratedSets::stream(std::uint64_t set, const RunContext& run, std::uint64_t first,
                               std::optional<std::uint64_t> last) const {
    const auto points = sequence(set, run);
    walk_to(*points, asked_.request.start + first, plan_.dimension, run);
    return [=, at = asked_.request.start + first,
            end = asked_.request.start + last.value_or(plan_.count), scaling = scaling_,
            chain = chain_for(set, run), lane = silent(run)](std::span<double> rows) mutable {
        const std::size_t d = chain->dimension_out();
        const auto some =
            static_cast<std::size_t>(std::min<std::uint64_t>(end - at, rows.size() / d));
        fill_rows(*points, at, *chain, scaling, rows.first(some * d), lane);
        at += some;
        return some;
    };
}

PointSet GeneratedSets::raw_points(std::uint64_t set, const Plan& plan,
                                   const RunContext& run) const {
    if (!generator_.traits.sequence) {
        need_memory_of(plan, run);
        return generator_.set(plan, asked_.options, run);
    }
    const RunContext steady = run.rising();
    const auto points = plan.count == plan_.count
                            ? sequence(set, steady)
                            : std::shared_ptr<Sequence>(new_sequence(plan, set, steady));
    return points_of(*points, plan, asked_.request.start, steady);
}

void GeneratedSets::keep_runs(PointSet& points, const RunContext& run) const {
    if (!goes_on_from_runs(asked_.options, *chain_)) return;
    const PointSet runs = read_runs(asked_.options, *chain_, silent(run));
    if (runs.count() <= points.count()) std::ranges::copy(runs.flat(), points.flat().begin());
}

void GeneratedSets::tell_absent_levels(const RunContext& run) const {
    constexpr std::uint64_t few = std::uint64_t{1} << 16;
    if (!streamed() || plan_.count > few || chain_->empty()) return;
    if (std::ranges::none_of(chain_->outcome_axes(), &OutcomeAxis::discrete)) return;
    std::vector<double> rows(static_cast<std::size_t>(plan_.count) * dimension());
    stream(0, silent(run))(rows);
    warn_of_absent_levels(rows, generator_, *chain_, run);
}

PointSet GeneratedSets::made(std::uint64_t set, const RunContext& run) const {
    const bool refills = chain_->traits().refills && plan_.count > 0;
    // Whether points without an image are replaced by later points of the sequence.
    const bool next = refills && generator_.traits.sequence && generator_.traits.prefix &&
                      !chain_->traits().needs_whole_set;
    Plan plan = plan_;
    plan.seed += set;
    PointSet points = next ? PointSet() : raw_points(set, plan, run);
    auto worked_out = std::move(points.provenance.options);
    auto found = std::move(points.provenance.found);
    auto side_files =
        generator_.traits.sequence ? this->side_files() : std::move(points.side_files);
    double efficiency = 1;
    if (!chain_->empty()) {
        const RunContext rest = run.best_is_wanted() ? unstopped(run) : run;
        if (refills) {
            auto [rows, made, kept] =
                next ? next_images(set, rest) : images_of_more(set, points, rest);
            points = PointSet(std::move(rows), dimension());
            points.provenance.efficiency = static_cast<double>(kept) / static_cast<double>(made);
        } else {
            points = image_of(points, *chain_for(set, rest, points.count()), rest.stage(1, 1),
                              asked_.request.start);
        }
        efficiency = points.provenance.efficiency;
        keep_runs(points, rest);
        if (set == 0) warn_of_absent_levels(points.flat(), generator_, *chain_, run);
    }
    if (scaling_) scaling_->apply(points.flat(), points.dimension());
    points.domain = domain_;
    points.provenance = provenance(set, points.count());
    points.provenance.efficiency = efficiency;
    if (!worked_out.empty()) points.provenance.options = std::move(worked_out);
    // Results of the generator's search hold for points of the unit cube. Other points keep only
    // the record of how the search ended.
    if (!chain_->empty() || scaling_)
        std::erase_if(found, [](const auto& one) { return one.first != interrupted.first; });
    if (!found.empty()) points.provenance.found = std::move(found);
    points.side_files = std::move(side_files);
    return points;
}

namespace {

/// Gives up if at most 1e-6 of `made` points of d coordinates have an image, once making them has
/// taken some seconds. @throws Error(input)
void check_share(std::uint64_t kept, std::uint64_t made, std::size_t d) {
    const std::uint64_t enough =
        std::max<std::uint64_t>(20'000'000 / std::max<std::size_t>(d, 2), 1'000'000);
    if (made < enough || static_cast<double>(kept) > 1e-6 * static_cast<double>(made)) return;
    fail_with_hint(
        ErrorKind::input,
        "random points never satisfy constraints that hold only on a surface, such as those with "
        "==",
        "the constraints hold for {} of {} points; at least one in a million is required",
        kept == 0 ? "none" : std::to_string(kept), made);
}

/// Tries random points until one satisfies the constraints, before large sets are made in vain.
/// @throws Error(input)
void look_for_one(const WarpChain& chain, std::size_t cube_dimension, const RunContext& run) {
    const Rng rng(1, 0);
    const std::size_t count = 1 + 0x40000 / cube_dimension;
    std::vector<double> rows(count * cube_dimension);
    std::uint64_t made = 0;
    do {
        check_share(0, made, cube_dimension);
        rng.fill(made * cube_dimension, rows);
        made += count;
        run.check_stop();
    } while (chain.mapped(rows, false, 0, run).empty());
}

}  // namespace

GeneratedSets::Images GeneratedSets::next_images(std::uint64_t set, const RunContext& run) const {
    const auto chain = chain_for(set, run);
    const RunContext quiet = silent(run);
    const auto points = sequence(set, quiet);
    const std::size_t d = dimension();
    const std::uint64_t start = asked_.request.start;
    const std::uint64_t last = start + plan_.count;
    Images images{{}, 0, 0};
    for (int pass = 0; images.kept < last; ++pass) {
        const auto lacking = static_cast<double>(last - images.kept);
        const double share = pass == 0 ? 1
                                       : std::max(static_cast<double>(images.kept), 1.0) /
                                             static_cast<double>(images.made);
        const double more = pass == 0 ? lacking : std::max(1.1 * lacking / share, 4096.0);
        if (pass == 1 && more > 1e7)
            run.notify(
                fmt::format("the fraction of points that satisfy the constraints is {:.2g}{}; "
                            "about {:.1g} more points must be made",
                            share, images.kept == 0 ? " or less" : "", more));
        check_share(images.kept, images.made, d);
        const std::uint64_t left = generator_.traits.max_index - images.made;
        if (left == 0)
            fail(ErrorKind::input, "the constraints hold for {} of the {} points that {} has",
                 images.kept, images.made, generator_.name);
        Plan plan = plan_;
        plan.count = std::min(left, static_cast<std::uint64_t>(std::min(more, 0x1p20)));
        const PointSet next = points_of(*points, plan, images.made, quiet);
        const auto rows = chain->mapped(next.flat(), false, images.made, quiet);
        const std::uint64_t skipped =
            std::min<std::uint64_t>(start - std::min(start, images.kept), rows.size() / d);
        images.rows.insert(images.rows.end(),
                           rows.begin() + static_cast<std::ptrdiff_t>(skipped * d), rows.end());
        images.kept += rows.size() / d;
        images.made += plan.count;
        run.tick(std::min(images.kept, last), last);
    }
    images.rows.resize(static_cast<std::size_t>(plan_.count) * d);
    return images;
}

namespace {

/// Whether a generator can make sets of count + 1 points, as a sign that it can make any number.
bool takes_any_count(const Generator& generator, Request request, std::uint64_t count,
                     const Values& options) {
    try {
        request.count = count + 1;
        return plan_for(generator, request, options).count == count + 1;
    } catch (const Error&) {
        return false;
    }
}

}  // namespace

GeneratedSets::Images GeneratedSets::images_of_more(std::uint64_t set, const PointSet& first,
                                                    const RunContext& run) const {
    const auto chain = chain_for(set, run);
    const RunContext quiet = silent(run);
    const std::size_t d = dimension();
    std::vector<double> kept = chain->mapped(first.flat(), false, asked_.request.start, quiet);
    std::uint64_t count = first.count();
    if (kept.size() / d < plan_.count &&
        !takes_any_count(generator_, asked_.request, plan_.count, asked_.options)) {
        if (kept.empty())
            fail(ErrorKind::input, "the constraints hold for none of the {} points of {}", count,
                 generator_.name);
        run.notify(fmt::format(
            "{} of the {} points of {} satisfy the constraints; the others are left out, since it "
            "has no set of another size to take them from",
            kept.size() / d, count, generator_.name));
        return {std::move(kept), count, kept.size() / d};
    }
    if (kept.empty()) look_for_one(*chain, plan_.dimension, quiet);
    Images best{{}, count, 0};
    for (int step = 0; step < 12; ++step) {
        const std::uint64_t have = kept.size() / d;
        if (have >= plan_.count && (best.rows.empty() || count < best.made))
            best = {kept, count, have};
        if (!best.rows.empty() && have >= plan_.count && have <= plan_.count + 2 + plan_.count / 50)
            break;
        if (have == 0 && count > 10'000'000) break;
        const double ratio =
            have == 0 ? 32 : static_cast<double>(plan_.count) / static_cast<double>(have);
        const double next = static_cast<double>(count) * ratio * 1.005 + 1;
        if (!best.rows.empty() && next >= static_cast<double>(best.made)) break;
        Request request = asked_.request;
        request.count = count = static_cast<std::uint64_t>(next);
        request.seed = plan_.seed + set;
        const Plan plan = plan_for(generator_, request, asked_.options);
        // The first set has already caused all warnings.
        kept =
            chain->mapped(raw_points(set, plan, unwarned(run)).flat(), false, request.start, quiet);
    }
    if (best.rows.empty())
        fail(ErrorKind::input, "the constraints hold for {} of {} points",
             kept.empty() ? "none" : std::to_string(kept.size() / d), count);
    best.rows.resize(static_cast<std::size_t>(plan_.count) * d);
    if (best.made == plan_.count) return best;
    run.notify(fmt::format(
        "{} points were made, of which {} satisfy the constraints; the properties of {} "
        "are those of the larger set",
        best.made, plan_.count, generator_.name));
    return best;
}

void GeneratedSets::prepare(const RunContext& run) const {
    if (!uses_seed(generator_, asked_.options)) sequence_ = sequence(0, run);
}

std::vector<SideFile> GeneratedSets::side_files() const {
    return sequence_ ? sequence_->side_files : std::vector<SideFile>();
}

Provenance GeneratedSets::provenance(std::uint64_t set, std::uint64_t count) const {
    Provenance meta{.version = STIPPLE_VERSION,
                    .generator = generator_.name,
                    .options = typed_settings(asked_.options, generator_.options),
                    .seed = plan_.seed + set,
                    .count = count,
                    .dimension = dimension(),
                    .start = asked_.request.start,
                    .warps = chain_->record().specs,
                    .domain = domain_->spec(),
                    .bounds = {},
                    .shard = {},
                    .command = asked_.command,
                    .independent = generator_.traits.independent};
    std::erase_if(meta.options, [this](const auto& option) {  // options that only write side files
        return std::ranges::find(generator_.writes, option.first) != generator_.writes.end();
    });
    meta.columns = chain_->names();
    meta.levels = levels_of(*chain_);
    if (asked_.request.bounds) meta.bounds = format_box(*asked_.request.bounds);
    meta.inputs = inputs_;
    if (sequence_) meta.found = sequence_->found();
    if (generator_.stream_version > 1)
        meta.stream_versions.emplace_back(generator_.name, generator_.stream_version);
    const auto& later = chain_->record().stream_versions;
    meta.stream_versions.insert(meta.stream_versions.end(), later.begin(), later.end());
    return meta;
}

}  // namespace stipple
