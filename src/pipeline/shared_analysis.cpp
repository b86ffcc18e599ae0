// SPDX-License-Identifier: MIT
#include "pipeline/shared_analysis.hpp"

#include <algorithm>
#include <array>
#include <exception>
#include <utility>

#include "core/bytes/file_bytes.hpp"
#include "core/bytes/fingerprint.hpp"
#include "core/bytes/packed.hpp"
#include "core/error.hpp"
#include "io/feed.hpp"
#include "io/source_text.hpp"

namespace stipple {
namespace {

/// The points [first, last) of a set.
struct Stretch {
    std::uint64_t first = 0;
    std::uint64_t last = 0;
};

Stretch stretch_of(std::uint64_t count, std::uint64_t grain, const Peers& peers) {
    const std::uint64_t grains = (count + grain - 1) / grain;
    const auto size = static_cast<std::uint64_t>(peers.size());
    // The first ranks get one grain more if there is a remainder, so that rank 0 has points.
    const auto begin = [&](std::uint64_t rank) {
        return std::min(count, (grains / size * rank + std::min(rank, grains % size)) * grain);
    };
    const auto rank = static_cast<std::uint64_t>(peers.rank());
    return {begin(rank), begin(rank + 1)};
}

/// Returns an accumulator that has processed this rank's part of the set; null if the part is
/// empty, except on rank 0.
std::shared_ptr<SharedAccumulator> counted_in(const Analyzer& analyzer, const SharedSet& set,
                                              const Values& options, const Ranks& ranks,
                                              const RunContext& run) {
    const std::uint64_t grain = analyzer.sharing.grain(set.points, options);
    const Stretch mine = stretch_of(*set.points.count, grain, ranks);
    if (mine.first == mine.last && ranks.rank() > 0) return nullptr;
    const std::shared_ptr<Accumulator> made = accumulator_for(analyzer, set.points, options, run);
    auto measure = std::dynamic_pointer_cast<SharedAccumulator>(made);
    if (!measure) throw std::logic_error(analyzer.name + " takes no parts of a set");
    const std::size_t width = set.points.width();
    if (mine.first > 0) {
        std::vector<double> head(arrival_batch(set.points.dimension()) * width);
        head.resize(set.from(0)(head) * width);
        measure->begin_at(mine.first, head);
    }
    const auto next = [from = set.from(mine.first), left = mine.last - mine.first,
                       width](std::span<double> rows) mutable {
        const auto some =
            static_cast<std::size_t>(std::min<std::uint64_t>(left, rows.size() / width));
        if (some > 0 && from(rows.first(some * width)) < some)
            fail(ErrorKind::input, "the input became shorter while it was read");
        left -= some;
        return some;
    };
    Arrival part = set.points;
    part.count = mine.last - mine.first;
    add_all(*measure, part, next, run);
    return measure;
}

/// @throws Error(usage) for a pipe or a device, whose bytes only one of the ranks would get
std::uint64_t fingerprint_of(const std::string& path, const RunContext& run) {
    if (is_pipe(path))
        fail_with_hint(ErrorKind::usage, "store its bytes in a file",
                       "{}: is a pipe or a device; ranks share only files", io::source_name(path));
    io::Feed feed(path, run);
    std::string bytes(io::Feed::front_size, '\0');
    std::uint64_t hash = fingerprint(std::string_view());
    while (const std::size_t size = feed.read(bytes))
        hash = fingerprint(std::string_view(bytes).substr(0, size), hash);
    return hash;
}

/// Returns the counts of points and coordinates in a file.
/// @throws Error(input) unless it holds one set, whose coordinates agree with those of `first`
std::array<std::uint64_t, 2> size_of(const std::string& path, const std::string& first,
                                     const io::Opener& open) {
    const auto stream = open(path);
    if (path != first) {
        const auto front = open(first);
        io::require_alike({path, stream->dimension(), stream->provenance()},
                          {first, front->dimension(), front->provenance()});
    }
    if (!stream->next_set()) fail(ErrorKind::input, "{}: it holds no points", path);
    const std::uint64_t count = stream->skip(~std::uint64_t{0});
    if (stream->next_set())
        fail_with_hint(ErrorKind::input, "'stipple study' shares many sets",
                       "{}: it holds several sets; ranks share one", path);
    return {count, stream->dimension()};
}

/// Merges the accumulators of all ranks in rank 0. A rank whose lowest set bit is `step` sends its
/// state to rank - step.
void merge(SharedAccumulator* measure, Ranks& ranks, const RunContext& run) {
    const int rank = ranks.rank();
    for (int step = 1; step < ranks.size(); step *= 2) {
        if (rank % (2 * step) != 0)
            return ranks.give(rank - step, measure ? measure->state(run) : std::string());
        if (rank + step >= ranks.size()) continue;
        const std::string more = ranks.take(rank + step);
        if (!more.empty()) measure->merge(more, run);
    }
}

}  // namespace

void agreed(Peers& peers, const std::function<void()>& work) {
    Packer packer;
    try {
        work();
    } catch (const std::exception&) {
        packer.put_all(packed(caught_error())).put_all(peers.host());
    }
    const auto said = peers.exchange(packer.take());
    const auto first = std::ranges::find_if(said, [](const auto& of) { return !of.empty(); });
    if (first == said.end()) return;
    peers.end_together();
    Unpacker from(*first);
    const std::string trouble = from.take_text();
    const bool same = std::ranges::all_of(said, [&](const std::string& of) {
        return !of.empty() && Unpacker(of).take_text() == trouble;
    });
    const std::string who =
        same ? "" : fmt::format("rank {} on {}: ", first - said.begin(), from.take_text());
    const Error error = unpacked_error(trouble);
    throw Error(error.kind(), who + error.what(), error.hint());
}

std::optional<std::size_t> unlike_rank(std::string_view text, Peers& peers) {
    const auto all = peers.exchange(format_fingerprint(fingerprint(text)));
    const auto unlike = std::ranges::find_if(all, [&](const auto& of) { return of != all[0]; });
    if (unlike == all.end()) return std::nullopt;
    peers.end_together();
    return static_cast<std::size_t>(unlike - all.begin());
}

void require_same_files(const std::vector<std::string>& paths, Peers& peers,
                        const RunContext& run) {
    if (peers.size() == 1 || paths.empty()) return;
    Packer packer;
    agreed(peers, [&] {
        for (const auto& path : paths) packer.put(fingerprint_of(path, run));
    });
    const auto all = peers.exchange(packer.take());
    std::vector<Unpacker> told(all.begin(), all.end());
    for (const auto& path : paths) {
        const auto bytes = told[0].take<std::uint64_t>();
        for (std::size_t rank = 1; rank < told.size(); ++rank) {
            if (told[rank].take<std::uint64_t>() == bytes) continue;
            peers.end_together();
            fail(ErrorKind::input, "{}: this file is not the same for rank {} as for rank 0", path,
                 rank);
        }
    }
}

SharedSet shared_in_files(const std::vector<std::string>& paths, const io::Opener& open,
                          Peers& peers, const RunContext& run) {
    const auto size = static_cast<std::size_t>(peers.size());
    require_same_files(paths, peers, run);
    Packer packer;
    agreed(peers, [&] {
        for (auto i = static_cast<std::size_t>(peers.rank()); i < paths.size(); i += size)
            packer.put(size_of(paths[i], paths.front(), open));
    });
    const auto all = peers.exchange(packer.take());
    std::vector<Unpacker> told(all.begin(), all.end());
    std::vector<std::uint64_t> counts;
    std::uint64_t count = 0;
    std::size_t dimension = 0;
    for (std::size_t i = 0; i < paths.size(); ++i) {
        const auto [points, coordinates] = told[i % size].take<std::array<std::uint64_t, 2>>();
        counts.push_back(points);
        count += points;
        dimension = coordinates;
    }
    return {.points = {.domain = unit_cube(dimension), .count = count},
            .from = [=](std::uint64_t first) -> NextRows {
                std::size_t file = 0;
                while (file + 1 < paths.size() && first >= counts[file]) first -= counts[file++];
                const std::shared_ptr<io::PointStream> stream =
                    io::join_points(paths, open, run, file);
                stream->next_set();
                stream->skip(first);
                return [stream](std::span<double> rows) { return stream->read(rows); };
            }};
}

SharedSet shared_in_memory(PointSet points) {
    const auto all = std::make_shared<const PointSet>(std::move(points));
    return {.points = {.domain = all->domain, .count = all->count()},
            .from = [all](std::uint64_t first) -> NextRows {
                return [all, next = rows_of(*all, first)](std::span<double> rows) {
                    return next(rows);
                };
            }};
}

std::optional<Found> analyze_shared(const Analyzer& analyzer, const SharedSet& set,
                                    const Values& options, Ranks& ranks, const RunContext& run) {
    if (set.points.count == 0U)
        fail(ErrorKind::input, "{} needs at least one point; the set is empty", analyzer.name);
    RunContext mine = run;
    mine.threads = threads_of(ranks, run);
    std::shared_ptr<SharedAccumulator> measure;
    agreed(ranks, [&] { measure = counted_in(analyzer, set, options, ranks, mine); });
    mine.progress = {};
    merge(measure.get(), ranks, mine);
    if (ranks.rank() != 0) return std::nullopt;
    return Found{measure->report(mine), *set.points.count};
}

}  // namespace stipple
