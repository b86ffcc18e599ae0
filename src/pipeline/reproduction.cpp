// SPDX-License-Identifier: MIT
#include "pipeline/reproduction.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/bytes/raw_numbers.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "io/decimal.hpp"
#include "io/provenance.hpp"
#include "pipeline/chain.hpp"
#include "pipeline/units.hpp"
#include "pipeline/warping.hpp"

namespace stipple {
namespace {

std::string name_of_set(std::size_t set) { return set > 0 ? fmt::format("set {}", set) : "it"; }

/// Calls take(rows) with batches of a set's rows until it returns false. The numbers are rounded as
/// those read back from a file written as `written`. Returns false if take() did.
bool each_batch(const SetStream& stream, const OpenSet& open, const Target& written,
                const RunContext& run, const std::function<bool(std::span<const double>)>& take) {
    const std::size_t width = stream.dimension();
    const std::size_t batch = std::max<std::size_t>(1, (std::size_t{1} << 18) / width);
    std::uint64_t done = 0;
    std::string text;
    return in_batches(open.next, batch, width, run, [&](std::span<const double> rows) {
        auto numbers = written.columns.any() ? with_columns(rows, {}, written.columns, stream)
                                             : std::vector<double>(rows.begin(), rows.end());
        for (double& number : numbers) {
            if (written.single) number = to_single(number);
            if (!written.precision) continue;
            text.clear();
            io::append_number(text, number, written.precision);
            io::read_number(text.data(), text.data() + text.size(), number);
        }
        run.tick(done += rows.size() / width, open.count);
        return take(numbers);
    });
}

/// Makes all sets in memory.
std::vector<PointSet> collect(const Making& making, Target written, const RunContext& run) {
    std::vector<PointSet> sets;
    written.take = [&](const SetStream& stream) {
        const Provenance meta = stream.head(0, stream.sets).provenance;
        const std::size_t d = stream.dimension();
        for (std::size_t set = 0; set < stream.sets; ++set) {
            const RunContext part = part_of_run(run, set, stream.sets).rising();
            std::vector<double> numbers;
            each_batch(stream, stream.open(set, part), written, part,
                       [&](std::span<const double> rows) {
                           run.need_memory(8 * static_cast<double>(numbers.size() + rows.size()),
                                           "the points before their last warp");
                           numbers.insert(numbers.end(), rows.begin(), rows.end());
                           return true;
                       });
            sets.emplace_back(std::move(numbers), d);
            sets.back().domain = meta.domain.empty() ? unit_cube(d) : stream.domain;
            sets.back().provenance = meta;
        }
    };
    making(written);
    return sets;
}

/// Whether the reproduced points of a set are those in the file; otherwise, stores the first
/// difference in `result`.
bool same_points(const SetStream& stream, std::size_t set, const Target& written,
                 io::PointStream& file, Comparison& result, const RunContext& run) {
    const std::size_t width = file.dimension();
    const RunContext part = part_of_run(run, set, stream.sets).rising();
    const OpenSet open = stream.open(set, part);
    std::uint64_t at = 0;
    std::vector<double> found;
    return each_batch(stream, open, written, part, [&](std::span<const double> made) {
        found.resize(made.size());
        const std::size_t got = file.read(found) * width;
        const auto differs = std::ranges::mismatch(made.first(got), std::span(found).first(got));
        const auto place = static_cast<std::size_t>(differs.in1 - made.begin());
        result.points += place / width;
        if (place < got) {
            result.difference = {.set = set,
                                 .point = at + place / width,
                                 .column = place % width,
                                 .found = found[place],
                                 .made = made[place]};
            return false;
        }
        at += got / width;
        if (got < made.size())
            result.mismatch = fmt::format("{} has {} points; made again it has {}",
                                          name_of_set(set), at, open.count);
        return got == made.size();
    });
}

Comparison compared(const SetStream& stream, const Target& written, io::PointStream& file,
                    bool unmarked, const RunContext& run) {
    const SetsHead head = stream.head(0, stream.sets);
    Comparison result{.made = head.provenance};
    const std::size_t width = stream.dimension() + written.columns.names().size();
    if (file.dimension() != width)
        result.mismatch = fmt::format("its points have {} numbers; made again they have {}",
                                      file.dimension(), width);
    std::vector<double> more(file.dimension());
    for (std::size_t set = 0; set < stream.sets && result.mismatch.empty(); ++set) {
        const bool there = (unmarked && set > 0) || file.next_set();
        // A file with only the first set is no mismatch: the others may be in files of their own.
        if (!there && set > 1)
            result.mismatch =
                fmt::format("it has {} sets; made again there are {}", set, stream.sets);
        if (!there) return result;
        ++result.sets;
        if (!same_points(stream, set, written, file, result, run)) return result;
        if ((!unmarked || set + 1 == stream.sets) && file.read(more) > 0)
            result.mismatch = fmt::format("{} has more than the {} points of its recipe",
                                          name_of_set(set), head.counts[set]);
    }
    if (result.mismatch.empty() && file.next_set())
        result.mismatch = fmt::format("it has more than the {} sets of its recipe", result.sets);
    return result;
}

/// Adds a step of the points' provenance that was a separate run of the program.
/// @param sets number of sets in the file
/// @param have number of sets before the step; updated to the number after it
Making after_step(Making before, const std::string& step, std::uint64_t sets, std::uint64_t& have,
                  const RunContext& run) {
    if (io::is_cut(step)) {
        Target cut{.single = step == io::cut_to_single};
        if (!cut.single) {
            const auto digits =
                parse_integer(std::string_view(step).substr(io::cut_to_digits.size()));
            cut.precision = static_cast<int>(std::clamp<std::int64_t>(digits.value_or(0), 0, 1000));
        }
        return [=](const Target& target) { write_sets(collect(before, cut, run), target, run); };
    }
    const bool back = step.starts_with(inverse_of);
    Spec spec = parse_spec(std::string_view(step).substr(back ? inverse_of.size() : 0));
    if (scramble_named(spec.name) == nullptr)
        return [=](const Target& target) {
            write_warped({.sets = collect(before, {}, run)}, spec, back, target, run);
        };
    std::uint64_t seed = 1;
    for (const auto& [name, text] : spec.settings)
        if (name == scramble_seed.name) seed = parse_unsigned(text).value_or(1);
    std::erase_if(spec.settings, [](const auto& s) { return s.first == scramble_seed.name; });
    const std::uint64_t replications = sets > have && sets % have == 0 ? sets / have : 1;
    have *= replications;
    return [=](const Target& target) {
        write_scrambled(collect(before, {}, run), spec, seed, replications, target, run);
    };
}

}  // namespace

Making made_again(SetsToMake job, const std::vector<std::string>& steps, std::uint64_t sets,
                  const RunContext& run) {
    std::uint64_t have = job.sets;
    Making all = [job = std::move(job), run](const Target& target) { produce(job, target, run); };
    for (const std::string& step : steps) all = after_step(std::move(all), step, sets, have, run);
    return all;
}

Comparison compare(const Making& making, Target written, io::PointStream& file, bool unmarked,
                   const RunContext& run) {
    Comparison result;
    written.take = [&](const SetStream& stream) {
        result = compared(stream, written, file, unmarked, run);
    };
    making(written);
    return result;
}

std::string bytes_of(const Making& making, Target target) {
    std::string bytes;
    target.sink = [&](std::string_view more) {
        bytes += more;
        return true;
    };
    making(target);
    return bytes;
}

}  // namespace stipple
