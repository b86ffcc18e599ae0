// SPDX-License-Identifier: MIT
#include "study/study_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>

#include "core/bytes/file_bytes.hpp"
#include "core/error.hpp"
#include "core/text.hpp"

namespace stipple {
namespace {

constexpr const char* journal_format = "stipple.study-journal";

std::string folder_of(const std::string& path) {
    const auto slash = path.rfind('/');
    return slash == std::string::npos ? "." : path.substr(0, slash + 1);
}

[[noreturn]] void refuse(const std::string& path) {
    if (errno == ENOENT)
        fail(ErrorKind::io, "{}: {}", path,
             exists(status_of(folder_of(path))) ? "no file can be made in its folder"
                                                : "no such folder");
    refuse_file(path, errno);
}

int opened(const std::string& path, int flags) {
    const int descriptor = ::open(path.c_str(), flags | O_CLOEXEC, 0666);
    if (descriptor < 0) refuse(path);
    return descriptor;
}

/// Writes all of it, whatever signals come.
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

/// Whether the bytes are on the disk. Some file systems have nothing to synchronise, and say so.
bool is_synchronised(int result) { return result == 0 || errno == EINVAL || errno == ENOTSUP; }

/// Writes what a file holds to the disk, where the system can do so without its times.
int synchronise_bytes(int descriptor) {
#if defined(_POSIX_SYNCHRONIZED_IO) && _POSIX_SYNCHRONIZED_IO > 0
    return ::fdatasync(descriptor);
#else
    return ::fsync(descriptor);
#endif
}

/// Has a file that is new on the disk, its name in the folder, too.
void synchronise_new(int descriptor, const std::string& path) {
    if (!is_synchronised(::fsync(descriptor))) refuse(path);
    const int folder = ::open(folder_of(path).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const bool done = folder >= 0 && is_synchronised(::fsync(folder));
    const int error = errno;
    if (folder >= 0) ::close(folder);
    if (!done) refuse_file(path, error);
}

[[noreturn]] void refuse_place(const std::string& path, std::uint64_t line) {
    fail(ErrorKind::input,
         "{}:{}: this row is not where the study has it; it was moved or rows are missing", path,
         line);
}

std::vector<std::string> keys_of(const std::vector<StudyRow>& rows) {
    std::vector<std::string> keys;
    for (const StudyRow& row : rows) keys.push_back(row.key);
    return keys;
}

/// Whether a row is one of that unit's.
bool is_of(const Sweep& sweep, const StudyRow& row, std::uint64_t unit) {
    return unit < sweep.units() && belongs(row, row_of(sweep, sweep.unit(unit)));
}

}  // namespace

std::string journal_of(const std::string& table) { return table + ".journal"; }

/// Lines of a file, which may not be there. A read that fails is not its end.
class StudyFile::Lines {
  public:
    explicit Lines(const std::string& path) : path_(path), in_(path, std::ios::binary) {
        if (!in_.is_open() && errno != ENOENT) refuse_file(path_, errno);
        empty_ = !in_.is_open() || in_.peek() == std::ifstream::traits_type::eof();
        require_read();
    }

    [[nodiscard]] bool is_empty() const { return empty_; }

    /// The whole line that comes next; false at the end, and where it has no end.
    bool take(std::string& line) {
        const bool whole = std::getline(in_, line) && !in_.eof();
        require_read();
        return whole;
    }

  private:
    void require_read() const {
        if (in_.bad()) refuse_file(path_, errno);
    }

    std::string path_;
    std::ifstream in_;
    bool empty_ = true;
};

/// The rows of a table, in order.
class StudyFile::RowReader {
  public:
    RowReader(const std::string& path, const StudyTable& table)
        : path_(path), table_(table), lines_(path) {
        if (table.style() == TableStyle::csv) take_line();
    }

    /// The row that comes next; nothing at the end. @throws Error(input), Error(cancelled)
    std::optional<StudyRow> take(const RunContext& run) {
        run.check_stop();
        if (!take_line()) return std::nullopt;
        auto row = table_.parse(text_);
        if (!row) fail(ErrorKind::input, "{}:{}: is no row of a study", path_, line_);
        return row;
    }

    /// Number of the line that was taken last, from 1, and its bytes.
    [[nodiscard]] std::uint64_t line() const { return line_; }
    [[nodiscard]] std::size_t size() const { return text_.size() + 1; }

    /// At the end: whether the last line had one.
    [[nodiscard]] bool is_whole() const { return text_.empty(); }

