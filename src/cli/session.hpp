// SPDX-License-Identifier: MIT
//
// One run of the program: threads, seed, memory limit, progress bar, warnings, Ctrl-C.
#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include "cli/parsing/arguments.hpp"
#include "stipple/run.hpp"

namespace stipple::cli {

/// Progress bar on stderr: "[####      ]  41 %  3 s left", with a note in place of the time if
/// there is one.
class ProgressBar {
  public:
    explicit ProgressBar(ProgressMode mode);
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;
    ~ProgressBar() { clear(); }

    void show(double fraction);
    /// Sets the note that is shown in place of the time left.
    void note(const std::string& words) { words_ = words; }
    void clear();

  private:
    using Clock = std::chrono::steady_clock;
    bool wanted_;
    Clock::duration patience_;
    Clock::time_point start_ = Clock::now();
    Clock::time_point shown_ = {};
    std::string words_;
    bool visible_ = false;
};

class Session {
  public:
    explicit Session(const Request& request);
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    [[nodiscard]] const RunContext& run() const { return run_; }

    /// Prints a note to stderr, unless --quiet. Notes are delayed until the work is done or 100
    /// have collected, so that an error is usually printed without notes.
    void warn(const std::string& sentence);

    /// Like warn(), without "note: ": for messages that an option asks for.
    void tell(const std::string& sentence);

    /// Prints the delayed notes.
    void tell_warnings();

  private:
    RunContext run_;
    std::vector<std::string> warnings_;
    bool quiet_;
    ProgressBar bar_;
};

/// Prints text to stderr; ignores a closed or full stderr.
void say(std::string_view text);

/// Prints "stipple: SENTENCE" to stderr, escaped and truncated.
void say_line(std::string_view sentence);

/// Stops the runs of all sessions, like Ctrl-C.
void request_stop();

/// Makes Ctrl-C, SIGTERM and SIGHUP stop a Session's run; a second one ends the program
/// immediately.
void catch_interrupts();

}  // namespace stipple::cli
