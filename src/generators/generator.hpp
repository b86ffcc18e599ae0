// SPDX-License-Identifier: MIT
//
// Record of a generator, and the two ways of making points: one by one, or as a whole set.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/domain.hpp"
#include "core/options.hpp"
#include "core/outcome_axis.hpp"
#include "core/point_set.hpp"
#include "stipple/generate.hpp"
#include "stipple/run.hpp"

namespace stipple {

/// Images of a generator's points under the warps after it, for searches that optimize the images.
struct Destination {
    /// Whether point i at `row` has an image; safe to call from several threads.
    std::function<bool(std::uint64_t i, std::span<const double> row)> has_image = {};
    bool drops = false;  ///< true if some points have no image; a search should avoid them
    std::vector<OutcomeAxis> axes = {};  ///< by coordinate: outcomes that the warps map it to
    PointSet given = {};  ///< preimages in the unit cube of the points that the set extends
};

/// Request with defaults for all values that it leaves open.
struct Plan {
    std::uint64_t count = 0;  ///< 0: known only after the set is made
    std::size_t dimension = 0;
    std::uint64_t seed = 1;
    std::optional<Box> bounds = {};
    std::uint64_t start = 0;  ///< index of the first point; above 0 only with traits.prefix
    std::shared_ptr<const Destination> destination = {};  ///< null unless a search needs it
};

/// Sequence of points: point i is a function of i alone, for a given plan and options.
class Sequence {
  public:
    using Fill = std::function<void(std::uint64_t first, std::span<double> rows)>;
    using Found = std::function<std::vector<std::pair<std::string, std::string>>()>;

    Sequence(Fill fill, bool random_access, Found found = {})
        : fill_(std::move(fill)), random_access_(random_access), found_(std::move(found)) {}

    /// Files written together with the points.
    std::vector<SideFile> side_files = {};

    /// Writes points first, first + 1, ... until `rows`, a multiple of the dimension, is full;
    /// in [0, 1)^d, or the box if boxed. With random_access() several threads may call it at once.
    void fill(std::uint64_t first, std::span<double> rows) const { fill_(first, rows); }

    /// False for a random number engine that runs in order: a jump generates all points in between.
    [[nodiscard]] bool random_access() const { return random_access_; }

    void set_found(Found found) { found_ = std::move(found); }

    /// Results of a search by name, such as a lattice's generating vector and its figure of merit.
    [[nodiscard]] std::vector<std::pair<std::string, std::string>> found() const {
        return found_ ? found_() : std::vector<std::pair<std::string, std::string>>();
    }

  private:
    Fill fill_;
    bool random_access_;
    Found found_;
};

inline std::unique_ptr<Sequence> sequence_of(Sequence::Fill fill, bool random_access = true) {
    return std::make_unique<Sequence>(std::move(fill), random_access);
}

struct GeneratorTraits {
    std::size_t min_dimension = 1;
    std::size_t max_dimension = 1'000'000;
    bool sequence = true;      ///< makes any range of points in constant memory
    bool prefix = true;        ///< point i does not depend on the count; --start works
    bool seeded = true;        ///< uses the seed, at least under some options
    bool boxed = false;        ///< makes points in the box instead of the cube: distances matter
    bool independent = false;  ///< points are statistically independent
    bool levels = false;  ///< coordinates are levels of factors, to which warps may assign values
    std::uint64_t max_index = std::uint64_t{1} << 53;  ///< start + count is at most this
    std::string more_dimensions = {};  ///< name of a file option that raises max_dimension
};

/// Integers in the formula of a generator's points, such as the columns of a matrix.
struct Constants {
    std::string name;
    std::vector<std::uint64_t> numbers;
    bool words = false;  ///< numbers have 32 bits, for emitted code without 64-bit integers
};

/// Provenance entry of a search that was stopped and kept its best points.
inline constexpr std::pair<const char*, const char*> interrupted{"ended", "interrupted"};

struct Generator {
    std::string name;
    std::string summary;
    std::string source;
    std::string family = {};  ///< such as "blue noise"; set by the registry from the folder
    /// Search words, such as kind, parts or uses; no names of other components (layering_test.cpp).
    std::vector<std::string> related = {};
    GeneratorTraits traits;
    Schema options;
    std::vector<std::string> aliases = {};  ///< other names that users of the field would type
    std::vector<std::string> writes = {};   ///< options for side files (core/point_set.hpp)

