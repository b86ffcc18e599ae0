// SPDX-License-Identifier: MIT
//
// One JSON object with all points:
//
//     {"format":"stipple.points","version":1,"meta":{...},"dimension":2,"count":2,"points":[
//     [0,0],
//     [0.5,0.25]
//     ]}
//
// Several sets are "sets":[[[0,0],[0.5,0.25]],...] instead of the points; `count` then applies to
// each set, or is a list if they differ. Rows with extras have "columns". The reader accepts the
// keys in any order and ignores unknown ones. It also accepts a bare [[x,y],...] and records
// [{"x":0,"y":0},...].
//
// The points are parsed here, since the JSON library takes eight times as long and cannot locate a
// malformed point; everything else is left to it.
//
// Cost    45 ns per number on one core; memory for the points in addition to the file.
// Source  T. Bray, RFC 8259, 2017.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/json.hpp"
#include "core/text.hpp"
#include "io/columns.hpp"
#include "io/decimal.hpp"
#include "io/format.hpp"
#include "io/formats/json_head.hpp"
#include "io/source_text.hpp"

namespace stipple::io::json {
namespace {

void head(const Layout& layout, std::string& out) {
    out +=
        json_head(layout, layout.counts) + (layout.many_sets() ? ",\"sets\":[" : ",\"points\":[");
}

void begin_set(const Layout& layout, std::size_t set, std::string& out) {
    if (layout.many_sets()) out += set > 0 ? "\n],[" : "[";
}

void rows(const Layout& layout, std::size_t, std::uint64_t first, std::span<const double> numbers,
          std::string& out) {
    const std::size_t width = layout.width();
    if (first == 0 && !numbers.empty()) {
        append_rows(out, numbers.first(width), width, {"\n[", ",", "]"}, layout.precision);
        numbers = numbers.subspan(width);
    }
    append_rows(out, numbers, width, {",\n[", ",", "]"}, layout.precision);
}

void tail(const Layout& layout, std::string& out) {
    out += layout.many_sets() ? "\n]]}\n" : "\n]}\n";
}

class Reader {
  public:
    Reader(const SourceText& text, const RunContext& run)
        : text_(text), run_(run), p_(text.begin()), last_(text.end()) {}

    void read() {
        skip_blanks();
        if (p_ != last_ && *p_ == '[')
            read_bare();
        else
            read_object();
        skip_blanks();
        if (p_ != last_)
            text_.refuse(p_, shown(word()) + " follows the points; expected the end of the file");
        if (starts.empty())
            text_.refuse_whole(
                "the object has neither \"points\" nor \"sets\"; expected "
                "\"points\":[[0.1,0.2],...]");
    }

    /// Checks that all records have numbers in the coordinate columns. @throws Error(input)
    void require_numbers(const Columns& columns) {
        for (std::size_t c = 0; c < words_.size(); ++c)
            if (words_[c] != nullptr && columns.role[c] < columns.dimension) {
                p_ = words_[c];
                refuse("a finite number, or --column with the names of other columns");
            }
    }

    JsonHead head;
    std::size_t width = 0;
    std::vector<double> numbers;
    std::vector<std::uint64_t> starts;

  private:
    void skip_blanks() {
        while (p_ != last_ && (*p_ == ' ' || *p_ == '\n' || *p_ == '\r' || *p_ == '\t')) ++p_;
    }

    /// The word at the cursor, for messages.
    [[nodiscard]] std::string_view word() const {
        const char* end = std::find_if(p_, last_, [](char c) {
            return c == ',' || c == ']' || c == '}' || c == ':' || c == '\n' || c == '\r' ||
                   c == ' ';
        });
        if (end == p_ && p_ != last_) ++end;
        return {p_, static_cast<std::size_t>(end - p_)};
    }

    [[noreturn]] void refuse(const std::string& expected) const {
        if (p_ == last_) text_.refuse(p_, "the file ends too soon; expected " + expected);
        text_.refuse(p_, "found " + shown(word()) + "; expected " + expected);
    }

    /// Skips blanks and consumes `c`; returns false if another character follows.
    bool accept(char c) {
        skip_blanks();
        if (p_ == last_ || *p_ != c) return false;
        ++p_;
        return true;
    }

    void expect(char c, const char* expected) {
        if (!accept(c)) refuse(expected);
    }

