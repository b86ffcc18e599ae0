// SPDX-License-Identifier: MIT
//
// Files that stipple writes about points, and that hold none.
#pragma once

#include <string>
#include <string_view>

namespace stipple::cli {

/// @param front the first bytes of the file, some hundred at least where it has them
/// @throws Error(input) for such a file, saying what it is and what can be made again from it
void refuse_without_points(const std::string& name, std::string_view front);

}  // namespace stipple::cli
