// SPDX-License-Identifier: MIT
#include "cli/verbs.hpp"

int main(int argc, char** argv) { return stipple::cli::run(argc, argv); }
