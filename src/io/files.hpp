// SPDX-License-Identifier: MIT
//
// Bytes in and out: whole files or standard input, read at once; output beside its target, renamed
// when whole.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "core/point_set.hpp"
#include "io/feed.hpp"
#include "io/format.hpp"
#include "stipple/run.hpp"

namespace stipple::io {

/// The bytes of a file, or of standard input for "-". @throws Error as Feed does; Error(limit)
std::string read_bytes(const std::string& path, const RunContext& run);

/// A file that comes into being when it is whole, or standard output for "-". Devices and pipes are
/// written in place; a link's target is replaced, not the link.
class Output {
  public:
    /// A write that is interrupted by a signal (its handler installed without SA_RESTART) ends when
    /// `stop` was requested.
    /// @throws Error(io) when the target cannot be made.
    explicit Output(std::string path, std::stop_token stop = {});
    /// Takes the bytes in place of a file; false: it wants no more.
    using Sink = std::function<bool(std::string_view bytes)>;
    explicit Output(Sink sink);
    Output(const Output&) = delete;
    Output& operator=(const Output&) = delete;
    /// Removes what was not committed.
    ~Output();

    /// Writes all bytes. False: the reader of the pipe went away, and nobody wants more (SIGPIPE
    /// must be ignored).
    /// @throws Error(io), naming the target and the reason; Error(cancelled).
    bool write(std::string_view bytes);

    /// Ends the writing, for a file that waits for commit(). @throws Error(io)
    void close();

    /// Puts the file in its place. @throws Error(io)
    void commit();

  private:
    void open_beside(const std::string& target);
    void open_in_place();

    std::string path_;       ///< as messages name it
    std::string target_;     ///< what is replaced
    std::string temporary_;  ///< empty: written in place (standard output, devices)
    std::stop_token stop_;
    Sink sink_;
    int descriptor_ = -1;
    bool owned_ = false;   ///< the descriptor is ours to close
    bool broken_ = false;  ///< the pipe has no reader
};

/// The format that a file's extension means or, where it leaves that open, its first bytes.
const Format& format_for(const std::string& path, std::string_view bytes);

/// All sets in the bytes of a file; else as read_points.
std::vector<PointSet> read_sets(std::string_view bytes, const std::string& path,
                                const ReadOptions& options, const RunContext& run,
                                const Format* format = nullptr);

/// All sets of a file, in the named format or the one that its extension or its bytes tell. Where
/// options.source is "-", messages name `path`.
/// @throws Error(input), Error(io), Error(usage)
std::vector<PointSet> read_points(const std::string& path, const ReadOptions& options,
                                  const RunContext& run, const Format* format = nullptr);

/// The one set of the file that an option of a unit names.
/// @throws Error as read_points; Error(usage) for standard input, which could not be read again
PointSet read_given(std::string_view option, const std::string& path, const ReadOptions& options,
                    const RunContext& run);

}  // namespace stipple::io
