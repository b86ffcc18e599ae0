// SPDX-License-Identifier: MIT
//
// Runs the stipple program, or a shell line that uses it, and keeps all that comes out.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace stipple::testing {

/// Shell words that wait until a process handles an interrupt (bit 1 of its caught signals).
inline std::string caught(const std::string& pid) {
    return "until grep -Eq '^SigCgt:.*[2367abef]$' /proc/" + pid + "/status; do sleep 0.01; done; ";
}

struct Outcome {
    int code = 0;  ///< exit code; 128 + signal if it was killed
    std::string out;
    std::string err;
};

/// A directory of its own for a test, removed at the end; the working directory of its commands.
class Sandbox {
  public:
    Sandbox();
    Sandbox(const Sandbox&) = delete;
    Sandbox& operator=(const Sandbox&) = delete;
    ~Sandbox();

    /// Runs `stipple ARGS...` with the given standard input.
    [[nodiscard]] Outcome run(std::vector<std::string> arguments,
                              const std::string& input = {}) const;

    /// Runs a line of bash in which `stipple` is the program; with pipefail.
    [[nodiscard]] Outcome shell(const std::string& line, const std::string& input = {}) const;

    void write(const std::string& name, const std::string& bytes) const;
    [[nodiscard]] std::string read(const std::string& name) const;
    [[nodiscard]] bool exists(const std::string& name) const;

    /// Names of what is in the directory, sorted.
    [[nodiscard]] std::vector<std::string> files() const;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

/// The standard output of a run that must go well, and say nothing besides.
std::string good(const Outcome& outcome);

/// Expects of a run that it refuses: with this exit code and one line of error with these words,
/// that starts with the program's name; and no output.
void expect_refusal(const Outcome& outcome, int code, const std::string& words,
                    const std::string& program = "stipple");

}  // namespace stipple::testing
