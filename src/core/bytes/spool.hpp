// SPDX-License-Identifier: MIT
//
// What would take too much memory, on disk until it is needed.
#pragma once

#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace stipple {

/// Bytes that are read in the order in which they were written: a file in the folder of temporary
/// files (TMPDIR); where the system can, one without a name, which goes with the process.
/// @throws Error(io) where it has no room
class Spool {
  public:
    /// Without a buffer, what was written can be read though what came later had no room.
    enum class Buffered { no, yes };
    explicit Spool(Buffered buffered = Buffered::yes);
    Spool(const Spool&) = delete;
    Spool& operator=(const Spool&) = delete;
    ~Spool();

    void write(std::string_view bytes);

    /// What was written is read next, from the first byte on.
    void rewind();

    /// Fills all of it, or what is left for; returns how many bytes came.
    std::size_t read(std::span<char> bytes);

    /// A name under which it can be opened as long as it lives.
    [[nodiscard]] std::string path() const;

  private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    [[noreturn]] void refuse() const;

    bool buffered_;
    std::string folder_;
    std::string name_ = {};  ///< empty: it has none
    std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace stipple
