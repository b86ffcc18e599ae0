// SPDX-License-Identifier: MIT
//
// The verb `study`: generators x dimensions x counts x seeds x measures, as one tidy table.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "cli/inputs.hpp"
#include "cli/launched.hpp"
#include "cli/session.hpp"
#include "cli/verbs.hpp"
#include "core/error.hpp"
#include "core/spec.hpp"
#include "core/text.hpp"
#include "io/files.hpp"
#include "io/source_text.hpp"
#include "pipeline/ranks.hpp"
#include "pipeline/shared_analysis.hpp"
#include "pipeline/units.hpp"
#include "study/study_config.hpp"
#include "study/study_file.hpp"
#include "study/study_run.hpp"
#include "study/study_summary.hpp"
#include "study/work_queue.hpp"

namespace stipple::cli {
namespace {

constexpr std::uint64_t most_units = 10'000'000;  // limit for measurements without --yes

/// The request, completed by the configuration file; typed options take precedence.
StudyRequest with_config(const StudyRequest& typed, const RunContext& run) {
    const std::string& path = *typed.config;
    if (path == "-" && launched_ranks() > 1)
        fail(ErrorKind::usage, "--config: the ranks have no standard input; name a file");
    require_same_files({path}, joined_ranks(), run);
    Arguments all = typed;
    std::erase_if(all.common, [](const auto& option) { return option.first == "config"; });
    const auto is_typed = [&](const std::string& name) {
        return typed.has(name) || (name == "generators" && !typed.inputs.empty());
    };
    for (auto& setting : parse_study_config(io::read_bytes(path, run), io::source_name(path)))
        if (!is_typed(setting.first)) all.common.push_back(std::move(setting));
    auto request = request_as<StudyRequest>(all);
    request.parameters = typed.parameters;
    if (!request.parameters) read_parameter_file(request, run);
    return request;
}

/// Throws an error again. If its option is from the configuration file, the message names the file
/// and the key.
[[noreturn]] void refuse_setting(const Error& e, const StudyRequest& typed) {
    const std::string_view what = e.what();
    const auto end = what.find(": ");
    if (!typed.config || !what.starts_with("--") || end == std::string_view::npos ||
        typed.has(what.substr(2, end - 2)))
        throw e;
    throw Error(ErrorKind::input,
                fmt::format("{}: $.{}", io::source_name(*typed.config), what.substr(2)), e.hint());
}

SweepRequest sweep_of(const StudyRequest& asked, Session& session) {
    SweepRequest sweep = asked;
    for (const std::string& text : asked.inputs)
        std::ranges::move(split_specs(text, "study"), std::back_inserter(sweep.generators));
    for (const auto& [specs, name] :
         {std::pair{&sweep.generators, "generators"}, {&sweep.measures, "analyze"}})
        if (specs->empty())
            fail_with_hint(
                ErrorKind::usage,
                "'stipple study --help' has examples; --config FILE names a study in a file",
                "study: --{} is missing", name);
    sweep.first_seed = seed_of(asked, ~std::uint64_t{0}, session);
    if (asked.parameters) {
        sweep.warps.push_back(asked.parameters->spec());
        if (!asked.has("dimension")) sweep.dimensions = {asked.parameters->dimension()};
    }
    if (std::ranges::find(sweep.keys, "") != sweep.keys.end())
        fail(ErrorKind::usage, "--keys: '{}' has an empty name", join(sweep.keys, ","));
    return sweep;
}

SummaryOptions summary_options(const StudyRequest& asked, std::uint64_t seed) {
    SummaryOptions options = asked;
    options.seed = seed;
    return options;
}

/// Extension of a path, such as ".csv"; empty for devices and names without extension.
std::string extension_of(const std::string& path) {
    if (path == "-" || path.starts_with("/dev/")) return "";
    return std::filesystem::path(path).extension().string();
}

StudyFormat study_format(const StudyRequest& request, const std::string& path) {
    if (request.format) return *request.format;
    const std::string extension = extension_of(path);
    if (extension == ".jsonl" || extension == ".ndjson") return StudyFormat::jsonl;
    if (extension == ".tex" && request.wide) return StudyFormat::latex;
    if (!extension.empty() && extension != ".csv")
        fail_with_hint(ErrorKind::usage, "--format csv or jsonl selects a format for any file name",
                       "--output: a study's table is .csv or .jsonl or, with --wide, .tex; '{}' is "
                       "none of these",
                       path);
    return StudyFormat::csv;
}

TableStyle style_of(StudyFormat format) {
    return format == StudyFormat::jsonl ? TableStyle::jsonl : TableStyle::csv;
}

/// Command that makes the table, without options that do not affect it.
std::string command_of(const StudyRequest& request) {
    return command_text(request, {"resume", "overwrite", "yes"});
}

/// The means as a wide table, in the format of the request.
std::string wide_text(std::vector<MeanRow> means, const StudyRequest& request) {
    if (!request.labels.empty()) label_generators(means, request.labels);
    const StudyFormat format = study_format(request, output_of(request));
    if (format == StudyFormat::latex) return wide_latex(means, command_of(request));
    const TableStyle style = style_of(format);
    const std::string above = request.meta ? study_preface(style, command_of(request)) : "";
    return above + wide_table(means, style);
}

/// Path beside the table: study.csv -> study.summary.csv.
std::string beside(const std::string& path, const std::string& what) {
    const std::string extension = std::filesystem::path(path).extension().string();
    return path.substr(0, path.size() - extension.size()) + "." + what + extension;
}

/// The two tables of a summary.
struct SummaryText {
    TableStyle style;
    std::string preface;
    std::string means;
    std::string pairs;

