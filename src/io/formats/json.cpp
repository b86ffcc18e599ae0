// SPDX-License-Identifier: MIT
//
// One JSON object with all points:
//
//     {"format":"stipple.points","version":1,"meta":{...},"dimension":2,"count":2,"points":[
//     [0,0],
//     [0.5,0.25]
//     ]}
//
// Several sets stand as "sets":[[[0,0],[0.5,0.25]],...] in place of the points; `count` is then
// that of each set, or a list where they differ. Rows with extras name their "columns". The reader
// takes the keys in any order, ignores those that it does not know, and takes a bare [[x,y],...]
// too.
//
// The points are scanned here rather than by the JSON library, which takes eight times as long for
// them and cannot say where a point stands that is not like the others; all else is left to it.
//
// Cost    45 ns a number on one core; memory for the points beside the file's bytes.
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

    JsonHead head;
    std::size_t width = 0;
    std::vector<double> numbers;
    std::vector<std::uint64_t> starts;

  private:
    void skip_blanks() {
        while (p_ != last_ && (*p_ == ' ' || *p_ == '\n' || *p_ == '\r' || *p_ == '\t')) ++p_;
    }

    /// What stands at the cursor, for messages.
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

    /// Takes `c`, or leaves the cursor.
    bool accept(char c) {
        skip_blanks();
        if (p_ == last_ || *p_ != c) return false;
        ++p_;
        return true;
    }

    void expect(char c, const char* expected) {
        if (!accept(c)) refuse(expected);
    }

    /// [[0,1],...] or [[[0,1],...],...]
    void read_bare() {
        const char* const begin = p_;
        std::size_t depth = 0;
        while (accept('[')) ++depth;
        p_ = begin;
        if (depth >= 3)
            read_sets();
        else
            read_points();
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
                if (!starts.empty())
                    text_.refuse(p_, "points for a second time; expected them once");
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

    /// The text of a value that is not ours to scan; all that is left, where it is too deep.
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
            // A first row as long as the others makes this the only allocation.
            const auto rows = (last_ - begin) / std::max<std::ptrdiff_t>(p_ - begin, 1) + 1;
            const std::size_t room = static_cast<std::size_t>(rows) * width;
            run_.need_memory(8 * static_cast<double>(room), "reading " + text_.source());
            numbers.reserve(room);
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
};

std::vector<PointSet> read(std::string_view bytes, const ReadOptions& options,
                           const RunContext& run) {
    const SourceText text(bytes, options.source);
    Reader reader(text, run);
    reader.read();
    const Columns columns = json_columns(text, reader.head, reader.width, options);
    std::vector<double> numbers = keep_coordinates(std::move(reader.numbers), columns);
    std::vector<PointSet> sets =
        cut_sets(std::move(numbers), columns.dimension, reader.starts, reader.head.provenance);
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
