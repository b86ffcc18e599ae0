// SPDX-License-Identifier: MIT
#include "core/bytes/raw_numbers.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>

#include "core/error.hpp"

namespace stipple {
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

/// Converts stored numbers as the type among `Stored...` that has type.size bytes.
template <class... Stored>
void convert_sized(std::string_view bytes, const RawType& type, std::span<double> numbers) {
    const auto convert_if = [&]<class One>(One) {
        if (sizeof(One) == type.size) convert<One>(bytes, type.big_endian, numbers);
    };
    (convert_if(Stored{}), ...);
}

}  // namespace

void take_raw(std::string_view bytes, const RawType& type, std::span<double> numbers) {
    using std::int16_t, std::int32_t, std::int64_t, std::int8_t;
    using std::uint16_t, std::uint32_t, std::uint64_t, std::uint8_t;
    if (type.kind == RawType::floating) convert_sized<float, double>(bytes, type, numbers);
    if (type.kind == RawType::integer)
        convert_sized<int8_t, int16_t, int32_t, int64_t>(bytes, type, numbers);
    if (type.kind == RawType::natural)
        convert_sized<uint8_t, uint16_t, uint32_t, uint64_t>(bytes, type, numbers);
}

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
        if (std::abs(number) > double{std::numeric_limits<float>::max()} && std::isfinite(number))
            fail(ErrorKind::input, "float32 cannot hold {}; write float64", number);
        std::memcpy(to, &cut, 4);
        to += 4;
    }
}

float to_single(double value) {
    const auto single = static_cast<float>(value);
    return std::abs(static_cast<double>(single)) > std::abs(value) ? std::nextafter(single, 0.0F)
                                                                   : single;
}

}  // namespace stipple
