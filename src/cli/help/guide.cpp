// SPDX-License-Identifier: MIT
#include "cli/help/guide.hpp"

#include <algorithm>
#include <cassert>
#include <string_view>

#include "core/text.hpp"

namespace stipple::cli {
namespace {

std::string heading_of(std::string_view page) {
    return std::string(page.substr(2, page.find('\n') - 2));
}

std::string trimmed(std::string_view text) { return std::string(trim(text)); }

}  // namespace

const std::vector<Topic>& topics() {
    static const auto all = [] {
        std::vector<Topic> found;
        for (const GuidePage& page : guide())
            if (!std::string_view(page.name).starts_with("verbs/"))
                found.push_back({page.name, heading_of(page.text), page.text});
        return found;
    }();
    return all;
}

VerbPage verb_page(const std::string& verb) {
    const auto page = std::ranges::find_if(
        guide(), [name = "verbs/" + verb](const GuidePage& each) { return name == each.name; });
    assert(page != guide().end());
    const std::string_view all = page->text;
    const std::string_view usage = all.substr(all.find("\n\n    ") + 2);
    const std::string_view rest = usage.substr(usage.find("\n\n"));
    constexpr std::string_view examples = "\n\n## Examples\n\n";
    const auto end = rest.find(examples);
    VerbPage found{.summary = heading_of(all).substr(verb.size() + 2),
                   .usage = trimmed(usage.substr(0, usage.find('\n'))),
                   .text = trimmed(rest.substr(0, end)),
                   .examples = {}};
    for (const auto line : split(rest.substr(end + examples.size()), '\n'))
        if (!trim(line).empty()) found.examples += trimmed(line) + "\n";
    return found;
}

}  // namespace stipple::cli
