// SPDX-License-Identifier: MIT
#include "cli/launched.hpp"

#include <algorithm>
#include <cstdlib>

#include "core/error.hpp"
#include "core/text.hpp"

namespace stipple::cli {
namespace {

/// The largest of the numbers that the environment has for them; else nothing.
std::optional<std::uint64_t> environment(std::initializer_list<const char*> names) {
    std::optional<std::uint64_t> most;
    for (const char* name : names)
        if (const char* text = std::getenv(name))
            if (const auto number = parse_unsigned(text))
                most = std::max(most.value_or(0), *number);
    return most;
}

}  // namespace

std::uint64_t launched_ranks() {
    return std::max<std::uint64_t>(1,
                                   environment({"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}).value_or(1));
}

bool is_mute(std::string_view verb) {
    return (verb == "analyze" || verb == "study") && launched_ranks() > 1 &&
           environment({"OMPI_COMM_WORLD_RANK", "PMI_RANK"}).value_or(0) != 0;
}

std::unique_ptr<Ranks> launched(std::string_view verb, const RunContext& run) {
    const std::uint64_t ranks = launched_ranks();
    if (ranks == 1) return std::make_unique<Ranks>();
    if (!has_mpi())
        fail_with_hint(ErrorKind::usage, "build with -DSTIPPLE_MPI=ON, or start one process",
                       "{}: an MPI launcher started {} processes, and this build has no MPI", verb,
                       ranks);
    return join_ranks(run.stop);
}

}  // namespace stipple::cli
