// SPDX-License-Identifier: MIT
//
// Output of a study. Units, each with the results of one measure for one set, are appended to the
// table as they are finished, in any order. When all are present, the table is rewritten in the
// order of the study. Until then, FILE.journal names the study, and is locked by its process:
//
//     {"format":"stipple.study-journal","version":3,"study":...,"settings":{...}}
//
// The ordered rows are written into the journal, which is then renamed to the table: after a crash,
// either the old table or the new one is complete.
//
// Resuming   If a table has a journal, its units are in any order; otherwise they are in order,
//            without gaps. The last unit may lack rows: it is run again unless it has the keys of
//            the preceding unit of the same measure and, if the last key is a list's, the same
//            generator, n and d. Text after the last complete row of an unfinished table is cut
//            off; other damage is an error. If the study extends a finished smaller one, rows of
//            the latter come first, and get the new fingerprint when the table is rewritten.
// Beware     standard output, pipes and devices get rows in order: early rows wait in memory.
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

/// Warns if the table has a journal, that is, if its study is not finished.
void note_unfinished(const std::string& table, const RunContext& run);

/// Summary of the units that failed.
struct StudyFailures {
    std::uint64_t units = 0;
    std::uint64_t first_unit = 0;
    StudyRow first = {};     ///< row of the first unit that failed
    bool met_limit = false;  ///< whether a unit exceeded a limit of memory or time
};

class StudyFile {
  public:
    using Listener = std::function<void(const StudyRow&)>;

    /// Action if the file holds a study: throw an error, resume it, or replace it.
    enum class Start { fresh, resume, anew };

    /// @param listener called with every row in the order of the study, including rows found in the
    /// file; may be empty
    /// @throws Error(input) if the file is not a study's table, or holds another study than the one
    /// to be resumed; Error(usage) if it holds a study and `start` is fresh, or if a stream is to
    /// be resumed; Error(io), Error(cancelled)
    StudyFile(std::string path, const Sweep& sweep, const StudyTable& table, Start start,
              Listener listener, const RunContext& run);

    StudyFile(const StudyFile&) = delete;
    StudyFile& operator=(const StudyFile&) = delete;
    ~StudyFile();

    /// Ranges of the units in the file, in order.
    [[nodiscard]] std::vector<UnitRange> done() const;
    [[nodiscard]] std::uint64_t units_written() const { return written_; }
    [[nodiscard]] const StudyFailures& failures() const { return failures_; }
    /// Whether rows go to standard output, a pipe or a device.
    [[nodiscard]] bool is_stream() const { return stream_.has_value(); }
    [[nodiscard]] bool has_journal() const { return journal_ >= 0; }

    /// Writes units; safe to call from several threads. Returns false if the reader of the pipe has
    /// closed it. @throws Error(io), now and in all later calls
    bool put(const Segment& segment);

    /// Flushes new rows to the disk; safe to call while another thread calls put().
    void sync();

    /// Passes the rows of a file to the listener, after all units have been put. Does nothing for a
    /// stream, whose rows were passed when they were written. @throws Error(cancelled), Error(io)
    void listen(const RunContext& run) const;

    /// For a file: sorts its rows and removes its journal. For a stream: appends the text `more`.
    /// @throws Error(cancelled), Error(io)
    void finish(const std::string& more, const RunContext& run);

  private:
    /// Consecutive units whose rows follow each other in the table, in the order of the units.
    struct Stored {
        std::uint64_t last = 0;  ///< index after the last unit
        std::uint64_t offset = 0;
        std::uint64_t bytes = 0;
    };
    class TableReader;

    void open_file(Start start, const RunContext& run);
    void begin_table();
    void lock_journal();
    [[nodiscard]] bool journal_is_ours() const;
    void begin_journal();
    [[nodiscard]] std::optional<Sweep> smaller_study(const RunContext& run) const;
    [[noreturn]] void refuse_other(std::string differs = {}) const;
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
    std::optional<io::Output> stream_;  ///< standard output, a pipe or a device; empty: a file
    int output_ = -1;
    int journal_ = -1;
    std::mutex mutex_;                          // guards the members down to failures_
    std::map<std::uint64_t, Stored> index_;     ///< ranges of stored units, by their first unit
    std::map<std::uint64_t, Segment> waiting_;  ///< early segments of a stream, by first unit
    std::uint64_t head_size_ = 0;               ///< bytes above the rows
    std::size_t head_lines_ = 0;                ///< lines above the rows
    std::uint64_t size_ = 0;                    ///< bytes of the table
    std::uint64_t written_ = 0;                 ///< number of units in the file
    bool mixed_ = false;         ///< whether some rows have the fingerprint of a smaller study
    std::exception_ptr broken_;  ///< error of a failed write; later calls of put() throw it again
    StudyFailures failures_;
    bool journal_synced_ = false;
    std::atomic<bool> dirty_ = false;  ///< whether rows were written since the last sync
    std::atomic<int> lost_ = 0;        ///< errno of a failed sync; 0: none failed
};

}  // namespace stipple
