// SPDX-License-Identifier: MIT
//
// Temporary storage on disk for data too large for memory.
#pragma once

#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace stipple {

/// A file in the temporary folder (TMPDIR); its bytes are read in the order in which they were
/// written. On Linux it has no name and disappears with the process.
/// @throws Error(io) if the disk is full
class Spool {
  public:
    /// Without a buffer, bytes already written stay readable if a later write finds the disk full.
    enum class Buffered { no, yes };
    explicit Spool(Buffered buffered = Buffered::yes);
    Spool(const Spool&) = delete;
    Spool& operator=(const Spool&) = delete;
    ~Spool();

    void write(std::string_view bytes);

    /// Ends writing; the next read() starts at the first byte.
    void rewind();

    /// Fills `bytes`, or only its front at the end of the file; returns the number of bytes read.
    std::size_t read(std::span<char> bytes);

    /// Path by which the file can be opened during this object's lifetime.
    [[nodiscard]] std::string path() const;

  private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    [[noreturn]] void refuse() const;

    bool buffered_;
    std::string folder_;
    std::string name_ = {};  ///< empty: the file has no name
    std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace stipple
