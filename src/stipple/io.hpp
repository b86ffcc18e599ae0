// SPDX-License-Identifier: MIT
//
// Point sets in files. The format follows from the extension: csv, txt, json, jsonl, npy, bin, utk,
// psa to read and write; ply and svg to write.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "stipple/points.hpp"
#include "stipple/run.hpp"

namespace stipple {

struct WriteOptions {
    std::string format = {};            ///< empty: from the extension
    bool header = true;                 ///< column names in the first line, in CSV
    bool meta = false;                  ///< provenance in comment lines; JSON always has it
    bool single = false;                ///< float32 in binary formats
    std::optional<int> precision = {};  ///< digits after the point; unset: the shortest exact text
};

/// Writes one set, or several of the same dimension. The file is written under a temporary name and
/// renamed when complete; a failure leaves nothing behind. The parent folder must exist; "-" is
/// standard output.
/// @throws Error(usage) for unknown formats and for sets that one file cannot hold; Error(io)
void write(const std::string& path, const PointSet& points, const WriteOptions& options = {},
           const RunContext& run = {});
void write(const std::string& path, std::span<const PointSet> sets,
           const WriteOptions& options = {}, const RunContext& run = {});

struct ReadFileOptions {
    std::string format = {};    ///< empty: from the extension or the first bytes
    std::size_t dimension = 0;  ///< numbers per point; for raw binary without FILE.meta.json
    bool single = false;        ///< raw binary holds float32
};

/// Returns all sets of a file, with the provenance in FILE.meta.json if there is one.
/// @throws Error(input) naming line or byte, and what was expected; Error(io); Error(usage)
std::vector<PointSet> read_sets(const std::string& path, const ReadFileOptions& options = {},
                                const RunContext& run = {});

/// Returns the only set of a file. @throws as read_sets, and Error(input) if there are several
PointSet read(const std::string& path, const ReadFileOptions& options = {},
              const RunContext& run = {});

}  // namespace stipple
