// SPDX-License-Identifier: MIT
//
// The verb `report`: sets in, one page about all of them out.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <string_view>

#include "cli/inputs.hpp"
#include "cli/session.hpp"
#include "cli/verbs.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "io/output.hpp"
#include "io/source_text.hpp"
#include "page/experiment.hpp"
#include "page/html.hpp"
#include "page/measures.hpp"
#include "pipeline/chain.hpp"
#include "pipeline/generated.hpp"
#include "pipeline/set_writer.hpp"
#include "report/check.hpp"
#include "report/document.hpp"

namespace stipple::cli {
namespace {

/// A set that has not been measured yet.
struct PendingSet {
    PointSet points;
    page::Set set;
    page::Input input;
    /// All sets of its generator, the first of them this one; null if the generator makes one set.
    std::shared_ptr<const GeneratedSets> others = {};
};

std::string file_name(const std::string& path) { return path.substr(path.rfind('/') + 1); }

/// Known keys of a measure's results.
std::vector<std::string> keys_of(const std::string& measure, const Analyzer& analyzer) {
    std::vector<std::string> keys;
    for (const ResultKey& result : analyzer.results)
        if (free_parts(result) == 0) keys.push_back(measure + "." + result.key);
    for (const page::Key& known : page::compared_keys())
        if (std::string_view(known.key).starts_with(measure + ".") &&
            std::ranges::find(keys, known.key) == keys.end())
            keys.emplace_back(known.key);
    return keys;
}

/// Parses a condition and completes its key: a measure's name alone means its result `value`.
/// @throws Error(usage) for a key that no page has, or a condition that never holds
Check condition_of(const std::string& text, const std::string& option) {
    Check check = parse_check(text, option);
    const std::string measure = check.key.substr(0, check.key.find_first_of(".["));
    const page::Planned* plan = page::planned(measure);
    if (plan == nullptr) {
        std::vector<std::string> names;
        for (const auto& known : page::planned_measures()) names.emplace_back(known.name);
        fail_with_hint(ErrorKind::usage, suggest(measure, names),
                       "{}: '{}' does not begin with the name of a measure", option, check.key);
    }
    const bool alone = check.key == measure;
    if (alone) check.key += ".value";
    const std::string path = check.key.substr(0, check.key.find('['));
    const ResultKey* result =
        path == measure ? nullptr : find_result(*plan->analyzer, path.substr(measure.size() + 1));
    if (result == nullptr) {
        const auto keys = keys_of(measure, *plan->analyzer);
        fail_with_hint(ErrorKind::usage,
                       alone ? "its keys are " + join(keys, ", ") : suggest(check.key, keys),
                       "{}: there is no '{}'", option, check.key);
    }
    require_sense(check, *result);
    return check;
}

/// Negation of a condition.
Check opposite_of(const Check& check) {
    static const std::map<std::string, std::string> opposites = {
        {"<", ">="}, {"<=", ">"}, {">", "<="}, {">=", "<"}, {"==", "!="}, {"!=", "=="}};
    Check opposite = check;
    opposite.op = opposites.at(check.op);
    return opposite;
}

class Reporter {
  public:
    Reporter(const ReportRequest& request, Session& session)
        : request_(request),
          session_(session),
          path_(output_of(request)),
          json_(request.json.value_or(io::extension_of(path_) == ".json")) {
        if (!json_ && is_terminal(path_))
            fail_with_hint(ErrorKind::usage, "name a file with -o, or pipe it on",
                           "an HTML page cannot be shown on a terminal");
        if (request.max_work) work_ = static_cast<std::int64_t>(*request.max_work);
        for (const auto& text : request.checks)
            conditions_.push_back(condition_of(text, "--check"));
        for (const auto& text : request.fail_on) {
            const Check check = opposite_of(condition_of(text, "--fail-on"));
            session.warn(fmt::format("--fail-on {} is the older form of --check {}", text,
                                     shell_word(check.key + check.op + check.value)));
            conditions_.push_back(check);
        }
    }

    int go() {
        keep_inputs();
        static const std::vector<std::string> known = {".html", ".htm", ".json"};
        if (!request_.json)
            io::require_extension(path_, known, "--format selects a format for any file name");
        io::Output output(path_, session_.run().stop);
        load();
        check_sets();
        name_sets();
        page::Page whole{.title = {}, .version = STIPPLE_VERSION, .command = command(), .sets = {}};
        for (std::size_t i = 0; i < pending_.size(); ++i) whole.sets.push_back(finished(i));
        whole.title = title_of(whole.sets);
        const bool fine = judge(whole.sets);
        if (fine)  // no warnings beside failed conditions
            for (const page::Set& set : whole.sets) warn_of_nothing(set);
        session_.run().check_stop();
        if (output.write(json_ ? page::to_json(whole) : page::to_html(whole))) output.commit();
        return fine ? 0 : 1;
    }

