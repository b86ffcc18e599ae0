// SPDX-License-Identifier: MIT
//
// Reader for delimited text. Cuts the file at line starts into blocks of about 1 MiB and parses
// them in parallel, each directly into its place in the result.
//
// Cost    45 ns for a number of 17 digits on one core; memory for the points in addition to the
//         file.
// Promise the same points, and the same error, for any number of threads.
#include "io/formats/delimited.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <unordered_set>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "io/decimal.hpp"
#include "io/provenance.hpp"

namespace stipple::io {
namespace {

constexpr std::uint64_t block_bytes = std::uint64_t{1} << 20;
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

bool is_blank(char c) { return c == ' ' || c == '\t'; }

/// Skips blanks that do not separate fields.
const char* over_blanks(const char* p, const char* last, char separator) {
    while (p != last && is_blank(*p) && (*p != separator || separator == ' ')) ++p;
    return p;
}

/// A field of a line, without its quotes and surrounding blanks.
struct Field {
    std::string_view text;
    const char* at;  ///< start of the text in the line
};

/// End of the field that starts at `p`: the next separator outside quotes.
const char* field_end(const char* p, const char* last, char separator) {
    if (p != last && *p == '"') {
        const char* close = std::find(p + 1, last, '"');
        if (close != last) p = close + 1;
    }
    if (separator == ' ') return std::find_if(p, last, is_blank);
    const std::string_view rest(p, last);
    return p + std::min(rest.find(separator), rest.size());
}

Field field_between(const char* first, const char* last) {
    while (first != last && is_blank(*first)) ++first;
    const char* at = first;
    while (last != first && is_blank(last[-1])) --last;
    if (last - first >= 2 && *first == '"' && last[-1] == '"') {
        ++first;
        --last;
    }
    return {{first, static_cast<std::size_t>(last - first)}, at};
}

/// A column's name as UTF-8; text that is not valid UTF-8 is read as Latin-1, as spreadsheets write
/// it.
std::string name_in(std::string_view text) {
    std::string name(text);
    if (utf8_of(code_points(text)) == name) return name;
    name.clear();
    for (const char byte : text) append_utf8(name, static_cast<unsigned char>(byte));
    return name;
}

/// Iterates over the fields of a line.
class FieldReader {
  public:
    FieldReader(std::string_view line, char separator)
        : p_(line.data()), last_(line.data() + line.size()), separator_(separator) {}

    /// Reads the next field; false at the end of the line.
    bool next(Field& field) {
        if (ended_) return false;
        p_ = over_blanks(p_, last_, separator_);
        if (separator_ == ' ' && p_ == last_) return false;
        const char* const end = field_end(p_, last_, separator_);
        field = field_between(p_, end);
        ended_ = end == last_;
        if (!ended_) p_ = end + 1;
        return true;
    }

  private:
    const char* p_;
    const char* last_;
    char separator_;
    bool ended_ = false;
};

std::vector<Field> fields_of(std::string_view line, char separator) {
    std::vector<Field> fields;
    FieldReader reader(line, separator);
    for (Field field{}; reader.next(field);) fields.push_back(field);
    return fields;
}

bool is_number(std::string_view text) {
    double value = 0;
    const char* const last = text.data() + text.size();
    return !text.empty() && read_number(text.data(), last, value) == last;
}

/// Parses a finite number; returns false if the field is not one.
bool take_number(const Field& field, double& value) {
    const char* const last = field.text.data() + field.text.size();
    return read_number(field.text.data(), last, value) == last && std::isfinite(value);
}

/// Replaces the decimal comma of a number (0,5) by a point; empty if the text is not such a number.
std::string with_point(std::string_view text) {
    const auto comma = text.find(',');
    if (comma == std::string_view::npos || text.find('.') != std::string_view::npos) return {};
    std::string number(text);
    number[comma] = '.';
    return is_number(number) ? number : "";
}

/// As take_number(), for files with decimal commas; rejects decimal points.
bool take_number_with_comma(const Field& field, double& value) {
    if (field.text.find('.') != std::string_view::npos) return false;
    if (field.text.find(',') == std::string_view::npos) return take_number(field, value);
    const std::string number = with_point(field.text);
    return !number.empty() && take_number({number, field.at}, value);
}

/// Whether a field marks a missing number.
bool is_gap(const Field& field) {
    double value = 0;
    const char* const last = field.text.data() + field.text.size();
    return field.text.empty() || field.text == "NA" ||
           (read_number(field.text.data(), last, value) == last && std::isnan(value));
}

/// Describes why a field is not a finite number.
std::string trouble_with(const Field& field, bool decimal_comma) {
    if (field.text.empty()) return "an empty field; expected a number";
    if (decimal_comma && field.text.find('.') != std::string_view::npos)
        return shown(field.text) +
               " has a decimal point; expected a decimal comma, as in the rows above";
    if (!is_number(field.text)) {
        const bool comma = !decimal_comma && std::ranges::count(field.text, ',') == 1;
        return shown(field.text) + " is not a number; expected " +
               (comma           ? "a decimal point, as in 0.5"
                : decimal_comma ? "one such as 0,5"
                                : "one such as 0.5 or 1e-3");
    }
    const bool digits =
        std::ranges::any_of(field.text, [](char c) { return c >= '0' && c <= '9'; });
    return shown(field.text) +
           (digits ? " is beyond the largest double, 1.8e308" : " is not finite") +
           "; expected a finite number";
}

class RowReader {
  public:
    RowReader(const SourceText& text, const Columns& columns, const Dialect& dialect)
        : text_(text), columns_(columns), dialect_(dialect) {}

