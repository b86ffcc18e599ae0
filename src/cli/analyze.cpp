// SPDX-License-Identifier: MIT
//
// The verb `analyze`: point sets in, results out.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "cli/analysis.hpp"
#include "cli/inputs.hpp"
#include "cli/launched.hpp"
#include "cli/session.hpp"
#include "cli/terminal.hpp"
#include "cli/verbs.hpp"
#include "core/error.hpp"
#include "core/spec.hpp"
#include "core/text.hpp"
#include "io/output.hpp"
#include "pipeline/generated.hpp"
#include "pipeline/shared_analysis.hpp"
#include "report/latex.hpp"
#include "report/typical.hpp"

namespace stipple::cli {
namespace {

ReportFormat report_format(const AnalyzeRequest& request, const std::string& path) {
    if (request.format) return *request.format;
    static const std::vector<std::string> known = {".json", ".csv", ".txt", ".tex"};
    io::require_extension(path, known, "--format selects a format for any file name");
    const std::string extension = io::extension_of(path);
    if (extension.empty() && request.array) return ReportFormat::json;
    if (extension == ".csv") return ReportFormat::csv;
    if (extension == ".tex") return ReportFormat::latex;
    const bool for_people = extension.empty() && (request.full || request.explain);
    return for_people || is_terminal(path) || extension == ".txt" ? ReportFormat::text
                                                                  : ReportFormat::json;
}

std::vector<std::string> result_keys(const Analyzer& analyzer) {
    std::vector<std::string> keys;
    for (const ResultKey& result : analyzer.results) keys.push_back(result.key);
    return keys;
}

/// Whether `wanted` is the key of a result, or a part of it between dots.
bool is_part(const std::string& key, const std::string& wanted) {
    return fmt::format(".{}.", key).find(fmt::format(".{}.", wanted)) != std::string::npos;
}

/// The results whose keys are words of `wanted`, or contain one between dots; the word value[0]
/// selects one number of a list.
Report picked(const Report& report, const std::vector<std::string>& wanted,
              const std::string& group = {}) {
    Report kept;
    for (const auto& [name, value, unit] : report.entries()) {
        if (const auto* inner = std::get_if<Report>(&value)) {
            Report part = picked(*inner, wanted, group + name + ".");
            if (!part.entries().empty()) kept.add(name, std::move(part));
            continue;
        }
        for (const std::string& word : wanted) {
            if (!is_part(group + name, word.substr(0, word.find('[')))) continue;
            const auto list = list_at(report, name);
            const auto open = word.find('[');
            if (!list || open == std::string::npos) {
                kept.add(name, value, unit);
                continue;
            }
            const auto index = parse_unsigned(split(word.substr(open + 1), ']').front());
            if (!index || *index >= list->size())
                fail(ErrorKind::usage, "--keys: '{}' is not a key; {} has {} numbers, from [0]",
                     word, group + name, list->size());
            kept.add(name + word.substr(open), (*list)[*index], unit);
        }
    }
    return kept;
}

/// Index of a set among `of` sets; nullopt if it is the only one.
std::optional<std::size_t> number_of(std::size_t set, std::size_t of) {
    return of > 1 ? std::optional(set) : std::nullopt;
}

/// One `analyze` call: its analyses, checks and outputs.
class AnalyzeCall {
  public:
    AnalyzeCall(const AnalyzeRequest& request, Session& session, Ranks& ranks)
        : request_(request),
          session_(session),
          ranks_(ranks),
          inputs_(input_names(request)),
          path_(output_of(request)),
          format_(report_format(request, path_)) {
        if (format_ != ReportFormat::text)
            refuse_options(request, "full,explain", "requires --format text");
        if (format_ != ReportFormat::json)
            refuse_options(request, "array", "requires --format json");
        for (const auto& [analyzer, options] : request.analyzers)
            analyses_.push_back(std::make_unique<Analysis>(*analyzer, options, request, session,
                                                           files_, several_analyzers()));
        for (const auto& text : request.checks) add_check(text);
        for (const auto& text : request.keys) add_key(text);
    }

