// SPDX-License-Identifier: MIT
#include "core/error.hpp"

#include <new>
#include <stdexcept>
#include <string_view>
#include <system_error>

namespace stipple {

Error caught_error() {
    try {
        throw;
    } catch (const Error& e) {
        return e;
    } catch (const std::bad_alloc&) {
        return {ErrorKind::limit, "out of memory"};
    } catch (const std::length_error&) {  // more elements than a vector can have
        return {ErrorKind::limit, "out of memory"};
    } catch (const std::exception& e) {
        const auto* failed = dynamic_cast<const std::system_error*>(&e);
        const bool thread =
            failed ? failed->code() == std::errc::resource_unavailable_try_again
                   : std::string_view(e.what()).starts_with("pthread_create");  // thrown by oneTBB
        if (thread)
            return {ErrorKind::limit, "cannot start a thread",
                    "the limits (ulimit) may be too low; use fewer --threads"};
        return {ErrorKind::io, fmt::format("internal error: {}", e.what())};
    }
}

void throw_to_caller() {
    try {
        throw;
    } catch (const std::bad_alloc&) {
        throw caught_error();
    } catch (const std::length_error&) {
        throw caught_error();
    }
}

}  // namespace stipple
