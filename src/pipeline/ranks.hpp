// SPDX-License-Identifier: MIT
//
// The processes that share a study or an analysis, as the launcher of MPI started them; or this one
// alone. All calls are made from the thread that made the object.
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
    /// Ranks on this machine, with this one.
    [[nodiscard]] virtual int on_machine() const { return 1; }

    /// Gives the message, of less than 2^31 bytes without waiting.
    virtual void send(int /*to*/, std::string /*bytes*/) {}
    /// The next message that came, if any.
    virtual std::optional<Message> poll() { return std::nullopt; }

    /// Tells the others that this rank ends, and why: waiting for it, they throw that, named by its
    /// rank and host; computing, they are stopped.
    /// @return what ended this rank: the error, or that of the rank that failed before
    virtual Error fail_together(const Error& error) { return error; }

    /// Gives bytes of any size to another rank, which takes them at the same time.
    virtual void give(int /*to*/, const std::string& /*bytes*/) {}
    virtual std::string take(int /*from*/) { return {}; }
};

/// Threads of this process: all that the user gave or, by default, its share of the machine.
unsigned threads_of(const Ranks& ranks, const RunContext& run);

/// Whether this build has MPI.
bool has_mpi();

/// The name and version of the MPI of this build, "Open MPI v4.1.6"; empty without.
std::string mpi_version();

/// Joins the others that the launcher started. Without MPI in the build, this process alone.
/// @param stop that was asked for: nobody waits for the others in the end, as a launcher that ends
/// its ranks lets none of them leave together
/// @param request_stop ends what this rank computes, since another has failed
std::unique_ptr<Ranks> join_ranks(std::stop_token stop, std::function<void()> request_stop);

}  // namespace stipple
