// SPDX-License-Identifier: MIT
//
// One program for all targets: runs the target that STIPPLE_FUZZ names, or without it lists all.
//
// The project is compiled with GCC, which calls a function at every edge of the control flow, while
// Clang counts inline. These calls are counted here in a table that libFuzzer reads, indexed by the
// edges' addresses.
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <stdexcept>
#include <stop_token>
#include <thread>

#include "core/bytes/file_bytes.hpp"
#include "fuzz.hpp"

#define UNCOUNTED __attribute__((no_sanitize_coverage, no_sanitize("address", "undefined")))

namespace {

constexpr std::size_t counter_count = std::size_t{1} << 16;
__attribute__((section("__libfuzzer_extra_counters"), used)) unsigned char counters[counter_count];

}  // namespace

extern "C" {

UNCOUNTED void __wrap___sanitizer_cov_trace_pc() {
    const auto at = reinterpret_cast<std::uintptr_t>(__builtin_return_address(0));
    unsigned char& counter = counters[(at >> 16 ^ at) % counter_count];
    counter = static_cast<unsigned char>(counter + (counter < 255));
}

// Comparisons of floating-point numbers, which libFuzzer does not use.
UNCOUNTED void __sanitizer_cov_trace_cmpf(float, float) {}
UNCOUNTED void __sanitizer_cov_trace_cmpd(double, double) {}

}  // extern "C"

namespace stipple::fuzz {

namespace {

/// Requests a stop some time after an input begins, so that expensive requests are not reported as
/// hangs.
class Deadline {
  public:
    Deadline() {
        std::thread([this] {
            for (;; std::this_thread::sleep_for(std::chrono::milliseconds(20))) {
                const std::lock_guard lock(mutex_);
                if (age_++ >= 5) source_.request_stop();
            }
        }).detach();
    }

    void begin() {
        const std::lock_guard lock(mutex_);
        age_ = 0;
        if (source_.stop_requested()) source_ = {};
    }

    std::stop_token token() { return source_.get_token(); }

  private:
    std::mutex mutex_;
    std::stop_source source_;
    int age_ = 0;
};

Deadline& deadline() {
    static auto* const one = new Deadline;
    return *one;
}

}  // namespace

RunContext small_run() {
    return {.threads = 1, .stop = deadline().token(), .max_memory = std::uint64_t{32} << 20};
}

void require(bool holds, const std::string& what) {
    if (!holds) throw std::logic_error(what);
}

const std::string& as_file(std::string_view bytes) {
    static const int file = memfd_create("input", 0);
    static const std::string name = "/proc/self/fd/" + std::to_string(file);
    const bool written = ftruncate(file, 0) == 0 && pwrite(file, bytes.data(), bytes.size(), 0) ==
                                                        static_cast<ssize_t>(bytes.size());
    require(written, "no file in memory");
    return name;
}

namespace {

std::vector<Target> all_targets() {
    std::vector<Target> all;
    for (const auto& some :
         {point_targets(), file_targets(), text_targets(), comparison_targets(), command_targets()})
        all.insert(all.end(), some.begin(), some.end());
    return all;
}

Target named_target() {
    const char* const name = std::getenv("STIPPLE_FUZZ");
    const std::vector<Target> all = all_targets();
    for (const Target& target : all)
        if (name && target.name == name) return target;
    for (const Target& target : all) std::puts(target.name.c_str());
    std::exit(name ? 2 : 0);
}

const Target& chosen() {
    static const Target target = named_target();
    return target;
}

}  // namespace
}  // namespace stipple::fuzz

extern "C" int LLVMFuzzerInitialize(int*, char***);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size);

extern "C" int LLVMFuzzerInitialize(int*, char***) {
    stipple::fuzz::chosen();
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace stipple;
    static const std::string& file = fuzz::as_file({});
    limit_whole_files(std::uint64_t{32} << 20);
    fuzz::deadline().begin();
    try {
        // Inputs may name any files; only the file that holds the input itself can be opened.
        const FileRules rules({{file, file}}, {"/dev/null", "-"});
        fuzz::chosen().work({reinterpret_cast<const char*>(bytes), size});
    } catch (const Error&) {  // rejected
    } catch (const std::exception& error) {
        std::fprintf(stderr, "\ndefect: %s\n", error.what());
        std::abort();
    }
    return 0;
}
