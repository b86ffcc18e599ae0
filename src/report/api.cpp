// SPDX-License-Identifier: MIT
//
// Reports as text, for the public API.
#include "report/document.hpp"
#include "stipple/analyze.hpp"

namespace stipple {

std::string to_text(const Report& report) {
    Measurement measurement;
    measurement.results = report;
    return to_text(std::span(&measurement, 1));
}

}  // namespace stipple
