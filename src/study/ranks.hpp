// SPDX-License-Identifier: MIT
//
// The processes that share a study, as the launcher of MPI started them; or this one alone.
//
// What they say to each other are short messages: work, and what became of it. All calls are made
// from the thread that made the object.
#pragma once

#include <memory>
#include <optional>
#include <string>

namespace stipple {

struct Message {
    int from = 0;
    std::string bytes;
};

class Ranks {
  public:
    Ranks() = default;
    Ranks(const Ranks&) = delete;
    Ranks& operator=(const Ranks&) = delete;
    virtual ~Ranks() = default;

    [[nodiscard]] virtual int rank() const { return 0; }
    [[nodiscard]] virtual int size() const { return 1; }
    /// Ranks on this machine, with this one.
    [[nodiscard]] virtual int on_machine() const { return 1; }

    /// Gives the message to the post; it waits for nobody.
    virtual void send(int /*to*/, std::string /*bytes*/) {}
    /// The next message that came, if any.
    virtual std::optional<Message> poll() { return std::nullopt; }
};

/// Whether this build has MPI.
bool has_mpi();

/// Joins the others that the launcher started. Without MPI in the build, this process alone.
std::unique_ptr<Ranks> join_ranks();

}  // namespace stipple
