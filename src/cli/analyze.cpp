// SPDX-License-Identifier: MIT
//
// The verb `analyze`: point sets in, results out.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <exception>
#include <map>
#include <optional>
#include <utility>

#include "cli/inputs.hpp"
#include "cli/launched.hpp"
#include "cli/verbs.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/spec.hpp"
#include "core/text.hpp"
#include "io/output.hpp"
#include "io/source_text.hpp"
#include "math/fourier/transform.hpp"
#include "pipeline/chain.hpp"
#include "pipeline/generated.hpp"
#include "pipeline/pipeline.hpp"
#include "pipeline/shared_analysis.hpp"
#include "report/average.hpp"
#include "report/check.hpp"
#include "report/document.hpp"
#include "report/grid_files.hpp"

namespace stipple::cli {
namespace {

/// A condition; --check alone asks whether the set is valid.
Check check_of(const std::string& text, const Analyzer& analyzer) {
    if (text != bare_check) {
        const Check check = parse_check(text);
        const auto* result = find_result(analyzer, check.key.substr(0, check.key.find('[')));
        if (result != nullptr) require_sense(check, *result);
        return check;
    }
    if (find_result(analyzer, "valid")) return {.key = "valid", .op = "==", .value = "true"};
    std::vector<std::string> keys;
    for (const ResultKey& result : analyzer.results) keys.push_back(result.key);
    fail_with_hint(
        ErrorKind::usage, "its results are " + join(keys, ", "),
        "--check: {} has no result that says whether a set is valid; expected KEY<VALUE, with <, "
        "<=, >, >=, == or !=",
        analyzer.name);
}

/// @throws Error(usage) for a domain that is given twice, or that the analyzer would not heed.
void check_domain(const Arguments& arguments, const Analyzer& analyzer) {
    for (const char* other : {"rescale", "domain"})
        if (arguments.has("bounds") && arguments.has(other))
            fail(ErrorKind::usage, "--bounds and --{}: give one of them", other);
    const auto named = arguments.get("domain");
    const bool moved = arguments.has("bounds") || arguments.has("rescale");
    if (!named || *named == "unit-cube" || moved || !analyzer.traits.unit_cube) return;
    fail_with_hint(ErrorKind::usage, "--rescale or --bounds lo..hi moves points into the cube",
                   "--domain: {} measures points against the unit cube, not against {}",
                   analyzer.name, *named);
}

/// An option of an analyzer that names a file to be written beside its report.
struct FileOption {
    const char* option;
    const char* extension;  ///< of the one format that is written; empty: any
};
constexpr std::array<FileOption, 3> file_options = {
    {{"grid", ".npy"}, {"image", ".png"}, {"wisdom", ""}}};

/// @throws Error(usage) for a name that promises another format, or that is given twice.
void check_side_files(const Values& options, const std::string& output) {
    std::vector<std::pair<std::string, std::string>> taken = {{"output", output}};
    for (const FileOption& file : file_options) {
        const auto* option = options.try_find(file.option);
        if (option == nullptr || !option->given) continue;
        const auto& path = std::get<std::string>(option->value);
        if (path.starts_with("/dev/")) continue;
        if (!path.ends_with(file.extension))
            fail(ErrorKind::usage, "--{}: writes {}; '{}' has another name", file.option,
                 file.extension, path);
        for (const auto& [other, name] : taken)
            if (name == path)
                fail(ErrorKind::usage, "--{}: --{} writes {}, too", file.option, other, path);
        taken.emplace_back(file.option, path);
    }
}

/// text, json or csv
std::string report_format(const Arguments& arguments, const std::string& path) {
    if (const auto format = arguments.get("format")) return *format;
    static const std::vector<std::string> known = {".json", ".csv", ".txt"};
    io::require_extension(path, known, "--format names what is written under any name");
    const std::string extension = io::extension_of(path);
    if (extension == ".csv") return "csv";
    return is_terminal(path) || extension == ".txt" ? "text" : "json";
}

// Sets wait to be measured side by side, a few megabytes at a time.
constexpr std::size_t large = std::size_t{1} << 18;     // coordinates of a set that does not
constexpr std::size_t together = std::size_t{1} << 20;  // of all that wait
constexpr std::size_t most_waiting = std::size_t{1} << 12;

/// A set with where it was found.
struct FoundSet {
    PointSet points;
    std::string source;
    std::optional<std::size_t> number;  ///< in its file, of several
    std::string kind;                   ///< sets of one kind have a mean
};

/// What sets that may be averaged have in common: how they were made, but for the seed, as far as it
/// is known; else their number of points.
/// @param count of this set, or of the first in its file
std::string kind_of(const Provenance& made, std::uint64_t count) {
    if (made.generator.empty()) return fmt::format("{} points", count);
    std::string kind = made.generator;
    for (const auto& [name, value] : made.options) kind += fmt::format(" {}={}", name, value);
    for (const std::string& warp : made.warps) kind += " -w " + warp;
    // A count that was not asked for may differ from seed to seed.
    if (made.command.find(" --count ") != std::string::npos)
        kind += fmt::format(" -n {}", made.count);
    return fmt::format("{} {} {} {}", kind, made.start, made.shard, made.bounds);
}

/// The sets of one kind, for their mean.
struct Group {
    Values options;  ///< those asked for, and what the first set decides
    ReportAverage average = {};
    std::vector<Report> singles = {};  ///< what was averaged, where it is needed
};

/// What became of a set that was measured beside others; nothing where a stop came before it.
struct Outcome {
    std::optional<Measurement> measurement;
    std::exception_ptr error;
    bool over_limit = false;  ///< it would need more than its share of the memory, say
    std::vector<std::string> warnings;
};

/// One call: its measurements, checks and outputs.
class Analysis {
  public:
    Analysis(const Arguments& arguments, Session& session, Ranks& ranks)
        : arguments_(arguments),
          session_(session),
          ranks_(ranks),
          analyzer_(find_analyzer(arguments.unit)),
          asked_(settings_of(analyzer_.options, arguments)),
          options_(asked_),
          inputs_(input_names(arguments)),
          path_(output_of(arguments)),
          format_(report_format(arguments, path_)),
          pooled_(arguments.has("pool")),
          averaged_(arguments.has("average") || pooled_),
          strengths_(text_of(analyzer_.strengths).value_or("")) {
        for (const auto& text : arguments.all("check"))
            checks_.push_back(check_of(text, analyzer_));
    }

