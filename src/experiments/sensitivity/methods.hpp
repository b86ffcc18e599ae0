// SPDX-License-Identifier: MIT
//
// Methods of the analyzer, each in a source of its name: those for structured designs, with functions
// that find out whether the rows form one, and those for any design.
#pragma once

#include "experiments/sensitivity/effects.hpp"

namespace stipple::analyzers::sensitivity {

Layout find_pick_freeze(const PointSet& design);

/// Leaves out base rows with a failed run. @throws Error(input) if too few remain
Effects pick_freeze(const Layout& layout, const Inputs& inputs, const Response& response,
                    const Setting& setting, const RunContext& run);

Layout find_trajectories(const PointSet& design);

/// Leaves out trajectories with a failed run. @throws Error(input) if too few remain
Effects elementary_effects(const Layout& layout, const Inputs& inputs, const Response& response,
                           const Setting& setting, const RunContext& run);

/// Checks that on each curve nearly all the variance of its own input's ranks is at harmonics of w,
/// and hardly any of the other inputs' ranks.
/// @param harmonics M; if empty, that of the first curve
Layout find_curves(const PointSet& design, std::optional<std::size_t> harmonics,
                   const RunContext& run);

/// @throws Error(input) for failed runs, because a curve with gaps has no spectrum
Effects fourier_amplitudes(const Layout& layout, const Inputs& inputs, const Response& response,
                           const RunContext& run);

/// Leaves out failed runs. @throws Error(input) if too few remain
Effects rank_indices(const Inputs& inputs, const Response& response, const Setting& setting,
                     const RunContext& run);

/// Leaves out failed runs. Returns nullopt if no term improves on the mean.
/// @throws Error(input) if too few runs remain
std::optional<Effects> polynomial_chaos(const Inputs& inputs, const Response& response,
                                        const Setting& setting, const RunContext& run);

/// Fraction of rows that differ from another row in exactly one coordinate, if it is far above
/// chance; otherwise 0, also for full factorials and for too many rows to examine quickly.
double share_of_neighbors(const PointSet& points, const RunContext& run);

/// Warns of the two inputs with the largest rank correlation if it is too large for independent
/// ones.
void note_dependence(const Inputs& in, const RunContext& run);

}  // namespace stipple::analyzers::sensitivity
