// SPDX-License-Identifier: MIT
#pragma once

namespace stipple::cli {

/// The whole program: parses, works, prints; returns the exit code of the contract.
int run(int argc, char** argv);

}  // namespace stipple::cli
