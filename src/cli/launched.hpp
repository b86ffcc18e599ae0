// SPDX-License-Identifier: MIT
//
// What an MPI launcher started.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include "pipeline/ranks.hpp"

namespace stipple::cli {

/// Processes that an MPI launcher started, 1 if none did.
std::uint64_t launched_ranks();

/// Whether another of them speaks for all.
bool is_mute();

/// Joins the others. @throws Error(usage) where there are others and the build has no MPI
std::unique_ptr<Ranks> launched(std::string_view verb, const RunContext& run);

}  // namespace stipple::cli
