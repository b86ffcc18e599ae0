// SPDX-License-Identifier: MIT
//
// Where an axis has numbers, and what they look like: steps of 1, 2 or 5 times a power of ten; on a
// logarithmic axis powers of ten.
#pragma once

#include <string>
#include <vector>

namespace stipple::plot {

struct Tick {
    double value = 0;
    std::string text;
};

struct Ticks {
    std::vector<Tick> numbers;
    std::vector<double> minor = {};  ///< marks without numbers between them
    int exponent = 0;                ///< numbers are to be taken times 10 to this
};

/// At most `most` (2 or more) numbers in [low, high], low < high, and at least two; whole: of whole
/// numbers only, be it one.
Ticks linear_ticks(double low, double high, std::size_t most, bool whole = false);

/// The same on a logarithmic axis, 0 < low < high.
Ticks log_ticks(double low, double high, std::size_t most);

/// Powers of two in [low, high], 0 < low < high, so that at most `most` have numbers.
Ticks binary_ticks(double low, double high, std::size_t most);

/// "10⁻³"
std::string power_of_ten(int exponent);

/// A number with a true minus sign.
std::string printed(double value, int digits_after_point);

/// The shortest text of at most so many digits: "0.0123", "1.5e+06".
std::string rounded(double value, int digits = 4);

}  // namespace stipple::plot
