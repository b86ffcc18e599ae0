// SPDX-License-Identifier: MIT
#include "io/binary.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "core/error.hpp"
#include "io/decimal.hpp"

namespace stipple::io {
namespace {

static_assert(std::endian::native == std::endian::little);

template <class Stored>
void convert(std::string_view bytes, bool swapped, std::span<double> numbers) {
    const char* from = bytes.data();
    for (double& number : numbers) {
        char raw[sizeof(Stored)];
        std::memcpy(raw, from, sizeof raw);
        if (swapped) std::reverse(std::begin(raw), std::end(raw));
        number = static_cast<double>(std::bit_cast<Stored>(raw));
        from += sizeof raw;
    }
}

template <class One, class Two, class Four, class Eight>
void convert_whole(std::string_view bytes, const RawType& type, std::span<double> numbers) {
    if (type.size == 1) return convert<One>(bytes, type.big_endian, numbers);
    if (type.size == 2) return convert<Two>(bytes, type.big_endian, numbers);
    if (type.size == 4) return convert<Four>(bytes, type.big_endian, numbers);
    convert<Eight>(bytes, type.big_endian, numbers);
}

}  // namespace

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

void take_raw(std::string_view bytes, const RawType& type, std::span<double> numbers) {
    switch (type.kind) {
        case RawType::integer:
            return convert_whole<std::int8_t, std::int16_t, std::int32_t, std::int64_t>(bytes, type,
                                                                                        numbers);
        case RawType::natural:
            return convert_whole<std::uint8_t, std::uint16_t, std::uint32_t, std::uint64_t>(
                bytes, type, numbers);
        case RawType::floating:
            break;
    }
    if (type.size == 4) return convert<float>(bytes, type.big_endian, numbers);
    convert<double>(bytes, type.big_endian, numbers);
}

void check_finite(std::span<const double> numbers, const RawPlace& place) {
    const auto it = std::ranges::find_if_not(numbers, [](double x) { return std::isfinite(x); });
    if (it == numbers.end()) return;
    const auto index = static_cast<std::size_t>(it - numbers.begin());
    const std::string point =
        place.row == 0 ? std::string() : fmt::format(" in point {}", index / place.row);
    fail(ErrorKind::input, "{}: byte {}: {}{}; expected finite numbers", place.source,
         place.offset + index * place.size, *it, point);
}

}  // namespace stipple::io
