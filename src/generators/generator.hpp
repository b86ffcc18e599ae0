// SPDX-License-Identifier: MIT
//
// What a generator is: its record, and the two ways of making points.
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
#include "core/point_set.hpp"
#include "stipple/generate.hpp"
#include "stipple/run.hpp"

namespace stipple {

/// What becomes of the points, for searches that take it into account.
struct Destination {
    /// Whether point i, which is there, has an image; safe to call from several threads.
    std::function<bool(std::uint64_t i, std::span<const double> row)> has_image = {};
    bool drops = false;                  ///< some have none
    std::vector<OutcomeAxis> axes = {};  ///< of each coordinate
    PointSet given = {};  ///< what a search goes on from, where its file holds their images
};

/// A request with everything decided.
struct Plan {
    std::uint64_t count = 0;  ///< 0: known only when the set is made
    std::size_t dimension = 0;
    std::uint64_t seed = 1;
    std::optional<Box> bounds = {};
    std::uint64_t start = 0;  ///< index of the first point; above 0 only with traits.prefix
    std::shared_ptr<const Destination> destination = {};  ///< none: nothing becomes of them
};

/// Point i as a function of i alone (given plan and options).
class Sequence {
  public:
    using Fill = std::function<void(std::uint64_t first, std::span<double> rows)>;
    using Found = std::function<std::vector<std::pair<std::string, std::string>>()>;

    Sequence(Fill fill, bool random_access, Found found = {})
        : fill_(std::move(fill)), random_access_(random_access), found_(std::move(found)) {}

    /// Files that come with the points.
    std::vector<SideFile> side_files = {};

    /// Writes points first, first + 1, ... until `rows` (a multiple of the dimension) is full;
    /// coordinates in [0, 1). With random_access() several threads may call it at once.
    void fill(std::uint64_t first, std::span<double> rows) const { fill_(first, rows); }

    /// False for a sequential engine: going on is cheap, any other step costs a walk to it.
    [[nodiscard]] bool random_access() const { return random_access_; }

    void set_found(Found found) { found_ = std::move(found); }

    /// What a search found, by name: a lattice's vector, and how good it is.
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
    bool sequence = true;      ///< streams in constant memory, shards
    bool prefix = true;        ///< point i does not depend on the count; --start works
    bool seeded = true;        ///< uses the seed, at least under some options
    bool boxed = false;        ///< takes the bounds itself, since its distances hold in them
    bool independent = false;  ///< no point tells anything of another
    std::uint64_t max_index = std::uint64_t{1} << 53;  ///< start + count is at most this
    std::string more_dimensions = {};  ///< option with a file that has more than max_dimension
};

/// What a search says of the points that it has found when it was stopped and the run keeps the best.
inline constexpr std::pair<const char*, const char*> interrupted{"ended", "interrupted"};

struct Generator {
    std::string name;
    std::string summary;
    std::string source;
    std::string family = {};  ///< "blue noise"; the registry gives it, by the folder
    /// Words that lead to it and are no names of it: what it is a kind, a part or a use of.
    std::vector<std::string> related = {};
    GeneratorTraits traits;
    Schema options;
    std::vector<std::string> aliases = {};  ///< other names that users of the field would type
    std::vector<std::string> writes = {};   ///< options that name a side file (core/point_set.hpp)

    /// Raised with every change of the points that the same options and seed give (see
    /// tests/contract/golden.txt).
    std::uint64_t stream_version = 1;

    /// Decides count and dimension. Empty: 1024 points, 2 dimensions unless asked otherwise.
    /// @throws Error(usage) for counts and dimensions it cannot make, naming what it can.
    std::function<Plan(const Request&, const Values&)> plan = {};

    /// Exactly one of these two, as traits.sequence says. A sequence whose making takes long
    /// reports its progress, up to 0.99, and can be stopped.
    std::function<std::unique_ptr<Sequence>(const Plan&, const Values&, const RunContext&)>
        sequence = {};
    /// A set may put what it worked out (a radius) into its provenance's options.
    std::function<PointSet(const Plan&, const Values&, const RunContext&)> set = {};

    /// Writes down what options mean together, for the provenance: a rule that a vector implies.
    std::function<void(Values&)> settle = {};

    /// Whether the points depend on the seed under these options; empty: as traits.seeded says.
    std::function<bool(const Values&)> uses_seed = {};

    /// What the user should know about such a request, in sentences; it is no mistake.
    std::function<std::vector<std::string>(const Request&, const Plan&, const Values&)> notes = {};

    /// Seconds on one core for a set of n points, within a factor of ten; empty: 3e-8 n d for a
    /// sequence, 3e-5 n 5^(d - 2) for other sets.
    double (*cost)(double n, double d) = nullptr;

    /// Of a sequence: whether under these options it takes a search, so that sets are made in memory
    /// and may be the best of one that was stopped; empty: never.
    std::function<bool(const Values&)> whole = {};

    /// Of a generator of digits in other bases than 2: that of each coordinate, which scrambles take
    /// unless told another.
    std::function<std::vector<std::uint32_t>(const Plan&, const Values&)> bases = {};

    /// Largest seed, where an engine's own seeding takes fewer than 64 bits.
    std::function<std::uint64_t(const Values&)> max_seed = {};
};

/// The request completed with the defaults and checked against the generator's traits.
/// @throws Error(usage)
Plan plan_for(const Generator& generator, const Request& request, const Values& options);

/// Whether sets of different seeds differ.
bool uses_seed(const Generator& generator, const Values& options);

/// The defaults, with the least effort of what searches: for points that are needed at once.
Values quick_options(const Generator& generator);

/// What generator.plan does where it is empty.
Plan default_plan(const Request& request, std::uint64_t count = 1024, std::size_t dimension = 2);

/// Refuses a count that is not `what`, as `who` needs, and names those that are: `below`, if not 0,
/// and `above`, if up to 2^53. @throws Error(usage)
[[noreturn]] void refuse_count(std::uint64_t count, const std::string& what, const std::string& who,
                               std::uint64_t below, std::uint64_t above);

/// k with k^dimension == count. @throws Error(usage) naming the two nearest counts that have one.
std::uint64_t exact_root(std::uint64_t count, std::size_t dimension, const std::string& who);

/// The plan of k^dimension points; without a count, the nearest to 1024. @throws as exact_root
Plan plan_of_cubes(const Request& request, const std::string& who);

namespace generators {
/// All generators, in alphabetical order.
const std::vector<Generator>& all();
}  // namespace generators

}  // namespace stipple