    int go() {
        check_domain(arguments_, analyzer_);
        check_side_files(options_, path_);
        warn_of_units();
        if (ranks_.size() > 1)
            share();
        else
            arguments_.has("generate") ? add_generated() : add_inputs();
        measure_waiting();
        if (ranks_.rank() > 0) return 0;  // rank 0 speaks
        if (interrupted()) return print_what_is_known();
        if (averaged_) finish_averages();
        save_wisdom();
        const bool fine = verdict();
        print();
        files_.commit();
        return fine ? 0 : 1;
    }

  private:
    /// Distances in a box whose sides measure different things mean little.
    void warn_of_units() const {
        const auto bounds = arguments_.get("bounds");
        if (!bounds || !options_.try_find("metric")) return;
        const auto ranges = std::ranges::count(*bounds, ',') + 1;
        const Box box = parse_box(*bounds, static_cast<std::size_t>(ranges));
        std::vector<double> sides;
        for (std::size_t k = 0; k < box.dimension(); ++k) sides.push_back(box.extent(k));
        const auto [shortest, longest] = std::ranges::minmax(sides);
        if (longest > shortest)
            session_.warn(
                fmt::format("the sides of --bounds are between {} and {} long, and distances mix "
                            "their units; --rescale maps the points to the unit cube first",
                            format_number(shortest), format_number(longest)));
    }