    int go() {
        for (const auto& analysis : analyses_) analysis->check_arguments(path_);
        if (ranks_.size() > 1) {
            share();
        } else {
            require_sources();
            for (const std::string& input : inputs_)
                if (!interrupted()) in_blocks() ? add_stream(input) : add_sets(input);
            add_generated();
        }
        measure_waiting();
        if (ranks_.rank() > 0) return 0;  // only rank 0 prints
        if (interrupted()) return print_what_is_known();
        for (const auto& analysis : analyses_) analysis->finish();
        warn_of_kinds();
        const bool fine = verdict();
        print();
        files_.commit();
        return fine ? 0 : 1;
    }

  private:
    [[nodiscard]] bool several_analyzers() const { return request_.analyzers.size() > 1; }
    /// The first analysis: the only one, unless there are several analyzers.
    [[nodiscard]] Analysis& only() const { return *analyses_.front(); }

    /// Name of the column of weights, from the analyzer's option; empty if not given.
    [[nodiscard]] std::string strengths() const {
        for (const auto& analysis : analyses_) {
            const auto column = analysis->text_of(analysis->analyzer().strengths);
            if (column && several_analyzers())
                fail(ErrorKind::usage, "--weights: run {} alone", analysis->analyzer().name);
            if (column) return *column;
        }
        return {};
    }

    /// Whether sets can be measured in blocks while they are read.
    [[nodiscard]] bool in_blocks() const {
        return !several_analyzers() && only().analyzer().accumulate && !request_.rescale;
    }

    /// Checks that --weights applies to the sources of points. Warns if files to be averaged are
    /// given twice, since their sets are not independent. @throws Error(usage)
    void require_sources() const {
        for (auto i = inputs_.begin(); request_.averaged() && i != inputs_.end(); ++i)
            if (std::find(inputs_.begin(), i, *i) != i)
                session_.run().notify(*i + " is given twice: its sets are averaged twice");
        if (strengths().empty()) return;
        if (!request_.generate.empty())
            fail(ErrorKind::usage, "--weights: generated points have no weight column");
        if (!in_blocks())
            fail(ErrorKind::usage, "--rescale and --weights: give --bounds instead of --rescale");
    }

    // ---------------------------------------------------------------- sets

    void add_sets(const std::string& input) {
        std::vector<PointSet> sets;
        before_errors([&] { sets = read_input(input, request_, session_.run()); });
        const std::uint64_t count = sets.empty() ? 0 : sets[0].count();
        for (std::size_t set = 0; set < sets.size() && !interrupted(); ++set) {
            const Provenance& made = sets[set].provenance;
            const SetOrigin origin{.source = input,
                                   .number = number_of(set, sets.size()),
                                   .kind = request_.averaged() ? kind_of(made, count) : "",
                                   .columns = made.columns,
                                   .several = several_sources() || sets.size() > 1};
            add_to_all(std::move(sets[set]), origin);
        }
    }

    /// Adds a set to every analysis, mapped to the unit cube if the analyzer needs that.
    void add_to_all(PointSet points, const SetOrigin& origin) {
        for (const auto& analysis : analyses_) {
            PointSet own = analysis == analyses_.back() ? std::move(points) : points;
            before_errors([&] {
                naming(origin.source,
                       [&] { own = prepared(std::move(own), analysis->analyzer(), request_); });
            });
            analysis->add(std::move(own), origin);
        }
    }

    /// Runs work(). If it throws, first measures all earlier sets, whose errors are reported first.
    template <class Work>
    void before_errors(const Work& work) {
        try {
            work();
        } catch (...) {
            measure_waiting();
            throw;
        }
    }

    /// Warns of several means, since users may not know that files contain sets of several kinds.
    void warn_of_kinds() const {
        if (inputs_.empty() || only().kinds() < 2) return;
        session_.warn(
            fmt::format("the sets are of {} kinds, and each kind has its own mean; --pool gives "
                        "one mean of all",
                        only().kinds()));
    }

    void measure_waiting() {
        for (const auto& analysis : analyses_) analysis->measure_waiting();
    }

