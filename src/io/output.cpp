// SPDX-License-Identifier: MIT
#include "io/output.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <set>
#include <system_error>
#include <vector>

#include "core/bytes/file_bytes.hpp"
#include "core/error.hpp"
#include "core/text.hpp"

namespace stipple::io {
namespace {

/// File descriptor if the path names standard output or standard error; otherwise nullopt.
std::optional<int> standard_descriptor(const std::string& path) {
    if (path == "-" || path == "/dev/stdout" || path == "/dev/fd/1") return STDOUT_FILENO;
    if (path == "/dev/stderr" || path == "/dev/fd/2") return STDERR_FILENO;
    return std::nullopt;
}

/// Resolves symbolic links at the end of a path; the target need not exist.
std::filesystem::path follow_links(std::filesystem::path path) {
    std::error_code none;
    for (int links = 0; links < 40 && std::filesystem::is_symlink(path, none); ++links)
        path = path.parent_path() / std::filesystem::read_symlink(path, none);
    return path;
}

std::string folder_of(const std::filesystem::path& path) {
    const auto parent = path.parent_path();
    return parent.empty() ? "." : parent.string();
}

/// Temporary name in the target's folder. The counter distinguishes the files of one command.
std::string part_name(const std::filesystem::path& target) {
    static std::atomic<std::uint64_t> number = 0;
    return fmt::format("{}/.stipple-{}-{}.part", folder_of(target), ::getpid(), number++);
}

void append_text(std::string& record, const std::string& text) {
    const std::size_t size = text.size();
    record.append(reinterpret_cast<const char*>(&size), sizeof size).append(text);
}

using NameBuffer = std::array<char, PATH_MAX>;

/// Reads a text into the buffer, without allocating; returns nullopt at the end.
std::optional<std::string_view> take_text(Spool& spool, NameBuffer& buffer) {
    std::size_t size = 0;
    if (spool.read({reinterpret_cast<char*>(&size), sizeof size}) < sizeof size)
        return std::nullopt;
    if (size >= buffer.size() || spool.read({buffer.data(), size}) < size) return std::nullopt;
    buffer[size] = '\0';
    return std::string_view(buffer.data(), size);
}

/// Flag for opening a file without a name; 0 if the system does not support that.
#ifdef O_TMPFILE
constexpr int unnamed_file = O_TMPFILE;
#else
constexpr int unnamed_file = 0;
#endif

/// Path of an open file that has no name.
std::string name_of_descriptor(int descriptor) {
    return fmt::format("/proc/self/fd/{}", descriptor);
}

/// Whether at least 64 file descriptors remain after this one, which inputs may need.
bool leaves_descriptors(int descriptor) {
    constexpr rlim_t spare = 64;
    rlimit limit{};
    return ::getrlimit(RLIMIT_NOFILE, &limit) == 0 &&
           (limit.rlim_cur == RLIM_INFINITY ||
            static_cast<rlim_t>(descriptor) + spare < limit.rlim_cur);
}

struct Living {
    std::mutex mutex;
    std::set<PartFiles*> objects;
};
Living& living() {
    static Living all;
    return all;
}

}  // namespace

PartFiles::PartFiles() {
    const std::lock_guard lock(living().mutex);
    living().objects.insert(this);
}

PartFiles::~PartFiles() {
    const std::lock_guard lock(living().mutex);
    living().objects.erase(this);
}

void PartFiles::remove_all() noexcept {
    for (PartFiles* one : living().objects) one->remove_parts();
}

Output::Output(std::string path, std::stop_token stop)
    : path_(std::move(path)), stop_(std::move(stop)) {
    if (const auto standard = standard_descriptor(path_)) {
        descriptor_ = *standard;
        if (path_ == "-") path_ = "stdout";
        return;
    }
    if (const auto kind = compression_of_name(path_); kind != Compression::none)
        compressor_ = std::make_unique<Compressor>(kind);
    if (path_.empty()) fail(ErrorKind::io, "the output's name is empty; expected a file name");
    FileRules::require_writable(path_);
    struct stat status {};
    const bool there = ::stat(path_.c_str(), &status) == 0;
    if (!there && errno != ENOENT) refuse_file(path_, errno);
    if (there && S_ISDIR(status.st_mode)) refuse_file(path_, EISDIR);
    if (there && !S_ISREG(status.st_mode)) {
        open_in_place();
        return;
    }
    // A read-only file is not replaced, even if the folder's permissions would allow it.
    const bool protected_file = (status.st_mode & 0222) == 0 || ::access(path_.c_str(), W_OK) != 0;
    if (there && protected_file) fail(ErrorKind::io, "{}: the file is read-only", path_);
    target_ = follow_links(path_);
    // Drops set-user-ID and set-group-ID: they were set for the old content only.
    const auto mode = static_cast<mode_t>(there ? status.st_mode & 01777 : 0666);
    open_beside(mode);
    if (!there) return;
    // Restores the owner and the full mode, if permitted; the mode second, since changing the owner
    // clears some of its bits.
    if (::fchown(descriptor_, status.st_uid, status.st_gid) != 0) errno = 0;
    if (::fchmod(descriptor_, mode) != 0) errno = 0;
}

Output::Output(Sink sink) : sink_(std::move(sink)) {}

void Output::open_in_place() {
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
    if (descriptor_ < 0 && errno == EINTR) fail(ErrorKind::cancelled, "interrupted");
    if (descriptor_ < 0) refuse_file(path_, errno);
    owned_ = true;
}

void Output::open_beside(mode_t mode) {
    const std::string folder = folder_of(target_);
    struct stat status {};
    if (::stat(folder.c_str(), &status) != 0 && errno == ENOENT)
        fail(ErrorKind::io, "{}: there is no folder {}", path_, shown(folder));
    if (open_unnamed(mode)) return;
    while (descriptor_ < 0) {
        temporary_ = part_name(target_);
        descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
        if (descriptor_ >= 0 || errno == EEXIST) continue;
        temporary_.clear();
        if (errno == ENOENT) fail(ErrorKind::io, "{}: no file can be made in its folder", path_);
        refuse_file(path_, errno);
    }
    owned_ = true;
}

/// Creates a file without a name if the file system supports that and allows naming it later.
bool Output::open_unnamed(mode_t mode) {
    if (unnamed_file == 0) return false;
    const std::string folder = folder_of(target_);
    const int descriptor = ::open(folder.c_str(), unnamed_file | O_WRONLY | O_CLOEXEC, mode);
    if (descriptor < 0) return false;
    if (leaves_descriptors(descriptor) &&
        ::access(name_of_descriptor(descriptor).c_str(), F_OK) == 0) {
        descriptor_ = descriptor;
        owned_ = true;
        return true;
    }
    ::close(descriptor);
    return false;
}

Output::~Output() {
    if (owned_ && descriptor_ >= 0) ::close(descriptor_);
    remove_parts();
}

void Output::remove_parts() noexcept {
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

bool Output::write(std::string_view bytes) {
    if (sink_) {
        broken_ = broken_ || (!bytes.empty() && !sink_(bytes));
        return !broken_;
    }
    front_.add(bytes);
    if (!compressor_) return put(bytes);
    return compressor_->add(bytes, [this](std::string_view some) { return put(some); });
}

void Output::finish() {
    if (const auto compressor = std::move(compressor_))
        compressor->finish([this](std::string_view some) { return put(some); });
    if (!temporary_.empty()) close();
}

bool Output::put(std::string_view bytes) {
    while (!bytes.empty() && !broken_) {
        // Also before the first write: it may wait for a reader, and no other signal will end it.
        if (stop_.stop_requested()) fail(ErrorKind::cancelled, "interrupted");
        const auto done = ::write(descriptor_, bytes.data(), bytes.size());
        if (done >= 0) {
            bytes.remove_prefix(static_cast<std::size_t>(done));
        } else if (errno == EPIPE) {
            broken_ = true;
        } else if (errno == EAGAIN) {
            pollfd waiting{.fd = descriptor_, .events = POLLOUT, .revents = 0};
            ::poll(&waiting, 1, 50);
        } else if (errno != EINTR) {
            refuse_file(path_, errno);
        }
    }
    return !broken_;
}

void Output::close() {
    if (!owned_ || descriptor_ < 0) return;
    const int closed = ::close(descriptor_);
    descriptor_ = -1;
    if (closed != 0) refuse_file(path_, errno);
}

/// Links the unnamed file to the target's name. If the target exists, links the file to a temporary
/// name, from which commit() renames it.
void Output::name_it() {
    const std::string unnamed = name_of_descriptor(descriptor_);
    const auto link_as = [&](const std::string& name) {
        return ::linkat(AT_FDCWD, unnamed.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
    };
    if (link_as(target_)) return;
    while (errno == EEXIST) {
        std::string name = part_name(target_);
        if (!link_as(name)) continue;
        temporary_ = std::move(name);
        return;
    }
    refuse_file(path_, errno);
}

void Output::commit() {
    finish();
    if (!target_.empty() && temporary_.empty() && descriptor_ >= 0) name_it();
    close();
    if (temporary_.empty()) return;
    if (::rename(temporary_.c_str(), target_.c_str()) != 0) refuse_file(path_, errno);
    temporary_.clear();
}

void Outputs::set_aside() {
    if (files_.empty()) return;
    files_.back().finish();
    const auto& [name, target] = files_.back().names();
    if (name.empty()) return;
    if (!names_) names_ = std::make_unique<Spool>(Spool::Buffered::no);
    std::string record;
    append_text(record, name);
    append_text(record, target);
    names_->write(record);
    files_.back().release();
    files_.pop_back();
}

Outputs::~Outputs() { remove_parts(); }

void Outputs::remove_parts() noexcept {
    if (!names_) return;
    try {
        names_->rewind();
        NameBuffer buffer;
        for (; take_text(*names_, buffer); take_text(*names_, buffer)) ::unlink(buffer.data());
    } catch (...) {  // the names cannot be read, so the files are not removed
    }
}

void Outputs::commit() {
    constexpr std::size_t named = 10;
    std::uint64_t count = 0;
    std::vector<std::string> some;  // names of files already in place
    some.reserve(named);
    // Calls put() to put one file in place. Returns false if put() returns no path, because no file
    // is left to put in place.
    const auto place = [&](const auto& put) {
        try {
            std::optional<std::string> path = put();
            if (path && count++ < named) some.push_back(std::move(*path));
            return path.has_value();
        } catch (...) {
            if (count == 0) throw;
            const Error e = caught_error();
            const std::string more =
                count > named ? fmt::format(" and {} others", count - named) : "";
            throw Error(e.kind(),
                        fmt::format("{}; already written: {}{}", e.what(), join(some, ", "), more),
                        e.hint());
        }
    };
    set_aside();
    for (Output& file : files_)
        place([&] {
            std::optional path = file.path();
            file.commit();
            return path;
        });
    files_.clear();
    if (!names_) return;
    names_->rewind();
    while (place([&]() -> std::optional<std::string> {
        NameBuffer name;
        NameBuffer buffer;
        if (!take_text(*names_, name)) return std::nullopt;
        std::string target(take_text(*names_, buffer).value());
        if (::rename(name.data(), target.c_str()) != 0) refuse_file(target, errno);
        return target;
    })) {
    }
    names_.reset();
}

}  // namespace stipple::io
