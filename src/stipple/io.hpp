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
    std::string format = {};            ///< else from the extension
    bool header = true;                 ///< names of columns, in CSV
    bool meta = false;                  ///< provenance in comment lines; JSON always has it
    bool single = false;                ///< float32, in binary formats
    std::optional<int> precision = {};  ///< digits after the point; else the shortest exact text
};

/// Writes one set, or several of one dimension, beside the target, and renames the file when it is
/// whole; nothing is left when that fails. Parents of the path must exist; "-" is standard output.
/// @throws Error(usage) for unknown formats and for sets that one file cannot hold; Error(io)
void write(const std::string& path, const PointSet& points, const WriteOptions& options = {},
           const RunContext& run = {});
void write(const std::string& path, std::span<const PointSet> sets,
           const WriteOptions& options = {}, const RunContext& run = {});

struct ReadFileOptions {
    std::string format = {};    ///< else from the extension, or the first bytes
    std::size_t dimension = 0;  ///< numbers in a point, which raw binary does not say
    bool single = false;        ///< raw binary is float32
};

/// All sets of a file.
/// @throws Error(input) naming line or byte, and what was expected; Error(io); Error(usage)
std::vector<PointSet> read_sets(const std::string& path, const ReadFileOptions& options = {},
                                const RunContext& run = {});

/// The only set of a file. @throws as read_sets does, and Error(input) where there are several
PointSet read(const std::string& path, const ReadFileOptions& options = {},
              const RunContext& run = {});

}  // namespace stipple
