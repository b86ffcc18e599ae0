// SPDX-License-Identifier: MIT
#include "pipeline/produce.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/machine/int128.hpp"
#include "core/parallel.hpp"
#include "generators/density_options.hpp"
#include "io/carried_meta.hpp"
#include "media/png_picture.hpp"

namespace stipple {
namespace {

/// A job, with the data that all its sets share.
class Producer {
  public:
    Producer(const SetsToMake& job, const Target& target, const RunContext& run)
        : job_(job),
          generator_(*job.generator),
          target_(target),
          run_(run),
          // Only the first shard gives warnings.
          sets_(job, job.shard.index == 0 ? run : unwarned(run)) {
        if (job_.shard.of > 1 && job_.sets > 1)
            fail(ErrorKind::usage,
                 "--shard divides one set; use --seed to choose which, instead of --sets");
        if (job_.shard.of > 1 && sets_.chain().traits().needs_whole_set)
            fail(ErrorKind::usage,
                 "--shard: the parameters of a whole set are reordered; make all points at once");
        check_columns();
        check_side_files();
    }

    /// Returns whether the points are the best of a search that was stopped.
    bool go() {
        if (sets_.streamed()) {
            stream();
            return false;
        }
        const auto make = [this](std::size_t set) { return made(set); };
        write_sets(stream_of(job_.sets, make, sets_.plan().seed, &sets_.chain()), target_, run_);
        return stopped_;
    }

  private:
    /// Refuses columns of densities if an option makes the density of the points unknown.
    void check_columns() const {
        const char* shaped = shaping_option(job_.options);
        if (!target_.columns.any() || shaped == nullptr) return;
        fail_with_hint(ErrorKind::usage, "'generate random -w image:file=...' has exact densities",
                       "--with-{}: the density of points made with --{} is not known",
                       target_.columns.names().front(), shaped);
    }

    /// Checks that side files overwrite neither each other nor the points.
    void check_side_files() const {
        const std::uint64_t seed = sets_.plan().seed;
        for (const std::string& option : generator_.writes) {
            const auto& item = job_.options.find(option);
            const auto& known = generator_.options.options();
            const bool file = std::ranges::find(known, option, &Option::name)->type == "file";
            if (!item.given || !file) continue;
            const auto& path = std::get<std::string>(item.value);
            // The sets of a sequence share one side file.
            if (job_.sets > 1 && !generator_.traits.sequence && !file_per_set(path))
                fail(ErrorKind::usage, "--{}: {} sets need a name with {{set}} or {{seed}}", option,
                     job_.sets);
            if (path_of_set(path, 0, seed) == path_of_set(target_.path, 0, seed))
                fail(ErrorKind::usage,
                     "--{}: '{}' is already the output for the points; name another file", option,
                     path);
        }
    }

    /// Returns the shard's range of rows [first, last) among `count`.
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
        const auto open = [&, first = first, last = last](std::size_t set, const RunContext& part) {
            OpenSet begun{.next = sets_.stream(set, part, first, last), .count = count};
            if (set + 1 == job_.sets) begun.side_files = sets_.side_files();
            return begun;
        };
        const auto head = [&](std::size_t set, std::size_t end) {
            return SetsHead{.provenance = signed_by(sets_.provenance(set, count)),
                            .counts = Counts::equal(end - set, count)};
        };
        write_sets({.sets = job_.sets,
                    .domain = sets_.domain(),
                    .chain = &sets_.chain(),
                    .open = open,
                    .head = head,
                    .seed = [&](std::size_t set) { return sets_.plan().seed + set; },
                    .starts = true},
                   target_, run);
        if (job_.shard.index == 0) tell_found();
    }

    /// Reports the generating vector that a search for a lattice found, and its figure of merit.
    void tell_found() const {
        const auto found = sets_.provenance(0, 0).found;
        if (target_.take || found.empty() || found[0].first != "vector") return;
        const bool known = found.size() > 1;
        run_.notify(fmt::format(
            "{}: found generating vector {}, figure of merit {} (squared worst-case error{})",
            generator_.name, found[0].second,
            known ? found[1].second : "beyond the range of numbers",
            known && found.back().first != "squared_error" ? " of all points of the lattice" : ""));
    }

    /// Makes one set in memory: generates and warps it, and cuts out the shard.
    [[nodiscard]] PointSet made(std::size_t set) {
        RunContext run = part_of_run(run_, set, job_.sets);
        if (job_.sets > 1) run.note = nullptr;  // notes on a set would hide the total time left
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
        stopped_ = was_interrupted(points.provenance);
        return points;
    }

    /// Stores the provenance of the points in the PNG pictures among their side files.
    void sign_pictures(PointSet& points) const {
        for (std::size_t i = 0; i < points.side_files.size() && i < generator_.writes.size(); ++i) {
            std::string& bytes = points.side_files[i].bytes;
            if (bytes.starts_with(png_magic))
                bytes = io::png_with_meta(
                    bytes, {.of = generator_.writes[i], .provenance = points.provenance});
        }
    }

    /// Adds the command line and the shard to the provenance of a set.
    [[nodiscard]] Provenance signed_by(Provenance meta) const {
        meta.command = job_.command;
        if (job_.shard.of > 1) meta.shard = fmt::format("{}/{}", job_.shard.index, job_.shard.of);
        return meta;
    }

    const SetsToMake& job_;
    const Generator& generator_;
    const Target& target_;
    const RunContext& run_;
    GeneratedSets sets_;
    bool stopped_ = false;
};

}  // namespace

bool produce(const SetsToMake& job, const Target& target, const RunContext& run) {
    return Producer(job, target, run).go();
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
    write_sets(stream_of(sets), with_own_columns(target, sets.front()), run);
}

}  // namespace stipple
