// SPDX-License-Identifier: MIT
#include "media/triangle_mesh.hpp"

#include <charconv>
#include <limits>
#include <string_view>

#include "core/bytes/file_bytes.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "media/token_file.hpp"

namespace stipple {
namespace {

constexpr std::size_t between_stops = 65536;  ///< rows between checks for a stop

double coordinate(TokenFile& file, const char* what) {
    const Token token = file.next_on_line(what);
    const auto value = parse_number(token.text);
    if (!value)
        file.refuse(token,
                    fmt::format("{} is not a finite number; expected {}", shown(token.text), what));
    if (!(std::abs(*value) <= most_coordinate))
        file.refuse(token, fmt::format("{} is outside [-1e150, 1e150]", shown(token.text)));
    return *value;
}

/// The corner with the highest vertex index so far; the index is checked at the end of the file.
struct Highest {
    Token token;
    std::int64_t place = -1;
};

/// Vertex index of a corner "7", "7/1", "7//3" or "-1", where -1 is the latest vertex, and so on.
std::uint32_t corner(TokenFile& file, std::size_t vertices, Highest& highest) {
    const Token token = file.next("a corner");
    const std::string_view text = token.text.substr(0, token.text.find('/'));
    std::int64_t index = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
    if (error != std::errc() || end != text.data() + text.size())
        file.refuse(token, fmt::format("{} is not a corner; expected the number of a vertex",
                                       shown(token.text)));
    const auto count = static_cast<std::int64_t>(vertices);
    const std::int64_t place = index < 0 ? count + index : index - 1;
    if (index == 0 || place < 0 || place >= std::numeric_limits<std::uint32_t>::max())
        file.refuse(token, fmt::format("there is no vertex {}; {} are given before this line",
                                       index, count));
    if (place > highest.place) highest = {token, place};
    return static_cast<std::uint32_t>(place);
}

void skip_rest(TokenFile& file) {
    while (!file.at_line_end()) file.next("a word");
}

}  // namespace

TriangleMesh parse_obj(std::string bytes, const std::string& name, const RunContext& run) {
    TokenFile file(std::move(bytes), name);
    TriangleMesh mesh;
    MeshFaces faces;
    std::vector<std::uint32_t> polygon;
    Highest highest;
    for (std::size_t row = 0; !file.at_end(); ++row) {
        if (row % between_stops == 0) run.check_stop();
        const Token word = file.next("a line");
        if (word.text == "v") {
            if (mesh.vertices.size() == std::numeric_limits<std::uint32_t>::max())
                file.refuse(word, "there are more than 2^32 - 1 vertices");
            const double x = coordinate(file, "coordinate x");
            const double y = coordinate(file, "coordinate y");
            mesh.vertices.push_back({x, y, coordinate(file, "coordinate z")});
        } else if (word.text == "f") {
            polygon.clear();
            while (!file.at_line_end())
                polygon.push_back(corner(file, mesh.vertices.size(), highest));
            if (polygon.size() < 3)
                file.refuse(word, fmt::format("a face of {} corners; at least 3 are needed",
                                              polygon.size()));
            faces.add(polygon);
        }
        skip_rest(file);
    }
    if (highest.place >= static_cast<std::int64_t>(mesh.vertices.size()))
        file.refuse(highest.token, fmt::format("there is no vertex {}; the file has {}",
                                               highest.place + 1, mesh.vertices.size()));
    mesh.triangles = faces.triangles(mesh.vertices, name, run);
    if (mesh.triangles.empty()) file.refuse_whole("no faces; expected a PLY or OBJ mesh");
    return mesh;
}

TriangleMesh read_mesh(const std::string& path, const RunContext& run) {
    std::string bytes = read_file(path);
    run.need_memory(4.0 * static_cast<double>(bytes.size()), "the mesh");
    const std::string_view head = std::string_view(bytes).substr(0, 4);
    if (head == "ply\n" || head == "ply\r") return parse_ply(std::move(bytes), path, run);
    return parse_obj(std::move(bytes), path, run);
}

}  // namespace stipple
