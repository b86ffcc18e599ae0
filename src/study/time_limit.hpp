// SPDX-License-Identifier: MIT
//
// Work that must end after a while: it is told to stop as if the user had asked for it.
#pragma once

#include <functional>
#include <optional>

#include "stipple/run.hpp"

namespace stipple {

/// Calls work with a run that is told to stop after so many seconds, as run.seconds counts them.
/// True: the time was over before the work was. What work throws is thrown on, except when the
/// limit made it stop.
bool over_time(const RunContext& run, std::optional<double> seconds,
               const std::function<void(const RunContext&)>& work);

}  // namespace stipple