  private:
    bool take_line() {
        ++line_;
        return lines_.take(text_);
    }

    const std::string& path_;
    const StudyTable& table_;
    Lines lines_;
    std::string text_;
    std::uint64_t line_ = 0;
};

Json StudyFile::head_of_journal(Lines& lines, std::string& line) {
    Json head = lines.take(line) ? try_parse_json(line) : Json();
    const bool known =
        head.is_object() && head.contains("study") && head.contains("settings") &&
        line.starts_with(fmt::format("{{\"format\":\"{}\",\"version\":2,", journal_format));
    return known ? head : Json();
}

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

void StudyFile::sync() {
    if (!dirty_.exchange(false)) return;
    for (const int descriptor : {output_, journal_})
        if (descriptor >= 0 && !is_synchronised(synchronise_bytes(descriptor))) lost_ = errno;
}

void StudyFile::open_file(Start start, const RunContext& run) {
    const bool resume = start == Start::resume;
    const bool unfinished = exists(status_of(journal_of(path_)));
    Lines lines(path_);
    std::string first;
    const bool empty = lines.is_empty();
    // A crash may have left a part of the first line; its end was not reached then.
    const bool whole = lines.take(first);
    const bool ours = whole ? table_.is_head(first)
                            : start != Start::fresh && (table_.head().starts_with(first) ||
                                                        first.starts_with("{\"generator\":"));
    if (!empty && !ours)
        fail_with_hint(ErrorKind::input, "name another file with -o",
                       "{}: is there and is not a study's table", path_);
    if (unfinished && start == Start::fresh)
        fail_with_hint(ErrorKind::usage, "--resume goes on with it, --overwrite begins anew",
                       "{}: holds a study that is not finished", path_);
    if (whole && start == Start::fresh)
        fail_with_hint(ErrorKind::usage,
                       "--overwrite begins anew, --resume adds what is missing, -o names another",
                       "{}: exists, and holds a study", path_);
    output_ = opened(path_, O_RDWR | O_CREAT | O_APPEND);
    if (!resume || !whole) {
        begin_journal();
        cut_to(output_, 0, path_);
        write_all(output_, table_.head(), path_);
        return;
    }
    if (table_.style() == TableStyle::csv && first + "\n" != table_.head()) refuse_other();
    if (const auto smaller = smaller_study(run)) {
        take_over(*smaller, run);
    } else {
        if (unfinished) read_journal();
        read_rows(run);
        if (next_ == sweep_.units()) return;
        if (!unfinished) begin_journal();
    }
    write_waiting();
}

void StudyFile::open_journal() {
    journal_ = opened(journal_of(path_), O_RDWR | O_CREAT | O_APPEND);
    if (::flock(journal_, LOCK_EX | LOCK_NB) != 0)
        fail(ErrorKind::io, "{}: another study is writing to it", path_);
}

void StudyFile::begin_journal() {
    if (journal_ < 0) open_journal();
    Json settings = Json::object();
    for (const auto& [key, value] : sweep_.settings()) settings[key] = value;
    const std::string head =
        fmt::format("{{\"format\":\"{}\",\"version\":2,\"study\":\"{}\",\"settings\":{}}}\n",
                    journal_format, sweep_.fingerprint(), json_text(settings));
    cut_to(journal_, 0, journal_of(path_));
    write_all(journal_, head, journal_of(path_));
    journal_size_ = head.size();
}

void StudyFile::refuse_other() const {
    Lines journal(journal_of(path_));
    std::string line;
    const Json head = head_of_journal(journal, line);
    std::string differs;
    for (const auto& [name, value] : sweep_.settings()) {
        const bool known = head.is_object() && head["settings"].is_object() &&
                           head["settings"].contains(name) && head["settings"][name].is_string();
        if (!known || head["settings"][name] == value) continue;
        differs = fmt::format(": it has {} '{}', this one '{}'", name,
                              head["settings"][name].get<std::string>(), value);
        break;
    }
    fail_with_hint(ErrorKind::input, "resume it with its own options, or name another file with -o",
                   "{}: --resume: the study there is another one{}", path_, differs);
}

void StudyFile::read_journal() {
    open_journal();
    Lines lines(journal_of(path_));
    std::string line;
    const Json head = head_of_journal(lines, line);
    if (head.is_null()) return begin_journal();
    if (head["study"] != sweep_.fingerprint()) refuse_other();
    journal_size_ = line.size() + 1;
    while (read_entry(lines)) {
    }
    cut_to(journal_, journal_size_, journal_of(path_));
}

bool StudyFile::read_entry(Lines& lines) {
    std::string line;
    if (!lines.take(line)) return false;
    std::vector<std::uint64_t> numbers;
    for (const auto word : split(line, ' ')) numbers.push_back(parse_unsigned(word).value_or(0));
    if (numbers.empty()) return false;
    Waiting waiting{.bytes = {numbers.begin() + 1, numbers.end()},
                    .offset = journal_size_ + line.size() + 1};
    for (std::uint64_t unit = numbers[0]; std::uint64_t left : waiting.bytes) {
        do {  // a crash may have left other bytes than those that were written
            if (!lines.take(line) || line.size() + 1 > left) return false;
            const auto row = table_.parse(line);
            if (!row || !is_of(sweep_, *row, unit)) return false;
            left -= line.size() + 1;
        } while (left > 0);
        ++unit;
    }
    journal_size_ = waiting.offset + waiting.size();
    waiting_.emplace(numbers[0], std::move(waiting));
    return true;
}

std::vector<UnitRange> StudyFile::done() const {
    std::vector<UnitRange> ranges = {{0, next_}};
    for (const auto& [first, waiting] : waiting_)
        ranges.push_back({first, first + waiting.bytes.size()});
    return ranges;
}

void StudyFile::read_rows(const RunContext& run) {
    RowReader reader(path_, table_);
    std::uint64_t end = table_.head().size();  // of the rows read so far
    std::uint64_t whole = end;                 // of those of whole units
    std::vector<StudyRow> rows;                // of the unit next_
    std::vector<std::vector<std::string>> keys(sweep_.measures().size());  // of the unit before
    const auto take_unit = [&] {
        for (const StudyRow& row : rows) listener_(row);
        keys[sweep_.unit(next_++).measure] = keys_of(std::exchange(rows, {}));
        whole = end;
    };
    while (const auto row = reader.take(run)) {
        if (row->study != sweep_.fingerprint()) refuse_other();
        if (!is_of(sweep_, *row, next_)) {
            if (rows.empty() || !is_of(sweep_, *row, next_ + 1)) refuse_place(path_, reader.line());
            take_unit();
        }
        rows.push_back(*row);
        end += reader.size();
    }
    // How many rows the last unit has, those of a unit before it tell: else it is done again.
    const bool finished = journal_ < 0 && reader.is_whole() && next_ + 1 == sweep_.units();
    if (finished && !rows.empty() && keys_of(rows) == keys[sweep_.unit(next_).measure]) take_unit();
    cut_to(output_, whole, path_);
}

std::optional<Sweep> StudyFile::smaller_study(const RunContext& run) const {
    SweepRequest request = sweep_.request();
    for (auto* list : {&request.generators, &request.measures}) list->clear();
    for (auto* list : {&request.counts, &request.dimensions}) list->clear();
    const auto add = [](auto& list, const auto& entry) {
        if (std::ranges::find(list, entry) == list.end()) list.push_back(entry);
    };
    std::uint64_t last_seed = 0;
    request.first_seed = ~std::uint64_t{0};
    RowReader rows(path_, table_);
    std::string fingerprint;
    while (const auto row = rows.take(run)) {
        if (row->study == sweep_.fingerprint()) return std::nullopt;
        fingerprint = row->study;
        add(request.generators, row->generator);
        add(request.measures, row->measure);
        add(request.counts, row->count);
        add(request.dimensions, row->dimension);
        request.first_seed = std::min(request.first_seed, row->seed);
        last_seed = std::max(last_seed, row->seed);
    }
    if (fingerprint.empty()) return std::nullopt;
    request.seeds = last_seed - request.first_seed + 1;
    // The fingerprint vouches for what rows do not show: keys, limits, and that none is missing.
    std::optional<Sweep> sweep;
    try {
        sweep.emplace(std::move(request));
    } catch (const Error&) {
        refuse_other();
    }
    if (sweep->fingerprint() != fingerprint) refuse_other();
    if (const std::string lost = sweep_.lacks(*sweep); !lost.empty())
        fail_with_hint(ErrorKind::input, "name it, too, or name another file with -o",
                       "{}: --resume: the study there has {}, this one has not", path_, lost);
    return sweep;
}

void StudyFile::take_over(const Sweep& smaller, const RunContext& run) {
    if (journal_ < 0) open_journal();
    begin_journal();
    RowReader rows(path_, table_);
    Segment segment;    // units in a row
    std::string lines;  // of the one that is read
    std::size_t bytes = 0;
    std::uint64_t unit = 0;
    const auto end_segment = [&] {
        if (!segment.lines.empty()) keep(std::exchange(segment, {}), true);
        bytes = 0;
    };
    const auto end_unit = [&] {
        constexpr std::size_t most_bytes = 1 << 20;
        const std::uint64_t at = sweep_.same_unit(smaller, smaller.unit(unit++));
        if (at != segment.units.last || bytes > most_bytes) end_segment();
        if (segment.lines.empty()) segment.units = {at, at};
        ++segment.units.last;
        bytes += lines.size();
        segment.lines.push_back(std::exchange(lines, {}));
    };
    while (auto row = rows.take(run)) {
        if (!is_of(smaller, *row, unit)) {
            if (lines.empty() || !is_of(smaller, *row, unit + 1)) refuse_place(path_, rows.line());
            end_unit();
        }
        row->study = sweep_.fingerprint();
        lines += table_.line(*row);
    }
    end_segment();  // the last unit is done again: nobody can tell whether it is whole
    synchronise_new(journal_, journal_of(path_));
    cut_to(output_, table_.head().size(), path_);
    if (!is_synchronised(synchronise_bytes(output_))) refuse(path_);
}

void StudyFile::keep(const Segment& segment, bool in_journal) {
    Waiting waiting;
    std::string head = std::to_string(segment.units.first);
    for (const auto& lines : segment.lines) {
        waiting.bytes.push_back(lines.size());
        waiting.text += lines;
        head += fmt::format(" {}", lines.size());
    }
    if (in_journal) {
        head += '\n';
        write_all(journal_, head + waiting.text, journal_of(path_));
        waiting.offset = journal_size_ + head.size();
        journal_size_ = waiting.offset + waiting.size();
        waiting.text.clear();
    }
    waiting_.emplace(segment.units.first, std::move(waiting));
}

bool StudyFile::put(const Segment& segment) {
    if (broken_) return false;
    broken_ = true;
    keep(segment, segment.units.first > next_ && journal_ >= 0);
    dirty_ = true;
    broken_ = !write_waiting();
    return !broken_;
}

bool StudyFile::write_waiting() {
    while (!waiting_.empty() && waiting_.begin()->first <= next_) {
        const auto [first, waiting] = *waiting_.begin();
        waiting_.erase(waiting_.begin());
        const std::uint64_t known = next_ - first;  // units that the table has
        if (known >= waiting.bytes.size()) continue;
        const std::string text = text_of(waiting).substr(waiting.size(known));
        next_ = first + waiting.bytes.size();
        for (const auto line : split(std::string_view(text).substr(0, text.size() - 1), '\n'))
            if (const auto row = table_.parse(line)) listener_(*row);
        if (!write(text)) return false;
    }
    return true;
}

bool StudyFile::write(const std::string& text) {
    if (stream_) return stream_->write(text);
    write_all(output_, text, path_);
    return true;
}

std::string StudyFile::text_of(const Waiting& waiting) const {
    if (!waiting.text.empty()) return waiting.text;
    std::string text(waiting.size(), '\0');
    for (std::size_t done = 0; done < text.size();) {
        const auto got = ::pread(journal_, text.data() + done, text.size() - done,
                                 static_cast<off_t>(waiting.offset + done));
        if (got == 0) fail(ErrorKind::io, "{}: was cut off by another program", journal_of(path_));
        if (got < 0 && errno != EINTR) refuse(journal_of(path_));
        if (got > 0) done += static_cast<std::size_t>(got);
    }
    return text;
}

std::uint64_t StudyFile::Waiting::size(std::size_t units) const {
    const auto end = bytes.begin() + static_cast<std::ptrdiff_t>(std::min(units, bytes.size()));
    return std::accumulate(bytes.begin(), end, std::uint64_t{0});
}

bool StudyFile::finish(const std::string& more) {
    const bool wanted = write(more);
    if (output_ >= 0 && !is_synchronised(::fsync(output_))) refuse(path_);
    // What an earlier one could not write, the system does not try again.
    if (lost_ != 0) refuse_file(path_, lost_);
    if (journal_ >= 0 && ::unlink(journal_of(path_).c_str()) != 0) refuse(journal_of(path_));
    return wanted;
}

}  // namespace stipple
