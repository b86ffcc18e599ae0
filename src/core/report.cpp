// SPDX-License-Identifier: MIT
#include "stipple/report.hpp"

#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "core/text.hpp"

namespace stipple {
namespace {

/// The result of type T under the key; `kind` names the type in messages.
/// @throws Error(usage) if it is missing or of another type
template <class T>
const T& held(const Report& report, std::string_view key, std::string_view kind) {
    const Report::Item* item = report.find(key);
    const T* value = item ? std::get_if<T>(item) : nullptr;
    if (item && value == nullptr) fail(ErrorKind::usage, "the result '{}' is not a {}", key, kind);
    if (value == nullptr)
        fail_with_hint(ErrorKind::usage, suggest(key, report.keys()),
                       "there is no {} '{}' among the results", kind, key);
    return *value;
}

}  // namespace

// Not defaulted: clang would never finish compiling the comparison, which recurs through Item.
bool Report::operator==(const Report& other) const {
    return entries_ == other.entries_ && unmet_ == other.unmet_;
}

Report& Report::put(std::string_view name, Item value, std::string_view unit) {
    const auto it = std::ranges::find(entries_, name, &Entry::name);
    if (it == entries_.end())
        entries_.push_back({std::string(name), std::move(value), std::string(unit)});
    else
        *it = {std::string(name), std::move(value), std::string(unit)};
    return *this;
}

const Report::Item* Report::find(std::string_view key) const {
    for (const auto& [name, value, unit] : entries_) {
        if (name == key) return &value;  // tested first, as a name may contain dots
        const auto* group = std::get_if<Report>(&value);
        if (group == nullptr || !key.starts_with(name) || key.substr(name.size(), 1) != ".")
            continue;
        if (const Item* item = group->find(key.substr(name.size() + 1))) return item;
    }
    return nullptr;
}

Report::Item* Report::find(std::string_view key) {
    return const_cast<Item*>(std::as_const(*this).find(key));
}

double Report::number(std::string_view key) const {
    const Item* item = find(key);
    if (item)
        if (const auto* whole = std::get_if<std::int64_t>(item)) return static_cast<double>(*whole);
    return held<double>(*this, key, "number");
}

const std::string& Report::text(std::string_view key) const {
    return held<std::string>(*this, key, "word");
}

const Report::Curve& Report::curve(std::string_view key) const {
    return held<Curve>(*this, key, "curve");
}

std::vector<std::string> Report::keys() const {
    std::vector<std::string> keys;
    for (const auto& [name, value, unit] : entries_) {
        if (const auto* group = std::get_if<Report>(&value)) {
            for (const auto& inner : group->keys()) keys.push_back(name + "." + inner);
        } else if (!std::holds_alternative<Grid>(value)) {
            keys.push_back(name);
        }
    }
    return keys;
}

}  // namespace stipple
