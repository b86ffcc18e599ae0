// SPDX-License-Identifier: MIT
//
// Runs the stipple program, or a shell command that uses it, and captures all output.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace stipple::testing {

/// Shell command that waits until a process handles SIGINT (bit 1 of its caught signals).
inline std::string caught(const std::string& pid) {
    return "until grep -Eq '^SigCgt:.*[2367abef]$' /proc/" + pid + "/status; do sleep 0.01; done; ";
}

struct Outcome {
    int code = 0;  ///< exit code; 128 + signal if killed
    std::string out;
    std::string err;
};

/// Temporary directory of a test, the working directory of its commands.
class Sandbox {
  public:
    Sandbox();
    Sandbox(const Sandbox&) = delete;
    Sandbox& operator=(const Sandbox&) = delete;
    ~Sandbox();

    /// Runs `stipple ARGS...` with the given standard input.
    [[nodiscard]] Outcome run(std::vector<std::string> arguments,
                              const std::string& input = {}) const;

    /// Runs a line of bash in which `stipple` is the program, with pipefail.
    [[nodiscard]] Outcome shell(const std::string& line, const std::string& input = {}) const;

    void write(const std::string& name, const std::string& bytes) const;
    [[nodiscard]] std::string read(const std::string& name) const;
    [[nodiscard]] bool exists(const std::string& name) const;

    /// Names of the directory's entries, sorted.
    [[nodiscard]] std::vector<std::string> files() const;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

/// Standard output of a run; expects success and no output to stderr.
std::string good(const Outcome& outcome);

/// Expects a run to fail: with this exit code, no output, and one line of error that contains
/// `words` and starts with the program's name.
void expect_refusal(const Outcome& outcome, int code, const std::string& words,
                    const std::string& program = "stipple");

}  // namespace stipple::testing
