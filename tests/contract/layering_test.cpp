// SPDX-License-Identifier: MIT
//
// Data moves in one direction along the folders of src/: a folder includes only those to its left,
// and engines do not include each other. Nothing else includes the experiments, which may be left
// out. No two sources include each other's headers, and none names a unit.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/bytes/file_bytes.hpp"
#include "io/format.hpp"
#include "math/distributions/families.hpp"
#include "pipeline/units.hpp"
#include "places.hpp"
#include "support/contract.hpp"

namespace stipple::testing::layering_test {
namespace {

/// Names of all units; of formats only if asked, since their extensions are used by readers.
std::set<std::string> names_of_units(bool with_formats) {
    std::set<std::string> all;
    for (const auto& names : {names_of(generators::all()), names_of(scrambles::all()),
                              names_of(warps::all()), names_of(analyzers::all())})
        all.insert(names.begin(), names.end());
    const auto formats = names_of(io::all());
    if (with_formats) all.insert(formats.begin(), formats.end());
    return all;
}

/// Folders of src/ in their order; those in one row do not include each other. The public API is
/// first: its headers include nothing else.
const std::vector<std::vector<std::string>> line = {
    {"stipple"},     {"core"},     {"math"},
    {"media"},       {"io"},       {"generators", "scrambles", "warps", "analyzers"},
    {"experiments"}, {"pipeline"}, {"emit"},
    {"report"},      {"study"},    {"plot"},
    {"page"},        {"cli"},      {"python"}};

/// Folders whose subfolders are engines, which do not include each other.
const std::set<std::string> of_engines = {"generators", "warps", "analyzers", "experiments"};

/// Position of a folder in that order.
std::size_t place_of(const std::string& folder) {
    for (std::size_t i = 0; i < line.size(); ++i)
        if (std::ranges::find(line[i], folder) != line[i].end()) return i;
    return line.size();
}

/// Top folder and subfolder: "core" and "" for core/rng.hpp, "warps" and "planar" for
/// warps/planar/disk.cpp.
std::pair<std::string, std::string> folders_of(const std::filesystem::path& path) {
    const std::vector<std::string> parts(path.begin(), path.end());
    return {parts.front(), parts.size() > 2 ? parts[1] : ""};
}

/// Whether a file of src/ may include another one.
bool may_include(const std::filesystem::path& file, const std::filesystem::path& included) {
    const auto [folder, engine] = folders_of(file);
    const auto [left, other] = folders_of(included);
    if (folder != left) return place_of(left) < place_of(folder) && left != "experiments";
    return !of_engines.contains(folder) || other.empty() || other == engine;
}

const std::filesystem::path src = STIPPLE_SOURCE_DIR "/src";

/// Sources and headers of a folder of src/.
std::vector<std::filesystem::path> files_of(const std::string& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(src / folder)) {
        const auto extension = entry.path().extension();
        if (extension == ".cpp" || extension == ".hpp") files.push_back(entry.path());
    }
    return files;
}

/// Headers of src/ that a file includes.
std::vector<std::filesystem::path> includes_of(const std::filesystem::path& file) {
    static const std::regex include(R"re(^\s*#\s*include\s*"([^"]+)")re");
    std::vector<std::filesystem::path> included;
    std::ifstream in(file);
    std::smatch match;
    for (std::string text; std::getline(in, text);)
        if (std::regex_search(text, match, include)) included.emplace_back(match[1].str());
    return included;
}

/// Path without extension, the same for a source and its header.
std::string source_of(std::filesystem::path path) { return path.replace_extension(); }

/// For each source with its header, the sources whose headers it includes.
std::map<std::string, std::set<std::string>> source_graph() {
    std::map<std::string, std::set<std::string>> graph;
    for (const auto& place : line)
        for (const auto& folder : place)
            for (const auto& file : files_of(folder)) {
                const auto source = source_of(std::filesystem::relative(file, src));
                for (const auto& header : includes_of(file))
                    graph[source].insert(source_of(header));
                graph[source].erase(source);
            }
    return graph;
}

/// Sources in cycles of inclusion or between two cycles: those that remain after repeatedly
/// removing sources that include no remaining source or are included by none.
std::set<std::string> sources_in_cycles(std::map<std::string, std::set<std::string>> graph) {
    for (std::size_t before = 0; before != graph.size();) {
        before = graph.size();
        std::set<std::string> included;
        for (const auto& node : graph) included.insert(node.second.begin(), node.second.end());
        std::erase_if(graph, [&](const auto& node) {
            return !included.contains(node.first) ||
                   std::ranges::none_of(node.second, [&](const std::string& other) {
                       return graph.contains(other);
                   });
        });
    }
    std::set<std::string> left;
    for (const auto& node : graph) left.insert(node.first);
    return left;
}

/// Units with ordinary words as names, which are also names of results, options and their values,
/// or of distributions.
std::set<std::string> ordinary_words() {
    std::set<std::string> words = {
        "design",    "digital-shift", "disk",        "dispersion", "empirical", "fast",
        "faure",     "grid",          "image",       "jittered",   "matrix",    "mixture",
        "morris",    "owen",          "parameters",  "pixel",      "power",     "random",
        "rejection", "saltelli",      "sensitivity", "simplex",    "truncated"};
    for (const MarginalFamily& family : marginal_families()) words.emplace(family.name);
    return words;
}

/// Likewise in the folders after the units, which take from records whatever depends on a unit.
const std::set<std::string> ordinary_after_units = {
    "bin",      "csv",         "json",       "jsonl", "svg",  // values of --format
    "grid",     "image",       "pixel",      "power",         // keys of results and their files
    "integers", "log-uniform", "parameters",                  // words of parameter files
    "jittered", "random",      "uniform"};  // picture of a warp's strata, --seed random, a density

/// Files that name units of other files, with these units.
const std::map<std::string, std::set<std::string>> exceptions = {
    // The default format is not repeated in commands; raw files have no head.
    {"cli/points.cpp", {"csv"}},
    {"cli/reproduce.cpp", {"bin"}},
    // Designs are compared with the usual choice.
    {"experiments/quality/design.cpp", {"latin-hypercube"}},
};

/// Names of units in a file's strings, except the file's own unit.
std::set<std::string> units_named_in(const std::filesystem::path& file) {
    const std::string folder = folders_of(std::filesystem::relative(file, src)).first;
    const bool after_units = place_of(folder) > place_of("experiments");
    static const std::set<std::string> both[] = {names_of_units(false), names_of_units(true)};
    const std::set<std::string>& names = both[after_units ? 1 : 0];
    static const std::set<std::string> ordinary = ordinary_words();
    const std::set<std::string>& words = after_units ? ordinary_after_units : ordinary;
    static const std::regex string(R"re((name|generator|warp|analyzer)?(?: [!=]= )?"([^"]*)")re");
    std::string own = file.stem();
    std::ranges::replace(own, '_', '-');
    std::set<std::string> found;
    std::ifstream in(file);
    for (std::string text; std::getline(in, text);) {
        text.erase(std::min(text.find("//"), text.size()));
        for (std::sregex_iterator at(text.begin(), text.end(), string), end; at != end; ++at)
            if (const std::string word = (*at)[2]; names.contains(word) && word != own)
                if ((*at)[1].matched || !words.contains(word)) found.insert(word);
    }
    return found;
}

/// README of a file's folder, or of the nearest folder above that has one; empty if none has.
std::filesystem::path readme_of(const std::filesystem::path& file) {
    for (auto folder = file.parent_path(); folder != src; folder = folder.parent_path())
        if (exists(folder / "README.md")) return folder / "README.md";
    return {};
}

/// Whether a text has a source between backquotes: `disk`, `disk.hpp` or `planar/disk`.
bool names_source(const std::string& text, const std::string& stem) {
    return std::regex_search(text, std::regex("`([\\w.]+/)*" + stem + "(\\.[ch]pp)?`"));
}

void expect_nowhere(const std::regex& forbidden, const std::string& folder) {
    for (const auto& file : files_of(folder)) {
        std::ifstream in(file);
        for (std::string text; std::getline(in, text);)
            EXPECT_FALSE(std::regex_search(text, forbidden)) << file << ": " << text;
    }
}

}  // namespace

TEST(Layering, EveryFileIncludesOnlyWhatStandsLeftOfIt) {
    std::size_t files = 0;
    for (const auto& place : line)
        for (const auto& folder : place)
            for (const auto& file : files_of(folder)) {
                ++files;
                for (const auto& header : includes_of(file))
                    EXPECT_TRUE(may_include(std::filesystem::relative(file, src), header))
                        << file << ": " << header;
            }
    EXPECT_GT(files, 40U);
}

TEST(Layering, NoTwoSourcesIncludeEachOther) {
    const std::map<std::string, std::set<std::string>> cycle = {
        {"a", {"b"}}, {"b", {"a"}}, {"c", {}}};
    EXPECT_EQ(sources_in_cycles(cycle), (std::set<std::string>{"a", "b"}));
    EXPECT_EQ(sources_in_cycles(source_graph()), std::set<std::string>{});
}

// Special properties of a unit belong in its record, so that new units need no change elsewhere.
TEST(Layering, NoUnitIsNamedOutsideItsOwnFile) {
    for (const auto& place : line)
        for (const auto& folder : place)
            for (const auto& file : files_of(folder)) {
                std::set<std::string> known;
                const auto found = exceptions.find(std::filesystem::relative(file, src));
                if (found != exceptions.end())
                    std::ranges::set_intersection(found->second, names_of_units(true),
                                                  std::inserter(known, known.end()));
                EXPECT_EQ(units_named_in(file), known)
                    << file << ": a string here is the name of a unit. Ask the unit's record "
                    << "for what depends on it. If the word means something else, take another "
                    << "one, or add it to ordinary_words() above.";
            }
}

TEST(Layering, NoFolderIsLeftOut) {
    for (const auto& entry : std::filesystem::directory_iterator(STIPPLE_SOURCE_DIR "/src"))
        EXPECT_TRUE(!entry.is_directory() || place_of(entry.path().filename()) < line.size())
            << entry.path();
}

// A folder without a README belongs to the one above it, which may leave out units: a unit's file has
// its name.
TEST(Layering, EverySourceIsNamedInTheReadmeOfItsFolder) {
    EXPECT_TRUE(names_source("a `b/disk.hpp`", "disk"));
    EXPECT_FALSE(names_source("a disk, `disk_maps`", "disk"));
    const std::set<std::string> units = names_of_units(true);
    for (const auto& place : line)
        for (const auto& folder : place)
            for (const auto& file : files_of(folder)) {
                const auto readme = readme_of(file);
                std::string unit = file.stem();
                std::ranges::replace(unit, '_', '-');
                const bool own = readme.parent_path() == file.parent_path();
                const bool listed =
                    units.contains(unit) || (folder == "experiments" && !STIPPLE_EXPERIMENTS);
                if (readme.empty() || (listed && !own)) continue;
                EXPECT_TRUE(names_source(read_file(readme), file.stem()))
                    << readme << " does not name " << file.filename();
            }
}

// Checks the rule "only cli/ prints" in the code.
TEST(Layering, OnlyTheCommandLinePrintsOrExits) {
    const std::regex forbidden(
        R"(\b(std::cout|std::cerr|std::clog|printf\(|fmt::print|std::exit|std::abort|std::getenv)\b)");
    for (const auto& place : line)
        for (const auto& folder : place)
            if (folder != "cli") expect_nowhere(forbidden, folder);
}

// Standard distributions differ between libraries; clocks and engines make points that cannot be
// reproduced.
TEST(Layering, PointsComeFromNoClockAndNoStandardDistribution) {
    const std::regex forbidden(
        R"(std::(uniform_\w+_distribution|normal_distribution|random_device|default_random_engine)|std::chrono|\btime\(|\bclock\()");
    for (const char* folder :
         {"core", "math", "media", "generators", "scrambles", "warps", "analyzers"})
        expect_nowhere(forbidden, folder);
}

// Untrusted text is never printed raw: messages are printed by say_line(), which escapes them, and
// only these files write anything.
TEST(Layering, MessagesLeaveInOnePlace) {
    const std::regex prints(
        R"re(std::c(out|err|log)\b|\b(puts|f?printf|fputs|fwrite|perror)\(|::write\(\w)re");
    const std::set<std::string> writers = {"core/bytes/spool.cpp", "cli/session.cpp",
                                           "io/output.cpp", "study/study_file.cpp"};
    for (const auto& place : line)
        for (const auto& folder : place)
            for (const auto& file : files_of(folder)) {
                if (writers.contains(std::filesystem::relative(file, src))) continue;
                std::ifstream in(file);
                for (std::string text; std::getline(in, text);) {
                    text.erase(std::min(text.find("//"), text.size()));
                    EXPECT_FALSE(std::regex_search(text, prints)) << file << ": " << text;
                }
            }
    std::ifstream in(src / "cli/session.cpp");
    for (std::string statement; std::getline(in, statement, ';');)
        EXPECT_TRUE(statement.find("say(fmt::format(") == statement.npos ||
                    statement.find("printable(") != statement.npos)
            << statement;
}

}  // namespace stipple::testing::layering_test
