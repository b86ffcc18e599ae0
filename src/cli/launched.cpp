// SPDX-License-Identifier: MIT
#include "cli/launched.hpp"

#include <algorithm>
#include <cstdlib>
#include <memory>

#include "cli/session.hpp"
#include "cli/verbs.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "pipeline/shared_analysis.hpp"

namespace stipple::cli {
namespace {

/// Largest number among these environment variables; nullopt if none is set.
std::optional<std::uint64_t> environment(std::initializer_list<const char*> names) {
    std::optional<std::uint64_t> most;
    for (const char* name : names)
        if (const char* text = std::getenv(name))
            if (const auto number = parse_unsigned(text))
                most = std::max(most.value_or(0), *number);
    return most;
}

/// Number of processes from mpirun's environment; nullopt if not started by mpirun.
std::optional<std::uint64_t> started_by_mpirun() {
    return environment({"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"});
}

/// Ranks that this process has joined; null before it joins.
std::unique_ptr<Ranks>& joined() {
    static std::unique_ptr<Ranks> ranks;
    return ranks;
}

}  // namespace

std::uint64_t launched_ranks() {
    auto ranks = started_by_mpirun();
    // Slurm's launcher with PMIx only sets this variable.
    if (!ranks) ranks = environment({"SLURM_STEP_NUM_TASKS"});
    return std::max<std::uint64_t>(1, ranks.value_or(1));
}

bool is_launched() { return started_by_mpirun().has_value(); }

bool is_shared(std::string_view verb) { return verb == "analyze" || verb == "study"; }

bool is_mute(std::string_view verb) {
    if (!is_shared(verb) || launched_ranks() == 1) return false;
    auto rank = environment({"OMPI_COMM_WORLD_RANK", "PMI_RANK"});
    if (!rank) rank = environment({"PMIX_RANK", "SLURM_PROCID"});
    return rank.value_or(0) != 0;
}

Ranks& launched(const Arguments& arguments, const RunContext& run) {
    if (joined()) return *joined();
    const std::string& verb = info_of(*arguments.verb).name;
    const std::uint64_t started = launched_ranks();
    if (started == 1) return *(joined() = std::make_unique<Ranks>());
    if (!has_mpi())
        fail_with_hint(ErrorKind::usage, "build it with -DSTIPPLE_MPI=ON, or start one process",
                       "{}: an MPI launcher started {} processes, and this build has no MPI", verb,
                       started);
    joined() = join_ranks(run.stop, request_stop);
    agreed(*joined(), [] {});  // throws if the arguments of another rank are wrong
    if (joined()->size() == 1)
        fail_with_hint(ErrorKind::usage, "start them by mpirun, or by srun --mpi=pmix",
                       "{}: a launcher started {} processes, which do not find each other by MPI",
                       verb, started);
    Arguments same = arguments;
    // Names of files with points may differ: the files' bytes are compared.
    if (arguments.verb == Verb::analyze) std::ranges::fill(same.inputs, "FILE");
    if (const auto rank = unlike_rank(command_text(same), *joined()))
        fail_with_hint(ErrorKind::usage, "start all ranks by the same command",
                       "{}: the arguments of rank {} are not those of rank 0", verb, *rank);
    return *joined();
}

Ranks& joined_ranks() {
    static Ranks alone;
    return joined() ? *joined() : alone;
}

Error shared_failure(std::string_view verb, const Error& error) {
    if (joined()) return joined()->fail_together(error);
    const bool others_join = has_mpi() && is_shared(verb) && launched_ranks() > 1;
    if (!others_join || error.kind() == ErrorKind::cancelled) return error;
    try {
        joined() = join_ranks({}, request_stop);
        agreed(*joined(), [&] { throw Error(error); });
    } catch (const Error& first) {
        return first;
    }
    return error;
}

void leave_ranks() { joined().reset(); }

}  // namespace stipple::cli