    /// Upper bound for the number of rows in [p, last).
    [[nodiscard]] std::uint64_t most_rows(const char* p, const char* last) const {
        const auto lines = 1 + static_cast<std::uint64_t>(std::count(p, last, text_.newline()));
        const std::uint64_t least_bytes =  // minimum bytes of a row with its line end
            columns_.width() + (dialect_.gaps ? 0 : columns_.dimension);
        return std::min(lines, 1 + static_cast<std::uint64_t>(last - p) / least_bytes);
    }

    /// Parses the lines in [p, last) into `room`; returns the number of rows.
    std::uint64_t read(const char* p, const char* last, std::span<double> room,
                       std::vector<Mark>& marks) const {
        std::uint64_t count = 0;
        double set = unknown;
        while (p != last) {
            const std::string_view line = line_at(text_, p);
            const char* const end = line.data() + line.size();
            const char* const first = over_blanks(p, end, ' ');
            const bool aside = first != end && *first == (dialect_.brackets ? '{' : '#');
            if (aside && (dialect_.brackets || trim(line) == "#"))
                marks.push_back({count, p, unknown});
            // In a table with one column, an empty line is a missing number.
            const bool gap = first == end && dialect_.gaps && columns_.width() == 1;
            if (gap) room[count++] = unknown;
            if (first != end && !aside) {
                double number = set;
                read_row(line, room.data() + count * columns_.dimension, number);
                if (!std::isnan(number) && number != set) marks.push_back({count, p, number});
                set = number;
                ++count;
            }
            p = next_line(text_, end);
        }
        return count;
    }

  private:
    /// Level names of a column; null for numeric columns.
    const std::vector<std::string>* words_of(std::size_t c) const {
        const std::size_t role = columns_.role[c];
        const bool some = role < columns_.words.size() && !columns_.words[role].empty();
        return some ? &columns_.words[role] : nullptr;
    }

    /// Value of a field: its number, the index of its level name, or NaN if missing. @throws
    /// Error(input)
    double number_in(std::string_view line, const Field& field, std::size_t c) const {
        const auto* words = words_of(c);
        const bool gap = dialect_.gaps && is_gap(field);
        if (words != nullptr) {
            const auto at = std::ranges::find(*words, field.text);
            if (at == words->end() && gap) return unknown;
            if (at == words->end())
                refuse(line, field.at,
                       shown(field.text) +
                           " is not among the words of its column; expected one of " +
                           shown(join(*words, ", ")));
            return static_cast<double>(at - words->begin());
        }
        if (gap) return unknown;
        double value = 0;
        const bool taken =
            dialect_.comma ? take_number_with_comma(field, value) : take_number(field, value);
        if (!taken) refuse(line, field.at, trouble_with(field, dialect_.comma));
        return value;
    }

    /// Stores the value of column c as a coordinate or as the set number. Returns false for an
    /// invalid set number.
    bool store(std::size_t c, double value, double* row, double& set) const {
        const std::size_t role = columns_.role[c];
        if (role < columns_.dimension) {
            row[role] = value;
        } else if (role == Columns::set_number) {
            if (!is_set_number(value)) return false;
            set = value;
        }
        return true;
    }

    /// Parses one row. @throws Error(input)
    void read_row(std::string_view line, double* row, double& set) const {
        FieldReader fields(dialect_.brackets ? inside_brackets(line) : line, dialect_.separator);
        const char* surplus = nullptr;  // first field beyond the last column
        std::size_t count = 0;
        for (Field field{}; fields.next(field); ++count) {
            if (count == columns_.width()) surplus = field.at;
            if (count >= columns_.width() || columns_.role[count] == Columns::skipped) continue;
            if (!store(count, number_in(line, field, count), row, set))
                refuse(line, field.at,
                       shown(field.text) + " is not the number of a set; expected 0, 1, 2...");
        }
        if (count == columns_.width()) return;
        const std::string_view content = trim(line);
        refuse(line, surplus != nullptr ? surplus : content.data() + content.size(),
               fmt::format("the row has {} field{}; expected {}", count, count == 1 ? "" : "s",
                           columns_.width()) +
                   (dialect_.model_line > 0 ? fmt::format(", as line {} has", dialect_.model_line)
                                            : std::string()));
    }

