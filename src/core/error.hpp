// SPDX-License-Identifier: MIT
//
// The one exception type of the library. Only the command line turns a kind into an exit code.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace stipple {

/// What went wrong: a wrong call, bad data, the file system, a limit, or the user's own wish.
enum class ErrorKind { usage, input, io, limit, cancelled };

class Error : public std::runtime_error {
  public:
    Error(ErrorKind kind, const std::string& what, std::string hint = {})
        : std::runtime_error(what), kind_(kind), hint_(std::move(hint)) {}

    [[nodiscard]] ErrorKind kind() const { return kind_; }

    /// One sentence that helps to mend the call, or nothing.
    [[nodiscard]] const std::string& hint() const { return hint_; }

  private:
    ErrorKind kind_;
    std::string hint_;
};

/// Throws an Error: what is wrong, the value, what is allowed.
template <class... Args>
[[noreturn]] void fail(ErrorKind kind, fmt::format_string<Args...> what, Args&&... args) {
    throw Error(kind, fmt::format(what, std::forward<Args>(args)...));
}

/// As fail(), with a second sentence that helps to mend the call.
template <class... Args>
[[noreturn]] void fail_with_hint(ErrorKind kind, std::string hint, fmt::format_string<Args...> what,
                                 Args&&... args) {
    throw Error(kind, fmt::format(what, std::forward<Args>(args)...), std::move(hint));
}

}  // namespace stipple
