// SPDX-License-Identifier: MIT
#include "generators/points_from.hpp"

#include <utility>
#include <vector>

#include "core/error.hpp"
#include "io/files.hpp"

namespace stipple {

PointSet points_from(const std::string& path, const RunContext& run) {
    if (path == "-")
        fail(ErrorKind::usage, "--from: standard input cannot be read again; give a file");
    std::vector<PointSet> sets = io::read_points(path, {}, run);
    if (sets.size() != 1)
        fail(ErrorKind::input, "{}: {} sets of points; expected one", path, sets.size());
    return std::move(sets.front());
}

}  // namespace stipple
