// SPDX-License-Identifier: MIT
//
// Processes started by an MPI launcher.
#pragma once

#include <cstdint>
#include <string_view>

#include "cli/parsing/arguments.hpp"
#include "pipeline/ranks.hpp"

namespace stipple::cli {

/// Number of processes that an MPI launcher started; 1 without a launcher.
std::uint64_t launched_ranks();

/// Whether mpirun started this process, which then writes to a terminal even if mpirun's output is
/// redirected to a file.
bool is_launched();

/// Whether rank 0 reports the errors of this process: if this is another rank of a verb that ranks
/// share. Processes of other verbs report their own errors.
bool is_mute(std::string_view verb);

/// Whether ranks share the work of the verb.
bool is_shared(std::string_view verb);

/// Joins the other processes that the launcher started, until leave_ranks(). Does nothing if they
/// are joined.
/// @throws Error(usage) if there are several processes, but MPI does not connect them or is not
/// built in, or if their arguments differ in more than names of points' files and in options that
/// never affect a result
Ranks& launched(const Arguments& arguments, const RunContext& run);

/// The ranks that this process has joined; itself alone before that.
Ranks& joined_ranks();

/// The error to report for this process: its own, which is then sent to the other ranks, or that of
/// a rank that failed earlier. Joins the ranks first if they share the verb.
Error shared_failure(std::string_view verb, const Error& error);

/// Leaves the ranks. Call it after all output: a launcher ends all processes when one fails.
void leave_ranks();

}  // namespace stipple::cli
