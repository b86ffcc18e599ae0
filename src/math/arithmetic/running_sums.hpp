// SPDX-License-Identifier: MIT
//
// Running sums of numbers, each rounded once or nearly so, by carrying along what additions lose.
//
// Promise sums of numbers >= 0 rise, and stay as they are where a number is 0; off by 2^-53 of
//         themselves and n 2^-106. The same bits on every machine.
// Source  A. Neumaier, Z. angew. Math. Mech. 54 (1974) 39-51, doi:10.1002/zamm.19740540106.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

namespace stipple {

/// x_1, x_1 + x_2, ... for numbers >= 0.
inline std::vector<double> running_sums(std::span<const double> numbers) {
    std::vector<double> sums;
    sums.reserve(numbers.size());
    double sum = 0;
    double lost = 0;
    double last = 0;
    for (const double x : numbers) {
        const double next = sum + x;
        lost += sum >= x ? (sum - next) + x : (x - next) + sum;
        sum = next;
        if (x > 0) last = std::max(last, sum + lost);  // rounding must not make them fall
        sums.push_back(last);
    }
    return sums;
}

}  // namespace stipple
