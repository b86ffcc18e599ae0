// SPDX-License-Identifier: MIT
//
// What many units share stays small: a virtual function of a shared class is overridden at least
// twice, a field of a unit's record is set by at least two units, and both are used somewhere. What
// does not follow the rule is listed below with its reason.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <string_view>

#include "places.hpp"

namespace stipple::testing::hooks_test {
namespace {

namespace fs = std::filesystem;

const fs::path src = STIPPLE_SOURCE_DIR "/src";

/// Hooks with one implementation.
const std::map<std::string, std::string> exceptions = {
    {"rank", "a process alone, or MPI's ranks"},
    {"size", "a process alone, or MPI's ranks"},
    {"host", "a process alone, or MPI's ranks"},
    {"end_together", "a process alone, or MPI's ranks"},
    {"levels", "readers ask every domain, and only named parameters have levels"},
    {"outcome_axes", "the same, of a warp whose domain is not made yet"},
    {"set_step", "only correlations of parameters order whole sets"},
    {"needs_whole_set", "the same, before the options are known"},
    {"refills", "only constraints of parameters replace points that they drop"},
    {"held", "only sets in memory need no copy"},
    {"looks_like_one_set", "only rows of text may hide where sets begin"},
    {"max_seed", "only one generator takes its permutations from 32 bits"},
    {"more_dimensions", "only Sobol' points take direction numbers from a file"},
    {"tabulated", "only expressions of two variables are tabulated"},
    {"table", "only sensitivity is measured in rows that are no points"},
    {"strengths", "only the periodogram has weights of points"},
    {"follow", "only one analyzer measures prefixes while a stream arrives"},
};

std::string code_of(const fs::path& file) {
    std::ifstream in(file);
    std::string code;
    for (std::string line; std::getline(in, line); code += '\n')
        code += line.substr(0, line.find("//"));
    return code;
}

bool in_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

std::string name_at(std::string_view code, std::size_t at) {
    std::size_t end = at;
    while (end < code.size() && in_name(code[end])) ++end;
    return std::string(code.substr(at, end - at));
}

/// How often each name is overridden, set by `.name =` in a file of units, and read by `.name` or
/// `->name` elsewhere.
struct Uses {
    std::map<std::string, int> overrides;
    std::map<std::string, std::set<std::string>> setters;
    std::map<std::string, std::set<std::string>> readers;

    void add(const std::string& file, std::string_view code) {
        for (std::size_t at = code.find("override"); at != code.npos;
             at = code.find("override", at + 1)) {
            std::size_t begin = code.find_last_of(";{}", at) + 1;
            begin = code.find('(', begin);
            if (begin >= at) continue;
            std::size_t first = begin;
            while (first > 0 && in_name(code[first - 1])) --first;
            ++overrides[name_at(code, first)];
        }
        for (std::size_t at = 1; at + 1 < code.size(); ++at) {
            if (code[at] != '.' && (code[at] != '>' || code[at - 1] != '-')) continue;
            const std::string name = name_at(code, at + 1);
            const bool set = !in_name(code[at - 1]) && code[at - 1] != ')' &&
                             code.substr(at + 1 + name.size(), 2) == " =" && code[at] == '.';
            (set ? setters : readers)[name].insert(file);
        }
    }
};

const Uses& uses() {
    static const Uses all = [] {
        Uses found;
        for (const auto& entry : fs::recursive_directory_iterator(src)) {
            const auto extension = entry.path().extension();
            if (extension == ".cpp" || extension == ".hpp")
                found.add(fs::relative(entry.path(), src), code_of(entry.path()));
        }
        return found;
    }();
    return all;
}

template <class Map>
std::size_t count_of(const Map& map, const std::string& name) {
    const auto found = map.find(name);
    if (found == map.end()) return 0;
    if constexpr (requires { found->second.size(); })
        return found->second.size();
    else
        return static_cast<std::size_t>(found->second);
}

/// Calls visit(name) for each match's first group in the code.
template <class Visit>
void for_each_match(const std::string& code, const char* pattern, const Visit& visit) {
    const std::regex expression(pattern);
    for (std::sregex_iterator at(code.begin(), code.end(), expression), end; at != end; ++at)
        visit((*at)[1].str());
}

}  // namespace

TEST(Hooks, VirtualFunctionsOfSharedClassesAreOverriddenTwice) {
    int checked = 0;
    for (const char* folder : {"core", "io", "generators", "scrambles", "warps", "analyzers"})
        for (const auto& entry : fs::directory_iterator(src / folder)) {
            if (entry.path().extension() != ".hpp") continue;
            for_each_match(
                code_of(entry.path()), R"(virtual [^;{=~]*?(\w+)\()", [&](const std::string& name) {
                    ++checked;
                    EXPECT_GE(count_of(uses().readers, name), 1U) << entry.path() << ": " << name;
                    if (!exceptions.contains(name)) {
                        EXPECT_GE(count_of(uses().overrides, name), 2U)
                            << entry.path() << ": " << name << " is overridden once";
                    }
                });
        }
    EXPECT_GT(checked, 50);
}

TEST(Hooks, FieldsOfRecordsAreSetByTwoUnits) {
    int checked = 0;
    for (const char* header : {"generators/generator.hpp", "scrambles/scramble.hpp",
                               "warps/warp.hpp", "analyzers/analyzer.hpp"}) {
        const std::string code = code_of(src / header);
        for (const auto* record : {"Generator", "Scramble", "Warp", "Analyzer", "GeneratorTraits",
                                   "WarpTraits", "AnalyzerTraits"}) {
            const std::size_t begin = code.find("struct " + std::string(record) + " ");
            if (begin == code.npos) continue;
            const std::string body = code.substr(begin, code.find("\n};", begin) - begin);
            for_each_match(body, R"(\n    [^\n;{=]*[ )](?!const;)(\w+)( = [^;]*)?;)",
                           [&](const std::string& name) {
                               ++checked;
                               EXPECT_GE(count_of(uses().readers, name), 1U)
                                   << header << ": " << name;
                               if (!exceptions.contains(name)) {
                                   EXPECT_GE(count_of(uses().setters, name), 2U)
                                       << header << ": " << name << " is set by one unit";
                               }
                           });
        }
    }
    EXPECT_GT(checked, 30);
}

// What is listed is declared somewhere, and still has one implementation.
TEST(Hooks, ExceptionsAreNeeded) {
    for (const auto& [name, reason] : exceptions)
        EXPECT_LE(std::min(count_of(uses().overrides, name), count_of(uses().setters, name)), 1U)
            << name << ": " << reason;
}

}  // namespace stipple::testing::hooks_test
