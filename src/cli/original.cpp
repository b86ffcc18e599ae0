// SPDX-License-Identifier: MIT
#include "cli/original.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/bytes/file_bytes.hpp"
#include "core/error.hpp"
#include "core/json.hpp"
#include "io/carried_meta.hpp"
#include "io/files.hpp"
#include "io/provenance.hpp"
#include "io/source_text.hpp"
#include "media/png_picture.hpp"
#include "study/study_table.hpp"

namespace stipple::cli {
namespace {

[[noreturn]] void refuse_without_provenance(const Original& original) {
    fail_with_hint(ErrorKind::input,
                   "json and jsonl always hold it; generate --meta puts it into other formats",
                   "{}: it does not say how its points were made", original.name);
}

/// Whether a file begins like a table of a study, its summary or its comparison.
bool is_study(std::string_view front) {
    const auto line = front.substr(0, front.find('\n'));
    for (const TableStyle style : {TableStyle::csv, TableStyle::jsonl})
        if (StudyTable(style, true).is_head(line)) return true;
    return line.starts_with("table,generator,") || line.starts_with("table,dimension,");
}

/// @throws Error(input) for stipple's files without points, such as reports, with a hint about what
/// can be made again from them
/// @param front first bytes of the file, at least a few hundred if it has so many
void refuse_without_points(const std::string& name, std::string_view front) {
    const auto top = front.substr(0, 1000);
    const auto has = [top](std::string_view words) {
        return top.find(words) != std::string_view::npos;
    };
    const auto is = [&](const char* format) {
        return (top.starts_with('[') || top.starts_with('{')) && has(fmt::format("\"{}\"", format));
    };
    struct Other {
        bool is;
        const char* what;
        const char* hint;
    };
    const Other others[] = {
        {is("stipple.report") || top.starts_with("analyzer,source,"),
         "it holds results of analyze, and names the points that they are of, but not how these "
         "were made",
         "reproduce takes files of points"},
        {is("stipple.comparison") || has("name=\"generator\" content=\"stipple"),
         "a report about points, which it does not hold",
         "it names the command that makes it again, and those that make its points"},
        {is("stipple.study-journal"), "the journal of a study that is not finished, without points",
         "the same 'stipple study' with --resume goes on"},
        {is_study(front), "a table of a study, without points",
         "'stipple generate' with a row's generator, its options, count, dimension, warps and "
         "seed makes the points of that row again"},
        {is("stipple.meta"), "it says how the points in the file beside it were made",
         "reproduce takes the file of points"},
        {has("<!DOCTYPE html") || has("<html"), "an HTML page, which holds no points", ""}};
    for (const auto& [is_it, what, hint] : others)
        if (is_it) fail_with_hint(ErrorKind::input, hint, "{}: {}", name, what);
}

/// A pipe's bytes in a temporary file.
std::shared_ptr<Spool> spooled(const std::string& pipe, const RunContext& run) {
    auto spool = std::make_shared<Spool>();
    spool->write(io::read_bytes(pipe, run));
    spool->rewind();
    return spool;
}

/// Reads the provenance from a picture by `stipple plot`; false if it is not one.
bool take_plot(Original& original, std::string_view picture) {
    const Json note = try_parse_json(io::picture_note(picture).value_or(""));
    if (!note.is_object() || note.contains("format") || !note.contains("command")) return false;
    original.plotted = note["command"].get<std::string>();
    if (!note.contains("meta"))
        fail(ErrorKind::input, "{}: a picture drawn by '{}', of no single set with provenance",
             original.name, original.plotted);
    original.meta = io::provenance_from(note["meta"]);
    return true;
}

/// Reads the provenance of files that are not read as points; false if it is not such a file.
bool take_carried(Original& original, std::string_view front, const RunContext& run) {
    std::optional<io::CarriedMeta> carried;
    const std::string beside = io::meta_path(original.path);
    const bool picture = front.starts_with(png_magic);
    const bool svg = front.starts_with("<svg") || front.starts_with("<?xml");
    original.drawn = front.starts_with("ply\n") || svg;
    if (picture || original.drawn) {
        const std::string whole = io::read_bytes(original.path, run);
        if (take_plot(original, whole)) return true;
        carried = io::find_carried_meta(whole, original.name);
        if (!carried) refuse_without_provenance(original);
    } else if (exists(status_of(beside))) {
        carried = io::carried_meta(io::read_bytes(beside, run), beside);
        original.format = &io::format_named(carried->of);
        if (carried->width > 0) original.width = carried->width;
        original.sets = carried->sets;
    }
    if (!carried) return false;
    original.meta = carried->provenance;
    if (picture) original.picture = carried->of;
    if (original.drawn) original.format = &io::format_named(carried->of);
    return true;
}

}  // namespace

std::unique_ptr<io::PointStream> open_original(const Original& original, ReadOptions options,
                                               const RunContext& run) {
    RunContext reading = run;
    reading.threads = 1;
    options.source = original.name;
    options.any_count = true;  // differences in the count are reported by the comparison
    options.single = original.meta.single;
    if (original.width) options.dimension = original.width;
    return io::open_points(original.path, options, reading, original.format);
}

Original read_original(const std::string& input, const RunContext& run) {
    const auto status = status_of(input);
    const bool pipe =
        input == "-" || (exists(status) && !is_regular_file(status) && !is_directory(status));
    Original original{.name = io::source_name(input), .path = input};
    if (pipe) {
        original.spool = spooled(input, run);
        original.path = original.spool->path();
    }
    const io::Feed feed(original.path, run);
    refuse_without_points(original.name, feed.front());
    const bool carried = take_carried(original, feed.front(), run);
    if (!carried && io::format_of_extension(original.path) == &io::format_named("bin"))
        refuse_without_provenance(original);  // the format cannot store one
    if (!carried) original.meta = open_original(original, {}, run)->provenance();
    if (original.meta.generator.empty()) refuse_without_provenance(original);
    return original;
}

}  // namespace stipple::cli
