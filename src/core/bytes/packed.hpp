// SPDX-License-Identifier: MIT
//
// Serialization of values to bytes and back, for other processes on machines of the same type.
#pragma once

#include <cassert>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "stipple/error.hpp"

namespace stipple {

class Packer {
  public:
    template <class T>
    Packer& put(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
        return *this;
    }

    template <class T>
    Packer& put_all(std::span<const T> values) {
        static_assert(std::is_trivially_copyable_v<T>);
        put<std::uint64_t>(values.size());
        bytes_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
        return *this;
    }
    template <class T>
    Packer& put_all(const std::vector<T>& values) {
        return put_all(std::span<const T>(values));
    }
    Packer& put_all(std::string_view text) { return put_all(std::span<const char>(text)); }

    [[nodiscard]] std::string take() { return std::move(bytes_); }

  private:
    std::string bytes_;
};

/// Reads values in the order in which they were put, with the same types.
class Unpacker {
  public:
    /// Keeps a view of the bytes, which must outlive the Unpacker.
    explicit Unpacker(std::string_view bytes) : bytes_(bytes) {}

    template <class T>
    T take() {
        T value{};
        copy(&value, sizeof value);
        return value;
    }

    template <class T>
    std::vector<T> take_all() {
        std::vector<T> values(take<std::uint64_t>());
        copy(values.data(), values.size() * sizeof(T));
        return values;
    }
    std::string take_text() {
        std::string text(take<std::uint64_t>(), '\0');
        copy(text.data(), text.size());
        return text;
    }

    [[nodiscard]] bool empty() const { return bytes_.empty(); }

  private:
    void copy(void* to, std::size_t size) {
        assert(size <= bytes_.size());
        if (size > 0) std::memcpy(to, bytes_.data(), size);
        bytes_.remove_prefix(size);
    }

    std::string_view bytes_;
};

inline std::string packed(const Error& error) {
    return Packer().put(error.kind()).put_all(error.what()).put_all(error.hint()).take();
}

inline Error unpacked_error(std::string_view bytes) {
    Unpacker from(bytes);
    const auto kind = from.take<ErrorKind>();
    const std::string what = from.take_text();
    return {kind, what, from.take_text()};
}

}  // namespace stipple