    SummaryText(const StudySummary& summary, const SummaryOptions& options,
                const StudyRequest& request, const RunContext& run)
        : style(style_of(study_format(request, output_of(request)))),
          preface(request.meta ? study_preface(style, command_of(request)) : ""),
          means(summary.means(style, options, run)),
          pairs(summary.comparisons(style, options, run)) {}

    /// Text between two tables in one output.
    [[nodiscard]] std::string gap() const { return style == TableStyle::csv ? "\n" + preface : ""; }
    void write_beside(const std::string& path) const {
        write_text(beside(path, "summary"), preface + means);
        write_text(beside(path, "comparisons"), preface + pairs);
    }
};

/// Whether the command only summarizes an existing table of a study, its only input.
bool reads_table(const StudyRequest& request) {
    std::error_code none;
    return request.inputs.size() == 1 && (request.wide || request.summary) &&
           !request.has("generators") && std::filesystem::exists(request.inputs[0], none);
}

/// Writes the means of a table, or its summary.
void summarize_table(const StudyRequest& request, const RunContext& run) {
    const std::string& path = request.inputs[0];
    refuse_options(request,
                   "analyze,config,count,curves,dimension,overwrite,parameters,resume,seed,"
                   "seeds,time-limit,warp",
                   "does not apply to the table of a study");
    auto study = read_study(io::read_bytes(path, run), io::source_name(path), run, request.keys);
    if (!study) fail(ErrorKind::input, "{}: is not the table of a study", path);
    note_unfinished(path, run);
    const std::string to = output_of(request);
    if (auto* means = std::get_if<std::vector<MeanRow>>(&*study)) {
        refuse_options(request, "summary,confidence", "does not apply to the summary of a study");
        return write_text(to, wide_text(*std::move(means), request));
    }
    const auto& rows = std::get<StudySummary>(*study);
    SummaryOptions options = summary_options(request, rows.first_seed());
    if (request.wide) options.resamples = 0;
    if (request.wide) return write_text(to, wide_text(rows.mean_rows(options, run), request));
    const SummaryText text(rows, options, request, run);
    if (extension_of(to).empty())
        return write_text(to, text.preface + text.means + text.gap() + text.pairs);
    text.write_beside(to);
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
    Study(const StudyRequest& request, Session& session, Ranks& ranks)
        : request_(request),
          session_(session),
          ranks_(ranks),
          sweep_(sweep_of(request, session)),
          path_(output_of(request)),
          table_(table_of(request)),
          summary_options_(summary_options(request, sweep_.request().first_seed)) {}

    int go() {
        refuse_too_much();
        require_same_files(sweep_.files(), ranks_, session_.run());
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
    [[nodiscard]] StudyTable table_of(const StudyRequest& request) const {
        const TableStyle style = style_of(study_format(request, path_));
        return {style, sweep_.request().seconds,
                request.meta ? study_preface(style, command_of(request)) : ""};
    }

    int lead() {
        const RunContext& run = session_.run();
        const StudyFile::Start start = request_.resume      ? StudyFile::Start::resume
                                       : request_.overwrite ? StudyFile::Start::anew
                                                            : StudyFile::Start::fresh;
        StudyFile::Listener listen;
        if (request_.summary || request_.wide)
            listen = [this](const StudyRow& row) { summary_.add(row); };
        const UnitRunner runner(sweep_, run);
        runner.require_options(run);
        // For a wide table, rows are only kept in the summary.
        StudyFile file(request_.wide ? "/dev/null" : path_, sweep_, table_, start, listen, run);
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
                fmt::format("{0} and {0}.journal hold {1} of {2} measurements; --resume continues",
                            path_, file.units_written(), sweep_.units()),
                "interrupted");
        }
        const StudyFailures& failed = file.failures();
        if (failed.units == 0) return 0;
        session_.warn(
            fmt::format("{} of {} measurements failed, for the reasons in their rows; the first: "
                        "{} with {} points, seed {}, {}: {}",
                        failed.units, sweep_.units(), failed.first.generator, failed.first.count,
                        failed.first.seed, failed.first.measure, failed.first.reason));
        return failed.met_limit ? 5 : 3;
    }

