// SPDX-License-Identifier: MIT
#include "io/source_text.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace stipple::io {

std::string source_name(std::string_view source) {
    return std::string(source == "-" ? "stdin" : source);
}

void refuse_empty(std::string_view source, std::string_view expected) {
    if (source == "-")
        fail_with_hint(ErrorKind::input, "did the command before it in the pipe fail?",
                       "stdin: no input; expected {}", expected);
    fail(ErrorKind::input, "{}: the file is empty; expected {}", source, expected);
}

SourceText::SourceText(std::string_view bytes, std::string_view source)
    : bytes_(bytes), source_(source_name(source)) {
    using namespace std::string_view_literals;
    if (bytes.starts_with("\xFF\xFE"sv) || bytes.starts_with("\xFE\xFF"sv))
        refuse_whole("the text is in UTF-16; expected ASCII or UTF-8",
                     "iconv -f UTF-16 -t UTF-8 converts it");
    if (bytes.starts_with("\x1F\x8B"sv))
        refuse_whole("the file is compressed; expected plain points", "unpack it: gunzip, zcat");
    if (bytes_.starts_with("\xEF\xBB\xBF"sv)) bytes_.remove_prefix(3);
    if (bytes_.empty()) refuse_empty(source, "points, one per line");
    if (bytes_.find('\n') == std::string_view::npos) newline_ = '\r';
}

SourceText::SourceText(std::string_view bytes, std::string_view source, char newline,
                       std::size_t lines_before)
    : bytes_(bytes), source_(source_name(source)), newline_(newline), lines_before_(lines_before) {}

std::size_t SourceText::line_of(const char* at) const {
    return lines_before_ + 1 + static_cast<std::size_t>(std::count(begin(), at, newline_));
}

void SourceText::refuse(const char* at, const std::string& what, std::string hint) const {
    const char* line = at;
    while (line != begin() && line[-1] != newline_) --line;
    throw Error(ErrorKind::input,
                fmt::format("{}:{}:{}: {}", source_, line_of(at), at - line + 1, what),
                std::move(hint));
}

void SourceText::refuse_whole(const std::string& what, std::string hint) const {
    throw Error(ErrorKind::input, fmt::format("{}: {}", source_, what), std::move(hint));
}

const char* first_control_byte(std::string_view line) {
    const auto it = std::ranges::find_if(line, [](char c) {
        return (static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == 0x7F;
    });
    return it == line.end() ? nullptr : &*it;
}

}  // namespace stipple::io
