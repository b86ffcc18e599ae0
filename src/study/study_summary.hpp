// SPDX-License-Identifier: MIT
//
// What the seeds of a study say together: means with their errors for every generator, and
// generators against each other, pair by pair.
//
// Promise  depends on the rows alone, which come in the order of the study.
// Beware   p-values are corrected over the pairs of generators for one dimension, count, measure
//          and key alone: conclusions from several of these need a further correction.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "study/statistics.hpp"
#include "study/study_table.hpp"

namespace stipple {

struct SummaryOptions {
    bool paired = false;  ///< compare by seed; else Welch's test
    double confidence = 0.95;
    std::uint64_t resamples = 2000;
    std::uint64_t seed = 1;  ///< of the bootstrap
};

class StudySummary {
  public:
    /// What is said of one generator under one key.
    struct Sample {
        StudyRow row;  ///< the first one
        std::vector<std::uint64_t> seeds = {};
        std::vector<double> values = {};
    };

    void add(const StudyRow& row);

    /// In the order in which they came.
    [[nodiscard]] const std::vector<Sample>& samples() const { return samples_; }

    /// A row for each generator, dimension, count, measure and key.
    /// @throws Error(cancelled)
    [[nodiscard]] std::string means(TableStyle style, const SummaryOptions& options,
                                    const RunContext& run) const;

    /// A row for each pair of generators, if there are two that some set of went well. Notifies of
    /// two that have the same values everywhere.
    /// @throws Error(cancelled)
    [[nodiscard]] std::string comparisons(TableStyle style, const SummaryOptions& options,
                                          const RunContext& run) const;

  private:
    /// Two generators under one key.
    struct Pair {
        const Sample* a = nullptr;
        const Sample* b = nullptr;
        std::size_t sets_a = 0;  ///< that were compared
        std::size_t sets_b = 0;
        MeanTest test = {};
        double p_holm = 1;
    };
    /// What is compared: dimension, count, measure, key.
    using Topic = std::tuple<std::uint64_t, std::uint64_t, std::string, std::string>;
    using Cell = std::tuple<std::string, std::uint64_t, std::uint64_t, std::string>;

    [[nodiscard]] std::vector<Pair> pairs_of(const Topic& topic, bool by_seed) const;

    std::vector<Sample> samples_;
    std::map<std::pair<std::string, Topic>, std::size_t> places_;
    std::map<Topic, std::vector<std::size_t>> topics_;
    std::vector<Topic> topics_in_order_;
    struct Failed {
        StudyRow row;
        std::uint64_t sets = 0;
        bool some_went_well = false;
    };
    std::map<Cell, Failed> failed_;  ///< all cells, also those of which nothing failed
};

}  // namespace stipple