    void finish(StudyFile& file) const {
        const RunContext& run = session_.run();
        if (request_.wide) {
            SummaryOptions options = summary_options_;
            options.resamples = 0;
            return write_text(path_, wide_text(summary_.mean_rows(options, run), request_));
        }
        if (!request_.summary) return file.finish("", run);
        file.listen(run);
        const SummaryText text(summary_, summary_options_, request_, run);
        if (file.is_stream())
            return file.finish(text.gap() + text.means + text.gap() + text.pairs, run);
        file.finish("", run);
        text.write_beside(path_);
    }

    /// Removes the previous summary, which could be mistaken for one of the new study.
    void remove_old_summary() const {
        for (const auto& path : {beside(path_, "summary"), beside(path_, "comparisons")}) {
            std::ifstream in(path, std::ios::binary);
            std::string first;
            while (std::getline(in, first) && is_study_preface(first)) first.clear();
            if (first.starts_with("table,") || first.starts_with("{\"table\":"))
                std::filesystem::remove(path);
        }
    }

    /// Rejects a huge study without --yes, which is probably a mistake. @throws Error(limit) with
    /// its number of rows and time
    void refuse_too_much() const {
        if (request_.yes || sweep_.units() <= most_units) return;
        const StudyRow row = row_of(sweep_, sweep_.unit(0));
        const double bytes = static_cast<double>(table_.line(row).size() + 40);
        const auto units = static_cast<double>(sweep_.units());
        const unsigned cores =
            threads_of(ranks_, session_.run()) * static_cast<unsigned>(ranks_.size());
        const SweepRequest& r = sweep_.request();
        std::string takes = "about " + format_bytes(units * bytes);
        constexpr std::uint64_t most_cells = 1'000'000;  // limit for estimating the time
        if (sweep_.cells() <= most_cells)
            takes +=
                fmt::format(" and {} on {} {}", long_time(WorkQueue(sweep_).seconds_left() / cores),
                            cores, cores == 1 ? "core" : "cores");
        fail_with_hint(
            ErrorKind::limit, "--yes starts it anyway",
            "the study has {} rows or more ({} generators x {} dimensions x {} counts x {} seeds x "
            "{} measures), {}",
            sweep_.units(), r.generators.size(), r.dimensions.size(), r.counts.size(), r.seeds,
            r.measures.size(), takes);
    }

    const StudyRequest& request_;
    Session& session_;
    Ranks& ranks_;
    Sweep sweep_;
    std::string path_;
    StudyTable table_;
    SummaryOptions summary_options_;
    bool began_ = false;
    StudySummary summary_;
};

}  // namespace

int StudyRequest::perform(Session& session) const {
    Ranks& ranks = launched(*this, session.run());
    const bool reads = !ranks.exchange(reads_table(*this) ? "reads" : "").front().empty();
    if (reads) {  // rank 0 decides for all, and it alone writes
        if (ranks.rank() == 0) summarize_table(*this, session.run());
        return 0;
    }
    std::optional<StudyRequest> completed;
    std::optional<Study> study;
    try {
        if (config) completed = with_config(*this, session.run());
        study.emplace(completed ? *completed : *this, session, ranks);
    } catch (const Error& e) {
        refuse_setting(e, *this);
    }
    return study->go();
}

}  // namespace stipple::cli
