// SPDX-License-Identifier: MIT
//
// The bytes of a file that a unit was named: tables, matrices, pictures.
#pragma once

#include <cstdint>
#include <string>

namespace stipple {

/// @param error errno: what went wrong with the file. @throws Error(io) "NAME: what"
[[noreturn]] void refuse_file(const std::string& name, int error);

/// Reads the file at once. @throws Error(io): missing, a directory, unreadable; Error(limit): larger
/// than 1 GiB, or what limit_whole_files() said.
std::string read_file(const std::string& path);

/// From now on read_file() takes no more bytes than that, nor than 1 GiB.
void limit_whole_files(std::uint64_t bytes);

}  // namespace stipple
