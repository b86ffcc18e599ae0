// SPDX-License-Identifier: MIT
//
// Functions that several verbs call.
#pragma once

#include <initializer_list>
#include <span>
#include <string_view>

#include "analyzers/analyzer.hpp"
#include "cli/parsing/requests.hpp"
#include "pipeline/produce.hpp"
#include "report/average.hpp"
#include "report/document.hpp"

namespace stipple::cli {

/// Runs the whole program; returns the exit code.
int run(int argc, char** argv);

/// Reads the parameter file of the request, and performs it; returns the exit code.
int work_on(Request& request, Session& session);

/// Candidates for the last word, one per line with its explanation; "@files" if a file name is
/// possible. Called by the scripts of `completions`.
std::string complete(std::vector<std::string> words);

/// Text of --help for the program, a verb, or a unit of a verb; made from the units' records.
std::string help_text(const Arguments& arguments);

/// All words that `stipple help WORD` explains: topics, verbs, units and terms.
std::vector<std::string> explained_words();

/// Versions of stipple and the libraries it is linked with.
std::string version_text();

/// The sets that a `generate` command requests.
SetsToMake sets_to_make(const GenerateRequest& request, Session& session);

/// Output as requested by -o, -f, --dtype, --precision, --meta and --no-header.
Target target_of(const Writing& request);

/// Path of the output of a verb that writes one file. @throws Error(usage) for a name with {set} or
/// {seed}
std::string output_of(const Request& request);

/// Whether the path is "-" and standard output is a terminal; always false under mpirun.
bool is_terminal(const std::string& path);

/// The common options with these names as typed, in the order of `names`, quoted for a shell.
std::string typed_options(const Arguments& arguments,
                          std::initializer_list<std::string_view> names);

/// A generator of --generate as words of 'stipple generate', quoted for a shell.
std::string typed_generator(const std::string& text);

/// Whether the points depend on the seed.
bool seed_matters(const Generator& generator, const Provenance& from);

/// Options of a set's generator that are not at their defaults, such as "scramble=owen", except
/// long ones and those that the generator decided.
/// @param typed command or spec that made the set; empty if unknown
std::vector<std::string> changed_options(const Provenance& from, const Generator& generator,
                                         std::string_view typed);

/// The command of a verb as typed, quoted for a shell; without the options in `left_out` and those
/// that never affect a result. @param seed if given, replaces that of --seed, which may be random
std::string command_text(const Arguments& arguments, std::vector<std::string> left_out = {},
                         std::optional<std::uint64_t> seed = {});

/// Stores in a measurement the mean of an analyzer's results over sets, with standard errors if
/// there are several.
void take_mean(Measurement& m, const ReportAverage& average, std::span<const Report> sets,
               const Analyzer& analyzer, const Values& options);

/// Writes text to a file or standard output, completely or not at all.
void write_text(const std::string& path, const std::string& text);

}  // namespace stipple::cli
