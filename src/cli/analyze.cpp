// SPDX-License-Identifier: MIT
//
// The verb `analyze`: point sets in, results out.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <optional>

#include "cli/set_batch.hpp"
#include "cli/verbs.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "io/files.hpp"
#include "math/transform.hpp"
#include "report/average.hpp"
#include "report/check.hpp"
#include "report/document.hpp"
#include "report/grid_files.hpp"
#include "study/chain.hpp"
#include "study/generated.hpp"
#include "study/pipeline.hpp"

namespace stipple::cli {
namespace {

/// The box of the points' extremes, with a direction that has no extent made as wide as 1.
Box box_around(const PointSet& points) {
    const std::vector<double> first(points[0].begin(), points[0].end());
    Box box = bounding_box(points.flat(), {first, first});
    for (std::size_t k = 0; k < box.dimension(); ++k)
        if (!(box.high[k] > box.low[k])) box.high[k] = box.low[k] + 1;
    return box;
}

/// Of points the first of which is point `first`; a row may hold more than the box has coordinates.
/// @throws Error(input) for points outside.
void require_inside(std::span<const double> rows, std::size_t width, const Box& box,
                    std::uint64_t first) {
    const DomainPtr domain = box_domain(box);
    const std::size_t d = box.dimension();
    for (std::size_t i = 0; i < rows.size(); i += width)
        if (!domain->contains(rows.subspan(i, d)))
            fail(ErrorKind::input, "point {} is outside the bounds {}", first + i / width,
                 format_box(box));
}

/// Makes points of the box points of the unit cube.
void into_unit_cube(std::span<double> rows, std::size_t width, const Box& box) {
    const DomainPtr domain = box_domain(box);
    const std::size_t d = box.dimension();
    for (std::size_t i = 0; i < rows.size(); i += width)
        domain->to_cube(rows.subspan(i, d), rows.subspan(i, d));
}

/// @throws Error(input) for points outside the box.
PointSet to_unit_cube(PointSet points, const Box& box) {
    require_inside(points.flat(), box.dimension(), box, 0);
    into_unit_cube(points.flat(), box.dimension(), box);
    points.domain = unit_cube(points.dimension());
    return points;
}

void check_bounds(const Arguments& arguments) {
    for (const char* other : {"rescale", "domain"})
        if (arguments.has("bounds") && arguments.has(other))
            fail(ErrorKind::usage, "--bounds and --{}: give one of them", other);
}

/// Points of another domain may lie in the cube and be no sample of it.
/// @throws Error(input) where the set says that it has another domain.
PointSet of_the_cube(PointSet points, const Analyzer& analyzer) {
    const std::string domain = points.domain->spec();
    const auto outside = [](double x) { return !(x >= 0 && x <= 1); };
    if (!analyzer.traits.unit_cube || domain == "unit-cube" ||
        (domain.starts_with("box") &&
         points.domain->bounding_box() == unit_cube(points.dimension())->bounding_box()) ||
        std::ranges::any_of(points.flat(), outside))  // which is said with the first of them
        return points;
    fail_with_hint(ErrorKind::input,
                   "--rescale or --bounds lo..hi moves points into the cube; --domain unit-cube "
                   "takes them as they are",
                   "{} measures points against the unit cube; the domain of these is {}",
                   analyzer.name, domain);
}

/// --bounds says what box the points live on. Analyzers of the unit cube get them mapped to it; the
/// others measure them where they are, distances and integrals in the box.
PointSet prepared(PointSet points, const Analyzer& analyzer, const Arguments& arguments) {
    const auto bounds = arguments.get("bounds");
    check_bounds(arguments);
    if (const auto domain = arguments.get("domain"))
        points.domain = parse_domain(*domain, points.dimension());
    if (bounds) {
        const Box box = parse_box(*bounds, points.dimension());
        if (analyzer.traits.unit_cube) return to_unit_cube(std::move(points), box);
        require_inside(points.flat(), box.dimension(), box, 0);
        points.domain = box_domain(box);
        return points;
    }
    if (arguments.has("rescale")) {
        const Box box = box_around(points);
        return to_unit_cube(std::move(points), box);
    }
    return of_the_cube(std::move(points), analyzer);
}

bool tells(const Analyzer& analyzer, std::string_view key) {
    return std::ranges::any_of(analyzer.results, [&](const auto& r) { return r.key == key; });
}

/// A condition; --check alone asks whether the set is valid.
Check check_of(const std::string& text, const Analyzer& analyzer) {
    if (text != bare_check) return parse_check(text);
    if (tells(analyzer, "valid")) return {.key = "valid", .op = "==", .value = "true"};
    std::vector<std::string> keys;
    for (const ResultKey& result : analyzer.results) keys.push_back(result.key);
    fail_with_hint(ErrorKind::usage, "its results are " + join(keys, ", "),
                   "--check: {} does not tell whether a set is valid; expected KEY<VALUE, with <, "
                   "<=, >, >=, == or !=",
                   analyzer.name);
}

/// @throws Error(usage) for a domain that the analyzer would not heed.
void check_domain(const Arguments& arguments, const Analyzer& analyzer) {
    const auto named = arguments.get("domain");
    const bool moved = arguments.has("bounds") || arguments.has("rescale");
    if (!named || *named == "unit-cube" || moved || !analyzer.traits.unit_cube) return;
    fail_with_hint(ErrorKind::usage, "--rescale or --bounds lo..hi moves points into the cube",
                   "--domain: {} measures points against the unit cube, not against {}",
                   analyzer.name, *named);
}

enum class Style { text, json, csv };

Style style_of(const Arguments& arguments, const std::string& path) {
    const auto format = arguments.get("format");
    if (format == "text") return Style::text;
    if (format == "json") return Style::json;
    if (format == "csv") return Style::csv;
    if (format) fail(ErrorKind::usage, "--format: '{}' is not one of text, json, csv", *format);
    if (path.ends_with(".csv")) return Style::csv;
    if (path.ends_with(".txt")) return Style::text;
    return path == "-" && isatty(STDOUT_FILENO) == 1 ? Style::text : Style::json;
}

/// What sets are from; joined ones are from all at once.
std::vector<std::string> inputs_of(const Arguments& arguments) {
    if (arguments.inputs.empty()) return {"-"};
    return arguments.has("concat") ? std::vector{join(arguments.inputs, ", ")} : arguments.inputs;
}

/// The measurements of one call, and what is to be done with them.
class Analysis {
  public:
    Analysis(const Arguments& arguments, Session& session)
        : arguments_(arguments),
          session_(session),
          analyzer_(find_analyzer(arguments.unit)),
          options_(settings_of(analyzer_.options, arguments)),
          joined_(arguments.has("concat")),
          inputs_(inputs_of(arguments)),
          path_(arguments.get("output").value_or("-")),
          style_(style_of(arguments, path_)),
          averaged_(arguments.has("average")),
          batch_(
              session.run(),
              [this](const FoundSet& set, const RunContext& run) { return measured(set, run); },
              [this](const FoundSet& set, Measurement m) {
                  keep(std::move(m), inputs_.size() > 1 || set.of > 1);
              }) {
        for (const auto& text : arguments.all("check"))
            checks_.push_back(check_of(text, analyzer_));
        for (const Option& option : analyzer_.options.options()) {
            const auto& item = options_.find(option.name);
            if (!option.optional || item.given)
                shown_options_.emplace_back(option.name, format_value(item.value));
        }
    }

