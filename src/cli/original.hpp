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

/// A file whose provenance is known.
struct Original {
    std::string name;                   ///< for messages
    std::string path;                   ///< where it can be opened more than once
    std::shared_ptr<Spool> spool = {};  ///< that it is, where it came from a pipe
    Provenance meta = {};
    const Format* format = nullptr;         ///< where its name and bytes leave it open
    std::optional<std::size_t> width = {};  ///< numbers of a point, where the bytes leave it open
    std::size_t sets = 0;                   ///< in the file; 0: as its bytes say
    std::string picture = {};               ///< option of the generator that made it, if it is one
    bool drawn = false;                     ///< svg or ply, which are not read
    std::string plotted = {};               ///< command that drew it, if it is a picture of points
};

/// @throws Error(input) for a file that does not say how its points were made, or holds none: says
/// what it is and what can be made again from it
Original read_original(const std::string& input, const RunContext& run);

/// Its points, by one thread: on the others they are made again.
/// @param options which columns are read
std::unique_ptr<io::PointStream> open_original(const Original& original, ReadOptions options,
                                               const RunContext& run);

}  // namespace stipple::cli
