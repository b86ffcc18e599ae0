// SPDX-License-Identifier: MIT
//
// Making points. A generator is named by a spec, NAME or NAME:OPTION=VALUE,...: "halton",
// "sobol:scramble=owen", "poisson-disk:radius=0.01". `stipple list generators` shows all of them.
//
// Promise  the points depend only on the spec and the request, not on threads, time or machine.
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

/// Parameters of a set; unset ones take the generator's defaults, usually 1024 points in two
/// dimensions.
struct Request {
    std::optional<std::uint64_t> count = {};
    std::optional<std::size_t> dimension = {};
    std::uint64_t start = 0;         ///< index of the first point, for sequences
    std::optional<Box> bounds = {};  ///< box that the points fill; unset: the unit cube
    std::uint64_t seed = 1;
};

/// Options as text, {{"base", "3"}}; they override those of the spec.
using Settings = std::vector<std::pair<std::string, std::string>>;

/// Names of all generators, in alphabetical order.
std::vector<std::string> generator_names();

/// Returns the requested points with their provenance.
/// @throws Error(usage) for unknown names and options, and for counts and dimensions that the
/// generator cannot make; Error(limit) if run.max_memory would be exceeded; Error(cancelled)
PointSet generate(std::string_view spec, const Request& request = {}, const Settings& settings = {},
                  const RunContext& run = {});

/// Random access to a sequence: point i as a pure function of i, for example for a renderer that
/// asks for samples one by one. Works with generators whose points do not depend on the whole set
/// (halton, sobol, jittered, ..., but no blue noise). One Sampler can serve several threads at
/// once.
class Sampler {
  public:
    /// @throws Error(usage), also if the generator's points depend on the whole set
    explicit Sampler(std::string_view spec, const Request& request = {});
    Sampler(Sampler&&) noexcept;
    Sampler& operator=(Sampler&&) noexcept;
    ~Sampler();

    [[nodiscard]] std::size_t dimension() const;

    /// Fills `rows` with points first, first + 1, ...; coordinates in [0, 1). Point 0 is the one
    /// with the index `start` of the request.
    /// @throws Error(usage) if the size is not a multiple of dimension(), and for indices beyond
    /// the last point
    void fill(std::uint64_t first, std::span<double> rows) const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace stipple
