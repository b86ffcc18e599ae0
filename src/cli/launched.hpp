// SPDX-License-Identifier: MIT
//
// What an MPI launcher started.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "pipeline/ranks.hpp"

namespace stipple::cli {

/// Processes that an MPI launcher started, 1 if none did.
std::uint64_t launched_ranks();

/// Whether another of them reports errors for all: where a launcher started several processes for
/// this verb. Verbs that ranks do not share speak for themselves, wherever they run.
bool is_mute(std::string_view verb);

/// Joins the others, until leave_ranks(). @throws Error(usage) where there are others and MPI does
/// not find them, or the build has none
Ranks& launched(std::string_view verb, const RunContext& run);

/// To be called when everything is said: a launcher ends all processes as soon as one has failed.
void leave_ranks();

}  // namespace stipple::cli
