// SPDX-License-Identifier: MIT
//
// What the verbs do; each returns the exit code.
#pragma once

#include <initializer_list>
#include <span>
#include <string_view>

#include "analyzers/analyzer.hpp"
#include "cli/parsing/arguments.hpp"
#include "cli/session.hpp"
#include "pipeline/produce.hpp"
#include "report/average.hpp"
#include "report/document.hpp"

namespace stipple::cli {

/// The whole program: parses, works, prints; returns the exit code of the contract.
int run(int argc, char** argv);

int generate(const Arguments& arguments, Session& session);
int warp(const Arguments& arguments, Session& session);
int analyze(const Arguments& arguments, Session& session);
int convert(const Arguments& arguments, Session& session);
int plot(const Arguments& arguments, Session& session);
int report(const Arguments& arguments, Session& session);
int study(const Arguments& arguments, Session& session);
int list(const Arguments& arguments);
int reproduce(const Arguments& arguments, Session& session);
int help(const Arguments& arguments);
int completions(const Arguments& arguments);

/// What may stand for the last of the words, and why, a candidate a line; "@files" where a file's
/// name may. For the scripts of `completions`.
std::string complete(std::vector<std::string> words);

/// What --help says for the program, a verb, or a unit of a verb; made from the records.
std::string help_text(const Arguments& arguments);

/// Points of a generator, or of the image of a warp, in letters; empty where there are none to show.
std::string picture_in_letters(Verb verb, const UnitInfo& unit);

/// stipple and the libraries it is linked with.
std::string version_text();

/// What `generate` was asked to make.
SetsToMake sets_to_make(const Arguments& arguments, Session& session);

/// Where points go, as -o, -f, --dtype, --precision, --meta and --no-header say.
Target target_of(const Arguments& arguments);

/// Where a verb writes its one file. @throws Error(usage) for a name with {set} or {seed}
std::string output_of(const Arguments& arguments);

/// Whether this is standard output, and a terminal.
bool is_terminal(const std::string& path);

/// A word as a shell takes it, in quotes where it must be.
std::string shell_word(const std::string& word);

/// " --name value", as a shell takes it.
std::string typed_option(const std::string& name, const std::string& value, bool flag);

/// What was typed of a verb's inputs and common options, as a shell takes it; less what is left
/// out, and what never changes a result.
std::string command_text(const Arguments& arguments,
                         std::initializer_list<std::string_view> left_out = {});

/// The unit's options as typed. @throws Error(usage)
Values settings_of(const Schema& schema, const Arguments& arguments);

/// Puts the mean of an analyzer's results on several sets into a measurement.
void take_mean(Measurement& m, const ReportAverage& average, std::span<const Report> sets,
               const Analyzer& analyzer, const Values& options);

/// Writes text to a file or standard output, whole or not at all.
void write_text(const std::string& path, const std::string& text);

}  // namespace stipple::cli
