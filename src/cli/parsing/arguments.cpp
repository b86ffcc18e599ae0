// SPDX-License-Identifier: MIT
#include "cli/parsing/arguments.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/text.hpp"

namespace stipple::cli {

bool Arguments::has(std::string_view name) const { return get(name).has_value(); }

std::optional<std::string> Arguments::get(std::string_view name) const {
    const auto texts = all(name);
    return texts.empty() ? std::nullopt : std::optional(texts.back());
}

std::vector<std::string> Arguments::all(std::string_view name) const {
    std::vector<std::string> texts;
    for (const auto& [option, text] : common)
        if (option == name) texts.push_back(text);
    return texts;
}

void Arguments::refuse(std::initializer_list<std::string_view> names, std::string_view why) const {
    for (const auto name : names)
        if (has(name)) fail(ErrorKind::usage, "--{}: {}", name, why);
}

std::optional<std::uint64_t> Arguments::integer(std::string_view name, std::uint64_t low,
                                                std::uint64_t high) const {
    const auto text = get(name);
    if (!text) return std::nullopt;
    const auto value = parse_unsigned(*text);
    if (value && *value >= low && *value <= high) return value;
    const auto number = parse_number(*text);
    if (!value && (!number || *number != std::floor(*number)))
        fail(ErrorKind::usage, "--{}: '{}' is not a whole number, such as 1000, 1e6, 2^20 or 64k",
             name, *text);
    fail(ErrorKind::usage, "--{}: {} is outside [{}, {}]", name, *text, low, high);
}

std::optional<std::uint64_t> Arguments::integer(std::string_view name) const {
    if (!has(name)) return std::nullopt;
    const Option& option = find_common("--" + std::string(name), *verb)->option;
    return integer(name, static_cast<std::uint64_t>(option.low),
                   static_cast<std::uint64_t>(option.high));
}

void check_choices(const Arguments& arguments) {
    for (const auto& [name, text] : arguments.common) {
        const CommonOption* common = find_common("--" + name, *arguments.verb);
        if (common != nullptr && common->option.type == "choice")
            static_cast<void>(common->option.parse(text));
    }
}

namespace table {
namespace {

using enum Verb;
constexpr Verb writers = generate | warp | convert;
constexpr Verb readers = warp | analyze | convert | plot | report;
constexpr Verb workers = writers | analyze | plot | study | report | reproduce;

constexpr double most_points = 0x1p53;
constexpr double most_dimensions = 1'000'000;
constexpr double most_sets = 1'000'000'000;
constexpr double most_work = 0x1p60;

const std::vector<CommonOption> rows = {
    {"--generators", "SPECS", "", "generators to compare: sobol:scramble=owen,halton", study, true},
    {"--analyze", "SPECS", "", "analyzers to run: star-discrepancy,integration:integrand=...",
     study, true},
    {"--config", "FILE", "",
     "a study as JSON, as data/study.schema.json says; options on the command line override it",
     study},
    {"--generate", "GENERATOR[:OPT=V,...]", "",
     "generated points, behind those of the INPUTs, without a file; all share -n, -d, --seed, "
     "--start and --warp, as in 'stipple generate'",
     analyze | plot | report, true},
    {"-n,--count", "COUNTS", "1024", "points in a set: 16,64,256 or 2^4..2^16 or 16..65536*2",
     study},
    {"-n,--count", "N", "1024", "points in a set; 1e6, 2^20 and 64k (= 65536) are accepted",
     generate, false, 1, most_points},
    {"-n,--count", "N", "1024", "points of a set of --generate", analyze | plot | report, false, 1,
     most_points},
    {"-d,--dimension", "DIMENSIONS", "2", "one or several, written as for -n", study},
    {"-d,--dimension", "D", "2", "dimension", generate, false, 1, most_dimensions},
    {"-s,--seed", "S", "1", "the first 64-bit seed; 'random' draws one and reports it", study},
    {"-s,--seed", "S", "1", "64-bit seed; 'random' draws one and reports it", generate},
    {"-s,--seed", "S", "1", "64-bit seed of a scramble; 'random' draws one and reports it", warp},
    {"-s,--seed", "S", "1", "64-bit seed of --generate; 'random' draws one and reports it",
     analyze | plot | report},
    {"-m,--seeds,--sets", "R", "1", "independent realizations, with seeds S, S + 1, ...", generate,
     false, 1, most_sets},
    {"-m,--seeds,--sets", "R", "1",
     "independent replications by a scramble, with seeds S, S + 1, ...", warp, false, 1, most_sets},
    {"-m,--seeds,--sets", "R", "1", "sets of each --generate, with seeds S, S + 1, ...",
     analyze | plot, false, 1, most_sets},
    {"-m,--seeds,--sets", "R", "1",
     "sets of each --generate, with seeds S, S + 1, ...: the first is shown, and all are compared "
     "by their means",
     report, false, 1, 1000},
    {"-m,--sets,--seeds", "R", "1",
     "sets of each generator, dimension and count: seeds S, S + 1, ...", study, false, 1,
     most_points},
    {"-w,--warp", "NAME[:OPT=V,...]", "", "warp or scramble of --generate", analyze | plot | report,
     true},
    {"-w,--warp", "NAME[:OPT=V,...]", "",
     "warp or scramble the points; NAME@I,J takes two coordinates", generate, true},
    {"-w,--warp", "NAME[:OPT=V,...]", "", "warp or scramble before measuring, in order", study,
     true},
    {"--parameters", "FILE", "",
     "named parameters, to which the points go after all warps (stipple help parameters)",
     generate | study},
    {"--parameters", "FILE", "", "parameter file of the warp parameters", warp},
    {"--parameters", "FILE", "",
     "the parameter file that the points are of, or those of --generate go to (stipple help "
     "parameters)",
     analyze | convert | plot | report},
    {"--unit-cube", "", "",
     "with --parameters: the numbers in the unit cube, less those that break a constraint",
     generate | analyze | plot | report},
    {"--start", "I", "0", "index of the first point of --generate", analyze | plot | report, false,
     0, most_points},
    {"--start", "I", "0", "index of a sequence's first point", generate, false, 0, most_points},
    {"--bounds", "LO..HI,...", "",
     "scale to a box: one range for all coordinates, or one for each; of warped points, those that "
     "no warp takes",
     generate},
    {"--bounds", "LO..HI,...", "",
     "the box that the points lie in; analyzers of the unit cube first map it to the cube",
     analyze},
    {"--coordinates", "I,J,...", "", "coordinates to warp, from 1; the same as WARP@I,J", warp},
    {"--inverse", "", "", "map points back to the unit cube", warp},
    {"-o,--output", "FILE", "-",
     "- is standard output; {set} and {seed} in the name make a file for each set", writers},
    {"-o,--output", "FILE", "-", "- is standard output", analyze | list | plot | study | report},
    {"-o,--output", "FILE", "", "also write the reproduced points", reproduce},
    {"-o,--output", "FOLDER", "", "with --man: all manual pages, as files in a folder", help},
    {"-f,--format", "FORMAT", "", "file format; default: from the extension, else csv", writers},
    {"-f,--format", "text|json|csv", "", "output format; default: text on a terminal, else json",
     analyze},
    {"-f,--format", "html|json", "", "output format; default: from the extension, else html",
     report},
    {"-f,--format", "text|json|markdown", "text", "output format; json is complete and stable",
     list},
    {"-f,--format", "text|json", "text", "output format", reproduce},
    {"-f,--format", "svg|pdf|png|text", "",
     "picture format; default: from the extension; text is Braille, as wide as the terminal", plot},
    {"-f,--format", "csv|jsonl", "", "table format; default: from the extension, else csv", study},
    {"--json", "", "", "short for --format json", analyze | list | report | reproduce},
    {"--markdown", "", "", "short for --format markdown", list},
    {"--long", "", "", "with the traits and options of every unit", list},
    {"--man", "", "", "as a manual page, for man", help},
    {"--check", "[KEY<VALUE]", "",
     "exit with 1 unless it holds; also <= > >= == !=; mean[0] picks one of a list; alone: "
     "valid==true",
     analyze, true},
    {"--check", "KEY<VALUE", "",
     "exit with 1 unless it holds for all sets: star-discrepancy.value<0.01; also <= > >= == !=",
     report, true},
    {"--fail-on", "KEY>VALUE", "", "older form: --check of the opposite", report, true},
    {"--average", "", "",
     "one result, the mean over all sets, with standard errors where they apply; one of each kind "
     "where the sets were made by different generators, options, counts or warps",
     analyze},
    {"--pool", "", "", "one mean of all sets, however they were made", analyze},
    {"--full", "", "", "as text, with all numbers of long lists, as tables", analyze},
    {"--explain", "", "",
     "as text, with what each result means, which of two is better, and what is typical of 1024 "
     "points in the plane",
     analyze},
    {"--chart",
     "points|density|pairs|histogram|distances|spectrum|radial|pair-correlation|differential|"
     "local-discrepancy",
     "points",
     "what to draw of points: their places (of three coordinates a view, of more each pair of the "
     "first 8), counts, each pair of coordinates, histograms, distances to the nearest neighbour, "
     "what analyze finds with its default options, or the local discrepancy of the square with the "
     "worst boxes of the star discrepancy",
     plot},
    {"--key", "KEY", "", "result to draw of a report, such as prefixes.value or minimum", plot},
    {"--set", "K", "", "draw only set or report K, from 0; default: all", plot},
    {"--overlay", "", "",
     "several sets of points in one frame, in colours; default: a frame for each", plot},
    {"--draw", "cells,gap", "",
     "over the points of a plane: their Voronoi cells, the largest empty circle, or both", plot},
    {"--keys", "KEY,...", "",
     "results to keep, by name or by a dotted part of it: value, radial.power, mean[0]; "
     "default: all numbers",
     study},
    {"--summary", "", "",
     "means with standard errors, t and bootstrap intervals, medians, root mean squares, and "
     "pairwise comparisons of generators with Holm-corrected p-values",
     study},
    {"--curves", "", "", "also keep lists, a row for each number: radial.power[3]", study},
    {"--resume", "", "",
     "continue the study in the output file, also with more seeds, counts, generators, ...; start "
     "it if there is none",
     study},
    {"--overwrite", "", "", "replace the study that the file holds", study},
    {"--domain", "SPEC", "",
     "domain of the points: unit-cube, disk, triangle:vertices=[...], ...; default: as the file "
     "states",
     analyze | plot | report},
    {"--rescale", "", "",
     "first map the box of --bounds, else the bounding box of the points, to the unit cube",
     analyze},
    {"--rescale", "", "", "first map the bounding box of the points of files to the unit cube",
     plot | report},
    {"--meta", "", "",
     "write the provenance: in '# ' lines on top of text formats; for npy, bin, utk and psa in "
     "FILE.meta.json",
     writers},
    {"--vector-output", "FILE", "",
     "of points of a lattice: also writes its generating vector, as their provenance tells it",
     convert},
    {"--vector-format", "lddata|latnet-builder", "lddata", "form of --vector-output", convert},
    {"--with-pdf", "", "", "add a column with the density of each point", generate | warp},
    {"--with-weight", "", "",
     "add a column with 1 / density: the mean of f times weight estimates the integral of f",
     generate | warp},
    {"--density-at", "", "",
     "the points stay where they are, with a column of the warp's density there: 0 off its domain",
     warp},
    {"--shard", "I/K", "0/1",
     "the I-th of K (from 0) contiguous parts; concatenated they are the whole set", generate},
    {"--title", "TEXT", "", "default: from the provenance; '' for neither title nor subtitle",
     plot},
    {"--labels", "A,B,...", "",
     "names of the sets or curves in legends and titles, in their order; of a study its generators",
     plot},
    {"--axes", "X,Y,...", "",
     "names of the axes: of points all coordinates; of curves x, then the y of each panel", plot},
    {"--theme", "light|dark", "light", "colours", plot},
    {"--width", "W", "", "pixels, or characters of text; default: automatic", plot},
    {"--height", "H", "",
     "pixels, or lines of text; default: automatic; with --width, several sets stand in the rows "
     "that make them largest",
     plot},
    {"--x-scale", "linear|log", "", "scale of curves and histograms; default: automatic", plot},
    {"--y-scale", "linear|log", "", "scale of curves and histograms; default: automatic", plot},
    {"--pairs", "welch|paired", "welch",
     "compare by Welch's t test, or by paired differences of sets with one seed", study},
    {"--confidence", "C", "0.95", "confidence level of the intervals", study},
    {"--bootstrap", "B", "2000", "bootstrap resamples", study, false, 1, 10'000'000},
    {"--time-limit", "SECONDS", "",
     "limit for making a set, and for each measure of it; what takes longer fails", study},
    {"--no-seconds", "", "", "omit the timing columns, so that every run gives the same bytes",
     study},
    {"--yes", "", "", "start even with more than 10 million rows", study},
    {"--max-work", "N", "1e9",
     "comparisons of each search for a worst box (a few seconds); a search that stops there "
     "gives rigorous bounds",
     report, false, 1, most_work},
    {"--concat", "", "", "join all INPUTs into one set, in order, such as the shards of a set",
     analyze | convert},
    {"--column", "X,Y,...", "", "columns to read, by name or number (from 1)", readers},
    {"--from", "FORMAT", "", "format of the input; default: from its extension or first bytes",
     readers},
    {"-d,--dimension", "D", "", "coordinates of a point; required for raw binary files", readers,
     false, 1, most_dimensions},
    {"--input", "FILE", "",
     "a file that the points were made from, under whatever name; no other file is read", reproduce,
     true},
    {"--input-dtype", "f64|f32", "f64", "number type of raw binary input", readers},
    {"--output-dtype", "f64|f32", "f64", "number type of binary formats that are written", writers},
    {"--dtype", "f64|f32", "f64", "short for --output-dtype", generate | convert},
    {"--dtype", "f64|f32", "f64", "short for --input-dtype", analyze | plot | report},
    {"--dtype", "f64|f32", "f64", "short for --input-dtype and --output-dtype", warp},
    {"--precision", "P", "",
     "digits after the point, truncated; default: the shortest text that reads back exactly",
     writers, false, 0, 1000},
    {"--no-header", "", "", "omit the header line of csv", writers},
    {"--threads", "T", "0", "0 = all cores; never changes a result", workers, false, 0, 4096},
    {"--max-memory", "SIZE", "80 % of the machine's",
     "refuse, before starting, what would need more; 500M, 2G", workers},
    {"--quiet", "", "", "no warnings and no progress", workers},
    {"--progress", "auto|always|never", "auto", "a bar on stderr, after 0.5 s on a terminal",
     workers}};

}  // namespace
}  // namespace table

const std::vector<VerbInfo>& verbs() {
    static const auto table = [] {
        std::vector<VerbInfo> all;
        for (const auto& [verb, name] : {std::pair{Verb::generate, "generate"},
                                         {Verb::warp, "warp"},
                                         {Verb::analyze, "analyze"},
                                         {Verb::convert, "convert"},
                                         {Verb::plot, "plot"},
                                         {Verb::study, "study"},
                                         {Verb::report, "report"},
                                         {Verb::list, "list"},
                                         {Verb::reproduce, "reproduce"},
                                         {Verb::help, "help"},
                                         {Verb::completions, "completions"}})
            all.push_back({verb_page(name), verb, name});
        return all;
    }();
    return table;
}

const VerbInfo* find_verb(std::string_view name) {
    const auto it = std::ranges::find(verbs(), name, &VerbInfo::name);
    return it == verbs().end() ? nullptr : &*it;
}

const VerbInfo& info_of(Verb verb) { return *std::ranges::find(verbs(), verb, &VerbInfo::verb); }

CommonOption::CommonOption(std::string_view all_names, std::string_view placeholder,
                           const char* shown_default, const char* help, Verb of_verbs, bool several,
                           double low, double high)
    : names(all_names),
      value(placeholder),
      fallback(shown_default),
      option{.name = std::string(all_names.substr(all_names.rfind("--") + 2)),
             .type = "text",
             .fallback = fallback,
             .optional = true,
             .low = low,
             .high = high,
             .help = help},
      verbs(of_verbs),
      repeatable(several) {
    if (value.empty()) option.type = "flag";
    if (high > 0) option.type = "integer";
    if (value == "FILE" || value == "FOLDER") option.type = "file";
    if (value.find('|') == std::string::npos) return;
    option.type = "choice";
    for (const auto word : split(value, '|')) option.choices.emplace_back(word);
}

std::vector<const CommonOption*> options_of(Verb verb) {
    std::vector<const CommonOption*> found;
    for (const CommonOption& option : table::rows)
        if ((static_cast<unsigned>(option.verbs) & static_cast<unsigned>(verb)) != 0)
            found.push_back(&option);
    return found;
}

const CommonOption* find_common(std::string_view name, Verb verb) {
    for (const CommonOption* option : options_of(verb))
        for (const auto known : split(option->names, ','))
            if (known == name) return option;
    return nullptr;
}

std::vector<Option> own_options(Verb verb, const UnitInfo& unit) {
    std::vector<Option> own = unit.options;
    std::erase_if(own, [&](const Option& option) {
        return find_common("--" + option.name, verb) != nullptr;
    });
    return own;
}

}  // namespace stipple::cli