    /// Reads a bare list: [[0,1],...], [[[0,1],...],...] or [{"x":0,"y":1},...].
    void read_bare() {
        const char* const begin = p_;
        std::size_t depth = 0;
        while (accept('[')) ++depth;
        const bool records = depth == 1 && p_ != last_ && *p_ == '{';
        p_ = begin;
        if (records)
            read_records();
        else if (depth >= 3)
            read_sets();
        else
            read_points();
    }

    void read_records() {
        expect('[', "a list of records");
        starts.push_back(0);
        do {
            read_record();
            if (numbers.size() / width % 8192 == 0) run_.check_stop();
        } while (accept(','));
        expect(']', "',' or ']'");
    }

    /// Parses a record into the columns named by the first record; remembers values that are not
    /// numbers.
    void read_record() {
        expect('{', "a record such as {\"x\":0.1,\"y\":0.2}");
        const char* const begin = p_ - 1;
        const bool first = width == 0;
        std::vector<bool> seen(width);
        const std::size_t row = numbers.size();
        numbers.resize(row + width);
        std::size_t count = 0;
        do {
            skip_blanks();
            const std::string_view key = read_key();
            const std::size_t c = first ? add_name(key) : column_of(key, count);
            if (first) numbers.push_back(0);
            if (!first && seen[c]) text_.refuse(key.data(), "the name occurs twice");
            if (!first) seen[c] = true;
            expect(':', "':'");
            skip_blanks();
            const bool number = p_ != last_ && (*p_ == '-' || (*p_ >= '0' && *p_ <= '9'));
            if (!number && words_[c] == nullptr) words_[c] = p_;
            if (number)
                numbers[row + c] = read_coordinate();
            else
                skip_value();
            ++count;
        } while (accept(','));
        expect('}', "',' or '}'");
        if (first) width = count;
        if (first) reserve_for(begin);
        if (count != width)
            text_.refuse(begin, fmt::format("the record has {} of the {} names of the first record",
                                            count, width));
    }

    /// Adds a name of the first record; returns its index.
    std::size_t add_name(std::string_view key) {
        if (std::ranges::find(keys_, key) != keys_.end())
            text_.refuse(key.data(), "the name occurs twice");
        keys_.push_back(key);
        words_.push_back(nullptr);
        head.columns.push_back(
            parse_piece(text_, {key.data() - 1, key.size() + 2}).get<std::string>());
        return keys_.size() - 1;
    }

    /// Index of a name of the first record. Tries `place` first: the order is usually the same.
    [[nodiscard]] std::size_t column_of(std::string_view key, std::size_t place) const {
        if (place < keys_.size() && keys_[place] == key) return place;
        const auto it = std::ranges::find(keys_, key);
        if (it == keys_.end())
            text_.refuse(key.data(), shown(key) + " is not a name of the first record");
        return static_cast<std::size_t>(it - keys_.begin());
    }

    /// Reserves memory for all rows at once, assuming that each has as many characters as the
    /// first.
    void reserve_for(const char* begin) {
        const auto rows = (last_ - begin) / std::max<std::ptrdiff_t>(p_ - begin, 1) + 1;
        const std::size_t room = static_cast<std::size_t>(rows) * width;
        run_.need_memory(8 * static_cast<double>(room), "reading " + text_.source());
        numbers.reserve(room);
    }

    void read_object() {
        expect('{', "{\"format\":\"stipple.points\",...} or [[0.1,0.2],...]");
        if (accept('}')) return;
        do {
            skip_blanks();
            const std::string_view key = read_key();
            expect(':', "':'");
            skip_blanks();
            if (key == "points" || key == "sets") {
                if (!starts.empty()) text_.refuse(p_, "points occur twice; expected them once");
                key == "points" ? read_points() : read_sets();
            } else {
                const char* const at = p_;
                take_key(text_, at, key, parse_piece(text_, skip_value()), head);
            }
        } while (accept(','));
        expect('}', "',' or '}'");
    }

    std::string_view read_key() {
        const char* const begin = p_;
        if (p_ == last_ || *p_ != '"') refuse("a key such as \"points\"");
        skip_string();
        return {begin + 1, static_cast<std::size_t>(p_ - begin - 2)};
    }

    void skip_string() {
        for (++p_; p_ != last_ && *p_ != '"'; ++p_)
            if (*p_ == '\\' && ++p_ == last_) break;
        if (p_ == last_) refuse("a closing quote");
        ++p_;
    }

