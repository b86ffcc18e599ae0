// SPDX-License-Identifier: MIT
#include "pipeline/warping.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "io/columns.hpp"
#include "io/provenance.hpp"
#include "pipeline/chain.hpp"
#include "pipeline/pipeline.hpp"
#include "pipeline/units.hpp"

namespace stipple {
namespace {

/// Records a warp in the provenance of a set. If the set's numbers were truncated when written, the
/// truncation is recorded before it, as a step.
void record_warp(PointSet& set, const WarpChain& chain, bool inverse,
                 const std::vector<std::pair<std::string, std::string>>& inputs) {
    Provenance& meta = set.provenance;
    io::record_cuts(meta);
    const std::string warp = std::string(inverse ? inverse_of : "") + chain.record().specs.front();
    for (const auto& input : inputs)
        if (std::ranges::find(meta.inputs, input) == meta.inputs.end())
            meta.inputs.push_back(input);
    for (const auto& version : chain.record().stream_versions)
        if (std::ranges::find(meta.stream_versions, version) == meta.stream_versions.end())
            meta.stream_versions.push_back(version);
    meta.dimension = set.dimension();
    meta.count = set.count();
    meta.domain = set.domain->spec();
    meta.warps.push_back(warp);
}

/// The mapping of a warp, for as many coordinates as `spec` names, or `dimension` if it names none.
auto mapping_of(const Spec& spec, std::size_t dimension, const RunContext& run) {
    const Warp& warp = find_warp(spec.name);
    const std::size_t given = spec.coordinates.empty() ? dimension : spec.coordinates.size();
    return warp.make(spec.values(warp.options), given, run);
}

/// Numbers per row before a warp, if its images have rows of `after` numbers.
/// @throws Error(input) if the images have another dimension
std::size_t dimension_before(const Spec& spec, std::size_t after, const RunContext& run) {
    const auto mapping = mapping_of(spec, after, run);
    const std::size_t gives = mapping->domain()->dimension();
    if (gives > after || (spec.coordinates.empty() && gives != after))
        fail(ErrorKind::input, "the images of {} are points of {} numbers; these have {}",
             spec.name, gives, after);
    return after - gives + mapping->cube_dimension();
}

/// Numbers per row before an inverse, if its images have rows of `after` numbers.
std::size_t dimension_before_inverse(const Spec& spec, std::size_t after, const RunContext& run) {
    const auto mapping = mapping_of(spec, after, run);
    return after - mapping->cube_dimension() + mapping->domain()->dimension();
}

/// Whether all coordinates that are neither taken nor already warped are in the unit cube, as their
/// domain claims.
bool others_in_cube(const PointSet& points, std::span<const std::size_t> taken,
                    const std::vector<Factor>& warped) {
    std::vector<bool> known(points.dimension());
    for (const std::size_t k : taken) known[k] = true;
    for (const Factor& factor : warped)
        for (const std::size_t k : factor.coordinates) known[k] = true;
    for (std::size_t k = 0; k < known.size(); ++k)
        for (std::size_t i = 0; i < points.count() && !known[k]; ++i)
            if (!(points[i][k] >= 0 && points[i][k] <= 1)) return false;
    return true;
}

/// Checks that no other set follows in a text, if its number of sets was not known when output
/// began. @throws Error(input)
void refuse_second_set(io::PointStream& stream) {
    if (stream.sets() || !stream.next_set()) return;
    fail_with_hint(ErrorKind::input, "give each set in a file of its own",
                   "a second set begins in a text that is too large to be read as a whole");
}

/// A warp or its inverse, for points on a given domain.
struct Warping {
    /// Makes the chain and checks the target. @param densities whether the points have densities of
    /// their own
    Warping(const Spec& spec, bool back, const DomainPtr& on, const Target& target,
            const RunContext& run, const ChainSet& set = {}, bool densities = false)
        : inverse(back), taken(named_or_all(spec, on->dimension())) {
        const std::size_t d = on->dimension();
        if (inverse && !find_warp(spec.name).traits.invertible)
            fail(ErrorKind::usage, "--inverse: the warp {} has no inverse", spec.name);
        if (!inverse) before = warped_factors(on, taken);
        chain = std::make_shared<WarpChain>(
            std::span(&spec, 1), inverse ? dimension_before(spec, d, run) : d, set, run, before);
        if (densities) find_stretch(spec, set, run);
        if (inverse && target.columns.any() && !densities)
            fail(ErrorKind::usage,
                 "--with-{}: the inverse gives points of the unit cube, density 1",
                 target.columns.names().front());
        inputs = fingerprints(chain->record().files, run);
        cube = fmt::format("the unit cube [0, 1]^{}", taken.size());
        if (!spec.coordinates.empty()) cube += " in coordinates " + format_coordinates(taken);
    }

