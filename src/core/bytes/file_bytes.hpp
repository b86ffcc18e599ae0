// SPDX-License-Identifier: MIT
//
// Reading of whole files, such as tables, matrices and pictures that options name; and restrictions
// on which files may be opened.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "stipple/run.hpp"

namespace stipple {

/// Throws for a failed file operation. @param error value of errno
/// @throws Error(io) "NAME: reason"; Error(limit) if memory ran out
[[noreturn]] void refuse_file(const std::string& name, int error);

/// Status of a path; the file may not exist. @throws Error(io) if the status is unknown
std::filesystem::file_status status_of(const std::string& path);

/// Whether a path is standard input ("-"), a pipe or a device, whose bytes cannot be read again.
/// @throws Error(io) as status_of()
bool is_pipe(const std::string& path);

/// Reads the whole file. @throws Error(io) if missing, a directory or unreadable; Error(limit) if
/// larger than 1 GiB or than the limit_whole_files() limit
std::string read_file(const std::string& path);

/// Fingerprint (core/bytes/fingerprint.hpp) of the file's bytes, read in small blocks.
/// @throws Error(io) as read_file(); Error(cancelled)
std::uint64_t file_fingerprint(const std::string& path, const RunContext& run);

/// Sets the size limit of read_file(), at most 1 GiB.
void limit_whole_files(std::uint64_t bytes);

// Access control for files that untrusted text names. All code that opens files checks here, so
// that no option can bypass it.

/// Restricts which files can be opened during its lifetime. Only one may exist at a time; no other
/// thread may open files while it is created or destroyed. Standard input and output are not
/// restricted.
class FileRules {
  public:
    /// @param readable maps each name that may be read to the path to open for it
    /// @param writable names of the files that may be written
    FileRules(std::map<std::string, std::string> readable, std::vector<std::string> writable);
    FileRules(const FileRules&) = delete;
    FileRules& operator=(const FileRules&) = delete;
    ~FileRules();

    /// The path to open for reading a file of this name. @throws Error(usage) if it may not be read
    static const std::string& readable(const std::string& path);

    /// @throws Error(usage) if the file may not be written
    static void require_writable(const std::string& path);

  private:
    std::map<std::string, std::string> readable_;
    std::vector<std::string> writable_;
};

}  // namespace stipple
