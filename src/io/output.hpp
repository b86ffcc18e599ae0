// SPDX-License-Identifier: MIT
//
// Output files that appear under their names only when all of them are complete.
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
#include "core/bytes/fingerprint.hpp"
#include "core/bytes/spool.hpp"

namespace stipple::io {

/// Something with files under temporary names. All such files can be removed when the program ends
/// without destructors.
class PartFiles {
  public:
    PartFiles();
    PartFiles(const PartFiles&) = delete;
    PartFiles& operator=(const PartFiles&) = delete;
    virtual ~PartFiles();

    /// Removes the files of all objects, without allocating.
    static void remove_all() noexcept;

  protected:
    /// Removes the files of this object, if any.
    virtual void remove_parts() noexcept = 0;
};

/// A file that appears only when it is complete, or standard output for "-". Devices and pipes are
/// written in place; for a symbolic link, its target is replaced. Names ending in .gz or .zst get
/// compressed bytes. Until commit() the bytes are in an unnamed file, which vanishes with the
/// process, or in a file .stipple-PID-N.part in the same folder if the file system has no unnamed
/// files.
class Output final : public PartFiles {
  public:
    /// If a signal interrupts a write (handler installed without SA_RESTART) and `stop` was
    /// requested, the write is abandoned. @throws Error(io) if the file cannot be created
    explicit Output(std::string path, std::stop_token stop = {});
    /// Function that receives the bytes instead of a file; it returns false to stop the output.
    using Sink = std::function<bool(std::string_view bytes)>;
    explicit Output(Sink sink);
    /// Removes the file if it was not committed.
    ~Output() override;

    /// Writes all bytes. Returns false if the reader closed the pipe (SIGPIPE must be ignored), or
    /// the sink stopped. @throws Error(io) naming the target and the reason; Error(cancelled)
    bool write(std::string_view bytes);

    /// Ends writing. A file with a temporary name is closed, to save its descriptor. @throws
    /// Error(io)
    void finish();

    /// Gives the file its final name. @throws Error(io)
    void commit();

    [[nodiscard]] const std::string& path() const { return path_; }

    /// Fingerprint of the first bytes written so far, before compression.
    [[nodiscard]] std::string front() const { return front_.text(); }

    /// The temporary name, empty if there is none, and the target's name.
    [[nodiscard]] std::pair<const std::string&, const std::string&> names() const {
        return {temporary_, target_};
    }

    /// Leaves the temporary file to the caller, who renames or removes it.
    void release() { temporary_.clear(); }

  private:
    void remove_parts() noexcept override;
    void open_in_place();
    void open_beside(mode_t mode);
    bool open_unnamed(mode_t mode);
    bool put(std::string_view bytes);
    void name_it();
    void close();

    std::string path_;       ///< name in messages
    std::string target_;     ///< file to create or replace; empty: written in place
    std::string temporary_;  ///< name until commit(); empty if the file has no name
    std::stop_token stop_;
    Sink sink_;
    FrontFingerprint front_;
    std::unique_ptr<Compressor> compressor_;  ///< for names ending in .gz or .zst
    int descriptor_ = -1;
    bool owned_ = false;   ///< the destructor closes the descriptor
    bool broken_ = false;  ///< the reader closed the pipe
};

/// Output files of one command, which appear together or not at all. The number of files does not
/// affect memory: their names are stored on disk.
class Outputs final : public PartFiles {
  public:
    Outputs() = default;
    /// Removes the files that were not committed.
    ~Outputs() override;

    /// Opens the next Output with these arguments; the previous one must be complete. The reference
    /// is valid until the next call.
    template <class... Arguments>
    Output& add(Arguments&&... arguments) {
        set_aside();
        return files_.emplace_back(std::forward<Arguments>(arguments)...);
    }

    /// Puts all files in place. @throws Error(io) naming the files already in place
    void commit();

  private:
    void remove_parts() noexcept override;
    void set_aside();

    std::list<Output> files_;       ///< unnamed files, files written in place, and the last file
    std::unique_ptr<Spool> names_;  ///< temporary and final names of the other files
};

}  // namespace stipple::io