    /// Checks that rows of a stream are in the cube.
    /// @param first index of the first row
    /// @throws Error(input)
    void require_in_cube(std::span<const double> rows, std::size_t d, std::uint64_t first) const {
        for (std::size_t i = 0; i < rows.size(); i += d)
            if (const auto row = rows.subspan(i, d); !in_cube(row, taken))
                fail(ErrorKind::input, "point {} is outside {}: ({})", first + i / d, cube,
                     join(gather(row, d, taken), ", "));
    }

    /// Sets `stretch`, which changes densities: the warp without the domains of other coordinates.
    /// @throws Error(input) if the change is not known: the warp drops or reorders points
    void find_stretch(const Spec& spec, const ChainSet& set, const RunContext& run) {
        if (!inverse && (chain->traits().drops || chain->traits().needs_whole_set))
            fail_with_hint(ErrorKind::input,
                           "--column picks the coordinates, which are then taken to be uniform",
                           "the points have a column of densities; how the warp {} changes these "
                           "is not known, for it {}",
                           spec.name,
                           chain->traits().drops ? "leaves points out" : "reorders points");
        stretch = before.empty() ? chain
                                 : std::make_shared<WarpChain>(std::span(&spec, 1),
                                                               chain->dimension_in(), set, run);
    }

    /// Densities at the mapped points if the points have densities p: p / |J| or, for the inverse
    /// map, p |J|, where J is the Jacobian determinant of the warp.
    [[nodiscard]] std::vector<double> densities(const PointSet& from, const PointSet& to) const {
        auto factors = stretch->density((inverse ? from : to).flat());
        for (std::size_t i = 0; i < factors.size(); ++i)
            factors[i] = inverse ? from.densities[i] / factors[i] : from.densities[i] * factors[i];
        return factors;
    }

