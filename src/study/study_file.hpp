// SPDX-License-Identifier: MIT
//
// The output of a study. Units are appended to the table as they are measured, in any order. When
// all are there, the table is rewritten in the order of the study. Until then it has a file
// FILE.journal beside it, which names the study and is locked by the process that works on it:
//
//     {"format":"stipple.study-journal","version":3,"study":...,"settings":{...}}
//
// The ordered rows are written into the journal, which is then renamed to the table: a crash leaves
// the one or the other.
//
// Resuming   A table with a journal has its units in any order; one without has them in order, up to
//            its end. Its last unit may lack rows: unless it has the keys of an earlier unit of the
//            same measure, it is measured again. Behind the last row of an unfinished table may be
//            anything, which is cut off; what is damaged anywhere else is refused.
//            The rows of a finished smaller study stay in front, and get the fingerprint of this one
//            when the table is rewritten.
// Beware     standard output, pipes and devices get rows in order: those that come early wait in
//            memory.
#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "io/output.hpp"
#include "study/study_table.hpp"
#include "study/sweep.hpp"

namespace stipple {

/// The file beside a study's table that is there until the study is finished.
std::string journal_of(const std::string& table);

/// Units without a result.
struct StudyFailures {
    std::uint64_t units = 0;
    std::uint64_t first_unit = 0;
    StudyRow first = {};     ///< row of that unit
    bool met_limit = false;  ///< of memory or time, at least once
};

class StudyFile {
  public:
    using Listener = std::function<void(const StudyRow&)>;

    /// What to do with a study that the file holds: refuse it, go on with it, or replace it.
    enum class Start { fresh, resume, anew };

    /// @param listener called with every row in the order of the study, including rows found in the
    /// file; may be empty
    /// @throws Error: the file exists and is no study's table, holds a study without being asked to
    /// resume or replace it, or holds another study than the one to be resumed; Error(io),
    /// Error(cancelled).
    StudyFile(std::string path, const Sweep& sweep, const StudyTable& table, Start start,
              Listener listener, const RunContext& run);

    StudyFile(const StudyFile&) = delete;
    StudyFile& operator=(const StudyFile&) = delete;
    ~StudyFile();

    /// Units that the file has, in order.
    [[nodiscard]] std::vector<UnitRange> done() const;
    [[nodiscard]] std::uint64_t units_written() const { return written_; }
    [[nodiscard]] const StudyFailures& failures() const { return failures_; }
    /// Whether rows go to standard output, a pipe or a device.
    [[nodiscard]] bool is_stream() const { return stream_.has_value(); }
    [[nodiscard]] bool has_journal() const { return journal_ >= 0; }

    /// Writes units; any thread may call it. False: the reader of the pipe has closed it.
    /// @throws Error(io), now and in all later calls
    bool put(const Segment& segment);

    /// Writes new rows to the disk itself; may be called beside put().
    void sync();

    /// Passes the rows of a file to the listener; all units have been put. A stream has done so.
    /// @throws Error(cancelled), Error(io)
    void listen(const RunContext& run) const;

    /// Puts the rows of a file in order and removes its journal; adds the text to a stream.
    /// @throws Error(cancelled), Error(io)
    void finish(const std::string& more, const RunContext& run);

  private:
    /// Units that are together in the table, in order.
    struct Stored {
        std::uint64_t last = 0;  ///< behind the last one
        std::uint64_t offset = 0;
        std::uint64_t bytes = 0;
    };
    class TableReader;

    void open_file(Start start, const RunContext& run);
    void lock_journal();
    [[nodiscard]] bool journal_is_ours() const;
    void begin_journal();
    [[nodiscard]] std::optional<Sweep> smaller_study(const RunContext& run) const;
    [[noreturn]] void refuse_other() const;
    [[nodiscard]] bool has(std::uint64_t unit) const;
    void store(UnitRange units, std::uint64_t offset, std::uint64_t bytes);
    void note_failure(std::uint64_t unit, const StudyRow& row);
    bool put_in_turn(const Segment& segment);
    void for_each_line(const std::function<void(const std::string&)>& visit,
                       const RunContext& run) const;
    [[nodiscard]] std::string renamed(const std::string& line) const;
    void rewrite(const RunContext& run);

    std::string path_;
    const Sweep& sweep_;
    const StudyTable& table_;
    Listener listener_;
    std::optional<io::Output> stream_;  ///< instead of a file: standard output, a pipe, a device
    int output_ = -1;
    int journal_ = -1;
    std::mutex mutex_;                          // of all below
    std::map<std::uint64_t, Stored> index_;     ///< by the first unit
    std::map<std::uint64_t, Segment> waiting_;  ///< for their turn in a stream
    std::uint64_t size_ = 0;                    ///< of the table, in bytes
    std::uint64_t written_ = 0;                 ///< units
    bool mixed_ = false;         ///< some rows have the fingerprint of a smaller study
    std::exception_ptr broken_;  ///< a write failed: nothing may be written behind the gap
    StudyFailures failures_;
    bool journal_synced_ = false;
    std::atomic<bool> dirty_ = false;  ///< something was written since the last sync
    std::atomic<int> lost_ = 0;        ///< errno of a sync that failed
};

}  // namespace stipple
