// SPDX-License-Identifier: MIT
//
// The verb `reproduce`: makes the points of a file again from its provenance, and compares. The
// points are made by the command in the provenance, which has the options as typed; the options in
// the provenance also include computed values, such as a radius.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "cli/session.hpp"
#include "cli/verbs.hpp"
#include "core/bytes/file_bytes.hpp"
#include "core/bytes/fingerprint.hpp"
#include "core/bytes/spool.hpp"
#include "core/error.hpp"
#include "core/json.hpp"
#include "core/text.hpp"
#include "io/carried_meta.hpp"
#include "io/files.hpp"
#include "io/point_stream.hpp"
#include "io/provenance.hpp"
#include "io/source_text.hpp"
#include "media/png_picture.hpp"
#include "pipeline/chain.hpp"
#include "pipeline/pipeline.hpp"
#include "pipeline/reproduction.hpp"
#include "pipeline/warping.hpp"
#include "plot/drawing/drawing.hpp"
#include "study/study_table.hpp"

namespace stipple::cli {
namespace {

// ---------------------------------------------------------------- the file

/// A file with known provenance.
struct Original {
    std::string name;                   ///< name for messages
    std::string path;                   ///< path that can be opened repeatedly
    std::shared_ptr<Spool> spool = {};  ///< owns the copy of a pipe
    Provenance meta = {};
    const Format* format = nullptr;         ///< null: determined by the file's name and bytes
    std::optional<std::size_t> width = {};  ///< numbers per point, if not determined by the bytes
    std::size_t sets = 0;                   ///< sets in the file; 0: determined by the bytes
    std::string picture = {};  ///< for a picture by a generator: the option that names it
    bool drawn = false;        ///< SVG or PLY, which cannot be read back
    std::string plotted = {};  ///< for a picture by `stipple plot`: the command that drew it
};

[[noreturn]] void refuse_without_provenance(const Original& original) {
    fail_with_hint(ErrorKind::input,
                   "json and jsonl always record it; generate --meta adds it to other formats",
                   "{}: it does not record how its points were made", original.name);
}

/// Whether a file begins like a table of a study, its summary or its comparison.
bool is_study(std::string_view front) {
    front = without_preface(front);
    const auto line = front.substr(0, front.find('\n'));
    for (const TableStyle style : {TableStyle::csv, TableStyle::jsonl})
        if (StudyTable(style, true).is_head(line)) return true;
    return line.starts_with("table,generator,") || line.starts_with("table,dimension,");
}

/// Rejects stipple's files without points, such as reports. @throws Error(input) with a hint about
/// what can be made again from the file
/// @param front first bytes of the file; the first 1000 are searched
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
         "it holds results of analyze and names their points, but does not record how these were "
         "made",
         "reproduce takes files of points"},
        {is("stipple.comparison") || has("name=\"generator\" content=\"stipple"),
         "a report about points, which it does not contain",
         "it names the command that makes it again, and those that make its points"},
        {is("stipple.study-journal"), "the journal of an unfinished study, without points",
         "the same 'stipple study' with --resume continues it"},
        {is_study(front), "a table of a study, without points",
         "the command in its '# command' line (study --meta) makes it again, and 'stipple "
         "generate' "
         "with a row's generator, its options, count, dimension, warps and seed its points"},
        {is("stipple.meta"), "it records how the points in another file were made",
         "reproduce takes the file of points"},
        {has("<!DOCTYPE html") || has("<html"), "an HTML page, which holds no points", ""}};
    for (const auto& [is_it, what, hint] : others)
        if (is_it) fail_with_hint(ErrorKind::input, hint, "{}: {}", name, what);
}

/// Copies a pipe to a temporary file.
std::shared_ptr<Spool> spooled(const std::string& pipe, const RunContext& run) {
    auto spool = std::make_shared<Spool>();
    spool->write(io::read_bytes(pipe, run));
    spool->rewind();
    return spool;
}