    /// Adds sets of any size, read in blocks.
    void add_stream(const std::string& input) {
        const RunContext& run = session_.run();
        Analysis& analysis = only();
        const auto stream = open_input(input, request_, run, strengths());
        const std::size_t before = analysis.measurements().size();
        std::size_t sets = 0;
        SetOrigin origin{.source = input};
        for (; stream->next_set(); ++sets)
            naming(input, [&] {
                const NextRows read = [&](std::span<double> rows) { return stream->read(rows); };
                const Arrival points =
                    arrival_of(*stream, !strengths().empty(), analysis.analyzer(), request_, run);
                const Provenance& made = stream->provenance();
                if (request_.averaged() && !made.generator.empty()) origin.kind = kind_of(made, 0);
                origin.columns = made.columns;
                origin.number = sets;
                origin.several = several_sources() || sets > 0;
                analysis.add(points, within_bounds(read, points, 0, analysis.analyzer(), request_),
                             origin, made, run);
            });
        if (sets == 1 && analysis.measurements().size() == before + 1) analysis.forget_number();
    }

    void add_generated() {
        if (request_.generate.empty()) return;
        const std::uint64_t seed = seed_for_generators(request_, session_);
        for (const std::string& text : request_.generate)
            add_generated(text, generated_sets(text, seed, request_, session_.run()));
    }

    void add_generated(const std::string& text, const GeneratedSets& generated) {
        // Identical sets add no information to a mean.
        const std::uint64_t sets =
            request_.averaged() ? generated.different_sets() : generated.sets();
        const auto count = generated.streamed();
        RunContext quiet = session_.run();
        if (sets > 1) quiet.progress = {};
        for (std::uint64_t set = 0; set < sets && !interrupted(); ++set) {
            session_.run().tick(set, sets);
            SetOrigin origin{.source = text,
                             .number = number_of(set, sets),
                             .kind = text,
                             .several = several_sources() || sets > 1};
            if (in_blocks() && count)
                only().add({generated.domain(), count}, generated.stream(set, quiet), origin, {},
                           quiet);
            else
                add_to_all(generated.made(set, quiet), origin);
        }
    }

    [[nodiscard]] bool several_sources() const {
        return inputs_.size() + request_.generate.size() > 1;
    }

    // ---------------------------------------------------------------- one set, by all ranks

    void share() {
        const Analyzer& analyzer = only().analyzer();
        if (several_analyzers())
            fail_with_hint(ErrorKind::usage, "name one, or start one process",
                           "analyze: ranks do not share several analyzers");
        if (!analyzer.sharing)
            fail_with_hint(ErrorKind::usage,
                           "start one process; 'stipple study' shares many sets out",
                           "analyze: ranks do not share {}", analyzer.name);
        if (request_.rescale)
            fail(ErrorKind::usage, "--rescale: ranks see a part of the points; give --bounds");
        if (several_sources())
            fail(ErrorKind::usage, "analyze: ranks share one set; name its files{}",
                 inputs_.size() > 1 ? " with --concat" : "");
        if (!inputs_.empty() && inputs_.front() == "-")
            fail(ErrorKind::usage, "analyze: ranks share one set; name its files");
        if (request_.sets > 1)
            fail_with_hint(ErrorKind::usage, "'stipple study' shares many sets out",
                           "--sets: ranks share one");
        require_sources();
        if (!request_.generate.empty()) return measure_together(request_.generate.front());
        naming(inputs_.front(), [this] { measure_together(inputs_.front()); });
    }

    void measure_together(const std::string& source) {
        Analysis& analysis = only();
        const Analyzer& analyzer = analysis.analyzer();
        SharedSet set;
        Measurement m =
            analysis.timed({.source = source}, set.points.domain, analysis.options(), [&] {
                set = request_.generate.empty()
                          ? shared_files(request_, analyzer, strengths(), ranks_, own_run())
                          : shared_generated();
                if (analyzer.sharing.together)
                    return Found{searched_together(set), *set.points.count};
                return analyze_shared(analyzer, set, analysis.options(), ranks_, own_run())
                    .value_or(Found{});
            });
        if (ranks_.rank() == 0) analysis.keep(std::move(m), {});
    }

    SharedSet shared_generated() {
        const std::string& spec = request_.generate.front();
        const auto generated = std::make_shared<GeneratedSets>(
            generated_sets(spec, seed_for_generators(request_, session_), request_, own_run()));
        const RunContext run = own_run();
        const auto count = generated->streamed();
        if (!count && !only().analyzer().sharing.together)
            fail(ErrorKind::usage,
                 "--generate: ranks share sequences; {} makes its points all together", spec);
        if (!count) return shared_in_memory(generated->made(0, run));
        return {.points = {.domain = generated->domain(), .count = *count},
                .from = [=](std::uint64_t first) { return generated->stream(0, run, first); }};
    }

