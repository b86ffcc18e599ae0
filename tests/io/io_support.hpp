// SPDX-License-Identifier: MIT
//
// Shorthands for writing and reading point files in memory.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/rng.hpp"
#include "io/format.hpp"
#include "support/units.hpp"

namespace stipple::testing {

/// A file with these sets; rows have layout.extras after the coordinates.
inline std::string written(std::string_view format_name, const std::vector<PointSet>& sets,
                           Layout layout = {}) {
    const Format& format = io::format_named(format_name);
    layout.dimension = sets.at(0).dimension() - layout.extras.size();
    for (const PointSet& set : sets) layout.counts.push_back(set.count());
    std::string out;
    if (format.head) format.head(layout, out);
    for (std::size_t s = 0; s < sets.size(); ++s) {
        if (format.begin_set) format.begin_set(layout, s, out);
        // Two calls, because rows are written in blocks.
        const std::size_t half = sets[s].count() / 2;
        const auto flat = sets[s].flat();
        format.rows(layout, s, 0, flat.first(half * sets[s].dimension()), out);
        format.rows(layout, s, half, flat.subspan(half * sets[s].dimension()), out);
    }
    if (format.tail) format.tail(layout, out);
    return out;
}

inline std::vector<PointSet> read_as(std::string_view format, std::string_view bytes,
                                     ReadOptions options = {}, const RunContext& run = {}) {
    if (options.source == "-") options.source = "p";
    return io::format_named(format).read(bytes, options, run);
}

/// Notes that reading makes, one after another.
inline std::string notes_of(std::string_view format, std::string_view bytes,
                            const ReadOptions& options = {}) {
    std::string notes;
    read_as(format, bytes, options, {.warn = [&](const std::string& note) { notes += note; }});
    return notes;
}

/// Error of reading; empty if there is none.
inline std::string refusal(std::string_view format, std::string_view bytes,
                           const ReadOptions& options = {}, const RunContext& run = {}) {
    return error_of([&] { read_as(format, bytes, options, run); });
}

/// Uniform random points, the same for the same seed.
inline PointSet random_points(std::size_t count, std::size_t dimension, std::uint64_t seed = 1) {
    PointSet points(count, dimension);
    Rng(seed).fill(0, points.flat());
    return points;
}

inline Provenance some_provenance() {
    return {.version = "0.1.0",
            .generator = "halton",
            .options = {{"base", "3"},
                        {"radius", "0.25"},
                        {"toroidal", "true"},
                        {"method", "polar"},
                        {"like-a-number", "007"},
                        {"vertices", "0,0 1,0 0,1"}},
            .seed = 18446744073709551615U,
            .count = 3,
            .dimension = 2,
            .start = 5,
            .warps = {"disk:method=concentric"},
            .domain = "disk:radius=2",
            .bounds = "0..2",
            .shard = "1/4",
            .command = "stipple generate halton -n 3 \"quoted\" \\ und \xC3\xA4"};
}

}  // namespace stipple::testing
