// SPDX-License-Identifier: MIT
//
// Text assembled from the named parts of a library. Lines of a part that begin with % control it:
//
//     %part NAME            begins a part
//     %need NAME            puts another part before this one, once
//     %if KEY [VALUE ...]   the lines until %end, or else those after %else, if KEY has one of
//                           these values, or any value if none is named
//     %use KEY ...          counts as a use of KEY; see used()
//     %limit KEY MOST       refuses larger values of KEY
//     %refuse SENTENCE      ends with this error
//
// In other lines, {{KEY}} is replaced by its value, @@ by the prefix of all names, and @name by
// prefix_name. If a value has several lines, the text before {{KEY}} is repeated in each of them.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace stipple::emit {

using Words = std::map<std::string, std::string, std::less<>>;

class Template {
  public:
    /// @param library text with the parts; must outlive the template
    Template(std::string_view library, std::string prefix);

    [[nodiscard]] bool has(std::string_view part) const { return parts_.contains(part); }

    /// Appends a part to the text, after those that it needs.
    /// @throws Error(usage) for refused values
    void add(std::string_view part, const Words& words);

    /// Parts so far, with blank lines between them.
    [[nodiscard]] const std::string& text() const { return text_; }

    /// Returns the text of a part; appends only the parts that it needs.
    [[nodiscard]] std::string filled(std::string_view part, const Words& words);

    /// Whether a line has used the key.
    [[nodiscard]] bool used(std::string_view key) const { return used_.contains(key); }

    std::string gap = "\n";  ///< text between parts

  private:
    [[nodiscard]] std::string replaced(std::string_view line, const Words& words);
    [[nodiscard]] const std::string* find(std::string_view key, const Words& words);
    bool holds(std::string_view condition, const Words& words);
    void control(std::string_view line, const Words& words);

    std::map<std::string_view, std::string_view> parts_;
    std::string prefix_;
    std::string text_;
    std::set<std::string_view> needed_;
    std::set<std::string, std::less<>> used_;
};

}  // namespace stipple::emit