    /// The run of this rank, with its share of the machine's memory; only rank 0 reports progress
    /// and warnings.
    [[nodiscard]] RunContext own_run() const {
        RunContext run = session_.run();
        run.max_memory /= static_cast<std::uint64_t>(ranks_.on_machine());
        run.threads = threads_of(ranks_, run);
        if (ranks_.rank() == 0) return run;
        run.progress = {};
        run.warn = {};
        return run;
    }

    /// Runs an analyzer for which every rank holds all points.
    [[nodiscard]] Report searched_together(const SharedSet& set) const {
        const RunContext run = own_run();
        const Analyzer& analyzer = only().analyzer();
        std::optional<PointSet> points;
        agreed(ranks_, [&] {
            const std::size_t d = set.points.dimension();
            const std::size_t size = *set.points.count * d;
            run.need_memory(8.0 * static_cast<double>(size), "the set of points");
            std::vector<double> rows(size);
            set.from(0)(rows);
            points.emplace(std::move(rows), d);
            points->domain = set.points.domain;
            check_dimension(analyzer, d);
            require_unit_cube(*points);
        });
        return analyzer.sharing.together(*points, only().options(), ranks_, run);
    }

    // ---------------------------------------------------------------- checks

    /// A condition on one analyzer's results.
    struct NamedCheck {
        Check check;
        const Analysis* analysis;
    };

    /// Adds a condition. Its key may begin with an analyzer's name, and must if there are several
    /// analyzers. The name alone means the result `value`.
    void add_check(const std::string& text) {
        if (text == bare_check) return add_bare_check();
        Check check = parse_check(text);
        const Analysis& analysis = analysis_of(check.key, check.option);
        const Analyzer& analyzer = analysis.analyzer();
        check.key = without_name(check.key, analyzer);
        const auto* result = find_result(analyzer, check.key.substr(0, check.key.find('[')));
        if (result != nullptr) require_sense(check, *result);
        checks_.push_back({std::move(check), &analysis});
    }

    /// Adds a result to print; see add_check() for its key.
    void add_key(const std::string& text) {
        const Analysis& analysis = analysis_of(text, "--keys");
        const Analyzer& analyzer = analysis.analyzer();
        const std::string key = without_name(text, analyzer);
        if (key.empty() || !has_result(analyzer, key))
            fail_with_hint(ErrorKind::usage, suggest(key, result_keys(analyzer)),
                           "--keys: {} has no result '{}'", analyzer.name, key);
        for (const auto& each : analyses_)
            if (&each->analyzer() == &analyzer) keys_[each.get()].push_back(key);
    }

    /// Checks --keys against the results. The earlier check accepts any word for a placeholder of a
    /// known key, such as OUTPUT. @throws Error(usage)
    void require_keys() const {
        for (const auto& [analysis, keys] : keys_)
            for (const std::string& text : keys) {
                const std::string key = text.substr(0, text.find('['));
                std::vector<std::string> known = result_keys(analysis->analyzer());
                for (const auto& [m, of] : in_order())
                    if (of == analysis)
                        std::ranges::move(m->results.keys(), std::back_inserter(known));
                if (std::ranges::none_of(known, [&](const auto& k) { return is_part(k, key); }))
                    fail_with_hint(ErrorKind::usage, suggest(key, known),
                                   "--keys: {} has no result '{}'", analysis->analyzer().name, key);
            }
    }

    [[nodiscard]] const Analysis& analysis_of(const std::string& key,
                                              const std::string& option) const {
        if (!several_analyzers()) return only();
        std::vector<std::string> names;
        for (const auto& analysis : analyses_) {
            const std::string& name = analysis->analyzer().name;
            if (key == name || key.starts_with(name + ".")) return *analysis;
            names.push_back(fmt::format("{}.{}", name, key));
        }
        fail_with_hint(ErrorKind::usage, fmt::format("such as {}", join(names, " or ")),
                       "{}: '{}' does not begin with the name of one of the analyzers", option,
                       key);
    }

