// SPDX-License-Identifier: MIT
//
// Input points of a verb: from files, with --from, -d, --column, --dtype, --domain, --bounds and
// --rescale, or from a generator, with --generate.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "analyzers/analyzer.hpp"
#include "cli/session.hpp"
#include "core/error.hpp"
#include "io/point_stream.hpp"
#include "pipeline/shared_analysis.hpp"

namespace stipple::cli {

/// Inputs from the command line, by default standard input unless --generate is given; files joined
/// by --concat are one input. @throws Error(usage) if standard input is named twice
std::vector<std::string> input_names(const Arguments& arguments);

/// The input of a verb that takes exactly one. @throws Error(usage) if there are more
std::string only_input(const Arguments& arguments, const std::string& hint = {});

/// Sets of an input, with their domain; with --concat, all files as one set.
std::vector<PointSet> read_input(const std::string& path, const Arguments& arguments,
                                 const RunContext& run);

/// Like read_input(), for the bytes of a file that has been read.
std::vector<PointSet> read_input(std::string_view bytes, const std::string& path,
                                 const Arguments& arguments, const RunContext& run);

/// Opens an input to be read in blocks; its domain is input_domain().
/// @param strengths name of a column of weights, read after the coordinates; empty if none
std::unique_ptr<io::PointStream> open_input(const std::string& path, const Arguments& arguments,
                                            const RunContext& run,
                                            const std::string& strengths = {});

/// Reads all sets of a stream, with their domain.
std::vector<PointSet> read_all(io::PointStream& stream, const Arguments& arguments,
                               const RunContext& run);

/// Removes rows with a missing number (NaN), such as failed runs; notes and returns how many.
/// @throws Error(input) if none remain
std::size_t leave_out_gaps(PointSet& set, const std::string& input, const RunContext& run);

/// Domain of a file's points, from --parameters or from the file.
DomainPtr input_domain(const Provenance& provenance, std::size_t dimension,
                       const Arguments& arguments, const RunContext& run);

/// An error in points with the name of their input in front, if not there yet.
/// @param hint replaces the error's own hint; empty: keeps it
Error named_error(const Error& e, const std::string& input, const std::string& hint);

/// Runs work() on an input; errors in its points name the input.
template <class Work>
auto naming(const std::string& input, const Work& work, const std::string& hint = {}) {
    try {
        return work();
    } catch (const Error& e) {
        throw named_error(e, input, hint);
    }
}

/// Sets the domain from --domain, if given.
void take_domain(PointSet& set, const Arguments& arguments);

/// @throws Error(input) if the bounding box is too wide for float64
/// @param input named in the message; empty if the caller adds the name
void require_width(const PointSet& points, const std::string& input = {});

/// Points of a file in their own coordinates, in the domain of --domain; or their bounding box
/// mapped to the unit cube for --rescale. @throws like take_domain() and require_width()
PointSet placed(PointSet points, const std::string& input, const Arguments& arguments);

/// Checks points for an analyzer of the unit cube: points of another domain may be in the cube
/// without being a sample of it. @throws Error(input) if the set has another domain
PointSet of_the_cube(PointSet points, const Analyzer& analyzer);

/// Applies --domain, --bounds and --rescale. Analyzers of the unit cube get points mapped to it;
/// others measure in the original coordinates, with distances and integrals in the box.
PointSet prepared(PointSet points, const Analyzer& analyzer, const Arguments& arguments);

/// Domain and number of a stream's points, prepared like prepared().
Arrival arrival_of(const io::PointStream& stream, bool weighted, const Analyzer& analyzer,
                   const Arguments& arguments, const RunContext& run);

/// Rows from `next`, mapped as --bounds requires. @param first index of the first point
NextRows within_bounds(NextRows next, const Arrival& arrival, std::uint64_t first,
                       const Analyzer& analyzer, const Arguments& arguments);

/// All files of a command as one set that ranks share.
SharedSet shared_files(const Arguments& arguments, const Analyzer& analyzer,
                       const std::string& strengths, Ranks& ranks, const RunContext& run);

/// The seed of --seed, or a random one, at most `largest`, which is reported. @throws Error(usage)
std::uint64_t seed_of(const Arguments& arguments, std::uint64_t largest, Session& session);

/// Largest seed that the generator accepts.
std::uint64_t largest_seed(const Generator& generator, const Values& values);

/// The seed of --seed, or a random one, which the generators of all specs accept.
std::uint64_t seed_for(const Arguments& arguments, std::span<const std::string> specs,
                       Session& session);

/// Sets requested by -n, -d, --start, --sets, --warp and --parameters; without seed and bounds.
SetsToMake sets_asked(const Generator& generator, Values options, const Arguments& arguments);

/// Sets of a --generate spec, with -n, -d, --start and --warp.
GeneratedSets generated_sets(const std::string& spec, std::uint64_t seed,
                             const Arguments& arguments, const RunContext& run);

/// @throws Error(usage) for options of --generate without it, and for options of files without
/// files
void require_options_of_sources(const Arguments& arguments);

}  // namespace stipple::cli