    /// Reports the first control byte in the line or, if it has none, the error. @throws
    /// Error(input)
    [[noreturn]] void refuse(std::string_view line, const char* at, const std::string& what) const {
        if (const char* bad = first_control_byte(line))
            text_.refuse(bad, fmt::format("byte 0x{:02X} is not text; expected numbers",
                                          static_cast<unsigned char>(*bad)));
        text_.refuse(at, what);
    }

    std::string_view inside_brackets(std::string_view line) const {
        const std::string_view row = trim(line);
        if (!row.starts_with('[')) refuse(line, row.data(), "expected a point such as [0.1,0.2]");
        const auto close = row.find(']');
        if (close == std::string_view::npos)
            refuse(line, row.data() + row.size(), "the row ends too soon; expected ']'");
        if (close + 1 != row.size())
            refuse(line, row.data() + close + 1,
                   shown(trim(row.substr(close + 1))) +
                       " follows a point; expected the end of the line");
        return row.substr(1, close - 1);
    }

    const SourceText& text_;
    const Columns& columns_;
    Dialect dialect_;
};

/// A block of whole lines and the results of parsing it.
struct Piece {
    const char* first = nullptr;
    const char* last = nullptr;
    std::uint64_t room = 0;  ///< upper bound for the number of rows
    std::uint64_t begin = 0;
    std::uint64_t count = 0;
    std::vector<Mark> marks = {};
    std::optional<Error> error = {};
};

/// Divides [body, end) into blocks; each ends at the first line start after its nominal end.
std::vector<Piece> cut_at_lines(const SourceText& text, const char* body, const RowReader& reader,
                                const RunContext& run) {
    const auto line_from = [&](std::uint64_t byte) {
        return byte == 0 ? body : next_line(text, body + byte - 1);
    };
    const auto size = static_cast<std::uint64_t>(text.end() - body);
    std::vector<Piece> pieces(block_count(size, block_bytes));
    for_each_block(silent(run), size, block_bytes, [&](const Block& block) {
        Piece& piece = pieces[block.index];
        piece.first = line_from(block.first);
        piece.last = line_from(block.last);
        piece.room = reader.most_rows(piece.first, piece.last);
    });
    for (std::size_t i = 1; i < pieces.size(); ++i)
        pieces[i].begin = pieces[i - 1].begin + pieces[i - 1].room;
    return pieces;
}

/// Closes gaps between the pieces, which may hold fewer rows than were reserved for them.
Rows close_gaps(std::vector<Piece>& pieces, std::vector<double> numbers, std::size_t dimension) {
    Rows rows;
    std::uint64_t count = 0;
    for (Piece& piece : pieces) {
        const auto from = numbers.begin() + static_cast<std::ptrdiff_t>(piece.begin * dimension);
        if (count != piece.begin)
            std::copy_n(from, piece.count * dimension,
                        numbers.begin() + static_cast<std::ptrdiff_t>(count * dimension));
        for (Mark mark : piece.marks) {
            mark.row += count;
            rows.marks.push_back(mark);
        }
        count += piece.count;
    }
    numbers.resize(count * dimension);
    rows.numbers = std::move(numbers);
    return rows;
}

bool is_header(const std::vector<Field>& fields) {
    return std::ranges::none_of(
               fields,
               [](const Field& f) { return is_number(f.text) || !with_point(f.text).empty(); }) &&
           std::ranges::any_of(fields, [](const Field& f) { return !f.text.empty(); });
}

/// Whether the fields are numbers between tabs, at least one with a decimal comma.
bool has_tabs_and_commas(std::string_view line) {
    if (line.find('\t') == std::string_view::npos) return false;
    bool comma = false;
    for (const Field& field : fields_of(line, '\t')) {
        const bool with_comma = !with_point(field.text).empty();
        if (!with_comma && !is_number(field.text)) return false;
        comma = comma || with_comma;
    }
    return comma;
}

/// The line without its quoted fields, in which separators are part of a name.
std::string without_quoted(std::string_view line) {
    std::string bare;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const bool opens =
            line[i] == '"' && (i == 0 || std::string_view(",; \t").find(line[i - 1]) != line.npos);
        const std::size_t close = opens ? line.find('"', i + 1) : line.npos;
        if (close != line.npos)
            i = close;
        else
            bare += line[i];
    }
    return bare;
}

/// Guesses the separator from a line. If tabs separate the names of a header, these may contain
/// blanks, commas and semicolons. Tabs beside commas or semicolons only align columns.
char separator_of(std::string_view line) {
    if (has_tabs_and_commas(line)) return '\t';
    const std::string bare = without_quoted(line);
    const auto has = [&bare](std::string_view text) { return bare.find(text) != bare.npos; };
    const bool beside = has(",\t") || has("\t,") || has(";\t") || has("\t;");
    if (has("\t") && !beside && is_header(fields_of(line, '\t'))) return '\t';
    for (const char* separator : {";", ","})
        if (has(separator)) return separator[0];
    return ' ';
}

}  // namespace

