// SPDX-License-Identifier: MIT
#include "study/study_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/bytes/file_bytes.hpp"
#include "core/error.hpp"
#include "core/json.hpp"
#include "core/text.hpp"

namespace stipple {
namespace {

constexpr const char* journal_format = "stipple.study-journal";

std::string folder_of(const std::string& path) {
    const auto slash = path.rfind('/');
    return slash == std::string::npos ? "." : path.substr(0, slash + 1);
}

/// Returns the path, or the target if it is a link.
std::string real_file(const std::string& path) {
    std::error_code none;
    const bool link = std::filesystem::is_symlink(path, none);
    const auto target = link ? std::filesystem::canonical(path, none) : std::filesystem::path();
    return target.empty() ? path : target.string();
}

[[noreturn]] void refuse(const std::string& path) {
    if (errno == ENOENT)
        fail(ErrorKind::io, "{}: {}", path,
             exists(status_of(folder_of(path))) ? "no file can be made in its folder"
                                                : "no such folder");
    refuse_file(path, errno);
}

int opened(const std::string& path) {
    const int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (descriptor < 0) refuse(path);
    return descriptor;
}

/// Writes all bytes; continues if a signal interrupts a write.
void write_all(int descriptor, std::string_view bytes, const std::string& path) {
    while (!bytes.empty()) {
        const auto written = ::write(descriptor, bytes.data(), bytes.size());
        if (written < 0 && errno != EINTR) refuse(path);
        if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
    }
}

void cut_to(int descriptor, std::uint64_t size, const std::string& path) {
    if (::ftruncate(descriptor, static_cast<off_t>(size)) != 0) refuse(path);
}

/// Whether an fsync() with this result succeeded. File systems that cannot synchronise report so,
/// which counts as success.
bool is_synchronised(int result) { return result == 0 || errno == EINVAL || errno == ENOTSUP; }

/// Flushes a new file and its entry in the folder to the disk. Returns false if this fails, with
/// the reason in errno.
bool synchronise_new(int descriptor, const std::string& path) {
    if (!is_synchronised(::fsync(descriptor))) return false;
    const int folder = ::open(folder_of(path).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const bool done = folder >= 0 && is_synchronised(::fsync(folder));
    const int error = errno;
    if (folder >= 0) ::close(folder);
    errno = error;
    return done;
}

/// Reads a file line by line; a missing file is empty. A read error throws instead of ending the
/// file.
class Lines {
  public:
    explicit Lines(const std::string& path) : path_(path), in_(path, std::ios::binary) {
        if (!in_.is_open() && errno != ENOENT) refuse_file(path_, errno);
    }

    /// Reads the next line. Returns false at the end of the file; `line` is then the rest without a
    /// line break, often empty.
    bool take(std::string& line) {
        const bool whole = std::getline(in_, line) && !in_.eof();
        if (in_.bad()) refuse_file(path_, errno);
        return whole;
    }

    void seek(std::uint64_t offset) { in_.seekg(static_cast<std::streamoff>(offset)); }

  private:
    std::string path_;
    std::ifstream in_;
};

std::string journal_of(const std::string& table) { return real_file(table) + ".journal"; }

/// Describes the first setting that differs in the file; empty if there is none.
std::string difference(const Json& file, const Sweep& ours) {
    for (const auto& [name, value] : ours.settings())
        if (const Json other = file.value(name, Json()); other.is_string() && other != value)
            return fmt::format(": it has {} '{}', this one '{}'", name, other.get<std::string>(),
                               value);
    return {};
}

Json json_of_settings(const Sweep& sweep) {
    Json settings = Json::object();
    for (const auto& [name, value] : sweep.settings()) settings[name] = value;
    return settings;
}

/// Describes a differing setting that rows do not show (keys, curves, time limit), for a table
/// without a journal: tries settings of `ours` and a few others until the fingerprint agrees.
/// @param ours the study of the rows, with those settings as requested now
/// @param keys the distinct keys of the rows, or 100 of them
std::string hidden_difference(const Sweep& ours, const std::string& fingerprint,
                              const std::vector<std::string>& keys) {
    for (const auto& kept : {ours.request().keys, {}, keys})
        for (const bool curves : {ours.request().curves, !ours.request().curves})
            for (const auto limit : {ours.request().time_limit, std::optional<double>()}) {
                SweepRequest request = ours.request();
                request.keys = kept;
                request.curves = curves;
                request.time_limit = limit;
                try {
                    const Sweep theirs(std::move(request));
                    if (theirs.fingerprint() == fingerprint)
                        return difference(json_of_settings(theirs), ours);
                } catch (const Error&) {  // no study has these keys
                }
            }
    return ": of other keys, another time-limit or version of stipple, which rows do not show";
}

/// Returns the first line of a table's journal; null if it is missing or is not that of a journal.
Json head_of_journal(const std::string& table) {
    std::string line;
    Json head = Lines(journal_of(table)).take(line) ? try_parse_json(line) : Json();
    const bool known =
        head.is_object() && head.contains("study") && head["settings"].is_object() &&
        line.starts_with(fmt::format("{{\"format\":\"{}\",\"version\":3,", journal_format));
    return known ? head : Json();
}

}  // namespace

void note_unfinished(const std::string& table, const RunContext& run) {
    std::error_code none;
    if (table != "-" && std::filesystem::exists(journal_of(table), none))
        run.notify(fmt::format("{}: the study is not finished", table));
}

/// Reads the table of a study that is resumed, and stores the positions of its units.
class StudyFile::TableReader {
  public:
    TableReader(StudyFile& file, bool unfinished, const RunContext& run)
        : file_(file),
          smaller_(file.smaller_study(run)),
          part_(smaller_ ? &*smaller_ : &file.sweep_),
          unfinished_(unfinished),
          ordered_(smaller_ || !unfinished) {
        file.mixed_ = smaller_.has_value();
    }

