// SPDX-License-Identifier: MIT
//
// A page of help in one of two styles: plain text for terminals, or man(7) for man.
#pragma once

#include <string>
#include <string_view>

namespace stipple::cli {

class HelpPage {
  public:
    enum class Style { text, man };

    explicit HelpPage(Style style) : style_(style) {}

    [[nodiscard]] bool for_man() const { return style_ == Style::man; }

    /// What the page is about; `number` is the section of the manual.
    void title(const std::string& name, int number, const std::string& summary,
               const std::string& usage = {});
    void section(const std::string& name);
    void subsection(const std::string& name);
    void paragraph(const std::string& text);
    /// An option, a verb or a result with what it is.
    void entry(const std::string& tag, const std::string& help);
    /// Lines as they stand.
    void lines(std::string_view text);
    /// The pages of all verbs and topics but this one; in the manual only.
    void see_also(const std::string& but);

    [[nodiscard]] const std::string& text() const { return text_; }

  private:
    Style style_;
    std::string text_;
};

}  // namespace stipple::cli
