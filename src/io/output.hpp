// SPDX-License-Identifier: MIT
//
// Files that are written beside their targets and put in place when all of them are whole.
#pragma once

#include <sys/types.h>

#include <functional>
#include <list>
#include <memory>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>

#include "core/bytes/compression.hpp"
#include "core/bytes/spool.hpp"

namespace stipple::io {

/// A file that comes into being when it is whole, or standard output for "-". Devices and pipes are
/// written in place; a link's target is replaced, not the link. A name that ends in .gz or .zst gets
/// compressed bytes. Until commit() the bytes are in a
/// file without a name, which vanishes with the process, or in a file NAME.part where the file
/// system has no such files.
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

    /// No more is written: what has a name till commit() needs no descriptor. @throws Error(io)
    void finish();

    /// Puts the file in its place. @throws Error(io)
    void commit();

    [[nodiscard]] const std::string& path() const { return path_; }

    /// The name until commit(), empty where it has none, and that of the target.
    [[nodiscard]] std::pair<const std::string&, const std::string&> names() const {
        return {temporary_, target_};
    }

    /// Somebody else renames or removes the file of that name from now on.
    void release() { temporary_.clear(); }

  private:
    void open_in_place();
    void open_beside(mode_t mode);
    bool open_unnamed(mode_t mode);
    bool put(std::string_view bytes);
    void name_it();
    void close();

    std::string path_;       ///< as messages name it
    std::string target_;     ///< what is replaced; empty: written in place
    std::string temporary_;  ///< the name until commit(); empty: none
    std::stop_token stop_;
    Sink sink_;
    std::unique_ptr<Compressor> compressor_;  ///< of what a name that ends in .gz or .zst gets
    int descriptor_ = -1;
    bool owned_ = false;   ///< the descriptor is ours to close
    bool broken_ = false;  ///< the pipe has no reader
};

/// The files of one command, which appear together or not at all. Their names do not take memory,
/// however many there are.
class Outputs {
  public:
    Outputs() = default;
    Outputs(const Outputs&) = delete;
    Outputs& operator=(const Outputs&) = delete;
    /// Removes what was not committed.
    ~Outputs();

    /// One more, made as an Output is, when the one before is written; the reference is valid until
    /// the next.
    template <class... Arguments>
    Output& add(Arguments&&... arguments) {
        set_aside();
        return files_.emplace_back(std::forward<Arguments>(arguments)...);
    }

    /// Puts all files in their places. @throws Error(io), naming those that are in place already
    void commit();

  private:
    void set_aside();

    std::list<Output> files_;  ///< those that are open, or were never beside a target, and the last
    std::unique_ptr<Spool> names_;  ///< the others: the names they have, and are to have
};

}  // namespace stipple::io
