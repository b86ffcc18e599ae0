// SPDX-License-Identifier: MIT
//
// What warps without defaults for all their options are tested with.
#pragma once

#include <string>

#include "places.hpp"
#include "support/pictures.hpp"
#include "support/units.hpp"

namespace stipple::testing {

/// Options that the warp cannot do without.
inline Settings needed_options(const std::string& warp) {
    static const TemporaryFile array(
        npy_of<double>("<f8", "(2, 3)", std::vector<double>{1, 2, 3, 4, 2, 1}));
    if (warp == "expression-1d") return {{"density", "1+x"}};
    if (warp == "expression-2d") return {{"density", "1+x*y"}};
    if (warp == "image") return {{"file", array.path()}};
    if (warp == "mesh") return {{"file", STIPPLE_SOURCE_DIR "/tests/support/tetrahedron.obj"}};
    if (warp == "rejection") return {{"density", "x+y"}, {"bound", "2"}};
    return {};
}

}  // namespace stipple::testing
