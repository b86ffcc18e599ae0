// SPDX-License-Identifier: MIT
//
// Measurements as people and programs read them: text, JSON (format stipple.report, version 1),
// CSV.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/json.hpp"
#include "stipple/report.hpp"

namespace stipple {

/// One analyzer's results on one set, or the mean over several.
struct Measurement {
    std::string analyzer;
    std::string source;
    std::optional<std::size_t> set =
        {};                           ///< number of the set in its file, where there are several
    std::size_t sets = 1;             ///< sets that the results are the mean of
    std::uint64_t count = 0;          ///< of a mean over sets of different sizes, the smallest
    std::uint64_t largest_count = 0;  ///< of such a mean; else 0
    std::size_t dimension = 0;
    std::string domain;
    std::vector<std::string> columns = {};  ///< names of the coordinates, where they have any
    std::vector<std::pair<std::string, std::string>> options = {};
    Report results = {};
    std::optional<Report> standard_error = {};  ///< of a mean
    double seconds = 0;
};

/// The number under a key of a report; nothing where there is none.
std::optional<double> number_at(const Report& report, std::string_view key);

/// The list of numbers under a key; nothing where there is none.
std::optional<Report::Curve> list_at(const Report& report, std::string_view key);

/// An item for people: long lists are cut short and say so; nothing for grids and groups.
std::string text_of(const Report::Item& item);

/// An object; numbers that JSON cannot hold (infinities) become null in its text.
Json json_of(const Report& report);

/// An object of options, numbers and flags as such.
Json json_of(const std::vector<std::pair<std::string, std::string>>& options);

/// One object for one measurement, an array for several; ends with a newline.
std::string to_json(std::span<const Measurement> measurements);

struct TextStyle {
    /// Long lists stand in tables below, those of one group and length side by side; else they are cut
    /// short, and say so.
    bool full = false;
    /// What stands below the line of a result, with its ends of lines; empty: nothing.
    std::function<std::string(const Measurement&, const std::string& key)> below = {};
};

/// Names, values and units in aligned columns.
std::string to_text(std::span<const Measurement> measurements, const TextStyle& style = {});

/// Whether the bytes are JSON of reports as far as their front tells: an object, or an array of
/// objects, that names the format.
bool looks_like_reports(std::string_view bytes);

/// The way back from to_json: the measurements of one report, of an array of them, or of several
/// texts one after the other. null is NaN. `source` is for messages.
/// @throws Error(input) for what is no such JSON, and for none at all.
std::vector<Measurement> read_reports(std::string_view bytes, const std::string& source);

/// A tidy table: a row for each measurement, or for each entry of its curves; nested keys are
/// dotted, and numbers of other lists have columns KEY.0, KEY.1... (csv_table.cpp). The standard
/// errors of a mean are columns, too: standard_error.KEY.
std::string to_csv(std::span<const Measurement> measurements);

}  // namespace stipple
