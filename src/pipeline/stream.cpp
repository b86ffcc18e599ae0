// SPDX-License-Identifier: MIT
#include "pipeline/stream.hpp"

#include <algorithm>
#include <future>
#include <memory>
#include <utility>

#include "core/bytes/spool.hpp"
#include "core/parallel.hpp"
#include "io/columns.hpp"
#include "io/provenance.hpp"

namespace stipple {
namespace {

/// Reduces the metadata of several sets to what holds for all: removes options and results of
/// searches that differ, such as a radius computed for each set, and the way the sets were made
/// unless readers of the file find that of `other` from it and the set's place in the file.
void keep_common(Provenance& common, const Provenance& other, std::uint64_t place) {
    const auto keep_equal = [](auto& pairs, const auto& others) {
        std::erase_if(pairs, [&](const auto& pair) {
            return std::ranges::find(others, pair) == others.end();
        });
    };
    keep_equal(common.options, other.options);
    keep_equal(common.found, other.found);
    const std::uint64_t seed = io::seed_of_set(common, place);
    const bool seeded = seed != common.seed;  // else the seeds of scrambles in the warps differ
    if (other.generator != common.generator || other.command != common.command ||
        other.start != common.start || other.shard != common.shard ||
        (seeded && (other.seed != seed || other.warps != common.warps)))
        common = io::without_making(common);
    if (other.domain != common.domain) common.domain.clear();
}

using SetAt = std::function<const PointSet&(std::size_t set)>;

/// Stream of sets that at(set) returns.
/// @param one_at_a_time memory holds one set: each one replaces the previous set
SetStream in_memory(std::size_t sets, const SetAt& at, bool one_at_a_time, const WarpChain* chain) {
    const auto open = [at](std::size_t set, const RunContext&) {
        const PointSet& points = at(set);
        return OpenSet{.next = rows_of(points),
                       .count = points.count(),
                       .densities = points.densities,
                       .side_files = points.side_files};
    };
    const auto head = [=](std::size_t first, std::size_t last) {
        const PointSet& set = at(first);
        SetsHead all{.provenance = set.provenance};
        if (one_at_a_time && last - first > 1) {
            all.counts = Counts::equal(last - first, 0);
            return all;
        }
        all.extent = bounding_box(set.flat(), set.domain->bounding_box());
        for (std::size_t i = first; i < last; ++i) {
            all.counts.push_back(at(i).count());
            keep_common(all.provenance, at(i).provenance, i - first);
        }
        return all;
    };
    const std::size_t known = one_at_a_time ? 1 : sets;
    bool side_files = false;
    for (std::size_t set = 0; set < known; ++set) side_files |= !at(set).side_files.empty();
    return {.sets = sets,
            .domain = at(0).domain,
            .chain = chain,
            .open = open,
            .head = head,
            .seed = [at](std::size_t set) { return at(set).provenance.seed; },
            .one_at_a_time = one_at_a_time,
            .side_files = side_files};
}

}  // namespace

NextRows rows_of(const PointSet& points, std::uint64_t first) {
    const std::size_t d = points.dimension();
    return [rest = points.flat().subspan(static_cast<std::size_t>(first) * d),
            d](std::span<double> rows) mutable {
        const auto some = rest.first(std::min(rest.size(), rows.size() / d * d));
        std::ranges::copy(some, rows.begin());
        rest = rest.subspan(some.size());
        return some.size() / d;
    };
}

bool in_batches(const NextRows& next, std::size_t batch, std::size_t width, const RunContext& run,
                const std::function<bool(std::span<const double>)>& take) {
    constexpr std::size_t few = 65536;  // fewer numbers are not worth starting a thread
    std::vector<double> rows(batch * width);
    std::vector<double> ahead(rows.size());
    const auto policy = run.thread_count() > 1 && rows.size() > few
                            ? std::launch::async | std::launch::deferred
                            : std::launch::deferred;  // always allowed, in case no thread can start
    for (std::size_t count = next(rows); count > 0; rows.swap(ahead)) {
        run.check_stop();
        auto fetched = std::async(policy, [&] { return next(ahead); });
        if (!take(std::span(rows).first(count * width))) return false;
        count = fetched.get();
    }
    return true;
}

SetStream stream_of(const std::vector<PointSet>& sets, const WarpChain* chain) {
    const auto at = [&sets](std::size_t set) -> const PointSet& { return sets[set]; };
    return in_memory(sets.size(), at, false, chain);
}

SetStream stream_of(std::size_t sets, std::function<PointSet(std::size_t set)> make,
                    std::uint64_t seed, const WarpChain* chain) {
    struct Current {
        PointSet points;
        std::size_t set = 0;
    };
    const auto current = std::make_shared<Current>(Current{make(0), 0});
    const auto at = [current, make = std::move(make)](std::size_t set) -> const PointSet& {
        if (set != current->set) *current = {make(set), set};
        return current->points;
    };
    SetStream stream = in_memory(sets, at, true, chain);
    stream.seed = [seed](std::size_t set) { return seed + set; };
    return stream;
}

SetStream waiting(const SetStream& made, const RunContext& run,
                  const std::function<void(const std::vector<SideFile>&)>& take) {
    struct OnDisk {
        Spool spool;
        SetsHead head;
    };
    const auto kept = std::make_shared<OnDisk>();
    SetsHead& all = kept->head;
    const std::size_t d = made.dimension();
    std::vector<double> rows(std::max<std::size_t>(1, 8192 / d) * d);
    for (std::size_t set = 0; set < made.sets; ++set) {
        const Provenance provenance = made.head(set, set + 1).provenance;
        if (set == 0) all.provenance = provenance;
        keep_common(all.provenance, provenance, set);
        const OpenSet open = made.open(set, run);
        all.counts.push_back(open.count);
        take(open.side_files);
        while (const std::size_t count = open.next(rows)) {
            const auto bytes = std::as_bytes(std::span(rows).first(count * d));
            kept->spool.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
        }
    }
    kept->spool.rewind();
    SetStream stream = made;
    stream.one_at_a_time = false;
    stream.head = [kept](std::size_t, std::size_t) { return kept->head; };
    stream.open = [kept, d](std::size_t set, const RunContext&) {
        const std::uint64_t count = kept->head.counts[set];
        const auto next = [kept, d, left = count](std::span<double> into) mutable {
            const auto some =
                static_cast<std::size_t>(std::min<std::uint64_t>(left, into.size() / d));
            const auto bytes = std::as_writable_bytes(into.first(some * d));
            kept->spool.read({reinterpret_cast<char*>(bytes.data()), bytes.size()});
            left -= some;
            return some;
        };
        return OpenSet{.next = next, .count = count};
    };
    return stream;
}

RunContext part_of_run(const RunContext& run, std::size_t set, std::size_t sets) {
    const auto all = static_cast<double>(sets);
    return run.stage(static_cast<double>(set) / all, static_cast<double>(set + 1) / all);
}

}  // namespace stipple
