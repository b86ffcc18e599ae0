// SPDX-License-Identifier: MIT
#include "study/study_file.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>

#include "core/error.hpp"
#include "core/file_bytes.hpp"
#include "core/json.hpp"

namespace stipple {
namespace {

constexpr const char* journal_format = "stipple.study-journal";

std::string journal_of(const std::string& path) { return path + ".journal"; }

bool there(const std::string& path) {
    struct stat status {};
    return ::stat(path.c_str(), &status) == 0;
}

[[noreturn]] void refuse(const std::string& path) {
    const auto slash = path.rfind('/');
    const std::string folder = slash == std::string::npos ? "." : path.substr(0, slash + 1);
    if (errno == ENOENT)
        fail(ErrorKind::io, "{}: {}", path,
             there(folder) ? "no file can be made in its folder" : "no such folder");
    fail(ErrorKind::io, "{}: {}", path == "-" ? "stdout" : path, file_trouble(errno));
}

int opened(const std::string& path, int flags) {
    const int descriptor = ::open(path.c_str(), flags | O_CLOEXEC, 0666);
    if (descriptor < 0) refuse(path);
    return descriptor;
}

/// Writes all of it, whatever signals come. False: the reader of the pipe went away.
bool write_all(int descriptor, std::string_view bytes, const std::string& path) {
    while (!bytes.empty()) {
        const auto written = ::write(descriptor, bytes.data(), bytes.size());
        if (written < 0 && errno == EPIPE) return false;
        if (written < 0 && errno == EAGAIN) {
            pollfd waiting{.fd = descriptor, .events = POLLOUT, .revents = 0};
            ::poll(&waiting, 1, -1);
        } else if (written < 0 && errno != EINTR) {
            refuse(path);
        }
        if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
}

void cut_to(int descriptor, std::uint64_t size, const std::string& path) {
    if (::ftruncate(descriptor, static_cast<off_t>(size)) != 0) refuse(path);
}

/// Lines of a text, each with its end.
std::vector<std::string> lines_in(std::string_view text) {
    std::vector<std::string> lines;
    while (!text.empty()) {
        const auto end = std::min(text.find('\n'), text.size() - 1) + 1;
        lines.emplace_back(text.substr(0, end));
        text.remove_prefix(end);
    }
    return lines;
}

/// The whole line that comes next; false at the end and where it has no end.
bool whole_line(std::istream& in, std::string& line) { return std::getline(in, line) && !in.eof(); }

/// A line without what was measured by the clock.
std::string timeless(const StudyTable& table, const std::string& line) {
    auto row = table.parse(std::string_view(line).substr(0, line.size() - 1));
    if (!row) return line;
    row->generate_seconds.reset();
    row->seconds.reset();
    return table.line(*row);
}

}  // namespace

StudyFile::StudyFile(std::string path, const Sweep& sweep, const StudyTable& table, Start start,
                     Listener listener, const RunContext& run)
    : path_(std::move(path)), sweep_(sweep), table_(table), listener_(std::move(listener)) {
    struct stat status {};
    const bool exists = path_ != "-" && ::stat(path_.c_str(), &status) == 0;
    if (exists && S_ISDIR(status.st_mode))
        fail(ErrorKind::io, "{}: is a folder, not a file", path_);
    stream_ = path_ == "-" || (exists && !S_ISREG(status.st_mode));
    if (stream_ && start == Start::resume)
        fail(ErrorKind::usage, "--resume: needs a file; name the one to go on with by -o");
    stream_ ? open_stream() : open_file(start, run);
}

StudyFile::~StudyFile() {
    sync();
    if (owned_) ::close(output_);
    if (journal_ >= 0) ::close(journal_);
}

void StudyFile::open_stream() {
    owned_ = path_ != "-";
    output_ = owned_ ? opened(path_, O_WRONLY) : STDOUT_FILENO;
    write_all(output_, table_.head(), path_);
}

void StudyFile::sync() {
    if (!dirty_.exchange(false)) return;
    // What cannot be synchronised, such as a pipe, says so; the rows are where they can be.
    if (owned_ && !stream_) ::fdatasync(output_);
    if (journal_ >= 0) ::fdatasync(journal_);
}

void StudyFile::open_file(Start start, const RunContext& run) {
    const bool resume = start == Start::resume;
    const bool unfinished = there(journal_of(path_));
    std::ifstream in(path_, std::ios::binary);
    std::string first;
    const bool empty = !in || in.peek() == std::ifstream::traits_type::eof();
    // A crash may have left a part of the first line; its end was not reached then.
    const bool whole = !empty && whole_line(in, first);
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
    owned_ = true;
    if (!resume || !whole) {
        begin_journal();
        cut_to(output_, 0, path_);
        write_all(output_, table_.head(), path_);
        return;
    }
    if (unfinished) read_journal();
    read_rows(run);
    if (!unfinished && is_complete()) {
        partial_.clear();
        done_.add({0, next_ = sweep_.units()});
        return;
    }
    if (!unfinished) begin_journal();
    write_waiting();
}

void StudyFile::begin_journal() {
    const std::string name = journal_of(path_);
    journal_ = opened(name, O_RDWR | O_CREAT | O_APPEND);
    if (::flock(journal_, LOCK_EX | LOCK_NB) != 0)
        fail(ErrorKind::io, "{}: another study is writing to it", path_);
    Json settings = Json::object();
    for (const auto& [key, value] : sweep_.settings()) settings[key] = value;
    const std::string head = Json{{"format", journal_format},
                                  {"version", 1},
                                  {"study", sweep_.fingerprint()},
                                  {"settings", settings}}
                                 .dump() +
                             "\n";
    cut_to(journal_, 0, name);
    write_all(journal_, head, name);
    journal_size_ = head.size();
}

void StudyFile::refuse_other(const std::string& found_settings) const {
    std::string differs;
    const Json found = Json::parse(found_settings, nullptr, false);
    for (const auto& [name, value] : sweep_.settings()) {
        if (!found.is_object() || !found.contains(name) || found[name] == value) continue;
        differs = fmt::format(": it has {} '{}', this one '{}'", name,
                              found[name].get<std::string>(), value);
        break;
    }
    fail_with_hint(ErrorKind::input, "resume it with its own options, or name another file with -o",
                   "{}: --resume: the study there is another one{}", path_, differs);
}

void StudyFile::read_journal() {
    const std::string name = journal_of(path_);
    std::ifstream in(name, std::ios::binary);
    std::string line;
    const Json head = whole_line(in, line) ? Json::parse(line, nullptr, false) : Json();
    if (!head.is_object() || head.value("format", "") != journal_format) return begin_journal();
    if (head.value("study", "") != sweep_.fingerprint()) refuse_other(head["settings"].dump());
    journal_ = opened(name, O_RDWR | O_APPEND);
    if (::flock(journal_, LOCK_EX | LOCK_NB) != 0)
        fail(ErrorKind::io, "{}: another study is writing to it", path_);
    journal_size_ = line.size() + 1;
    while (read_entry(in, journal_size_)) {
    }
    cut_to(journal_, journal_size_, name);
}

bool StudyFile::read_entry(std::istream& in, std::uint64_t offset) {
    std::string line;
    if (!whole_line(in, line)) return false;
    const Json entry = Json::parse(line, nullptr, false);
    if (!entry.is_object() || !entry.contains("first") || !entry.contains("bytes")) return false;
    Waiting waiting{.bytes = entry["bytes"].get<std::vector<std::size_t>>(),
                    .offset = offset + line.size() + 1};
    const auto size = std::accumulate(waiting.bytes.begin(), waiting.bytes.end(), std::size_t{0});
    std::string text(size, '\0');
    in.read(text.data(), static_cast<std::streamsize>(size));
    if (static_cast<std::size_t>(in.gcount()) < size) return false;
    const auto first = entry["first"].get<std::uint64_t>();
    done_.add({first, first + waiting.bytes.size()});
    waiting_.emplace(first, std::move(waiting));
    journal_size_ = offset + line.size() + 1 + size;
    return true;
}

void StudyFile::read_rows(const RunContext& run) {
    std::ifstream in(path_, std::ios::binary);
    std::string line;
    std::uint64_t whole = 0;
    std::uint64_t number = 0;
    keys_before_.resize(sweep_.measures().size());
    if (table_.style() == StudyTable::Style::csv) {
        whole_line(in, line);
        ++number;
        whole = line.size() + 1;
        if (line + "\n" != table_.head()) refuse_other("{}");
    }
    while (whole_line(in, line)) {
        run.check_stop();
        ++number;
        const auto row = table_.parse(line);
        if (!row) fail(ErrorKind::input, "{}:{}: is no row of a study", path_, number);
        if (row->study != sweep_.fingerprint()) refuse_other("{}");
        if (!take_row(*row, number)) {
            partial_.clear();
            keys_before_[sweep_.unit(next_ - 1).measure] = std::exchange(keys_, {});
        }
        partial_.push_back(line + "\n");
        keys_.push_back(row->key);
        listener_(*row);
        whole += line.size() + 1;
    }
    if (!line.empty()) keys_.clear();  // a row was torn
    cut_to(output_, whole, path_);
    done_.add({0, next_});
}

/// Whether a file without a journal has all rows: the last unit's results are those of a unit
/// before it. How many a unit has is not known before it is done.
bool StudyFile::is_complete() const {
    const auto last = sweep_.unit(sweep_.units() - 1).measure;
    return next_ + 1 == sweep_.units() && !keys_.empty() && keys_ == keys_before_[last];
}

/// Counts a row of the file. True: it is of the same unit as the row before.
bool StudyFile::take_row(const StudyRow& row, std::uint64_t line) {
    if (next_ < sweep_.units() && belongs(row, row_of(sweep_, sweep_.unit(next_)))) return true;
    const bool following = !partial_.empty() && next_ + 1 < sweep_.units() &&
                           belongs(row, row_of(sweep_, sweep_.unit(next_ + 1)));
    if (!following)
        fail(ErrorKind::input,
             "{}:{}: this row is not where the study has it; it was moved or rows are missing",
             path_, line);
    ++next_;
    return false;
}

bool StudyFile::put(const Segment& segment) {
    Waiting waiting;
    std::string text;
    for (const auto& lines : segment.lines) {
        waiting.bytes.push_back(lines.size());
        text += lines;
    }
    const bool early = segment.units.first > next_;
    if (early && journal_ >= 0) {
        const std::string head =
            Json{{"first", segment.units.first}, {"bytes", waiting.bytes}}.dump() + "\n";
        write_all(journal_, head + text, journal_of(path_));
        waiting.offset = journal_size_ + head.size();
        journal_size_ += head.size() + text.size();
    } else {
        waiting.text = std::move(text);
    }
    dirty_ = true;
    waiting_.emplace(segment.units.first, std::move(waiting));
    return write_waiting();
}

bool StudyFile::write_waiting() {
    while (!waiting_.empty() && waiting_.begin()->first <= next_) {
        const auto [first, waiting] = *waiting_.begin();
        waiting_.erase(waiting_.begin());
        if (!write_units(first, waiting)) return false;
    }
    return true;
}

bool StudyFile::write_units(std::uint64_t first, const Waiting& waiting) {
    if (first + waiting.bytes.size() <= next_) return true;  // the file had them already
    std::string text = waiting.text;
    if (text.empty()) {
        text.resize(std::accumulate(waiting.bytes.begin(), waiting.bytes.end(), std::size_t{0}));
        const auto got =
            ::pread(journal_, text.data(), text.size(), static_cast<off_t>(waiting.offset));
        if (got < 0) refuse(journal_of(path_));
        if (got != static_cast<ssize_t>(text.size()))
            fail(ErrorKind::io, "{}: was cut off by another program", journal_of(path_));
    }
    const auto known = static_cast<std::ptrdiff_t>(next_ - first);
    text.erase(
        0, std::accumulate(waiting.bytes.begin(), waiting.bytes.begin() + known, std::size_t{0}));
    text = without_known_rows(text);
    for (const auto& line : lines_in(text))
        if (const auto row = table_.parse(std::string_view(line).substr(0, line.size() - 1)))
            listener_(*row);
    next_ = first + waiting.bytes.size();
    return write_all(output_, text, path_);
}

/// The lines of units from next_ on, less those that are in the file already.
std::string StudyFile::without_known_rows(const std::string& lines) {
    std::size_t at = 0;
    for (const auto& known : std::exchange(partial_, {})) {
        const auto end = std::min(lines.find('\n', at), lines.size() - 1) + 1;
        if (timeless(table_, lines.substr(at, end - at)) != timeless(table_, known))
            fail(ErrorKind::input,
                 "{}: --resume: a row there is not what this program makes; it was changed, or "
                 "made by another program",
                 path_);
        at = end;
    }
    return lines.substr(at);
}

bool StudyFile::finish(const std::string& more) {
    const bool wanted = write_all(output_, more, path_);
    if (owned_ && ::fsync(output_) != 0 && errno != EINVAL && errno != ENOTSUP && errno != EROFS)
        refuse(path_);
    if (journal_ >= 0) ::unlink(journal_of(path_).c_str());
    return wanted;
}

}  // namespace stipple
