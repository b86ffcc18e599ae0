// SPDX-License-Identifier: MIT
//
// Bytes in and out: whole files or standard input, read at once; output beside its target, renamed
// when whole.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/point_set.hpp"
#include "core/run_context.hpp"
#include "io/format.hpp"

namespace stipple::io {

/// The bytes of a file (mapped), or of standard input for "-".
class Input {
  public:
    /// @throws Error(io): missing, a directory, unreadable; Error(cancelled).
    Input(const std::string& path, const RunContext& run);
    Input(const Input&) = delete;
    Input& operator=(const Input&) = delete;
    ~Input();

    [[nodiscard]] std::string_view bytes() const { return bytes_; }

  private:
    std::string_view bytes_;
    std::string owned_;
    void* mapped_ = nullptr;
};

/// A file that comes into being when it is whole, or standard output for "-".
class Output {
  public:
    /// @throws Error(io) when the target cannot be made.
    explicit Output(std::string path);
    Output(const Output&) = delete;
    Output& operator=(const Output&) = delete;
    /// Removes what was not committed.
    ~Output();

    /// Writes all bytes. False: the reader of the pipe went away, and nobody wants more.
    /// @throws Error(io), naming the target and the reason.
    bool write(std::string_view bytes);

    /// Puts the file in its place. @throws Error(io)
    void commit();

  private:
    std::string path_;
    std::string temporary_;  ///< empty: written in place (standard output, devices)
    int descriptor_ = -1;
};

/// All sets of a file, in the named format or the one that its extension or its bytes tell.
/// @throws Error(input), Error(io), Error(usage)
std::vector<PointSet> read_points(const std::string& path, const ReadOptions& options,
                                  const RunContext& run, const Format* format = nullptr);

}  // namespace stipple::io
