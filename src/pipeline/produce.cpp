// SPDX-License-Identifier: MIT
#include "pipeline/produce.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

#include "core/bytes/spool.hpp"
#include "core/error.hpp"
#include "core/machine/int128.hpp"
#include "core/parallel.hpp"
#include "generators/density_options.hpp"
#include "io/carried_meta.hpp"
#include "io/output.hpp"
#include "media/png_picture.hpp"
#include "pipeline/chain.hpp"
#include "pipeline/generated.hpp"
#include "pipeline/pipeline.hpp"
#include "pipeline/units.hpp"

namespace stipple {
namespace {

/// What a file of several sets tells of them: their provenance, less the options that are not the
/// same for all, such as a radius that was worked out for each.
void keep_common(Provenance& common, const Provenance& other) {
    std::erase_if(common.options, [&](const auto& option) {
        return std::ranges::find(other.options, option) == other.options.end();
    });
}

void write_side_files(const std::vector<SideFile>& files, const Target& target,
                      io::Outputs& outputs, const RunContext& run) {
    for (const SideFile& file : files)
        if (!target.take) outputs.add(file.path, run.stop).write(file.bytes);
}

/// Makes the sets of a job, each once and in order.
using MakeSet = std::function<PointSet(std::size_t set)>;

/// Sets that are written when all of them are made, for what comes before the first tells of all.
/// Meanwhile they are on disk.
class WaitingSets {
  public:
    void add(const PointSet& set) {
        if (counts_.size() == 0) common_ = set.provenance;
        keep_common(common_, set.provenance);
        counts_.push_back(set.count());
        const auto bytes = std::as_bytes(set.flat());
        spool_.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    }

    void write(SetsToWrite job, const Target& target, io::Outputs& outputs, const RunContext& run) {
        spool_.rewind();
        const std::size_t d = job.dimension();
        job.source = [&](std::size_t set, const RunContext&) -> NextRows {
            return [this, d, left = counts_[set]](std::span<double> rows) mutable {
                const auto some =
                    static_cast<std::size_t>(std::min<std::uint64_t>(left, rows.size() / d));
                const auto bytes = std::as_writable_bytes(rows.first(some * d));
                spool_.read({reinterpret_cast<char*>(bytes.data()), bytes.size()});
                left -= some;
                return some;
            };
        };
        job.provenance = [&](std::size_t) { return common_; };
        job.counts = counts_;
        write_files(job, target, outputs, run);
    }

