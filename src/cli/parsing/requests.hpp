// SPDX-License-Identifier: MIT
//
// Typed requests: the options of each verb, parsed and checked. The table in options.cpp connects
// each option to its field.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analyzers/analyzer.hpp"
#include "cli/parsing/arguments.hpp"
#include "core/spec.hpp"
#include "emit/emit.hpp"
#include "io/format.hpp"
#include "pipeline/generated.hpp"
#include "report/table_line.hpp"
#include "study/study_summary.hpp"
#include "study/sweep.hpp"

namespace stipple::cli {

/// A given seed, or the request for a random one.
struct Seed {
    std::uint64_t value = 1;
    bool random = false;
};

/// The arguments of a verb, and the fields of options that several verbs share.
struct Request : Arguments {
    virtual ~Request() = default;

    /// Sets the fields that are determined by other fields.
    virtual void settle() {}

    /// Performs the command; returns the exit code. Defined in the verb's source.
    virtual int perform(Session& session) const = 0;

    std::optional<std::string> output = {};
    std::optional<std::string> parameters_file = {};
    /// Domain that the parameter file describes; null without a file, and before
    /// read_parameter_file().
    DomainPtr parameters = {};
    std::optional<Seed> seed = {};
    unsigned threads = 0;
    std::optional<std::uint64_t> max_memory = {};  ///< bytes
    bool quiet = false;
    ProgressMode progress = ProgressMode::automatic;
};

/// Points from files or from --generate.
struct Sources : Request {
    std::vector<std::string> generate = {};  ///< specs of generators
    std::optional<std::uint64_t> count = {};
    std::optional<std::uint64_t> dimension = {};
    std::uint64_t start = 0;
    std::uint64_t sets = 1;
    std::vector<Spec> warps = {};
    bool unit_cube = false;
    std::optional<std::string> bounds = {};
    std::optional<std::string> domain = {};
    bool rescale = false;
    bool concat = false;
    std::vector<std::string> columns = {};
    std::string from = {};              ///< format, f32 or f64; empty: detected
    std::optional<bool> dtype_in = {};  ///< whether numbers are float32
    std::optional<bool> dtype = {};

    // Set by the verb and its units, not by options.
    bool densities = false;  ///< reads the column pdf or weight
    bool gaps = false;       ///< reads rows with missing numbers, to be left out
    bool tables = false;     ///< reads rows of tables, not points
};

/// Points written to files.
struct Writing : Sources {
    const Format* format = nullptr;
    std::optional<bool> dtype_out = {};
    std::optional<int> precision = {};
    bool meta = false;
    bool header = true;
    bool with_pdf = false;
    bool with_weight = false;
};

struct GenerateRequest : Writing {
    Shard shard = {};

    int perform(Session& session) const override;
};

struct WarpRequest : Writing {
    std::optional<std::string> coordinates = {};
    bool inverse = false;
    bool density_at = false;

    void settle() override;
    int perform(Session& session) const override;
};

struct ConvertRequest : Writing {
    ConvertRequest() { densities = true; }

    std::optional<std::string> vector_output = {};
    std::optional<std::string> vector_format = {};

    int perform(Session& session) const override;
};

enum class ReportFormat { text, json, csv, latex };

struct AnalyzeRequest : Sources {
    std::vector<std::pair<const Analyzer*, Values>> analyzers = {};
    std::optional<ReportFormat> format = {};
    std::vector<std::string> checks = {};
    bool average = false;
    bool pool = false;
    bool full = false;
    bool explain = false;
    std::vector<std::string> keys = {};
    bool seconds = true;
    bool array = false;

    [[nodiscard]] bool averaged() const { return average || pool; }

    void settle() override;
    int perform(Session& session) const override;
};

enum class Medium { svg, pdf, png, text };

struct PlotRequest : Sources {
    PlotRequest() { gaps = true; }

    std::optional<Medium> format = {};
    std::string chart = {};
    std::optional<std::string> key = {};
    std::optional<std::uint64_t> set = {};
    bool overlay = false;
    bool letters = false;
    std::vector<std::string> draw = {};
    std::optional<std::string> title = {};
    std::vector<std::string> labels = {};
    std::vector<std::string> axes = {};
    bool dark = false;
    std::optional<std::uint64_t> width = {};
    std::optional<std::uint64_t> height = {};
    std::optional<bool> log_x = {};
    std::optional<bool> log_y = {};

    int perform(Session& session) const override;
};

struct ReportRequest : Sources {
    ReportRequest() { gaps = true; }

    std::optional<bool> json = {};
    std::vector<std::string> checks = {};
    std::vector<std::string> fail_on = {};
    std::optional<std::uint64_t> max_work = {};

    int perform(Session& session) const override;
};

enum class StudyFormat { csv, jsonl, latex };

struct StudyRequest : Request, SweepRequest, SummaryOptions {
    std::optional<std::string> config = {};
    std::optional<StudyFormat> format = {};
    std::vector<std::string> labels = {};  ///< names of the generators
    bool summary = false;
    bool wide = false;
    bool meta = false;
    bool resume = false;
    bool overwrite = false;
    bool yes = false;

    void settle() override;
    int perform(Session& session) const override;
};

struct ReproduceRequest : Request {
    bool json = false;
    std::vector<std::string> files = {};  ///< the files of --input

    int perform(Session& session) const override;
};

struct EmitRequest : Sources {
    emit::Language language = emit::Language::c;
    std::string name = {};

    int perform(Session& session) const override;
};

struct ListRequest : Request {
    bool json = false;
    bool full = false;

    int perform(Session& session) const override;
};

struct HelpRequest : Request {
    bool man = false;

    int perform(Session& session) const override;
};

struct CompletionsRequest : Request {
    int perform(Session& session) const override;
};

/// Makes the request of the arguments' verb: parses the texts of its options, and checks their
/// combination. @throws Error(usage)
std::unique_ptr<Request> request_of(const Arguments& arguments);

/// As request_of(), for a verb that has requests of type VerbRequest.
template <class VerbRequest>
VerbRequest request_as(const Arguments& arguments) {
    return dynamic_cast<VerbRequest&>(*request_of(arguments));
}

}  // namespace stipple::cli