std::string_view line_at(const SourceText& text, const char* begin) {
    std::string_view line(begin, text.end());
    line = line.substr(0, line.find(text.newline()));
    if (text.newline() == '\n' && line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

const char* next_line(const SourceText& text, const char* at) {
    const std::string_view rest(at, text.end());
    const auto end = rest.find(text.newline());
    return end == rest.npos ? text.end() : at + end + 1;
}

Rows read_rows(const SourceText& text, const char* body, const Columns& columns,
               const Dialect& dialect, const RunContext& run) {
    const RowReader reader(text, columns, dialect);
    std::vector<Piece> pieces = cut_at_lines(text, body, reader, run);
    const std::uint64_t room = pieces.empty() ? 0 : pieces.back().begin + pieces.back().room;
    run.need_memory(static_cast<double>(room) * static_cast<double>(columns.dimension) * 8,
                    "reading " + text.source());
    std::vector<double> numbers(room * columns.dimension);
    for_each_block(silent(run), pieces.size(), 1, [&](const Block& block) {
        Piece& piece = pieces[block.index];
        const auto place = std::span(numbers).subspan(piece.begin * columns.dimension,
                                                      piece.room * columns.dimension);
        try {
            piece.count = reader.read(piece.first, piece.last, place, piece.marks);
        } catch (const Error& error) {
            piece.error = error;
        }
    });
    for (const Piece& piece : pieces)
        if (piece.error) throw Error(*piece.error);
    return close_gaps(pieces, std::move(numbers), columns.dimension);
}

std::vector<std::uint64_t> set_starts(const SourceText& text, const Rows& rows,
                                      std::size_t dimension) {
    std::vector<std::uint64_t> starts{0};
    for (const Mark& mark : rows.marks) {
        if (mark.row == 0) continue;  // a separator before the first point begins no set
        if (mark.row == starts.back() || mark.row * dimension == rows.numbers.size())
            text.refuse(mark.at, "a set without points; a line such as this separates two sets");
        starts.push_back(mark.row);
    }
    return starts;
}

Top read_top(const SourceText& text) {
    Top top{.provenance = {}, .first = text.begin(), .next = nullptr};
    bool comments = false;
    bool ours = false;
    for (; top.first != text.end(); top.first = top.next) {
        const std::string_view raw = line_at(text, top.first);
        top.next = next_line(text, top.first);
        const std::string_view line = trim(raw);
        if (line.empty()) continue;
        if (line.front() != '#') {
            if (const char* bad = first_control_byte(raw))
                text.refuse(bad, fmt::format("byte 0x{:02X} is not text; expected numbers, or the "
                                             "name of a binary format",
                                             static_cast<unsigned char>(*bad)));
            return top;
        }
        comments = true;
        const std::string_view comment = trim(line.substr(1));
        ours = ours || comment == "tool: \"stipple\"";
        if (ours) take_comment_line(comment, top.provenance);
    }
    text.refuse_whole(comments ? "the file holds only comments; expected points, one per line"
                               : "the file holds only blank lines; expected points, one per line");
}

namespace {

/// Results of reading the top of a table.
struct TableHead {
    Top top;
    Dialect dialect;
    Columns columns;
    bool names = false;          ///< the first line is a header
    const char* body = nullptr;  ///< start of the rows
    bool words_to_find = false;  ///< the first row has words that are not known levels
    /// Sentences on replaced names and on what may be meant otherwise.
    std::vector<std::string> notes = {};

    void report(const std::string& source, const RunContext& run) const {
        for (const std::string& note : notes)
            if (!note.empty()) run.notify(fmt::format("{}: {}", source_name(source), note));
    }
};

/// Calls `look` with the fields of each of the first 1000 rows, until it returns false.
void look_at_rows(const SourceText& text, const char* body, char separator,
                  const std::function<bool(const std::vector<Field>&)>& look) {
    int left = 1000;
    for (const char* at = body; at != text.end() && left > 0; at = next_line(text, at)) {
        const std::string_view line = line_at(text, at);
        if (trim(line).empty() || trim(line).starts_with('#')) continue;
        if (!look(fields_of(line, separator))) return;
        --left;
    }
}

/// Whether the first column holds 0, 1, 2, ... or 1, 2, 3, ...
bool counts_rows(const SourceText& text, const char* body, char separator) {
    constexpr int few = 3;
    int rows = 0;
    bool counts = true;
    double first = 0;
    look_at_rows(text, body, separator, [&](const std::vector<Field>& fields) {
        const auto number = parse_number(fields.front().text);
        if (rows == 0) first = number.value_or(-1);
        return counts = number && *number == first + rows++;
    });
    return counts && rows >= few && (first == 0 || first == 1);
}

/// Whether a number with a decimal comma may be one of thousands: 1,234.
bool may_be_thousands(std::string_view text) {
    const auto comma = text.find(',');
    return comma <= 3 && text.size() == comma + 4 && text[0] >= '1' && text[0] <= '9';
}

/// The first fractional number if it has a decimal comma, or a later one that cannot be of
/// thousands; otherwise empty. Skips columns with level names.
std::string_view number_with_comma(const SourceText& text, const TableHead& head) {
    std::string_view found;
    const char separator = head.dialect.separator;
    const auto& words = head.columns.words;
    if (separator == ',' || separator == ' ') return found;
    look_at_rows(text, head.body, separator, [&](const std::vector<Field>& fields) {
        for (std::size_t c = 0; c < std::min(fields.size(), head.columns.width()); ++c) {
            const Field& field = fields[c];
            const std::size_t role = head.columns.role[c];
            if (role < words.size() && !words[role].empty()) continue;
            const bool comma = !with_point(field.text).empty();
            if (comma) found = field.text;
            if (comma ? !may_be_thousands(found)
                      : found.empty() && is_number(field.text) &&
                            field.text.find('.') != std::string_view::npos)
                return false;
        }
        return true;
    });
    return found;
}

/// Whether a field holds a level name, rather than a misspelled number.
bool holds_word(const Field& field) {
    const auto is_letter = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
               static_cast<unsigned char>(c) > 127;
    };
    return is_word(std::string(field.text)) && std::ranges::any_of(field.text, is_letter);
}

/// Sorted distinct words of a column. Empty if the column also holds numbers or too many words.
/// Also empty for a single row, where a word is more likely a mistake.
std::vector<std::string> words_in_column(const SourceText& text, const TableHead& head,
                                         std::size_t c) {
    constexpr std::size_t most = 10'000;
    std::size_t rows = 0;
    std::set<std::string, std::less<>> words;
    for (const char* at = head.body; at != text.end(); at = next_line(text, at)) {
        const std::string_view line = line_at(text, at);
        if (trim(line).empty() || trim(line).starts_with('#')) continue;
        const auto fields = fields_of(line, head.dialect.separator);
        if (fields.size() <= c) break;  // read_row() reports the short row later
        if (head.dialect.gaps && is_gap(fields[c])) continue;
        if (!holds_word(fields[c]) || words.size() > most) return {};
        words.emplace(fields[c].text);
        ++rows;
    }
    if (rows == 1) words.clear();
    return {words.begin(), words.end()};
}

/// Finds level names in columns for which the provenance has none, and reports them.
void find_words(TableHead& head, const SourceText& text, const std::string& source,
                const RunContext& run) {
    for (std::size_t c = 0; head.words_to_find && c < head.columns.width(); ++c) {
        const std::size_t role = head.columns.role[c];
        if (role >= head.columns.names.size() || !head.columns.words[role].empty()) continue;
        auto words = words_in_column(text, head, c);
        if (words.empty()) continue;
        std::vector<std::string> told;
        for (const std::string& word : words)
            told.push_back(fmt::format("{} {}", told.size(), word));
        run.notify(fmt::format("{}: the column '{}' holds words, which are read as numbers: {}",
                               source_name(source), head.columns.names[role],
                               shown(join(told, ", "))));
        head.top.provenance.levels.emplace_back(head.columns.names[role], words);
        head.columns.words[role] = std::move(words);
    }
}

/// Takes level names from the provenance and detects further columns with words.
void take_words(TableHead& head, const SourceText& text) {
    Columns& columns = head.columns;
    columns.words.resize(columns.names.size());
    for (const auto& [name, words] : head.top.provenance.levels) {
        const auto at = std::ranges::find(columns.names, name);
        if (at != columns.names.end())
            columns.words[static_cast<std::size_t>(at - columns.names.begin())] = words;
    }
    look_at_rows(text, head.body, head.dialect.separator, [&](const std::vector<Field>& fields) {
        for (std::size_t c = 0; c < std::min(fields.size(), columns.width()); ++c) {
            const std::size_t role = columns.role[c];
            if (role >= columns.words.size() || (head.dialect.gaps && is_gap(fields[c]))) continue;
            auto& words = columns.words[role];
            // A number that is not a level name (as "nan" may be) shows that the column was written
            // as numbers.
            if (is_number(fields[c].text) &&
                std::ranges::find(words, fields[c].text) == words.end())
                words.clear();
            head.words_to_find |= columns.words[role].empty() && holds_word(fields[c]);
        }
        return false;
    });
}

/// Sentence on a first line that may be meant otherwise: names that begin like numbers, or a point
/// 0, 1, 2, ... above fractions, by which some programs number columns. Empty for other lines.
std::string doubt_about(const std::vector<Field>& fields, bool names, std::string_view below) {
    const auto looks_like_number = [](const Field& field) {
        const auto at = field.text.find_first_not_of("+-.$");
        return at < 3 && field.text[at] >= '0' && field.text[at] <= '9';
    };
    if (names && std::ranges::all_of(fields, looks_like_number))
        return fmt::format(
            "the first line is read as names of columns, though {} begins like a number",
            shown(fields[0].text));
    bool counts = !names && fields.size() > 1 && below.find('.') != below.npos;
    for (std::size_t k = 0; k < fields.size(); ++k) counts &= fields[k].text == std::to_string(k);
    return counts ? "the first line is read as a point; remove it if it numbers the columns" : "";
}

/// Sentence on weights that are not the inverses of the densities beside them in the first row;
/// else empty.
std::string doubt_about_weights(const SourceText& text, const TableHead& head,
                                const std::vector<std::string>& names) {
    double product = 1;
    look_at_rows(text, head.body, head.dialect.separator, [&](const std::vector<Field>& fields) {
        for (std::size_t c = 0; c < std::min(fields.size(), names.size()); ++c)
            if (double value = 1;
                (names[c] == "pdf" || names[c] == "weight") && take_number(fields[c], value))
                product *= value;
        return false;
    });
    return std::abs(product - 1) > 0.01 ? "the column 'weight' is not 1 / pdf, and is not used"
                                        : "";
}

/// Checks that rows without names are as long as the provenance above them states.
/// @throws Error(input)
void require_told_width(const SourceText& text, const TableHead& head, const ReadOptions& options) {
    const std::size_t told = head.top.provenance.dimension;
    const std::size_t found = head.columns.dimension - (options.strengths.empty() ? 0 : 1);
    const bool asked =
        !options.columns.empty() || options.dimension || options.all_columns || options.any_count;
    if (!head.names && !asked && told != 0 && told != found)
        text.refuse_whole(fmt::format("the rows have {} numbers, but the provenance above them "
                                      "states {} coordinates",
                                      found, told),
                          "--column picks the coordinates by number");
}

TableHead read_head(const SourceText& text, const ReadOptions& options) {
    TableHead head{.top = read_top(text), .dialect = {}, .columns = {}};
    if (!options.levels.empty()) head.top.provenance.levels = options.levels;
    const std::string_view line = line_at(text, head.top.first);
    head.dialect.separator = separator_of(line);
    head.dialect.gaps = options.gaps;
    const std::vector<Field> fields = fields_of(line, head.dialect.separator);
    std::vector<std::string> names;
    if (is_header(fields))
        for (const Field& field : fields) names.push_back(name_in(field.text));
    head.names = !names.empty();
    if (!head.names && head.top.provenance.columns.size() == fields.size())
        names = head.top.provenance.columns;
    head.dialect.model_line = text.line_of(head.top.first);
    head.columns = choose_columns(names, fields.size(), options,
                                  fmt::format("{}:{}", text.source(), head.dialect.model_line));
    if (auto sentences = replace_names(head.columns.names, options.gaps); !options.all_columns)
        head.notes = std::move(sentences);
    require_told_width(text, head, options);
    tell_columns(head.top.provenance, head.columns, options);
    head.top.provenance.named = head.names;
    head.body = head.names ? head.top.next : head.top.first;
    if (head.names) take_words(head, text);
    const bool chosen = !options.columns.empty() || options.all_columns;
    const bool row_names = head.names && names[0].empty() && !chosen;
    if (row_names)
        head.notes.emplace_back(
            "the first column has no name; it is read as row names and left out; --column picks "
            "columns by number");
    head.notes.push_back(doubt_about(fields, head.names, line_at(text, head.top.next)));
    // Digits that were cut may change the product of a density and its inverse.
    if (head.columns.density == "pdf,weight" && !head.top.provenance.precision)
        head.notes.push_back(doubt_about_weights(text, head, names));
    const std::string_view comma = number_with_comma(text, head);
    head.dialect.comma = !comma.empty();
    if (may_be_thousands(comma))
        head.notes.push_back(
            fmt::format("{} is read as {}, not as thousands", comma, with_point(comma)));
    // Files by stipple have default names next to pdf or weight, which need no notice.
    std::string measure;
    if (head.names && options.columns.empty() && !head.top.provenance.columns.empty())
        for (std::size_t c = 0; c < names.size(); ++c)
            if (head.columns.role[c] == Columns::checked) measure = names[c];
    if (!measure.empty())
        head.notes.push_back(
            fmt::format("the column '{}' is used as the {} of the points, not as a coordinate; "
                        "--column picks columns by name",
                        measure, measure == "pdf" ? "density" : measure));
    if (head.names && !row_names && !chosen && fields.size() > 1 && names[0] != "set" &&
        counts_rows(text, head.body, head.dialect.separator))
        head.notes.push_back(fmt::format(
            "the column '{}' counts the rows but is used as a coordinate; --column picks the "
            "others",
            names[0]));
    return head;
}

/// Stream of rows, parsed in parts of whole lines.
class DelimitedStream final : public PointStream {
  public:
    DelimitedStream(std::unique_ptr<Feed> feed, const TableHead& head, const SourceText& front,
                    const ReadOptions& options, const RunContext& run)
        : feed_(std::move(feed)),
          run_(run),
          source_(options.source),
          columns_(head.columns),
          dialect_(head.dialect),
          provenance_(head.top.provenance),
          names_(head.names),
          counted_(options.any_count),
          newline_(front.newline()) {
        const auto skipped = static_cast<std::size_t>(head.body - feed_->front().data());
        lines_ = front.line_of(head.body) - 1;
        text_.resize(skipped);
        feed_->read(text_);
        text_.clear();
    }

    std::size_t dimension() const override { return columns_.dimension; }
    const Provenance& provenance() const override { return provenance_; }

    std::vector<PointSet> read_all(const RunContext& run) override {
        auto sets = PointStream::read_all(run);
        tell_origin(sets, provenance_, numbers_);
        return sets;
    }

    /// With a header, a column holds the set numbers; without one, `#` lines separate the sets.
    bool looks_like_one_set() const override { return names_ && !numbered(); }

    bool next_set() override {
        if (!started_) return started_ = true;
        while (at_ == part_end() && !cut_here() && refill()) {
        }
        if (!cut_here()) return false;
        end_first_set();
        marks_.erase(marks_.begin());
        return true;
    }

    std::size_t read(std::span<double> rows) override {
        const std::size_t d = columns_.dimension;
        std::size_t done = 0;
        while (done < rows.size()) {
            if (cut_here() || (at_ == part_end() && !refill()) || cut_here()) break;
            const std::uint64_t end = marks_.empty() ? part_end() : marks_.front().row;
            const auto count = std::min<std::size_t>(end - at_, (rows.size() - done) / d);
            const auto from = std::span(rows_.numbers).subspan((at_ - part_begin_) * d, count * d);
            std::ranges::copy(from, rows.begin() + static_cast<std::ptrdiff_t>(done));
            done += count * d;
            at_ += count;
        }
        return done / d;
    }

  private:
    /// Boundary between two sets: its line, and the index of the first row after it.
    struct Cut {
        std::uint64_t row;
        std::size_t line;
    };

    std::uint64_t part_end() const {
        return part_begin_ + rows_.numbers.size() / columns_.dimension;
    }
    bool numbered() const { return columns_.has(Columns::set_number); }
    bool cut_here() const { return !marks_.empty() && marks_.front().row == at_; }

    /// Parses parts of the text until one has a row or a cut; returns false at the end of the text.
    bool refill() {
        while (at_ == part_end()) {
            if (!read_lines()) {
                if (last_cut_.row > 0 && last_cut_.row == part_end()) refuse_empty(last_cut_.line);
                end_first_set();
                return false;
            }
            parse();
            if (cut_here()) return true;
        }
        return true;
    }

    /// Moves the incomplete last line to the front of the buffer and reads more text. Returns false
    /// at the end.
    bool read_lines() {
        text_.erase(0, used_);
        used_ = 0;
        for (;;) {
            const std::size_t before = text_.size();
            text_.resize(before + Feed::front_size);
            const std::size_t got = feed_->read(std::span(text_).subspan(before));
            text_.resize(before + got);
            const auto last = text_.rfind(newline_);
            const bool end = got < Feed::front_size;
            used_ = end ? text_.size() : last == std::string::npos ? 0 : last + 1;
            if (used_ > 0 || end) return used_ > 0;
            run_.need_memory(static_cast<double>(text_.size()), "a line of " + source_);
        }
    }

    void parse() {
        part_begin_ = at_;
        const SourceText text(std::string_view(text_).substr(0, used_), source_, newline_, lines_);
        rows_ = read_rows(text, text.begin(), columns_, dialect_, run_);
        if (numbered()) cut_at_numbers(text);
        for (const Mark& mark : rows_.marks) {
            if (numbered()) break;
            const Cut cut{part_begin_ + mark.row, text.line_of(mark.at)};
            if (cut.row == 0) continue;  // a separator before the first point begins no set
            if (cut.row == last_cut_.row) refuse_empty(cut.line);
            marks_.push_back(cut);
            last_cut_ = cut;
        }
        lines_ = text.line_of(text.end()) - 1;
    }

    /// Adds a cut at each change of the set number. Rows of one set must be adjacent, unlike in a
    /// small file, since earlier rows are no longer available.
    void cut_at_numbers(const SourceText& text) {
        for (const Mark& mark : rows_.marks) {
            if (std::isnan(mark.number) || mark.number == number_) continue;
            const std::size_t line = text.line_of(mark.at);
            numbers_.push_back(static_cast<std::uint64_t>(mark.number));
            if (!seen_.insert(mark.number).second)
                fail_with_hint(ErrorKind::input, "sort the rows by their set",
                               "{}:{}:1: set {} begins again; in text of more than {} MiB the rows "
                               "of a set must be adjacent",
                               source_name(source_), line, mark.number, Feed::front_size >> 20);
            if (!std::isnan(number_)) marks_.push_back({part_begin_ + mark.row, line});
            number_ = mark.number;
        }
    }

    void end_first_set() {
        if (!std::exchange(counted_, true)) note_count(source_, provenance_, at_, run_);
    }

    [[noreturn]] void refuse_empty(std::size_t line) const {
        fail(ErrorKind::input,
             "{}:{}:1: a set without points; a line such as this separates two sets",
             source_name(source_), line);
    }

    std::unique_ptr<Feed> feed_;
    RunContext run_;
    std::string source_;
    Columns columns_;
    Dialect dialect_;
    Provenance provenance_;
    bool names_;
    bool counted_;  ///< the count of the first set was compared with the provenance
    char newline_;
    bool started_ = false;
    std::string text_;
    std::size_t used_ = 0;   ///< bytes of text_ already parsed
    std::size_t lines_ = 0;  ///< lines before the next part
    Rows rows_;
    std::uint64_t part_begin_ = 0;  ///< index of this part's first row in the stream
    std::uint64_t at_ = 0;          ///< index of the next row in the stream
    std::vector<Cut> marks_;
    Cut last_cut_{0, 0};
    double number_ = unknown;             ///< number of the current set, from the set column
    std::unordered_set<double> seen_;     ///< set numbers seen so far
    std::vector<std::uint64_t> numbers_;  ///< the same, in order
};

}  // namespace

std::vector<PointSet> read_delimited(std::string_view bytes, const ReadOptions& options,
                                     const RunContext& run) {
    const SourceText text(bytes, options.source);
    TableHead head = read_head(text, options);
    head.report(options.source, run);
    find_words(head, text, options.source, run);
    const Columns& columns = head.columns;
    Rows rows = read_rows(text, head.body, columns, head.dialect, run);
    if (rows.numbers.empty())
        text.refuse_whole(fmt::format(
            "the file holds only a header (line {}); expected points below it, one per line",
            head.dialect.model_line));
    if (columns.has(Columns::set_number))
        return gather_sets(std::move(rows.numbers), columns.dimension, std::move(rows.marks),
                           head.top.provenance);
    const auto starts = set_starts(text, rows, columns.dimension);
    return cut_sets(std::move(rows.numbers), columns.dimension, starts, head.top.provenance);
}

std::unique_ptr<PointStream> stream_delimited(std::unique_ptr<Feed>& feed,
                                              const ReadOptions& options, const RunContext& run) {
    const SourceText front(feed->front(), options.source);
    std::optional<TableHead> head;
    try {
        head = read_head(front, options);
    } catch (const Error&) {
        return nullptr;  // reading the whole text gives a better message
    }
    const bool cut_off = std::find(head->body, front.end(), front.newline()) == front.end();
    if (cut_off || head->words_to_find) return nullptr;
    head->report(options.source, run);
    return std::make_unique<DelimitedStream>(std::move(feed), *head, front, options, run);
}

}  // namespace stipple::io