    /// Returns the size to which the table is to be cut.
    std::uint64_t read(const RunContext& run) {
        Lines lines(file_.path_);
        std::string text;
        end_ = begin_ = file_.head_size_;
        line_ = file_.head_lines_;
        lines.seek(begin_);
        std::uint64_t damaged = 0;  // number of the first damaged line; 0: none
        while (take_line(lines, text)) {
            run.check_stop();
            const auto row = file_.table_.parse(text);
            if (!row && damaged == 0) damaged = line_;
            if (damaged != 0 && (row || !unfinished_))
                fail(ErrorKind::input, "{}:{}: this is not a row of a study", file_.path_, damaged);
            if (row) add(*row);
            if (row) end_ += text.size() + 1;
        }
        const bool finished =
            !unfinished_ && text.empty() && part_ == &file_.sweep_ && unit_ + 1 == part_->units();
        const bool whole = end_part(finished);
        return whole || part_ != &file_.sweep_ ? end_ : begin_;
    }

  private:
    bool take_line(Lines& lines, std::string& text) {
        ++line_;
        return lines.take(text);
    }

    void add(const StudyRow& row) {
        if (row.study != part_->fingerprint()) begin_own_part(row);
        if (!like_ || !belongs(row, *like_)) {
            const std::uint64_t next = like_ ? unit_ + 1 : 0;
            end_unit();
            begin_unit(row, next);
        }
        keys_.push_back(row.key);
        if (row.failed()) failure_ = row;
    }

    /// Call at the first row of this study after rows of a smaller study: ends their part.
    void begin_own_part(const StudyRow& row) {
        if (part_ == &file_.sweep_ || row.study != file_.sweep_.fingerprint()) file_.refuse_other();
        end_part(false);
        like_.reset();
        part_ = &file_.sweep_;
        ordered_ = !unfinished_;
    }

