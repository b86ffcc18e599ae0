// SPDX-License-Identifier: MIT
//
// The way of rows to a file: filled, warped and formatted block by block on all threads, written in
// order. Memory is a few blocks a thread, whatever the size of the set.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "pipeline/chain.hpp"
#include "pipeline/produce.hpp"

namespace stipple {

/// Rows of one set, on their way to the file.
struct Source {
    std::uint64_t count = 0;    ///< rows
    std::size_t dimension = 0;  ///< numbers of a row that `fill` gives
    /// Gives rows [first, first + k) where `rows` holds k of them.
    std::function<void(std::uint64_t first, std::span<double> rows)> fill;
    bool in_order = false;  ///< fill must be called for one block after the other
    /// In place of fill, where the count is not known: gives the next rows, as many as fit, and
    /// fewer only at the end.
    std::function<std::size_t(std::span<double> rows)> read = {};
    std::shared_ptr<const WarpChain> chain;  ///< that the rows go through
    std::uint64_t first = 0;                 ///< index of the first row in the whole set
};

/// What happens to rows before and after their warps.
struct Route {
    std::optional<Box> bounds = {};  ///< scales the unit cube to this box first
    Columns columns = {};            ///< added as last numbers
    double volume = 1;               ///< measure of what the chain's unit cube was scaled to
    bool inverse = false;            ///< goes back to the unit cube
    bool starts = false;             ///< its first point can be left out by --start
};

/// Sets with everything that is needed to write them one after the other.
struct Shipment {
    std::size_t sets = 1;
    std::size_t first_set = 0;  ///< number of the first one among all
    std::function<Source(std::size_t set, const RunContext&)> source;
    std::function<Provenance(std::size_t set)> provenance;
    std::optional<std::uint64_t> first_seed = {};  ///< of {seed} in names; else the provenance says
    std::function<Box(std::size_t set)> extent;    ///< what a picture of the set shows
    /// Files that come with the set, under their final names; empty: none.
    std::function<const std::vector<SideFile>&(std::size_t set)> side_files = {};
    std::vector<std::uint64_t> counts;
    std::size_t dimension = 0;  ///< numbers of a row that is written, less the columns
    Route route;
};

/// Whether the path holds {set} or {seed}.
bool file_per_set(const std::string& path);

/// The path with {set} and {seed} filled in.
std::string path_of_set(std::string path, std::size_t set, std::uint64_t seed);

/// Writes the sets to the target's file or files, and what comes with them. False: the pipe was
/// closed.
/// @throws Error
bool ship(const Shipment& shipment, const Target& target, const RunContext& run);

/// The part of a run's progress that one of several sets is.
RunContext lane(const RunContext& run, std::size_t set, std::size_t sets);

/// Tells the user how many of `count` points were kept by a chain that may drop some.
/// @throws Error(input) when none was
void tell_kept(std::uint64_t count, std::uint64_t kept, const WarpChain& chain,
               const RunContext& run);

/// Each row with the route's columns behind it.
std::vector<double> with_columns(std::span<const double> rows, const WarpChain& chain,
                                 const Route& route);

}  // namespace stipple