  private:
    // ---------------------------------------------------------------- sets

    /// Ensures that the page does not overwrite its input.
    void keep_inputs() const {
        std::error_code none;
        for (const std::string& input : request_.inputs)
            if (std::filesystem::is_regular_file(path_, none) &&
                std::filesystem::equivalent(path_, input, none))
                fail(ErrorKind::usage, "--output: {} is an input, which it would overwrite", path_);
    }

    void load() {
        for (const std::string& input : input_names(request_)) add_file(input);
        if (!request_.generate.empty()) seed_ = seed_for_generators(request_, session_);
        for (const std::string& spec : request_.generate) add_generated(spec);
    }

    void add_file(const std::string& input) {
        auto sets = read_input(input, request_, session_.run());
        for (std::size_t i = 0; i < sets.size(); ++i) {
            PendingSet next;
            next.set.left_out = place(sets[i], input, request_, session_.run());
            next.set.source = input;
            next.set.provenance = sets[i].provenance;
            next.set.command = sets[i].provenance.command;
            // No command can reproduce a set with rows left out.
            if (next.set.left_out == 0) next.input.words = words_of_file(input);
            next.input.bounds = !request_.domain;
            if (sets.size() > 1) {
                next.set.number = i;
                next.input.remark = fmt::format("  # result {} of the array", i);
            }
            next.points = std::move(sets[i]);
            pending_.push_back(std::move(next));
        }
    }

    /// The file, with its reading options, as arguments of 'stipple analyze'.
    [[nodiscard]] std::string words_of_file(const std::string& input) const {
        return shell_word(input) +
               typed_options(request_, {"from", "dimension", "column", "input-dtype", "dtype",
                                        "domain", "parameters", "rescale"});
    }

    void add_generated(const std::string& text) {
        const auto sets = std::make_shared<const GeneratedSets>(
            generated_sets(text, seed_, request_, session_.run()));
        PendingSet next;
        next.points = sets->made(0, session_.run());
        if (sets->sets() > 1) next.others = sets;
        next.set.source = text;
        next.set.command =
            fmt::format("stipple generate {}{}", typed_generator(text), of_generated());
        next.set.provenance = next.points.provenance;
        next.set.provenance.command = next.set.command;
        next.input.words = fmt::format("--generate {}{}", shell_word(text), of_generated());
        pending_.push_back(std::move(next));
    }

    /// Options shared by all generated sets, for the command that makes the first set of a
    /// generator.
    [[nodiscard]] std::string of_generated() const {
        return typed_options(request_,
                             {"count", "dimension", "start", "warp", "parameters", "unit-cube"}) +
               (request_.seed ? fmt::format(" --seed {}", seed_) : "");
    }

    /// Checks that the sets can be on one page: at most most_sets, all of one dimension. @throws
    /// Error(usage), Error(input)
    void check_sets() const {
        if (pending_.size() > page::most_sets)
            fail_with_hint(ErrorKind::usage, "'stipple study' compares more, as tables",
                           "a report compares at most {} sets; these are {}", page::most_sets,
                           pending_.size());
        const PendingSet& first = pending_.front();
        for (const auto& [points, set, input, others] : pending_)
            if (points.dimension() != first.points.dimension())
                fail_with_hint(ErrorKind::input, "make a report for each dimension",
                               "{}: points of {} coordinates are not compared with those of {}, "
                               "which have {}",
                               io::source_name(set.source), points.dimension(),
                               io::source_name(first.set.source), first.points.dimension());
    }

    /// Gives the sets short, distinct names.
    void name_sets() {
        std::map<std::string, int> seen;
        for (auto& [points, set, input, others] : pending_) {
            const std::string last = file_name(set.source);
            const bool one_file =
                std::ranges::all_of(pending_, [&, &source = set.source](const PendingSet& other) {
                    return file_name(other.set.source) != last || other.set.source == source;
                });
            set.name = one_file && input.words.find("--generate") != 0 ? last : set.source;
            if (set.name == "-") set.name = "standard input";
            if (set.number) set.name += fmt::format(", set {}", *set.number);
            if (const int before = seen[set.name]++; before > 0)
                set.name += fmt::format(" ({})", before + 1);
        }
    }

    [[nodiscard]] static std::string title_of(const std::vector<page::Set>& sets) {
        constexpr std::size_t few = 3;
        if (sets.size() > few) return fmt::format("{} sample sets compared", sets.size());
        std::vector<std::string> names;
        for (const page::Set& set : sets) names.push_back(set.name);
        return join(names, " · ");
    }

    // ---------------------------------------------------------------- measures and conditions