    /// Adds valid == true, the condition of --check without a text, for each analyzer with that
    /// result.
    void add_bare_check() {
        const std::size_t before = checks_.size();
        for (const auto& analysis : analyses_)
            if (find_result(analysis->analyzer(), "valid"))
                checks_.push_back({{.key = "valid", .op = "==", .value = "true"}, analysis.get()});
        if (checks_.size() > before) return;
        const Analyzer& first = only().analyzer();
        fail_with_hint(
            ErrorKind::usage, "its results are " + join(result_keys(first), ", "),
            "--check: {} has no result that says whether a set is valid; expected KEY<VALUE, with "
            "<, <=, >, >=, == or !=",
            first.name);
    }

    /// Whether all checks and expectations hold; reports those that fail.
    bool verdict() {
        bool fine = true;
        const auto complain = [&fine](const std::string& sentence) {
            say_line(sentence);
            fine = false;
        };
        for (const auto& [m, analysis] : in_order()) {
            const std::string name =
                m->set ? fmt::format("{}, set {}", m->source, *m->set) : m->source;
            for (const auto& sentence : m->results.unmet())
                complain(fmt::format("{}: {}", name, sentence));
            for (const NamedCheck& asked : checks_) {
                if (asked.analysis != analysis) continue;
                const Check& check = asked.check;
                if (const auto found = analysis->broken(check, m->results))
                    complain(fmt::format("{}: {}{}{}{} does not hold: it is {}", name,
                                         several_analyzers() ? m->analyzer + "." : "", check.key,
                                         check.op, check.value, *found));
            }
        }
        return fine;
    }

    // ---------------------------------------------------------------- output

    using Taken = std::pair<Measurement*, const Analysis*>;

    /// All measurements, grouped by set.
    [[nodiscard]] std::vector<Taken> in_order() const {
        std::vector<Taken> all;
        for (std::size_t i = 0;; ++i) {
            const std::size_t before = all.size();
            for (const auto& analysis : analyses_)
                if (i < analysis->measurements().size())
                    all.emplace_back(&analysis->measurements()[i], analysis.get());
            if (all.size() == before) return all;
        }
    }

    [[nodiscard]] bool interrupted() const { return session_.run().stop.stop_requested(); }

    /// Prints the results that analyses returned after a stop request: the best found so far.
    /// Throws instead for means, which would lack sets, for output to a file, and on several ranks.
    int print_what_is_known() {
        if (request_.averaged() || path_ != "-" || ranks_.size() > 1) session_.run().check_stop();
        print();
        say_line("interrupted");
        constexpr int exit_code = 130;
        return exit_code;
    }

    [[nodiscard]] TextStyle text_style() const {
        TextStyle style{.full = request_.full};
        if (request_.explain)
            style.below = [](const Measurement& m, const std::string& key) {
                constexpr std::size_t indent = 6;
                std::string text;
                for (const std::string& sentence :
                     meaning_of(find_analyzer(m.analyzer), key, m.dimension, m.options))
                    text +=
                        std::string(indent, ' ') + filled(sentence, text_columns(), indent) + "\n";
                return text;
            };
        return style;
    }

    void print() {
        require_keys();
        std::vector<Measurement> all;
        for (const auto& [measurement, analysis] : in_order()) {
            if (!keys_.empty() && !keys_.contains(analysis)) continue;
            Measurement& m = all.emplace_back(std::move(*measurement));
            if (!request_.seconds) m.seconds.reset();
            if (keys_.empty()) continue;
            m.results = picked(m.results, keys_.at(analysis));
            if (m.standard_error) m.standard_error = picked(*m.standard_error, keys_.at(analysis));
        }
        files_.add(path_, std::stop_token())
            .write(format_ == ReportFormat::json    ? to_json(all, request_.array)
                   : format_ == ReportFormat::latex ? to_latex(all)
                   : format_ == ReportFormat::csv   ? to_csv(all)
                                                    : to_text(all, text_style()));
    }

    const AnalyzeRequest& request_;
    Session& session_;
    Ranks& ranks_;
    std::vector<std::string> inputs_;
    std::string path_;
    ReportFormat format_;
    io::Outputs files_;  ///< the report and the files beside it
    std::vector<std::unique_ptr<Analysis>> analyses_;
    std::vector<NamedCheck> checks_;
    std::map<const Analysis*, std::vector<std::string>> keys_;  ///< results that --keys selects
};

}  // namespace

int AnalyzeRequest::perform(Session& session) const {
    return AnalyzeCall(*this, session, launched(*this, session.run())).go();
}

}  // namespace stipple::cli
