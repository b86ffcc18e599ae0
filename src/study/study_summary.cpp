// SPDX-License-Identifier: MIT
#include "study/study_summary.hpp"

#include <cmath>

#include "core/text.hpp"

namespace stipple {
namespace {

TableCell word(const char* name, std::string text) { return {name, std::move(text)}; }
TableCell whole(const char* name, std::uint64_t value) {
    return {name, std::to_string(value), true};
}
TableCell real(const char* name, double value) {
    return {name, std::isnan(value) ? "" : format_number(value), true};
}

std::vector<TableCell> mean_cells(const StudyRow& row, const SampleSummary& s,
                                  std::uint64_t failures, double confidence, const Interval& t,
                                  const Interval& boot) {
    return {word("table", "mean"),
            word("generator", row.generator),
            whole("dimension", row.dimension),
            word("warps", row.warps),
            whole("count", row.count),
            word("measure", row.measure),
            word("domain", row.domain),
            word("key", row.key),
            whole("sets", s.count),
            whole("failed", failures),
            real("mean", s.mean),
            real("standard_error", s.standard_error),
            real("median", s.median),
            real("standard_deviation", s.deviation),
            real("confidence", confidence),
            real("t_low", t.low),
            real("t_high", t.high),
            real("bootstrap_low", boot.low),
            real("bootstrap_high", boot.high),
            word("study", row.study)};
}

/// Values of the seeds that both samples have.
struct Paired {
    std::vector<double> a;
    std::vector<double> b;
};

Paired paired(const std::vector<std::uint64_t>& seeds_a, const std::vector<double>& a,
              const std::vector<std::uint64_t>& seeds_b, const std::vector<double>& b) {
    Paired both;
    for (std::size_t i = 0, j = 0; i < a.size(); ++i) {
        while (j < b.size() && seeds_b[j] < seeds_a[i]) ++j;
        if (j == b.size() || seeds_b[j] != seeds_a[i]) continue;
        both.a.push_back(a[i]);
        both.b.push_back(b[j]);
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

std::string StudySummary::means(TableStyle style, const SummaryOptions& options,
                                const RunContext& run) const {
    std::string text;
    const auto add = [&](const StudyRow& row, std::span<const double> values,
                         std::uint64_t stream) {
        const SampleSummary s = summarize(values);
        const auto boot = bootstrap_interval(values, options.confidence, options.resamples,
                                             options.seed, stream, run);
        const auto& failed = failed_.at({row.generator, row.dimension, row.count, row.measure});
        const auto cells = mean_cells(row, s, failed.sets, options.confidence,
                                      t_interval(s, options.confidence), boot);
        if (text.empty()) text = table_head(style, cells);
        text += table_line(style, cells);
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

std::string StudySummary::comparisons(TableStyle style, const SummaryOptions& options,
                                      const RunContext& run) const {
    const auto cells_of_pair = [&](const Pair& pair) -> std::vector<TableCell> {
        const auto& [a, b, sets_a, sets_b, test, p_holm] = pair;
        const StudyRow& row = a->row;
        return {word("table", "comparison"),
                whole("dimension", row.dimension),
                word("warps", row.warps),
                whole("count", row.count),
                word("measure", row.measure),
                word("key", row.key),
                word("generator_a", row.generator),
                word("generator_b", b->row.generator),
                word("method", options.paired ? "paired" : "welch"),
                whole("sets_a", sets_a),
                whole("sets_b", sets_b),
                real("difference", test.difference),
                real("standard_error", test.standard_error),
                real("t", test.t),
                real("degrees_of_freedom", test.degrees),
                real("p_value", test.p_value),
                real("p_holm", p_holm),
                word("study", row.study)};
    };
    const Sample none{};  // where there are no pairs, the table has its names alone
    std::string text = table_head(style, cells_of_pair({&none, &none}));
    std::map<std::pair<std::string, std::string>, bool> same;  // whether two never differ
    for (const Topic& topic : topics_in_order_) {
        run.check_stop();
        for (const Pair& pair : pairs_of(topic, options.paired)) {
            text += table_line(style, cells_of_pair(pair));
            bool& never =
                same.emplace(std::pair(pair.a->row.generator, pair.b->row.generator), true)
                    .first->second;
            never = never && pair.a->values == pair.b->values && pair.a->seeds == pair.b->seeds;
        }
    }
    for (const auto& [generators, never] : same)
        if (never)
            run.notify(
                fmt::format("{} and {} have the same values everywhere: their sets may be "
                            "the same points",
                            generators.first, generators.second));
    return text;
}

}  // namespace stipple
