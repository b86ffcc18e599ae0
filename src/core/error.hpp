// SPDX-License-Identifier: MIT
//
// Functions that throw Error with a formatted message.
#pragma once

#include <fmt/format.h>

#include <string>
#include <utility>

#include "stipple/error.hpp"

namespace stipple {

/// Throws an Error. The message should name the fault, the value and what is allowed.
template <class... Args>
[[noreturn]] void fail(ErrorKind kind, fmt::format_string<Args...> what, Args&&... args) {
    throw Error(kind, fmt::format(what, std::forward<Args>(args)...));
}

/// As fail(), with a hint: a sentence on how to correct the call.
template <class... Args>
[[noreturn]] void fail_with_hint(ErrorKind kind, std::string hint, fmt::format_string<Args...> what,
                                 Args&&... args) {
    throw Error(kind, fmt::format(what, std::forward<Args>(args)...), std::move(hint));
}

/// Converts the exception being handled to an Error. A lack of memory or of threads becomes
/// ErrorKind::limit; other standard exceptions become internal errors. Call it from a handler of
/// std::exception.
Error caught_error();

/// Rethrows the exception being handled, as an Error if it reports a lack of memory. For the
/// handlers of public calls; exceptions of a caller's own functions pass unchanged.
[[noreturn]] void throw_to_caller();

}  // namespace stipple