    void begin_unit(const StudyRow& row, std::uint64_t next) {
        const bool in_order =
            next < part_->units() && belongs(row, row_of(*part_, part_->unit(next)));
        const auto unit = in_order   ? std::optional(next)
                          : ordered_ ? std::nullopt
                                     : unit_of(*part_, row);
        if (unit) like_ = row_of(*part_, part_->unit(unit_ = *unit));
        if (!unit || file_.has(own_unit()))
            fail(ErrorKind::input,
                 "{}:{}: this row is not in its place; it was moved, or rows before it are missing",
                 file_.path_, line_);
        begin_ = end_;
        keys_.clear();
        failure_.reset();
    }

    /// Index, in this study, of the unit that is being read.
    [[nodiscard]] std::uint64_t own_unit() const {
        StudyRow row = *like_;
        row.study = file_.sweep_.fingerprint();
        return part_ == &file_.sweep_ ? unit_ : unit_of(file_.sweep_, row).value();
    }

    void end_unit() {
        if (!like_) return;
        const std::uint64_t unit = own_unit();
        // Units that lacked memory or a file are measured again: both may be available now.
        if (failure_ && failure_->lacked_something()) return;
        if (failure_) file_.note_failure(unit, *failure_);
        file_.store({unit, unit + 1}, begin_, end_ - begin_);
        usual_keys_[like_->measure] = {*like_, std::move(keys_)};
    }

    /// Stores the last unit of `part_` if it is complete. Returns false if it may lack rows.
    bool end_part(bool finished) {
        if (!like_) return true;
        const auto& [row, keys] = usual_keys_[like_->measure];
        // Equal keys prove nothing if lists may differ in length, as for other generators, n or d.
        const bool alike = finished || !keys_.back().ends_with(']') ||
                           (row.generator == like_->generator && row.count == like_->count &&
                            row.dimension == like_->dimension);
        if (keys != keys_ || !alike) return false;
        end_unit();
        return true;
    }

