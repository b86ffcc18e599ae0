// SPDX-License-Identifier: MIT
//
// What the verbs do; each returns the exit code.
#pragma once

#include <span>

#include "cli/arguments.hpp"
#include "cli/session.hpp"
#include "io/point_stream.hpp"
#include "pipeline/produce.hpp"

namespace stipple::cli {

int generate(const Arguments& arguments, Session& session);
int warp(const Arguments& arguments, Session& session);
int analyze(const Arguments& arguments, Session& session);
int convert(const Arguments& arguments, Session& session);
int plot(const Arguments& arguments, Session& session);
int report(const Arguments& arguments, Session& session);
int study(const Arguments& arguments, Session& session);
int list(const Arguments& arguments, const std::vector<Kind>& kinds);
int reproduce(const Arguments& arguments, const std::vector<Kind>& kinds, Session& session);
int help(const Arguments& arguments, const std::vector<Kind>& kinds);
int completions(const Arguments& arguments);

/// What may stand for the last of the words, and why, a candidate a line; "@files" where a file's
/// name may. For the scripts of `completions`.
std::string complete(std::vector<std::string> words, const std::vector<Kind>& kinds);

/// What `generate` was asked to make.
Production production_of(const Arguments& arguments, Session& session);

/// --seed, or one that is drawn and reported, at most `largest`. @throws Error(usage)
std::uint64_t seed_of(const Arguments& arguments, std::uint64_t largest, Session& session);

/// Where points go, as -o, -f, --dtype, --precision, --meta and --no-header say.
Target target_of(const Arguments& arguments);

/// The inputs that are named, or standard input. @throws Error(usage) when that is named twice
std::vector<std::string> input_names(const Arguments& arguments);

/// Where a verb writes its one file. @throws Error(usage) for a name with {set} or {seed}
std::string output_of(const Arguments& arguments);

/// The sets of an input file, with their domain; --from, -d, --column, --dtype are heeded.
std::vector<PointSet> read_input(const std::string& path, const Arguments& arguments,
                                 const RunContext& run);

/// The same of the bytes of a file that was read already.
std::vector<PointSet> read_input(std::string_view bytes, const std::string& path,
                                 const Arguments& arguments, const RunContext& run);

/// The same in blocks, where they are many; their domain is input_domain.
/// `strengths` names a column that comes behind the coordinates.
std::unique_ptr<io::PointStream> open_input(const std::string& path, const Arguments& arguments,
                                            const RunContext& run,
                                            const std::string& strengths = {});

/// All inputs as one set, for --concat.
std::unique_ptr<io::PointStream> open_joined(const Arguments& arguments, const RunContext& run,
                                             const std::string& strengths = {});
std::vector<PointSet> read_joined(const Arguments& arguments, const RunContext& run);

/// What points of a file live on.
DomainPtr input_domain(const Provenance& provenance, std::size_t dimension,
                       const Arguments& arguments, const RunContext& run);

/// A word as a shell takes it, in quotes where it must be.
std::string shell_word(const std::string& word);

/// What was typed of a verb's inputs and common options, as a shell takes it; less what is left
/// out.
std::string command_text(const Arguments& arguments, std::span<const std::string> left_out);

/// The unit's options as typed. @throws Error(usage)
Values settings_of(const Schema& schema, const Arguments& arguments);

/// What is asked of a generator: -n, -d, --start; without seed and bounds.
Request request_of(const Arguments& arguments);

/// Writes text to a file or standard output, whole or not at all.
void write_text(const std::string& path, const std::string& text);

}  // namespace stipple::cli
