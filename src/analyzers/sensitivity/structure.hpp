// SPDX-License-Identifier: MIT
//
// What rows show that no method of structured designs takes: that they are no independent sample.
#pragma once

#include "analyzers/sensitivity/effects.hpp"

namespace stipple::analyzers::sensitivity {

/// The share of rows that differ from another row in exactly one coordinate; 0 of full factorials, and
/// where it would take too long.
double share_of_neighbors(const PointSet& points, const RunContext& run);

/// Notes the two inputs whose rank correlation is the largest, if it is too large for independent ones.
void note_dependence(const Inputs& in, const RunContext& run);

}  // namespace stipple::analyzers::sensitivity
