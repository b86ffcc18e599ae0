// SPDX-License-Identifier: MIT
//
// 64-bit fingerprint of bytes, to detect changes:
//
//     h_0 = 14695981039346656037,    h_i = (h_{i-1} xor byte_i) * 1099511628211  (mod 2^64).
//
// Beware  does not protect against deliberate changes.
// Source  G. Fowler, L. C. Noll, K.-P. Vo, D. Eastlake, The FNV non-cryptographic hash algorithm
//         (FNV-1a).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace stipple {

/// @param before fingerprint of the preceding bytes; nullopt if these bytes are the first
std::uint64_t fingerprint(std::string_view bytes, std::optional<std::uint64_t> before = {});

/// Fingerprint of the numbers as little-endian float64.
std::uint64_t fingerprint(std::span<const double> numbers);

/// Formats 16 hexadecimal digits.
std::string format_fingerprint(std::uint64_t value);

/// Fingerprint of the first 2^20 bytes of a file, which are added in pieces of any size.
class FrontFingerprint {
  public:
    void add(std::string_view bytes) {
        bytes = bytes.substr(0, size - taken_);
        hash_ = fingerprint(bytes, hash_);
        taken_ += bytes.size();
    }
    [[nodiscard]] std::string text() const { return format_fingerprint(hash_); }

  private:
    static constexpr std::size_t size = std::size_t{1} << 20;
    std::size_t taken_ = 0;
    std::uint64_t hash_ = fingerprint(std::string_view());
};

}  // namespace stipple