    /// One set, by all ranks.
    void share() {
        if (!analyzer_.sharing)
            fail_with_hint(ErrorKind::usage,
                           "start one process; 'stipple study' shares many sets out",
                           "analyze: ranks do not share {}", analyzer_.name);
        if (arguments_.has("rescale"))
            fail(ErrorKind::usage, "--rescale: ranks see a part of the points; give --bounds");
        if (!arguments_.has("generate") && (inputs_.size() > 1 || inputs_.front() == "-"))
            fail(ErrorKind::usage, "analyze: ranks share one set; name its files{}",
                 inputs_.size() > 1 ? " with --concat" : "");
        if (arguments_.integer("sets").value_or(1) > 1)
            fail_with_hint(ErrorKind::usage, "'stipple study' shares many sets out",
                           "--sets: ranks share one");
        if (arguments_.has("generate")) return measure_together(*arguments_.get("generate"));
        refuse_generated_options(arguments_);
        naming(inputs_.front(), [this] { measure_together(inputs_.front()); });
    }

    void measure_together(const std::string& source) {
        SharedSet set;
        Measurement m = timed(source, {}, set.points.domain, [&] {
            set = arguments_.has("generate")
                      ? shared_generated()
                      : shared_files(arguments_, analyzer_, strengths_, ranks_, own_run());
            if (analyzer_.sharing.together) return Found{searched_together(set), *set.points.count};
            return analyze_shared(analyzer_, set, options_, ranks_, own_run()).value_or(Found{});
        });
        if (ranks_.rank() == 0) keep(std::move(m), {}, false);
    }

    SharedSet shared_generated() {
        const auto generated = std::make_shared<GeneratedSets>(asked_sets());
        const RunContext run = own_run();
        const auto count = generated->streamed();
        if (!count && !analyzer_.sharing.together)
            fail(ErrorKind::usage,
                 "--generate: ranks share sequences; {} makes its points all together",
                 *arguments_.get("generate"));
        if (!count) return shared_in_memory(generated->made(0, run));
        return {.points = {.domain = generated->domain(), .count = *count},
                .from = [=](std::uint64_t first) { return generated->stream(0, run, first); }};
    }

    /// This rank's part of the run: nothing that the others say, too.
    [[nodiscard]] RunContext own_run() const {
        RunContext run = session_.run();
        run.threads = threads_of(ranks_, run);
        if (ranks_.rank() == 0) return run;
        run.progress = {};
        run.warn = {};
        return run;
    }

    /// All ranks have all points.
    [[nodiscard]] Report searched_together(const SharedSet& set) const {
        const RunContext run = own_run();
        std::optional<PointSet> points;
        agreed(ranks_, [&] {
            const std::size_t d = set.points.dimension();
            const std::size_t size = *set.points.count * d;
            run.need_memory(8.0 * static_cast<double>(size), "the points");
            std::vector<double> rows(size);
            set.from(0)(rows);
            points.emplace(std::move(rows), d);
            points->domain = set.points.domain;
            check_dimension(analyzer_, d);
            require_unit_cube(*points);
        });
        return analyzer_.sharing.together(*points, options_, ranks_, run);
    }

    /// What --generate names.
    GeneratedSets asked_sets() {
        arguments_.refuse({"bounds", "rescale", "domain", "column", "from", "dtype", "input-dtype"},
                          "is of points from files, not of --generate");
        if (!arguments_.inputs.empty())
            fail(ErrorKind::usage, "--generate takes no INPUT; '{}' is given",
                 arguments_.inputs.front());
        if (!strengths_.empty())
            fail(ErrorKind::usage, "--weights: generated points have no strengths");
        const auto spec = arguments_.all("generate");
        return generated_sets(spec.back(), seed_for(arguments_, spec, session_), arguments_,
                              own_run());
    }

    void add_generated() {
        const GeneratedSets generated = asked_sets();
        const std::string text = *arguments_.get("generate");
        const std::uint64_t sets = generated.sets();
        const auto count = generated.streamed();
        RunContext quiet = session_.run();
        if (sets > 1) quiet.progress = {};
        for (std::uint64_t set = 0; set < sets && !interrupted(); ++set) {
            session_.run().tick(set, sets);
            if (analyzer_.accumulate && count)
                keep(measured_in_blocks({generated.domain(), count}, generated.stream(set, quiet),
                                        text, number_of(set, sets), quiet),
                     {}, sets > 1);
            else
                add({of_the_cube(generated.made(set, quiet), analyzer_),
                     text,
                     number_of(set, sets),
                     {}});
        }
    }

