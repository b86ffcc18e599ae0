// SPDX-License-Identifier: MIT
#include "pipeline/chain.hpp"

#include <algorithm>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>

#include "core/bytes/file_bytes.hpp"
#include "core/bytes/fingerprint.hpp"
#include "core/error.hpp"
#include "core/machine/memory.hpp"
#include "core/parallel.hpp"
#include "core/product_domain.hpp"
#include "core/rng.hpp"
#include "core/text.hpp"
#include "io/format.hpp"
#include "pipeline/units.hpp"

namespace stipple {
namespace {

/// Returns to[i] for the index i with from[i] == k.
std::size_t moved(std::size_t k, std::span<const std::size_t> from,
                  std::span<const std::size_t> to) {
    return to[static_cast<std::size_t>(std::ranges::find(from, k) - from.begin())];
}

/// Returns the positions in the output row of an image of `size` numbers: `taken` if the sizes
/// agree; otherwise consecutive, after the other coordinates below taken[0].
std::vector<std::size_t> places(std::span<const std::size_t> taken, std::size_t size) {
    if (taken.size() == size) return {taken.begin(), taken.end()};
    const auto before =
        std::ranges::count_if(taken, [&](std::size_t k) { return k < taken.front(); });
    std::vector<std::size_t> at(size);
    std::iota(at.begin(), at.end(), taken.front() - static_cast<std::size_t>(before));
    return at;
}

/// Builds rows with the columns of `part` at the positions `at`, and the columns `rest` of `rows`
/// at the positions `free`.
std::vector<double> interleave(std::span<const double> rows, std::size_t width,
                               std::span<const std::size_t> rest, std::span<const double> part,
                               std::span<const std::size_t> at, std::span<const std::size_t> free) {
    const std::size_t wide = rest.size() + at.size();
    const std::size_t count = rows.size() / width;
    std::vector<double> out(count * wide);
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t k = 0; k < at.size(); ++k) out[i * wide + at[k]] = part[i * at.size() + k];
        for (std::size_t k = 0; k < rest.size(); ++k)
            out[i * wide + free[k]] = rows[i * width + rest[k]];
    }
    return out;
}

void keep_rows(std::vector<double>& rows, std::size_t width, std::span<const std::uint8_t> keep) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < keep.size(); ++i) {
        if (!keep[i]) continue;
        std::copy_n(rows.begin() + static_cast<std::ptrdiff_t>(i * width), width,
                    rows.begin() + static_cast<std::ptrdiff_t>(kept * width));
        ++kept;
    }
    rows.resize(kept * width);
}

/// Reports that a warp takes `takes` coordinates, which is not the number that it was given.
/// @param width numbers per row
/// @throws Error(usage)
[[noreturn]] void refuse_coordinates(const Spec& spec, std::size_t takes, std::size_t width) {
    const std::string wants =
        fmt::format("warp {} takes {} coordinate{}", spec.name, takes, takes == 1 ? "" : "s");
    if (!spec.coordinates.empty())
        fail(ErrorKind::usage, "{}; {} {} named: {}@{}", wants, spec.coordinates.size(),
             spec.coordinates.size() == 1 ? "is" : "are", spec.name,
             format_coordinates(spec.coordinates));
    std::string hint;
    if (takes < width)
        hint = fmt::format("name the coordinates: {}@{}, or make points with -d {}", spec.name,
                           format_coordinates(all_coordinates(takes)), takes);
    fail_with_hint(ErrorKind::usage, hint, "{}; the points have {}", wants, width);
}

}  // namespace

std::vector<double> gather(std::span<const double> rows, std::size_t width,
                           std::span<const std::size_t> columns) {
    std::vector<double> out;
    out.reserve(rows.size() / width * columns.size());
    for (std::size_t i = 0; i < rows.size(); i += width)
        for (const std::size_t k : columns) out.push_back(rows[i + k]);
    return out;
}