    /// Increased whenever the same options and seed give other points (tests/contract/golden.txt).
    std::uint64_t stream_version = 1;

    /// Decides count and dimension. If empty: 1024 points and 2 dimensions by default.
    /// @throws Error(usage) naming the possible values if the count or dimension is not possible
    std::function<Plan(const Request&, const Values&)> plan = {};

    /// Exactly one of `sequence` and `set` is given, according to traits.sequence. A sequence
    /// that takes long to construct reports progress up to 0.99 and can be stopped.
    std::function<std::unique_ptr<Sequence>(const Plan&, const Values&, const RunContext&)>
        sequence = {};
    /// A set may add values it computed, such as a radius, to the options in its provenance.
    std::function<PointSet(const Plan&, const Values&, const RunContext&)> set = {};

    /// Sets options that other options imply, for the provenance: a given vector implies its rule.
    std::function<void(Values&)> settle = {};

    /// Whether the points depend on the seed under these options; if empty, traits.seeded decides.
    std::function<bool(const Values&)> uses_seed = {};

    /// Sentences for the user about a valid request, for example that other counts would be better.
    std::function<std::vector<std::string>(const Request&, const Plan&, const Values&)> notes = {};

    /// Seconds on one core for a set of n points, within a factor of ten. If empty: 3e-8 n d for a
    /// sequence, 3e-5 n 5^(d - 2) for other sets.
    double (*cost)(double n, double d) = nullptr;

    /// For sequences: whether these options make the whole set in memory, mostly by a search, which
    /// may return its best result so far if it is stopped. If empty: false.
    std::function<bool(const Values&)> whole = {};

    /// Base of each coordinate, the default for scrambles; empty if no base other than 2 occurs.
    std::function<std::vector<std::uint32_t>(const Plan&, const Values&)> bases = {};

    /// Constants of the points' formula, besides count, dimension, bases and options, for emitted
    /// code (emit/) that makes the same points. Computing them may take a search.
    std::function<std::vector<Constants>(const Plan&, const Values&, const RunContext&)> constants =
        {};

    /// Largest seed under these options, for engines whose seeding takes fewer than 64 bits.
    std::function<std::uint64_t(const Values&)> max_seed = {};
};

/// Completes the request with defaults and checks it against the generator's traits.
/// @throws Error(usage)
Plan plan_for(const Generator& generator, const Request& request, const Values& options);

/// Whether the points depend on the seed under these options.
bool uses_seed(const Generator& generator, const Values& options);

/// Default options, with the least search effort, for points that are needed immediately.
Values quick_options(const Generator& generator);

/// Plan of a generator without a function `plan`: the request, with these defaults.
Plan default_plan(const Request& request, std::uint64_t count = 1024, std::size_t dimension = 2);

/// Throws Error(usage): the generator `who` needs a count that is `what`. Names the nearest such
/// counts: `below` unless it is 0, `above` unless it exceeds 2^53.
[[noreturn]] void refuse_count(std::uint64_t count, const std::string& what, const std::string& who,
                               std::uint64_t below, std::uint64_t above);

/// k with k^dimension == count. @throws Error(usage) naming the two nearest such counts
std::uint64_t exact_root(std::uint64_t count, std::size_t dimension, const std::string& who);

/// Plan for k^dimension points; by default the count nearest to 1024. @throws as exact_root
Plan plan_of_cubes(const Request& request, const std::string& who);

namespace generators {
/// All generators, in alphabetical order.
const std::vector<Generator>& all();
}  // namespace generators

}  // namespace stipple
