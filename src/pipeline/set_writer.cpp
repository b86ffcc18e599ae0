// SPDX-License-Identifier: MIT
#include "pipeline/set_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "generators/generator.hpp"
#include "io/carried_meta.hpp"
#include "io/columns.hpp"
#include "io/output.hpp"
#include "io/provenance.hpp"

namespace stipple {
namespace {

/// Returns the value, which must be finite: readers of files do not accept infinite numbers.
/// @throws Error(input)
double finite(const char* column, double value, std::span<const double> point, bool starts) {
    if (std::isfinite(value)) return value;
    fail_with_hint(
        ErrorKind::input,
        starts ? "--start 1 leaves out a sequence's first point, where coordinates are 0" : "",
        "--{}: the value at the point ({}) is infinite", column, join(point, ", "));
}

/// Writes the rows of one set, a batch of blocks at a time. Returns false if the pipe was closed.
/// @param set number of the set in the file
bool write_rows(const OpenSet& open, const SetStream& stream, const Layout& layout,
                const Target& target, std::size_t set, io::Output& output, const RunContext& run) {
    const std::size_t d = stream.dimension();
    const std::uint64_t block = std::max<std::uint64_t>(1, 16384 / d);
    std::uint64_t written = 0;
    std::vector<std::string> texts;
    const auto densities = [&](const Block& b) {
        return open.densities.empty() ? open.densities
                                      : open.densities.subspan(written + b.first, b.last - b.first);
    };
    const auto write = [&](std::span<const double> rows) {
        texts.resize(block_count(rows.size() / d, block));
        for_each_block(silent(run), rows.size() / d, block, [&](const Block& b) {
            auto part = rows.subspan(b.first * d, (b.last - b.first) * d);
            std::vector<double> wide;
            if (target.columns.any())
                part = wide = with_columns(part, densities(b), target.columns, stream);
            texts[b.index].clear();
            target.format->rows(layout, set, written + b.first, part, texts[b.index]);
        });
        for (const std::string& text : texts)
            if (!output.write(text)) return false;
        written += rows.size() / d;
        if (open.count > 0) run.tick(written, open.count);
        return true;
    };
    // Memory must hold two batches of rows and the text of one, which limits the number of threads.
    constexpr double blocks = 8;
    constexpr double bytes = 48;  // bytes of memory for each number
    const double share = blocks * bytes * static_cast<double>(block * d);
    const double threads = std::clamp(static_cast<double>(run.memory_left()) / (4 * share), 1.0,
                                      static_cast<double>(run.thread_count()));
    const auto batch = static_cast<std::uint64_t>(blocks * std::floor(threads)) * block;
    const auto at_once =
        static_cast<std::size_t>(open.count > 0 ? std::min(batch, open.count) : batch);
    return in_batches(open.next, at_once, d, run, write);
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

Layout layout_of(SetsHead head, const SetStream& stream, const Target& target) {
    Layout layout{.dimension = stream.dimension(),
                  .extras = target.columns.names(),
                  .counts = std::move(head.counts),
                  .header = target.header,
                  .meta = target.meta,
                  .single = target.single,
                  .precision = target.precision,
                  .provenance = std::move(head.provenance),
                  .extent = head.extent ? head.extent : stream.domain->bounding_box()};
    Provenance& meta = layout.provenance;
    if (target.precision && !target.format->traits.binary)
        meta.precision = std::min(meta.precision.value_or(*target.precision), *target.precision);
    if (target.single && target.format->traits.binary) {
        if (meta.precision) io::record_cuts(meta);  // to float32 after the digits
        meta.single = true;
    }
    return layout;
}

/// Text of a provenance file beside the points, with "?" as `front`, if requested and if their
/// format cannot hold it; otherwise empty. Made before files are, since a JSON value that runs out
/// of memory in its destructor ends the program, which would leave parts of files.
std::string meta_beside(const Layout& layout, const std::string& path, const Target& target,
                        const RunContext& run) {
    if (!target.meta || !target.format->traits.meta_beside || target.sink) return {};
    if (path == "-" || path.starts_with("/dev/")) {
        run.notify(
            fmt::format("--meta: the format {} cannot hold provenance, and {} has no side file",
                        target.format->name, path == "-" ? "standard output" : path));
        return {};
    }
    return io::to_text({.of = target.format->name,
                        .width = layout.width(),
                        .sets = layout.counts.are_equal() ? layout.counts.size() : 0,
                        .single = layout.single,
                        .front = "?",
                        .extras = layout.extras,
                        .provenance = layout.provenance}) +
           "\n";
}

/// Checks that no two sets would be written to one file: sets from files may have the same seed.
/// @throws Error(usage)
void check_seeds(const SetStream& stream, const Target& target) {
    if (target.path.find("{set}") != std::string::npos) return;
    std::unordered_map<std::uint64_t, std::size_t> taken;
    for (std::size_t set = 0; set < stream.sets; ++set) {
        const auto [there, is_new] = taken.try_emplace(stream.seed(set), set);
        if (!is_new)
            fail_with_hint(ErrorKind::usage, "use {set}",
                           "--output: sets {} and {} both have the seed {}, and would be one file",
                           there->second, set, there->first);
    }
}

void write_side_files(const std::vector<SideFile>& files, io::Outputs& outputs,
                      const RunContext& run) {
    for (const SideFile& file : files) outputs.add(file.path, run.stop).write(file.bytes);
}

/// Writes the sets [first, last). Returns false if the pipe was closed.
/// @param open the first set, already open; replaced by the later ones
/// @param part context of the first set, from part_of_run()
bool write_points(const SetStream& stream, OpenSet& open, std::size_t first, std::size_t last,
                  const Layout& layout, const Target& target, io::Output& output,
                  const RunContext& run, RunContext part) {
    const Format& format = *target.format;
    std::string bytes;
    if (format.head) format.head(layout, bytes);
    for (std::size_t set = first; set < last; ++set) {
        if (set > first) {
            part = part_of_run(run, set, stream.sets).rising();
            open = stream.open(set, part);
        }
        if (format.begin_set) format.begin_set(layout, set - first, bytes);
        if (!output.write(bytes)) return false;
        bytes.clear();
        if (!write_rows(open, stream, layout, target, set - first, output, part)) return false;
    }
    if (format.tail) format.tail(layout, bytes);
    return output.write(bytes);
}

/// Writes one file with the sets [first, last), and their side files. Returns false if the reader
/// closed the pipe; side files are written all the same.
bool write_file(const SetStream& stream, std::size_t first, std::size_t last,
                const std::string& path, const Target& target, io::Outputs& outputs,
                RunContext run) {
    const Layout layout = layout_of(stream.head(first, last), stream, target);
    std::string meta = meta_beside(layout, path, target, run);
    check_format(*target.format, layout);
    if (stream.one_at_a_time && last - first == 1 && was_interrupted(layout.provenance))
        run = unstopped(run);  // the search was stopped; writes its best result
    // Opens the first set early, so that its errors come before any output.
    const RunContext part = part_of_run(run, first, stream.sets).rising();
    OpenSet open = stream.open(first, part);
    write_side_files(open.side_files, outputs, run);
    io::Output& output = target.sink ? outputs.add(target.sink) : outputs.add(path, run.stop);
    const bool wanted = write_points(stream, open, first, last, layout, target, output, run, part);
    if (!meta.empty()) {
        replace_all(meta, R"("front":"?")", fmt::format(R"("front":"{}")", output.front()));
        outputs.add(io::meta_path(path), run.stop).write(meta);
    }
    // The sets of a sequence share their side files, which come with the last set.
    if (last - first > 1) write_side_files(open.side_files, outputs, run);
    return wanted;
}

/// Whether all sets must be made before their file is begun: because its head depends on all of
/// them, or because they have side files, which are written first.
bool waits_for_all(const SetStream& stream, const Target& target) {
    const FormatTraits& traits = target.format->traits;
    const bool first_tells = traits.counts_first || traits.equal_sets || target.meta;
    return stream.sets > 1 && (stream.side_files || (stream.one_at_a_time && first_tells));
}

}  // namespace

bool was_interrupted(const Provenance& meta) {
    return std::ranges::count(meta.found, std::pair<std::string, std::string>(interrupted)) > 0;
}

Target with_own_columns(Target target, const PointSet& points) {
    if (points.densities.empty()) return target;
    const auto there = io::density_columns(points.provenance);
    target.columns.pdf |= there.pdf;
    target.columns.weight |= there.weight;
    return target;
}

std::vector<double> with_columns(std::span<const double> rows, std::span<const double> densities,
                                 const Columns& columns, const SetStream& stream) {
    const std::size_t d = stream.dimension();
    const std::size_t count = rows.size() / d;
    double volume = 1;
    std::vector<double> own;
    if (densities.empty()) {
        const bool warped = stream.chain != nullptr && !stream.chain->empty();
        own = warped ? stream.chain->density(rows) : std::vector<double>(count, 1);
        // Without warps, points are uniform on their domain: the unit cube, or a box to which it
        // was scaled.
        if (!warped) volume = stream.domain->measure();
        if (!(volume > 0 && volume < std::numeric_limits<double>::infinity()))
            fail(ErrorKind::input, "--with-{}: the volume of the bounds is beyond float64",
                 columns.names().front());
        densities = own;
    }
    std::vector<double> wide;
    wide.reserve(rows.size() + 2 * count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto row = rows.subspan(i * d, d);
        wide.insert(wide.end(), row.begin(), row.end());
        const bool off = columns.anywhere && !stream.chain->domain()->contains(row);
        const double pdf = off ? 0 : densities[i] / volume;
        const double weight = volume / densities[i];
        if (columns.pdf)
            wide.push_back(
                finite(columns.anywhere ? "density-at" : "with-pdf", pdf, row, stream.starts));
        if (columns.weight) wide.push_back(finite("with-weight", weight, row, stream.starts));
    }
    return wide;
}

const Format& format_of(const Target& target) {
    if (target.format != nullptr) return *target.format;
    if (const Format* format = io::format_of_extension(target.path)) return *format;
    std::vector<std::string> known;
    for (const Format& format : io::all())
        known.insert(known.end(), format.extensions.begin(), format.extensions.end());
    io::require_extension(
        target.path, known,
        "--format selects a format for any file name; 'stipple plot' draws pictures");
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

void write_sets(const SetStream& stream, const Target& asked, const RunContext& run) {
    if (asked.take)
        return asked.take(stream.one_at_a_time && stream.sets > 1
                              ? waiting(stream, run, [](const auto&) {})
                              : stream);
    Target target = asked;
    target.format = &format_of(asked);
    io::Outputs outputs;
    const std::size_t sets = stream.sets;
    if (file_per_set(target.path)) {
        check_seeds(stream, target);
        for (std::size_t set = 0; set < sets; ++set)
            if (!write_file(stream, set, set + 1, path_of_set(target.path, set, stream.seed(set)),
                            target, outputs, run))
                break;
    } else if (waits_for_all(stream, target)) {
        const auto beside = [&](const auto& files) { write_side_files(files, outputs, run); };
        write_file(waiting(stream, run, beside), 0, sets, target.path, target, outputs, run);
    } else {
        write_file(stream, 0, sets, target.path, target, outputs, run);
    }
    outputs.commit();
}

std::vector<std::string> Columns::names() const {
    std::vector<std::string> names;
    if (pdf) names.emplace_back("pdf");
    if (weight) names.emplace_back("weight");
    return names;
}

}  // namespace stipple
