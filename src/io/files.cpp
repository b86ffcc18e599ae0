// SPDX-License-Identifier: MIT
#include "io/files.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include "core/bytes/file_bytes.hpp"
#include "core/bytes/file_rules.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "core/utf8.hpp"
#include "io/feed.hpp"
#include "io/source_text.hpp"

namespace stipple::io {
namespace {

/// /dev/fd/3 -> 3; else nothing.
std::optional<int> standard_descriptor(const std::string& path) {
    if (path == "-" || path == "/dev/stdout" || path == "/dev/fd/1") return STDOUT_FILENO;
    if (path == "/dev/stderr" || path == "/dev/fd/2") return STDERR_FILENO;
    return std::nullopt;
}

/// What a chain of symbolic links ends in, whether it is there or not.
std::filesystem::path follow_links(std::filesystem::path path) {
    std::error_code none;
    for (int links = 0; links < 40 && std::filesystem::is_symlink(path, none); ++links)
        path = path.parent_path() / std::filesystem::read_symlink(path, none);
    return path;
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

std::string read_bytes(const std::string& path, const RunContext& run) {
    return Feed(path, run).read_all();
}

Output::Output(std::string path, std::stop_token stop)
    : path_(std::move(path)), stop_(std::move(stop)) {
    if (const auto standard = standard_descriptor(path_)) {
        descriptor_ = *standard;
        if (path_ == "-") path_ = "stdout";
        return;
    }
    if (path_.empty()) fail(ErrorKind::io, "the output's name is empty; expected a file's name");
    FileRules::require_writable(path_);
    target_ = follow_links(path_);
    struct stat status {};
    const bool there = ::stat(path_.c_str(), &status) == 0;
    if (!there && errno != ENOENT) refuse_file(path_, errno);
    if (there && S_ISDIR(status.st_mode)) refuse_file(path_, EISDIR);
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
    if (descriptor_ < 0) refuse_file(path_, errno);
    owned_ = true;
}

void Output::open_beside(const std::string& target) {
    const auto parent = std::filesystem::path(target).parent_path();
    const std::string folder = parent.empty() ? "." : parent.string();
    struct stat status {};
    if (::stat(folder.c_str(), &status) != 0 && errno == ENOENT)
        fail(ErrorKind::io, "{}: there is no folder {}", path_, shown(folder));
    for (int attempt = 0; descriptor_ < 0; ++attempt) {
        temporary_ = fmt::format("{}/.stipple-{}-{}.part", folder, ::getpid(), attempt);
        descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor_ >= 0 || errno == EEXIST) continue;
        temporary_.clear();
        if (errno == ENOENT) fail(ErrorKind::io, "{}: no file can be made in its folder", path_);
        refuse_file(path_, errno);
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
            refuse_file(path_, errno);
        }
        if (stop_.stop_requested()) fail(ErrorKind::cancelled, "interrupted");
    }
    return !broken_;
}

void Output::close() {
    if (!owned_ || descriptor_ < 0) return;
    const int closed = ::close(descriptor_);
    descriptor_ = -1;
    if (closed != 0) refuse_file(path_, errno);
}

void Output::commit() {
    close();
    if (temporary_.empty()) return;
    if (::rename(temporary_.c_str(), target_.c_str()) != 0) refuse_file(path_, errno);
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
    return read_sets(read_bytes(path, run), path, options, run, format);
}

PointSet read_given(std::string_view option, const std::string& path, const ReadOptions& options,
                    const RunContext& run) {
    if (path == "-")
        fail(ErrorKind::usage, "--{}: standard input cannot be read again; give a file", option);
    std::vector<PointSet> sets = read_points(path, options, run);
    if (sets.size() != 1)
        fail(ErrorKind::input, "{}: {} sets of points; expected one", path, sets.size());
    return std::move(sets.front());
}

}  // namespace stipple::io
