// SPDX-License-Identifier: MIT
//
// Provenance where readers of points do not look for it: in a file beside the points, for formats
// that have no place for it (npy, bin, utk, psa); in the comments of ply; in the metadata of svg; in
// a text chunk of a PNG picture that a generator made with its points.
//
//     points.npy.meta.json {"format":"stipple.meta","version":1,"of":"npy","width":2,"meta":{...}}
//
// Beware  a file beside points stays when another program replaces them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "io/format.hpp"

namespace stipple::io {

struct CarriedMeta {
    std::string of;         ///< the format of the points, or the option that named the picture
    std::size_t width = 0;  ///< numbers of a point; 0: not said
    std::size_t sets = 0;   ///< in the file; 0: not said
    Provenance provenance = {};
};

/// The name of the file beside points.
std::string meta_path(std::string_view points);

std::string to_text(const CarriedMeta& meta);

/// The way back. @throws Error(input) for a text that is none.
CarriedMeta carried_meta(std::string_view text, const std::string& source);

/// What the bytes of ply, svg or PNG hold; nothing where they are neither or hold none.
std::optional<CarriedMeta> find_carried_meta(std::string_view bytes, const std::string& source);

/// What a picture by `stipple plot`, PNG or svg, tells of itself, as JSON; nothing for others.
std::optional<std::string> picture_note(std::string_view bytes);

/// The bytes of a ply or svg without what they hold of provenance.
std::string without_meta(std::string_view bytes);

/// A PNG picture with provenance in a text chunk.
std::string png_with_meta(std::string_view png, const CarriedMeta& meta);

/// Provenance as svg's metadata element.
std::string svg_metadata(const Provenance& provenance);

}  // namespace stipple::io