    bool inverse;
    std::vector<std::size_t> taken;  ///< coordinates of the warp; only these must be in the cube
    std::string cube;                ///< name of the cube in messages
    std::vector<Factor> before;      ///< domains of coordinates that are already warped
    std::shared_ptr<const WarpChain> chain;
    std::vector<std::pair<std::string, std::string>> inputs = {};
    std::shared_ptr<const WarpChain> stretch = {};  ///< the warp alone, to change densities
};

/// Image or preimage of a set, with updated provenance.
PointSet warped(const PointSet& set, const Warping& warping, const RunContext& run) {
    const auto& [inverse, taken, cube, before, chain, inputs, stretch] = warping;
    if (!inverse) require_in_cube(set, taken, cube);
    const bool said = inverse || others_in_cube(set, taken, before);
    PointSet image = inverse ? preimage_of(set, *chain, run) : image_of(set, *chain, run);
    record_warp(image, *chain, inverse, inputs);
    if (!said) image.provenance.domain.clear();
    if (!set.densities.empty()) image.densities = warping.densities(set, image);
    return image;
}

/// Reader of the images or preimages of a stream's points; rows of `wide` numbers.
NextRows warped_rows(io::PointStream& stream, const Warping& warping, std::size_t wide,
                     const RunContext& run) {
    return [&stream, &warping, wide, quiet = silent(run), taken = std::vector<double>(),
            came = std::uint64_t{0},
            kept = std::uint64_t{0}](std::span<double> rows) mutable -> std::size_t {
        const std::size_t d = stream.dimension();
        for (;;) {  // until a batch has points with an image
            taken.resize(rows.size() / wide * d);
            const std::size_t count = stream.read(taken);
            if (count == 0) break;
            const auto points = std::span(taken).first(count * d);
            if (!warping.inverse) warping.require_in_cube(points, d, came);
            const auto images = warping.chain->mapped(points, warping.inverse, came, quiet);
            std::ranges::copy(images, rows.begin());
            came += count;
            kept += images.size() / wide;
            if (!images.empty()) return images.size() / wide;
        }
        refuse_second_set(stream);
        if (!warping.inverse) tell_kept(*warping.chain, came, kept, quiet);
        return 0;
    };
}

/// Stream of sets that are read while they are written.
SetStream stream_of(io::PointStream& points, const DomainPtr& on) {
    const auto next = [&points](std::span<double> rows) {
        const std::size_t count = points.read(rows);
        if (count == 0) refuse_second_set(points);
        return count;
    };
    return {.sets = points.sets().value_or(1),
            .domain = on,
            .open =
                [&points, next](std::size_t, const RunContext&) {
                    points.next_set();
                    return OpenSet{.next = next};
                },
            .head =
                [&points](std::size_t first, std::size_t last) {
                    return SetsHead{.provenance = points.provenance(),
                                    .counts = Counts::equal(last - first, 0)};
                }};
}

}  // namespace

std::size_t dimension_before_step(std::string_view step, std::size_t after, const RunContext& run) {
    if (io::is_cut(step)) return after;
    const bool back = step.starts_with(inverse_of);
    const Spec spec = parse_spec(step.substr(back ? inverse_of.size() : 0));
    if (scramble_named(spec.name) != nullptr) return after;
    return back ? dimension_before_inverse(spec, after, run) : dimension_before(spec, after, run);
}

bool takes_whole_sets(const Spec& warp, std::size_t dimension, const RunContext& run) {
    return find_warp(warp.name).traits.needs_whole_set &&
           mapping_of(warp, dimension, run)->set_step();
}

std::vector<std::uint32_t> digit_bases(const Provenance& meta) {
    const Generator* generator = generator_named(meta.generator);
    if (generator == nullptr || !generator->bases || !meta.bounds.empty()) return {};
    const auto keeps_digits = [](const std::string& step) {
        return io::is_cut(step) ||
               (!step.starts_with(inverse_of) && scramble_named(parse_spec(step).name) != nullptr);
    };
    if (!std::ranges::all_of(meta.warps, keeps_digits)) return {};
    Values options = generator->options.defaults();
    const auto& known = generator->options.options();
    for (const auto& [name, text] : meta.options)
        if (std::ranges::find(known, name, &Option::name) != known.end())
            generator->options.set(options, name, text);
    return chain_set(*generator, {.count = meta.count, .dimension = meta.dimension}, options).bases;
}

PointSet warped_set(const PointSet& set, const Spec& warp, bool inverse, const RunContext& run) {
    const bool densities = !set.densities.empty();
    const ChainSet of{.count = set.count(), .bases = digit_bases(set.provenance)};
    Spec spec = warp;
    const auto has_seed = [](const auto& item) { return item.first == scramble_seed.name; };
    if (scramble_named(spec.name) != nullptr && std::ranges::none_of(spec.settings, has_seed))
        spec.settings.emplace_back(scramble_seed.name, std::to_string(of.seed));  // to be recorded
    return warped(set, Warping(spec, inverse, set.domain, {}, run, of, densities), run);
}

bool can_stream(const io::PointStream& stream, const Target& target) {
    const bool sets_known = stream.sets() || stream.looks_like_one_set();
    return sets_known && !stream.held() && !target.format->traits.counts_first && !target.meta &&
           !file_per_set(target.path);
}

void write_warped(Unwarped from, const Spec& warp, bool inverse, const Target& target,
                  const RunContext& run) {
    const bool densities = !from.stream && !from.sets.front().densities.empty();
    const Warping warping(warp, inverse, from.domain(), target, run, {}, densities);
    const WarpChain& chain = *warping.chain;
    if (!from.stream) {
        const Target wider = with_own_columns(target, from.sets.front());
        for (PointSet& set : from.sets) set = warped(set, warping, run);
        return write_sets(stream_of(from.sets, &chain), wider, run);
    }
    SetStream images = stream_of(*from.stream, from.on);
    images.domain = inverse ? domain_before(chain, from.on) : chain.domain();
    images.chain = &chain;
    images.open = [&](std::size_t, const RunContext&) {
        from.stream->next_set();
        return OpenSet{.next = warped_rows(*from.stream, warping, images.dimension(), run)};
    };
    images.head = [&, head = images.head](std::size_t first, std::size_t last) {
        SetsHead changed = head(first, last);
        Provenance& meta = changed.provenance;
        meta.columns = chain.names(std::move(meta.columns), inverse);
        if (!inverse) std::ranges::move(levels_of(chain), std::back_inserter(meta.levels));
        return changed;
    };
    write_sets(images, target, run);
}

void write_density_at(const Unwarped& at, const Spec& warp, Target target, const RunContext& run) {
    const DomainPtr& on = at.domain();
    const std::size_t d = dimension_before(warp, on->dimension(), run);
    auto chain = std::make_unique<WarpChain>(std::span(&warp, 1), d, ChainSet{}, run);
    // Coordinates that are not part of the warp's images keep their domains.
    auto others = warped_factors(domain_before(*chain, on), named_or_all(warp, d));
    if (!others.empty())
        chain =
            std::make_unique<WarpChain>(std::span(&warp, 1), d, ChainSet{}, run, std::move(others));
    target.columns = {.pdf = true, .anywhere = true};
    SetStream points = at.stream ? stream_of(*at.stream, on) : stream_of(at.sets);
    points.chain = chain.get();
    points.head = [head = points.head](std::size_t first, std::size_t last) {
        SetsHead known = head(first, last);
        known.provenance = io::without_making(known.provenance);
        return known;
    };
    write_sets(points, target, run);
}

void write_scrambled(const std::vector<PointSet>& sets, const Spec& scramble, std::uint64_t seed,
                     std::uint64_t replications, const Target& target, const RunContext& run) {
    if (replications * sets.size() - 1 > ~seed)
        fail(ErrorKind::usage, "--seed: {} and {} sets go beyond the 64 bits of a seed", seed,
             replications * sets.size());
    if (!sets.front().densities.empty())
        fail_with_hint(
            ErrorKind::input, "--column picks the coordinates, which are then taken to be uniform",
            "the points have a column of densities; scrambles are for points with density 1");
    const std::string& picked = sets.front().provenance.flaw;
    for (const Generator& generator : generators::all())
        if (generator.bases &&
            picked.find(fmt::format("generator: \"{}\"", generator.name)) != std::string::npos)
            run.notify(
                fmt::format("--column picked coordinates of {}; the base of their digits is "
                            "taken to be 2 unless base=B is given",
                            generator.name));
    const auto scrambled = [&](std::size_t set) {
        const PointSet& points = sets[set / replications];
        Spec spec = scramble;
        spec.settings.emplace_back(scramble_seed.name, std::to_string(seed + set));
        const Warping scrambling(
            spec, false, points.domain, {}, run,
            {.count = points.count(), .bases = digit_bases(points.provenance)});
        return warped(points, scrambling, run);
    };
    write_sets(stream_of(sets.size() * replications, scrambled, seed), target, run);
}

}  // namespace stipple
