// SPDX-License-Identifier: MIT
//
// Making points. A generator is named by a spec, NAME or NAME:OPTION=VALUE,...: "halton",
// "sobol:scramble=owen", "poisson-disk:radius=0.01". `stipple list generators` shows all of them.
//
// Promise  the points depend on the spec and the request alone: not on threads, time or machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "stipple/points.hpp"
#include "stipple/run.hpp"

namespace stipple {

/// What is asked of a generator. What is not given, it decides: 1024 points in two dimensions, as a
/// rule.
struct Request {
    std::optional<std::uint64_t> count = {};
    std::optional<std::size_t> dimension = {};
    std::uint64_t start = 0;         ///< index of the first point, for sequences
    std::optional<Box> bounds = {};  ///< box that the points fill; else the unit cube
    std::uint64_t seed = 1;
};

/// Options as text: {{"base", "3"}}; beside those of the spec.
using Settings = std::vector<std::pair<std::string, std::string>>;

/// Names of all generators, in alphabetical order.
std::vector<std::string> generator_names();

/// The points of a request, with their provenance.
/// @throws Error(usage) for unknown names and options, and for counts and dimensions that the
/// generator cannot make; Error(limit) for what exceeds run.max_memory; Error(cancelled)
PointSet generate(std::string_view spec, const Request& request = {}, const Settings& settings = {},
                  const RunContext& run = {});

/// Point i of a sequence as a pure function of i: for a renderer that asks for samples one by one.
/// Takes the generators that need no set as a whole (halton, sobol, jittered, ..., no blue noise).
/// Several threads may ask one Sampler at once.
class Sampler {
  public:
    /// @throws Error(usage), also for generators whose points are made all together
    explicit Sampler(std::string_view spec, const Request& request = {});
    Sampler(Sampler&&) noexcept;
    Sampler& operator=(Sampler&&) noexcept;
    ~Sampler();

    [[nodiscard]] std::size_t dimension() const;

    /// Writes points first, first + 1, ... until `rows`, whose size is a multiple of the dimension,
    /// is full; coordinates in [0, 1).
    /// @throws Error(usage) for another size, and for indices beyond the last point
    void fill(std::uint64_t first, std::span<double> rows) const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace stipple
