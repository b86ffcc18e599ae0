// SPDX-License-Identifier: MIT
#include "core/bytes/raw_numbers.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <iterator>

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

template <class One, class Two, class Four, class Eight>
void convert_whole(std::string_view bytes, const RawType& type, std::span<double> numbers) {
    if (type.size == 1) return convert<One>(bytes, type.big_endian, numbers);
    if (type.size == 2) return convert<Two>(bytes, type.big_endian, numbers);
    if (type.size == 4) return convert<Four>(bytes, type.big_endian, numbers);
    convert<Eight>(bytes, type.big_endian, numbers);
}

}  // namespace

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

}  // namespace stipple
