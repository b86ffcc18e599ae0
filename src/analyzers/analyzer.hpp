// SPDX-License-Identifier: MIT
//
// What an analyzer is: its record, and the function from points to a report.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/options.hpp"
#include "core/peers.hpp"
#include "core/point_set.hpp"
#include "stipple/report.hpp"
#include "stipple/run.hpp"

namespace stipple {

struct AnalyzerTraits {
    std::size_t min_dimension = 1;
    std::size_t max_dimension = 1'000'000;
    bool unit_cube = true;   ///< takes points of the closed unit cube only
    bool boxed = false;      ///< takes points of the unit cube or a box only
    bool densities = false;  ///< looks at what is known of the points' own densities
    bool table = false;      ///< takes rows of any numbers, of which some may be missing: NaN
};

/// One key of the results, for help and `list`.
struct ResultKey {
    std::string key;  ///< dotted; a part in capitals stands for any name
    std::string help;
    bool always = true;           ///< false: some options give it
    std::string_view words = {};  ///< that it may be, separated by |; empty: numbers, or any text
};

inline constexpr std::string_view true_or_false = "true|false";

/// What is known of a set before its points come.
struct Arrival {
    DomainPtr domain;
    std::optional<std::uint64_t> count = {};  ///< points, where they are announced
    bool weighted = false;                    ///< rows hold a strength behind the coordinates

    [[nodiscard]] std::size_t dimension() const { return domain->dimension(); }
    [[nodiscard]] std::size_t width() const { return dimension() + (weighted ? 1 : 0); }
};

/// Measures a set that comes in pieces, without keeping it. What it reports must not depend on
/// whether the count was announced.
class Accumulator {
  public:
    Accumulator() = default;
    Accumulator(const Accumulator&) = delete;
    Accumulator& operator=(const Accumulator&) = delete;
    virtual ~Accumulator() = default;

    /// Takes the next points of the set, arrival_batch() of them, and fewer only at its end. It may
    /// use the run's threads; its progress is the caller's to tell.
    virtual void add(std::span<const double> rows, const RunContext& run) = 0;

    /// Called once, when all points came. @throws Error(input)
    virtual Report report(const RunContext& run) = 0;
};

/// Measures a part of a set whose count was announced, and takes in what others found of the rest.
class SharedAccumulator : public Accumulator {
  public:
    /// Called before any points come, where others take those before: the first here is point
    /// `first`, and `head` the first batch of the whole set.
    virtual void begin_at(std::uint64_t first, std::span<const double> head) = 0;

    /// What it has found, for the one that merges it. No points may come any more.
    virtual std::string state(const RunContext& run) = 0;

    /// Takes in what the accumulator of the points right behind its own has found. The report is
    /// then, to the last bit, that of one accumulator that was given all of them.
    virtual void merge(std::string_view state, const RunContext& run) = 0;
};

/// How several processes share the work on one set: each sees a part of the points (grain), or each
/// sees all and does a part of a search (together). At most one of both is there.
struct Sharing {
    /// Points that stay together: each part begins at a multiple of it. `accumulate` then makes a
    /// SharedAccumulator. @throws Error(usage) where these options stand against it
    std::function<std::uint64_t(const Arrival&, const Values&)> grain = {};

    /// As `analyze`, with others that were given the same points and options; all of them get the
    /// report.
    std::function<Report(const PointSet&, const Values&, Peers&, const RunContext&)> together = {};

    explicit operator bool() const { return grain || together; }
};

/// Points that an accumulator is given at a time: depends on nothing but the dimension, so that
/// sums do not, either.
constexpr std::size_t arrival_batch(std::size_t dimension) {
    constexpr std::size_t numbers = std::size_t{1} << 18;
    return dimension < numbers ? numbers / dimension : 1;
}

struct Analyzer {
    std::string name;
    std::string summary;
    std::string source;
    std::string family = {};  ///< "blue noise"; the registry gives it, by the folder
    /// Words that lead to it and are no names of it: what it is a kind, a part or a use of.
    std::vector<std::string> related = {};
    AnalyzerTraits traits;
    Schema options;
    std::vector<ResultKey> results;
    std::string_view strengths = {};  ///< option naming their column, if there is one

    /// Measures one set. Dimension and domain were checked against the traits before. Empty where
    /// `accumulate` does it.
    std::function<Report(const PointSet&, const Values&, const RunContext&)> analyze = {};

    /// Measures a set of any size as it comes, in constant memory where it can; checks by itself
    /// that the points are on their domain. Empty: all points are needed at once.
    std::function<std::unique_ptr<Accumulator>(const Arrival&, const Values&, const RunContext&)>
        accumulate = {};

    /// Seconds on one core for a set of n points, within a factor of ten; empty: 5e-7 n d.
    double (*cost)(double n, double d) = nullptr;

    /// How several processes share the work on one set; empty: they do not.
    Sharing sharing = {};

    /// Called with the mean of `sets` reports (numbers, curves and grids averaged): works out anew
    /// what a mean of results is not, such as an anisotropy. May be empty.
    std::function<void(Report& mean, std::size_t sets, const Values&)> refine = {};

    /// Called with the first of the reports that are to be averaged: fixes options that would
    /// otherwise depend on a set's size, so that reports on other sizes can be averaged with it.
    /// May be empty.
    std::function<void(const Report& first, Values&)> follow = {};

    /// Called after `refine` with the reports that were averaged, less their curves and grids: adds
    /// what is worked out from each of them, such as a combined p-value. May be empty.
    std::function<void(Report& mean, std::span<const Report> sets, const Values&)> combine = {};
};

/// A grain of one batch of points.
std::uint64_t batch_grain(const Arrival& arrival, const Values&);

/// The record of the result under a dotted key; nullptr if there is none.
const ResultKey* find_result(const Analyzer& analyzer, std::string_view key);

/// @throws Error(input) when the points' dimension is not one that the analyzer takes.
void check_dimension(const Analyzer& analyzer, std::size_t dimension);

/// Whether all sets that are to be averaged have the same number under a key, but for rounding.
bool alike(std::span<const Report> sets, std::string_view key);

/// Takes entries out of a report, as of places and pairs there is no mean.
void drop(Report& report, std::initializer_list<std::string_view> names);

namespace analyzers {
/// All analyzers, in alphabetical order.
const std::vector<Analyzer>& all();
}  // namespace analyzers

}  // namespace stipple