ChainSet chain_set(const Generator& generator, const Plan& plan, const Values& options) {
    return {
        .seed = plan.seed,
        .count = plan.start + plan.count,
        .bases = generator.bases ? generator.bases(plan, options) : std::vector<std::uint32_t>()};
}

WarpChain::WarpChain(std::span<const Spec> specs, std::size_t dimension, const ChainSet& set,
                     const RunContext& run, std::vector<Factor> warped)
    : dimension_in_(dimension), from_(all_coordinates(dimension)) {
    for (Factor& before : warped) set_domain(std::move(before));
    for (const Spec& spec : specs)
        if (const Scramble* scramble = scramble_named(spec.name))
            add_scramble(*scramble, spec, set);
        else
            add_warp(find_warp(spec.name), spec, run);
    if (set.bounds && !empty())
        for (const auto& [k, at] : kept())
            set_domain({box_domain({{set.bounds->low[k]}, {set.bounds->high[k]}}), {at}});
    std::vector<Factor> factors;
    for (const Step& step : steps_)
        if (step.domain) factors.push_back({step.domain, step.image});
    domain_ = filled_up(std::move(factors), dimension_out());
}

void WarpChain::set_domain(Factor factor) {
    steps_.push_back({.domain = std::move(factor.domain),
                      .image = std::move(factor.coordinates),
                      .width_in = dimension_out(),
                      .width_out = dimension_out()});
}

std::vector<std::pair<std::size_t, std::size_t>> WarpChain::kept() const {
    std::vector<std::pair<std::size_t, std::size_t>> found;
    for (std::size_t at = 0; at < from_.size(); ++at)
        if (from_[at] != none) found.emplace_back(from_[at], at);
    return found;
}

WarpChain::Step WarpChain::step_of(const Spec& spec) const {
    const auto named = named_or_all(spec, dimension_out());
    for (const std::size_t k : named) {
        if (k >= dimension_out())
            fail(ErrorKind::usage, "{}@{}: the points have coordinates 1 to {}", spec.name,
                 format_coordinates(named), dimension_out());
        for (const Step& earlier : steps_)
            if (std::ranges::find(earlier.image, k) != earlier.image.end())
                fail(ErrorKind::usage,
                     "warp {}: coordinate {} is already on another domain; it takes coordinates of "
                     "the unit cube",
                     spec.name, k + 1);
    }
    Step step{.coordinates = named,
              .rest = other_coordinates(dimension_out(), named),
              .width_in = dimension_out()};
    for (const std::size_t k : named) step.from.push_back(from_[k]);
    return step;
}

template <class Unit>
void WarpChain::remember(const Unit& unit, const Spec& spec, const Values& values) {
    std::string text = format_spec(unit.name, values, unit.options);
    if (!spec.coordinates.empty())
        text.insert(unit.name.size(), fmt::format("@{}", format_coordinates(spec.coordinates)));
    record_.specs.push_back(std::move(text));
    std::ranges::copy(files_of(unit.options, values), std::back_inserter(record_.files));
    if (unit.stream_version > 1)
        record_.stream_versions.emplace_back(unit.name, unit.stream_version);
}

/// Sets the base of a scramble of digits to that of its coordinates, unless the spec sets it.
void WarpChain::set_bases(Values& values, const Scramble& scramble,
                          std::span<const std::size_t> coordinates,
                          const std::vector<std::uint32_t>& bases) const {
    const auto& known = scramble.options.options();
    if (bases.empty() || std::ranges::find(known, "base", &Option::name) == known.end() ||
        values.find("base").given)
        return;
    std::vector<std::uint32_t> own;
    for (const std::size_t k : coordinates)
        own.push_back(bases.size() == 1 ? bases[0] : bases.at(from_[k]));
    if (std::ranges::count(own, own.front()) == std::ssize(own)) own.resize(1);
    if (own != std::vector<std::uint32_t>{2}) scramble.options.set(values, "base", join(own, ","));
}

