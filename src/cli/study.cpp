// SPDX-License-Identifier: MIT
//
// The verb `study`: generators x dimensions x counts x seeds x measures, as one tidy table.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "cli/inputs.hpp"
#include "cli/launched.hpp"
#include "cli/verbs.hpp"
#include "core/error.hpp"
#include "core/spec.hpp"
#include "core/text.hpp"
#include "io/files.hpp"
#include "io/source_text.hpp"
#include "pipeline/ranks.hpp"
#include "pipeline/units.hpp"
#include "study/study_config.hpp"
#include "study/study_file.hpp"
#include "study/study_run.hpp"
#include "study/study_summary.hpp"
#include "study/work_queue.hpp"

namespace stipple::cli {
namespace {

constexpr std::uint64_t most_units = 10'000'000;  // above it, --yes is needed

/// Arguments completed by the configuration file; typed options take precedence.
Arguments with_config(const Arguments& typed, std::uint64_t ranks, const RunContext& run) {
    Arguments all = typed;
    const auto path = typed.get("config");
    if (!path) return all;
    if (*path == "-" && ranks > 1)
        fail(ErrorKind::usage, "--config: the ranks have no standard input; name a file");
    for (auto& setting : parse_study_config(io::read_bytes(*path, run), io::source_name(*path)))
        if (!typed.has(setting.first)) all.common.push_back(std::move(setting));
    return all;
}

/// Rethrows an error; if its option is from the configuration, the message names the file and key.
[[noreturn]] void refuse_setting(const Error& e, const Arguments& typed) {
    const std::string_view what = e.what();
    const auto end = what.find(": ");
    const auto path = typed.get("config");
    if (!path || !what.starts_with("--") || end == std::string_view::npos ||
        typed.has(what.substr(2, end - 2)))
        throw e;
    throw Error(ErrorKind::input, fmt::format("{}: $.{}", io::source_name(*path), what.substr(2)),
                e.hint());
}

std::vector<std::string> specs_of(const Arguments& arguments, const std::string& name) {
    std::vector<std::string> specs;
    for (const auto& text : arguments.all(name))
        for (auto& spec : split_specs(text, "--" + name)) specs.push_back(std::move(spec));
    if (specs.empty())
        fail_with_hint(ErrorKind::usage,
                       "'stipple study --help' has examples; --config FILE names a study in a file",
                       "study: --{} is missing", name);
    return specs;
}

std::vector<std::uint64_t> numbers_of(const Arguments& arguments, const char* name,
                                      std::uint64_t otherwise, std::uint64_t high) {
    const auto text = arguments.get(name);
    if (!text) return {otherwise};
    return parse_counts(*text, fmt::format("--{}", name), 1, high);
}

std::optional<double> real_of(const Arguments& arguments, const char* name, double low, double high,
                              const char* range) {
    const auto text = arguments.get(name);
    if (!text) return std::nullopt;
    const auto value = parse_number(*text);
    if (!value || !(*value > low) || !(*value < high))
        fail(ErrorKind::usage, "--{}: '{}' is not a number {}", name, *text, range);
    return value;
}

SweepRequest request_of(const Arguments& arguments, const Ranks& ranks, Session& session) {
    SweepRequest request;
    request.generators = specs_of(arguments, "generators");
    request.measures = specs_of(arguments, "analyze");
    request.counts = numbers_of(arguments, "count", 1024, std::uint64_t{1} << 53);
    request.dimensions = numbers_of(arguments, "dimension", 2, 1'000'000);
    if (ranks.size() > 1 && arguments.get("seed") == "random")
        fail(ErrorKind::usage, "--seed: every rank would draw another one; give a number");
    request.first_seed = seed_of(arguments, ~std::uint64_t{0}, session);
    request.seeds = arguments.integer("seeds").value_or(1);
    request.warps = arguments.all("warp");
    if (const auto file = arguments.get("parameters")) {
        const auto named = read_parameters(*file, session.run());
        request.warps.push_back(named->spec());
        if (!arguments.has("dimension")) request.dimensions = {named->dimension()};
    }
    if (const auto keys = arguments.get("keys"))
        for (const auto key : split(*keys, ',')) request.keys.emplace_back(trim(key));
    if (std::ranges::find(request.keys, "") != request.keys.end())
        fail(ErrorKind::usage, "--keys: '{}' has an empty name", *arguments.get("keys"));
    request.curves = arguments.has("curves");
    request.time_limit = real_of(arguments, "time-limit", 0, 1e9, "of seconds above 0");
    request.seconds = !arguments.has("no-seconds");
    return request;
}

SummaryOptions summary_options(const Arguments& arguments, std::uint64_t seed) {
    SummaryOptions options{.seed = seed};
    options.paired = arguments.get("pairs") == "paired";
    options.confidence =
        real_of(arguments, "confidence", 0, 1, "between 0 and 1").value_or(options.confidence);
    options.resamples = arguments.integer("bootstrap").value_or(options.resamples);
    if (!arguments.has("summary"))
        arguments.refuse({"pairs", "confidence", "bootstrap"},
                         "is of --summary, which is not given");
    return options;
}

/// Extension, such as ".csv" of study.csv; empty if there is none, and for devices.
std::string extension_of(const std::string& path) {
    if (path == "-" || path.starts_with("/dev/")) return "";
    return std::filesystem::path(path).extension().string();
}

TableStyle table_style(const Arguments& arguments, const std::string& path) {
    const std::string extension = extension_of(path);
    const bool lines = extension == ".jsonl" || extension == ".ndjson";
    const auto format = arguments.get("format");
    if (!format && !lines && !extension.empty() && extension != ".csv")
        fail_with_hint(ErrorKind::usage, "--format csv or jsonl says what it is to hold",
                       "--output: a study's table is .csv or .jsonl; '{}' is neither", path);
    return (format ? *format == "jsonl" : lines) ? TableStyle::jsonl : TableStyle::csv;
}

/// Path beside the table: study.csv -> study.summary.csv.
std::string beside(const std::string& path, const std::string& what) {
    const std::string extension = std::filesystem::path(path).extension().string();
    return path.substr(0, path.size() - extension.size()) + "." + what + extension;
}

std::string long_time(double seconds) {
    if (seconds < 120) return fmt::format("{:.0f} seconds", seconds);
    if (seconds < 7200) return fmt::format("{:.0f} minutes", seconds / 60);
    if (seconds < 172'800) return fmt::format("{:.0f} hours", seconds / 3600);
    if (seconds < 3e8) return fmt::format("{:.0f} days", seconds / 86'400);
    return fmt::format("{:.0f} years", seconds / 31'557'600);
}

class Study {
  public:
    Study(const Arguments& arguments, Session& session, Ranks& ranks)
        : arguments_(arguments),
          session_(session),
          ranks_(ranks),
          sweep_(request_of(arguments, ranks, session)),
          path_(output_of(arguments)),
          table_(table_style(arguments, path_), sweep_.request().seconds),
          summary_options_(summary_options(arguments, sweep_.request().first_seed)),
          summarized_(arguments.has("summary")) {}

    int go() {
        refuse_too_much();
        if (ranks_.rank() != 0) {
            work_for_study(UnitRunner(sweep_, session_.run()), ranks_, session_.run());
            return 0;
        }
        try {
            return lead();
        } catch (...) {
            if (!began_) dismiss(ranks_);
            throw;
        }
    }

  private:
    int lead() {
        const RunContext& run = session_.run();
        const StudyFile::Start start = arguments_.has("resume")      ? StudyFile::Start::resume
                                       : arguments_.has("overwrite") ? StudyFile::Start::anew
                                                                     : StudyFile::Start::fresh;
        StudyFile::Listener listen;
        if (summarized_) listen = [this](const StudyRow& row) { summary_.add(row); };
        const UnitRunner runner(sweep_, run);
        runner.require_options(run);
        StudyFile file(path_, sweep_, table_, start, listen, run);
        if (start == StudyFile::Start::anew && !file.is_stream()) remove_old_summary();
        for (const auto& sentence : runner.before_warps()) session_.warn(sentence);
        try {
            began_ = true;
            if (!run_study(runner, file, ranks_, run)) return 0;
            finish(file);
        } catch (const Error& e) {
            if (e.kind() != ErrorKind::cancelled || !file.has_journal()) throw;
            fail_with_hint(
                ErrorKind::cancelled,
                fmt::format("what is done is in {0} and {0}.journal; --resume goes on", path_),
                "interrupted");
        }
        const StudyFailures& failed = file.failures();
        if (failed.units == 0) return 0;
        session_.warn(fmt::format(
            "{} of {} measurements failed, their rows say why; the first: {} with {} points, seed "
            "{}, {}: {}",
            failed.units, sweep_.units(), failed.first.generator, failed.first.count,
            failed.first.seed, failed.first.measure, failed.first.reason));
        return failed.met_limit ? 5 : 3;
    }

    void finish(StudyFile& file) const {
        const RunContext& run = session_.run();
        if (!summarized_) return file.finish("", run);
        file.listen(run);
        const auto means = summary_.means(table_.style(), summary_options_, run);
        const auto pairs = summary_.comparisons(table_.style(), summary_options_, run);
        if (file.is_stream()) {
            const char* gap = table_.style() == TableStyle::csv ? "\n" : "";
            file.finish(gap + means + gap + pairs, run);
            return;
        }
        file.finish("", run);
        write_text(beside(path_, "summary"), means);
        write_text(beside(path_, "comparisons"), pairs);
    }

    /// Removes the previous summary, which could be mistaken for one of the new study.
    void remove_old_summary() const {
        for (const auto& path : {beside(path_, "summary"), beside(path_, "comparisons")}) {
            std::ifstream in(path, std::ios::binary);
            std::string first;
            if (std::getline(in, first) &&
                (first.starts_with("table,") || first.starts_with("{\"table\":")))
                std::filesystem::remove(path);
        }
    }

    /// @throws Error(limit) for a huge study without --yes: one of months is probably a mistake
    void refuse_too_much() const {
        if (arguments_.has("yes") || sweep_.units() <= most_units) return;
        const StudyRow row = row_of(sweep_, sweep_.unit(0));
        const double bytes = static_cast<double>(table_.line(row).size() + 40);
        const auto units = static_cast<double>(sweep_.units());
        const unsigned cores =
            threads_of(ranks_, session_.run()) * static_cast<unsigned>(ranks_.size());
        const SweepRequest& r = sweep_.request();
        std::string takes = "about " + format_bytes(units * bytes);
        constexpr std::uint64_t most_cells = 1'000'000;  // quick to estimate
        if (sweep_.cells() <= most_cells)
            takes +=
                fmt::format(" and {} on {} {}", long_time(WorkQueue(sweep_).seconds_left() / cores),
                            cores, cores == 1 ? "core" : "cores");
        fail_with_hint(
            ErrorKind::limit, "--yes starts it all the same",
            "the study has {} rows or more ({} generators x {} dimensions x {} counts x {} seeds x "
            "{} measures), {}",
            sweep_.units(), r.generators.size(), r.dimensions.size(), r.counts.size(), r.seeds,
            r.measures.size(), takes);
    }

    const Arguments& arguments_;
    Session& session_;
    Ranks& ranks_;
    Sweep sweep_;
    std::string path_;
    StudyTable table_;
    SummaryOptions summary_options_;
    bool summarized_;
    bool began_ = false;
    StudySummary summary_;
};

}  // namespace

int study(const Arguments& arguments, Session& session) {
    if (arguments.has("resume") && arguments.has("overwrite"))
        fail(ErrorKind::usage, "--resume and --overwrite: give one of them");
    if (!arguments.inputs.empty())
        fail(ErrorKind::usage, "study takes no input; '{}' is not understood",
             arguments.inputs.front());
    Ranks& ranks = launched("study", session.run());
    const Arguments all = with_config(arguments, launched_ranks(), session.run());
    std::optional<Study> study;
    try {
        check_choices(all);
        study.emplace(all, session, ranks);
    } catch (const Error& e) {
        refuse_setting(e, arguments);
    }
    return study->go();
}

}  // namespace stipple::cli
