// SPDX-License-Identifier: MIT
//
// The bytes of a file that a unit was named: tables, matrices, pictures.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "stipple/run.hpp"

namespace stipple {

/// @param error errno: what went wrong with the file. @throws Error(io) "NAME: what"; Error(limit)
/// where it was memory
[[noreturn]] void refuse_file(const std::string& name, int error);

/// What a path names, which may be nothing. @throws Error(io) where that cannot be told
std::filesystem::file_status status_of(const std::string& path);

/// Reads the file at once. @throws Error(io): missing, a directory, unreadable; Error(limit): larger
/// than 1 GiB, or what limit_whole_files() said.
std::string read_file(const std::string& path);

/// Fingerprint (core/bytes/fingerprint.hpp) of the file's bytes, of which few are in memory at a time.
/// @throws Error(io) as read_file(); Error(cancelled)
std::uint64_t file_fingerprint(const std::string& path, const RunContext& run);

/// From now on read_file() takes no more bytes than that, nor than 1 GiB.
void limit_whole_files(std::uint64_t bytes);

// Which files may be opened while a stranger's text names them. All readers and writers of files ask
// here, so that no option can be forgotten.

/// As long as it lives, no file is opened but these. One at a time, made and destroyed while nothing
/// else opens files; standard input and output are not files.
class FileRules {
  public:
    /// @param readable what is opened for a name @param writable names of what may be written
    FileRules(std::map<std::string, std::string> readable, std::vector<std::string> writable);
    FileRules(const FileRules&) = delete;
    FileRules& operator=(const FileRules&) = delete;
    ~FileRules();

    /// What to open to read a file of that name. @throws Error(usage) where it may not be read
    static const std::string& readable(const std::string& path);

    /// @throws Error(usage) where the file may not be written
    static void require_writable(const std::string& path);

  private:
    std::map<std::string, std::string> readable_;
    std::vector<std::string> writable_;
};

}  // namespace stipple
