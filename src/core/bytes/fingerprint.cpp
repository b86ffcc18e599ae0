// SPDX-License-Identifier: MIT
#include "core/bytes/fingerprint.hpp"

#include <fmt/format.h>

#include <bit>

namespace stipple {
namespace {

constexpr std::uint64_t basis = 14695981039346656037U;
constexpr std::uint64_t prime = 1099511628211U;

}  // namespace

std::uint64_t fingerprint(std::string_view bytes, std::optional<std::uint64_t> before) {
    std::uint64_t hash = before.value_or(basis);
    for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * prime;
    return hash;
}

std::uint64_t fingerprint(std::span<const double> numbers) {
    std::uint64_t hash = basis;
    for (const double number : numbers) {
        const auto bits = std::bit_cast<std::uint64_t>(number);
        for (int byte = 0; byte < 64; byte += 8) hash = (hash ^ ((bits >> byte) & 255)) * prime;
    }
    return hash;
}

std::string format_fingerprint(std::uint64_t value) { return fmt::format("{:016x}", value); }

}  // namespace stipple
