// SPDX-License-Identifier: MIT
#include "study/spec_list.hpp"

#include <algorithm>
#include <optional>
#include <unordered_set>

#include "core/error.hpp"
#include "core/text.hpp"

namespace stipple {
namespace {

/// Whether a number is a power of a base of 2 or more.
bool is_power(std::uint64_t number, std::uint64_t base) {
    while (number > 1 && number % base == 0) number /= base;
    return number == 1;
}

/// One item of a list: a number, or a range of them.
class CountRange {
  public:
    CountRange(std::string_view text, std::string_view who, std::uint64_t low, std::uint64_t high)
        : text_(trim(text)), who_(who), low_(low), high_(high) {}

    std::vector<std::uint64_t> numbers() const {
        const auto dots = text_.find("..");
        if (dots == std::string_view::npos) return {number(text_)};
        const std::uint64_t first = number(text_.substr(0, dots));
        const std::string_view rest = text_.substr(dots + 2);
        const auto mark = rest.find_first_of("*+", rest.starts_with('+') ? 1 : 0);
        const std::uint64_t last = number(rest.substr(0, mark));
        if (first > last)
            fail(ErrorKind::usage, "{}: the range '{}' is empty: {} is above {}", who_, text_,
                 first, last);
        if (first == last) return {first};
        if (mark == std::string_view::npos) return by_factor(first, last, base(first, last));
        const auto step = parse_unsigned(trim(rest.substr(mark + 1)));
        const bool factor = rest[mark] == '*';
        if (!step || *step < (factor ? 2 : 1))
            fail(ErrorKind::usage, "{}: '{}' in '{}' is not a {}", who_,
                 trim(rest.substr(mark + 1)), text_,
                 factor ? "factor of 2 or more" : "step of 1 or more");
        return factor ? by_factor(first, last, *step) : by_step(first, last, *step);
    }

  private:
    std::uint64_t number(std::string_view text) const {
        text = trim(text);
        if (text.empty())
            fail(ErrorKind::usage, "{}: a number is missing{}", who_,
                 text_.empty() ? "" : fmt::format(" in '{}'", text_));
        const auto value = parse_unsigned(text);
        if (!value)
            fail(ErrorKind::usage,
                 "{}: '{}' is not a whole number such as 1000, 1e6, 2^20 or 64k, nor a range such "
                 "as 2^4..2^16, 16..65536*2 or 10..50+10",
                 who_, text);
        if (*value < low_ || *value > high_)
            fail(ErrorKind::usage, "{}: {} is outside [{}, {}]", who_, text, low_, high_);
        return *value;
    }

    /// The base that is written: 2 of 2^4..2^16.
    std::uint64_t base(std::uint64_t first, std::uint64_t last) const {
        const auto mark = text_.find('^');
        const auto end = text_.substr(0, mark);
        const auto begin = end.find_last_of(". ") + 1;  // 0 where there is none
        const auto written = mark == std::string_view::npos ? std::optional<std::uint64_t>()
                                                            : parse_unsigned(end.substr(begin));
        if (written && *written > 1 && is_power(first, *written) && is_power(last, *written))
            return *written;
        const auto step = std::max<std::uint64_t>(1, (last - first) / 8);
        fail_with_hint(
            ErrorKind::usage,
            fmt::format("{}..{}*2 goes by a factor, {}..{}+{} by a step, 2^4..2^16 by powers",
                        first, last, first, last, step),
            "{}: '{}' does not say which numbers between", who_, text_);
    }

    static std::vector<std::uint64_t> by_factor(std::uint64_t first, std::uint64_t last,
                                                std::uint64_t factor) {
        std::vector<std::uint64_t> list = {first};
        while (list.back() <= last / factor) list.push_back(list.back() * factor);
        return list;
    }

    std::vector<std::uint64_t> by_step(std::uint64_t first, std::uint64_t last,
                                       std::uint64_t step) const {
        constexpr std::uint64_t most = 1'000'000;
        if ((last - first) / step >= most)
            fail(ErrorKind::usage, "{}: the range '{}' has more than {} numbers", who_, text_,
                 most);
        std::vector<std::uint64_t> list = {first};
        while (step <= last - list.back()) list.push_back(list.back() + step);
        return list;
    }

    std::string_view text_;
    std::string_view who_;
    std::uint64_t low_;
    std::uint64_t high_;
};

}  // namespace

std::vector<std::uint64_t> parse_counts(std::string_view text, std::string_view who,
                                        std::uint64_t low, std::uint64_t high) {
    std::vector<std::uint64_t> all;
    std::unordered_set<std::uint64_t> seen;
    const auto items = split(text, ',');
    if (trim(text).empty()) fail(ErrorKind::usage, "{}: there are no numbers", who);
    for (const auto item : items)
        for (const std::uint64_t number : CountRange(item, who, low, high).numbers()) {
            if (!seen.insert(number).second)
                fail(ErrorKind::usage, "{}: {} stands twice in '{}'", who, number, text);
            all.push_back(number);
        }
    return all;
}

}  // namespace stipple
