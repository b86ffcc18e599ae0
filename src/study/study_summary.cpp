// SPDX-License-Identifier: MIT
#include "study/study_summary.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/text.hpp"
#include "report/latex.hpp"
#include "study/sweep.hpp"
#include "study/table_columns.hpp"
#include "study/unit_runner.hpp"

namespace stipple {
namespace {

/// Visits the columns of a row of means in order: name and field.
template <class Row, class Visit>
void for_each_column(Row& row, const Visit& visit) {
    visit("table", row.table);
    visit("generator", row.generator);
    visit("dimension", row.dimension);
    visit("warps", row.warps);
    visit("count", row.count);
    visit("measure", row.measure);
    visit("domain", row.domain);
    visit("key", row.key);
    visit("sets", row.sets);
    visit("failed", row.failed);
    visit("mean", row.mean);
    visit("standard_error", row.standard_error);
    visit("median", row.median);
    visit("standard_deviation", row.standard_deviation);
    visit("rms", row.rms);
    visit("rms_low", row.rms_low);
    visit("rms_high", row.rms_high);
    visit("confidence", row.confidence);
    visit("t_low", row.t_low);
    visit("t_high", row.t_high);
    visit("bootstrap_low", row.bootstrap_low);
    visit("bootstrap_high", row.bootstrap_high);
    visit("study", row.study);
}

std::vector<TableCell> cells_of(const MeanRow& row) {
    return columns::cells_of([&](const auto& visit) { for_each_column(row, visit); });
}

MeanRow mean_of(const StudyRow& first, std::span<const double> values, std::uint64_t failed,
                double confidence) {
    const SampleSummary s = summarize(values);
    const Interval t = t_interval(s, confidence);
    MeanRow row{.generator = first.generator,
                .dimension = first.dimension,
                .warps = first.warps,
                .count = first.count,
                .measure = first.measure,
                .domain = first.domain,
                .key = first.key,
                .sets = s.count,
                .failed = failed,
                .mean = s.mean,
                .standard_error = s.standard_error,
                .median = s.median,
                .standard_deviation = s.deviation,
                .confidence = confidence,
                .t_low = t.low,
                .t_high = t.high,
                .study = first.study};
    row.rms = root_mean_square(values);
    if (is_error_key(first.key)) {
        const Interval rms = rms_interval(values, confidence);
        row.rms_low = rms.low;
        row.rms_high = rms.high;
    }
    return row;
}

/// Values of two samples, for the seeds that are in both.
struct Paired {
    std::vector<double> a;
    std::vector<double> b;
};

Paired paired(const std::vector<std::uint64_t>& seeds_a, const std::vector<double>& a,
              const std::vector<std::uint64_t>& seeds_b, const std::vector<double>& b) {
    std::map<std::uint64_t, double> of_seed;
    for (std::size_t j = 0; j < b.size(); ++j) of_seed.emplace(seeds_b[j], b[j]);
    Paired both;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (const auto found = of_seed.find(seeds_a[i]); found != of_seed.end()) {
            both.a.push_back(a[i]);
            both.b.push_back(found->second);
        }
    return both;
}

}  // namespace

bool is_error_key(std::string_view key) { return key.substr(key.rfind('.') + 1) == "error"; }

void StudySummary::add(const StudyRow& row) {
    auto& failed = failed_[{row.generator, row.dimension, row.count, row.measure}];
    if (row.failed()) {
        failed.row = row;
        ++failed.sets;
        return;
    }
    failed.some_went_well = true;
    const Topic topic{row.dimension, row.count, row.measure, row.key};
    const std::size_t number = topic_numbers_.try_emplace(topic, topics_.size()).first->second;
    if (number == topics_.size()) topics_.emplace_back();
    auto& members = topics_[number];
    auto member = std::ranges::find(members, row.generator,
                                    [&](std::size_t i) { return samples_[i].row.generator; });
    if (member == members.end()) {
        member = members.insert(member, samples_.size());
        samples_.push_back({row});
    }
    Sample& sample = samples_[*member];
    sample.seeds.push_back(row.seed);
    sample.values.push_back(row.value.value_or(std::nan("")));
}

std::vector<MeanRow> StudySummary::mean_rows(const SummaryOptions& options,
                                             const RunContext& run) const {
    std::vector<MeanRow> rows;
    const auto add = [&](const StudyRow& first, std::span<const double> values,
                         std::uint64_t stream) {
        const auto& failed =
            failed_.at({first.generator, first.dimension, first.count, first.measure});
        MeanRow& row = rows.emplace_back(mean_of(first, values, failed.sets, options.confidence));
        if (options.resamples == 0) return;
        const auto boot = bootstrap_interval(values, options.confidence, options.resamples,
                                             options.seed, stream, run);
        row.bootstrap_low = boot.low;
        row.bootstrap_high = boot.high;
    };
    for (std::size_t i = 0; i < samples_.size(); ++i) add(samples_[i].row, samples_[i].values, i);
    for (const auto& [cell, failed] : failed_)
        if (!failed.some_went_well) add(failed.row, {}, 0);
    return rows;
}

std::string StudySummary::means(TableStyle style, const SummaryOptions& options,
                                const RunContext& run) const {
    const auto rows = mean_rows(options, run);
    std::string text = rows.empty() ? "" : table_head(style, cells_of(MeanRow()));
    for (const MeanRow& row : rows) text += table_line(style, cells_of(row));
    return text;
}

std::vector<StudySummary::Pair> StudySummary::pairs_of(const std::vector<std::size_t>& members,
                                                       bool by_seed) const {
    std::vector<Pair> pairs;
    std::vector<double> p_values;
    std::vector<std::vector<double>> values;
    for (const std::size_t member : members) {
        values.push_back(samples_[member].values);
        if (is_error_key(samples_[member].row.key))
            for (double& error : values.back()) error = std::abs(error);
    }
    for (std::size_t i = 0; i < members.size(); ++i)
        for (std::size_t j = i + 1; j < members.size(); ++j) {
            const Sample& a = samples_[members[i]];
            const Sample& b = samples_[members[j]];
            const Paired both = paired(a.seeds, values[i], b.seeds, values[j]);
            const auto& x = by_seed ? both.a : values[i];
            const auto& y = by_seed ? both.b : values[j];
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
    const auto cells_of_pair = [&](const Pair& pair) {
        const StudyRow& row = pair.a->row;
        const MeanTest& test = pair.test;
        const auto text = [](const char* word) { return std::string(word); };
        return columns::cells_of([&](const auto& visit) {
            visit("table", text("comparison"));
            visit("dimension", row.dimension);
            visit("warps", row.warps);
            visit("count", row.count);
            visit("measure", row.measure);
            visit("key", row.key);
            visit("generator_a", row.generator);
            visit("generator_b", pair.b->row.generator);
            visit("method", text(options.paired ? "paired" : "welch"));
            visit("compared", text(is_error_key(row.key) ? "absolute value" : "value"));
            visit("sets_a", std::uint64_t{pair.sets_a});
            visit("sets_b", std::uint64_t{pair.sets_b});
            visit("difference", test.difference);
            visit("standard_error", test.standard_error);
            visit("t", test.t);
            visit("degrees_of_freedom", test.degrees);
            visit("p_value", test.p_value);
            visit("p_holm", pair.p_holm);
            visit("study", row.study);
        });
    };
    const Sample none{};  // only for the names of the columns
    std::string text = table_head(style, cells_of_pair({&none, &none}));
    std::map<std::pair<std::string, std::string>, bool> same;  // true: no difference so far
    for (const auto& members : topics_) {
        run.check_stop();
        for (const Pair& pair : pairs_of(members, options.paired)) {
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

namespace {

/// Selects the rows of a table that --keys asks for.
class RowChoice {
  public:
    explicit RowChoice(std::span<const std::string> wanted)
        : wanted_(wanted), met_(wanted.size()) {}

    bool takes(const std::string& measure, const std::string& key) {
        if (wanted_.empty() || key.empty()) return true;  // the key is empty if a measure failed
        const auto analyzer = std::ranges::find(
            analyzers::all(), measure.substr(0, measure.find(':')), &Analyzer::name);
        const bool known = analyzer != analyzers::all().end();
        bool any = false;
        for (std::size_t i = 0; i < wanted_.size(); ++i)
            if (is_meant(key, {known ? without_name(wanted_[i], *analyzer) : wanted_[i]}))
                any = met_[i] = true;
        return any;
    }

    void require_all(const std::string& source) const {
        const auto none = std::ranges::find(met_, false);
        if (none != met_.end())
            fail(ErrorKind::usage, "--keys: {} has no result '{}'", source,
                 wanted_[static_cast<std::size_t>(none - met_.begin())]);
    }

  private:
    std::span<const std::string> wanted_;
    std::vector<bool> met_;
};

/// Rows of a study's table; a summary after them is ignored.
/// @param begin index of the first row
StudySummary rows_in(std::span<const std::string_view> lines, std::size_t begin,
                     const StudyTable& table, const std::string& source, const RunContext& run,
                     RowChoice& choice) {
    StudySummary summary;
    for (std::size_t i = begin; i < lines.size(); ++i) {
        run.check_stop();
        if (lines[i].empty() || lines[i].starts_with("{\"table\":")) break;
        const auto row = table.parse(lines[i]);
        if (!row) fail(ErrorKind::input, "{}:{}: this is not a row of a study", source, i + 1);
        if (choice.takes(row->measure, row->key)) summary.add(*row);
    }
    return summary;
}

std::vector<MeanRow> means_in_summary(std::span<const std::string_view> lines, std::size_t begin,
                                      TableStyle style, const std::string& source,
                                      RowChoice& choice) {
    const auto columns = cells_of(MeanRow());
    std::vector<MeanRow> rows;
    for (std::size_t i = begin; i < lines.size(); ++i) {
        const auto cells = parse_table_line(style, lines[i], columns);
        MeanRow& row = rows.emplace_back();
        const bool whole = cells && columns::read_cells(*cells, [&](const auto& visit) {
                               for_each_column(row, visit);
                           });
        if (!whole)
            fail(ErrorKind::input, "{}:{}: this is not a row of a study's summary", source, i + 1);
        if (!choice.takes(row.measure, row.key)) rows.pop_back();
    }
    return rows;
}

}  // namespace

std::optional<std::variant<std::vector<MeanRow>, StudySummary>> read_study(
    std::string_view bytes, const std::string& source, const RunContext& run,
    std::span<const std::string> keys) {
    const std::string_view table = without_preface(bytes);
    const std::string_view first = table.substr(0, table.find('\n'));
    const bool csv = !first.starts_with('{');
    const TableStyle style = csv ? TableStyle::csv : TableStyle::jsonl;
    const bool summary = csv ? std::string(first) + "\n" == table_head(style, cells_of(MeanRow()))
                             : first.starts_with("{\"table\":\"mean\"");
    if (first.starts_with(csv ? "table,dimension," : "{\"table\":\"comparison\""))
        fail_with_hint(ErrorKind::input, "the summary beside them has the means",
                       "{}: comparisons of a study are not drawn", source);
    if (!summary && !StudyTable(style, true).is_head(first)) return std::nullopt;
    const auto lines = split(bytes.substr(0, bytes.find_last_not_of('\n') + 1), '\n');
    const auto above = static_cast<std::size_t>(
        std::count(bytes.begin(), bytes.end() - static_cast<std::ptrdiff_t>(table.size()), '\n'));
    const std::size_t begin = above + (csv ? 1 : 0);
    const bool seconds = first.find("generate_seconds") != first.npos;
    RowChoice choice(keys);
    std::variant<std::vector<MeanRow>, StudySummary> study;
    if (summary)
        study = means_in_summary(lines, begin, style, source, choice);
    else
        study = rows_in(lines, begin, StudyTable(style, seconds), source, run, choice);
    choice.require_all(source);
    return study;
}

std::optional<std::vector<MeanRow>> read_means(std::string_view bytes, const std::string& source,
                                               const RunContext& run) {
    auto study = read_study(bytes, source, run);
    if (!study) return std::nullopt;
    if (const auto* rows = std::get_if<StudySummary>(&*study))
        return rows->mean_rows({.resamples = 0}, run);
    return std::get<0>(*std::move(study));
}

void label_generators(std::vector<MeanRow>& means, std::span<const std::string> labels) {
    std::map<std::string, std::size_t> numbers;
    for (const MeanRow& row : means) numbers.try_emplace(row.generator, numbers.size());
    if (numbers.size() != labels.size())
        fail(ErrorKind::usage, "--labels: {} names; expected one for each of the {} generators",
             labels.size(), numbers.size());
    for (MeanRow& row : means) row.generator = labels[numbers.at(row.generator)];
}

// ---------------------------------------------------------------- wide tables

namespace {

struct WideCell {
    double value = not_known;
    double half_width = not_known;
};

WideCell cell_of(const MeanRow& row) {
    return is_error_key(row.key) ? WideCell{row.rms, (row.rms_high - row.rms_low) / 2}
                                 : WideCell{row.mean, (row.t_high - row.t_low) / 2};
}

/// Means by row and generator. Measures, keys and generators are in the order of the study.
struct Wide {
    /// Indices of measure and key, dimension, count.
    using Key = std::tuple<std::size_t, std::size_t, std::uint64_t, std::uint64_t>;

    std::vector<std::string> measures;
    std::vector<std::string> keys;
    std::vector<std::string> generators;
    std::map<Key, std::map<std::size_t, WideCell>> rows;

    explicit Wide(std::span<const MeanRow> means) {
        const auto index = [](std::vector<std::string>& known, const std::string& name) {
            auto it = std::ranges::find(known, name);
            if (it == known.end()) it = known.insert(it, name);
            return static_cast<std::size_t>(it - known.begin());
        };
        for (const MeanRow& row : means) {
            if (row.key.empty()) continue;  // no key: all measurements failed
            auto& cells = rows[{index(measures, row.measure), index(keys, row.key), row.dimension,
                                row.count}];
            cells[index(generators, row.generator)] = cell_of(row);
        }
    }

    /// Texts of the first columns: measure, key, dimension, count.
    [[nodiscard]] std::vector<std::string> labels(const Key& row) const {
        return {measures[std::get<0>(row)], keys[std::get<1>(row)],
                std::to_string(std::get<2>(row)), std::to_string(std::get<3>(row))};
    }
};

constexpr std::size_t label_columns = 4;

}  // namespace

std::string wide_table(std::span<const MeanRow> means, TableStyle style) {
    const Wide wide(means);
    std::vector<std::string> names = {"measure", "key", "dimension", "count"};
    for (const std::string& generator : wide.generators)
        for (const char* what : {"", " half_width"}) names.push_back(generator + what);
    std::vector<TableCell> cells;
    for (const std::string& name : names) cells.push_back({.name = name, .text = name});
    std::string text = style == TableStyle::csv ? table_line(style, cells) : "";
    for (std::size_t i = 2; i < cells.size(); ++i) cells[i].number = true;
    const auto number = [](double x) { return std::isnan(x) ? "" : format_number(x); };
    for (const auto& [row, found] : wide.rows) {
        const auto labels = wide.labels(row);
        for (std::size_t i = 0; i < cells.size(); ++i)
            cells[i].text = i < label_columns ? labels[i] : "";
        for (const auto& [generator, cell] : found) {
            cells[label_columns + 2 * generator].text = number(cell.value);
            cells[label_columns + 2 * generator + 1].text = number(cell.half_width);
        }
        text += table_line(style, cells);
    }
    return text;
}

std::string wide_latex(std::span<const MeanRow> means, const std::string& command) {
    const Wide wide(means);
    LatexTable table{.comments = {fmt::format("stipple {}: {}", STIPPLE_VERSION, command)}};
    const std::vector<std::string> heads = {"measure", "key", "$d$", "$n$"};
    std::vector<std::size_t> shown;  // label columns that vary; if none does, n
    for (std::size_t k = 0; k < label_columns; ++k) {
        const std::string first = wide.rows.empty() ? "" : wide.labels(wide.rows.begin()->first)[k];
        const bool varies = std::ranges::any_of(
            wide.rows, [&](const auto& row) { return wide.labels(row.first)[k] != first; });
        if (varies || (k == label_columns - 1 && shown.empty()))
            shown.push_back(k);
        else
            table.comments.push_back(fmt::format("{}: {}", heads[k], first));
    }
    if (!means.empty())
        table.comments.push_back(
            fmt::format("means (of errors: root mean squares) +- half of the {} % interval",
                        format_number(100 * means.front().confidence)));
    for (const std::size_t k : shown) {
        table.head.push_back(heads[k]);
        table.words += k < 2 ? 1 : 0;
    }
    for (const std::string& generator : wide.generators)
        table.head.push_back(latex_text(generator));
    for (const auto& [key, found] : wide.rows) {
        auto& row = table.rows.emplace_back();
        for (const std::size_t k : shown) row.push_back(latex_text(wide.labels(key)[k]));
        for (std::size_t g = 0; g < wide.generators.size(); ++g) {
            const auto cell = found.find(g);
            row.push_back(cell == found.end()
                              ? "--"
                              : latex_number(cell->second.value, cell->second.half_width));
        }
    }
    return latex_packages + table.text();
}

}  // namespace stipple
