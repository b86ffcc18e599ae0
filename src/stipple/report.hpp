// SPDX-License-Identifier: MIT
//
// Results of an analyzer: named values in order, grouped if they belong together.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace stipple {

/// Matrix of numbers in row-major order, to be drawn as a picture; written to a file of its own,
/// never into tables.
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

    /// Adds a value under `name`, or replaces the entry that already has this name. `unit` is its
    /// unit of measurement.
    template <class T>
    Report& add(std::string_view name, T value, std::string_view unit = {});

    [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }
    [[nodiscard]] std::vector<Entry>& entries() { return entries_; }

    /// The item under a dotted key, "worst_box.volume"; nullptr if there is none.
    [[nodiscard]] const Item* find(std::string_view dotted_key) const;
    [[nodiscard]] Item* find(std::string_view dotted_key);

    /// The item of the returned type under a key. @throws Error(usage) if there is none
    [[nodiscard]] double number(std::string_view dotted_key) const;
    [[nodiscard]] const std::string& text(std::string_view dotted_key) const;
    [[nodiscard]] const Curve& curve(std::string_view dotted_key) const;

    /// Dotted keys of all items except grids and groups.
    [[nodiscard]] std::vector<std::string> keys() const;

    /// Records an expectation of the user (--expect) that does not hold.
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

template <class T>
Report& Report::add(std::string_view name, T value, std::string_view unit) {
    if constexpr (std::is_integral_v<T> && !std::is_same_v<T, bool>)
        return put(name, static_cast<std::int64_t>(value), unit);
    else if constexpr (std::is_convertible_v<T, std::string>)
        return put(name, std::string(std::move(value)), unit);
    else
        return put(name, std::move(value), unit);
}

}  // namespace stipple
