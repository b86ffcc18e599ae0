// SPDX-License-Identifier: MIT
//
// The verb `analyze`: point sets in, results out.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <optional>

#include "cli/verbs.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "io/files.hpp"
#include "report/average.hpp"
#include "report/check.hpp"
#include "report/document.hpp"
#include "report/grid_files.hpp"
#include "study/chain.hpp"
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

/// Points of the box as points of the unit cube. @throws Error(input) for points outside.
PointSet to_unit_cube(const PointSet& points, const Box& box) {
    const DomainPtr domain = box_domain(box);
    PointSet out(points.count(), points.dimension());
    for (std::size_t i = 0; i < points.count(); ++i) {
        if (!domain->contains(points[i]))
            fail(ErrorKind::input, "point {} is outside the bounds {}", i, format_box(box));
        domain->to_cube(points[i], out[i]);
    }
    return out;
}

PointSet prepared(PointSet points, const Arguments& arguments) {
    const auto bounds = arguments.get("bounds");
    if (bounds && arguments.has("rescale"))
        fail(ErrorKind::usage, "--bounds and --rescale: give one of them");
    if (const auto domain = arguments.get("domain"))
        points.domain = parse_domain(*domain, points.dimension());
    if (bounds) return to_unit_cube(points, parse_box(*bounds, points.dimension()));
    if (arguments.has("rescale")) return to_unit_cube(points, box_around(points));
    return points;
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

/// The measurements of one call, and what is to be done with them.
class Analysis {
  public:
    Analysis(const Arguments& arguments, Session& session)
        : arguments_(arguments),
          session_(session),
          analyzer_(find_analyzer(arguments.unit)),
          options_(settings_of(analyzer_.options, arguments)),
          path_(arguments.get("output").value_or("-")),
          style_(style_of(arguments, path_)),
          averaged_(arguments.has("average")) {
        for (const auto& text : arguments.all("check"))
            checks_.push_back(check_of(text, analyzer_));
        for (const Option& option : analyzer_.options.options()) {
            const auto& item = options_.find(option.name);
            if (!option.optional || item.given)
                shown_options_.emplace_back(option.name, format_value(item.value));
        }
    }

    int go() {
        auto inputs = arguments_.inputs;
        if (inputs.empty()) inputs.emplace_back("-");
        for (const std::string& input : inputs) {
            auto sets = read_input(input, arguments_, session_.run());
            for (std::size_t set = 0; set < sets.size(); ++set)
                add_naming_source(std::move(sets[set]), input, set, sets.size());
        }
        if (averaged_) finish_average();
        const bool fine = verdict();
        print();
        return fine ? 0 : 1;
    }

  private:
    using Clock = std::chrono::steady_clock;

    /// What is wrong with a set's points is said with the file that they are from.
    void add_naming_source(PointSet points, const std::string& input, std::size_t set,
                           std::size_t sets) {
        try {
            add(prepared(std::move(points), arguments_), input, set, sets);
        } catch (const Error& e) {
            if (e.kind() != ErrorKind::input) throw;
            throw Error(e.kind(), fmt::format("{}: {}", input == "-" ? "stdin" : input, e.what()),
                        e.hint());
        }
    }

    void add(const PointSet& points, const std::string& input, std::size_t set, std::size_t sets) {
        const auto start = Clock::now();
        Measurement m{.analyzer = analyzer_.name,
                      .source = input,
                      .set = sets > 1 ? std::optional(set) : std::nullopt,
                      .count = points.count(),
                      .dimension = points.dimension(),
                      .domain = points.domain->spec(),
                      .options = shown_options_,
                      .results = stipple::analyze(analyzer_, points, options_, session_.run())};
        m.seconds = std::chrono::duration<double>(Clock::now() - start).count();
        if (!averaged_) {
            save_grid(m.results, measurements_.size(), arguments_.inputs.size() > 1 || sets > 1);
            measurements_.push_back(std::move(m));
            return;
        }
        average_.add(m.results);
        if (average_.count() == 1) {
            measurements_.push_back(std::move(m));
        } else {
            measurements_[0].seconds += m.seconds;
            if (measurements_[0].source != input) measurements_[0].source += ", " + input;
            different_ |= measurements_[0].count != m.count;
        }
    }

    void finish_average() {
        Measurement& m = measurements_[0];
        m.set.reset();
        m.sets = average_.count();
        m.results = average_.mean();
        if (analyzer_.refine) analyzer_.refine(m.results, average_.count(), options_);
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
            write_text(path, std::string(name) == "grid" ? npy_bytes(*grid) : png_bytes(*grid));
        }
    }

    /// What averaged sets disagree on is not in their mean, and holds for none of it.
    bool holds(const Check& check, const Report& results) const {
        const bool lost = averaged_ && !results.find(check.key) && tells(analyzer_, check.key);
        return !lost && check.holds(results);
    }

    /// Whether all checks and expectations hold; says which do not.
    bool verdict() {
        for (const Measurement& m : measurements_) {
            for (const auto& sentence : m.results.unmet())
                unmet_.push_back(fmt::format("{}: {}", m.source, sentence));
            for (const Check& check : checks_)
                if (!holds(check, m.results))
                    unmet_.push_back(fmt::format("{}: {}{}{} does not hold", m.source, check.key,
                                                 check.op, check.value));
        }
        for (const auto& sentence : unmet_) fmt::print(stderr, "stipple: {}\n", sentence);
        return unmet_.empty();
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
    std::string path_;
    Style style_;
    bool averaged_;
    bool different_ = false;
    std::vector<Check> checks_;
    std::vector<std::pair<std::string, std::string>> shown_options_;
    std::vector<Measurement> measurements_;
    std::vector<std::string> unmet_;
    ReportAverage average_;
};

}  // namespace

int analyze(const Arguments& arguments, Session& session) {
    return Analysis(arguments, session).go();
}

}  // namespace stipple::cli
