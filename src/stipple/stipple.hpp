// SPDX-License-Identifier: MIT
//
// The whole public API: make, warp, measure, read and write point sets.
//
//     #include <stipple/stipple.hpp>
//     const stipple::PointSet points =
//         stipple::generate("halton", {.count = 1000, .dimension = 2});
//     const double d = stipple::analyze("star-discrepancy", points).number("value");
#pragma once

#include "stipple/analyze.hpp"   // IWYU pragma: export
#include "stipple/error.hpp"     // IWYU pragma: export
#include "stipple/generate.hpp"  // IWYU pragma: export
#include "stipple/io.hpp"        // IWYU pragma: export
#include "stipple/points.hpp"    // IWYU pragma: export
#include "stipple/run.hpp"       // IWYU pragma: export
#include "stipple/study.hpp"     // IWYU pragma: export
#include "stipple/warp.hpp"      // IWYU pragma: export