    void add_inputs() {
        refuse_generated_options(arguments_);
        const bool in_blocks = analyzer_.accumulate && !arguments_.has("rescale");
        if (!in_blocks && !strengths_.empty())
            fail(ErrorKind::usage, "--rescale and --weights: give --bounds in place of --rescale");
        for (const std::string& input : inputs_)
            if (!interrupted()) in_blocks ? add_stream(input) : add_sets(input);
    }

    /// A set's number, where there are several.
    static std::optional<std::size_t> number_of(std::size_t set, std::size_t of) {
        return of > 1 ? std::optional(set) : std::nullopt;
    }

    /// What work() finds of a set on the domain, with the time that it takes.
    template <class Work>
    [[nodiscard]] Measurement timed(const std::string& source, std::optional<std::size_t> set,
                                    const DomainPtr& domain, const Work& work) const {
        const auto start = std::chrono::steady_clock::now();
        Found found = work();
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
        return {.analyzer = analyzer_.name,
                .source = source,
                .set = set,
                .count = found.count,
                .dimension = domain->dimension(),
                .domain = domain->spec(),
                .options = typed_settings(options_, analyzer_.options),
                .results = std::move(found.report),
                .seconds = seconds.count()};
    }

    /// The text of an option of the analyzer, where it is given.
    [[nodiscard]] std::optional<std::string> text_of(std::string_view name) const {
        const auto* option = options_.try_find(name);
        if (option == nullptr || !option->given) return std::nullopt;
        return format_value(option->value);
    }

    void add_sets(const std::string& input) {
        std::vector<PointSet> sets;
        before_errors([&] { sets = read_input(input, arguments_, session_.run()); });
        const std::uint64_t count = sets.empty() ? 0 : sets[0].count();
        for (std::size_t set = 0; set < sets.size() && !interrupted(); ++set) {
            before_errors([&] {
                naming(input,
                       [&] { sets[set] = prepared(std::move(sets[set]), analyzer_, arguments_); });
            });
            std::string kind = averaged_ ? kind_of(sets[set].provenance, count) : "";
            add({std::move(sets[set]), input, number_of(set, sets.size()), std::move(kind)});
        }
    }

    /// Prefixes of sets whose points come in no order, or in that of their places, tell little.
    void warn_of_prefixes(const Provenance& made) {
        if (told_of_prefixes_ || !(text_of("prefixes") || text_of("every"))) return;
        const Generator* generator = generator_named(made.generator);
        const bool progressive =
            std::ranges::find(made.options, std::pair<std::string, std::string>(
                                                "order", "progressive")) != made.options.end();
        if (!generator || generator->traits.prefix || progressive) return;
        told_of_prefixes_ = true;
        session_.warn(fmt::format(
            "{} makes sets as a whole: their prefixes are not sets of its kind", made.generator));
    }

    /// Takes a set, and measures those that wait when they have become many. Large sets do not
    /// wait: they get all threads, and the memory, for themselves.
    void add(FoundSet set) {
        warn_of_prefixes(set.points.provenance);
        const std::size_t numbers = set.points.flat().size();
        if (numbers >= large) measure_waiting();
        waiting_.push_back(std::move(set));
        numbers_ += numbers;
        if (numbers >= large || numbers_ >= together || waiting_.size() >= most_waiting)
            measure_waiting();
    }

