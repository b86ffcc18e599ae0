// SPDX-License-Identifier: MIT
//
// The bytes of a file that a unit was named: tables, matrices, pictures.
#pragma once

#include <string>

namespace stipple {

/// @param error errno: what went wrong with the file. @throws Error(io) "NAME: what"
[[noreturn]] void refuse_file(const std::string& name, int error);

/// Reads the file at once. @throws Error(io): missing, a directory, unreadable, over 1 GiB.
std::string read_file(const std::string& path);

}  // namespace stipple
