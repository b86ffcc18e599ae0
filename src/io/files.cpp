// SPDX-License-Identifier: MIT
#include "io/files.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>

#include "core/error.hpp"
#include "core/file_bytes.hpp"
#include "core/text.hpp"
#include "io/point_stream.hpp"
#include "io/source_text.hpp"

namespace stipple::io {
namespace {

/// A descriptor that is closed in the end.
struct Closing {
    int descriptor;
    ~Closing() {
        if (descriptor > STDERR_FILENO) ::close(descriptor);
    }
};

[[noreturn]] void refuse(const std::string& name, int error) {
    fail(ErrorKind::io, "{}: {}", name, file_trouble(error));
}

/// Waits until bytes (or their end) are there.
void wait_for_bytes(int descriptor, const RunContext& run) {
    constexpr int patience = 50;  // milliseconds between two looks at the stop token
    pollfd waiting{.fd = descriptor, .events = POLLIN, .revents = 0};
    for (int ready = 0; ready == 0;) {
        run.check_stop();
        ready = ::poll(&waiting, 1, patience);
        if (ready < 0 && errno == EINTR) ready = 0;
    }
}

/// /dev/fd/3 -> 3; else nothing.
std::optional<int> standard_descriptor(const std::string& path) {
    if (path == "-" || path == "/dev/stdout" || path == "/dev/fd/1") return STDOUT_FILENO;
    if (path == "/dev/stderr" || path == "/dev/fd/2") return STDERR_FILENO;
    return std::nullopt;
}

/// What a chain of symbolic links ends in, whether it is there or not.
std::string follow_links(std::string path) {
    std::array<char, 4096> target;
    for (int links = 0; links < 40; ++links) {
        const auto size = ::readlink(path.c_str(), target.data(), target.size());
        if (size < 0) break;
        std::string next(target.data(), static_cast<std::size_t>(size));
        const auto slash = path.rfind('/');
        if (!next.starts_with('/') && slash != std::string::npos)
            next.insert(0, path.substr(0, slash + 1));
        path = std::move(next);
    }
    return path;
}

std::string folder_of(const std::string& path) {
    const auto slash = path.rfind('/');
    return slash == std::string::npos ? "." : path.substr(0, std::max<std::size_t>(slash, 1));
}

/// Opens a file for reading, or takes standard input for "-". @throws Error(io)
int open_to_read(const std::string& path, struct stat& status) {
    // Without O_NONBLOCK, opening a named pipe would wait where nobody can stop it.
    const int descriptor =
        path == "-" ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0 || ::fstat(descriptor, &status) != 0) refuse(source_name(path), errno);
    if (S_ISDIR(status.st_mode)) {
        const Closing file{descriptor};
        refuse(source_name(path), EISDIR);
    }
    return descriptor;
}

}  // namespace

const Format& format_for(const std::string& path, std::string_view bytes) {
    const Format* named = format_of_extension(path);
    if (named == nullptr || named->name == "csv" || named->name == "txt")
        return format_of_bytes(bytes);
    if (named->name == "json" || named->name == "jsonl") {
        const Format& found = format_of_bytes(bytes);
        if (found.name == "json" || found.name == "jsonl") return found;
    }
    return *named;
}

Feed::Feed(const std::string& path, RunContext run)
    : name_(source_name(path)), run_(std::move(run)) {
    struct stat status {};
    descriptor_ = open_to_read(path, status);
#ifdef F_SETPIPE_SZ
    // Large enough for a writer's whole block, so that both sides work at the same time.
    if (S_ISFIFO(status.st_mode)) ::fcntl(descriptor_, F_SETPIPE_SZ, 1 << 20);
#endif
    front_.resize(front_size);
    try {
        front_.resize(fetch(front_));
    } catch (...) {
        const Closing file{descriptor_};
        throw;
    }
}

Feed::~Feed() { const Closing file{descriptor_}; }

std::size_t Feed::fetch(std::span<char> bytes) {
    std::size_t done = 0;
    while (done < bytes.size()) {
        wait_for_bytes(descriptor_, run_);
        const auto got = ::read(descriptor_, bytes.data() + done, bytes.size() - done);
        if (got == 0) break;
        if (got > 0)
            done += static_cast<std::size_t>(got);
        else if (errno != EINTR && errno != EAGAIN)
            refuse(name_, errno);
    }
    return done;
}

