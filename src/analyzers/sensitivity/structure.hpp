// SPDX-License-Identifier: MIT
//
// Signs that rows are not an independent sample although they form no design of a known method.
#pragma once

#include "analyzers/sensitivity/effects.hpp"

namespace stipple::analyzers::sensitivity {

/// Fraction of rows that differ from another row in exactly one coordinate, if it is far above
/// chance; otherwise 0, also for full factorials and for too many rows to examine quickly.
double share_of_neighbors(const PointSet& points, const RunContext& run);

/// Warns of the two inputs with the largest rank correlation if it is too large for independent
/// ones.
void note_dependence(const Inputs& in, const RunContext& run);

}  // namespace stipple::analyzers::sensitivity
