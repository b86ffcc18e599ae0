// SPDX-License-Identifier: MIT
#include "cli/cli.hpp"

namespace stipple::cli {

int run(int, char**) { return 0; }

}  // namespace stipple::cli
