// SPDX-License-Identifier: MIT
#include "pipeline/set_writer.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "io/carried_meta.hpp"

namespace stipple {
namespace {

/// Files hold no infinite numbers: no reader would take them.
double finite(const char* column, double value, std::span<const double> point, bool starts) {
    if (std::isfinite(value)) return value;
    fail_with_hint(
        ErrorKind::input,
        starts ? "--start 1 leaves out a sequence's first point, where coordinates are 0" : "",
        "--{}: it is infinite at the point ({})", column, fmt::join(point, ", "));
}

/// The rows of one set as bytes of the output, a batch of blocks at a time; `set` is its number in
/// the file. False: the pipe was closed.
bool write_rows(const NextRows& next, const SetsToWrite& job, const Layout& layout,
                const Target& target, std::size_t set, io::Output& output, const RunContext& run) {
    const std::size_t d = job.width();
    const std::uint64_t block = std::max<std::uint64_t>(1, 16384 / d);
    const std::uint64_t count = layout.counts[set];
    std::uint64_t written = 0;
    std::vector<std::string> texts;
    const auto write = [&](std::span<const double> rows) {
        texts.resize(block_count(rows.size() / d, block));
        for_each_block(silent(run), rows.size() / d, block, [&](const Block& b) {
            auto part = rows.subspan(b.first * d, (b.last - b.first) * d);
            std::vector<double> wide;
            if (target.columns.any()) part = wide = with_columns(part, target.columns, job);
            texts[b.index].clear();
            target.format->rows(layout, set, written + b.first, part, texts[b.index]);
        });
        for (const std::string& text : texts)
            if (!output.write(text)) return false;
        written += rows.size() / d;
        if (count > 0) run.tick(written, count);
        return true;
    };
    const std::uint64_t batch = 8 * block * run.thread_count();
    const std::uint64_t all = count > 0 ? count : job.expected;
    const auto at_once = static_cast<std::size_t>(all > 0 ? std::min(batch, all) : batch);
    return in_batches(next, at_once, d, run, write);
}

std::string span_text(std::size_t low, std::size_t high) {
    return low == high ? std::to_string(low) : fmt::format("{} to {}", low, high);
}

void check_format(const Format& format, const Layout& layout) {
    const auto& traits = format.traits;
    const std::size_t d = layout.dimension;
    if (d < traits.min_dimension || d > traits.max_dimension)
        fail(ErrorKind::usage, "--format: {} holds points of dimension {}; these have {}",
             format.name, span_text(traits.min_dimension, traits.max_dimension), d);
    if (!traits.many_sets && layout.counts.size() > 1)
        fail_with_hint(ErrorKind::usage, "write a file for each set: -o 'NAME_{set}...'",
                       "--format: {} holds one set; there are {}", format.name,
                       layout.counts.size());
    if (traits.equal_sets && !layout.counts.are_equal())
        fail_with_hint(ErrorKind::usage, "write a file for each set: -o 'NAME_{set}...'",
                       "--format: {} holds sets of equal size only; these are not", format.name);
}

Layout layout_of(const SetsToWrite& job, std::size_t first, std::size_t last,
                 const Target& target) {
    Layout layout{.dimension = job.dimension(),
                  .header = target.header,
                  .meta = target.meta,
                  .single = target.single,
                  .precision = target.precision,
                  .provenance = job.provenance(first),
                  .extent = job.extent ? job.extent(first) : job.domain->bounding_box()};
    Provenance& meta = layout.provenance;
    if (target.precision && !target.format->traits.binary)
        meta.precision = std::min(meta.precision.value_or(*target.precision), *target.precision);
    meta.single |= target.single && target.format->traits.binary;
    layout.extras = target.columns.names();
    layout.counts = job.counts.part(first, last);
    return layout;
}

/// One file with sets [first, last) of the job.
bool write_points(const SetsToWrite& job, const Layout& layout, std::size_t first, std::size_t last,
                  const std::string& path, const Target& target, io::Outputs& outputs,
                  const RunContext& run) {
    const Format& format = *target.format;
    check_format(format, layout);
    // What is wrong with the first source shall be known before anything is written.
    RunContext part = part_of_run(run, first, job.sets).rising();
    NextRows next = job.source(first, part);
    io::Output& output = target.sink ? outputs.add(target.sink) : outputs.add(path, run.stop);
    std::string bytes;
    if (format.head) format.head(layout, bytes);
    for (std::size_t set = first; set < last; ++set) {
        if (set > first) {
            part = part_of_run(run, set, job.sets).rising();
            next = job.source(set, part);
        }
        if (format.begin_set) format.begin_set(layout, set - first, bytes);
        if (!output.write(bytes)) return false;
        bytes.clear();
        if (!write_rows(next, job, layout, target, set - first, output, part)) return false;
    }
    if (format.tail) format.tail(layout, bytes);
    return output.write(bytes);
}

/// Provenance for a file beside the points, where the format has no place for it; else nothing.
std::string meta_beside(const Layout& layout, const std::string& path, const Target& target,
                        const RunContext& run) {
    if (!target.meta || !target.format->traits.meta_beside || target.sink) return {};
    if (path == "-" || path.starts_with("/dev/")) {
        run.notify(fmt::format("--meta: {} has no place for provenance, and {} none beside it",
                               target.format->name, path == "-" ? "standard output" : path));
        return {};
    }
    return io::to_text(
               {target.format->name, layout.width(), layout.counts.size(), layout.provenance}) +
           "\n";
}

std::uint64_t seed_of_set(const SetsToWrite& job, std::size_t set) {
    return job.first_seed ? *job.first_seed + set : job.provenance(set).seed;
}

/// Seeds that files tell may be the same. @throws Error(usage) where two sets would be one file
void check_seeds(const SetsToWrite& job, const Target& target) {
    if (job.first_seed || target.path.find("{set}") != std::string::npos) return;
    std::unordered_map<std::uint64_t, std::size_t> taken;
    for (std::size_t set = 0; set < job.sets; ++set) {
        const auto [there, is_new] = taken.try_emplace(seed_of_set(job, set), set);
        if (!is_new)
            fail_with_hint(ErrorKind::usage, "use {set}",
                           "--output: sets {} and {} both have the seed {}, and would be one file",
                           job.first_set + there->second, job.first_set + set, there->first);
    }
}

/// The points and their provenance. Who closes the pipe has seen enough of the points, but did not
/// say so of the other file.
bool write_file(const SetsToWrite& job, std::size_t first, std::size_t last,
                const std::string& path, const Target& target, io::Outputs& outputs,
                const RunContext& run) {
    const Layout layout = layout_of(job, first, last, target);
    if (const auto meta = meta_beside(layout, path, target, run); !meta.empty())
        outputs.add(io::meta_path(path), run.stop).write(meta);
    return write_points(job, layout, first, last, path, target, outputs, run);
}

}  // namespace

std::vector<double> with_columns(std::span<const double> rows, const Columns& columns,
                                 const SetsToWrite& job) {
    const std::size_t d = job.dimension();
    const auto density = job.densities ? std::vector<double>() : job.chain->density(rows);
    // Without warps, what the points are on is the unit cube, or what it was scaled to.
    const double volume = job.chain->empty() && !job.densities ? job.domain->measure() : 1;
    std::vector<double> wide;
    const std::size_t count = rows.size() / job.width();
    wide.reserve(rows.size() + 2 * count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto row = rows.subspan(i * job.width(), d);
        wide.insert(wide.end(), row.begin(), row.end());
        const double told = job.densities ? rows[i * job.width() + d] : density[i];
        const bool off = columns.anywhere && !job.chain->domain()->contains(row);
        const double pdf = off ? 0 : told / volume;
        const double weight = volume / told;
        if (columns.pdf)
            wide.push_back(
                finite(columns.anywhere ? "density-at" : "with-pdf", pdf, row, job.starts));
        if (columns.weight) wide.push_back(finite("with-weight", weight, row, job.starts));
    }
    return wide;
}

const Format& format_of(const Target& target) {
    if (target.format != nullptr) return *target.format;
    if (const Format* format = io::format_of_extension(target.path)) return *format;
    std::vector<std::string> known;
    for (const Format& format : io::all())
        known.insert(known.end(), format.extensions.begin(), format.extensions.end());
    io::require_extension(target.path, known,
                          "--format names what is written under any name; pictures are drawn by "
                          "'stipple plot'");
    return io::format_named("csv");
}

bool file_per_set(const std::string& path) {
    return path.find("{set}") != std::string::npos || path.find("{seed}") != std::string::npos;
}

std::string path_of_set(std::string path, std::size_t set, std::uint64_t seed) {
    replace_all(path, "{set}", std::to_string(set));
    replace_all(path, "{seed}", std::to_string(seed));
    return path;
}

void write_files(const SetsToWrite& job, const Target& asked, const RunContext& run) {
    io::Outputs outputs;
    write_files(job, asked, outputs, run);
    outputs.commit();
}

void write_files(const SetsToWrite& job, const Target& asked, io::Outputs& outputs,
                 const RunContext& run) {
    if (asked.take) return asked.take(job);
    Target target = asked;
    target.format = &format_of(asked);
    if (!file_per_set(target.path)) {
        write_file(job, 0, job.sets, target.path, target, outputs, run);
        return;
    }
    check_seeds(job, target);
    for (std::size_t set = 0; set < job.sets; ++set) {
        const auto path = path_of_set(target.path, job.first_set + set, seed_of_set(job, set));
        if (!write_file(job, set, set + 1, path, target, outputs, run)) return;
    }
}

RunContext part_of_run(const RunContext& run, std::size_t set, std::size_t sets) {
    const auto all = static_cast<double>(sets);
    return run.stage(static_cast<double>(set) / all, static_cast<double>(set + 1) / all);
}

std::vector<std::string> Columns::names() const {
    std::vector<std::string> names;
    if (pdf) names.emplace_back("pdf");
    if (weight) names.emplace_back("weight");
    return names;
}

}  // namespace stipple
