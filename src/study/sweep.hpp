// SPDX-License-Identifier: MIT
//
// Units of a study: generators x dimensions x counts x seeds, each set analyzed by all measures.
//
//     unit u = (cell * seeds + seed) * measures + measure,
//     cell   = (generator * dimensions + dimension) * counts + count
//
// Shape    there may be more units than fit in memory: nothing here grows with their number.
// Promise  units, their order and the fingerprint depend on the request alone.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "analyzers/analyzer.hpp"
#include "core/spec.hpp"
#include "generators/generator.hpp"

namespace stipple {

/// A study as the user writes it.
struct SweepRequest {
    std::vector<std::string> generators = {};  ///< as for parse_generator()
    std::vector<std::uint64_t> counts = {1024};
    std::vector<std::uint64_t> dimensions = {2};
    std::uint64_t first_seed = 1;
    std::uint64_t seeds = 1;
    std::vector<std::string> measures = {};  ///< specs of analyzers
    std::vector<std::string> warps = {};     ///< specs; after the generators' own warps
    std::vector<std::string> keys = {};      ///< results to keep; empty: all numbers
    bool curves = false;                     ///< keep lists of numbers, too
    std::optional<double> time_limit = {};   ///< seconds for making a set, and for each measure
    bool seconds = true;                     ///< rows include the seconds spent
};

/// A generator or an analyzer with its options.
template <class Unit>
struct Chosen {
    const Unit* unit = nullptr;
    Values values = {};
    std::string spec = {};  ///< omits default options; includes a generator's warps
    std::vector<std::pair<std::string, std::string>> options = {};  ///< all options
    std::size_t warps = 0;               ///< index of a generator's WarpList
    std::vector<std::string> keys = {};  ///< results of an analyzer to keep; empty: all numbers
};

/// Warps and scrambles of some generators, in order.
struct WarpList {
    std::vector<Spec> all = {};
    std::vector<std::string> names = {};  ///< as typed
    std::size_t scrambles = 0;            ///< number of scrambles before the first warp
    bool random = false;                  ///< whether there are scrambles

    [[nodiscard]] std::span<const Spec> first() const { return {all.data(), scrambles}; }
    [[nodiscard]] std::span<const Spec> later() const { return std::span(all).subspan(scrambles); }
};

/// Sets that differ only in the seed.
struct Cell {
    std::size_t generator = 0;
    std::size_t dimension = 0;
    std::uint64_t count = 0;
};

/// One measure of one set.
struct Unit {
    std::uint64_t cell = 0;
    std::uint64_t seed_index = 0;
    std::size_t measure = 0;
};

/// Units [first, last).
struct UnitRange {
    std::uint64_t first = 0;
    std::uint64_t last = 0;
    bool operator==(const UnitRange&) const = default;
};

/// Whether `wanted` is `result`, or one or more of its parts, which are separated by dots. A part
/// of `result` in capitals matches any word.
bool names_result(const std::string& result, std::string_view wanted);

/// Whether `key` is the name of a result of the analyzer, or a part of it.
bool has_result(const Analyzer& analyzer, std::string_view key);

/// Removes the analyzer's name from the front of a key; "value" if the key is the name alone.
std::string without_name(const std::string& key, const Analyzer& analyzer);

class Sweep {
  public:
    /// Resolves the units of a request. @throws Error(usage) for unknown units and options
    explicit Sweep(SweepRequest request);

    [[nodiscard]] const SweepRequest& request() const { return request_; }
    [[nodiscard]] const std::vector<Chosen<Generator>>& generators() const { return generators_; }
    [[nodiscard]] const std::vector<Chosen<Analyzer>>& measures() const { return measures_; }
    /// Different lists of warps, each for one generator or several.
    [[nodiscard]] const std::vector<WarpList>& warp_lists() const { return warp_lists_; }
    [[nodiscard]] const WarpList& warps_of(std::size_t generator) const {
        return warp_lists_[generators_[generator].warps];
    }
    /// The request's warps, joined by blanks as in rows; the generators' own come before them.
    [[nodiscard]] const std::string& warp_names() const { return warp_names_; }

    [[nodiscard]] std::uint64_t cells() const;
    [[nodiscard]] std::uint64_t units() const { return units_; }
    [[nodiscard]] Cell cell(std::uint64_t index) const;
    [[nodiscard]] Unit unit(std::uint64_t index) const;
    [[nodiscard]] std::uint64_t units_per_cell() const { return request_.seeds * measures_.size(); }
    /// Name of something in the sweep `part` that is missing from this one, such as "seed 5"; empty
    /// if nothing is missing.
    [[nodiscard]] std::string missing_from(const Sweep& part) const;
    /// Index of a unit; nullopt if the study does not contain it.
    [[nodiscard]] std::optional<std::uint64_t> index_of(std::string_view generator,
                                                        std::uint64_t dimension,
                                                        std::uint64_t count, std::uint64_t seed,
                                                        std::string_view measure) const;

    /// The files that generators, warps and measures read.
    [[nodiscard]] std::vector<std::string> files() const;

    /// Whether the sets of a generator differ from seed to seed.
    [[nodiscard]] bool seeded(std::size_t generator) const;

    /// Names and texts of all settings that rows depend on.
    [[nodiscard]] const std::vector<std::pair<std::string, std::string>>& settings() const {
        return settings_;
    }
    /// Fingerprint of settings(): 16 hexadecimal digits.
    [[nodiscard]] const std::string& fingerprint() const { return fingerprint_; }

  private:
    void choose();
    [[nodiscard]] std::size_t warp_list(std::vector<std::string> own);
    void count_units();
    void write_settings();

    SweepRequest request_;
    std::vector<Chosen<Generator>> generators_;
    std::vector<Chosen<Analyzer>> measures_;
    std::vector<WarpList> warp_lists_;
    std::string warp_names_;
    std::uint64_t units_ = 0;
    std::vector<std::pair<std::string, std::string>> settings_;
    std::string fingerprint_;
};

}  // namespace stipple
