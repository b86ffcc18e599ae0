// SPDX-License-Identifier: MIT
//
// Measurements as one table that pandas or a spreadsheet reads: a row for each measurement, or
// for each entry of its curves.
#pragma once

#include <span>
#include <string>

#include "report/document.hpp"

namespace stipple {

std::string csv_table(std::span<const Measurement> measurements);

}  // namespace stipple
