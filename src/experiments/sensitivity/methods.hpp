// SPDX-License-Identifier: MIT
//
// Methods of the analyzer, each in a source file of the same name. Some are for structured designs,
// with functions that check whether rows form such a design; the others are for any design.
#pragma once

#include "experiments/sensitivity/effects.hpp"

namespace stipple::analyzers::sensitivity {

Layout find_pick_freeze(const PointSet& design);

/// Sobol' indices; ignores base rows with a failed run. @throws Error(input) if too few remain
Effects pick_freeze(const Layout& layout, const Inputs& inputs, const Response& response,
                    const Setting& setting, const RunContext& run);

Layout find_trajectories(const PointSet& design);

/// Elementary effects; ignores trajectories with a failed run. @throws Error(input) if too few
/// trajectories remain
Effects elementary_effects(const Layout& layout, const Inputs& inputs, const Response& response,
                           const Setting& setting, const RunContext& run);

/// Checks that on each curve the ranks of the curve's own input have nearly all their variance at
/// harmonics of w, and those of the other inputs hardly any.
/// @param harmonics M; if empty, that of the first curve
Layout find_curves(const PointSet& design, std::optional<std::size_t> harmonics,
                   const RunContext& run);

/// Indices by extended FAST. @throws Error(input) for failed runs, because a curve with gaps has no
/// spectrum
Effects fourier_amplitudes(const Layout& layout, const Inputs& inputs, const Response& response,
                           const RunContext& run);

/// First-order indices by ranks; ignores failed runs. @throws Error(input) if too few runs remain
Effects rank_indices(const Inputs& inputs, const Response& response, const Setting& setting,
                     const RunContext& run);

/// Indices by polynomial chaos; ignores failed runs. Returns nullopt if no term predicts better
/// than the mean. @throws Error(input) if too few runs remain
std::optional<Effects> polynomial_chaos(const Inputs& inputs, const Response& response,
                                        const Setting& setting, const RunContext& run);

/// Fraction of rows that differ from another row in exactly one coordinate, if this fraction is far
/// above chance; otherwise 0. Also 0 for full factorials, and if there are too many rows to examine
/// quickly.
double share_of_neighbors(const PointSet& points, const RunContext& run);

/// Warns of the two inputs with the largest rank correlation if it refutes independence.
void note_dependence(const Inputs& in, const RunContext& run);

}  // namespace stipple::analyzers::sensitivity
