// SPDX-License-Identifier: MIT
#include "media/points_file.hpp"

#include <fmt/format.h>

#include "core/text.hpp"

namespace stipple {
namespace {

/// Takes one line after the other apart into numbers.
class LineReader {
  public:
    LineReader(TokenFile& file, std::vector<double>& numbers) : file_(file), numbers_(numbers) {}

    /// Appends the numbers of the next line; how many they are.
    std::size_t read() {
        const std::size_t before = numbers_.size();
        comma_ = {};
        separated_ = true;
        do take_fields(file_.next("a coordinate"));
        while (!file_.at_line_end());
        if (!comma_.text.empty()) file_.refuse(comma_, "no coordinate follows this comma");
        return numbers_.size() - before;
    }

    /// The part of a token before its first comma.
    static Token first_field(const Token& token) {
        return {token.text.substr(0, token.text.find(',')), token.line, token.column};
    }

  private:
    /// A token is fields with commas between them; a comma may also stand at its ends, next to
    /// blanks, but not two commas without a number between.
    void take_fields(const Token& token) {
        std::size_t at = 0;
        for (const auto text : split(token.text, ',')) {
            const Token field{text, token.line, token.column + at};
            if (at > 0) take_comma({token.text.substr(at - 1, 1), token.line, field.column - 1});
            if (!text.empty()) take_number(field);
            at += text.size() + 1;
        }
    }

    void take_comma(const Token& comma) {
        if (separated_) file_.refuse(comma, "a comma without a coordinate before it");
        comma_ = comma;
        separated_ = true;
    }

    void take_number(const Token& field) {
        const auto value = parse_number(field.text);
        if (!value)
            file_.refuse(field, fmt::format("{} is not a finite number; expected a coordinate",
                                            TokenFile::shown(field)));
        numbers_.push_back(*value);
        comma_ = {};
        separated_ = false;
    }

    TokenFile& file_;
    std::vector<double>& numbers_;
    Token comma_;             ///< the last one, while nothing has followed it
    bool separated_ = false;  ///< no number stands before the place reached
};

/// Rows of numbers, and which of them begin a group.
struct Lines {
    std::vector<double> numbers;
    std::size_t dimension = 0;
    std::vector<std::size_t> groups;
};

/// Passes the line of names that may be on top. @throws Error(input) where no points follow.
void pass_names(TokenFile& file) {
    // A line that does not begin with a number is one of names; only the first may be.
    if (!file.at_end() && !parse_number(LineReader::first_field(file.peek()).text)) {
        const Token first = LineReader::first_field(file.peek());
        if (first.text == "set") file.refuse(first, "several sets of points; expected one");
        if (!first.text.empty() && first.text.find_first_of("{[\x93") != std::string_view::npos)
            file.refuse(first, "neither names nor numbers; expected text, a point a line");
        file.skip_line();
    }
    if (file.at_end()) file.refuse_whole("no points; expected a point a line");
}

Lines read_lines(TokenFile& file, const RunContext& run) {
    pass_names(file);
    Lines rows;
    LineReader lines(file, rows.numbers);
    rows.groups.push_back(0);
    std::size_t last_line = file.peek().line;
    rows.dimension = lines.read();
    for (std::size_t i = 1; !file.at_end(); ++i) {
        if (i % 4096 == 0) run.check_stop();
        const Token first = file.peek();
        if (first.line > last_line + 1) rows.groups.push_back(i);
        last_line = first.line;
        const std::size_t found = lines.read();
        if (found != rows.dimension)
            file.refuse(first, fmt::format("{} coordinates in this line; expected {}, as before",
                                           found, rows.dimension));
    }
    return rows;
}

}  // namespace

PointSet read_points(TokenFile& file, const RunContext& run) {
    Lines rows = read_lines(file, run);
    return {std::move(rows.numbers), rows.dimension};
}

PointSet read_points(const std::string& path, const RunContext& run) {
    TokenFile file(path);
    return read_points(file, run);
}

std::vector<PointSet> read_point_groups(TokenFile& file, const RunContext& run) {
    const Lines rows = read_lines(file, run);
    std::vector<PointSet> groups;
    for (std::size_t g = 0; g < rows.groups.size(); ++g) {
        const std::size_t first = rows.groups[g] * rows.dimension;
        const std::size_t last =
            g + 1 < rows.groups.size() ? rows.groups[g + 1] * rows.dimension : rows.numbers.size();
        groups.emplace_back(std::vector(rows.numbers.begin() + static_cast<std::ptrdiff_t>(first),
                                        rows.numbers.begin() + static_cast<std::ptrdiff_t>(last)),
                            rows.dimension);
    }
    return groups;
}

}  // namespace stipple