    StudyFile& file_;
    std::optional<Sweep> smaller_;
    const Sweep* part_;  ///< study that the rows being read belong to
    bool unfinished_;    ///< whether there is a journal
    bool ordered_;       ///< whether units must be in order
    std::uint64_t line_ = 0;
    std::optional<StudyRow> like_;  ///< row_of() of the unit being read
    std::uint64_t unit_ = 0;
    std::vector<std::string> keys_;    ///< keys of the unit's rows
    std::optional<StudyRow> failure_;  ///< row of the unit, if it failed
    std::uint64_t begin_ = 0;          ///< position of the unit, in bytes
    std::uint64_t end_ = 0;            ///< position after the last row
    std::map<std::string, std::pair<StudyRow, std::vector<std::string>>> usual_keys_;
};

StudyFile::StudyFile(std::string path, const Sweep& sweep, const StudyTable& table, Start start,
                     Listener listener, const RunContext& run)
    : path_(std::move(path)), sweep_(sweep), table_(table), listener_(std::move(listener)) {
    const auto status = status_of(path_);
    if (path_ != "-" && is_directory(status))
        fail(ErrorKind::io, "{}: is a folder, not a file", path_);
    if (path_ != "-" && (!exists(status) || is_regular_file(status))) {
        open_file(start, run);
        return;
    }
    if (start == Start::resume)
        fail(ErrorKind::usage, "--resume: needs a file; name the one to go on with by -o");
    stream_.emplace(path_).write(table_.head());
}

StudyFile::~StudyFile() {
    sync();
    if (output_ >= 0) ::close(output_);
    if (journal_ >= 0) ::close(journal_);
}

void StudyFile::open_file(Start start, const RunContext& run) {
    const bool unfinished = exists(status_of(journal_of(path_)));
    Lines lines(path_);
    std::string first;
    // After a crash, the first line may be incomplete or missing.
    bool whole = lines.take(first);
    for (; whole && is_study_preface(first); whole = lines.take(first), ++head_lines_)
        head_size_ += first.size() + 1;
    const bool ours = whole ? table_.is_head(first)
                            : first.empty() || head_lines_ > 0 ||
                                  (start != Start::fresh && (table_.head().starts_with(first) ||
                                                             first.starts_with("{\"generator\":")));
    if (!ours)
        fail_with_hint(ErrorKind::input, "name another file with -o",
                       "{}: exists and is not the table of a study", path_);
    if (unfinished && start == Start::fresh)
        fail_with_hint(ErrorKind::usage, "--resume continues it, --overwrite starts anew",
                       "{}: holds an unfinished study", path_);
    if (whole && start == Start::fresh)
        fail_with_hint(
            ErrorKind::usage,
            "--overwrite starts anew, --resume adds what is missing, -o names another file",
            "{}: exists and holds a study", path_);
    output_ = opened(path_);
    if (start != Start::resume || !whole) {
        lock_journal();
        begin_journal();
        begin_table();
        return;
    }
    if (table_.style() == TableStyle::csv) {
        if (first + "\n" != table_.names())
            refuse_other(first.ends_with(",seconds") ? ": it has seconds, this one has none"
                                                     : ": it has no seconds, this one has");
        head_size_ += table_.names().size();
        ++head_lines_;
    }
    if (unfinished) lock_journal();
    const bool known = unfinished && journal_is_ours();
    size_ = TableReader(*this, unfinished, run).read(run);
    if (!unfinished && (mixed_ || written_ < sweep_.units())) lock_journal();
    if (journal_ >= 0 && !known) begin_journal();
    cut_to(output_, size_, path_);
}

void StudyFile::begin_table() {
    cut_to(output_, 0, path_);
    write_all(output_, table_.head(), path_);
    size_ = head_size_ = table_.head().size();
}

void StudyFile::lock_journal() {
    journal_ = opened(journal_of(path_));
    struct stat locked = {};
    struct stat there = {};
    const bool alone = ::flock(journal_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
    if (!alone) fail(ErrorKind::io, "{}: another study is writing to it", path_);
    // If another process finished before the lock, it has renamed the opened file to its table.
    if (::fstat(journal_, &locked) != 0 || ::stat(journal_of(path_).c_str(), &there) != 0 ||
        locked.st_ino != there.st_ino)
        fail(ErrorKind::io, "{}: another study is writing to it", path_);
}

/// Whether the journal is that of this study; false if it is damaged.
/// @throws Error(input) if the journal is that of another study
bool StudyFile::journal_is_ours() const {
    const Json head = head_of_journal(path_);
    if (head.is_object() && head["study"] != sweep_.fingerprint()) refuse_other();
    return head.is_object();
}

void StudyFile::begin_journal() {
    const std::string journal = journal_of(path_);
    cut_to(journal_, 0, journal);
    write_all(
        journal_,
        fmt::format("{{\"format\":\"{}\",\"version\":3,\"study\":\"{}\",\"settings\":{}}}\n",
                    journal_format, sweep_.fingerprint(), json_text(json_of_settings(sweep_))),
        journal);
}

void StudyFile::refuse_other(std::string differs) const {
    const Json head = head_of_journal(path_);
    if (head.is_object() && differs.empty()) differs = difference(head["settings"], sweep_);
    fail_with_hint(ErrorKind::input, "resume it with its own options, or name another file with -o",
                   "{}: --resume: the file holds another study{}", path_, differs);
}

/// Returns the finished study that this one extends, if the table begins with rows of another
/// study; otherwise nullopt. @throws Error(input) if this study does not extend the other one
std::optional<Sweep> StudyFile::smaller_study(const RunContext& run) const {
    SweepRequest request = sweep_.request();
    for (auto* list : {&request.generators, &request.measures}) list->clear();
    for (auto* list : {&request.counts, &request.dimensions}) list->clear();
    const auto add = [](auto& list, const auto& entry) {
        if (std::ranges::find(list, entry) == list.end()) list.push_back(entry);
    };
    std::uint64_t last_seed = 0;
    request.first_seed = ~std::uint64_t{0};
    std::string fingerprint;
    std::string warps;
    std::vector<std::string> keys;
    Lines lines(path_);
    for (std::string text; lines.take(text);) {
        run.check_stop();
        const auto row = table_.parse(text);
        if (!row) continue;
        if (row->study == sweep_.fingerprint()) break;
        fingerprint = row->study;
        warps = row->warps;
        if (keys.size() < 100) add(keys, row->key);
        add(request.generators, row->generator);
        add(request.measures, row->measure);
        add(request.counts, row->count);
        add(request.dimensions, row->dimension);
        request.first_seed = std::min(request.first_seed, row->seed);
        last_seed = std::max(last_seed, row->seed);
    }
    if (fingerprint.empty()) return std::nullopt;
    request.seeds = last_seed - request.first_seed + 1;
    // Its fingerprint is compared, too: it also covers settings that rows do not show (keys,
    // limits), and sets that have no rows.
    std::optional<Sweep> sweep;
    try {
        sweep.emplace(std::move(request));
    } catch (const Error&) {
        refuse_other();
    }
    if (warps != sweep->warp_names()) refuse_other(difference({{"warp", warps}}, sweep_));
    if (sweep->fingerprint() != fingerprint)
        refuse_other(hidden_difference(*sweep, fingerprint, keys));
    if (const std::string lost = sweep_.missing_from(*sweep); !lost.empty())
        fail_with_hint(ErrorKind::input, "include it, too, or name another file with -o",
                       "{}: --resume: the study in the file has {}, this one does not", path_,
                       lost);
    return sweep;
}

bool StudyFile::has(std::uint64_t unit) const {
    const auto behind = index_.upper_bound(unit);
    return behind != index_.begin() && std::prev(behind)->second.last > unit;
}

void StudyFile::store(UnitRange units, std::uint64_t offset, std::uint64_t bytes) {
    written_ += units.last - units.first;
    const auto behind = index_.lower_bound(units.first);
    if (behind != index_.begin()) {
        Stored& before = std::prev(behind)->second;
        if (before.last == units.first && before.offset + before.bytes == offset) {
            before.last = units.last;
            before.bytes += bytes;
            return;
        }
    }
    index_.emplace_hint(behind, units.first, Stored{units.last, offset, bytes});
}

std::vector<UnitRange> StudyFile::done() const {
    std::vector<UnitRange> ranges;
    for (const auto& [first, stored] : index_) ranges.push_back({first, stored.last});
    return ranges;
}

void StudyFile::note_failure(std::uint64_t unit, const StudyRow& row) {
    if (failures_.units++ == 0 || unit < failures_.first_unit) {
        failures_.first_unit = unit;
        failures_.first = row;
    }
    failures_.met_limit |= row.reason.starts_with("limit") || row.reason.starts_with("time limit");
}

bool StudyFile::put(const Segment& segment) {
    std::string text;
    std::vector<std::pair<std::uint64_t, StudyRow>> failed;
    for (std::uint64_t unit = segment.units.first; unit < segment.units.last; ++unit)
        for (const StudyRow& row :
             rows_of(sweep_, sweep_.unit(unit), segment.results[unit - segment.units.first])) {
            if (row.failed()) failed.emplace_back(unit, row);
            if (!stream_) text += table_.line(row);
        }
    const std::lock_guard lock(mutex_);
    if (broken_) std::rethrow_exception(broken_);
    try {
        for (const auto& [unit, row] : failed) note_failure(unit, row);
        if (stream_) return put_in_turn(segment);
        write_all(output_, text, path_);
        dirty_ = true;
        store(segment.units, size_, text.size());
        size_ += text.size();
    } catch (...) {
        broken_ = std::current_exception();
        throw;
    }
    return true;
}

bool StudyFile::put_in_turn(const Segment& segment) {
    waiting_.emplace(segment.units.first, segment);
    while (!waiting_.empty() && waiting_.begin()->first == written_) {
        const auto [units, results] = std::move(waiting_.extract(waiting_.begin()).mapped());
        std::string text;
        for (const UnitResult& result : results)
            for (const StudyRow& row : rows_of(sweep_, sweep_.unit(written_++), result)) {
                text += table_.line(row);
                if (listener_) listener_(row);
            }
        if (!stream_->write(text)) return false;
    }
    return true;
}

void StudyFile::sync() {
    if (!dirty_.exchange(false)) return;
    // Without the journal, rows out of order would be mistaken for damage.
    if (!journal_synced_ && !synchronise_new(journal_, journal_of(path_))) lost_ = errno;
    journal_synced_ = true;
    if (!is_synchronised(::fsync(output_))) lost_ = errno;
}

/// Returns the line, with its fingerprint replaced by that of this study.
std::string StudyFile::renamed(const std::string& line) const {
    StudyRow row = table_.parse(line).value();
    row.study = sweep_.fingerprint();
    std::string text = table_.line(row);
    text.pop_back();
    return text;
}

/// Calls `visit` for the lines of the table, in the order of the study.
void StudyFile::for_each_line(const std::function<void(const std::string&)>& visit,
                              const RunContext& run) const {
    Lines lines(path_);
    std::string line;
    for (const auto& [first, stored] : index_) {
        lines.seek(stored.offset);
        for (std::uint64_t left = stored.bytes; left > 0;) {
            run.check_stop();
            if (!lines.take(line) || line.size() >= left)
                fail(ErrorKind::io, "{}: was cut off by another program", path_);
            left -= line.size() + 1;
            visit(mixed_ ? renamed(line) : line);
        }
    }
}

void StudyFile::listen(const RunContext& run) const {
    if (stream_ || !listener_) return;
    for_each_line([&](const std::string& line) { listener_(*table_.parse(line)); }, run);
}

void StudyFile::rewrite(const RunContext& run) {
    const std::string journal = journal_of(path_);
    cut_to(journal_, 0, journal);
    std::string block = table_.head();
    constexpr std::size_t most_bytes = 1 << 20;
    const auto write = [&](const std::string& line) {
        block.append(line).append("\n");
        if (block.size() < most_bytes) return;
        write_all(journal_, block, journal);
        block.clear();
    };
    for_each_line(write, run);
    write_all(journal_, block, journal);
    struct stat mode = {};
    struct stat fresh = {};
    if (::fstat(output_, &mode) != 0 || ::fstat(journal_, &fresh) != 0) refuse(path_);
    if (mode.st_mode != fresh.st_mode && ::fchmod(journal_, mode.st_mode & 07777) != 0)
        refuse(journal);
    if (!is_synchronised(::fsync(journal_))) refuse(journal);
    if (::rename(journal.c_str(), real_file(path_).c_str()) != 0) refuse(path_);
}

void StudyFile::finish(const std::string& more, const RunContext& run) {
    if (stream_) {
        stream_->write(more);
        return;
    }
    // If an earlier sync failed, rows may be lost: later syncs do not write them again.
    if (lost_ != 0) refuse_file(path_, lost_);
    const bool in_order =
        !mixed_ && index_.size() == 1 && head_size_ + index_.begin()->second.bytes == size_;
    if (!in_order) rewrite(run);
    if (in_order && !is_synchronised(::fsync(output_))) refuse(path_);
    if (in_order && journal_ >= 0 && ::unlink(journal_of(path_).c_str()) != 0)
        refuse(journal_of(path_));
    dirty_ = false;
}

}  // namespace stipple
