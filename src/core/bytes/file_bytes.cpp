// SPDX-License-Identifier: MIT
#include "core/bytes/file_bytes.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>

#include "core/bytes/fingerprint.hpp"
#include "core/error.hpp"
#include "core/text.hpp"

namespace stipple {
namespace {

constexpr std::uint64_t largest_limit = std::uint64_t{1} << 30;

std::atomic<std::uint64_t>& most_bytes() {
    static std::atomic<std::uint64_t> most = largest_limit;
    return most;
}

std::string file_trouble(int error) {
    switch (error) {
        case ENOENT:
            return "no such file";
        case EISDIR:
            return "is a folder, not a file";
        case EACCES:
        case EPERM:
            return "permission denied";
        case ENOSPC:
            return "no space left on the device";
        case EFBIG:
            return "larger than the limit of files (ulimit -f)";
        case EROFS:
            return "the file system is read-only";
        case ENOMEM:
            return "out of memory";
        case ENOTDIR:
            return "a part of its path is not a folder";
        default:
            return std::generic_category().message(error);
    }
}

}  // namespace

void refuse_file(const std::string& name, int error) {
    const auto kind = error == ENOMEM ? ErrorKind::limit : ErrorKind::io;
    fail(kind, "{}: {}", name, file_trouble(error));
}

std::filesystem::file_status status_of(const std::string& path) {
    std::error_code trouble;
    const auto status = std::filesystem::status(path, trouble);
    if (!status_known(status)) refuse_file(path, trouble.value());
    return status;
}

bool is_pipe(const std::string& path) {
    if (path == "-") return true;
    const auto status = status_of(path);
    return exists(status) && !is_regular_file(status) && !is_directory(status);
}

namespace {

using FilePtr = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

FilePtr open_file(const std::string& path) {
    FilePtr file(std::fopen(FileRules::readable(path).c_str(), "rb"), &std::fclose);
    if (!file) refuse_file(path, errno);
    return file;
}

}  // namespace

std::uint64_t file_fingerprint(const std::string& path, const RunContext& run) {
    const FilePtr file = open_file(path);
    std::array<char, std::size_t{1} << 16> bytes;
    std::optional<std::uint64_t> hash;
    std::size_t got = 0;
    do {
        run.check_stop();
        got = std::fread(bytes.data(), 1, bytes.size(), file.get());
        hash = fingerprint({bytes.data(), got}, hash);
    } while (got == bytes.size());
    if (std::ferror(file.get()) != 0) refuse_file(path, errno);
    return *hash;
}

std::string read_file(const std::string& path) {
    const FilePtr file = open_file(path);
    std::string bytes;
    constexpr std::size_t step = std::size_t{1} << 16;
    for (std::size_t got = step; got == step;) {
        const std::size_t before = bytes.size();
        if (before > most_bytes())
            fail_with_hint(
                ErrorKind::limit,
                most_bytes() < largest_limit
                    ? "set --max-memory to at least three times the file's size, up to 3G"
                    : "",
                "{}: the file is larger than {}, the limit for files that are read at once", path,
                format_bytes(static_cast<double>(most_bytes())));
        if (before + step > bytes.capacity()) bytes.reserve(before + before / 2 + step);
        bytes.resize(before + step);
        got = std::fread(bytes.data() + before, 1, step, file.get());
        bytes.resize(before + got);
    }
    if (std::ferror(file.get()) != 0) refuse_file(path, errno);
    return bytes;
}

void limit_whole_files(std::uint64_t bytes) { most_bytes() = std::min(bytes, largest_limit); }

namespace {

const FileRules* rules = nullptr;  // null: all files are allowed

}  // namespace

FileRules::FileRules(std::map<std::string, std::string> readable, std::vector<std::string> writable)
    : readable_(std::move(readable)), writable_(std::move(writable)) {
    rules = this;
}

FileRules::~FileRules() { rules = nullptr; }

const std::string& FileRules::readable(const std::string& path) {
    if (rules == nullptr) return path;
    const auto it = rules->readable_.find(path);
    if (it == rules->readable_.end())
        fail_with_hint(ErrorKind::usage, "--input FILE allows reading a file",
                       "it names the file {}, which may only be read if --input allows it",
                       shown(path));
    return it->second;
}

void FileRules::require_writable(const std::string& path) {
    if (rules == nullptr || std::ranges::find(rules->writable_, path) != rules->writable_.end())
        return;
    fail(ErrorKind::usage,
         "it names the file {}, which may not be written; only the file of --output may",
         shown(path));
}

}  // namespace stipple