std::size_t Feed::read(std::span<char> bytes) {
    const std::size_t held = std::min(front_.size() - taken_, bytes.size());
    std::copy_n(front_.begin() + static_cast<std::ptrdiff_t>(taken_), held, bytes.begin());
    taken_ += held;
    return held == bytes.size() ? held : held + fetch(bytes.subspan(held));
}

std::optional<std::uint64_t> Feed::skip(std::uint64_t count) {
    struct stat status {};
    if (::fstat(descriptor_, &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
    const auto ahead = std::min<std::uint64_t>(count, front_.size() - taken_);
    const auto at = ::lseek(descriptor_, 0, SEEK_CUR);
    if (at < 0) return std::nullopt;
    const auto left = static_cast<std::uint64_t>(std::max<off_t>(0, status.st_size - at));
    const auto behind = std::min(count - ahead, left);
    if (behind > 0 && ::lseek(descriptor_, static_cast<off_t>(behind), SEEK_CUR) < 0)
        return std::nullopt;
    taken_ += static_cast<std::size_t>(ahead);
    return ahead + behind;
}

std::string Feed::read_all() {
    std::string bytes = front_.substr(taken_);
    if (ends_in_front()) return bytes;
    for (;;) {
        const std::size_t before = bytes.size();
        run_.need_memory(2 * static_cast<double>(before), "the bytes of " + name_);
        bytes.resize(before + std::max(before, front_size));
        const std::size_t got = fetch(std::span(bytes).subspan(before));
        const bool end = got < bytes.size() - before;
        bytes.resize(before + got);
        if (end) return bytes;
    }
}

Input::Input(const std::string& path, const RunContext& run) {
    const std::string name = source_name(path);
    struct stat status {};
    const Closing file{open_to_read(path, status)};
    if (S_ISREG(status.st_mode) && status.st_size > 0 &&
        ::lseek(file.descriptor, 0, SEEK_CUR) == 0) {
        size_ = static_cast<std::size_t>(status.st_size);
        void* const data =
            ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE | MAP_POPULATE, file.descriptor, 0);
        mapped_ = data != MAP_FAILED;
        if (mapped_) {
            data_ = static_cast<char*>(data);
            return;
        }
        size_ = 0;
    }
    try {
        read_all(file.descriptor, name, run);
    } catch (...) {
        std::free(data_);
        throw;
    }
}

void Input::read_all(int descriptor, const std::string& name, const RunContext& run) {
    constexpr std::size_t first_room = std::size_t{1} << 16;
    std::size_t room = 0;
    for (;;) {
        if (size_ == room) {
            room = std::max(first_room, 2 * room);
            run.need_memory(static_cast<double>(room), "the bytes of " + name);
            // Unlike a string, this grows large blocks without a copy.
            auto* const more = static_cast<char*>(std::realloc(data_, room));
            if (more == nullptr) fail(ErrorKind::limit, "{}: no memory for its bytes", name);
            data_ = more;
        }
        wait_for_bytes(descriptor, run);
        const auto got = ::read(descriptor, data_ + size_, room - size_);
        if (got == 0) return;
        if (got > 0)
            size_ += static_cast<std::size_t>(got);
        else if (errno != EINTR && errno != EAGAIN)
            refuse(name, errno);
    }
}

Input::~Input() {
    if (mapped_)
        ::munmap(data_, size_);
    else
        std::free(data_);
}

Output::Output(std::string path, std::stop_token stop)
    : path_(std::move(path)), stop_(std::move(stop)) {
    if (const auto standard = standard_descriptor(path_)) {
        descriptor_ = *standard;
        if (path_ == "-") path_ = "stdout";
        return;
    }
    if (path_.empty()) fail(ErrorKind::io, "the output's name is empty; expected a file's name");
    target_ = follow_links(path_);
    struct stat status {};
    const bool there = ::stat(path_.c_str(), &status) == 0;
    if (!there && errno != ENOENT) refuse(path_, errno);
    if (there && S_ISDIR(status.st_mode)) refuse(path_, EISDIR);
    if (there && !S_ISREG(status.st_mode)) {
        open_in_place();
        return;
    }
    // A file that nobody may write is meant to stay, even where the user could replace it.
    const bool protected_file = (status.st_mode & 0222) == 0 || ::access(path_.c_str(), W_OK) != 0;
    if (there && protected_file) fail(ErrorKind::io, "{}: the file is read-only", path_);
    open_beside(target_);
    if (!there) return;
    // The owner stays where that is allowed; the mode comes second, for a change of owner cuts it.
    if (::fchown(descriptor_, status.st_uid, status.st_gid) != 0) errno = 0;
    ::fchmod(descriptor_, status.st_mode & 07777);
}

Output::Output(Sink sink) : sink_(std::move(sink)) {}

void Output::open_in_place() {
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
    if (descriptor_ < 0 && errno == EINTR) fail(ErrorKind::cancelled, "interrupted");
    if (descriptor_ < 0) refuse(path_, errno);
    owned_ = true;
}

void Output::open_beside(const std::string& target) {
    const std::string folder = folder_of(target);
    struct stat status {};
    if (::stat(folder.c_str(), &status) != 0 && errno == ENOENT)
        fail(ErrorKind::io, "{}: there is no folder {}", path_, shown(folder));
    for (int attempt = 0; descriptor_ < 0; ++attempt) {
        temporary_ = fmt::format("{}/.stipple-{}-{}.part", folder, ::getpid(), attempt);
        descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor_ >= 0 || errno == EEXIST) continue;
        temporary_.clear();
        if (errno == ENOENT) fail(ErrorKind::io, "{}: no file can be made in its folder", path_);
        refuse(path_, errno);
    }
    owned_ = true;
}

