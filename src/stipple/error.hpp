// SPDX-License-Identifier: MIT
//
// The one exception type of the library.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace stipple {

/// What went wrong: a wrong call, bad data, the file system, a limit, or a requested stop.
enum class ErrorKind { usage, input, io, limit, cancelled };

class Error : public std::runtime_error {
  public:
    Error(ErrorKind kind, const std::string& what, std::string hint = {})
        : std::runtime_error(what), kind_(kind), hint_(std::move(hint)) {}

    [[nodiscard]] ErrorKind kind() const { return kind_; }

    /// A sentence on how to correct the call; may be empty.
    [[nodiscard]] const std::string& hint() const { return hint_; }

  private:
    ErrorKind kind_;
    std::string hint_;
};

}  // namespace stipple
