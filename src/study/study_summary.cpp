// SPDX-License-Identifier: MIT
#include "study/study_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/json.hpp"
#include "core/text.hpp"
#include "study/statistics.hpp"

namespace stipple {
namespace {

/// A cell of a table: a word, or the text of a number.
struct TableCell {
    const char* name;
    std::string text;
    bool number = false;
};

TableCell word(const char* name, std::string text) { return {name, std::move(text)}; }
TableCell whole(const char* name, std::uint64_t value) {
    return {name, std::to_string(value), true};
}
TableCell real(const char* name, double value) {
    return {name, std::isnan(value) ? "" : format_number(value), true};
}

std::string json_cell(const TableCell& cell) {
    const bool finite = cell.text.empty() || cell.text.find("inf") == std::string::npos;
    if (cell.number && cell.text.empty()) return "null";
    if (cell.number && finite) return cell.text;
    return Json(cell.text).dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// A line of the table; in CSV, with the names before the first one.
std::string line_of(StudyTable::Style style, const std::vector<TableCell>& cells, bool first) {
    std::string names;
    std::string line;
    for (const TableCell& cell : cells) {
        if (&cell != &cells.front()) {
            names += ',';
            line += ',';
        }
        names += cell.name;
        line += style == StudyTable::Style::csv
                    ? csv_field(cell.text)
                    : fmt::format("\"{}\":{}", cell.name, json_cell(cell));
    }
    if (style == StudyTable::Style::jsonl) return fmt::format("{{{}}}\n", line);
    return first ? fmt::format("{}\n{}\n", names, line) : line + "\n";
}

/// Values of the seeds that both samples have.
struct Paired {
    std::vector<double> a;
    std::vector<double> b;
};

Paired paired(const std::vector<std::uint64_t>& seeds_a, const std::vector<double>& a,
              const std::vector<std::uint64_t>& seeds_b, const std::vector<double>& b) {
    Paired both;
    for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
        if (seeds_a[i] == seeds_b[j]) {
            both.a.push_back(a[i]);
            both.b.push_back(b[j]);
        }
        const bool forward_a = seeds_a[i] <= seeds_b[j];
        const bool forward_b = seeds_b[j] <= seeds_a[i];
        i += forward_a;
        j += forward_b;
    }
    return both;
}

}  // namespace

void StudySummary::add(const StudyRow& row) {
    auto& failed = failed_[{row.generator, row.dimension, row.count, row.measure}];
    if (row.failed()) {
        failed.row = row;
        ++failed.sets;
        return;
    }
    failed.some_went_well = true;
    const Topic topic{row.dimension, row.count, row.measure, row.key};
    const auto [it, fresh] = places_.try_emplace({row.generator, topic}, samples_.size());
    if (fresh) {
        auto& members = topics_[topic];
        if (members.empty()) topics_in_order_.push_back(topic);
        members.push_back(samples_.size());
        samples_.push_back({row});
    }
    Sample& sample = samples_[it->second];
    sample.seeds.push_back(row.seed);
    sample.values.push_back(row.value.value_or(std::nan("")));
}

std::uint64_t StudySummary::failures_of(const StudyRow& row) const {
    const auto it = failed_.find({row.generator, row.dimension, row.count, row.measure});
    return it == failed_.end() ? 0 : it->second.sets;
}

std::string StudySummary::means(StudyTable::Style style, const SummaryOptions& options,
                                const RunContext& run) const {
    std::string text;
    const auto add = [&](const StudyRow& row, std::span<const double> values,
                         std::uint64_t stream) {
        const SampleSummary s = summarize(values);
        const Interval t = t_interval(s, options.confidence);
        const Interval boot = bootstrap_interval(values, options.confidence, options.resamples,
                                                 options.seed, stream, run);
        text += line_of(style,
                        {word("table", "mean"),
                         word("generator", row.generator),
                         whole("dimension", row.dimension),
                         word("warps", row.warps),
                         whole("count", row.count),
                         word("measure", row.measure),
                         word("domain", row.domain),
                         word("key", row.key),
                         whole("sets", s.count),
                         whole("failed", failures_of(row)),
                         real("mean", s.mean),
                         real("standard_error", s.standard_error),
                         real("median", s.median),
                         real("standard_deviation", s.deviation),
                         real("confidence", options.confidence),
                         real("t_low", t.low),
                         real("t_high", t.high),
                         real("bootstrap_low", boot.low),
                         real("bootstrap_high", boot.high),
                         word("study", row.study)},
                        text.empty());
    };
    for (std::size_t i = 0; i < samples_.size(); ++i) add(samples_[i].row, samples_[i].values, i);
    for (const auto& [cell, failed] : failed_)
        if (!failed.some_went_well) add(failed.row, {}, 0);
    return text;
}

std::vector<StudySummary::Pair> StudySummary::pairs_of(const Topic& topic, bool by_seed) const {
    std::vector<Pair> pairs;
    std::vector<double> p_values;
    const auto& members = topics_.at(topic);
    for (std::size_t i = 0; i < members.size(); ++i)
        for (std::size_t j = i + 1; j < members.size(); ++j) {
            const Sample& a = samples_[members[i]];
            const Sample& b = samples_[members[j]];
            const Paired both = paired(a.seeds, a.values, b.seeds, b.values);
            const auto& x = by_seed ? both.a : a.values;
            const auto& y = by_seed ? both.b : b.values;
            pairs.push_back(
                {&a, &b, x.size(), y.size(), by_seed ? paired_test(x, y) : welch_test(x, y)});
            p_values.push_back(pairs.back().test.p_value);
        }
    const auto corrected = holm(p_values);
    for (std::size_t k = 0; k < pairs.size(); ++k) pairs[k].p_holm = corrected[k];
    return pairs;
}

std::string StudySummary::comparisons(StudyTable::Style style, const SummaryOptions& options,
                                      const RunContext& run) const {
    const auto line = [&](const Pair& pair, bool first) {
        const auto& [a, b, sets_a, sets_b, test, p_holm] = pair;
        const StudyRow& row = a->row;
        return line_of(
            style,
            {word("table", "comparison"), whole("dimension", row.dimension),
             word("warps", row.warps), whole("count", row.count), word("measure", row.measure),
             word("key", row.key), word("generator_a", row.generator),
             word("generator_b", b->row.generator),
             word("method", options.paired ? "paired" : "welch"), whole("sets_a", sets_a),
             whole("sets_b", sets_b), real("difference", test.difference),
             real("standard_error", test.standard_error), real("t", test.t),
             real("degrees_of_freedom", test.degrees), real("p_value", test.p_value),
             real("p_holm", p_holm), word("study", row.study)},
            first);
    };
    std::string text;
    for (const Topic& topic : topics_in_order_) {
        run.check_stop();
        for (const Pair& pair : pairs_of(topic, options.paired)) text += line(pair, text.empty());
    }
    if (!text.empty() || style == StudyTable::Style::jsonl) return text;
    const Sample none{};  // there are no pairs: the table has its names alone
    const std::string names = line({&none, &none, 0, 0, {}, 0}, true);
    return names.substr(0, names.find('\n') + 1);
}

}  // namespace stipple
