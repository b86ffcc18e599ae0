// SPDX-License-Identifier: MIT
#include "core/bytes/spool.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

#include "core/bytes/file_bytes.hpp"
#include "core/error.hpp"

namespace stipple {
namespace {

/// Whether opening /dev/fd/N opens the file anew from its first byte, instead of duplicating
/// descriptor N.
#ifdef __linux__
constexpr bool reopens = true;
#else
constexpr bool reopens = false;
#endif

}  // namespace

Spool::Spool(Buffered buffered) : buffered_(buffered == Buffered::yes) {
    std::error_code none;
    folder_ = std::filesystem::temp_directory_path(none).string();
    if (none) folder_ = "/tmp";
    std::string name = folder_ + "/stipple-XXXXXX";
    const int descriptor = ::mkostemp(name.data(), O_CLOEXEC);
    if (descriptor < 0) refuse();
    if (reopens)
        ::unlink(name.c_str());
    else
        name_ = name;
    file_.reset(::fdopen(descriptor, "w+"));
    if (file_ == nullptr) refuse();
}

Spool::~Spool() {
    if (!name_.empty()) ::unlink(name_.c_str());
}

void Spool::write(std::string_view bytes) {
    if (buffered_ && std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size())
        refuse();
    while (!buffered_ && !bytes.empty()) {
        const auto written = ::write(::fileno(file_.get()), bytes.data(), bytes.size());
        if (written < 0 && errno != EINTR) refuse();
        if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
    }
}

void Spool::rewind() {
    if (buffered_ && std::fflush(file_.get()) != 0) refuse();
    std::rewind(file_.get());
}

std::size_t Spool::read(std::span<char> bytes) {
    const std::size_t got = std::fread(bytes.data(), 1, bytes.size(), file_.get());
    if (std::ferror(file_.get()) != 0) refuse();
    return got;
}

std::string Spool::path() const {
    return reopens ? fmt::format("/dev/fd/{}", ::fileno(file_.get())) : name_;
}

void Spool::refuse() const { refuse_file("a temporary file in " + folder_, errno); }

}  // namespace stipple
