// SPDX-License-Identifier: MIT
//
// What an analyzer found: named values in order, nested where they belong together.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace stipple {

/// A picture's worth of numbers, row after row; written to files of its own, never into tables.
struct Grid {
    std::size_t rows = 0;
    std::size_t columns = 0;
    std::vector<double> values;
    bool operator==(const Grid&) const = default;
};

class Report {
  public:
    struct Entry;
    using Curve = std::vector<double>;
    using Integers = std::vector<std::int64_t>;
    using Item =
        std::variant<bool, std::int64_t, double, std::string, Curve, Integers, Grid, Report>;

    Report() = default;

    /// Adds a value under `name`; an entry that is there already is replaced. A unit may be named.
    Report& add(std::string_view name, bool value);
    Report& add(std::string_view name, std::int64_t value, std::string_view unit = {});
    Report& add(std::string_view name, std::uint64_t value, std::string_view unit = {});
    Report& add(std::string_view name, double value, std::string_view unit = {});
    Report& add(std::string_view name, const char* value);
    Report& add(std::string_view name, std::string value);
    Report& add(std::string_view name, Curve value, std::string_view unit = {});
    Report& add(std::string_view name, Integers value, std::string_view unit = {});
    Report& add(std::string_view name, Grid value);
    Report& add(std::string_view name, Report value);

    [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }
    [[nodiscard]] std::vector<Entry>& entries() { return entries_; }

    /// The item under a dotted key, "worst_box.volume"; nullptr if there is none.
    [[nodiscard]] const Item* find(std::string_view dotted_key) const;
    [[nodiscard]] Item* find(std::string_view dotted_key);

    /// @throws Error(usage) when there is no number under the key.
    [[nodiscard]] double number(std::string_view dotted_key) const;
    [[nodiscard]] const std::string& text(std::string_view dotted_key) const;
    [[nodiscard]] const Curve& curve(std::string_view dotted_key) const;

    /// Dotted keys of all that is not a grid or a group.
    [[nodiscard]] std::vector<std::string> keys() const;

    /// An expectation that the user stated (--expect) and that does not hold.
    void unmet(std::string sentence) { unmet_.push_back(std::move(sentence)); }
    void forget_unmet() { unmet_.clear(); }
    [[nodiscard]] const std::vector<std::string>& unmet() const { return unmet_; }

    bool operator==(const Report&) const;

  private:
    Report& put(std::string_view name, Item value, std::string_view unit);

    std::vector<Entry> entries_;
    std::vector<std::string> unmet_;
};

struct Report::Entry {
    std::string name;
    Item value;
    std::string unit;
    bool operator==(const Entry&) const = default;
};

}  // namespace stipple
