// SPDX-License-Identifier: MIT
//
// Provenance stored beside or around the points: in a sidecar file for formats that cannot hold it
// (npy, bin, utk, psa); in comments of ply; in the metadata element of svg; in a text chunk of a
// PNG picture that a generator made with its points.
//
//     points.npy.meta.json {"format":"stipple.meta","version":1,"of":"npy","width":2,"meta":{...}}
//
// Beware  a sidecar file becomes stale when another program replaces the points; readers ignore it
//         if the file has another number of points (except raw numbers) or other first bytes.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/format.hpp"

namespace stipple::io {

struct CarriedMeta {
    std::string of;  ///< the points' format, or the generator's option that names the picture
    std::size_t width = 0;                 ///< numbers per point; 0: unknown
    std::size_t sets = 0;                  ///< sets in the file; 0: unknown, or of different sizes
    bool single = false;                   ///< the file holds float32
    std::string front = {};                ///< FrontFingerprint of the file; empty: unknown
    std::vector<std::string> extras = {};  ///< names of the numbers after the coordinates
    Provenance provenance = {};

    /// Whether the recorded fingerprint, if any, is that of a file that begins with these bytes.
    [[nodiscard]] bool begins(std::string_view bytes) const;

    /// Whether this provenance fits a file with these bytes, sets, points and numbers per point.
    [[nodiscard]] bool fits(std::size_t of_sets, std::uint64_t count, std::size_t numbers,
                            std::string_view bytes) const;
};

/// Path of the sidecar file of a point file.
std::string meta_path(std::string_view points);

/// The sidecar file of a point file; nullopt for standard input and without such a file.
/// @throws Error(io); Error(input) as carried_meta()
std::optional<CarriedMeta> meta_beside(const std::string& points, const RunContext& run);

std::string to_text(const CarriedMeta& meta);

/// Parses the output of to_text(). @throws Error(input) if the text is not provenance
CarriedMeta carried_meta(std::string_view text, const std::string& source);

/// Provenance in the bytes of a ply, svg or PNG file; nullopt if the file has none or another
/// format.
std::optional<CarriedMeta> find_carried_meta(std::string_view bytes, const std::string& source);

/// JSON description in a PNG or svg picture made by `stipple plot`; nullopt for other files.
std::optional<std::string> picture_note(std::string_view bytes);

/// A ply or svg file with its provenance removed.
std::string without_meta(std::string_view bytes);

/// A PNG picture with provenance added as a text chunk.
std::string png_with_meta(std::string_view png, const CarriedMeta& meta);

/// Provenance as an svg metadata element.
std::string svg_metadata(const Provenance& provenance);

}  // namespace stipple::io
