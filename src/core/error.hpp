// SPDX-License-Identifier: MIT
//
// Throwing the one exception type of the library, its message formatted.
#pragma once

#include <fmt/format.h>

#include <string>
#include <utility>

#include "stipple/error.hpp"

namespace stipple {

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

/// What a handler of std::exception has caught, as an Error: out of memory and a thread that does not
/// start are limits, whatever else is none is an internal error.
Error caught_error();

}  // namespace stipple