void WarpChain::add_scramble(const Scramble& scramble, const Spec& spec, const ChainSet& set) {
    Values values = spec.values(scramble.options);
    Step step = step_of(spec);
    set_bases(values, scramble, step.coordinates, set.bases);
    step.width_out = step.width_in;
    step.at = step.coordinates;
    step.others = step.rest;
    std::uint64_t seed = set.seed;
    if (values.given(scramble_seed)) {
        const auto own = parse_unsigned(values[scramble_seed]);
        if (!own)
            fail(ErrorKind::usage, "{}: seed '{}' is not a whole number in [0, 2^64)", spec.name,
                 values[scramble_seed]);
        seed = *own;
    } else {
        traits_.seeded = true;
    }
    for (const std::string& text : record_.specs) {  // digits of the same scramble and seed cancel
        if (!text.starts_with(scramble.name) || values.try_find("base") == nullptr) continue;
        const Spec earlier = parse_spec(text);
        const bool meets = earlier.coordinates.empty() ||
                           std::ranges::find_first_of(earlier.coordinates, step.coordinates) !=
                               earlier.coordinates.end();
        if (meets && earlier.values(scramble.options)[scramble_seed] == values[scramble_seed])
            fail(ErrorKind::usage,
                 "warp {0}: it would undo a part of the {0} before it, which has the same seed; "
                 "give it another, such as {0}:seed=...",
                 scramble.name);
    }
    step.randomization =
        scramble.make(values, {.coordinates = step.coordinates, .seed = seed, .count = set.count});
    remember(scramble, spec, values);
    steps_.push_back(std::move(step));
}

void WarpChain::add_warp(const Warp& warp, const Spec& spec, const RunContext& run) {
    const Values values = spec.values(warp.options);
    Step step = step_of(spec);
    step.mapping = warp.make(values, step.coordinates.size(), run);
    step.set_step = step.mapping->set_step();
    const bool drops = step.mapping->drops();
    traits_.drops |= drops;
    traits_.refills |= drops && warp.traits.refills;
    traits_.needs_whole_set |= static_cast<bool>(step.set_step);
    const std::size_t takes = step.mapping->cube_dimension();
    if (takes != step.coordinates.size()) refuse_coordinates(spec, takes, step.width_in);
    step.domain = step.mapping->domain();
    const std::size_t gives = step.domain->dimension();
    step.width_out = step.width_in - takes + gives;
    step.image = step.at = places(step.coordinates, gives);
    step.others = other_coordinates(step.width_out, step.at);
    for (Step& earlier : steps_)
        for (std::size_t& k : earlier.image) k = moved(k, step.rest, step.others);
    std::vector<std::size_t> from(step.width_out, none);
    for (std::size_t i = 0; i < step.rest.size(); ++i) from[step.others[i]] = from_[step.rest[i]];
    from_ = std::move(from);
    remember(warp, spec, values);
    steps_.push_back(std::move(step));
}

std::vector<OutcomeAxis> WarpChain::outcome_axes() const {
    std::vector<OutcomeAxis> axes(dimension_in_);
    std::vector<bool> randomized(dimension_in_);
    for (const Step& step : steps_) {
        auto own = step.mapping ? step.mapping->outcome_axes() : std::vector<OutcomeAxis>();
        for (std::size_t i = 0; i < step.from.size(); ++i) {
            const std::size_t k = step.from[i];
            if (!step.mapping)
                randomized[k] = true;
            else if (!own.empty() && !randomized[k])
                axes[k] = std::move(own[i]);
        }
    }
    return axes;
}

std::vector<std::size_t> WarpChain::stops() const {
    std::vector<std::size_t> at;
    for (std::size_t i = 0; i < steps_.size(); ++i)
        if (steps_[i].set_step) at.push_back(i);
    at.push_back(steps_.size());
    return at;
}

