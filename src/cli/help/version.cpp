// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <oneapi/tbb/version.h>
#include <png.h>

#include <CLI/Version.hpp>
#include <boost/version.hpp>
#include <nlohmann/json_fwd.hpp>

#include "cli/verbs.hpp"
#include "math/fourier/fft.hpp"
#include "pipeline/ranks.hpp"

namespace stipple::cli {

std::string version_text() {
    return fmt::format(
        "stipple {}\nCLI11 {}, fmt {}.{}.{}, nlohmann-json {}.{}.{}, {}, oneTBB {}.{}, Boost "
        "{}.{}.{}, Random123, libpng {}, {}\n"
        "stipple is under the MIT licence; {}.\n",
        STIPPLE_VERSION, CLI11_VERSION, FMT_VERSION / 10000, FMT_VERSION / 100 % 100,
        FMT_VERSION % 100, NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR,
        NLOHMANN_JSON_VERSION_PATCH, fft_library(), TBB_VERSION_MAJOR, TBB_VERSION_MINOR,
        BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100,
        PNG_LIBPNG_VER_STRING, has_mpi() ? mpi_version() : "without MPI", fft_licence());
}

}  // namespace stipple::cli
