// SPDX-License-Identifier: MIT
//
// Provenance as the `meta` object of JSON and the `# ` lines of text formats.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "core/point_set.hpp"

namespace stipple::io {

/// Keys tool, version, generator, options, seed, count, dimension, start, warps, domain, command;
/// also columns, levels, bounds and shard where they are set, efficiency where points were dropped, precision and
/// dtype where numbers were cut, inputs where files were read, found where a search was made,
/// stream_versions above 1.
nlohmann::ordered_json to_json(const Provenance& provenance);

/// Takes what it knows and ignores the rest.
Provenance provenance_from(const nlohmann::ordered_json& meta);

/// Lines "# key: value" (value as JSON), each with its newline, or with what begins a comment in
/// another format.
std::string to_comment_lines(const Provenance& provenance, std::string_view begin = "# ");

/// The way back from such lines ("key: value" without "# "); false: not such a line.
bool take_comment_line(std::string_view line, Provenance& provenance);

}  // namespace stipple::io
