// SPDX-License-Identifier: MIT
//
// One analyzer of an `analyze` call: sets come in, one after the other; their measurements, or the
// means of these, stay.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analyzers/analyzer.hpp"
#include "cli/session.hpp"
#include "io/output.hpp"
#include "pipeline/pipeline.hpp"
#include "report/average.hpp"
#include "report/check.hpp"
#include "report/document.hpp"

namespace stipple::cli {

/// Where a set comes from.
struct SetOrigin {
    std::string source;                      ///< a file, or the spec of a generator
    std::optional<std::size_t> number = {};  ///< of several there
    std::string kind = {};                   ///< sets of one kind have a mean; empty: not known yet
    std::vector<std::string> columns = {};   ///< names of the coordinates, where they have any
    bool several = false;                    ///< there are other sets
};

/// What sets that may be averaged have in common: how they were made, but for the seed, as far as it
/// is known; else their number of points.
/// @param count of this set, or of the first in its file
std::string kind_of(const Provenance& made, std::uint64_t count);

class Analysis {
  public:
    /// @param files what is written beside the report goes there
    /// @param one_of_several so that errors name the analyzer
    Analysis(const Analyzer& analyzer, Values options, const Arguments& arguments, Session& session,
             io::Outputs& files, bool one_of_several);

    [[nodiscard]] const Analyzer& analyzer() const { return analyzer_; }
    /// Those that were asked for.
    [[nodiscard]] const Values& options() const { return asked_; }
    /// The text of an option of the analyzer, where it is given.
    [[nodiscard]] std::optional<std::string> text_of(std::string_view name) const;
    [[nodiscard]] std::vector<Measurement>& measurements() { return measurements_; }

    /// @throws Error(usage) for a domain that is given twice, or that the analyzer would not heed,
    /// and for the name of a file that promises another format, or that is given twice
    void check_arguments(const std::string& output) const;

    /// Takes a set, and measures those that wait when they have become many. Large sets do not
    /// wait: they get all threads, and the memory, for themselves.
    void add(PointSet points, SetOrigin origin);

    /// Measures a set that comes in blocks; its kind is known afterwards.
    void add(const Arrival& arrival, const NextRows& next, SetOrigin& origin,
             const Provenance& made, const RunContext& run);

    /// Takes what was measured elsewhere.
    void keep(Measurement m, const SetOrigin& origin);

    /// What work() finds of a set on the domain, with the time that it takes.
    [[nodiscard]] Measurement timed(const SetOrigin& origin, const DomainPtr& domain,
                                    const Values& options,
                                    const std::function<Found()>& work) const;

    /// Measures the sets that wait side by side. What comes of them is kept in their order, as if they
    /// had been measured one after the other: up to the first error or, where a stop is requested,
    /// of those that had begun and were measured nevertheless.
    void measure_waiting();

    /// Works out the means, and writes what is to stand beside the report.
    void finish();

    /// Means that there are.
    [[nodiscard]] std::size_t kinds() const { return groups_.size(); }

    /// The set that came last was the only one of its source.
    void forget_number() { measurements_.back().set.reset(); }

    /// What is found where a check does not hold; nothing where it does.
    [[nodiscard]] std::optional<std::string> broken(const Check& check,
                                                    const Report& results) const;

  private:
    struct Waiting {
        PointSet points;
        SetOrigin origin;
    };

    /// What became of a set that was measured beside others; nothing where a stop came before it.
    struct Outcome {
        std::optional<Measurement> measurement;
        std::exception_ptr error;
        bool over_limit = false;  ///< it would need more than its share of the memory, say
        std::vector<std::string> warnings;
    };

    /// The sets of one kind, for their mean.
    struct Group {
        Values options;  ///< those asked for, and what the first set decides
        ReportAverage average = {};
        std::vector<Report> singles = {};  ///< what was averaged, where it is needed
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
    [[nodiscard]] bool is_first(const std::string& kind, std::size_t dimension) const;
    [[nodiscard]] Values options_for(const std::string& kind, std::size_t dimension) const;
    std::size_t group_of(const std::string& kind, std::size_t dimension);
    void warn_of_sizes(const Group& group) const;
    void finish_averages();

    void save_grid(const Report& results, std::size_t number, bool several);
    void save_beside(const std::string& path, const std::string& bytes);

    const Analyzer& analyzer_;
    const Arguments& arguments_;
    Session& session_;
    io::Outputs& files_;
    bool one_of_several_;
    Values asked_;
    bool pooled_;  ///< sets of all kinds have one mean
    bool averaged_;
    bool told_of_prefixes_ = false;
    bool told_of_ranges_ = false;
    std::vector<Measurement> measurements_;
    std::vector<Group> groups_;  ///< of a measurement each, where these are means
    std::map<std::string, std::size_t> group_indices_;
    std::vector<Waiting> waiting_;
    std::size_t numbers_ = 0;  ///< coordinates of these
};

}  // namespace stipple::cli
