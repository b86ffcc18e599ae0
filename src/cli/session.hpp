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

/// A bar on stderr: "[####      ]  41 %  3 s left", or a note in place of the time.
class ProgressBar {
  public:
    enum class Mode { automatic, always, never };

    explicit ProgressBar(Mode mode);
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;
    ~ProgressBar() { clear(); }

    void show(double fraction);
    /// Words to stand in place of the time left when the bar is shown next.
    void note(const std::string& words) { words_ = words; }
    /// Takes the bar off the line.
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
    explicit Session(const Arguments& arguments);
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    [[nodiscard]] const RunContext& run() const { return run_; }

    /// A note on stderr, unless --quiet. It is said when the work is done, or takes long: an error says
    /// alone what is wrong.
    void warn(const std::string& sentence);

    /// The same for what was asked for.
    void tell(const std::string& sentence);

    /// Says what there is to say.
    void tell_warnings();

  private:
    RunContext run_;
    std::vector<std::string> warnings_;
    bool quiet_;
    ProgressBar bar_;
};

/// Text on stderr; a closed or full stderr is no error.
void say(std::string_view text);

/// A line "stipple: SENTENCE" on stderr, whoever's words are in it.
void say_line(std::string_view sentence);

/// Stops the runs of all sessions, as Ctrl-C does.
void request_stop();

/// From now on Ctrl-C, SIGTERM and SIGHUP stop a Session's run; a second one ends the program at once.
void catch_interrupts();

}  // namespace stipple::cli
