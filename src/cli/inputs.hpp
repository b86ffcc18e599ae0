// SPDX-License-Identifier: MIT
//
// Input points of a verb: from files (with --from, -d, --column, --dtype, --domain, --bounds and
// --rescale), or from a generator (--generate).
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "analyzers/analyzer.hpp"
#include "cli/parsing/requests.hpp"
#include "core/error.hpp"
#include "io/point_stream.hpp"
#include "pipeline/shared_analysis.hpp"

namespace stipple::cli {

/// Inputs on the command line or, without inputs and --generate, standard input. Files joined by
/// --concat are one input. @throws Error(usage) if standard input is named twice
std::vector<std::string> input_names(const Sources& from);

/// The input of a verb that takes exactly one. @throws Error(usage) if there are more
std::string only_input(const Sources& from, const std::string& hint = {});

/// Reads all sets of an input, with their domains; with --concat, all files as one set.
std::vector<PointSet> read_input(const std::string& path, const Sources& from,
                                 const RunContext& run);

/// Like read_input(), for the bytes of a file that has been read.
std::vector<PointSet> read_input(std::string_view bytes, const std::string& path,
                                 const Sources& from, const RunContext& run);

/// Opens an input to be read in blocks; input_domain() returns its domain.
/// @param strengths name of a column of weights, read after the coordinates; empty if none
std::unique_ptr<io::PointStream> open_input(const std::string& path, const Sources& from,
                                            const RunContext& run,
                                            const std::string& strengths = {});

/// Reads all sets of a stream, with their domains.
std::vector<PointSet> read_all(io::PointStream& stream, const Sources& from, const RunContext& run);

/// Domain of a file's points, from --parameters or from the file.
DomainPtr input_domain(const Provenance& provenance, std::size_t dimension, const Sources& from,
                       const RunContext& run);

/// The same error; if it is about the points and does not begin with the name of the input yet,
/// with that name in front.
/// @param hint for an error without its own
Error named_error(const Error& e, const std::string& input, const std::string& hint);

/// Returns work(). Its errors are rethrown with the input's name, see named_error().
template <class Work>
auto naming(const std::string& input, const Work& work, const std::string& hint = {}) {
    try {
        return work();
    } catch (const Error& e) {
        throw named_error(e, input, hint);
    }
}

/// Leaves out rows with missing numbers, and applies --domain and --rescale: that maps the points'
/// bounding box to the unit cube. Notes and returns the number of rows left out.
/// @throws Error(input) if no row remains, or the box is too wide for float64
std::size_t place(PointSet& points, const std::string& input, const Sources& from,
                  const RunContext& run);

/// Applies --domain, --bounds and --rescale. The box of --bounds is mapped to the unit cube for
/// analyzers of the cube and with --rescale; otherwise it becomes the domain.
PointSet prepared(PointSet points, const Analyzer& analyzer, const Sources& from);

/// Domain and count of a stream's points, after the options that prepared() applies.
Arrival arrival_of(const io::PointStream& stream, bool weighted, const Analyzer& analyzer,
                   const Sources& from, const RunContext& run);

/// Rows from `next`, checked and mapped as --bounds requires. @param first index of the first point
NextRows within_bounds(NextRows next, const Arrival& arrival, std::uint64_t first,
                       const Analyzer& analyzer, const Sources& from);

/// All files of a command as one set that ranks share.
SharedSet shared_files(const Sources& from, const Analyzer& analyzer, const std::string& strengths,
                       Ranks& ranks, const RunContext& run);

/// The seed of --seed; for --seed random, a random one up to `largest`, which is reported.
/// @throws Error(usage) for --seed random on several ranks, each of which would draw its own
std::uint64_t seed_of(const Request& request, std::uint64_t largest, Session& session);

/// Largest seed that the generator accepts.
std::uint64_t largest_seed(const Generator& generator, const Values& values);

/// As seed_of(); a random seed is one that all generators of --generate accept.
std::uint64_t seed_for_generators(const Sources& from, Session& session);

/// Sets requested by -n, -d, --start, --sets, --warp and --parameters; the caller sets seed and
/// bounds.
SetsToMake sets_asked(const Generator& generator, Values options, const Sources& from);

/// Sets of a --generate spec, with the options of sets_asked().
GeneratedSets generated_sets(const std::string& spec, std::uint64_t seed, const Sources& from,
                             const RunContext& run);

/// Reads the file of --parameters, if given. @throws Error(input), Error(io)
void read_parameter_file(Request& request, const RunContext& run);

}  // namespace stipple::cli
