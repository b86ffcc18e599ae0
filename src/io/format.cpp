// SPDX-License-Identifier: MIT
#include "io/format.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <numeric>

#include "core/bytes/compression.hpp"
#include "core/error.hpp"
#include "core/json.hpp"
#include "core/text.hpp"

namespace stipple {

std::vector<std::string> coordinate_names(std::size_t dimension) {
    if (dimension <= 3) {
        const std::vector<std::string> xyz{"x", "y", "z"};
        return {xyz.begin(), xyz.begin() + static_cast<std::ptrdiff_t>(dimension)};
    }
    std::vector<std::string> names;
    for (std::size_t k = 1; k <= dimension; ++k) names.push_back(fmt::format("x{}", k));
    return names;
}

std::vector<std::string> coordinate_names(std::size_t dimension, const Provenance& provenance) {
    const auto& kept = provenance.columns;
    return kept.size() == dimension ? kept : coordinate_names(dimension);
}

Counts Counts::equal(std::uint64_t sets, std::uint64_t each) {
    Counts counts;
    counts.sets_ = sets;
    counts.first_ = each;
    return counts;
}

void Counts::push_back(std::uint64_t count) {
    if (sets_ == 0) first_ = count;
    if (all_.empty() && count != first_) all_.assign(sets_, first_);
    if (!all_.empty()) all_.push_back(count);
    ++sets_;
}

std::uint64_t Counts::total() const {
    return all_.empty() ? sets_ * first_
                        : std::accumulate(all_.begin(), all_.end(), std::uint64_t{0});
}

Counts Counts::part(std::uint64_t first, std::uint64_t last) const {
    if (all_.empty()) return equal(last - first, first_);
    Counts counts;
    for (std::uint64_t set = first; set < last; ++set) counts.push_back(all_[set]);
    return counts;
}

std::vector<std::string> Layout::columns() const {
    std::vector<std::string> names = coordinate_names(dimension, provenance);
    names.insert(names.end(), extras.begin(), extras.end());
    return names;
}

namespace io {
namespace {

/// Distinguishes JSON lines from a single JSON value, for text that begins with { or [.
const char* json_or_lines(std::string_view text) {
    const auto end = text.find('\n');
    const std::string_view line = trim(text.substr(0, end));
    const bool whole = json_extent(line).size == line.size();
    const std::string_view inner = trim(line.substr(1));
    const bool nested = inner.starts_with('[') || inner.starts_with('{');
    if (whole && line.front() == '[' && !nested) return "jsonl";
    const bool more = end != std::string_view::npos && !trim(text.substr(end)).empty();
    return more && whole ? "jsonl" : "json";
}

}  // namespace

std::string extension_of(std::string_view path) {
    std::filesystem::path name(path);
    if (compression_of_name(path) != Compression::none) name.replace_extension();
    return lower_case(name.extension().string());
}

void require_extension(std::string_view path, std::span<const std::string> known,
                       const std::string& hint) {
    const std::string extension = path.starts_with("/dev/") ? "" : extension_of(path);
    if (extension.empty() || std::ranges::find(known, extension) != known.end()) return;
    fail_with_hint(ErrorKind::usage, hint, "--output: unknown extension '{}'; known: {}", extension,
                   join(known, " "));
}

const Format& format_named(std::string_view name) {
    const auto it = std::ranges::find(all(), name, &Format::name);
    if (it != all().end()) return *it;
    std::vector<std::string> names;
    for (const Format& format : all()) names.push_back(format.name);
    fail_with_hint(ErrorKind::usage, suggest(name, names), "unknown format '{}'", name);
}

const Format* format_of_extension(std::string_view path) {
    const std::string extension = extension_of(path);
    const auto it = std::ranges::find_if(all(), [&](const Format& format) {
        return std::ranges::find(format.extensions, extension) != format.extensions.end();
    });
    return it == all().end() ? nullptr : &*it;
}

bool extension_is_single(std::string_view path) { return extension_of(path) == ".f32"; }

const Format& format_of_bytes(std::string_view bytes) {
    if (bytes.starts_with("\x93NUMPY")) return format_named("npy");
    if (bytes.starts_with("UTK!")) return format_named("utk");
    if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
    constexpr std::string_view blanks = " \t\r\n";
    const auto first = bytes.find_first_not_of(blanks);
    if (first == std::string_view::npos || (bytes[first] != '{' && bytes[first] != '['))
        return format_named("csv");
    return format_named(json_or_lines(bytes.substr(first)));
}

}  // namespace io
}  // namespace stipple
