// SPDX-License-Identifier: MIT
//
// Signs that rows are not an independent sample, although they form no design that a method takes.
#pragma once

#include "analyzers/sensitivity/effects.hpp"

namespace stipple::analyzers::sensitivity {

/// The share of rows that differ from another row in exactly one coordinate, if that is far more than
/// by chance; else 0, also of full factorials and of so many rows that it would take too long.
double share_of_neighbors(const PointSet& points, const RunContext& run);

/// Notes the two inputs whose rank correlation is the largest, if it is too large for independent ones.
void note_dependence(const Inputs& in, const RunContext& run);

}  // namespace stipple::analyzers::sensitivity
