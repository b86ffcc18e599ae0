// SPDX-License-Identifier: MIT
#include "plot/study_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "core/error.hpp"
#include "core/text.hpp"
#include "plot/drawing/ticks.hpp"
#include "study/sweep.hpp"

namespace stipple::plot {
namespace {

/// The result that a panel shows.
struct Topic {
    std::string measure;
    std::string key;
    std::uint64_t dimension;
    friend bool operator==(const Topic&, const Topic&) = default;
};

Topic topic_of(const MeanRow& row) { return {row.measure, row.key, row.dimension}; }

Series series_of(const std::string& generator, const Topic& topic, bool errors,
                 std::span<const MeanRow> means) {
    std::vector<const MeanRow*> rows;
    for (const MeanRow& row : means)
        if (row.generator == generator && topic_of(row) == topic && std::isfinite(row.mean))
            rows.push_back(&row);
    std::ranges::sort(rows, {}, [](const MeanRow* row) { return row->count; });
    Series series{.name = generator, .marks = true};
    for (const MeanRow* row : rows) {
        series.x.push_back(static_cast<double>(row->count));
        series.y.push_back(errors ? row->rms : row->mean);
        series.low.push_back(errors ? row->rms_low : row->t_low);
        series.high.push_back(errors ? row->rms_high : row->t_high);
    }
    name_slope(series);
    return series;
}

/// Distinct texts in order of appearance.
template <class Text>
std::vector<std::string> distinct(std::span<const MeanRow> means, const Text& text) {
    std::vector<std::string> found;
    std::set<std::string> known;
    for (const MeanRow& row : means)
        if (known.insert(text(row)).second) found.push_back(text(row));
    return found;
}

std::string unit_of(const Topic& topic) { return topic.measure.substr(0, topic.measure.find(':')); }

/// Key of a topic in words, such as "cube error"; for the key "value", the analyzer's name.
std::string key_of(const Topic& topic) {
    std::string_view key = topic.key;
    if (last_part(key) == "value") key.remove_suffix(std::min<std::size_t>(6, key.size()));
    return words_of(key.empty() ? unit_of(topic) : std::string(key));
}

/// Name of a topic: key, and what differs between the topics: "centered (l2 discrepancy), d = 2".
std::string name_of(const Topic& topic, std::span<const Topic> all) {
    const auto differ = [&](const auto& property) {
        return std::ranges::any_of(
            all, [&](const Topic& other) { return property(other) != property(topic); });
    };
    const std::string unit = words_of(unit_of(topic));
    std::string name = key_of(topic);
    if (differ(unit_of) && name != unit) name += fmt::format(" ({})", unit);
    const bool options = std::ranges::any_of(all, [&](const Topic& other) {
        return other.measure != topic.measure && unit_of(other) == unit_of(topic);
    });
    if (options) name += topic.measure.substr(unit_of(topic).size());
    if (differ([](const Topic& t) { return t.dimension; }))
        name += fmt::format(", d = {}", topic.dimension);
    return name;
}

/// Topics with this key or, if there are none, with keys that contain it as a part. If `key` is
/// empty: topics with keys that end in "value", then all topics of measures without such keys.
std::vector<Topic> topics_of(std::span<const MeanRow> means, const std::string& key) {
    const bool whole = std::ranges::count(means, key, &MeanRow::key) > 0;
    const auto is_value = [](const Topic& topic) { return last_part(topic.key) == "value"; };
    std::set<std::string> valued;
    for (const MeanRow& row : means)
        if (is_value(topic_of(row))) valued.insert(row.measure);
    std::vector<Topic> topics;
    for (const MeanRow& row : means) {
        const Topic topic = topic_of(row);
        const bool wanted = key.empty() ? is_value(topic) || !valued.contains(row.measure)
                            : whole     ? row.key == key
                                        : names_result(row.key, key);
        if (!wanted || !std::isfinite(row.mean)) continue;
        if (std::ranges::find(topics, topic) == topics.end()) topics.push_back(topic);
    }
    std::stable_partition(topics.begin(), topics.end(), is_value);
    return topics;
}

/// Panel of a topic, with one curve per generator. A generator has one colour in all panels.
ChartPanel panel_of(const Topic& topic, const std::string& name, std::span<const MeanRow> means) {
    const bool errors = is_error_key(topic.key);
    ChartPanel panel{
        .x_name = "points n", .y_name = (errors ? "RMS of " : "") + name, .log_x = true};
    double low = HUGE_VAL;
    double high = 0;
    const auto generators = distinct(means, [](const auto& row) { return row.generator; });
    for (std::size_t i = 0; i < generators.size(); ++i) {
        Series series = series_of(generators[i], topic, errors, means);
        series.set = i;
        for (const double y : series.y) {
            low = std::min(low, y);
            high = std::max(high, y);
        }
        if (!series.x.empty()) panel.series.push_back(std::move(series));
    }
    panel.log_y = low > 0 && high > 1.5 * low;
    if (panel.log_y) panel.guides = falling_guides(panel.series[0]);
    return panel;
}

/// Subtitle: number of sets behind each mean, and confidence of the intervals.
std::string notes_of(std::span<const MeanRow> means) {
    const auto [least, most] =
        std::ranges::minmax(means, {}, [](const MeanRow& row) { return row.sets; });
    if (most.sets < 2) return {};
    std::string text = fmt::format("means of {} sets", most.sets);
    if (least.sets != most.sets) text = fmt::format("means of up to {} sets", most.sets);
    if (std::isfinite(most.confidence))
        text += fmt::format(", with {} % intervals", rounded(100 * most.confidence));
    return text;
}

}  // namespace

StudyChart study_chart(std::span<const MeanRow> means, const std::string& key) {
    constexpr std::size_t most_panels = 4;
    const auto keys = distinct(means, [](const auto& row) { return row.key; });
    const auto topics = topics_of(means, key);
    if (topics.empty() && !key.empty())
        fail_with_hint(ErrorKind::usage, suggest(key, keys), "--key: the study has no result '{}'",
                       key);
    if (topics.empty()) fail(ErrorKind::input, "the study has no numbers to draw");
    StudyChart found;
    for (const Topic& topic : topics) {
        if (found.chart.panels.size() < most_panels)
            found.chart.panels.push_back(panel_of(topic, name_of(topic, topics), means));
        else if (std::ranges::find(found.left_out, topic.key) == found.left_out.end())
            found.left_out.push_back(topic.key);
    }
    const auto alike = [&](const auto& property) {
        return std::ranges::all_of(
            topics, [&](const Topic& t) { return property(t) == property(topics[0]); });
    };
    found.chart.title = alike(unit_of) ? capitalised(words_of(unit_of(topics[0]))) : "Study";
    // A single curve has no legend.
    if (const auto generators = distinct(means, [](const auto& row) { return row.generator; });
        generators.size() == 1)
        found.chart.title += " of " + generators[0];
    found.chart.subtitle = notes_of(means);
    if (alike([](const Topic& t) { return t.dimension; }))
        found.chart.subtitle =
            fmt::format("d = {}{}{}", topics[0].dimension,
                        found.chart.subtitle.empty() ? "" : " · ", found.chart.subtitle);
    return found;
}

}  // namespace stipple::plot
