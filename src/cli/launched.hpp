// SPDX-License-Identifier: MIT
//
// What an MPI launcher started.
#pragma once

#include <cstdint>
#include <string_view>

#include "pipeline/ranks.hpp"

namespace stipple::cli {

/// Processes that an MPI launcher started, 1 if none did.
std::uint64_t launched_ranks();

/// Whether an MPI launcher started this process, which gives it a terminal of its own where its
/// output goes into a file.
bool is_launched();

/// Whether another of them reports errors for all: where a launcher started several processes for
/// this verb. Verbs that ranks do not share speak for themselves, wherever they run.
bool is_mute(std::string_view verb);

/// Joins the others, until leave_ranks(). @throws Error(usage) where there are others and MPI does
/// not find them, or the build has none
Ranks& launched(std::string_view verb, const RunContext& run);

/// What ends this process: its own error, which the others are told, or that of one that failed
/// before.
Error shared_failure(const Error& error);

/// To be called when everything is said: a launcher ends all processes as soon as one has failed.
void leave_ranks();

}  // namespace stipple::cli
