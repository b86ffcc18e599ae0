// SPDX-License-Identifier: MIT
//
// One analyzer of an `analyze` command: receives sets one after the other, and keeps their
// measurements or means of the measurements.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "analyzers/analyzer.hpp"
#include "cli/parsing/requests.hpp"
#include "cli/session.hpp"
#include "io/output.hpp"
#include "pipeline/pipeline.hpp"
#include "report/average.hpp"
#include "report/check.hpp"
#include "report/document.hpp"

namespace stipple::cli {

struct SetOrigin {
    std::string source;                      ///< file, or spec of a generator
    std::optional<std::size_t> number = {};  ///< index, if the source has several sets
    std::string kind = {};  ///< sets of equal kind are averaged; empty if not yet known
    std::vector<std::string> columns = {};  ///< names of the coordinates, if known
    bool several = false;                   ///< whether other sets of the command are known
};

/// Key for averaging: how the set was made, except for its seed; if that is unknown, the number of
/// points.
/// @param count points of this set, or of the first set in its file
std::string kind_of(const Provenance& made, std::uint64_t count);

class Analysis {
  public:
    /// @param files receives the files that are written beside the report
    /// @param one_of_several makes errors name the analyzer
    Analysis(const Analyzer& analyzer, Values options, const AnalyzeRequest& request,
             Session& session, io::Outputs& files, bool one_of_several);

    [[nodiscard]] const Analyzer& analyzer() const { return analyzer_; }
    /// Options of the analyzer as given.
    [[nodiscard]] const Values& options() const { return asked_; }
    /// Text of an option of the analyzer; nullopt if not given.
    [[nodiscard]] std::optional<std::string> text_of(std::string_view name) const;
    [[nodiscard]] std::vector<Measurement>& measurements() { return measurements_; }

    /// Checks the options, and warns of questionable ones. @throws Error(usage) if the analyzer
    /// would ignore --domain, or if the name of a file has the extension of another format or is
    /// given twice
    void check_arguments(const std::string& output) const;

    /// Adds a set, and measures the collected ones if there are many. Large sets are measured
    /// immediately, with all threads and all memory.
    void add(PointSet points, SetOrigin origin);

    /// Measures a set that arrives in blocks. When averaging, sets origin.kind if it is empty.
    void add(const Arrival& arrival, const NextRows& next, SetOrigin& origin,
             const Provenance& made, const RunContext& run);

    /// Adds an existing measurement.
    void keep(Measurement m, const SetOrigin& origin);

    /// Runs work() for a set, and returns its result and time as a measurement.
    [[nodiscard]] Measurement timed(const SetOrigin& origin, const DomainPtr& domain,
                                    const Values& options,
                                    const std::function<Found()>& work) const;

    /// Measures the collected sets in parallel. Results are kept in the order of the sets, as if
    /// they had been measured one after the other, up to the first error. After a stop request,
    /// only sets that have begun and succeed are kept.
    void measure_waiting();

    /// Computes the means, and writes the files beside the report.
    void finish();

    /// Number of groups, each with one mean.
    [[nodiscard]] std::size_t kinds() const { return groups_.size(); }

    /// Clears the index of the last set, which was the only one of its source.
    void forget_number() { measurements_.back().set.reset(); }

    /// Returns the value that fails a check; nullopt if the check holds.
    [[nodiscard]] std::optional<std::string> broken(const Check& check,
                                                    const Report& results) const;

  private:
    struct Waiting {
        PointSet points;
        SetOrigin origin;
    };

    /// Outcome for a set measured in parallel with others; empty if stopped before it began.
    struct Outcome {
        std::optional<Measurement> measurement;
        std::exception_ptr error;
        bool over_limit = false;  ///< exceeded a thread's share of the memory
        std::vector<std::string> warnings;
    };

    /// Sets of one kind, to be averaged.
    struct Group {
        Values options;  ///< given options, completed by those that the first set determines
        ReportAverage average = {};
        std::vector<Report> singles = {};  ///< numbers of each set, for Analyzer::combine
    };

    void check_domain() const;
    void check_side_files(const std::string& output) const;
    void warn_of_metric() const;
    void warn_of_prefixes(const Provenance& made);
    void warn_of_ranges(const PointSet& points);
    [[nodiscard]] bool interrupted() const { return session_.run().stop.stop_requested(); }

    [[nodiscard]] Outcome measured_alone(const Waiting& set, RunContext one) const;
    [[nodiscard]] Measurement measured(const Waiting& set, const RunContext& run) const;
    [[nodiscard]] RunContext naming_set(const SetOrigin& origin, const RunContext& run) const;

    [[nodiscard]] std::string group_name(const std::string& kind, std::size_t dimension) const;
    [[nodiscard]] const Group* known_group(const std::string& kind, std::size_t dimension) const;
    [[nodiscard]] const Values& options_for(const std::string& kind, std::size_t dimension) const;
    void warn_of_sizes(const Group& group) const;
    void finish_averages();

    void save_grid(const Report& results, std::size_t number, bool several);
    void save_beside(const std::string& path, const std::string& bytes);

    const Analyzer& analyzer_;
    const AnalyzeRequest& request_;
    Session& session_;
    io::Outputs& files_;
    bool one_of_several_;
    Values asked_;
    bool told_of_prefixes_ = false;
    bool told_of_ranges_ = false;
    std::vector<Measurement> measurements_;
    std::vector<Group> groups_;  ///< one per measurement, if averaging
    std::map<std::string, std::size_t> group_indices_;
    std::vector<Waiting> waiting_;
    std::size_t numbers_ = 0;  ///< number of coordinates of all sets in waiting_
};

}  // namespace stipple::cli
