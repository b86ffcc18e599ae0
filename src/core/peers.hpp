// SPDX-License-Identifier: MIT
//
// Processes that do one piece of work together: each runs the same program on the same input, does
// its part, and tells the others what came of it.
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

    /// The name of its machine.
    [[nodiscard]] virtual std::string host() const { return {}; }

    /// To be called by all, which end with one error and need not tell each other.
    virtual void end_together() {}

    /// What each of them says, in the order of ranks. All call it, equally often and in one order.
    virtual std::vector<std::string> exchange(std::string mine) { return {std::move(mine)}; }
};

}  // namespace stipple
