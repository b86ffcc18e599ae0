// SPDX-License-Identifier: MIT
//
// A study on all threads of this process and of the other MPI ranks. Each takes the next piece of
// work when it is done with the last; rank 0 writes the results.
//
// Cost     between ranks, for each piece of work (a second of it, as a rule): 30 bytes to ask and
//          to answer, and its rows, 150 to 250 bytes each. Rank 0 keeps 8 bytes for each unit that
//          waits in the journal; every rank the points of the sets that it works on.
// Promise  the file is the same for any number of threads and ranks, but for the seconds.
#pragma once

#include "pipeline/ranks.hpp"
#include "stipple/run.hpp"
#include "study/study_file.hpp"
#include "study/unit_runner.hpp"

namespace stipple {

/// On rank 0: does the units that the file lacks. run.progress tells the share of the time that is
/// over. False: the pipe was closed.
/// @throws Error(cancelled) when told to stop; what is done is in the file. Error(io)
bool run_study(const UnitRunner& runner, StudyFile& file, Ranks& ranks, const RunContext& run);

/// On the other ranks: works until rank 0 has no more to do. @throws Error(cancelled)
void work_for_study(const UnitRunner& runner, Ranks& ranks, const RunContext& run);

/// Tells the other ranks that there is nothing to do; for rank 0, where it does not come to
/// run_study.
void dismiss(Ranks& ranks);

}  // namespace stipple
