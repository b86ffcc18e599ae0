// SPDX-License-Identifier: MIT
//
// Files other than points that units and commands read: pictures, meshes, tables, matrices,
// reports, studies.
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/bytes/npy_header.hpp"
#include "fuzz.hpp"
#include "io/carried_meta.hpp"
#include "math/fourier/transform.hpp"
#include "media/density_map.hpp"
#include "media/pfm_picture.hpp"
#include "media/png_picture.hpp"
#include "media/triangle_mesh.hpp"
#include "plot/report_charts.hpp"
#include "plot/text_picture.hpp"
#include "report/document.hpp"
#include "stipple/stipple.hpp"
#include "study/study_config.hpp"
#include "study/study_file.hpp"

namespace stipple::fuzz {
namespace {

void density(std::string_view bytes) {
    const DensityMap map = read_density(as_file(bytes), false, small_run());
    for (const double u : {0.0, 0.3, 0.99999}) {
        const auto [x, y] = map.place(u, 1 - u - 1e-9);
        require(map.at(x, y) > 0, "a point where the density is 0");
    }
    accepted([&] { read_density(as_file(bytes), true, small_run()); });
    accepted([&] { read_lengths(as_file(bytes), small_run()); });
    accepted([&] { read_mask(as_file(bytes), false, small_run()); });
}

void png(std::string_view bytes) {
    text_of_png(bytes, "stipple");
    const PngPicture picture = read_png(bytes, "p", small_run());
    require(picture.grey.size() == picture.width * picture.height, "another size");
    for (const double grey : picture.grey) require(grey >= 0 && grey <= 1, "grey outside [0, 1]");
}

void pfm(std::string_view bytes) {
    const PlaneValues picture = read_pfm(bytes, "p", small_run());
    require(picture.values.size() == picture.width * picture.height, "another size");
}

void npy_header(std::string_view bytes) {
    const NpyHeader header = read_npy_header(bytes, "p");
    npy_numbers(header, bytes.size());
}

/// Maps points forward, and back if there is an inverse.
void warp(const std::string& spec, std::size_t dimension) {
    const Warper warper(spec, dimension);
    std::vector<double> cube(5 * warper.dimension_in());
    for (std::size_t i = 0; i < cube.size(); ++i)
        cube[i] = std::fmod(0.618 * static_cast<double>(i), 1);
    const std::vector<double> image = warper.forward(cube);
    for (const double x : image) require(std::isfinite(x), "an image that is not finite");
    for (const double f : warper.density(image)) require(f >= 0, "a density below 0");
    accepted([&] {
        for (const double x : warper.inverse(image)) require(x >= 0 && x < 1, "not in the cube");
    });
}

void mesh(std::string_view bytes) {
    for (const auto parse : {parse_ply, parse_obj})
        accepted([&] {
            const TriangleMesh found = parse(std::string(bytes), "p", small_run());
            for (const auto& corners : found.triangles)
                for (const std::uint32_t corner : corners)
                    require(corner < found.vertices.size(), "a corner that is not there");
        });
    warp("mesh:file=" + as_file(bytes), 3);
}

void generator(const char* spec, std::string_view bytes) {
    for (const std::size_t d : {1, 2, 5})
        accepted([&] {
            const PointSet points =
                generate(spec + as_file(bytes), {.count = 8, .dimension = d}, {}, small_run());
            // Points of the file may be on 1.
            for (const double x : points.flat()) require(x >= 0 && x <= 1, "not in the cube");
        });
}

/// A table of inputs and outputs of runs, for each method that accepts any.
void sensitivity(std::string_view bytes) {
    const PointSet table = read(as_file(bytes), {}, small_run());
    for (const char* spec : {"sensitivity", "sensitivity:method=ranks", "moments"})
        accepted([&] {
            const std::string text = to_text(analyze(spec, table, {}, small_run()));
            require(text.find(" nan") == text.npos && text.find(" inf") == text.npos,
                    "a result that is no number");
        });
}

/// Points that may be compressed.
void compressed(std::string_view bytes) {
    for (const PointSet& set : read_sets(as_file(bytes), {}, small_run()))
        require(set.count() > 0 && set.dimension() > 0, "a set without points");
}

void reports(std::string_view bytes) {
    looks_like_reports(bytes);
    const std::vector<Measurement> found = read_reports(bytes, "p");
    to_text(found);
    accepted([&] { to_csv(found); });
    const std::string text = to_json(found);
    require(to_json(read_reports(text, "p")) == text, "other reports");
    const plot::Chart chart = plot::chart_of(found);
    plot::chart_as_text(chart, {}, {});
    plot::svg_bytes(plot::draw_chart(chart, {}), 1, {});
}

void study_config(std::string_view bytes) {
    SweepRequest request{.measures = {}};
    for (const auto& [name, text] : parse_study_config(bytes, "p")) {
        if (name == "generators") request.generators.push_back(text);
        if (name == "analyze") request.measures.push_back(text);
        if (name == "warp") request.warps.push_back(text);
        if (name == "count") request.counts = parse_counts(text, "--count", 1, 1 << 20);
    }
    const Sweep sweep(request);
    for (std::uint64_t unit = 0; unit < std::min<std::uint64_t>(sweep.units(), 9); ++unit)
        row_of(sweep, sweep.unit(unit));
}

/// Resumes a small study from a table and its journal; in the end all rows must exist.
void study_journal(std::string_view bytes) {
    static const std::string path = std::filesystem::temp_directory_path() /
                                    ("stipple-fuzz-" + std::to_string(::getpid()) + ".csv");
    static const Sweep sweep({.generators = {"halton"},
                              .counts = {1, 2, 3},
                              .measures = {"star-discrepancy"},
                              .keys = {"value"},
                              .seconds = false});
    const StudyTable table(TableStyle::csv, false);
    const auto seam = std::min(bytes.find('\0'), bytes.size());
    std::ofstream(path, std::ios::binary) << bytes.substr(0, seam);
    if (seam < bytes.size())
        std::ofstream(path + ".journal", std::ios::binary) << bytes.substr(seam + 1);
    std::size_t rows = 0;
    accepted([&] {
        StudyFile file(
            path, sweep, table, StudyFile::Start::resume, [&](const StudyRow&) { ++rows; },
            small_run());
        std::uint64_t next = 0;
        std::vector<UnitRange> done = file.done();
        done.push_back({sweep.units(), sweep.units()});
        for (const auto& [first, last] : done) {
            for (; next < first; ++next) {
                file.put({{next, next + 1}, {{.numbers = {{"value", 0.5}}}}});
            }
            require(last <= sweep.units(), "units that the study does not have");
            next = std::max(next, last);
        }
        file.listen(small_run());
        file.finish("", small_run());
        require(rows >= sweep.units(), "rows are missing");
    });
    std::filesystem::remove(path);
    std::filesystem::remove(path + ".journal");
}

void study_rows(std::string_view bytes) {
    for (const TableStyle style : {TableStyle::csv, TableStyle::jsonl}) {
        const StudyTable table(style, true);
        if (const auto row = table.parse(bytes)) {
            const std::string line = table.line(*row);
            const auto again = table.parse(std::string_view(line).substr(0, line.size() - 1));
            require(again && table.line(*again) == line, "another row");
        }
    }
}

}  // namespace

std::vector<Target> file_targets() {
    using Bytes = std::string_view;
    return {
        {"density", density},
        {"png", png},
        {"pfm", pfm},
        {"npy-header", npy_header},
        {"mesh", mesh},
        {"polygon", [](Bytes b) { warp("polygon:file=" + as_file(b), 2); }},
        {"table-1d", [](Bytes b) { warp("table-1d:file=" + as_file(b), 1); }},
        {"parameters", [](Bytes b) { warp("parameters:file=" + as_file(b), 2); }},
        {"lattice", [](Bytes b) { generator("rank1-lattice:vector-file=", b); }},
        {"polynomial", [](Bytes b) { generator("polynomial-lattice:vector-file=", b); }},
        {"matrices", [](Bytes b) { generator("digital-net:matrices=", b); }},
        {"directions", [](Bytes b) { generator("sobol:directions=", b); }},
        {"subset", [](Bytes b) { generator("subset:effort=1e-5,from=", b); }},
        {"optimized", [](Bytes b) { generator("optimized:effort=1e-6,from=", b); }},
        {"extended", [](Bytes b) { generator("latin-hypercube:extend=", b); }},
        {"sensitivity", sensitivity},
        {"compressed", compressed},
        {"warp", [](Bytes b) { warp(std::string(b), 2); }},
        {"reports", reports},
        {"study-config", study_config},
        {"study-journal", study_journal},
        {"study-rows", study_rows},
        {"wisdom", [](Bytes b) { read_wisdom(as_file(b)); }},
    };
}

}  // namespace stipple::fuzz
