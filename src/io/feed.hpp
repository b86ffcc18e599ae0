// SPDX-License-Identifier: MIT
//
// Bytes of files and pipes, read in order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/bytes/compression.hpp"
#include "stipple/run.hpp"

namespace stipple::io {

/// The bytes of a file or of standard input, in order, decompressed where they are compressed. The
/// first of them can be looked at before they are read.
class Feed {
  public:
    static constexpr std::size_t front_size = std::size_t{1} << 22;

    /// Waits for the front's bytes as long as nobody asks to stop.
    /// @throws Error(io): missing, a directory, unreadable; Error(input): damaged where it is
    /// compressed, as also when it is read; Error(cancelled).
    Feed(const std::string& path, RunContext run);
    /// Bytes that are there already, and stay.
    explicit Feed(std::string_view bytes) : front_(bytes) {}

    /// The first front_size bytes, or all where there are fewer, or where they are there already.
    [[nodiscard]] std::string_view front() const { return front_; }

    /// Whether the front is all there is.
    [[nodiscard]] bool ends_in_front() const {
        return file_.descriptor < 0 || front_.size() < front_size;
    }

    /// Takes the next bytes, from the front on; fewer than asked for only at the end.
    /// @throws Error(io) where a file has changed since it was opened
    std::size_t read(std::span<char> bytes);

    /// Goes past the next bytes, as many as there are up to `count`, and says how many these were;
    /// nothing where they can only be read.
    std::optional<std::uint64_t> skip(std::uint64_t count);

    /// Takes all bytes. @throws Error(limit)
    std::string read_all();

  private:
    /// Closes what it opened.
    struct File {
        File() = default;
        File(const File&) = delete;
        File& operator=(const File&) = delete;
        ~File();

        int descriptor = -1;
    };

    std::size_t fetch(std::span<char> bytes);
    std::size_t fetch_raw(std::span<char> bytes);
    void decompress(Compression kind);
    void check_unchanged() const;

    std::string name_ = {};
    RunContext run_ = {};
    File file_ = {};
    std::size_t size_ = 0;         ///< of a file, as it was when it was opened
    std::int64_t changed_at_ = 0;  ///< as then; nanoseconds
    std::string held_;
    std::string_view front_;
    std::size_t taken_ = 0;  ///< bytes of the front that were read
    std::string raw_;        ///< compressed bytes
    std::optional<Decompressor> decompressor_;
};

}  // namespace stipple::io
