// SPDX-License-Identifier: MIT
#include "io/carried_meta.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/bytes/file_bytes.hpp"
#include "core/bytes/fingerprint.hpp"
#include "core/error.hpp"
#include "core/json.hpp"
#include "core/text.hpp"
#include "io/files.hpp"
#include "io/provenance.hpp"
#include "media/png_picture.hpp"

namespace stipple::io {
namespace {

constexpr std::string_view keyword = "stipple";
constexpr std::string_view open_tag = "<metadata>\n";
constexpr std::string_view close_tag = "</metadata>\n";
constexpr std::string_view ply_comment = "comment ";

/// Calls take(line, whether it is a comment) for each line of a ply header. Returns the position
/// after the header.
template <class Take>
std::size_t ply_header(std::string_view bytes, const Take& take) {
    std::size_t at = 0;
    while (at < bytes.size()) {
        const auto end = std::min(bytes.find('\n', at), bytes.size() - 1) + 1;
        const auto line = bytes.substr(at, end - at);
        take(line, line.starts_with(ply_comment));
        at = end;
        if (line == "end_header\n") break;
    }
    return at;
}

/// Parses provenance from lines "key: value"; nullopt if no line has a known key.
std::optional<CarriedMeta> of_lines(std::string of, std::string_view text) {
    CarriedMeta meta{.of = std::move(of)};
    bool found = false;
    for (const auto line : split(text, '\n')) found |= take_comment_line(line, meta.provenance);
    return found ? std::optional(meta) : std::nullopt;
}

std::optional<CarriedMeta> of_ply(std::string_view bytes) {
    std::string comments;
    ply_header(bytes, [&](std::string_view line, bool comment) {
        if (comment) comments += line.substr(ply_comment.size());
    });
    return of_lines("ply", comments);
}

/// The metadata element with its tags; empty if there is none.
std::string_view svg_piece(std::string_view bytes) {
    const auto begin = bytes.find(open_tag);
    const auto end = bytes.find(close_tag, begin == std::string_view::npos ? 0 : begin);
    if (begin == std::string_view::npos || end == std::string_view::npos) return {};
    return bytes.substr(begin, end + close_tag.size() - begin);
}

/// Content of the metadata element, unescaped; empty if there is none.
std::string svg_text(std::string_view bytes) {
    const auto piece = svg_piece(bytes);
    if (piece.empty()) return {};
    std::string text(
        piece.substr(open_tag.size(), piece.size() - open_tag.size() - close_tag.size()));
    replace_all(text, "&lt;", "<");
    replace_all(text, "&gt;", ">");
    replace_all(text, "&amp;", "&");
    return text;
}

bool is_svg(std::string_view bytes) {
    return bytes.starts_with("<svg") || bytes.starts_with("<?xml");
}

}  // namespace

std::string meta_path(std::string_view points) { return std::string(points) + ".meta.json"; }

std::optional<CarriedMeta> meta_beside(const std::string& points, const RunContext& run) {
    const std::string path = meta_path(points);
    if (points == "-" || !exists(status_of(path))) return std::nullopt;
    return carried_meta(read_bytes(path, run), path);
}

bool CarriedMeta::begins(std::string_view bytes) const {
    if (front.empty()) return true;
    FrontFingerprint found;
    found.add(bytes);
    return front == found.text();
}

bool CarriedMeta::fits(std::size_t of_sets, std::uint64_t count, std::size_t numbers,
                       std::string_view bytes) const {
    return of_sets == sets && count == provenance.count && numbers == width &&
           width == provenance.dimension + extras.size() && begins(bytes);
}

std::string to_text(const CarriedMeta& meta) {
    Json out{{"format", "stipple.meta"}, {"version", 1}, {"of", meta.of}};
    if (meta.width > 0) out["width"] = meta.width;
    if (meta.sets > 0) out["sets"] = meta.sets;
    if (meta.single) out["dtype"] = "f32";
    if (!meta.front.empty()) out["front"] = meta.front;
    if (!meta.extras.empty()) out["extras"] = meta.extras;
    out["meta"] = to_json(meta.provenance);
    // ASCII only, since a tEXt chunk of a PNG cannot hold UTF-8.
    return out.dump(-1, ' ', true, Json::error_handler_t::replace);
}

CarriedMeta carried_meta(std::string_view text, const std::string& source) {
    const Json json = try_parse_json(text);
    if (!json.is_object() || json.value("format", Json()) != "stipple.meta" ||
        json.value("version", Json()) != 1 || !json.contains("meta"))
        fail(ErrorKind::input,
             "{}: no provenance; expected {{\"format\":\"stipple.meta\",\"version\":1,...}}",
             source);
    CarriedMeta meta{.of = {}, .provenance = provenance_from(json["meta"])};
    const auto take = [&json](const char* key, std::size_t& number) {
        const auto it = json.find(key);
        if (it != json.end() && it->is_number_unsigned()) number = it->get<std::size_t>();
    };
    take("width", meta.width);
    take("sets", meta.sets);
    meta.single = json.value("dtype", Json()) == "f32";
    if (const auto it = json.find("extras"); it != json.end() && it->is_array())
        for (const Json& name : *it)
            if (name.is_string()) meta.extras.push_back(name.get<std::string>());
    const auto take_text = [&json](const char* key, std::string& word) {
        if (const auto it = json.find(key); it != json.end() && it->is_string())
            word = it->get<std::string>();
    };
    take_text("front", meta.front);
    take_text("of", meta.of);
    return meta;
}

std::optional<CarriedMeta> find_carried_meta(std::string_view bytes, const std::string& source) {
    if (bytes.starts_with("ply\n")) return of_ply(bytes);
    if (is_svg(bytes)) return of_lines("svg", svg_text(bytes));
    if (!bytes.starts_with(png_magic)) return std::nullopt;
    const auto text = text_of_png(bytes, keyword);
    return text ? std::optional(carried_meta(*text, source)) : std::nullopt;
}

std::optional<std::string> picture_note(std::string_view bytes) {
    if (bytes.starts_with(png_magic)) return text_of_png(bytes, keyword);
    if (!is_svg(bytes)) return std::nullopt;
    const std::string text = svg_text(bytes);
    const std::string begin = fmt::format("{}: ", keyword);
    for (const auto line : split(text, '\n'))
        if (line.starts_with(begin)) return std::string(line.substr(begin.size()));
    return std::nullopt;
}

std::string without_meta(std::string_view bytes) {
    if (bytes.starts_with("ply\n")) {
        std::string kept;
        const auto end = ply_header(bytes, [&](std::string_view line, bool comment) {
            if (!comment) kept += line;
        });
        return kept.append(bytes.substr(end));
    }
    const auto piece = svg_piece(bytes);
    if (piece.empty()) return std::string(bytes);
    const auto begin = static_cast<std::size_t>(piece.data() - bytes.data());
    return std::string(bytes.substr(0, begin)).append(bytes.substr(begin + piece.size()));
}

std::string png_with_meta(std::string_view png, const CarriedMeta& meta) {
    return png_with_text(png, keyword, to_text(meta));
}

std::string svg_metadata(const Provenance& provenance) {
    std::string lines = to_comment_lines(provenance, "");
    replace_all(lines, "&", "&amp;");
    replace_all(lines, "<", "&lt;");
    replace_all(lines, ">", "&gt;");
    return std::string(open_tag) + lines + std::string(close_tag);
}

}  // namespace stipple::io