void WarpChain::apply_set_step(const Step& step, std::span<double> rows, const RunContext& run) {
    std::vector<double> part = gather(rows, step.width_in, step.coordinates);
    step.set_step(part, run);
    const std::size_t d = step.coordinates.size();
    for (std::size_t i = 0; i < part.size() / d; ++i)
        for (std::size_t k = 0; k < d; ++k)
            rows[i * step.width_in + step.coordinates[k]] = part[i * d + k];
}

void WarpChain::note_infinite(const Step& step, std::span<const double> cube,
                              std::uint64_t first) const {
    if (step.mapping->domain()->measure() < std::numeric_limits<double>::infinity()) return;
    const std::size_t d = step.coordinates.size();
    for (std::size_t i = 0; i < cube.size(); i += d)
        if (step.mapping->infinite(cube.subspan(i, d))) {
            std::uint64_t least = infinite_;
            const std::uint64_t row = first + i / d;
            while (row < least && least != told && !infinite_.compare_exchange_weak(least, row)) {
            }
            return;
        }
}

void WarpChain::tell_infinite(const RunContext& run) const {
    const std::uint64_t row = infinite_;
    if (row == none || row == told) return;
    infinite_ = told;
    run.notify(
        fmt::format("point {} has a coordinate 0 or 1, which {} maps to infinity; a value far in "
                    "the tail replaces it; leave such points out (generate --start 1) or "
                    "scramble them",
                    row, short_specs(record_.specs)));
}

std::vector<double> WarpChain::forward(std::vector<double> rows, std::uint64_t first) const {
    std::size_t from = 0;
    for (const std::size_t stop : stops()) {
        rows = through(std::move(rows), first, from, stop);
        if (stop < steps_.size()) apply_set_step(steps_[stop], rows, {});
        from = stop;
    }
    return rows;
}

std::vector<double> WarpChain::through(std::vector<double> rows, std::uint64_t first,
                                       std::size_t from, std::size_t to) const {
    for (const Step& step : std::span(steps_).subspan(from, to - from)) {
        if (!step.mapping && !step.randomization) continue;
        const std::size_t count = rows.size() / step.width_in;
        const bool whole = step.coordinates == all_coordinates(step.width_in);
        auto part = whole ? std::move(rows) : gather(rows, step.width_in, step.coordinates);
        const bool drops = step.mapping && step.mapping->drops();
        std::vector<std::uint8_t> keep(drops ? count : 0, 1);
        if (step.mapping) {
            note_infinite(step, part, first);
            std::vector<double> image(count * step.at.size());
            step.mapping->forward(part, image, keep);
            part = std::move(image);
        } else {
            step.randomization(first, part);
        }
        rows = whole ? std::move(part)
                     : interleave(rows, step.width_in, step.rest, part, step.at, step.others);
        if (drops) keep_rows(rows, step.width_out, keep);
    }
    return rows;
}

std::vector<double> WarpChain::inverse(std::vector<double> rows) const {
    for (auto step = steps_.rbegin(); step != steps_.rend(); ++step) {
        if (!step->mapping)
            fail(ErrorKind::usage, "--inverse: a scramble is random and has no inverse");
        const std::size_t count = rows.size() / step->width_out;
        std::vector<double> cube(count * step->coordinates.size());
        step->mapping->inverse(gather(rows, step->width_out, step->at), cube);
        // A point on the boundary may have the preimage 1, but warps take coordinates below 1.
        for (double& x : cube) x = std::min(x, one_minus_ulp);
        rows = interleave(rows, step->width_out, step->others, cube, step->coordinates, step->rest);
    }
    return rows;
}