Output::~Output() {
    if (owned_ && descriptor_ >= 0) ::close(descriptor_);
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

bool Output::write(std::string_view bytes) {
    if (sink_) {
        broken_ = broken_ || (!bytes.empty() && !sink_(bytes));
        return !broken_;
    }
    while (!bytes.empty() && !broken_) {
        const auto done = ::write(descriptor_, bytes.data(), bytes.size());
        if (done >= 0) {
            bytes.remove_prefix(static_cast<std::size_t>(done));
        } else if (errno == EPIPE) {
            broken_ = true;
        } else if (errno == EAGAIN) {
            pollfd waiting{.fd = descriptor_, .events = POLLOUT, .revents = 0};
            ::poll(&waiting, 1, 50);
        } else if (errno != EINTR) {
            refuse(path_, errno);
        }
        if (stop_.stop_requested()) fail(ErrorKind::cancelled, "interrupted");
    }
    return !broken_;
}

void Output::close() {
    if (!owned_ || descriptor_ < 0) return;
    const int closed = ::close(descriptor_);
    descriptor_ = -1;
    if (closed != 0) refuse(path_, errno);
}

void Output::commit() {
    close();
    if (temporary_.empty()) return;
    if (::rename(temporary_.c_str(), target_.c_str()) != 0) refuse(path_, errno);
    temporary_.clear();
}

std::vector<PointSet> read_sets(std::string_view bytes, const std::string& path,
                                const ReadOptions& options, const RunContext& run,
                                const Format* format) {
    ReadOptions inner = options;
    if (inner.source == "-") inner.source = path;
    inner.single = options.single || extension_is_single(path);
    const Format& chosen = format != nullptr ? *format : format_for(path, bytes);
    if (!chosen.read) {
        std::vector<std::string> readable;
        for (const Format& known : all())
            if (known.read) readable.push_back(known.name);
        fail(ErrorKind::usage, "{}: {} is only written; formats that are read: {}",
             source_name(inner.source), chosen.name, join(readable, ", "));
    }
    return chosen.read(bytes, inner, run);
}

std::vector<PointSet> read_points(const std::string& path, const ReadOptions& options,
                                  const RunContext& run, const Format* format) {
    const Input input(path, run);
    return read_sets(input.bytes(), path, options, run, format);
}

}  // namespace stipple::io