  private:
    Spool spool_;
    Counts counts_;
    Provenance common_;
};

/// The rows of a set, each with the density of its point.
NextRows rows_with_densities(const PointSet& points) {
    return [&points, next = std::size_t{0}](std::span<double> rows) mutable {
        const std::size_t d = points.dimension();
        const std::size_t some = std::min(points.count() - next, rows.size() / (d + 1));
        for (std::size_t i = 0; i < some; ++i, ++next) {
            std::ranges::copy(points[next], rows.subspan(i * (d + 1), d).begin());
            rows[i * (d + 1) + d] = points.densities[next];
        }
        return some;
    };
}

/// Writes sets as they are, and their side files; `chain` is what gave them, for their density,
/// unless they tell it themselves.
void write_images(const std::vector<PointSet>& images, const WarpChain& chain,
                  std::size_t first_set, std::optional<std::uint64_t> first_seed,
                  const Target& target, io::Outputs& outputs, const RunContext& run) {
    const bool together = !file_per_set(target.path);
    const bool densities = target.columns.any() && !images.front().densities.empty();
    Provenance common = images.front().provenance;
    SetsToWrite job{
        .sets = images.size(),
        .first_set = first_set,
        .domain = images.front().domain,
        .chain = &chain,
        .source =
            [&](std::size_t set, const RunContext&) {
                return densities ? rows_with_densities(images[set]) : rows_of(images[set]);
            },
        .provenance = [&](std::size_t set) { return together ? common : images[set].provenance; },
        .first_seed = first_seed,
        .extent =
            [&](std::size_t set) {
                return bounding_box(images[set].flat(), images[set].domain->bounding_box());
            },
        .counts = {},
        .densities = densities};
    for (const PointSet& set : images) {
        job.counts.push_back(set.count());
        keep_common(common, set.provenance);
        write_side_files(set.side_files, target, outputs, run);
    }
    write_files(job, target, outputs, run);
}

/// The run for writing points: of a search that was stopped and has kept its best it goes on.
RunContext run_for_writing(const PointSet& points, const RunContext& run) {
    const bool kept = std::ranges::count(points.provenance.found,
                                         std::pair<std::string, std::string>(interrupted)) > 0;
    return kept ? unstopped(run) : run;
}

/// Makes and writes sets, in the memory of one.
/// @param chain what gave them, for their density @param first_seed of the first one's name, those
/// of the next go up; none: as their provenance says
void write_made(std::size_t sets, const MakeSet& make, const WarpChain& chain,
                std::optional<std::uint64_t> first_seed, const Target& target,
                const RunContext& run) {
    io::Outputs outputs;
    std::vector<PointSet> held{make(0)};
    SetsToWrite job{.sets = sets, .domain = held[0].domain, .chain = &chain};
    const FormatTraits& traits = format_of(target).traits;
    if (sets == 1 || file_per_set(target.path)) {
        for (std::size_t set = 0; set < sets; ++set) {
            if (set > 0) held[0] = make(set);
            const auto seed = first_seed ? std::optional(*first_seed + set) : std::nullopt;
            write_images(held, chain, set, seed, target, outputs,
                         run_for_writing(held[0], part_of_run(run, set, sets)));
        }
    } else if (traits.counts_first || traits.equal_sets || target.meta || target.take ||
               !held[0].side_files.empty()) {
        WaitingSets waiting;
        for (std::size_t set = 0; set < sets; ++set) {
            if (set > 0) held[0] = make(set);
            write_side_files(held[0].side_files, target, outputs, run);
            waiting.add(held[0]);
        }
        held.clear();
        waiting.write(std::move(job), target, outputs, run);
    } else {
        job.provenance = [&](std::size_t) { return held[0].provenance; };
        job.source = [&](std::size_t set, const RunContext&) {
            if (set > 0) held[0] = make(set);
            return rows_of(held[0]);
        };
        job.counts = Counts::equal(sets, 0);
        job.expected = held[0].count();
        write_files(job, target, outputs, run);
    }
    outputs.commit();
}

/// Writes sets that are there, and nothing else.
void write_all(const std::vector<PointSet>& sets, const WarpChain& chain, const Target& target,
               const RunContext& run) {
    io::Outputs outputs;
    write_images(sets, chain, 0, {}, target, outputs, run);
    outputs.commit();
}

/// Writes down that the set went through a warp. What was cut in writing was so before it.
void record_warp(PointSet& set, const WarpChain& chain, bool inverse,
                 const std::vector<std::pair<std::string, std::string>>& inputs) {
    Provenance& meta = set.provenance;
    if (meta.single) meta.warps.emplace_back(cut_to_single);
    if (meta.precision) meta.warps.push_back(fmt::format("{}{}", cut_to_digits, *meta.precision));
    meta.single = false;
    meta.precision.reset();
    const std::string warp = (inverse ? "inverse " : "") + chain.specs().front();
    for (const auto& input : inputs)
        if (std::ranges::find(meta.inputs, input) == meta.inputs.end())
            meta.inputs.push_back(input);
    for (const auto& version : chain.stream_versions())
        if (std::ranges::find(meta.stream_versions, version) == meta.stream_versions.end())
            meta.stream_versions.push_back(version);
    meta.dimension = set.dimension();
    meta.count = set.count();
    meta.domain = set.domain->spec();
    meta.warps.push_back(warp);
}

/// Numbers of a row that the warp makes into one of `after` numbers.
std::size_t dimension_before(const Spec& spec, std::size_t after, const RunContext& run) {
    const Warp& warp = find_warp(spec.name);
    const std::size_t given = spec.coordinates.empty() ? after : spec.coordinates.size();
    const auto mapping = warp.make(spec.values(warp.options), given, run);
    const std::size_t gives = mapping->domain()->dimension();
    if (gives > after || (spec.coordinates.empty() && gives != after))
        fail(ErrorKind::input, "the images of {} are points of {} numbers; these have {}",
             spec.name, gives, after);
    return after - gives + mapping->cube_dimension();
}

/// Whether all coordinates that are neither taken nor warped before are in the unit cube, on which
/// they are said to be.
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

/// A text whose number of sets was not known when the first was begun must have no more.
void refuse_second_set(io::PointStream& stream) {
    if (stream.sets() || !stream.next_set()) return;
    fail_with_hint(ErrorKind::input, "give each set in a file of its own",
                   "a second set begins in a text that is too large to be read as a whole");
}

/// A warp, or the way back through it, for points on a domain.
struct Warping {
    /// @param densities whether points tell their own
    Warping(const Spec& spec, bool back, const DomainPtr& on, const Target& target,
            const RunContext& run, const ChainSet& set = {}, bool densities = false)
        : inverse(back), taken(named_or_all(spec, on->dimension())) {
        const std::size_t d = on->dimension();
        if (inverse && !find_warp(spec.name).traits.invertible)
            fail(ErrorKind::usage, "--inverse: the warp {} has no inverse", spec.name);
        if (!inverse) before = warped_factors(on, taken, run);
        chain = std::make_shared<WarpChain>(
            std::span(&spec, 1), inverse ? dimension_before(spec, d, run) : d, set, run, before);
        if (densities) find_stretch(spec, set, run);
        if (inverse && target.columns.any() && !densities)
            fail(ErrorKind::usage,
                 "--with-{}: the inverse gives points of the unit cube, density 1",
                 target.columns.names().front());
        inputs = fingerprints(chain->files(), run);
        cube = fmt::format("the unit cube [0, 1]^{}", taken.size());
        if (!spec.coordinates.empty()) cube += " in coordinates " + format_coordinates(taken);
    }