namespace {

/// Splits rows of d numbers into blocks, and joins the images(block, first) of all, in order.
std::vector<double> in_blocks(
    std::span<const double> rows, std::size_t d, const RunContext& run,
    const std::function<std::vector<double>(std::vector<double>, std::size_t first)>& images) {
    const std::size_t count = rows.size() / d;
    const std::size_t block = std::max<std::size_t>(1, 16384 / d);
    std::vector<std::vector<double>> parts(block_count(count, block));
    for_each_block(run, count, block, [&](const Block& b) {
        const auto from = rows.subspan(b.first * d, (b.last - b.first) * d);
        parts[b.index] = images({from.begin(), from.end()}, b.first);
    });
    std::size_t numbers = 0;
    for (const auto& part : parts) numbers += part.size();
    std::vector<double> all;
    all.reserve(numbers);
    for (auto& part : parts) {
        all.insert(all.end(), part.begin(), part.end());
        release(part);  // so that memory never holds all points twice
    }
    return all;
}

}  // namespace

std::vector<double> WarpChain::mapped(std::span<const double> rows, bool back, std::uint64_t first,
                                      const RunContext& run) const {
    const std::size_t d = back ? dimension_out() : dimension_in_;
    const std::size_t wide = back ? dimension_in_ : dimension_out();
    run.need_memory(8.0 * static_cast<double>(rows.size() / d * wide), "the image of the points");
    if (back)
        return in_blocks(rows, d, run, [&](std::vector<double> block, std::size_t) {
            return inverse(std::move(block));
        });
    std::vector<double> all;
    std::size_t from = 0;
    for (const std::size_t stop : stops()) {
        const std::size_t width = steps_.empty() ? d : steps_[from].width_in;
        all = in_blocks(rows, width, run, [&](std::vector<double> block, std::size_t at) {
            return through(std::move(block), first + at, from, stop);
        });
        if (stop < steps_.size()) apply_set_step(steps_[stop], all, run);
        rows = all;
        from = stop;
    }
    tell_infinite(run);
    return all;
}

std::vector<std::string> WarpChain::names(std::vector<std::string> before, bool back) const {
    if (before.size() != (back ? dimension_out() : dimension_in_)) before.clear();
    std::vector<std::string> after(back ? dimension_in_ : dimension_out());
    if (!before.empty())
        for (const auto& [from, at] : kept())
            after[back ? from : at] = std::move(before[back ? at : from]);
    for (const Step& step : steps_) {
        if (!step.mapping) continue;
        const auto own = step.domain->names();  // if not empty, one for each cube coordinate
        for (std::size_t i = 0; i < own.size(); ++i)
            after[(back ? step.from : step.image)[i]] = own[i];
    }
    if (std::ranges::all_of(after, &std::string::empty)) return {};
    const auto usual = coordinate_names(after.size());
    for (std::size_t k = 0; k < after.size(); ++k)
        if (after[k].empty()) after[k] = usual[k];
    return after;
}

std::vector<double> WarpChain::density(std::span<const double> rows) const {
    std::vector<double> density(rows.size() / dimension_out(), 1.0);
    for (const Step& step : steps_)
        if (step.domain)
            multiply_densities(density, rows, step.image, *step.domain, step.mapping.get());
    return density;
}

Levels levels_of(const WarpChain& chain) {
    Levels all;
    for (const Factor& factor : factors_of(chain.domain()))
        std::ranges::move(factor.domain->levels(), std::back_inserter(all));
    return all;
}

DomainPtr domain_before(const WarpChain& chain, const DomainPtr& after) {
    const auto kept = chain.kept();
    std::vector<Factor> factors;
    for (const Factor& factor : warped_factors(after)) {
        std::vector<std::size_t> before;
        for (const std::size_t k : factor.coordinates)
            for (const auto& [from, at] : kept)
                if (at == k) before.push_back(from);
        if (before.size() == factor.coordinates.size())
            factors.push_back({factor.domain, std::move(before)});
    }
    return filled_up(std::move(factors), chain.dimension_in());
}