    /// Measures and draws a set, and frees its points.
    page::Set finished(std::size_t i) {
        auto [points, set, input, others] = std::move(pending_[i]);
        pending_[i].points = {};
        const RunContext run = part_of_run(session_.run(), i, pending_.size());
        page::Set whole = page::finished_set(std::move(set), points, input, work_, i, !json_, run);
        for (std::uint64_t r = 1; others && r < others->sets(); ++r) {
            page::Set next;
            next.measures =
                page::measure_set(others->made(r, session_.run()), input, work_,
                                  part_of_run(run, static_cast<std::size_t>(r),
                                              static_cast<std::size_t>(others->sets())));
            whole.replications.push_back(without_curves(next.all_results()));
        }
        return whole;
    }

    /// A report without grids and long lists, which suffices for conditions and means.
    static Report without_curves(const Report& report) {
        constexpr std::size_t few = 64;
        Report kept;
        for (const auto& [name, value, unit] : report.entries()) {
            const auto list = list_at(report, name);
            if (const auto* group = std::get_if<Report>(&value))
                kept.add(name, without_curves(*group));
            else if (!std::holds_alternative<Grid>(value) && (!list || list->size() <= few))
                kept.entries().push_back({name, value, unit});
        }
        return kept;
    }

    /// Warns if no measure could be applied to a set from a file, which is usually a mistake.
    void warn_of_nothing(const page::Set& set) const {
        const auto inputs = input_names(request_);
        if (std::ranges::find(inputs, set.source) == inputs.end() ||
            page::is_experiment(set.domain) ||  // its page explains why each measure is missing
            std::ranges::any_of(set.measures, [](const auto& m) { return m.results.has_value(); }))
            return;
        session_.warn(fmt::format(
            "{}: nothing could be measured ({}); --rescale maps the points to the unit cube, "
            "--domain 'box:bounds=[lo..hi,...]' names their box",
            set.name, set.measures.front().left_out));
    }

    /// Whether all conditions certainly hold; a missing value fails its condition. Reports
    /// failures.
    bool judge(const std::vector<page::Set>& sets) const {
        bool fine = true;
        for (const Check& check : conditions_) {
            require_known(check, sets);
            for (const page::Set& set : sets) {
                fine = judge(check, set, set.all_results(), set.name) && fine;
                for (std::size_t r = 0; r < set.replications.size(); ++r)
                    fine = judge(check, set, set.replications[r],
                                 fmt::format("{}, seed {}", set.name, seed_ + r + 1)) &&
                           fine;
            }
        }
        return fine;
    }

    static bool judge(const Check& check, const page::Set& set, const Report& all,
                      const std::string& name) {
        const bool there = has(all, check.key);
        if (there && check.holds(all)) return true;
        say_line(fmt::format("{}: {}{}{} does not hold: it is {}", name, check.key, check.op,
                             check.value, there ? check.found(all) : why_not(set, check.key)));
        return false;
    }

    /// Whether the report has the value, or at least its bounds.
    static bool has(const Report& all, const std::string& key) {
        const std::string path = key.substr(0, key.find('['));
        const Report::Item* item = all.find(path);
        if (item == nullptr && path.ends_with(".value"))
            item = all.find(path.substr(0, path.rfind('.')) + ".lower");
        return item != nullptr && !std::holds_alternative<Report>(*item);
    }

    static const page::Measure& measure_of(const page::Set& set, const std::string& key) {
        return *std::ranges::find(set.measures, key.substr(0, key.find('.')), &page::Measure::name);
    }

    static std::string why_not(const page::Set& set, const std::string& key) {
        const page::Measure& measure = measure_of(set, key);
        return measure.results ? "no result" : fmt::format("not known ({})", measure.left_out);
    }

    /// @throws Error(usage) if no set has the key, although all have results of the key's measure
    static void require_known(const Check& check, const std::vector<page::Set>& sets) {
        const std::string& key = check.key;
        std::string hint;
        for (const page::Set& set : sets) {
            const Report all = set.all_results();
            if (has(all, key) || !measure_of(set, key).results) return;
            hint = suggest(key, all.keys());
        }
        fail_with_hint(ErrorKind::usage, hint, "{}: no set has a result '{}'", check.option, key);
    }

    /// Command that makes this page, without options that do not affect it.
    [[nodiscard]] std::string command() const {
        return command_text(request_, {"format", "check", "fail-on"}, seed_) +
               (json_ ? " --json" : " -o report.html");
    }

    const ReportRequest& request_;
    Session& session_;
    std::string path_;
    bool json_;
    std::int64_t work_ = page::usual_work;
    std::vector<Check> conditions_;
    std::uint64_t seed_ = 1;
    std::vector<PendingSet> pending_;
};

}  // namespace

int ReportRequest::perform(Session& session) const { return Reporter(*this, session).go(); }

}  // namespace stipple::cli
