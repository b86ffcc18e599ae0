// SPDX-License-Identifier: MIT
//
// Table of the options that all units of a verb share: names, help, the field of the request that
// each one sets, and which options need or exclude others.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <type_traits>

#include "cli/parsing/requests.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "io/columns.hpp"
#include "io/files.hpp"
#include "pipeline/units.hpp"
#include "study/study_config.hpp"

namespace stipple::cli {
namespace {

// ---------------------------------------------------------------- texts

std::uint64_t whole_number(const Option& option, const std::string& text) {
    const auto value = parse_unsigned(text);
    const auto low = static_cast<std::uint64_t>(option.low);
    const auto high = static_cast<std::uint64_t>(option.high);
    if (value && *value >= low && *value <= high) return *value;
    const auto number = parse_number(text);
    if (!value && (!number || *number != std::floor(*number)))
        fail(ErrorKind::usage, "--{}: '{}' is not a whole number, such as 1000, 1e6, 2^20 or 64k",
             option.name, text);
    fail(ErrorKind::usage, "--{}: {} is outside [{}, {}]", option.name, text, low, high);
}

std::uint64_t byte_count(const Option& option, const std::string& text) {
    const auto bytes = parse_bytes(text);
    if (!bytes || *bytes == 0)
        fail(ErrorKind::usage, "--{}: '{}' is not a size such as 500M or 2G", option.name, text);
    return *bytes;
}

// Overloads of take() parse a text and store it in a field, by the field's type.

void take(std::string& field, const CommonOption&, const std::string& text) { field = text; }

/// For flags, choices and whole numbers. A choice is stored as its index, a flag --no-X as false.
template <class Field>
requires std::is_enum_v<Field> || std::is_integral_v<Field>
void take(Field& field, const CommonOption& common, const std::string& text) {
    const Option& option = common.option;
    if (option.type == "flag")
        field = static_cast<Field>(!option.name.starts_with("no-"));
    else if (option.type == "choice")
        field =
            static_cast<Field>(std::ranges::find(option.choices, text) - option.choices.begin());
    else
        field = static_cast<Field>(common.value == "SIZE" ? byte_count(option, text)
                                                          : whole_number(option, text));
}

void take(double& field, const CommonOption& common, const std::string& text) {
    const Option& option = common.option;
    const auto value = parse_number(text);
    if (!value || !(*value > option.low) || !(*value < option.high))
        fail(ErrorKind::usage, "--{}: '{}' is not a number above {} and below {}", option.name,
             text, option.low, option.high);
    field = *value;
}

void take(Seed& field, const CommonOption& common, const std::string& text) {
    field.random = text == "random";
    if (field.random) return;
    const auto seed = parse_unsigned(text);
    if (!seed)
        fail(ErrorKind::usage, "--{}: '{}' is not a whole number in [0, 2^64) or 'random'",
             common.option.name, text);
    field.value = *seed;
}

void take(Shard& field, const CommonOption& common, const std::string& text) {
    const auto parts = split(text, '/');
    const auto index = parts.size() == 2 ? parse_unsigned(parts[0]) : std::nullopt;
    const auto of = parts.size() == 2 ? parse_unsigned(parts[1]) : std::nullopt;
    if (!index || !of || *index >= *of)
        fail(ErrorKind::usage, "--{}: '{}' is not I/K with 0 <= I < K", common.option.name, text);
    field = {*index, *of};
}

void take(const Format*& field, const CommonOption&, const std::string& text) {
    field = &io::format_named(text);
}

void take(std::vector<std::uint64_t>& field, const CommonOption& common, const std::string& text) {
    const auto high = static_cast<std::uint64_t>(common.option.high);
    field = parse_counts(text, "--" + common.option.name, 1, high);
}

/// Appends the text's specs or, for a repeatable option, the text itself, or else its CSV names.
void take(std::vector<std::string>& field, const CommonOption& common, const std::string& text) {
    if (common.value == "SPECS")
        std::ranges::move(split_specs(text, "--" + common.option.name), std::back_inserter(field));
    else if (common.repeatable)
        field.push_back(text);
    else if (!text.empty())
        std::ranges::move(io::parse_names(text, common.option.name), std::back_inserter(field));
}

void take(std::vector<Spec>& field, const CommonOption&, const std::string& text) {
    field.push_back(parse_spec(text));
}

template <class Field>
void take(std::optional<Field>& field, const CommonOption& common, const std::string& text) {
    take(field.emplace(), common, text);
}

// ---------------------------------------------------------------- the table

struct Row : CommonOption {
    /// @param placeholder type of the value; empty for a flag; alternatives separated by |
    /// @param field member of these verbs' requests that stores the value
    /// @param high largest number, if above 0
    template <class VerbRequest, class Field>
    Row(std::string_view all_names, std::string_view placeholder, const char* shown_default,
        const char* help, Verb of_verbs, Field VerbRequest::*field, double low = 0, double high = 0)
        : Row(all_names, placeholder, shown_default, help, of_verbs, nullptr, low, high) {
        store = [field](Request& request, const CommonOption& own, const std::string& text) {
            take(dynamic_cast<VerbRequest&>(request).*field, own, text);
        };
        const bool list = value.find(',') != value.npos && value.find('[') == value.npos;
        repeatable = std::is_same_v<Field, std::vector<Spec>> ||
                     (std::is_same_v<Field, std::vector<std::string>> && !list);
    }