    /// Skips a value and returns its text, for the JSON library to parse. Returns all remaining
    /// text if the value is nested too deep, so that the library reports it.
    std::string_view skip_value() {
        const std::string_view rest(p_, last_);
        const auto [size, too_deep] = json_extent(rest);
        const std::string_view piece = rest.substr(0, size);
        p_ += piece.size();
        if (size == rest.npos && too_deep == rest.npos) refuse("',' or '}'");
        return piece;
    }

    void read_sets() {
        expect('[', "a list of sets");
        do read_points();
        while (accept(','));
        expect(']', "',' or ']'");
    }

    void read_points() {
        expect('[', "a list of points such as [[0.1,0.2],...]");
        const char* const begin = p_;
        starts.push_back(width == 0 ? 0 : numbers.size() / width);
        if (accept(']')) text_.refuse(begin, "a set without points; expected [0.1,0.2],...");
        std::size_t count = 0;
        do {
            read_point();
            if (++count % 8192 == 0) run_.check_stop();
        } while (accept(','));
        expect(']', "',' or ']'");
    }

    void read_point() {
        expect('[', "a point such as [0.1,0.2]");
        const char* const begin = p_ - 1;
        const std::size_t size = numbers.size();
        do numbers.push_back(read_coordinate());
        while (accept(','));
        expect(']', "',' or ']'");
        const std::size_t found = numbers.size() - size;
        if (width == 0) {
            width = found;
            reserve_for(begin);
        }
        if (found != width)
            text_.refuse(begin, fmt::format("the point has {} coordinate{}; expected {}, as the "
                                            "first has",
                                            found, found == 1 ? "" : "s", width));
    }

    double read_coordinate() {
        skip_blanks();
        double value = 0;
        const char* const digit = p_ != last_ && *p_ == '-' ? p_ + 1 : p_;
        const bool number = digit != last_ && *digit >= '0' && *digit <= '9';
        const char* const end = number ? read_number(p_, last_, value) : nullptr;
        if (end == nullptr) refuse("a finite number");
        if (!std::isfinite(value))
            text_.refuse(p_, shown(word()) +
                                 " is beyond the largest double, 1.8e308; expected a "
                                 "finite number");
        p_ = end;
        return value;
    }

    const SourceText& text_;
    const RunContext& run_;
    const char* p_;
    const char* last_;
    std::vector<std::string_view> keys_;  ///< names in the first record, still escaped
    std::vector<const char*> words_;      ///< for each column, the first value that is not a number
};

/// Marks where the first column, the number of the set, changes. @throws Error(input)
std::vector<Mark> marks_of(const SourceText& text, std::span<const double> table,
                           std::size_t width) {
    std::vector<Mark> marks;
    for (std::size_t i = 0; i < table.size(); i += width) {
        if (!is_set_number(table[i]))
            text.refuse_whole(
                fmt::format("point {}: {} is not the number of a set; expected 0, 1, 2...",
                            i / width, table[i]));
        if (i == 0 || table[i] != table[i - width])
            marks.push_back({.row = i / width, .at = text.begin(), .number = table[i]});
    }
    return marks;
}

std::vector<PointSet> read(std::string_view bytes, const ReadOptions& options,
                           const RunContext& run) {
    const SourceText text(bytes, options.source);
    Reader reader(text, run);
    reader.read();
    const Columns columns = json_columns(text, reader.head, reader.width, options, run);
    reader.require_numbers(columns);
    std::vector<Mark> marks;
    if (columns.has(Columns::set_number) && reader.starts.size() == 1)
        marks = marks_of(text, reader.numbers, reader.width);
    std::vector<double> numbers = keep_coordinates(std::move(reader.numbers), columns);
    const std::size_t d = columns.dimension;
    const Provenance& provenance = reader.head.provenance;
    auto sets = marks.empty() ? cut_sets(std::move(numbers), d, reader.starts, provenance)
                              : gather_sets(std::move(numbers), d, std::move(marks), provenance);
    std::vector<std::uint64_t> counts;
    for (const PointSet& set : sets) counts.push_back(set.count());
    if (!options.any_count) check_counts(text, reader.head, counts);
    return sets;
}

}  // namespace

Format unit() {
    return {.name = "json",
            .summary = "One JSON object with provenance and all points",
            .source = "RFC 8259",
            .extensions = {".json"},
            .traits = {.counts_first = true},
            .head = head,
            .begin_set = begin_set,
            .rows = rows,
            .tail = tail,
            .read = read};
}

}  // namespace stipple::io::json
