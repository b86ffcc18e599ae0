// SPDX-License-Identifier: MIT
//
// A file of points or a picture that `reproduce` makes again, with the provenance that it carries.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/bytes/spool.hpp"
#include "io/point_stream.hpp"

namespace stipple::cli {

/// A file with known provenance.
struct Original {
    std::string name;                   ///< name for messages
    std::string path;                   ///< path that can be opened repeatedly
    std::shared_ptr<Spool> spool = {};  ///< owns the copy of a pipe
    Provenance meta = {};
    const Format* format = nullptr;         ///< if not determined by the file's name and bytes
    std::optional<std::size_t> width = {};  ///< numbers per point, if not determined by the bytes
    std::size_t sets = 0;                   ///< sets in the file; 0: determined by the bytes
    std::string picture = {};  ///< option of the generator that wrote it, if it is a picture
    bool drawn = false;        ///< SVG or PLY, which cannot be read back
    std::string plotted = {};  ///< command that drew it, if it is a picture of points
};

/// @throws Error(input) for a file without points or without a record of how they were made; the
/// message names its type and what can be made again from it
Original read_original(const std::string& input, const RunContext& run);

/// Opens its points, read by one thread: the others make the points again.
/// @param options columns to read
std::unique_ptr<io::PointStream> open_original(const Original& original, ReadOptions options,
                                               const RunContext& run);

}  // namespace stipple::cli