    /// Measures the sets that wait side by side. What comes of them is kept in their order, as if they
    /// had been measured one after the other: up to the first error or, where a stop is requested,
    /// of those that had begun and were measured nevertheless.
    void measure_waiting() {
        numbers_ = 0;
        const std::vector<FoundSet> sets = std::exchange(waiting_, {});
        const RunContext& run = session_.run();
        const std::size_t threads = run.thread_count();
        // The last ones, too few for a thread each, are measured by all threads one after the other.
        const std::size_t spread = threads > 1 ? sets.size() - sets.size() % threads : 0;
        std::vector<Outcome> outcomes(spread);
        // A set that has begun may come to a result when a stop is requested.
        for_each_block(unstopped(run), spread, 1, [&](const Block& block) {
            if (!interrupted())
                outcomes[block.index] =
                    measured_alone(sets[block.index], run.share_of_memory(threads));
        });
        for (std::size_t i = 0; i < sets.size(); ++i) {
            const bool again = i >= spread || outcomes[i].over_limit;
            if (again && interrupted()) continue;
            if (again) {
                keep_found(sets[i], measured(sets[i], run));
                continue;
            }
            for (const auto& sentence : outcomes[i].warnings) run.notify(sentence);
            if (outcomes[i].error) std::rethrow_exception(outcomes[i].error);
            if (outcomes[i].measurement) keep_found(sets[i], std::move(*outcomes[i].measurement));
        }
    }

    /// Measures a set by one thread, beside others.
    [[nodiscard]] Outcome measured_alone(const FoundSet& set, RunContext one) const {
        Outcome outcome;
        one.threads = 1;
        one.progress = {};
        one.warn = [&outcome](const std::string& text) { outcome.warnings.push_back(text); };
        try {
            outcome.measurement = measured(set, one);
        } catch (const Error& e) {
            outcome.error = std::current_exception();
            outcome.over_limit = e.kind() == ErrorKind::limit;
        } catch (...) {
            outcome.error = std::current_exception();
        }
        return outcome;
    }

    void keep_found(const FoundSet& set, Measurement m) {
        keep(std::move(m), set.kind, inputs_.size() > 1 || set.number);
    }

    /// Errors of an input are reported after the sets before it have been measured.
    template <class Work>
    void before_errors(const Work& work) {
        try {
            work();
        } catch (...) {
            measure_waiting();
            throw;
        }
    }

    /// Sets of any size, in blocks.
    void add_stream(const std::string& input) {
        const RunContext& run = session_.run();
        const auto stream = open_input(input, arguments_, run, strengths_);
        const std::size_t before = measurements_.size();
        std::size_t sets = 0;
        std::string kind;  // not known of the first set before it is counted, where nobody says it
        for (; stream->next_set(); ++sets)
            naming(input, [&] {
                const NextRows read = [&](std::span<double> rows) { return stream->read(rows); };
                const Arrival points =
                    arrival_of(*stream, !strengths_.empty(), analyzer_, arguments_, run);
                const Provenance& made = stream->provenance();
                if (averaged_ && !made.generator.empty()) kind = kind_of(made, 0);
                if (averaged_) options_ = options_for(kind, points.dimension());
                Measurement m = measured_in_blocks(
                    points, within_bounds(read, points, 0, analyzer_, arguments_), input, sets,
                    run);
                if (averaged_ && kind.empty()) kind = kind_of(made, m.count);
                keep(std::move(m), kind, inputs_.size() > 1 || sets > 0);
            });
        if (sets == 1 && measurements_.size() == before + 1) measurements_.back().set.reset();
    }

    /// Measures a set that comes in blocks.
    [[nodiscard]] Measurement measured_in_blocks(const Arrival& arrival, const NextRows& next,
                                                 const std::string& source,
                                                 std::optional<std::size_t> set,
                                                 const RunContext& run) const {
        return timed(source, set, arrival.domain,
                     [&] { return stipple::analyze(analyzer_, arrival, next, options_, run); });
    }

    /// The run, its warnings with the set in front where there are others.
    [[nodiscard]] RunContext naming_set(const FoundSet& set, const RunContext& run) const {
        RunContext named = run;
        if (!set.number && arguments_.inputs.size() <= 1) return named;
        std::string name = io::source_name(set.source);
        if (set.number) name += fmt::format(", set {}", *set.number);
        named.warn = [&run, name](const std::string& sentence) {
            run.notify(fmt::format("{}: {}", name, sentence));
        };
        return named;
    }

    [[nodiscard]] Measurement measured(const FoundSet& set, const RunContext& run) const {
        const RunContext named = naming_set(set, run);
        return timed(set.source, set.number, set.points.domain, [&] {
            return naming(set.source, [&] {
                return Found{stipple::analyze(analyzer_, set.points, options_, named),
                             set.points.count()};
            });
        });
    }

