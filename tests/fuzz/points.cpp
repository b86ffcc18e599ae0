// SPDX-License-Identifier: MIT
//
// Formats of points: reading in blocks equals reading a whole file, and writing to any suitable
// format and reading back preserves the points.
#include <nlohmann/json.hpp>
#include <optional>

#include "core/json.hpp"
#include "core/text.hpp"
#include "fuzz.hpp"
#include "io/carried_meta.hpp"
#include "io/feed.hpp"
#include "io/files.hpp"
#include "io/format.hpp"
#include "io/point_stream.hpp"
#include "io/provenance.hpp"

namespace stipple::fuzz {
namespace {

using Sets = std::vector<PointSet>;

/// All sets of a stream, read in blocks; nullopt if the format cannot be read in blocks.
std::optional<Sets> in_blocks(const Format& format, std::string_view bytes,
                              const ReadOptions& options) {
    auto feed = std::make_unique<io::Feed>(bytes);
    const auto stream = format.stream(feed, options, small_run());
    if (!stream) return std::nullopt;
    Sets sets;
    while (stream->next_set()) {
        std::vector<double> rows;
        std::vector<double> block(3 * stream->dimension());
        while (const std::size_t got = stream->read(block))
            rows.insert(rows.end(), block.begin(),
                        block.begin() + static_cast<std::ptrdiff_t>(got * stream->dimension()));
        if (rows.empty()) fail(ErrorKind::input, "a set without points");  // like whole files
        sets.emplace_back(std::move(rows), stream->dimension());
    }
    return sets;
}

bool can_hold(const Format& format, const Sets& sets) {
    const std::size_t d = sets[0].dimension();
    bool equal = true;
    for (const PointSet& set : sets) equal = equal && set.count() == sets[0].count();
    const bool marked = format.name != "bin";  // bin merges all sets into one
    return format.read && d >= format.traits.min_dimension && d <= format.traits.max_dimension &&
           (equal || !format.traits.equal_sets) &&
           (sets.size() == 1 || (format.traits.many_sets && marked));
}

std::string written(const Format& format, const Sets& sets) {
    Layout layout{.dimension = sets[0].dimension(), .provenance = sets[0].provenance};
    layout.meta = true;
    for (const PointSet& set : sets) layout.counts.push_back(set.count());
    std::string out;
    if (format.head) format.head(layout, out);
    for (std::size_t s = 0; s < sets.size(); ++s) {
        if (format.begin_set) format.begin_set(layout, s, out);
        const auto flat = sets[s].flat();
        format.rows(layout, s, 0, flat.first(layout.dimension), out);
        format.rows(layout, s, 1, flat.subspan(layout.dimension), out);
    }
    if (format.tail) format.tail(layout, out);
    return out;
}

void read_points(const Format& format, std::string_view bytes) {
    TextInput input(bytes, 2);
    const std::size_t choice = input.below(256);
    const Format& other = io::all()[input.below(io::all().size())];
    ReadOptions options{.source = "p", .all_columns = (choice & 4) != 0};
    if ((choice & 3) != 0 || format.name == "bin") options.dimension = (choice & 3) + 1;
    options.single = (choice & 8) != 0;
    if ((choice & 48) == 16) options.columns = {"2", "x"};
    if ((choice & 48) == 32) options.strengths = "1";

    std::optional<Sets> sets;
    std::optional<Sets> blocks;
    accepted([&] { sets = format.read(input.text, options, small_run()); });
    const bool streamed =  // rarely, because blocks are large
        !format.stream || choice < 224 ||
        accepted([&] { blocks = in_blocks(format, input.text, options); });
    if (blocks || !streamed)
        require(blocks.has_value() == sets.has_value() && (!blocks || *blocks == *sets),
                "other points in blocks");
    if (!sets) return;
    require(!sets->empty() && sets->front().count() > 0, "no points");
    if (!can_hold(other, *sets)) return;
    const std::string again = written(other, *sets);
    const ReadOptions plain{.source = "p", .dimension = sets->front().dimension()};
    const Sets back = other.read(again, plain, {.threads = 1});
    require(back == *sets, "other points from " + other.name);
    const Provenance& meta = sets->front().provenance;
    // With weights, the last column is not a coordinate and its name is lost.
    if (other.name == "json" && options.strengths.empty() && meta.flaw.empty() &&
        !meta.version.empty())
        require(io::to_json(back[0].provenance) == io::to_json(meta), "other provenance");
}

void comments(std::string_view bytes) {
    Provenance meta;
    for (const auto line : split(bytes, '\n')) io::take_comment_line(line, meta);
    Provenance back;
    const std::string text = io::to_comment_lines(meta);
    for (const auto line : split(text, '\n'))
        if (line.size() > 2) io::take_comment_line(line.substr(2), back);
    if (meta.flaw.empty()) require(io::to_comment_lines(back) == text, "other comments");
}

void provenance(std::string_view bytes) {
    comments(bytes);
    const Json json = try_parse_json(bytes);
    if (json.is_discarded()) return;
    const Provenance meta = io::provenance_from(json);
    if (meta.flaw.empty())
        require(io::to_json(io::provenance_from(io::to_json(meta))) == io::to_json(meta),
                "other provenance");
}

void carried(std::string_view bytes) {
    accepted([&] { io::carried_meta(bytes, "p"); });
    std::optional<io::CarriedMeta> found;
    accepted([&] { found = io::find_carried_meta(bytes, "p"); });
    io::without_meta(bytes);
    io::picture_note(bytes);
    if (found && found->provenance.flaw.empty()) {
        const std::string text = io::to_text(*found);
        require(io::to_text(io::carried_meta(text, "p")) == text, "other carried meta");
    }
}

}  // namespace

std::vector<Target> point_targets() {
    std::vector<Target> targets = {{"provenance", provenance}, {"carried", carried}};
    for (const Format& format : io::all())
        if (format.read)
            targets.push_back({format.name, [&](std::string_view b) { read_points(format, b); }});
    targets.push_back(
        {"points", [](std::string_view b) { read_points(io::format_of_bytes(b), b); }});
    return targets;
}

}  // namespace stipple::fuzz
