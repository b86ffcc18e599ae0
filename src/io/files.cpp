// SPDX-License-Identifier: MIT
#include "io/files.hpp"

#include "core/error.hpp"
#include "core/text.hpp"
#include "io/feed.hpp"
#include "io/provenance.hpp"
#include "io/source_text.hpp"

namespace stipple::io {

const Format& format_for(const std::string& path, std::string_view bytes) {
    const Format* named = format_of_extension(path);
    const Format& found = format_of_bytes(bytes);
    const auto either = [](const Format& one, const char* first, const char* second) {
        return one.name == first || one.name == second;
    };
    const bool told = named == nullptr || either(*named, "csv", "txt") || named->name == "tsv" ||
                      (either(*named, "json", "jsonl") && either(found, "json", "jsonl")) ||
                      (named->name == "bin" && found.name == "utk");
    return told ? found : *named;
}

std::string read_bytes(const std::string& path, const RunContext& run) {
    return Feed(path, run).read_all();
}

std::vector<PointSet> read_sets(std::string_view bytes, const std::string& path,
                                const ReadOptions& options, const RunContext& run,
                                const Format* format) {
    ReadOptions inner = options;
    if (inner.source == "-") inner.source = path;
    inner.single = options.single || extension_is_single(path);
    const Format& chosen = format != nullptr ? *format : format_for(path, bytes);
    if (!chosen.read) {
        std::vector<std::string> readable;
        for (const Format& known : all())
            if (known.read) readable.push_back(known.name);
        fail(ErrorKind::usage, "{}: {} can only be written; formats that can be read: {}",
             source_name(inner.source), chosen.name, join(readable, ", "));
    }
    auto sets = chosen.read(bytes, inner, run);
    const PointSet& first = sets.front();
    if (!options.any_count) note_count(inner.source, first.provenance, first.count(), run);
    return sets;
}

std::vector<PointSet> read_points(const std::string& path, const ReadOptions& options,
                                  const RunContext& run, const Format* format) {
    return read_sets(read_bytes(path, run), path, options, run, format);
}

void require_file(std::string_view option, const std::string& path) {
    if (path == "-")
        fail(ErrorKind::usage, "--{}: standard input cannot be read again; give a file", option);
}

PointSet read_given(std::string_view option, const std::string& path, const ReadOptions& options,
                    const RunContext& run) {
    require_file(option, path);
    std::vector<PointSet> sets = read_points(path, options, run);
    if (sets.size() != 1)
        fail(ErrorKind::input, "{}: {} sets of points; expected one", path, sets.size());
    return std::move(sets.front());
}

}  // namespace stipple::io
