// SPDX-License-Identifier: MIT
//
// Group of processes that share one task: all run the same program on the same input, each does its
// part, and they exchange the results.
#pragma once

#include <string>
#include <vector>

namespace stipple {

class Peers {
  public:
    Peers() = default;
    Peers(const Peers&) = delete;
    Peers& operator=(const Peers&) = delete;
    virtual ~Peers() = default;

    [[nodiscard]] virtual int rank() const { return 0; }
    [[nodiscard]] virtual int size() const { return 1; }

    /// Name of this process's machine.
    [[nodiscard]] virtual std::string host() const { return {}; }

    /// Must be called by all processes when all fail with the same error, so that they need not
    /// notify each other.
    virtual void end_together() {}

    /// Returns the texts of all processes, ordered by rank. Collective: all processes must make the
    /// same calls in the same order.
    virtual std::vector<std::string> exchange(std::string mine) { return {std::move(mine)}; }
};

}  // namespace stipple
