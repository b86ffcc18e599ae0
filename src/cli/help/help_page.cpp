// SPDX-License-Identifier: MIT
#include "cli/help/help_page.hpp"

#include <fmt/format.h>

#include <cctype>
#include <utility>
#include <vector>

#include "cli/help/guide.hpp"
#include "cli/parsing/verb_options.hpp"
#include "core/text.hpp"

namespace stipple::cli {
namespace {

/// A text as roff takes it: backslashes and dashes as they stand, no line taken for a request.
std::string escaped(std::string_view text) {
    std::string out(text);
    for (const auto& [plain, roff] : {std::pair{"\\", "\\e"},
                                      {"-", "\\-"},
                                      {"'", "\\(aq"},
                                      {"`", "\\(ga"},
                                      {"^", "\\(ha"},
                                      {"~", "\\(ti"},
                                      {"\n.", "\n\\&."}})
        replace_all(out, plain, roff);
    return out.starts_with('.') ? "\\&" + out : out;
}

std::string upper(std::string text) {
    for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return text;
}

}  // namespace

void HelpPage::title(const std::string& name, int number, const std::string& summary,
                     const std::string& usage) {
    if (!for_man()) {
        text_ += fmt::format("{}: {}\n\nUsage: {}\n", name, summary, usage);
        return;
    }
    text_ +=
        fmt::format(".TH {} {} \"\" \"stipple {}\" \"stipple manual\"\n.SH NAME\n{} \\- {}\n",
                    escaped(upper(name)), number, STIPPLE_VERSION, escaped(name), escaped(summary));
    if (!usage.empty()) {
        section("Synopsis");
        lines(usage);
    }
    section("Description");
}

void HelpPage::section(const std::string& name) {
    text_ +=
        for_man() ? fmt::format(".SH {}\n", escaped(upper(name))) : fmt::format("\n{}:\n", name);
}

void HelpPage::subsection(const std::string& name) {
    text_ += for_man() ? fmt::format(".SS {}\n", escaped(name)) : fmt::format("\n{}:\n", name);
}

void HelpPage::paragraph(const std::string& text) {
    text_ += for_man() ? fmt::format(".P\n{}\n", escaped(text)) : fmt::format("\n{}\n", text);
}

void HelpPage::entry(const std::string& tag, const std::string& help) {
    if (for_man())
        text_ += fmt::format(".TP\n.B {}\n{}\n", escaped(trim(tag)), escaped(help));
    else if (tag.size() <= 26)
        text_ += fmt::format("  {:<26}  {}\n", tag, help);
    else
        text_ += fmt::format("  {}\n  {:<26}  {}\n", tag, "", help);
}

void HelpPage::lines(std::string_view text) {
    const std::string ended = std::string(text) + (text.ends_with('\n') ? "" : "\n");
    text_ += for_man() ? ".nf\n" + escaped(ended) + ".fi\n" : ended;
}

void HelpPage::see_also(const std::string& but) {
    if (!for_man()) return;
    std::vector<std::string> pages;
    const auto add = [&](const std::string& page, int number) {
        if (page != but) pages.push_back(fmt::format(".BR {} ({})", escaped(page), number));
    };
    add("stipple", 1);
    for (const VerbInfo& info : verbs()) add("stipple-" + info.name, 1);
    for (const Topic& topic : topics()) add("stipple-" + topic.name, 7);
    section("See also");
    text_ += join(pages, ",\n") + "\n";
}

}  // namespace stipple::cli
