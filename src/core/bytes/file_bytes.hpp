// SPDX-License-Identifier: MIT
//
// The bytes of a file that a unit was named: tables, matrices, pictures.
#pragma once

#include <string>

namespace stipple {

/// What went wrong with a file, as messages say it. @param error errno
std::string file_trouble(int error);

/// Reads the file at once. @throws Error(io): missing, a directory, unreadable, over 1 GiB.
std::string read_file(const std::string& path);

}  // namespace stipple
