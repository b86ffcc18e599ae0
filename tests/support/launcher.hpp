// SPDX-License-Identifier: MIT
//
// Options of mpirun for tests: more ranks than cores, run by root, and without shared memory
// between processes, which containers forbid.
#pragma once

#include <cstdlib>
#include <string>

#include "pipeline/ranks.hpp"

namespace stipple::testing {

inline const std::string mpirun =
    "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
    "OMPI_MCA_rmaps_base_oversubscribe=1 "
    "OMPI_MCA_btl=self,vader OMPI_MCA_btl_vader_single_copy_mechanism=none mpirun ";

/// Whether the tests can start ranks: this build has MPI, and mpirun is installed.
inline bool can_launch() { return has_mpi() && std::system("command -v mpirun > /dev/null") == 0; }

}  // namespace stipple::testing