PointSet image_of(const PointSet& points, const WarpChain& chain, const RunContext& run,
                  std::uint64_t start) {
    if (points.dimension() != chain.dimension_in())
        fail(ErrorKind::input, "the points have {} coordinates; the warps take {}",
             points.dimension(), chain.dimension_in());
    PointSet image(chain.mapped(points.flat(), false, start, run), chain.dimension_out());
    tell_kept(chain, points.count(), image.count(), run);
    image.domain = chain.domain();
    image.provenance = points.provenance;
    image.provenance.columns = chain.names(points.provenance.columns);
    std::ranges::move(levels_of(chain), std::back_inserter(image.provenance.levels));
    image.provenance.efficiency *=
        static_cast<double>(image.count()) / static_cast<double>(points.count());
    return image;
}

PointSet preimage_of(const PointSet& points, const WarpChain& chain, const RunContext& run) {
    if (points.dimension() != chain.dimension_out())
        fail(ErrorKind::input, "the points have {} coordinates; the warps give {}",
             points.dimension(), chain.dimension_out());
    PointSet before(chain.mapped(points.flat(), true, 0, run), chain.dimension_in());
    before.domain = domain_before(chain, points.domain);
    before.provenance = points.provenance;
    before.provenance.columns = chain.names(points.provenance.columns, true);
    return before;
}

void tell_kept(const WarpChain& chain, std::uint64_t count, std::uint64_t kept,
               const RunContext& run) {
    const std::string warps = short_specs(chain.record().specs);
    if (chain.traits().drops && kept < count)
        run.notify(fmt::format(
            "kept {} of {} points (efficiency {:.3g}): the others have no image "
            "under {}",
            kept, count, static_cast<double>(kept) / static_cast<double>(count), warps));
    if (kept == 0) fail(ErrorKind::input, "none of {} points has an image under {}", count, warps);
}

std::vector<std::string> files_of(const Schema& schema, const Values& values,
                                  std::span<const std::string> written) {
    std::vector<std::string> files;
    for (const Option& option : schema.options()) {
        const auto& item = values.find(option.name);
        const bool output = std::ranges::find(written, option.name) != written.end();
        if (!item.given || output) continue;
        if (option.type == "file") files.push_back(std::get<std::string>(item.value));
        if (option.unit == "generator" || option.unit == "warps")
            std::ranges::move(
                files_in(std::get<std::string>(item.value), "|", option.unit == "generator"),
                std::back_inserter(files));
    }
    return files;
}

std::vector<std::string> files_of(const Generator& generator, const Values& values,
                                  std::span<const Spec> warps) {
    auto files = files_of(generator.options, values, generator.writes);
    for (const Spec& spec : warps) {
        const Scramble* scramble = scramble_named(spec.name);
        const Schema& schema = scramble ? scramble->options : find_warp(spec.name).options;
        std::ranges::move(files_of(schema, spec.values(schema)), std::back_inserter(files));
    }
    return files;
}

std::vector<std::string> files_in(std::string_view specs, std::string_view separator,
                                  bool generators) {
    std::vector<std::string> files;
    for (const auto part : split_outside("[]", specs, separator)) {
        try {
            const Spec spec = parse_spec(part);
            const Schema& schema =
                generators ? find_generator(spec.name).options : find_warp(spec.name).options;
            std::ranges::move(files_of(schema, spec.values(schema)), std::back_inserter(files));
        } catch (const Error&) {  // reported where the spec is used; "unit-cube" is not a warp
        }
    }
    return files;
}

std::vector<std::pair<std::string, std::string>> fingerprints(std::span<const std::string> files,
                                                              const RunContext& run) {
    std::vector<std::pair<std::string, std::string>> all;
    for (const std::string& file : files) {
        // Does not read a pipe, which would use up its bytes. A missing file is reported later, by
        // its reader.
        const bool kept = is_regular_file(status_of(file));
        all.emplace_back(
            file, kept ? format_fingerprint(file_fingerprint(file, run)) : std::string(not_kept));
    }
    return all;
}

}  // namespace stipple
