// SPDX-License-Identifier: MIT
//
// Whole files or standard input, read at once.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/point_set.hpp"
#include "io/format.hpp"
#include "stipple/run.hpp"

namespace stipple::io {

/// The bytes of a file, or of standard input for "-". @throws Error as Feed does; Error(limit)
std::string read_bytes(const std::string& path, const RunContext& run);

/// The format that a file's extension means or, where it leaves that open, its first bytes.
const Format& format_for(const std::string& path, std::string_view bytes);

/// All sets in the bytes of a file; else as read_points.
std::vector<PointSet> read_sets(std::string_view bytes, const std::string& path,
                                const ReadOptions& options, const RunContext& run,
                                const Format* format = nullptr);

/// All sets of a file, in the named format or the one that its extension or its bytes tell. Where
/// options.source is "-", messages name `path`.
/// @throws Error(input), Error(io), Error(usage)
std::vector<PointSet> read_points(const std::string& path, const ReadOptions& options,
                                  const RunContext& run, const Format* format = nullptr);

/// The one set of the file that an option of a unit names.
/// @throws Error as read_points; Error(usage) for standard input, which could not be read again
PointSet read_given(std::string_view option, const std::string& path, const ReadOptions& options,
                    const RunContext& run);

/// Numbers in a row of that file, from its first rows. @throws as read_given
std::size_t width_of_given(std::string_view option, const std::string& path);

}  // namespace stipple::io