    /// An option without a field: the parser replaces it by another option.
    Row(std::string_view all_names, std::string_view placeholder, const char* shown_default,
        const char* help, Verb of_verbs, std::nullptr_t, double low = 0, double high = 0);
};

Row::Row(std::string_view all_names, std::string_view placeholder, const char* shown_default,
         const char* help, Verb of_verbs, std::nullptr_t, double low, double high)
    : CommonOption{.names = std::string(all_names),
                   .value = std::string(placeholder),
                   .fallback = shown_default,
                   .option = {.name = std::string(all_names.substr(all_names.rfind("--") + 2)),
                              .type = "text",
                              .fallback = std::string(shown_default),
                              .optional = true,
                              .low = low,
                              .high = high,
                              .help = help},
                   .verbs = of_verbs,
                   .store = [](Request&, const CommonOption&, const std::string&) {}} {
    if (value.empty()) option.type = "flag";
    if (value == "FILE" || value == "FOLDER") option.type = "file";
    if (value.find('|') == std::string::npos) return;
    option.type = "choice";
    for (const auto word : split(value, '|')) option.choices.emplace_back(word);
}

namespace table {

using enum Verb;
constexpr Verb writers = generate | warp | convert;
constexpr Verb readers = warp | analyze | convert | plot | report;
constexpr Verb workers = writers | analyze | plot | study | report | reproduce;
constexpr Verb all_verbs = workers | list | help | completions | emit;

constexpr double most_points = 0x1p53;
constexpr double most_dimensions = 1'000'000;
constexpr double most_sets = 1'000'000'000;
constexpr double most_work = 0x1p60;

const Row rows[] = {  // an array: a vector would copy each row
    {"--generators", "SPECS", "",
     "generators to compare, also without this option's name: sobol:scramble=owen,halton or "
     "'sobol --scramble owen' 'rank1-lattice -w cranley-patterson'",
     study, &SweepRequest::generators},
    {"--analyze", "SPECS", "", "analyzers to run: star-discrepancy,integration:integrand=...",
     study, &SweepRequest::measures},
    {"--config", "FILE", "",
     "JSON file of the study (schema: data/study.schema.json); other options override it", study,
     &StudyRequest::config},
    {"--generate", "GENERATOR[:OPT=V,...]", "",
     "also use points of this generator, after those of the INPUTs: halton, 'sobol --scramble "
     "owen', 'rank1-lattice -w cranley-patterson'; -n, -d, --seed, --start and --warp are those of "
     "'stipple generate' and apply to all generators",
     analyze | plot | report, &Sources::generate},
    {"-n,--count", "COUNTS", "1024", "points in a set: 16,64,256 or 2^4..2^16 or 16..65536*2",
     study, &SweepRequest::counts, 1, most_points},
    {"-n,--count", "N", "1024", "points in a set; 1e6, 2^20 and 64k (= 65536) are accepted",
     generate | emit, &Sources::count, 1, most_points},
    {"-n,--count", "N", "1024", "points of a set of --generate", analyze | plot | report,
     &Sources::count, 1, most_points},
    {"-d,--dimension", "DIMENSIONS", "2", "one or several, written as for -n", study,
     &SweepRequest::dimensions, 1, most_dimensions},
    {"-d,--dimension", "D", "2", "dimension", generate, &Sources::dimension, 1, most_dimensions},
    {"-d,--dimension", "D", "2", "dimension", emit, &Sources::dimension, 1,
     stipple::emit::most_dimensions},
    {"-s,--seed", "S", "1", "the first 64-bit seed; 'random' draws one and reports it", study,
     &Request::seed},
    {"-s,--seed", "S", "1", "64-bit seed; 'random' draws one and reports it", generate,
     &Request::seed},
    {"-s,--seed", "S", "1", "64-bit seed of a scramble; 'random' draws one and reports it", warp,
     &Request::seed},
    {"-s,--seed", "S", "1", "64-bit seed of --generate; 'random' draws one and reports it",
     analyze | plot | report, &Request::seed},
    {"-m,--seeds,--sets", "R", "1", "independent realizations, with seeds S, S + 1, ...", generate,
     &Sources::sets, 1, most_sets},
    {"-m,--seeds,--sets", "R", "1",
     "independent replications by a scramble, with seeds S, S + 1, ...", warp, &Sources::sets, 1,
     most_sets},
    {"-m,--seeds,--sets", "R", "1", "sets of each --generate, with seeds S, S + 1, ...",
     analyze | plot, &Sources::sets, 1, most_sets},
    {"-m,--seeds,--sets", "R", "1",
     "sets of each --generate, with seeds S, S + 1, ...: the first is shown, and all are compared "
     "by their means",
     report, &Sources::sets, 1, 1000},
    {"-m,--sets,--seeds", "R", "1",
     "sets of each generator, dimension and count: seeds S, S + 1, ...", study,
     &SweepRequest::seeds, 1, most_points},
    {"-w,--warp", "NAME[:OPT=V,...]", "", "warp or scramble of --generate", analyze | plot | report,
     &Sources::warps},
    {"-w,--warp", "NAME[:OPT=V,...]", "",
     "warp or scramble the points; NAME@I,J takes two coordinates", generate, &Sources::warps},
    {"-w,--warp", "NAME[:OPT=V,...]", "", "warp the points; NAME@I,J takes two coordinates", emit,
     &Sources::warps},
    {"-w,--warp", "NAME[:OPT=V,...]", "", "warp or scramble before measuring, in order", study,
     &SweepRequest::warps},
    {"--parameters", "FILE", "",
     "file of named parameters, to which the points are mapped after all warps (see 'stipple help "
     "parameters')",
     generate | study, &Request::parameters_file},
    {"--parameters", "FILE", "", "parameter file of the warp parameters", warp,
     &Request::parameters_file},
    {"--parameters", "FILE", "",
     "file of named parameters that the points are values of, or that those of --generate are "
     "mapped to (see 'stipple help parameters')",
     analyze | convert | plot | report, &Request::parameters_file},
    {"--unit-cube", "", "",
     "with --parameters: do not map the points, only drop those that violate a constraint",
     generate | analyze | plot | report, &Sources::unit_cube},
    {"--start", "I", "0", "index of the first point of --generate", analyze | plot | report,
     &Sources::start, 0, most_points},
    {"--start", "I", "0", "index of a sequence's first point", generate, &Sources::start, 0,
     most_points},
    {"--bounds", "LO..HI,...", "",
     "scale to a box: one range for all coordinates, or one for each; with --warp, only the "
     "coordinates that no warp takes are scaled",
     generate, &Sources::bounds},
    {"--bounds", "LO..HI,...", "",
     "box that contains the points; analyzers of the unit cube first map it to the cube", analyze,
     &Sources::bounds},
    {"--coordinates", "I,J,...", "", "coordinates to warp, from 1; the same as WARP@I,J", warp,
     &WarpRequest::coordinates},
    {"--inverse", "", "", "map points back to the unit cube", warp, &WarpRequest::inverse},
    {"-o,--output", "FILE", "-",
     "- is standard output; {set} and {seed} in the name make a file for each set", writers,
     &Request::output},
    {"-o,--output", "FILE", "-", "- is standard output",
     analyze | list | plot | study | report | emit, &Request::output},
    {"-o,--output", "FILE", "", "also write the reproduced points", reproduce, &Request::output},
    {"-o,--output", "FOLDER", "", "with --man: all manual pages, as files in a folder", help,
     &Request::output},
    {"-f,--format", "FORMAT", "", "file format; default: from the extension, else csv", writers,
     &Writing::format},
    {"-f,--format", "text|json|csv|latex", "",
     "output format; default: text on a terminal, else json; latex is a table with booktabs",
     analyze, &AnalyzeRequest::format},
    {"-f,--format", "html|json", "", "output format; default: from the extension, else html",
     report, &ReportRequest::json},
    {"-f,--format", "text|json", "text", "output format; json is complete and stable", list,
     &ListRequest::json},
    {"-f,--format", "text|json", "text", "output format", reproduce, &ReproduceRequest::json},
    {"-f,--format", "svg|pdf|png|text", "",
     "picture format; default: from the extension; text is Braille, as wide as the terminal", plot,
     &PlotRequest::format},
    {"-f,--format", "csv|jsonl|latex", "",
     "table format; default: from the extension, else csv; latex is a wide table with booktabs",
     study, &StudyRequest::format},
    {"--json", "", "", "short for --format json", analyze | list | report | reproduce, nullptr},
    {"--long", "", "", "with the traits and options of every unit", list, &ListRequest::full},
    {"--language", "c|glsl|hlsl|python", "c", "language of the code", emit, &EmitRequest::language},
    {"--name", "NAME", "",
     "name of the function, with which all other names begin; default: the generator's", emit,
     &EmitRequest::name},
    {"--man", "", "", "as a manual page, for man", help, &HelpRequest::man},
    {"--check", "[KEY<VALUE]", "",
     "exit with 1 unless this condition holds; also <= > >= == !=; mean[0] picks one of a list; "
     "without a condition: valid==true",
     analyze, &AnalyzeRequest::checks},
    {"--check", "KEY<VALUE", "",
     "exit with 1 unless this holds for all sets: star-discrepancy.value<0.01; also <= > >= == !=",
     report, &ReportRequest::checks},
    {"--fail-on", "KEY>VALUE", "", "older form of --check, with the opposite condition", report,
     &ReportRequest::fail_on},
    {"--array", "", "", "json that is always an array, also for a single report", analyze,
     &AnalyzeRequest::array},
    {"--average", "", "",
     "the mean over all sets, with standard errors where they apply; sets of different generators, "
     "options, counts or warps have a mean each",
     analyze, &AnalyzeRequest::average},
    {"--pool", "", "", "one mean of all sets, however they were made", analyze,
     &AnalyzeRequest::pool},
    {"--full", "", "", "text output with all numbers of long lists, as tables", analyze,
     &AnalyzeRequest::full},
    {"--keys", "KEY,...", "",
     "results to print, by name or by a dotted part of it: value, worst_box, mean[0]; with several "
     "analyzers ANALYZER.KEY, which prints these alone; default: all",
     analyze, &AnalyzeRequest::keys},
    {"--explain", "", "",
     "text output that explains each result: its meaning, which of two values is better, and what "
     "is typical of 1024 points in the plane",
     analyze, &AnalyzeRequest::explain},
    {"--chart",
     "points|density|pairs|histogram|distances|spectrum|radial|pair-correlation|differential|"
     "local-discrepancy",
     "points",
     "chart of points. points: positions (3 coordinates: a view in space; more: each pair of the "
     "first 8); density: counts by cell; pairs: each pair of coordinates; histogram: of each "
     "coordinate; distances: to the nearest neighbour; local-discrepancy: with the worst boxes of "
     "the star discrepancy; spectrum, radial, pair-correlation, differential: results of analyze "
     "with default options",
     plot, &PlotRequest::chart},
    {"--key", "KEY", "", "result of a report or study to draw, such as prefixes.value or minimum",
     plot, &PlotRequest::key},
    {"--set", "K", "", "draw only set or report K, from 0; default: all", plot, &PlotRequest::set,
     0, most_points},
    {"--overlay", "", "",
     "draw several sets of points in one frame, in colours; default: one frame per set", plot,
     &PlotRequest::overlay},
    {"--letters", "", "", "letters (a), (b), ... for several frames or panels", plot,
     &PlotRequest::letters},
    {"--draw", "cells,gap,grid=CxR", "",
     "also draw the Voronoi cells of points in the plane, their largest empty circle, or C x R "
     "equal cells, such as strata: grid=8x4",
     plot, &PlotRequest::draw},
    {"--keys", "KEY,...", "",
     "results to keep, by name or by a dotted part of it: value, radial.power, mean[0]; "
     "ANALYZER.KEY is kept of this analyzer alone; also of the table of a study that is the "
     "INPUT; default: all numbers",
     study, &SweepRequest::keys},
    {"--summary", "", "",
     "means with standard errors, t and bootstrap intervals, medians, root mean squares, and "
     "pairwise comparisons of generators with Holm-corrected p-values; also of the table of a "
     "study that is the INPUT",
     study, &StudyRequest::summary},
    {"--wide", "", "",
     "instead of rows, a table of the means with a row for each count and a column for each "
     "generator; also of the table or summary of a study that is the INPUT",
     study, &StudyRequest::wide},
    {"--curves", "", "", "also keep lists, a row for each number: radial.power[3]", study,
     &SweepRequest::curves},
    {"--resume", "", "",
     "continue the study in the output file, also with more seeds, counts, generators, ...; start "
     "a new one if there is none",
     study, &StudyRequest::resume},
    {"--overwrite", "", "", "replace the study that the file holds", study,
     &StudyRequest::overwrite},
    {"--domain", "SPEC", "",
     "domain of the points: unit-cube, disk, triangle:vertices=[...], ...; default: as the file "
     "states",
     analyze | plot | report, &Sources::domain},
    {"--rescale", "", "",
     "first map the box of --bounds, else the bounding box of the points, to the unit cube",
     analyze, &Sources::rescale},
    {"--rescale", "", "", "first map the bounding box of the points of files to the unit cube",
     plot | report, &Sources::rescale},
    {"--meta", "", "",
     "write the provenance: in '# ' lines on top of text formats; for npy, bin, utk and psa in "
     "FILE.meta.json",
     writers, &Writing::meta},
    {"--meta", "", "",
     "write the version and the command above the table: in '# ' lines or, in "
     "jsonl, as an object",
     study, &StudyRequest::meta},
    {"--vector-output", "FILE", "",
     "also write the generating vector of a lattice, from the provenance of its points", convert,
     &ConvertRequest::vector_output},
    {"--vector-format", "lddata|latnet-builder", "lddata", "format of --vector-output", convert,
     &ConvertRequest::vector_format},
    {"--with-pdf", "", "", "add a column with the density of each point", generate | warp,
     &Writing::with_pdf},
    {"--with-weight", "", "",
     "add a column with 1 / density: the mean of f times weight estimates the integral of f",
     generate | warp, &Writing::with_weight},
    {"--density-at", "", "",
     "do not move the points; add a column with the warp's density at each, 0 outside its domain",
     warp, &WarpRequest::density_at},
    {"--shard", "I/K", "0/1",
     "make only part I (from 0) of K contiguous parts, which concatenated are the whole set",
     generate, &GenerateRequest::shard},
    {"--title", "TEXT", "", "title; default: from the provenance; '' for no title or subtitle",
     plot, &PlotRequest::title},
    {"--labels", "A,B,...", "",
     "names of the sets or curves in legends and titles, in order; for a study, of its generators; "
     "quotes keep a comma: 'A,\"B, C\"'",
     plot, &PlotRequest::labels},
    {"--labels", "A,B,...", "", "with --wide: names of the generators, in order", study,
     &StudyRequest::labels},
    {"--axes", "X,Y,...", "",
     "names of the axes: for points, of all coordinates; for curves, of x, then of y in each panel",
     plot, &PlotRequest::axes},
    {"--theme", "light|dark", "light", "colours", plot, &PlotRequest::dark},
    {"--width", "W", "", "pixels, or characters of text; default: automatic", plot,
     &PlotRequest::width, 0, most_points},
    {"--height", "H", "",
     "pixels, or lines of text; default: automatic; with --width, several sets are arranged so "
     "that they are as large as possible",
     plot, &PlotRequest::height, 0, most_points},
    {"--x-scale", "linear|log", "", "scale of curves and histograms; default: automatic", plot,
     &PlotRequest::log_x},
    {"--y-scale", "linear|log", "", "scale of curves and histograms; default: automatic", plot,
     &PlotRequest::log_y},
    {"--pairs", "welch|paired", "welch",
     "compare by Welch's t test, or by paired differences of sets with the same seed", study,
     &SummaryOptions::paired},
    {"--confidence", "C", "0.95", "confidence level of the intervals", study,
     &SummaryOptions::confidence, 0, 1},
    {"--bootstrap", "B", "2000", "bootstrap resamples", study, &SummaryOptions::resamples, 1,
     10'000'000},
    {"--time-limit", "SECONDS", "",
     "time limit for making a set, and for each analyzer of it; a measurement that takes longer "
     "fails",
     study, &SweepRequest::time_limit, 0, 1e9},
    {"--no-seconds", "", "", "omit the timing columns, so that every run gives the same bytes",
     study, &SweepRequest::seconds},
    {"--no-seconds", "", "", "omit the time taken, so that every run gives the same bytes", analyze,
     &AnalyzeRequest::seconds},
    {"--yes", "", "", "start even with more than 10 million rows", study, &StudyRequest::yes},
    {"--max-work", "N", "1e9",
     "limit of comparisons in each search for a worst box (a few seconds); a search that reaches "
     "it gives rigorous bounds",
     report, &ReportRequest::max_work, 1, most_work},
    {"--concat", "", "", "join all INPUTs into one set, in order, such as the shards of a set",
     analyze | convert, &Sources::concat},
    {"--column", "X,Y,...", "", "columns to read, by name or number (from 1)", readers,
     &Sources::columns},
    {"--from", "FORMAT", "", "format of the input; default: from its extension or first bytes",
     readers, &Sources::from},
    {"-d,--dimension", "D", "",
     "coordinates of a point; required for raw binary files without FILE.meta.json", readers,
     &Sources::dimension, 1, most_dimensions},
    {"--input", "FILE", "",
     "input file of the original command, which may have been renamed; no other file is read",
     reproduce, &ReproduceRequest::files},
    {"--input-dtype", "f64|f32", "f64", "number type of raw binary input", readers,
     &Sources::dtype_in},
    {"--output-dtype", "f64|f32", "f64", "number type of binary formats that are written", writers,
     &Writing::dtype_out},
    {"--dtype", "f64|f32", "f64", "short for --output-dtype", generate | convert, &Sources::dtype},
    {"--dtype", "f64|f32", "f64", "short for --input-dtype", analyze | plot | report,
     &Sources::dtype},
    {"--dtype", "f64|f32", "f64", "short for --input-dtype and --output-dtype", warp,
     &Sources::dtype},
    {"--precision", "P", "",
     "digits after the point, truncated; default: the shortest text that reads back exactly",
     writers, &Writing::precision, 0, 1000},
    {"--no-header", "", "", "omit the header line of csv", writers, &Writing::header},
    {"--threads", "T", "0", "0 = all cores; never changes a result", workers, &Request::threads, 0,
     4096},
    {"--max-memory", "SIZE", "80 % of the machine's",
     "memory limit, such as 500M or 2G; jobs that need more are refused at the start", workers,
     &Request::max_memory},
    {"-q,--quiet", "", "", "no notes and no progress on stderr, only errors", all_verbs,
     &Request::quiet},
    {"--progress", "auto|always|never", "auto", "a bar on stderr, after 0.5 s on a terminal",
     workers, &Request::progress}};

/// Each of `options` needs or excludes the option `other`.
struct Rule {
    Verb verbs;
    std::string_view options;  ///< separated by commas
    enum Relation { need, exclude } relation;
    std::string_view other;
    std::string_view why;
};

const Rule rules[] = {
    {analyze | plot | report, "count,seed,sets,warp,start,unit-cube", Rule::need, "generate",
     "requires --generate, which is not given"},
    {analyze | plot | report, "bounds,rescale,domain,column,from,dtype,input-dtype", Rule::need,
     "INPUT", "applies to points from files, not to --generate"},
    {generate | analyze | plot | report, "unit-cube", Rule::need, "parameters",
     "requires --parameters, which is not given"},
    {analyze, "bounds", Rule::exclude, "domain", {}},
    {warp, "inverse,with-pdf,with-weight", Rule::exclude, "density-at",
     "--density-at leaves the points where they are"},
    {convert, "vector-format", Rule::need, "vector-output",
     "requires --vector-output, which is not given"},
    {study, "pairs,bootstrap", Rule::need, "summary", "requires --summary, which is not given"},
    {study, "resume", Rule::exclude, "overwrite", {}}};

}  // namespace table

bool includes(Verb verbs, Verb verb) {
    return (static_cast<unsigned>(verbs) & static_cast<unsigned>(verb)) != 0;
}

void check_rules(const Arguments& arguments) {
    const auto given = [&](std::string_view name) {
        return name == "INPUT" ? !arguments.inputs.empty() || !arguments.has("generate")
                               : arguments.has(name);
    };
    for (const auto& [verbs, options, relation, other, why] : table::rules) {
        const bool needs = relation == table::Rule::need;
        // With --config, a required option may be in the configuration file.
        if (!includes(verbs, *arguments.verb) || given(other) == needs ||
            (needs && given("config")))
            continue;
        if (!why.empty())
            refuse_options(arguments, options, why);
        else if (given(options))
            fail(ErrorKind::usage, "--{} and --{}: give one of them", options, other);
    }
}

// ---------------------------------------------------------------- requests

template <class VerbRequest>
std::unique_ptr<Request> filled(const Arguments& arguments) {
    auto request = std::make_unique<VerbRequest>();
    static_cast<Arguments&>(*request) = arguments;
    for (const auto& [name, text] : arguments.common) {
        const CommonOption& common = *find_common("--" + name, *arguments.verb);
        if (common.option.type == "choice") static_cast<void>(common.option.parse(text));
        common.store(*request, common, text);
    }
    check_rules(arguments);
    request->settle();
    return request;
}

}  // namespace

std::unique_ptr<Request> request_of(const Arguments& arguments) {
    return info_of(*arguments.verb).fill(arguments);
}

void WarpRequest::settle() { densities = !density_at; }

void StudyRequest::settle() {
    if (wide || format == StudyFormat::latex) {
        wide = true;
        refuse_options(*this, "summary,resume", "is for tables of rows, not for a wide one");
    } else if (!has("config")) {
        refuse_options(*this, "labels", "requires --wide, which is not given");
        if (!summary)
            refuse_options(*this, "confidence",
                           "requires --summary or --wide, which are not given");
    }
}

void AnalyzeRequest::settle() {
    for (const std::string& text : specs) {
        const Spec spec = parse_spec(text);
        const Analyzer& analyzer = find_analyzer(spec.name);
        analyzers.emplace_back(&analyzer, spec.values(analyzer.options));
    }
    if (specs.empty()) {
        const Analyzer& analyzer = find_analyzer(unit);
        analyzers.emplace_back(&analyzer, settings_of(analyzer.options, *this));
    }
    using Chosen = std::pair<const Analyzer*, Values>;
    tables = gaps = std::ranges::all_of(
        analyzers, [](const Chosen& chosen) { return chosen.first->traits.table; });
    densities = std::ranges::any_of(
        analyzers, [](const Chosen& chosen) { return chosen.first->traits.densities; });
}

bool Arguments::has(std::string_view name) const {
    return std::ranges::any_of(common, [&](const auto& given) { return given.first == name; });
}

void refuse_options(const Arguments& arguments, std::string_view names, std::string_view why) {
    for (const auto name : split(names, ','))
        if (arguments.has(name)) fail(ErrorKind::usage, "--{}: {}", name, why);
}

Values settings_of(const Schema& schema, const Arguments& arguments) {
    Values values = schema.defaults();
    for (const auto& [name, text] : arguments.settings) schema.set(values, name, text);
    return values;
}

const std::vector<VerbInfo>& verbs() {
    static const auto table = [] {
        std::vector<VerbInfo> all;
        const auto add = [&all](Verb verb, const char* name, const auto& fill) {
            all.push_back({verb_page(name), verb, name, fill});
        };
        add(Verb::generate, "generate", filled<GenerateRequest>);
        add(Verb::warp, "warp", filled<WarpRequest>);
        add(Verb::analyze, "analyze", filled<AnalyzeRequest>);
        add(Verb::convert, "convert", filled<ConvertRequest>);
        add(Verb::plot, "plot", filled<PlotRequest>);
        add(Verb::study, "study", filled<StudyRequest>);
        add(Verb::report, "report", filled<ReportRequest>);
        add(Verb::list, "list", filled<ListRequest>);
        add(Verb::reproduce, "reproduce", filled<ReproduceRequest>);
        add(Verb::emit, "emit", filled<EmitRequest>);
        add(Verb::help, "help", filled<HelpRequest>);
        add(Verb::completions, "completions", filled<CompletionsRequest>);
        return all;
    }();
    return table;
}

const VerbInfo* find_verb(std::string_view name) {
    const auto it = std::ranges::find(verbs(), name, &VerbInfo::name);
    return it == verbs().end() ? nullptr : &*it;
}

const VerbInfo& info_of(Verb verb) { return *std::ranges::find(verbs(), verb, &VerbInfo::verb); }

std::vector<const CommonOption*> options_of(Verb verb) {
    std::vector<const CommonOption*> found;
    for (const CommonOption& option : table::rows)
        if (includes(option.verbs, verb)) found.push_back(&option);
    return found;
}

const CommonOption* find_common(std::string_view name, Verb verb) {
    for (const CommonOption* option : options_of(verb))
        for (const auto known : split(option->names, ','))
            if (known == name) return option;
    return nullptr;
}

std::vector<Option> own_options(Verb verb, const UnitInfo& unit) {
    std::vector<Option> own(unit.options.begin(), unit.options.end());
    std::erase_if(own, [&](const Option& option) {
        return find_common("--" + option.name, verb) != nullptr;
    });
    return own;
}

}  // namespace stipple::cli
