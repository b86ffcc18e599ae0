// SPDX-License-Identifier: MIT
//
// Points that a verb is given: from files, as --from, -d, --column, --dtype, --domain, --bounds and
// --rescale say, or straight from a generator, for --generate.
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

/// The inputs that are named or, without --generate, standard input; those that --concat joins are
/// one.
/// @throws Error(usage) when standard input is named twice
std::vector<std::string> input_names(const Arguments& arguments);

/// The one input of a verb that takes no more. @throws Error(usage)
std::string only_input(const Arguments& arguments, const std::string& hint = {});

/// The sets of an input, with their domain; with --concat it is all files as one set.
std::vector<PointSet> read_input(const std::string& path, const Arguments& arguments,
                                 const RunContext& run);

/// The same of the bytes of a file that was read already.
std::vector<PointSet> read_input(std::string_view bytes, const std::string& path,
                                 const Arguments& arguments, const RunContext& run);

/// The same in blocks, where they are many; their domain is input_domain.
/// `strengths` names a column that comes behind the coordinates.
std::unique_ptr<io::PointStream> open_input(const std::string& path, const Arguments& arguments,
                                            const RunContext& run,
                                            const std::string& strengths = {});

/// All sets of a stream, with their domain.
std::vector<PointSet> read_all(io::PointStream& stream, const Arguments& arguments,
                               const RunContext& run);

/// Leaves out rows with a missing number (NaN), as runs that failed have it; notes and returns how many.
/// @throws Error(input) where none remains
std::size_t leave_out_gaps(PointSet& set, const std::string& input, const RunContext& run);

/// What points of a file live on, as the file says.
DomainPtr input_domain(const Provenance& provenance, std::size_t dimension,
                       const Arguments& arguments, const RunContext& run);

/// An error in points with the input that they are from in front, where it does not name it itself.
/// @param hint in place of its own; empty: that
Error named_error(const Error& e, const std::string& input, const std::string& hint);

/// Works on an input; errors in its points name it.
template <class Work>
auto naming(const std::string& input, const Work& work, const std::string& hint = {}) {
    try {
        return work();
    } catch (const Error& e) {
        throw named_error(e, input, hint);
    }
}

/// Puts the set on the domain that --domain names, if it does.
void take_domain(PointSet& set, const Arguments& arguments);

/// @throws Error(input) for coordinates so large that a box around them is too wide for float64.
/// @param input names them in the message; empty: the caller does
void require_width(const PointSet& points, const std::string& input = {});

/// The points of a file where they are looked at as they are: on the domain that --domain names, or
/// their bounding box mapped to the unit cube for --rescale. @throws as the two above
PointSet placed(PointSet points, const std::string& input, const Arguments& arguments);

/// Points of another domain may lie in the cube and be no sample of it.
/// @throws Error(input) where the set says that it has another domain.
PointSet of_the_cube(PointSet points, const Analyzer& analyzer);

/// --bounds says what box the points live on. Analyzers of the unit cube get them mapped to it; the
/// others measure them where they are, distances and integrals in the box.
PointSet prepared(PointSet points, const Analyzer& analyzer, const Arguments& arguments);

/// What the points of a stream are on, and how many there are, prepared in the same way.
Arrival arrival_of(const io::PointStream& stream, bool weighted, const Analyzer& analyzer,
                   const Arguments& arguments, const RunContext& run);

/// The rows that `next` gives, mapped as --bounds says; the first one is point `first`.
NextRows within_bounds(NextRows next, const Arrival& arrival, std::uint64_t first,
                       const Analyzer& analyzer, const Arguments& arguments);

/// All files of a command as one set that ranks share.
SharedSet shared_files(const Arguments& arguments, const Analyzer& analyzer,
                       const std::string& strengths, Ranks& ranks, const RunContext& run);

/// --seed, or one that is drawn and reported, at most `largest`. @throws Error(usage)
std::uint64_t seed_of(const Arguments& arguments, std::uint64_t largest, Session& session);

/// The largest seed that the generator takes.
std::uint64_t largest_seed(const Generator& generator, const Values& values);

/// --seed, one that the generators of all specs take.
std::uint64_t seed_for(const Arguments& arguments, std::span<const std::string> specs,
                       Session& session);

/// What -n, -d, --start, --sets, --warp and --parameters ask of a generator; without seed and bounds.
SetsToMake sets_asked(const Generator& generator, Values options, const Arguments& arguments);

/// What --generate names, with -n, -d, --start and --warp.
GeneratedSets generated_sets(const std::string& spec, std::uint64_t seed,
                             const Arguments& arguments, const RunContext& run);

/// @throws Error(usage) for options of --generate where it is not given, and for those of files where
/// only it is
void require_options_of_sources(const Arguments& arguments);

}  // namespace stipple::cli