    /// The points of a stream before these are in the cube; so must these be.
    void require_in_cube(std::span<const double> rows, std::size_t d, std::uint64_t first) const {
        for (std::size_t i = 0; i < rows.size(); i += d)
            if (const auto row = rows.subspan(i, d); !in_cube(row, taken))
                fail(ErrorKind::input, "point {} is outside {}: ({})", first + i / d, cube,
                     fmt::join(gather(row, d, taken), ", "));
    }

    /// The warp alone, without what points are on besides the unit cube.
    void find_stretch(const Spec& spec, const ChainSet& set, const RunContext& run) {
        if (!inverse && (chain->drops() || chain->reorders()))
            fail_with_hint(ErrorKind::input,
                           "--column picks the coordinates, which are then taken to be uniform",
                           "the points have a column of densities; how the warp {} changes these "
                           "is not known, for it {}",
                           spec.name, chain->drops() ? "leaves points out" : "reorders points");
        stretch = before.empty() ? chain
                                 : std::make_shared<WarpChain>(std::span(&spec, 1),
                                                               chain->dimension_in(), set, run);
    }

    /// Densities of the images of points that tell their own: p / |J|, on the way back p |J|.
    [[nodiscard]] std::vector<double> densities(const PointSet& from, const PointSet& to) const {
        auto factors = stretch->density((inverse ? from : to).flat());
        for (std::size_t i = 0; i < factors.size(); ++i)
            factors[i] = inverse ? from.densities[i] / factors[i] : from.densities[i] * factors[i];
        return factors;
    }

    bool inverse;
    std::vector<std::size_t> taken;  ///< coordinates; no others need be in the unit cube
    std::string cube;                ///< of these, for messages
    std::vector<Factor> before;      ///< what the points are on besides the unit cube
    std::shared_ptr<const WarpChain> chain;
    std::vector<std::pair<std::string, std::string>> inputs = {};
    std::shared_ptr<const WarpChain> stretch = {};  ///< what densities are divided by
};

/// Bases of the digits of points that a generator made, and scrambles alone have changed; empty: 2,
/// or not known.
std::vector<std::uint32_t> digit_bases(const Provenance& meta) {
    const Generator* generator = generator_named(meta.generator);
    if (generator == nullptr || !generator->bases || !meta.bounds.empty()) return {};
    const auto keeps_digits = [](const std::string& step) {
        return step == cut_to_single || step.starts_with(cut_to_digits) ||
               (!step.starts_with("inverse ") && scramble_named(parse_spec(step).name) != nullptr);
    };
    if (!std::ranges::all_of(meta.warps, keeps_digits)) return {};
    Values options = generator->options.defaults();
    const auto& known = generator->options.options();
    for (const auto& [name, text] : meta.options)
        if (std::ranges::find(known, name, &Option::name) != known.end())
            generator->options.set(options, name, text);
    return generator->bases({.count = meta.count, .dimension = meta.dimension}, options);
}

/// The image of a set, as its provenance tells it.
PointSet warped(const PointSet& set, const Warping& warping, const RunContext& run) {
    const auto& [inverse, taken, cube, before, chain, inputs, stretch] = warping;
    if (!inverse) require_in_cube(set, taken, cube);
    const bool said = inverse || others_in_cube(set, taken, before);
    PointSet image = inverse ? chain->preimage(set, run) : chain->image(set, run);
    record_warp(image, *chain, inverse, inputs);
    if (!said) image.provenance.domain.clear();
    if (!set.densities.empty()) image.densities = warping.densities(set, image);
    return image;
}

/// What writes the density of a warp's images at points that are, where the warp does not ask for
/// their coordinates, on what they are said to be on.
struct DensityAt {
    DensityAt(const Spec& warp, const DomainPtr& on, Target to, const RunContext& run)
        : target(std::move(to)) {
        const std::size_t d = dimension_before(warp, on->dimension(), run);
        chain = std::make_shared<WarpChain>(std::span(&warp, 1), d, ChainSet{}, run);
        auto others = warped_factors(chain->domain_before(on, run), named_or_all(warp, d), run);
        if (!others.empty())
            chain = std::make_shared<WarpChain>(std::span(&warp, 1), d, ChainSet{}, run,
                                                std::move(others));
        target.columns = {.pdf = true, .anywhere = true};
    }