    int go() {
        check_bounds(arguments_);
        check_domain(arguments_, analyzer_);
        if (arguments_.has("generate"))
            add_generated();
        else
            add_inputs();
        batch_.finish();
        if (interrupted()) return print_what_is_known();
        if (averaged_) finish_average();
        const bool fine = verdict();
        print();
        return fine ? 0 : 1;
    }

  private:
    using Clock = std::chrono::steady_clock;

    void add_inputs() {
        for (const char* name : {"count", "seed", "sets", "warp", "start"})
            if (arguments_.has(name))
                fail(ErrorKind::usage, "--{}: is of --generate, which names a generator", name);
        const bool in_blocks = analyzer_.accumulate && !arguments_.has("rescale");
        if (!in_blocks && !strengths().empty())
            fail(ErrorKind::usage, "--rescale and --weights: give --bounds in place of --rescale");
        for (const std::string& input : inputs_)
            if (!interrupted()) in_blocks ? add_stream(input) : add_sets(input);
    }

    /// Sets that are not in files.
    void add_generated() {
        for (const char* name : {"bounds", "rescale", "domain", "column", "from", "dtype"})
            if (arguments_.has(name))
                fail(ErrorKind::usage, "--{}: is of points from files, not of --generate", name);
        if (!arguments_.inputs.empty())
            fail(ErrorKind::usage, "--generate takes no INPUT; '{}' is given",
                 arguments_.inputs.front());
        if (!strengths().empty())
            fail(ErrorKind::usage, "--weights: generated points have no strengths");
        const std::string text = *arguments_.get("generate");
        const Spec spec = parse_spec(text);
        const Generator& generator = find_generator(spec.name);
        Values values = spec.values(generator.options);
        Request request = request_of(arguments_);
        const auto& max_seed = generator.max_seed;
        request.seed =
            seed_of(arguments_, max_seed ? max_seed(values) : ~std::uint64_t{0}, session_);
        std::vector<Spec> warps;
        for (const auto& warp : arguments_.all("warp")) warps.push_back(parse_spec(warp));
        const std::uint64_t sets = arguments_.integer("sets", 1, 1'000'000'000).value_or(1);
        const GeneratedSets generated(generator, std::move(values), std::move(request), sets,
                                      std::move(warps), session_.run());
        for (std::uint64_t set = 0; set < sets && !interrupted(); ++set) {
            session_.run().tick(set, sets);
            add_generated(generated, set, text);
        }
    }

    void add_generated(const GeneratedSets& generated, std::uint64_t set, const std::string& text) {
        RunContext quiet = session_.run();
        if (generated.sets() > 1) quiet.progress = {};
        const auto start = Clock::now();
        const auto count = generated.streamed();
        if (!analyzer_.accumulate || !count) {
            batch_.add(
                {of_the_cube(generated.made(set, quiet), analyzer_), text, set, generated.sets()});
            return;
        }
        Found found =
            stipple::analyze(analyzer_, {generated.domain(), count}, generated.dimension(),
                             generated.stream(set, quiet), options_, quiet);
        Measurement m = measurement(text, set, found.count, *generated.domain());
        m.results = std::move(found.report);
        m.seconds = seconds_since(start);
        if (generated.sets() == 1) m.set.reset();
        keep(std::move(m), generated.sets() > 1);
    }

    static double seconds_since(Clock::time_point start) {
        return std::chrono::duration<double>(Clock::now() - start).count();
    }

    [[nodiscard]] Measurement measurement(const std::string& source, std::size_t set,
                                          std::uint64_t count, const Domain& domain) const {
        return {.analyzer = analyzer_.name,
                .source = source,
                .set = set,
                .count = count,
                .dimension = domain.dimension(),
                .domain = domain.spec(),
                .options = shown_options_};
    }

    /// The column of strengths that was asked for.
    [[nodiscard]] std::string strengths() const {
        const auto* option = options_.try_find(analyzer_.strengths);
        return option != nullptr && option->given ? std::get<std::string>(option->value) : "";
    }

    void add_sets(const std::string& input) {
        std::vector<PointSet> sets;
        before_errors([&] {
            sets = joined_ ? read_joined(arguments_, session_.run())
                           : read_input(input, arguments_, session_.run());
        });
        for (std::size_t set = 0; set < sets.size() && !interrupted(); ++set) {
            before_errors([&] {
                naming(input,
                       [&] { sets[set] = prepared(std::move(sets[set]), analyzer_, arguments_); });
            });
            batch_.add({std::move(sets[set]), input, set, sets.size()});
        }
    }

    /// What is wrong with an input is said when the sets before it have been measured.
    template <class Work>
    void before_errors(const Work& work) {
        try {
            work();
        } catch (...) {
            batch_.finish();
            throw;
        }
    }

    /// What is wrong with a set's points is said with the file that they are from.
    template <class Work>
    static void naming(const std::string& input, const Work& work) {
        try {
            work();
        } catch (const Error& e) {
            const std::string name = input == "-" ? "stdin" : input;
            const std::string what = e.what();
            const auto named = [&](const auto& part) {
                return what.starts_with(std::string(part) + ":");
            };
            if (e.kind() != ErrorKind::input || named(name)) throw;
            // What is wrong with one of joined files names it.
            for (const auto part : split(name, ','))
                if (named(trim(part))) throw;
            throw Error(e.kind(), fmt::format("{}: {}", name, e.what()), e.hint());
        }
    }

    /// Sets of any size, in blocks.
    void add_stream(const std::string& input) {
        const auto stream = joined_ ? open_joined(arguments_, session_.run(), strengths())
                                    : open_input(input, arguments_, session_.run(), strengths());
        const std::size_t before = measurements_.size();
        std::size_t sets = 0;
        while (stream->next_set()) naming(input, [&] { add_arriving(*stream, input, sets++); });
        if (sets == 1 && measurements_.size() == before + 1) measurements_.back().set.reset();
    }

    [[nodiscard]] DomainPtr domain_of(const io::PointStream& stream, std::size_t d) const {
        if (const auto bounds = arguments_.get("bounds"))
            return analyzer_.traits.unit_cube ? unit_cube(d) : box_domain(parse_box(*bounds, d));
        if (const auto named = arguments_.get("domain")) return parse_domain(*named, d);
        return input_domain(stream.provenance(), d, arguments_, session_.run());
    }

    void take_bounds(std::span<double> rows, std::size_t width, const Box& box,
                     std::uint64_t first) const {
        require_inside(rows, width, box, first);
        if (analyzer_.traits.unit_cube) into_unit_cube(rows, width, box);
    }

    void add_arriving(io::PointStream& stream, const std::string& input, std::size_t set) {
        const auto start = Clock::now();
        const std::size_t width = stream.dimension();
        const bool weighted = !strengths().empty();
        const std::size_t d = width - (weighted ? 1 : 0);
        const DomainPtr domain = domain_of(stream, d);
        std::optional<Box> box;
        if (const auto bounds = arguments_.get("bounds")) box = parse_box(*bounds, d);
        std::uint64_t at = 0;
        const NextRows next = [&](std::span<double> rows) {
            const std::size_t count = stream.read(rows);
            if (box) take_bounds(rows.first(count * width), width, *box, at);
            at += count;
            return count;
        };
        Found found = stipple::analyze(analyzer_, {domain, stream.count(), weighted}, d, next,
                                       options_, session_.run());
        Measurement m = measurement(input, set, found.count, *domain);
        m.results = std::move(found.report);
        m.seconds = seconds_since(start);
        keep(std::move(m), inputs_.size() > 1 || set > 0);
    }

    /// The run, its warnings with the set in front where there are others.
    [[nodiscard]] RunContext naming_set(const FoundSet& set, const RunContext& run) const {
        RunContext named = run;
        if (set.of == 1 && arguments_.inputs.size() <= 1) return named;
        std::string name = set.source == "-" ? "stdin" : set.source;
        if (set.of > 1) name += fmt::format(", set {}", set.number);
        named.warn = [tell = run.warn, name](const std::string& sentence) {
            if (tell) tell(fmt::format("{}: {}", name, sentence));
        };
        return named;
    }

    [[nodiscard]] Measurement measured(const FoundSet& set, const RunContext& run) const {
        const auto start = Clock::now();
        const PointSet& points = set.points;
        Measurement m{.analyzer = analyzer_.name,
                      .source = set.source,
                      .set = set.of > 1 ? std::optional(set.number) : std::nullopt,
                      .count = points.count(),
                      .dimension = points.dimension(),
                      .domain = points.domain->spec(),
                      .options = shown_options_};
        const RunContext named = naming_set(set, run);
        naming(set.source,
               [&] { m.results = stipple::analyze(analyzer_, points, options_, named); });
        m.seconds = std::chrono::duration<double>(Clock::now() - start).count();
        return m;
    }

    /// Takes one set's results, `several` if there are others.
    void keep(Measurement m, bool several) {
        if (!averaged_) {
            save_grid(m.results, measurements_.size(), several);
            measurements_.push_back(std::move(m));
            return;
        }
        if (!measurements_.empty() && measurements_[0].dimension != m.dimension)
            fail(ErrorKind::usage, "--average: the sets have points of {} and of {} coordinates",
                 measurements_[0].dimension, m.dimension);
        average_.add(m.results);
        if (average_.count() == 1 && analyzer_.follow) analyzer_.follow(m.results, options_);
        if (analyzer_.combine) singles_.push_back(numbers_only(m.results));
        if (average_.count() == 1) {
            measurements_.push_back(std::move(m));
        } else {
            measurements_[0].seconds += m.seconds;
            if (measurements_[0].source != m.source) measurements_[0].source += ", " + m.source;
            different_ |= measurements_[0].count != m.count;
        }
    }

    void finish_average() {
        Measurement& m = measurements_[0];
        m.set.reset();
        m.sets = average_.count();
        m.results = average_.mean();
        if (analyzer_.refine) analyzer_.refine(m.results, average_.count(), options_);
        if (analyzer_.combine) analyzer_.combine(m.results, singles_, options_);
        if (average_.count() > 1) m.standard_error = only_of(m.results, average_.standard_error());
        if (different_)
            session_.warn("the sets that were averaged differ in their number of points");
        save_grid(m.results, 0, false);
    }

    void save_grid(const Report& results, std::size_t number, bool several) const {
        const auto* item = results.find("grid");
        const Grid* grid = item ? std::get_if<Grid>(item) : nullptr;
        for (const char* name : {"grid", "image"}) {
            const auto* option = options_.try_find(name);
            if (option == nullptr || !option->given) continue;
            std::string path = std::get<std::string>(option->value);
            if (grid == nullptr)
                fail(ErrorKind::input, "--{}: there is no grid for points of this dimension", name);
            const auto at = path.find("{set}");
            if (at != std::string::npos)
                path.replace(at, 5, std::to_string(number));
            else if (several)
                fail(ErrorKind::usage, "--{}: several sets need a name with {{set}}, or --average",
                     name);
            write_text(
                path, std::string(name) == "grid" ? npy_bytes(*grid) : png_bytes(*grid, picture()));
        }
        const auto* wisdom = options_.try_find("wisdom");
        if (wisdom && wisdom->given)
            write_text(std::get<std::string>(wisdom->value), wisdom_text());
    }

    /// How the options say that a grid is drawn.
    [[nodiscard]] PowerPicture picture() const {
        PowerPicture picture;
        if (const auto* scale = options_.try_find("image-scale"))
            picture.scale = std::get<std::string>(scale->value);
        if (const auto* bits = options_.try_find("image-bits"))
            picture.bits = std::get<std::string>(bits->value) == "16" ? 16 : 8;
        if (const auto* slice = options_.try_find("slice"))
            picture.slice = std::get<std::int64_t>(slice->value);
        return picture;
    }

    /// What averaged sets disagree on is not in their mean, and holds for none of it.
    bool lost(const Check& check, const Report& results) const {
        return averaged_ && !results.find(check.key) && tells(analyzer_, check.key);
    }

    bool holds(const Check& check, const Report& results) const {
        return !lost(check, results) && check.holds(results);
    }

    std::string found(const Check& check, const Report& results) const {
        return lost(check, results) ? "not the same for all sets" : check.found(results);
    }

    /// Whether all checks and expectations hold; says which do not.
    bool verdict() {
        for (const Measurement& m : measurements_) {
            for (const auto& sentence : m.results.unmet())
                unmet_.push_back(fmt::format("{}: {}", m.source, sentence));
            for (const Check& check : checks_)
                if (!holds(check, m.results))
                    unmet_.push_back(fmt::format("{}: {}{}{} does not hold: it is {}", m.source,
                                                 check.key, check.op, check.value,
                                                 found(check, m.results)));
        }
        for (const auto& sentence : unmet_) say(fmt::format("stipple: {}\n", sentence));
        return unmet_.empty();
    }

    [[nodiscard]] bool interrupted() const { return session_.run().stop.stop_requested(); }

    /// Results that came back although a stop was requested are as good as was possible till then;
    /// a mean of some sets would not be what was asked for, nor would a file.
    int print_what_is_known() const {
        if (averaged_ || path_ != "-") session_.run().check_stop();
        print();
        say("stipple: interrupted\n");
        constexpr int exit_code = 130;
        return exit_code;
    }

    void print() const {
        write_text(path_, style_ == Style::json  ? to_json(measurements_)
                          : style_ == Style::csv ? to_csv(measurements_)
                                                 : to_text(measurements_));
    }

    const Arguments& arguments_;
    Session& session_;
    const Analyzer& analyzer_;
    Values options_;
    bool joined_;  ///< all inputs are one set
    std::vector<std::string> inputs_;
    std::string path_;
    Style style_;
    bool averaged_;
    bool different_ = false;
    std::vector<Check> checks_;
    std::vector<std::pair<std::string, std::string>> shown_options_;
    std::vector<Measurement> measurements_;
    std::vector<std::string> unmet_;
    ReportAverage average_;
    std::vector<Report> singles_;  ///< what was averaged, where it is needed
    SetBatch batch_;
};

}  // namespace

int analyze(const Arguments& arguments, Session& session) {
    return Analysis(arguments, session).go();
}

}  // namespace stipple::cli
