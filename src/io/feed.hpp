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

/// Sequential bytes of a file or of standard input, decompressed if necessary. The first bytes can
/// be inspected before they are read.
class Feed {
  public:
    static constexpr std::size_t front_size = std::size_t{1} << 22;

    /// Blocks until the front is available or a stop is requested.
    /// @throws Error(io): missing, a directory, unreadable; Error(input): damaged compressed data
    /// (also thrown by read()); Error(cancelled)
    Feed(const std::string& path, RunContext run);
    /// Reads from memory that the caller owns and keeps valid.
    explicit Feed(std::string_view bytes) : front_(bytes) {}

    /// The first front_size bytes, or all bytes if the input is shorter or in memory.
    [[nodiscard]] std::string_view front() const { return front_; }

    /// Whether the front holds the whole input.
    [[nodiscard]] bool ends_in_front() const {
        return file_.descriptor < 0 || front_.size() < front_size;
    }

    /// Reads the next bytes of the input, which begins with front(); returns how many: fewer than
    /// requested only at the end. @throws Error(io) if the file has changed since it was opened
    std::size_t read(std::span<char> bytes);

    /// Skips up to `count` bytes and returns how many were skipped; nullopt if the input cannot
    /// seek.
    std::optional<std::uint64_t> skip(std::uint64_t count);

    /// Reads all remaining bytes. @throws Error(limit)
    std::string read_all();

  private:
    /// Closes the descriptor, except standard input.
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
    std::size_t size_ = 0;         ///< file size when opened
    std::int64_t changed_at_ = 0;  ///< modification time when opened, in nanoseconds
    std::string held_;
    std::string_view front_;
    std::size_t taken_ = 0;  ///< bytes of the front already read
    std::string raw_;        ///< compressed bytes not yet decoded
    std::optional<Decompressor> decompressor_;
};

}  // namespace stipple::io
