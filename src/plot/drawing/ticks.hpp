// SPDX-License-Identifier: MIT
//
// Positions and texts of the numbers on axes: multiples of 1, 2 or 5 times a power of ten; powers
// of ten on logarithmic axes.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace stipple::plot {

inline constexpr double least_shown = 1e-300;  ///< smaller numbers are shown as 0
inline constexpr double most_shown = 1e307;    ///< largest magnitude on an axis
inline constexpr int shown_digits = 13;        ///< values equal in 13 digits count as equal

/// Checks the range of an axis. @throws Error(input) if it is finite, but beyond most_shown
void require_shown(double low, double high);

/// Explains why an axis cannot distinguish low from high; empty if it can, or if both are equal.
std::string flaw_of_range(double low, double high, int digits = shown_digits);

/// [low, high], widened if it is too narrow for an axis. The magnitudes must be at most about
/// `most_shown`.
std::pair<double, double> visible_range(double low, double high, int digits = shown_digits);

struct Tick {
    double value = 0;
    std::string text;  ///< may have several lines
};

struct Ticks {
    std::vector<Tick> numbers;
    std::vector<double> minor = {};  ///< tick marks between the numbers
    int exponent = 0;                ///< the texts are in units of 10^exponent
};

/// At least two and at most `most` (2 or more) numbers in [low, high], low < high. If `whole`, only
/// integers, even if there is only one. Empty if an axis cannot distinguish low from high.
Ticks linear_ticks(double low, double high, std::size_t most, bool whole = false);

/// Like linear_ticks(), for a logarithmic axis with 0 < low < high.
Ticks log_ticks(double low, double high, std::size_t most);

/// Ticks at powers of two in [low, high], 0 < low < high; at most `most` have numbers.
Ticks binary_ticks(double low, double high, std::size_t most);

/// A power of ten with a superscript exponent: "10⁻³".
std::string power_of_ten(int exponent);

/// Formats a number with a typographic minus sign.
std::string printed(double value, int digits_after_point);

/// Formats a number with at most `digits` significant digits: "0.0123", "1.5e+06".
std::string rounded(double value, int digits = 4);

/// Both ends of a range, with additional digits if needed to distinguish them.
std::pair<std::string, std::string> rounded_ends(double low, double high, int digits = 4);

}  // namespace stipple::plot