/// Reads the provenance from a picture by `stipple plot`; returns false for other files.
bool take_plot(Original& original, std::string_view picture) {
    const Json note =
        try_parse_json(io::picture_note(picture).value_or(plot::pdf_note(picture, "stipple")));
    if (!note.is_object() || note.contains("format") || !note.contains("command")) return false;
    original.plotted = note["command"].get<std::string>();
    if (!note.contains("meta"))
        fail(ErrorKind::input, "{}: a picture drawn by '{}', of no single set with provenance",
             original.name, original.plotted);
    original.meta = io::provenance_from(note["meta"]);
    return true;
}

/// Reads the provenance from a picture, a ply or svg file, or the file's sidecar; returns false for
/// other files without a sidecar.
bool take_carried(Original& original, std::string_view front, const RunContext& run) {
    std::optional<io::CarriedMeta> carried;
    const bool picture = front.starts_with(png_magic) || front.starts_with("%PDF-");
    const bool svg = front.starts_with("<svg") || front.starts_with("<?xml");
    original.drawn = front.starts_with("ply\n") || svg;
    if (picture || original.drawn) {
        const std::string whole = io::read_bytes(original.path, run);
        if (take_plot(original, whole)) return true;
        carried = io::find_carried_meta(whole, original.name);
        if (!carried) refuse_without_provenance(original);
    } else if ((carried = io::meta_beside(original.path, run))) {
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

/// Opens the points of a file. One thread reads them, while other threads make the points again.
/// @param options columns to read
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

/// Reads the provenance of a file. @throws Error(input) if the file has no points or no provenance
Original read_original(const std::string& input, const RunContext& run) {
    Original original{.name = io::source_name(input), .path = input};
    if (is_pipe(input)) {
        original.spool = spooled(input, run);
        original.path = original.spool->path();
    }
    const io::Feed feed(original.path, run);
    refuse_without_points(original.name, feed.front());
    const bool carried = take_carried(original, feed.front(), run);
    if (!carried && io::format_of_extension(original.path) == &io::format_named("bin"))
        refuse_without_provenance(original);  // bin cannot store provenance
    if (!carried) original.meta = open_original(original, {}, run)->provenance();
    if (original.meta.generator.empty()) refuse_without_provenance(original);
    return original;
}

// ---------------------------------------------------------------- the recipe

/// Splits a command into words like a shell: at blanks, except inside 'quotes'; \' is a quote.
std::vector<std::string> shell_words(std::string_view command) {
    std::vector<std::string> words;
    bool quoted = false;
    bool begun = false;
    std::string word;
    for (std::size_t i = 0; i < command.size(); ++i) {
        const char c = command[i];
        if (c == '\'') {
            quoted = !quoted;
            begun = true;
        } else if (!quoted && c == ' ') {
            if (begun) words.push_back(std::move(word));
            word.clear();
            begun = false;
        } else {
            word += !quoted && c == '\\' && i + 1 < command.size() ? command[++i] : c;
            begun = true;
        }
    }
    if (begun) words.push_back(std::move(word));
    return words;
}

/// Arguments reconstructed from a provenance without a command. Its steps become --warp up to the
/// first inverse or truncation: those can only be steps of later commands.
Arguments arguments_of(const Provenance& meta, const std::string& name, const RunContext& run) {
    if (!meta.shard.empty() || meta.efficiency < 1)
        fail(ErrorKind::input, "{}: its provenance has no command, which a part of a set needs",
             name);
    Arguments typed;
    typed.verb = Verb::generate;
    typed.unit = meta.generator;
    typed.settings = meta.options;
    typed.common = {{"count", std::to_string(meta.count)}, {"seed", std::to_string(meta.seed)}};
    if (meta.start > 0) typed.common.emplace_back("start", std::to_string(meta.start));
    const auto later = std::ranges::find_if(meta.warps, [](const std::string& step) {
        return step.starts_with(inverse_of) || io::is_cut(step);
    });
    std::for_each(meta.warps.begin(), later,
                  [&](const std::string& warp) { typed.common.emplace_back("warp", warp); });
    std::size_t d = meta.dimension;
    for (auto step = meta.warps.rbegin(); step != meta.warps.rend(); ++step)
        d = dimension_before_step(*step, d, run);
    typed.common.emplace_back("dimension", std::to_string(d));
    if (!meta.bounds.empty()) typed.common.emplace_back("bounds", meta.bounds);
    return typed;
}

/// Replaces --parameters by the warp in the provenance, which contains the parameter file's
/// contents.
void take_parameters(Arguments& typed, const Provenance& meta) {
    if (!typed.has("parameters")) return;
    const auto before = static_cast<std::size_t>(std::ranges::count_if(
        typed.common, [](const auto& option) { return option.first == "warp"; }));
    if (meta.warps.size() <= before)
        fail(ErrorKind::usage, "its command names parameters, which its warps do not hold");
    std::erase_if(typed.common, [](const auto& option) {
        return option.first == "parameters" || option.first == "unit-cube";
    });
    typed.common.emplace_back("warp", meta.warps[before]);
    if (!typed.has("dimension"))
        typed.common.emplace_back("dimension", std::to_string(meta.dimension));
}

/// Arguments of the command in the provenance, or reconstructed ones if it is not a `generate`
/// command.
Arguments typed_for(const Original& original, const RunContext& run) {
    const auto words = shell_words(original.meta.command);
    if (words.size() < 3 || words[1] != "generate")
        return arguments_of(original.meta, original.name, run);
    std::vector<const char*> argv;
    for (const std::string& word : words) argv.push_back(word.c_str());
    Arguments typed = parse_arguments(static_cast<int>(argv.size()), argv.data());
    take_parameters(typed, original.meta);
    return typed;
}

/// Everything needed to make the file again.
struct Recipe {
    GenerateRequest request;
    SetsToMake job;
    std::vector<std::string> steps;  ///< warps that later commands applied
};

/// Runs work() on the provenance; its usage errors become errors of the file.
template <class Work>
auto reading_provenance(const Original& original, const Work& work) {
    try {
        return work();
    } catch (const Error& e) {
        if (e.kind() != ErrorKind::usage) throw;
        throw Error(ErrorKind::input,
                    fmt::format("{}: this stipple ({}) cannot follow its provenance: {}",
                                original.name, STIPPLE_VERSION, e.what()),
                    e.hint());
    }
}

Recipe recipe_of(const Original& original, Session& session) {
    const Provenance& meta = original.meta;
    const Generator& generator = find_generator(meta.generator);
    Recipe recipe;
    if (!meta.flaw.empty()) fail(ErrorKind::usage, "{}", meta.flaw);
    Arguments typed = typed_for(original, session.run());
    // Checks the options in the provenance as those of a command line.
    Values known = generator.options.defaults();
    for (const auto& [name, text] : meta.options) generator.options.set(known, name, text);
    // Options that only write side files do not affect the points.
    std::erase_if(typed.settings, [&](const auto& setting) {
        return std::ranges::find(generator.writes, setting.first) != generator.writes.end();
    });
    recipe.request = request_as<GenerateRequest>(typed);
    recipe.job = sets_to_make(recipe.request, session);
    SetsToMake& job = recipe.job;
    if (job.generator->name != generator.name)
        fail(ErrorKind::usage, "its command makes points by {}, its generator is {}",
             job.generator->name, generator.name);
    // Sets of one command in separate files have consecutive seeds.
    if (meta.seed - job.request.seed >= job.sets)
        fail(ErrorKind::usage, "its command makes {} of seed {}, its seed is {}",
             job.sets > 1 ? fmt::format("{} sets from one", job.sets) : "a set", job.request.seed,
             meta.seed);
    if (job.request.seed != meta.seed) job.sets = 1;
    job.request.seed = meta.seed;
    job.command = meta.command;
    if (job.warps.size() > meta.warps.size())
        fail(ErrorKind::usage, "its command has {} warps, its warps are {}", job.warps.size(),
             meta.warps.size());
    recipe.steps.assign(meta.warps.begin() + static_cast<std::ptrdiff_t>(job.warps.size()),
                        meta.warps.end());
    return recipe;
}

/// Stream version of a unit that makes or moves points.
std::uint64_t stream_version_of(const std::string& name) {
    const auto of = [&name](const auto& units) {
        const auto it = std::ranges::find_if(units, [&](const auto& u) { return u.name == name; });
        return it == units.end() ? 0 : it->stream_version;
    };
    const Scramble* scramble = scramble_named(name);
    return scramble ? scramble->stream_version : std::max(of(warps::all()), of(generators::all()));
}

/// Sentence about the first unit with another stream version than the provenance; empty if none.
std::string changed_rules(const Provenance& meta) {
    std::vector<std::string> units = {find_generator(meta.generator).name};
    for (std::string warp : meta.warps) {
        if (io::is_cut(warp)) continue;
        if (warp.starts_with("inverse ")) warp.erase(0, 8);
        units.push_back(parse_spec(warp).name);
    }
    for (const std::string& unit : units) {
        std::uint64_t then = 1;
        for (const auto& [name, version] : meta.stream_versions)
            if (name == unit) then = version;
        const std::uint64_t now = stream_version_of(unit);
        if (then != now && now != 0)
            return fmt::format(
                "the rules of {} changed: the file is of stream version {}, made by stipple {}; "
                "this stipple ({}) has version {}",
                unit, then, meta.version, STIPPLE_VERSION, now);
    }
    return {};
}

/// Rules for the files that the recipe may read: only those of this command line. Inputs are
/// identified by their fingerprints, so that they may have been renamed.
std::unique_ptr<FileRules> rules_for(const Original& original, const ReproduceRequest& request,
                                     const RunContext& run) {
    std::map<std::string, std::string> readable = {{original.path, original.path}};
    std::map<std::string, std::string> by_fingerprint;
    for (const std::string& file : request.files) {
        readable.emplace(file, file);
        by_fingerprint.emplace(format_fingerprint(file_fingerprint(file, run)), file);
    }
    for (const auto& [file, fingerprint_then] : original.meta.inputs) {
        if (fingerprint_then == not_kept)
            fail(ErrorKind::input, "{}: its points were made from {}, a pipe that is not kept",
                 original.name, shown(file));
        const auto same = by_fingerprint.find(fingerprint_then);
        if (same != by_fingerprint.end())
            readable[file] = same->second;
        else if (readable.contains(file))
            fail(ErrorKind::input, "{}: its points were made from {}, which has changed since",
                 original.name, shown(file));
        else
            fail_with_hint(
                ErrorKind::input, fmt::format("give it with --input {}", printable(file)),
                "{}: its points were made from {}, which is read only if --input allows it",
                original.name, shown(file));
    }
    const std::string output = request.output.value_or("-");
    return std::make_unique<FileRules>(std::move(readable),
                                       std::vector{output, io::meta_path(output)});
}

// ---------------------------------------------------------------- the verdict

/// Result of the comparison, as a sentence and as JSON.
struct Verdict {
    bool identical = false;
    std::string sentence;
    Json details = Json::object();
};

/// Remarks such as " in 3 sets, with 5 digits after the point".
std::string remarks_on(const Comparison& found, const Target& written) {
    std::string text;
    if (found.sets > 1) text += fmt::format(" in {} sets", found.sets);
    if (written.single) text += ", as float32";
    if (written.precision)
        text += fmt::format(", with {} digits after the point", *written.precision);
    return text;
}

class Reproducer {
  public:
    Reproducer(const Original& original, Recipe recipe, Session& session)
        : original_(original), recipe_(std::move(recipe)), session_(session), run_(session.run()) {
        run_.warn = nullptr;  // warnings were shown when the points were first made
        written_.precision = original.meta.precision;
        written_.single = original.meta.single;
    }

    Verdict go() {
        if (!original_.plotted.empty()) return {};
        if (!original_.picture.empty()) return compare_picture();
        return original_.drawn ? compare_bytes() : compare_points();
    }

    /// Makes the points again and writes them to a file.
    void write(const std::string& path) {
        Arguments typed = recipe_.request;
        typed.common.emplace_back("output", path);
        if (io::format_of_extension(path) != nullptr)
            std::erase_if(typed.common, [](const auto& c) { return c.first == "format"; });
        reading_provenance(original_, [&] {
            Target target = target_of(request_as<GenerateRequest>(typed));
            target.columns = written_.columns;
            making(1)(target);
        });
    }

  private:
    /// All steps that make the points. @param sets number of sets in the file
    [[nodiscard]] Making making(std::size_t sets) const {
        return made_again(recipe_.job, recipe_.steps, sets, run_);
    }

    Verdict compare_points() {
        const auto stream = open_original(original_, {.all_columns = true}, run_);
        written_.columns = columns_behind(stream->dimension());
        // Raw numbers do not show where a set ends.
        const bool raw = original_.format != nullptr && original_.format->name == "bin";
        const std::size_t sets = raw ? original_.sets : stream->sets().value_or(0);
        if (sets == 1) recipe_.job.sets = 1;
        const Comparison found =
            compare(making(std::max<std::size_t>(sets, 1)), written_, *stream, raw, run_);
        tell_differences(found.made);
        Verdict verdict = verdict_on(found, stream->dimension());
        const std::string wrong = verdict.identical ? contradiction(found.made) : "";
        if (!wrong.empty()) {
            verdict.identical = false;
            verdict.sentence = wrong;
        }
        return verdict;
    }

    /// Names of coordinates and extra columns.
    [[nodiscard]] std::vector<std::string> column_names(std::size_t dimension) const {
        auto names = coordinate_names(dimension, original_.meta);
        for (const auto& extra : written_.columns.names()) names.push_back(extra);
        return names;
    }

    /// Extra columns after the coordinates, deduced from `width`, the numbers per point.
    [[nodiscard]] Columns columns_behind(std::size_t width) const {
        const std::size_t d = original_.meta.dimension;
        if (width == d + 2) return {.pdf = true, .weight = true};
        if (width != d + 1) return {};
        const bool named = names_column("pdf") || names_column("weight");
        const bool weight = named ? names_column("weight") : recipe_.request.with_weight;
        return {.pdf = !weight, .weight = weight};
    }

    [[nodiscard]] bool names_column(const std::string& name) const {
        try {
            open_original(original_, {.columns = {name}}, run_);
        } catch (const Error&) {
            return false;
        }
        return true;
    }

    /// Warns of computed options in the provenance that have other values now, although the points
    /// may be equal.
    void tell_differences(const Provenance& made) const {
        if (!recipe_.steps.empty() || made.options.empty()) return;
        for (const auto& option : original_.meta.options)
            if (std::ranges::find(made.options, option) == made.options.end())
                session_.warn(
                    fmt::format("{}: its provenance has {} {}, but stipple {} finds another value",
                                original_.name, option.first, option.second, STIPPLE_VERSION));
    }

    /// Message if the points are equal but the provenance contradicts them; empty if it is right.
    [[nodiscard]] std::string contradiction(const Provenance& made) const {
        const Provenance& told = original_.meta;
        const auto text = [](std::uint64_t number) { return std::to_string(number); };
        const std::vector<std::array<std::string, 3>> facts = {
            {"count", text(told.count), text(made.count)},
            {"dimension", text(told.dimension), text(made.dimension)},
            {"start", text(told.start), text(made.start)},
            {"seed", text(told.seed), text(made.seed)},
            {"domain", told.domain, made.domain}};
        for (const auto& [name, says, is] : facts)
            if (says != is && !says.empty())
                return fmt::format(
                    "the points are the same, but the provenance has {} {} instead of {}", name,
                    says, is);
        return {};
    }

    /// Size in words, such as "50 points of 3 coordinates and pdf".
    [[nodiscard]] std::string size_of(const Comparison& found, std::size_t width) const {
        const auto extra = written_.columns.names();
        const std::size_t d = width - extra.size();
        std::string text =
            fmt::format("{} {} of {} {}", found.points, found.points == 1 ? "point" : "points", d,
                        d == 1 ? "coordinate" : "coordinates");
        for (const auto& name : extra) text += fmt::format(" and {}", name);
        return text;
    }

    [[nodiscard]] Verdict verdict_on(const Comparison& found, std::size_t width) const {
        Verdict verdict{.identical = found.identical(), .sentence = found.mismatch};
        verdict.details = {{"points", found.points}, {"sets", found.sets}};
        if (verdict.identical)
            verdict.sentence =
                fmt::format("{}{}", size_of(found, width), remarks_on(found, written_));
        if (!found.difference) return verdict;
        const Difference& at = *found.difference;
        const auto names = column_names(width - written_.columns.names().size());
        const bool several = recipe_.job.sets > 1 || at.set > 0;
        verdict.sentence =
            fmt::format("{}point {}, {}: the file has {}; made again it is {}",
                        several ? fmt::format("set {}, ", at.set) : "", at.point, names[at.column],
                        format_number(at.found), format_number(at.made));
        verdict.details["difference"] = {{"set", at.set},
                                         {"point", at.point},
                                         {"coordinate", names[at.column]},
                                         {"file", at.found},
                                         {"made", at.made}};
        return verdict;
    }

    /// Compares formats that cannot be read back, byte by byte.
    Verdict compare_bytes() {
        const std::string bytes = io::read_bytes(original_.path, run_);
        const std::string found = io::without_meta(bytes);
        const bool ply = found.starts_with("ply\n");
        const auto header = std::string_view(found).substr(0, found.find("end_header"));
        const auto says = [&](std::string_view words) {
            return ply && header.find(words) != std::string_view::npos;
        };
        Target target{.format = original_.format, .meta = true};
        target.single = says("property float ");
        if (says("format ascii")) target.precision = recipe_.request.precision;
        target.columns = {.pdf = says(" pdf\n"), .weight = says(" weight\n")};
        if (!says("property int set")) recipe_.job.sets = 1;
        const std::string made = io::without_meta(bytes_of(making(1), target));
        const auto [f, m] = std::ranges::mismatch(found, made);
        if (f == found.end() && m == made.end())
            return {.identical = true, .sentence = fmt::format("{} bytes", bytes.size())};
        const auto line = 1 + std::count(found.begin(), f, '\n');
        const auto byte = static_cast<std::size_t>(f - found.begin());
        const bool binary = ply && !says("format ascii") && byte > header.size();
        return {
            .sentence = fmt::format("{} {}, apart from its provenance", binary ? "byte" : "line",
                                    binary ? byte : static_cast<std::size_t>(line)),
            .details = {{"byte", byte}}};
    }

    /// Compares a picture that a generator wrote beside its points, pixel by pixel.
    Verdict compare_picture() {
        const auto& generator = *recipe_.job.generator;
        Values options = recipe_.job.options;
        generator.options.set(options, original_.picture, "picture.png");
        const PointSet points =
            GeneratedSets({&generator, options, recipe_.job.request}, run_).made(0, run_);
        if (points.side_files.empty())
            fail(ErrorKind::input, "{}: {} makes no such picture", original_.name, generator.name);
        const std::string bytes = io::read_bytes(original_.path, run_);
        const PngPicture found = read_png(bytes, original_.name, run_);
        const PngPicture made =
            read_png(points.side_files[0].bytes, "the picture made again", run_);
        if (found.width != made.width || found.height != made.height)
            return {.sentence = fmt::format("it is {} x {} pixels; made again it is {} x {}",
                                            found.width, found.height, made.width, made.height)};
        const auto [f, m] = std::ranges::mismatch(found.grey, made.grey);
        if (f == found.grey.end())
            return {.identical = true,
                    .sentence = fmt::format("{} x {} pixels", found.width, found.height)};
        const auto pixel = static_cast<std::size_t>(f - found.grey.begin());
        return {.sentence = fmt::format(
                    "column {}, row {}: the file has the grey {}; made again it is {}",
                    pixel % found.width, pixel / found.width, format_number(*f), format_number(*m)),
                .details = {{"column", pixel % found.width}, {"row", pixel / found.width}}};
    }

    const Original& original_;
    Recipe recipe_;
    Session& session_;
    RunContext run_;
    Target written_;  ///< float32, precision and extra columns of the file
};

int say(const Original& original, const Verdict& verdict, const std::string& changed,
        const ReproduceRequest& request) {
    std::string sentence = verdict.identical ? "identical: " : "different: ";
    sentence += verdict.sentence;
    if (!changed.empty()) sentence = changed;
    const std::string& version = original.meta.version;
    if (!verdict.identical && changed.empty() && version != STIPPLE_VERSION)
        sentence += fmt::format(" (made by stipple {}; this is {})", version, STIPPLE_VERSION);
    std::string text = printable(fmt::format("{}: {}", original.name, sentence)) + "\n";
    if (request.json) {
        Json out{{"format", "stipple.reproduction"}, {"version", 1}, {"file", original.name}};
        out["identical"] = verdict.identical;
        out["rules_changed"] = !changed.empty();
        out["sentence"] = sentence;
        out.update(verdict.details);
        out["command"] = original.meta.command;
        text = json_text(out, 2) + "\n";
    }
    // The verdict must not be mixed with points on standard output.
    if (request.output == "-")
        cli::say(text);
    else
        write_text("-", text);
    return verdict.identical ? 0 : 1;
}

/// Handles a picture by `plot`, which has no numbers to compare: writes its points to `output`.
/// @throws Error(input) without `output`
int remake_plotted(const Original& original, Reproducer& reproducer,
                   const std::optional<std::string>& output) {
    const Provenance& meta = original.meta;
    const std::string made =
        meta.command.empty() ? fmt::format("generator {}", meta.generator) : meta.command;
    if (!output)
        fail_with_hint(
            ErrorKind::input, "-o FILE makes its points again",
            "{}: a picture, which has no numbers to compare; it was drawn by '{}' of the "
            "points of '{}'",
            original.name, original.plotted, made);
    reproducer.write(*output);
    if (*output != "-")
        write_text("-",
                   fmt::format("{}: a picture of the points of '{}'; {} has them, made again\n",
                               original.name, made, *output));
    return 0;
}

}  // namespace

int ReproduceRequest::perform(Session& session) const {
    if (inputs.size() != 1)
        fail(ErrorKind::usage, "reproduce takes one FILE; {} are given", inputs.size());
    const Original original = read_original(inputs[0], session.run());
    if (was_interrupted(original.meta))
        fail_with_hint(
            ErrorKind::input,
            "the file is the only copy of its points; the whole search finds other ones",
            "{}: its search was interrupted, and cannot be stopped at the same place again",
            original.name);
    const std::string changed =
        reading_provenance(original, [&] { return changed_rules(original.meta); });
    if (!changed.empty()) return say(original, {}, changed, *this);
    const auto rules = rules_for(original, *this, session.run());
    std::optional<Reproducer> reproducer;
    const Verdict verdict = reading_provenance(original, [&] {
        reproducer.emplace(original, recipe_of(original, session), session);
        return reproducer->go();
    });
    if (!original.plotted.empty()) return remake_plotted(original, *reproducer, output);
    if (output) reproducer->write(*output);
    return say(original, verdict, {}, *this);
}

}  // namespace stipple::cli