    std::shared_ptr<const WarpChain> chain;
    Target target;
};

/// What is known of points that have a column which nothing of their making tells of.
Provenance without_making(const Provenance& meta) {
    Provenance known;
    known.columns = meta.columns;
    known.levels = meta.levels;
    known.count = meta.count;
    known.dimension = meta.dimension;
    known.domain = meta.domain;
    return known;
}

/// The images of the points of a stream, each of `wide` numbers.
NextRows warped_rows(io::PointStream& stream, const Warping& warping, std::size_t wide,
                     const RunContext& run) {
    return [&stream, &warping, wide, quiet = silent(run), taken = std::vector<double>(),
            came = std::uint64_t{0},
            kept = std::uint64_t{0}](std::span<double> rows) mutable -> std::size_t {
        const std::size_t d = stream.dimension();
        for (;;) {  // until some have an image
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
        if (!warping.inverse) warping.chain->tell_kept(came, kept, quiet);
        return 0;
    };
}

/// The run, its notes left to another part of the set.
RunContext untold(RunContext run) {
    run.warn = {};
    return run;
}

/// Everything about a production that is the same for all its sets.
class Producer {
  public:
    Producer(const Production& job, const Target& target, const RunContext& run)
        : job_(job),
          generator_(*job.generator),
          target_(target),
          run_(run),
          sets_(job, job.shard.index == 0 ? run : untold(run)) {
        if (job_.shard.of > 1 && job_.sets > 1)
            fail(ErrorKind::usage, "--shard and --sets: parts are of one set; choose it by --seed");
        if (job_.shard.of > 1 && sets_.chain().reorders())
            fail(ErrorKind::usage,
                 "--shard: the parameters of a whole set are reordered; make all points at once");
        check_columns();
        check_side_files();
    }

    void go() {
        if (sets_.streamed()) return stream();
        write_made(
            job_.sets, [this](std::size_t set) { return made(set); }, sets_.chain(), {}, target_,
            run_);
    }

  private:
    /// Columns of densities must be right.
    void check_columns() const {
        const char* shaped = shaping_option(job_.options);
        if (!target_.columns.any() || shaped == nullptr) return;
        fail_with_hint(ErrorKind::usage,
                       "'generate random -w image:file=...' tells densities for certain",
                       "--with-{}: the density of points made with --{} is not known",
                       target_.columns.names().front(), shaped);
    }

    /// Side files must not replace each other, nor the points.
    void check_side_files() const {
        const std::uint64_t seed = sets_.plan().seed;
        for (const std::string& option : generator_.writes) {
            const auto& item = job_.options.find(option);
            const auto& known = generator_.options.options();
            const bool file = std::ranges::find(known, option, &Option::name)->type == "file";
            if (!item.given || !file) continue;
            const auto& path = std::get<std::string>(item.value);
            // All sets of a sequence have one such file.
            if (job_.sets > 1 && !generator_.traits.sequence && !file_per_set(path))
                fail(ErrorKind::usage, "--{}: {} sets need a name with {{set}} or {{seed}}", option,
                     job_.sets);
            if (path_of_set(path, 0, seed) == path_of_set(target_.path, 0, seed))
                fail(ErrorKind::usage, "--{}: '{}' is where the points go; name another file",
                     option, path);
        }
    }

    /// The shard's rows [first, last) of `count`.
    [[nodiscard]] std::pair<std::uint64_t, std::uint64_t> part(std::uint64_t count) const {
        const auto cut = [&](std::uint64_t index) {
            return static_cast<std::uint64_t>(Uint128{count} * index / job_.shard.of);
        };
        const auto first = cut(job_.shard.index);
        const auto last = cut(job_.shard.index + 1);
        if (first == last)
            fail(ErrorKind::usage, "--shard: part {}/{} of {} points is empty", job_.shard.index,
                 job_.shard.of, count);
        return {first, last};
    }

    void stream() {
        const auto [first, last] = part(sets_.plan().count);
        const std::uint64_t count = last - first;
        const RunContext run = run_.rising();
        sets_.prepare(run);
        if (job_.shard.index == 0) sets_.tell_absent_levels(run);
        io::Outputs outputs;
        write_files(
            {.sets = job_.sets,
             .domain = sets_.domain(),
             .chain = &sets_.chain(),
             .source = [&, first = first, last = last](
                           std::size_t set,
                           const RunContext& part) { return sets_.stream(set, part, first, last); },
             .provenance = [&](std::size_t set) { return signed_by(sets_.provenance(set, count)); },
             .first_seed = sets_.plan().seed,
             .counts = Counts::equal(job_.sets, count),
             .starts = true},
            target_, outputs, run);
        write_side_files(sets_.side_files(), target_, outputs, run);
        outputs.commit();
    }

    /// One set, made, warped and cut in memory.
    [[nodiscard]] PointSet made(std::size_t set) const {
        RunContext run = part_of_run(run_, set, job_.sets);
        run.keeps_best = job_.sets == 1 && target_.path != "-" && !target_.take;
        PointSet points = sets_.made(set, run);
        const auto [first, last] = part(points.count());
        if (job_.shard.of > 1) {
            const std::size_t d = points.dimension();
            const auto rows = points.flat().subspan(first * d, (last - first) * d);
            PointSet shard(std::vector<double>(rows.begin(), rows.end()), d);
            shard.domain = std::move(points.domain);
            shard.provenance = std::move(points.provenance);
            shard.side_files = std::move(points.side_files);
            points = std::move(shard);
        }
        points.provenance.count = points.count();
        points.provenance = signed_by(std::move(points.provenance));
        for (SideFile& file : points.side_files)
            file.path = path_of_set(std::move(file.path), set, points.provenance.seed);
        sign_pictures(points);
        return points;
    }

    /// Pictures that come with the points tell where they are from.
    void sign_pictures(PointSet& points) const {
        for (std::size_t i = 0; i < points.side_files.size() && i < generator_.writes.size(); ++i) {
            std::string& bytes = points.side_files[i].bytes;
            if (bytes.starts_with(png_magic))
                bytes = io::png_with_meta(
                    bytes, {.of = generator_.writes[i], .provenance = points.provenance});
        }
    }

    /// The provenance with what the command adds to that of a set.
    [[nodiscard]] Provenance signed_by(Provenance meta) const {
        meta.command = job_.command;
        if (job_.shard.of > 1) meta.shard = fmt::format("{}/{}", job_.shard.index, job_.shard.of);
        return meta;
    }

    const Production& job_;
    const Generator& generator_;
    const Target& target_;
    const RunContext& run_;
    GeneratedSets sets_;
};

}  // namespace

void produce(const Production& production, const Target& target, const RunContext& run) {
    Producer(production, target, run).go();
}

void write_sets(std::vector<PointSet> sets, const Target& target, const RunContext& run) {
    if (sets.empty()) fail(ErrorKind::input, "there are no points to write");
    const std::size_t d = sets.front().dimension();
    for (std::size_t i = 0; i < sets.size(); ++i) {
        if (sets[i].count() == 0) fail(ErrorKind::input, "set {} has no points to write", i);
        if (sets[i].dimension() != d)
            fail(ErrorKind::input, "set {} has points of {} coordinates; those before have {}", i,
                 sets[i].dimension(), d);
        if (!sets[i].domain) sets[i].domain = unit_cube(d);
    }
    write_all(sets, WarpChain({}, d), target, run);
}

bool takes_whole_sets(const Spec& warp, std::size_t dimension, const RunContext& run) {
    const Warp& unit = find_warp(warp.name);
    const std::size_t given = warp.coordinates.empty() ? dimension : warp.coordinates.size();
    return unit.traits.reorders && unit.make(warp.values(unit.options), given, run)->reorders();
}

PointSet warped_set(const PointSet& set, const Spec& warp, bool inverse, const RunContext& run) {
    const bool densities = !set.densities.empty();
    const ChainSet of{.bases = digit_bases(set.provenance)};
    return warped(set, Warping(warp, inverse, set.domain, {}, run, of, densities), run);
}

void write_warped(std::vector<PointSet> sets, const Spec& warp, bool inverse, const Target& target,
                  const RunContext& run) {
    const bool densities = !sets.front().densities.empty();
    const Warping warping(warp, inverse, sets.front().domain, target, run, {}, densities);
    Target wider = target;
    if (densities) {
        const std::string& column = sets.front().provenance.density_column;
        wider.columns.pdf |= column.find("pdf") != std::string::npos;
        wider.columns.weight |= column.find("weight") != std::string::npos;
    }
    for (PointSet& set : sets) set = warped(set, warping, run);
    write_all(sets, *warping.chain, wider, run);
}

bool can_stream(const io::PointStream& stream, const Target& target) {
    const bool sets_known = stream.sets() || stream.looks_like_one_set();
    return sets_known && !stream.held() && !target.format->traits.counts_first && !target.meta &&
           !file_per_set(target.path);
}

void write_warped(io::PointStream& stream, const DomainPtr& on, const Spec& warp, bool inverse,
                  const Target& target, const RunContext& run) {
    const Warping warping(warp, inverse, on, target, run);
    const auto& chain = warping.chain;
    const std::size_t wide = inverse ? chain->dimension_in() : chain->dimension_out();
    const std::size_t sets = stream.sets().value_or(1);
    write_files({.sets = sets,
                 .domain = inverse ? chain->domain_before(on, run) : chain->domain(),
                 .chain = chain.get(),
                 .source =
                     [&](std::size_t /*set*/, const RunContext&) {
                         stream.next_set();
                         return warped_rows(stream, warping, wide, run);
                     },
                 .provenance =
                     [&](std::size_t) {
                         Provenance meta = stream.provenance();
                         meta.columns = chain->names(std::move(meta.columns), inverse);
                         if (!inverse)
                             std::ranges::move(chain->levels(), std::back_inserter(meta.levels));
                         return meta;
                     },
                 .counts = Counts::equal(sets, 0)},
                target, run);
}

void write_density_at(std::vector<PointSet> sets, const Spec& warp, const Target& target,
                      const RunContext& run) {
    const DensityAt at(warp, sets.front().domain, target, run);
    for (PointSet& set : sets) set.provenance = without_making(set.provenance);
    write_all(sets, *at.chain, at.target, run);
}

void write_density_at(io::PointStream& stream, const DomainPtr& on, const Spec& warp,
                      const Target& target, const RunContext& run) {
    const DensityAt at(warp, on, target, run);
    const std::size_t sets = stream.sets().value_or(1);
    const auto next = [&stream](std::span<double> rows) {
        const std::size_t count = stream.read(rows);
        if (count == 0) refuse_second_set(stream);
        return count;
    };
    write_files({.sets = sets,
                 .domain = on,
                 .chain = at.chain.get(),
                 .source =
                     [&](std::size_t /*set*/, const RunContext&) {
                         stream.next_set();
                         return next;
                     },
                 .provenance = [&](std::size_t) { return without_making(stream.provenance()); },
                 .counts = Counts::equal(sets, 0)},
                at.target, run);
}

void write_scrambled(const std::vector<PointSet>& sets, const Spec& scramble, std::uint64_t seed,
                     std::uint64_t replications, const Target& target, const RunContext& run) {
    if (replications * sets.size() - 1 > ~seed)
        fail(ErrorKind::usage, "--seed: {} and {} sets go beyond the 64 bits of a seed", seed,
             replications * sets.size());
    if (!sets.front().densities.empty())
        fail_with_hint(ErrorKind::input,
                       "--column picks the coordinates, which are then taken to be uniform",
                       "the points have a column of densities; a scramble keeps no density but 1");
    const auto scrambled = [&](std::size_t set) {
        const PointSet& points = sets[set / replications];
        Spec spec = scramble;
        spec.settings.emplace_back(scramble_seed.name, std::to_string(seed + set));
        const Warping scrambling(
            spec, false, points.domain, {}, run,
            {.count = points.count(), .bases = digit_bases(points.provenance)});
        return warped(points, scrambling, run);
    };
    const WarpChain nothing({}, sets.front().dimension());
    write_made(sets.size() * replications, scrambled, nothing, seed, target, run);
}

}  // namespace stipple