    /// What the group of a kind is called; sets of different dimensions are never of one kind.
    [[nodiscard]] std::string group_name(const std::string& kind, std::size_t dimension) const {
        return pooled_ ? "" : fmt::format("{} {}", dimension, kind);
    }

    /// What the next set is measured with: where others of its kind came before it, as these.
    [[nodiscard]] Values options_for(const std::string& kind, std::size_t dimension) const {
        const auto it = group_indices_.find(group_name(kind, dimension));
        return it == group_indices_.end() ? asked_ : groups_[it->second].options;
    }

    /// The group of a kind, which begins where there is none.
    std::size_t group_of(const std::string& kind, std::size_t dimension) {
        const auto [it, is_new] =
            group_indices_.emplace(group_name(kind, dimension), groups_.size());
        if (is_new) groups_.push_back({asked_});
        return it->second;
    }

    /// Takes one set's results, `several` if there are others.
    void keep(Measurement m, const std::string& kind, bool several) {
        if (!averaged_) {
            save_grid(m.results, measurements_.size(), several);
            measurements_.push_back(std::move(m));
            return;
        }
        const std::size_t index = group_of(kind, m.dimension);
        Group& group = groups_[index];
        if (index < measurements_.size() && measurements_[index].dimension != m.dimension)
            fail(ErrorKind::usage, "--pool: the sets have points of {} and of {} coordinates",
                 measurements_[index].dimension, m.dimension);
        group.average.add(m.results);
        if (analyzer_.combine) group.singles.push_back(numbers_only(m.results));
        if (group.average.count() > 1) return add_to(measurements_[index], m);
        if (analyzer_.follow) analyzer_.follow(m.results, group.options);
        options_ = group.options;
        measurements_.push_back(std::move(m));
    }

    /// Adds to what a mean says of its sets.
    static void add_to(Measurement& mean, const Measurement& m) {
        mean.seconds += m.seconds;
        if (mean.source != m.source) mean.source += ", " + m.source;
        const std::uint64_t largest = std::max({mean.count, mean.largest_count, m.count});
        mean.count = std::min(mean.count, m.count);
        if (mean.count != largest) mean.largest_count = largest;
    }

    void warn_of_sizes(const Group& group) const {
        std::vector<std::string> followed;  // options that the first set decided
        for (const auto& item : group.options.items())
            if (item != asked_.find(item.name))
                followed.push_back(fmt::format("--{} {}", item.name, format_value(item.value)));
        std::string text = "the sets that were averaged differ in their number of points";
        if (!followed.empty())
            text += fmt::format("; all are measured with {}, as the first", join(followed, " "));
        session_.warn(text);
    }

    void finish_averages() {
        for (std::size_t i = 0; i < groups_.size(); ++i) {
            Measurement& m = measurements_[i];
            const Group& group = groups_[i];
            m.set.reset();
            take_mean(m, group.average, group.singles, analyzer_, group.options);
            if (m.largest_count > 0) warn_of_sizes(group);
            save_grid(m.results, i, groups_.size() > 1);
        }
        if (groups_.size() > 1)
            session_.warn(
                fmt::format("the sets are of {} kinds, and each kind has its own mean; --pool "
                            "gives one mean of all",
                            groups_.size()));
    }

    void save_grid(const Report& results, std::size_t number, bool several) {
        const auto* grid = std::get_if<Grid>(results.find("grid"));
        for (const std::string name : {"grid", "image"}) {
            auto path = text_of(name);
            if (!path) continue;
            if (grid == nullptr)
                fail(ErrorKind::input, "--{}: there is no grid for points of this dimension", name);
            if (several && path->find("{set}") == std::string::npos)
                fail(ErrorKind::usage, "--{}: several sets need a name with {{set}}, or --average",
                     name);
            replace_all(*path, "{set}", std::to_string(number));
            save_beside(*path,
                        name == "grid" ? npy_bytes(*grid) : png_bytes(*grid, picture(results)));
        }
    }

