// SPDX-License-Identifier: MIT
#include "io/feed.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "core/bytes/file_bytes.hpp"
#include "core/error.hpp"
#include "io/source_text.hpp"

namespace stipple::io {
namespace {

/// Waits until data or the end of input is available.
void wait_for_bytes(int descriptor, const RunContext& run) {
    constexpr int patience = 50;  // milliseconds between checks of the stop token
    pollfd waiting{.fd = descriptor, .events = POLLIN, .revents = 0};
    for (int ready = 0; ready == 0;) {
        run.check_stop();
        ready = ::poll(&waiting, 1, patience);
        if (ready < 0 && errno == EINTR) ready = 0;
    }
}

std::int64_t change_time(const struct stat& status) {
#ifdef __APPLE__
    const timespec& time = status.st_mtimespec;
#else
    const timespec& time = status.st_mtim;
#endif
    return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

}  // namespace

Feed::Feed(const std::string& path, RunContext run)
    : name_(source_name(path)), run_(std::move(run)) {
    // Without O_NONBLOCK, opening a named pipe could block uninterruptibly.
    file_.descriptor =
        path == "-" ? STDIN_FILENO
                    : ::open(FileRules::readable(path).c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    struct stat status {};
    if (file_.descriptor < 0 || ::fstat(file_.descriptor, &status) != 0) refuse_file(name_, errno);
    if (S_ISDIR(status.st_mode)) refuse_file(name_, EISDIR);
#ifdef F_SETPIPE_SZ
    // Enlarges the pipe to hold a writer's whole block, so that both sides can work at the same
    // time.
    if (S_ISFIFO(status.st_mode)) ::fcntl(file_.descriptor, F_SETPIPE_SZ, 1 << 20);
#endif
    if (S_ISREG(status.st_mode)) size_ = static_cast<std::size_t>(status.st_size);
    changed_at_ = change_time(status);
    held_.resize(front_size);
    held_.resize(fetch(held_));
    if (const auto kind = compression_of_bytes(held_); kind != Compression::none) decompress(kind);
    front_ = held_;
}

void Feed::decompress(Compression kind) {
    raw_ = std::move(held_);
    const auto refill = [this, first = true]() mutable -> std::string_view {
        if (!std::exchange(first, false)) {
            raw_.resize(std::size_t{1} << 16);
            raw_.resize(fetch_raw(raw_));
        }
        return raw_;
    };
    decompressor_.emplace(kind, refill, name_);
    held_.resize(front_size);
    held_.resize(fetch(held_));
}

Feed::File::~File() {
    if (descriptor > STDERR_FILENO) ::close(descriptor);
}

std::size_t Feed::fetch(std::span<char> bytes) {
    return decompressor_ ? decompressor_->read(bytes) : fetch_raw(bytes);
}

std::size_t Feed::fetch_raw(std::span<char> bytes) {
    std::size_t done = 0;
    while (file_.descriptor >= 0 && done < bytes.size()) {
        wait_for_bytes(file_.descriptor, run_);
        const auto got = ::read(file_.descriptor, bytes.data() + done, bytes.size() - done);
        if (got == 0) {
            check_unchanged();
            break;
        }
        if (got > 0)
            done += static_cast<std::size_t>(got);
        else if (errno != EINTR && errno != EAGAIN)
            refuse_file(name_, errno);
    }
    return done;
}

void Feed::check_unchanged() const {
    struct stat status {};
    if (::fstat(file_.descriptor, &status) != 0 || !S_ISREG(status.st_mode)) return;
    if (static_cast<std::size_t>(status.st_size) != size_ || change_time(status) != changed_at_)
        fail(ErrorKind::io, "{}: the file changed while it was read", name_);
}

std::size_t Feed::read(std::span<char> bytes) {
    const std::size_t held = std::min(front_.size() - taken_, bytes.size());
    std::copy_n(front_.begin() + static_cast<std::ptrdiff_t>(taken_), held, bytes.begin());
    taken_ += held;
    return held == bytes.size() ? held : held + fetch(bytes.subspan(held));
}

std::optional<std::uint64_t> Feed::skip(std::uint64_t count) {
    struct stat status {};
    if (decompressor_ || ::fstat(file_.descriptor, &status) != 0 || !S_ISREG(status.st_mode))
        return std::nullopt;
    const auto ahead = std::min<std::uint64_t>(count, front_.size() - taken_);
    const auto at = ::lseek(file_.descriptor, 0, SEEK_CUR);
    if (at < 0) return std::nullopt;
    const auto left = static_cast<std::uint64_t>(std::max<off_t>(0, status.st_size - at));
    const auto behind = std::min(count - ahead, left);
    if (behind > 0 && ::lseek(file_.descriptor, static_cast<off_t>(behind), SEEK_CUR) < 0)
        return std::nullopt;
    taken_ += static_cast<std::size_t>(ahead);
    return ahead + behind;
}

std::string Feed::read_all() {
    std::string bytes(front_.substr(taken_));
    taken_ = front_.size();
    if (ends_in_front()) return bytes;
    // One byte more than the file's size, so that a short read shows its end.
    std::size_t room = size_ > bytes.size() ? size_ + 1 : bytes.size() + front_size;
    constexpr std::size_t step = std::size_t{4} << 20;  // bytes between checks of the stop token
    for (;; room = 2 * bytes.size()) {
        run_.need_memory(static_cast<double>(room), "the content of " + name_);
        bytes.reserve(room);
        while (bytes.size() < room) {
            const std::size_t before = bytes.size();
            const std::size_t wanted = std::min(step, room - before);
            bytes.resize(before + wanted);
            const std::size_t got = fetch(std::span(bytes).subspan(before));
            bytes.resize(before + got);
            if (got < wanted) return bytes;
        }
    }
}

}  // namespace stipple::io
