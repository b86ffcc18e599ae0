// SPDX-License-Identifier: MIT
//
// Reads point files or standard input as a whole.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/point_set.hpp"
#include "io/format.hpp"
#include "stipple/run.hpp"

namespace stipple::io {

/// All bytes of a file, or of standard input for "-". @throws Error as Feed does; Error(limit)
std::string read_bytes(const std::string& path, const RunContext& run);

/// Detects the format by the file's extension or, if that is ambiguous, by the first bytes.
const Format& format_for(const std::string& path, std::string_view bytes);

/// As read_points(), for the bytes of a file already read; `path` is its name.
std::vector<PointSet> read_sets(std::string_view bytes, const std::string& path,
                                const ReadOptions& options, const RunContext& run,
                                const Format* format = nullptr);

/// Reads all sets of a file. If `format` is null, the extension or the bytes decide. Messages name
/// options.source, or `path` if that is "-". @throws Error(input), Error(io), Error(usage)
std::vector<PointSet> read_points(const std::string& path, const ReadOptions& options,
                                  const RunContext& run, const Format* format = nullptr);

/// Reads the file that an option names, which must hold exactly one set.
/// @throws Error as read_points; Error(usage) for standard input, which cannot be read twice
PointSet read_given(std::string_view option, const std::string& path, const ReadOptions& options,
                    const RunContext& run);

/// Checks that the path is not standard input, which cannot be read twice. @throws Error(usage)
/// naming the option
void require_file(std::string_view option, const std::string& path);

}  // namespace stipple::io
