// SPDX-License-Identifier: MIT
//
// All that another program needs: make point sets, warp them, measure them, write and read them.
//
//     #include <stipple/stipple.hpp>
//     const stipple::PointSet points =
//         stipple::generate("halton", {.count = 1000, .dimension = 2});
//     const double d = stipple::analyze("star-discrepancy", points).number("value");
#pragma once

#include "core/error.hpp"         // IWYU pragma: export
#include "core/report.hpp"        // IWYU pragma: export
#include "io/files.hpp"           // IWYU pragma: export
#include "pipeline/chain.hpp"     // IWYU pragma: export
#include "pipeline/pipeline.hpp"  // IWYU pragma: export
#include "pipeline/produce.hpp"   // IWYU pragma: export
#include "report/document.hpp"    // IWYU pragma: export
