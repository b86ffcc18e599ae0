// SPDX-License-Identifier: MIT
#include "io/formats/binary.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "core/error.hpp"
#include "io/decimal.hpp"

namespace stipple::io {

static_assert(std::endian::native == std::endian::little);

void append_raw(std::string& out, std::span<const double> numbers, bool single) {
    if (!single) {
        out.append(reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes());
        return;
    }
    const std::size_t start = out.size();
    out.resize(start + 4 * numbers.size());
    char* to = out.data() + start;
    for (const double number : numbers) {
        const float cut = to_single(number);
        std::memcpy(to, &cut, 4);
        to += 4;
    }
}

void check_finite(std::span<const double> numbers, const RawPlace& place) {
    const auto it = std::ranges::find_if_not(numbers, [](double x) { return std::isfinite(x); });
    if (it == numbers.end()) return;
    const auto index = place.before + static_cast<std::size_t>(it - numbers.begin());
    const std::string point =
        place.row == 0 ? std::string() : fmt::format(" in point {}", index / place.row);
    fail(ErrorKind::input, "{}: byte {}: {}{}; expected finite numbers", place.source,
         place.offset + index * place.size, *it, point);
}

}  // namespace stipple::io