    void save_wisdom() {
        if (const auto path = text_of("wisdom")) save_beside(*path, wisdom_text());
    }

    /// Files that come with the report are put in their places with it.
    void save_beside(const std::string& path, const std::string& bytes) {
        files_.add(path, session_.run().stop).write(bytes);
    }

    /// How the options say that a grid is drawn.
    [[nodiscard]] PowerPicture picture(const Report& results) const {
        PowerPicture picture;
        if (const auto* reach = results.find("max_distance"))
            picture.differences = std::get<double>(*reach);
        if (const auto* scale = options_.try_find("image-scale"))
            picture.scale = std::get<std::string>(scale->value);
        if (const auto* bits = options_.try_find("image-bits"))
            picture.bits = std::get<std::string>(bits->value) == "16" ? 16 : 8;
        if (const auto* slice = options_.try_find("slice"))
            picture.slice = std::get<std::int64_t>(slice->value);
        return picture;
    }

    /// What is found where a check does not hold; nothing where it does.
    [[nodiscard]] std::optional<std::string> broken(const Check& check,
                                                    const Report& results) const {
        // What averaged sets disagree on is not in their mean, and holds for none of it.
        if (averaged_ && !results.find(check.key) && find_result(analyzer_, check.key))
            return "not the same for all sets";
        if (check.holds(results)) return std::nullopt;
        return check.found(results);
    }

    /// Whether all checks and expectations hold; says which do not.
    bool verdict() {
        for (const Measurement& m : measurements_) {
            for (const auto& sentence : m.results.unmet())
                unmet_.push_back(fmt::format("{}: {}", m.source, sentence));
            for (const Check& check : checks_)
                if (const auto found = broken(check, m.results))
                    unmet_.push_back(fmt::format("{}: {}{}{} does not hold: it is {}", m.source,
                                                 check.key, check.op, check.value, *found));
        }
        for (const auto& sentence : unmet_) say_line(sentence);
        return unmet_.empty();
    }

    [[nodiscard]] bool interrupted() const { return session_.run().stop.stop_requested(); }

    /// Results that came back although a stop was requested are as good as was possible till then;
    /// a mean of some sets would not be what was asked for, nor would a file.
    int print_what_is_known() {
        if (averaged_ || path_ != "-" || ranks_.size() > 1) session_.run().check_stop();
        print();
        say_line("interrupted");
        constexpr int exit_code = 130;
        return exit_code;
    }

    void print() {
        files_.add(path_, std::stop_token())
            .write(format_ == "json"  ? to_json(measurements_)
                   : format_ == "csv" ? to_csv(measurements_)
                                      : to_text(measurements_));
    }

    const Arguments& arguments_;
    Session& session_;
    Ranks& ranks_;
    const Analyzer& analyzer_;
    Values asked_;
    Values options_;  ///< for the next set
    std::vector<std::string> inputs_;
    std::string path_;
    std::string format_;
    bool pooled_;  ///< sets of all kinds have one mean
    bool averaged_;
    bool told_of_prefixes_ = false;
    std::string strengths_;  ///< the column of strengths that was asked for
    std::vector<Check> checks_;
    std::vector<Measurement> measurements_;
    std::vector<std::string> unmet_;
    std::vector<Group> groups_;  ///< of a measurement each, where these are means
    std::map<std::string, std::size_t> group_indices_;
    std::vector<FoundSet> waiting_;  ///< to be measured
    std::size_t numbers_ = 0;        ///< coordinates of these
    io::Outputs files_;              ///< the report, and what comes with it
};

}  // namespace

void take_mean(Measurement& m, const ReportAverage& average, std::span<const Report> sets,
               const Analyzer& analyzer, const Values& options) {
    m.sets = average.count();
    m.results = average.mean();
    if (analyzer.refine) analyzer.refine(m.results, average.count(), options);
    if (analyzer.combine) analyzer.combine(m.results, sets, options);
    if (average.count() > 1) m.standard_error = average.standard_error(m.results);
}

int analyze(const Arguments& arguments, Session& session) {
    return Analysis(arguments, session, launched("analyze", session.run())).go();
}

}  // namespace stipple::cli
