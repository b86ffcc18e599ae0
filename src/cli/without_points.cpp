// SPDX-License-Identifier: MIT
#include "cli/without_points.hpp"

#include "core/error.hpp"
#include "study/study_table.hpp"

namespace stipple::cli {
namespace {

/// A row of a study, its sums, or what compares them.
bool is_study(std::string_view front) {
    using Style = StudyTable::Style;
    const auto line = front.substr(0, front.find('\n'));
    for (const Style style : {Style::csv, Style::jsonl})
        if (StudyTable(style, true).is_head(line)) return true;
    return line.starts_with("table,generator,") || line.starts_with("table,dimension,");
}

}  // namespace

void refuse_without_points(const std::string& name, std::string_view front) {
    const auto top = front.substr(0, 1000);
    const auto has = [top](std::string_view words) {
        return top.find(words) != std::string_view::npos;
    };
    const auto is = [&](const char* format) {
        return (top.starts_with('[') || top.starts_with('{')) && has(fmt::format("\"{}\"", format));
    };
    const auto refuse = [&name](const char* what, std::string hint) {
        fail_with_hint(ErrorKind::input, std::move(hint), "{}: {}", name, what);
    };
    if (is("stipple.report") || top.starts_with("analyzer,source,"))
        refuse(
            "it holds results of analyze, and names the points that they are of, but not how these "
            "were made",
            "reproduce takes files of points");
    if (is("stipple.comparison") || has("name=\"generator\" content=\"stipple"))
        refuse("a report about points, which it does not hold",
               "it names the command that makes it again, and those that make its points");
    if (is("stipple.study-journal"))
        refuse("the journal of a study that is not finished, without points",
               "the same 'stipple study' with --resume goes on");
    if (is_study(front))
        refuse("a table of a study, without points",
               "'stipple generate' with a row's generator, its options, count, dimension, warps "
               "and seed makes the points of that row again");
    if (is("stipple.meta"))
        refuse("it says how the points in the file beside it were made",
               "reproduce takes the file of points");
    if (has("<!DOCTYPE html") || has("<html")) refuse("an HTML page, which holds no points", {});
}

}  // namespace stipple::cli
