// SPDX-License-Identifier: MIT
//
// The group of MPI processes (ranks) that share a study or an analysis; without MPI or a launcher,
// this process alone. All calls must come from the thread that created the object.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "core/peers.hpp"
#include "stipple/error.hpp"
#include "stipple/run.hpp"

namespace stipple {

struct Message {
    int from = 0;
    std::string bytes;
};

class Ranks : public Peers {
  public:
    /// Number of ranks on this machine, including this one.
    [[nodiscard]] virtual int on_machine() const { return 1; }

    /// Sends a message of less than 2^31 bytes, without waiting until it has arrived.
    virtual void send(int /*to*/, std::string /*bytes*/) {}
    /// Returns the next message that another rank sent; nullopt if none has arrived.
    virtual std::optional<Message> poll() { return std::nullopt; }

    /// Reports to the other ranks that this one ends with an error. Ranks that wait for it throw
    /// that error, prefixed by this rank and its host; ranks that compute are stopped.
    /// @return the error that ended this rank: `error`, or that of a rank that failed before
    virtual Error fail_together(const Error& error) { return error; }

    /// Sends bytes of any size to another rank, which must call take() at the same time.
    virtual void give(int /*to*/, const std::string& /*bytes*/) {}
    virtual std::string take(int /*from*/) { return {}; }
};

/// Number of threads for this process: as requested by the user or, by default, its share of the
/// machine.
unsigned threads_of(const Ranks& ranks, const RunContext& run);

/// Whether this build has MPI.
bool has_mpi();

/// Name and version of the MPI library in this build, "Open MPI v4.1.6"; empty without MPI.
std::string mpi_version();

/// Joins the group of processes that the MPI launcher started; in a build without MPI, the group is
/// this process alone.
/// @param stop once a stop is requested, the ranks exit without waiting for each other: a launcher
/// that terminates them may already have ended some
/// @param request_stop called when another rank fails, to end computations on this rank
std::unique_ptr<Ranks> join_ranks(std::stop_token stop, std::function<void()> request_stop);

}  // namespace stipple
