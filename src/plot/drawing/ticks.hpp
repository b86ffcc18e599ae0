// SPDX-License-Identifier: MIT
//
// Where an axis has numbers, and what they look like: steps of 1, 2 or 5 times a power of ten; on a
// logarithmic axis powers of ten.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace stipple::plot {

inline constexpr double least_shown = 1e-300;  ///< smaller numbers are shown as 0
inline constexpr double most_shown = 1e307;    ///< no axis reaches further
inline constexpr int shown_digits = 13;        ///< to which numbers differ that an axis tells apart

/// @throws Error(input) for numbers that no axis reaches; infinite ones are none.
void require_shown(double low, double high);

/// Why an axis cannot tell low from high; empty where it can, or where both are the same.
std::string flaw_of_range(double low, double high, int digits = shown_digits);

/// [low, high], or a range about them where that is too narrow for an axis. Both at most about
/// `most_shown`.
std::pair<double, double> visible_range(double low, double high, int digits = shown_digits);

struct Tick {
    double value = 0;
    std::string text;  ///< may have several lines
};

struct Ticks {
    std::vector<Tick> numbers;
    std::vector<double> minor = {};  ///< marks without numbers between them
    int exponent = 0;                ///< numbers are to be taken times 10 to this
};

/// At most `most` (2 or more) numbers in [low, high], low < high, and at least two; whole: of whole
/// numbers only, be it one. None in a range that is not visible.
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

/// Both ends of a range, with as many digits more as tell them apart.
std::pair<std::string, std::string> rounded_ends(double low, double high, int digits = 4);

}  // namespace stipple::plot
