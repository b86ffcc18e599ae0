// SPDX-License-Identifier: MIT
//
// The output of a study: rows in the order of the units, whatever order they are done in, and
// nothing of what is done lost when the program ends in the middle.
//
// Units that are next in order are written to the table at once. Those that come early wait in a
// journal beside it, FILE.journal, which is there as long as the study is not finished:
//
//     {"format":"stipple.study-journal","version":2,"study":...,"settings":{...}}
//     FIRST-UNIT BYTES-OF-ITS-LINES BYTES-OF-THE-NEXT-UNIT'S...
//     the lines of these units
//     ...
//
// After a crash the journal is cut back to its last whole entry, and the table to the last unit
// that another one follows: its last unit may lack rows, and is done again. A table without a
// journal is finished when its last unit has the results of the unit before it of the same measure.
//
// Beware   standard output, pipes and devices have no journal: rows wait in memory.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/json.hpp"
#include "io/output.hpp"
#include "study/study_table.hpp"
#include "study/sweep.hpp"
#include "study/unit_runner.hpp"

namespace stipple {

/// The file beside a study's table that is there until it is finished.
std::string journal_of(const std::string& table);

class StudyFile {
  public:
    using Listener = std::function<void(const StudyRow&)>;

    /// What to do with a study that the file holds: refuse it, go on with it, or replace it.
    enum class Start { fresh, resume, anew };

    /// @param listener called with each row of the study in order, also those found in the file
    /// @throws Error: the file is there and no study's, or is a study's and nobody said what to do
    /// with it, or is another one's than what is to be resumed; Error(io), Error(cancelled).
    StudyFile(std::string path, const Sweep& sweep, const StudyTable& table, Start start,
              Listener listener, const RunContext& run);

    StudyFile(const StudyFile&) = delete;
    StudyFile& operator=(const StudyFile&) = delete;
    ~StudyFile();

    /// Units that need not be done.
    [[nodiscard]] std::vector<UnitRange> done() const;
    [[nodiscard]] std::uint64_t units_written() const { return next_; }
    /// Whether rows go to standard output, a pipe or a device.
    [[nodiscard]] bool is_stream() const { return stream_.has_value(); }
    [[nodiscard]] bool has_journal() const { return journal_ >= 0; }

    /// Takes units that were done. False: the pipe was closed, and nobody wants more.
    /// @throws Error(io)
    bool put(const Segment& segment);

    /// Adds text behind the rows, once all units are there, and takes the journal away.
    bool finish(const std::string& more = {});

    /// Has what was taken put on the disk itself; may be called beside put().
    void sync();

  private:
    /// Units that wait for their turn.
    struct Waiting {
        std::vector<std::uint64_t> bytes = {};  ///< of each unit
        std::uint64_t offset = 0;               ///< in the journal
        std::string text = {};                  ///< where there is none

        /// Bytes of the first units.
        [[nodiscard]] std::uint64_t size(std::size_t units = ~std::size_t{0}) const;
    };

    void open_file(Start start, const RunContext& run);
    void open_journal();
    void begin_journal();
    void read_journal();
    class Lines;
    class RowReader;
    /// The head of a journal, which stays in `line`; null where it is none.
    static Json head_of_journal(Lines& lines, std::string& line);
    bool read_entry(Lines& lines);
    void read_rows(const RunContext& run);
    /// The finished study of which the rows are that are there, if this one has all that it has, and
    /// more; nothing where they are this one's. @throws Error(input) where they are another's
    [[nodiscard]] std::optional<Sweep> smaller_study(const RunContext& run) const;
    void take_over(const Sweep& smaller, const RunContext& run);
    void keep(const Segment& segment, bool in_journal);
    [[noreturn]] void refuse_other() const;
    bool write_waiting();
    bool write(const std::string& text);
    [[nodiscard]] std::string text_of(const Waiting& waiting) const;

    std::string path_;
    const Sweep& sweep_;
    const StudyTable& table_;
    Listener listener_;
    int output_ = -1;
    int journal_ = -1;
    std::atomic<bool> dirty_ = false;   ///< something was written since the last sync
    std::atomic<int> lost_ = 0;         ///< why what was written did not get to the disk; 0: it did
    bool broken_ = false;               ///< a write failed: nothing may be written behind the gap
    std::optional<io::Output> stream_;  ///< in place of a file: standard output, a pipe, a device
    std::uint64_t journal_size_ = 0;
    std::uint64_t next_ = 0;  ///< unit whose rows come next
    std::map<std::uint64_t, Waiting> waiting_;
};

}  // namespace stipple
