// SPDX-License-Identifier: MIT
//
// Runs a study on all threads of this process and of the other MPI ranks. A thread gets the next
// piece of work when it has finished one; rank 0 writes the results.
//
// Cost     messages between ranks for each piece of work, which usually takes a second: 30 bytes to
//          ask and to answer, and some 50 bytes for each row. Rank 0 keeps 40 bytes for each
//          contiguous range of units in the table; every rank keeps the points of the sets that it
//          works on.
// Promise  the file, except its columns of seconds, is the same for any number of threads and
//          ranks.
#pragma once

#include "pipeline/ranks.hpp"
#include "stipple/run.hpp"
#include "study/study_file.hpp"
#include "study/unit_runner.hpp"

namespace stipple {

/// Runs the units that are missing from the file; call it on rank 0. run.progress receives elapsed
/// time / estimated total time. Returns false if the reader of a pipe has closed it.
/// @throws Error(cancelled), with all finished units in the file; Error(io)
bool run_study(const UnitRunner& runner, StudyFile& file, Ranks& ranks, const RunContext& run);

/// Works for rank 0 until there is no more work; call it on all other ranks.
/// @throws Error(cancelled)
void work_for_study(const UnitRunner& runner, Ranks& ranks, const RunContext& run);

/// Ends the other ranks' work if rank 0 cannot call run_study.
void dismiss(Ranks& ranks);

}  // namespace stipple
