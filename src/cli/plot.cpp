// SPDX-License-Identifier: MIT
//
// The verb `plot`: points, reports or a study in, a picture out.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>

#include "analyzers/distances/empty_ball.hpp"
#include "cli/inputs.hpp"
#include "cli/session.hpp"
#include "cli/terminal.hpp"
#include "cli/verbs.hpp"
#include "core/bytes/npy_header.hpp"
#include "core/error.hpp"
#include "core/spec.hpp"
#include "core/text.hpp"
#include "io/files.hpp"
#include "io/provenance.hpp"
#include "io/source_text.hpp"
#include "page/experiment.hpp"
#include "pipeline/chain.hpp"
#include "pipeline/generated.hpp"
#include "pipeline/pipeline.hpp"
#include "pipeline/units.hpp"
#include "plot/drawing/ticks.hpp"
#include "plot/figure.hpp"
#include "plot/local_discrepancy.hpp"
#include "plot/pair_table.hpp"
#include "plot/points_picture.hpp"
#include "plot/report_charts.hpp"
#include "plot/spectral_table.hpp"
#include "plot/study_chart.hpp"
#include "plot/text_picture.hpp"
#include "report/average.hpp"
#include "report/document.hpp"
#include "study/study_file.hpp"
#include "study/sweep.hpp"

namespace stipple::cli {
namespace {

constexpr std::size_t most_overlaid = 7;  ///< limit for sets in one frame: one per colour
constexpr std::size_t most_frames = 12;   ///< limit for frames on one sheet

Medium medium_of(std::optional<Medium> named, const std::string& path) {
    const bool terminal = is_terminal(path);
    if (terminal && (named == Medium::png || named == Medium::pdf))
        fail_with_hint(ErrorKind::usage, "name a file with -o, or pipe it on",
                       "--format: {} is binary, and standard output is a terminal",
                       named == Medium::png ? "png" : "pdf");
    if (named) return *named;
    if (path == "-") return terminal ? Medium::text : Medium::svg;
    if (path.ends_with(".png")) return Medium::png;
    if (path.ends_with(".pdf")) return Medium::pdf;
    if (path.ends_with(".txt")) return Medium::text;
    if (path.ends_with(".svg") || path.starts_with("/dev/")) return Medium::svg;
    fail_with_hint(ErrorKind::usage, "or name the format with -f svg, pdf, png or text",
                   "--output: {} has no extension of a picture; expected .svg, .pdf, .png or .txt",
                   path);
}

/// A set of points with its source.
struct Loaded {
    PointSet points;
    std::string source;
    std::optional<std::size_t> number;  ///< index in the file, if it has several sets
    bool npy;                           ///< read from NPY, so possibly a table saved by --grid
    std::string title;                  ///< made from the provenance or the source
    std::string typed;                  ///< command or spec that made it; empty if unknown
    std::size_t left_out = 0;           ///< number of rows with missing numbers
    std::vector<bool> log = {};         ///< whether each coordinate is a parameter on a log scale
    std::vector<std::string> units = {};
};

/// Title for a picture of points: "halton", "sobol, disk"; if the generator is unknown, the file's
/// name or "points".
std::string title_of_points(const Provenance& from, const std::string& source) {
    if (from.generator.empty())
        return source == "-" || source.empty() ? "points" : source.substr(source.rfind('/') + 1);
    std::string title = from.generator;
    for (const std::string& warp : from.warps)
        title += ", " + (page::is_experiment(warp) ? "parameters" : warp);
    return title;
}

/// Title with options, such as "sobol:scramble=owen, disk", for pictures without a subtitle.
std::string full_title(const Loaded& set) {
    const Provenance& from = set.points.provenance;
    const Generator* generator = generator_named(from.generator);
    const auto options = generator != nullptr ? changed_options(from, *generator, set.typed)
                                              : std::vector<std::string>();
    if (options.empty() || !set.title.starts_with(from.generator)) return set.title;
    return fmt::format("{}:{}{}", from.generator, join(options, ","),
                       set.title.substr(from.generator.size()));
}

/// "1024 points, seed 3, scramble=owen": the count, the seed if it affects the points, and the
/// options that differ from their defaults.
std::string subtitle_of(const Loaded& set) {
    const Provenance& from = set.points.provenance;
    const std::size_t n = set.points.count();
    std::string text = fmt::format("{} point{}", n, n == 1 ? "" : "s");
    if (set.left_out > 0)
        text += fmt::format(", without {} that {} missing numbers", set.left_out,
                            set.left_out == 1 ? "has" : "have");
    if (const Generator* generator = generator_named(from.generator)) {
        if (seed_matters(*generator, from)) text += fmt::format(", seed {}", from.seed);
        if (from.start > 0) text += fmt::format(", from index {}", from.start);
        for (const std::string& option : changed_options(from, *generator, set.typed))
            text += ", " + option;
    }
    return text;
}

/// " (set 2)", or empty if the source has only one set.
std::string number_of(const Loaded& set) {
    return set.number ? fmt::format(" (set {})", *set.number) : "";
}

/// Key of the result with the side of a cell, for grids over distances.
constexpr const char* pixel_key = "pixel";

/// One `plot` call: the sets or reports read, and their picture.
class Plot {
  public:
    Plot(const PlotRequest& request, Session& session)
        : request_(request),
          session_(session),
          path_(output_of(request)),
          medium_(medium_of(request.format, path_)),
          chart_(request.chart),
          labels_(request.labels),
          axes_(request.axes) {
        for (const Analyzer& analyzer : analyzers::all())
            for (const auto& [name, title] : analyzer.charts)
                if (name == chart_) {
                    charted_ = &analyzer;
                    grid_title_ = title;
                }
        take_style();
    }

    int go() {
        for (const std::string& input : input_names(request_)) read(input);
        add_generated();
        if (several_kinds())
            refuse_options(request_, "labels,axes,set", "applies to inputs of a single kind");
        pick_set();
        rename_sources();
        if (!sets_.empty()) add_points();
        if (!reports_.empty()) add_reports();
        if (!means_.empty()) add_study();
        const std::string bytes = picture();
        session_.run().check_stop();
        write_text(path_, bytes);
        return 0;
    }

  private:
    /// Whether the sheet mixes points, reports and studies.
    [[nodiscard]] bool several_kinds() const {
        return !reports_.empty() + !sets_.empty() + !means_.empty() > 1;
    }

    void take_style() {
        style_.theme = request_.dark ? &plot::dark_theme : &plot::light_theme;
        style_.title = request_.title;
        style_.log_x = request_.log_x;
        style_.log_y = request_.log_y;
        const bool letters = medium_ == Medium::text;
        const std::uint64_t most = letters ? 1000 : 20000;
        const auto& width = request_.width;
        const auto& height = request_.height;
        require_range("width", width, letters ? 20 : 120, most);
        require_range("height", height, letters ? 8 : 90, most);
        if (letters) {
            const TerminalSize terminal = terminal_size();
            room_ = {.columns = terminal.columns,
                     .rows = terminal.rows,
                     .coloured = is_terminal(path_) && colours_wanted()};
            if (width) room_.columns = *width;
            if (height) room_.rows = *height;
            return;
        }
        // Text has its usual size in small pictures, and grows with large ones.
        constexpr double usual = 800;
        const double wide = static_cast<double>(width.value_or(0));
        const double high = static_cast<double>(height.value_or(0));
        if (wide > 0)
            style_.scale = std::max(1.0, wide / usual);
        else if (high > 0)
            style_.scale = std::max(1.0, high / usual);
        else if (medium_ == Medium::png)
            style_.scale = 2;
        style_.width = wide / style_.scale;
        style_.height = high / style_.scale;
    }

    /// Checks an option's number. @throws Error(usage) if it is outside [low, high]
    static void require_range(const char* option, const std::optional<std::uint64_t>& value,
                              std::uint64_t low, std::uint64_t high) {
        if (value && (*value < low || *value > high))
            fail(ErrorKind::usage, "--{}: {} is outside [{}, {}]", option, *value, low, high);
    }

    void read(const std::string& input) {
        const RunContext& run = session_.run();
        const std::string bytes = io::read_bytes(input, run);
        if (request_.from.empty())
            if (auto means = read_means(bytes, io::source_name(input), run)) {
                note_unfinished(input, run);
                add_study(*std::move(means), input);
                return;
            }
        if (request_.from.empty() && looks_like_reports(bytes)) {
            for (Measurement& m : read_reports(bytes, io::source_name(input)))
                reports_.push_back(std::move(m));
            return;
        }
        auto sets = naming(
            input, [&] { return read_input(bytes, input, request_, run); },
            "plot takes points, the JSON of 'stipple analyze', or the table of a study");
        for (std::size_t i = 0; i < sets.size(); ++i) {
            const std::size_t left_out = place(sets[i], input, request_, run);
            const Provenance made = sets[i].provenance;
            sets_.push_back({std::move(sets[i]), input,
                             sets.size() > 1 ? std::optional(i) : std::nullopt,
                             bytes.starts_with(npy_magic), title_of_points(made, input),
                             made.command, left_out});
        }
    }

    void add_generated() {
        if (request_.generate.empty()) return;
        seed_ = seed_for_generators(request_, session_);
        for (const std::string& spec : request_.generate) {
            const GeneratedSets sets = generated_sets(spec, seed_, request_, session_.run());
            const std::uint64_t count = sets.different_sets();
            for (std::uint64_t set = 0; set < count; ++set) {
                PointSet points = sets.made(set, session_.run());
                std::string title = title_of_points(points.provenance, spec);
                sets_.push_back({std::move(points), spec,
                                 count > 1 ? std::optional(set) : std::nullopt, false,
                                 std::move(title), spec});
            }
        }
    }

    /// Adds the rows of a study. If there are several studies, prefixes the generators' names with
    /// the file's name.
    void add_study(std::vector<MeanRow> means, const std::string& input) {
        if (means.empty()) fail(ErrorKind::input, "{}: the study has no rows", input);
        const auto prefix = [](std::vector<MeanRow>& rows, const std::string& from) {
            for (MeanRow& row : rows)
                row.generator = fmt::format("{}: {}", io::source_name(from), row.generator);
        };
        if (++studies_ == 2) prefix(means_, first_study_);
        if (studies_ == 1) first_study_ = input;
        if (studies_ > 1) prefix(means, input);
        std::ranges::move(means, std::back_inserter(means_));
    }

    /// Keeps only the set or report of --set, counted from 0 over all inputs.
    void pick_set() {
        if (!means_.empty()) return;
        const std::size_t there = std::max(sets_.size(), reports_.size());
        const auto& wanted = request_.set;
        require_range("set", wanted, 0, there - 1);
        if (!wanted) return;
        const auto pick = [&wanted](auto& all) {
            auto one = std::move(all[*wanted]);
            all.clear();
            all.push_back(std::move(one));
        };
        reports_.empty() ? pick(sets_) : pick(reports_);
    }

    /// Applies --labels to sets and generators of studies, and --axes to coordinates, before
    /// anything is drawn.
    void rename_sources() {
        for (Loaded& set : sets_) rename_columns(set);
        if (labels_.empty()) return;
        if (!means_.empty()) label_generators(means_, labels_);
        const std::vector<std::size_t> firsts = firsts_of_inputs();
        const bool all = labels_.size() == sets_.size();
        if (!all && !sets_.empty() && labels_.size() != firsts.size())
            refuse_labels(fmt::format("of the {} sets of points", sets_.size()));
        for (std::size_t i = 0, input = 0; i < sets_.size(); ++i) {
            while (input + 1 < firsts.size() && firsts[input + 1] <= i) ++input;
            sets_[i].title = labels_[all ? i : input];
            if (all) sets_[i].number.reset();
        }
    }

    void rename_columns(Loaded& set) const {
        Provenance& meta = set.points.provenance;
        const auto before = coordinate_names(set.points.dimension(), meta);
        set.log = page::log_axes(set.points);
        if (axes_.empty()) set.units = page::units_of(set.points);
        if (axes_.empty() || charted_ != nullptr || chart_ == "distances") return;
        if (axes_.size() != before.size())
            fail(ErrorKind::usage, "--axes: {} names for points of {} coordinates", axes_.size(),
                 before.size());
        for (auto& [column, words] : meta.levels)
            for (std::size_t k = 0; k < before.size(); ++k)
                if (column == before[k]) {
                    column = axes_[k];
                    break;
                }
        meta.columns = axes_;
    }

    [[noreturn]] void refuse_labels(const std::string& there) const {
        fail(ErrorKind::usage, "--labels: {} names; expected one for each {}", labels_.size(),
             there);
    }

    /// Applies --labels and --axes to a chart of reports.
    void rename(plot::Chart& chart) const {
        std::vector<std::string> names;
        const auto each = [&](const auto& work) {
            for (plot::ChartPanel& panel : chart.panels) {
                for (plot::Series& series : panel.series) work(series.name);
                for (plot::Bars& bars : panel.bars) work(bars.name);
            }
        };
        each([&](const std::string& name) {
            if (std::ranges::find(names, name) == names.end()) names.push_back(name);
        });
        if (!labels_.empty() && labels_.size() != names.size())
            refuse_labels(fmt::format("of the {} curves", names.size()));
        if (!labels_.empty())
            each([&](std::string& name) {
                name = labels_[static_cast<std::size_t>(std::ranges::find(names, name) -
                                                        names.begin())];
            });
    }

    void rename_axes(plot::Chart& chart) const {
        if (axes_.empty()) return;
        if (axes_.size() != chart.panels.size() + 1)
            fail(ErrorKind::usage, "--axes: {} names; there is x, and the y of {} panel{}",
                 axes_.size(), chart.panels.size(), chart.panels.size() == 1 ? "" : "s");
        for (std::size_t i = 0; i < chart.panels.size(); ++i) {
            chart.panels[i].x_name = axes_[0];
            chart.panels[i].y_name = axes_[i + 1];
        }
    }

    // ---------------------------------------------------------------- pictures

    void add_study() {
        if (!several_kinds())
            refuse_options(request_, "chart,set", "does not apply to the table of a study");
        plot::StudyChart found = plot::study_chart(means_, request_.key.value_or(""));
        if (!found.left_out.empty())
            session_.warn(fmt::format("{} results are drawn; --key draws others: {}",
                                      found.chart.panels.size(), join(found.left_out, ", ")));
        const auto below_zero = [](const plot::Series& series) {
            return std::ranges::any_of(series.y, [](double y) { return y < 0; });
        };
        for (const plot::ChartPanel& panel : found.chart.panels)
            if (style_.log_y.value_or(false) && std::ranges::any_of(panel.series, below_zero))
                fail(ErrorKind::input,
                     "--y-scale: a logarithmic axis cannot show {}, which has negative means",
                     panel.y_name);
        add(std::move(found.chart));
    }

    /// Adds a chart for the reports of each analyzer.
    void add_reports() {
        if (!chart_.empty() && sets_.empty())
            fail(ErrorKind::usage, "--chart applies to points only; omit it for a report of {}",
                 reports_[0].analyzer);
        while (!reports_.empty()) {
            const std::string analyzer = reports_[0].analyzer;
            const auto others =
                std::stable_partition(reports_.begin(), reports_.end(),
                                      [&](const Measurement& m) { return m.analyzer == analyzer; });
            const std::span own(reports_.begin(), others);
            if (!add_pair_tables(own)) {
                plot::Chart chart =
                    plot::chart_of(own, request_.key.value_or(""), style_.log_x.value_or(false));
                rename(chart);
                add(std::move(chart));
            }
            reports_.erase(reports_.begin(), others);
        }
    }

    /// Adds a heat map for each report of pairs of coordinates, with one colour scale for all.
    /// Returns false if --key names another result, or if a report has no numbers for pairs.
    bool add_pair_tables(std::span<const Measurement> reports) {
        std::vector<plot::PairTable> tables;
        double largest = 0;
        for (const Measurement& m : reports) {
            auto table = plot::pair_table(m);
            if (!table || (request_.key && !names_result(table->key, *request_.key))) return false;
            largest = std::max(largest, table->largest());
            tables.push_back(*std::move(table));
        }
        refuse_options(request_, "axes", "does not apply to pairs of coordinates");
        if (!labels_.empty() && labels_.size() != tables.size())
            refuse_labels(fmt::format("of the {} reports", tables.size()));
        for (std::size_t i = 0; i < tables.size(); ++i) {
            plot::PairTable& table = tables[i];
            if (!labels_.empty())
                table.title = labels_[i];
            else if (tables.size() > 1 && table.source != "-")
                table.title = table.source;
            const auto draw = [=](const plot::PictureStyle& style, bool last_in_row) {
                return plot::draw_pair_table(table, largest, last_in_row, style);
            };
            const auto write = [=](const plot::TextRoom&) {
                return plot::pair_table_as_text(table, largest);
            };
            frames_.push_back({.title = table.title, .draw = draw, .write = write, .bar = true});
        }
        return true;
    }

    void add(plot::Chart chart) {
        for (const plot::ChartPanel& panel : chart.panels)
            if (panel.off_axis > 0)
                session_.warn(fmt::format(
                    "{}: {} of {} values are 0 or less, and not on the logarithmic axis",
                    panel.x_name, panel.off_axis, panel.values));
        if (chart_ != "histogram") rename_axes(chart);  // a histogram's coordinates are renamed
        const auto draw = [chart](const plot::PictureStyle& style, bool) {
            return plot::draw_chart(chart, style);
        };
        const auto write = [this, chart](const plot::TextRoom& room) {
            return plot::chart_as_text(chart, style_, room);
        };
        frames_.push_back(
            {.title = chart.title, .draw = draw, .write = write, .panels = chart.panels.size()});
    }

    void add_points() {
        if (request_.key && !several_kinds())
            fail(ErrorKind::usage, "--key applies to reports and studies; these are points");
        if (charted_ != nullptr && grid_title_.empty()) return add(plot::chart_of(analyzed()));
        if (charted_ != nullptr || chart_.empty())
            if (auto found = saved_table()) {
                if (charted_ != nullptr)
                    found->differences = find_result(*charted_, pixel_key) != nullptr;
                return add_saved(*std::move(found));
            }
        if (charted_ != nullptr) return add_tables();
        if (chart_ == "local-discrepancy") return add_local_discrepancies();
        const bool frames = has_frames();
        if (!frames) require_one_dimension();
        keep_few_sets(frames ? most_frames : most_overlaid);
        for (const Loaded& set : sets_)
            if (chart_ == "pairs" && set.points.dimension() < 2)
                fail(ErrorKind::input, "--chart: points of one coordinate have no pairs of them");
        if (chart_ == "distances") return add_distances();
        if (chart_ != "histogram" && sets_[0].points.dimension() != 2) refuse_scales("such points");
        for (std::size_t i = 0; i < (frames ? sets_.size() : 1); ++i) {
            plot::PointsPicture picture = points_picture();
            if (frames) show_one(picture, i);
            add_overlays(picture, sets_[i]);
            if (chart_ == "histogram")
                add(plot::histogram_chart(picture));
            else
                add(picture);
        }
    }

    void add(const plot::PointsPicture& picture) {
        const auto draw = [this, picture](const plot::PictureStyle& style, bool) {
            return plot::draw_points(picture, style, session_.run());
        };
        const auto write = [picture](const plot::TextRoom& room) {
            return plot::points_as_text(picture, room);
        };
        frames_.push_back({.title = picture.title, .draw = draw, .write = write});
    }

    /// Restricts a picture of all sets to one of them.
    void show_one(plot::PointsPicture& picture, std::size_t i) const {
        picture.sets = {picture.sets[i]};
        picture.title = sets_[i].title + number_of(sets_[i]);
        picture.names = {picture.title};
        picture.subtitle = subtitle_of(sets_[i]);
    }

    /// Adds the overlays of --draw to the picture of one set.
    void add_overlays(plot::PointsPicture& picture, const Loaded& set) {
        if (request_.draw.empty()) return;
        if (set.points.dimension() != 2 || picture.sets.size() > 1 || medium_ == Medium::text ||
            std::ranges::find(picture.log, true) != picture.log.end())
            fail(ErrorKind::usage,
                 "--draw applies to one set of points of the plane per frame, not to text or "
                 "logarithmic axes");
        for (const std::string& word : request_.draw) {
            if (word == "cells") {
                picture.cells = true;
            } else if (word == "gap") {
                const auto distances = analyzers::distances_in_box(set.points, "", "--draw gap");
                const auto gap =
                    analyzers::largest_empty_ball(set.points, distances, {}, session_.run());
                picture.circles.push_back({.centre = {gap.center[0], gap.center[1]},
                                           .radius = gap.radius,
                                           .torus = distances.torus});
            } else if (word.starts_with("grid=")) {
                add_grid(picture, set.points, std::string_view(word).substr(5));
            } else {
                fail(ErrorKind::usage, "--draw: '{}' is not one of cells, gap, grid=COLUMNSxROWS",
                     word);
            }
        }
    }

    /// Adds the lines between equal cells of the domain's box. @param text COLUMNSxROWS
    static void add_grid(plot::PointsPicture& picture, const PointSet& set, std::string_view text) {
        const auto parts = split(text, 'x');
        const Box box = set.domain->bounding_box();
        for (std::size_t k = 0; k < 2; ++k) {
            const auto cells = parts.size() == 2 ? parse_unsigned(parts[k]) : std::nullopt;
            if (!cells || *cells < 1 || *cells > 1024)
                fail(ErrorKind::usage, "--draw: 'grid={}' is not grid=COLUMNSxROWS of 1 to 1024",
                     text);
            for (std::uint64_t i = 1; i < *cells; ++i) {
                plot::Position from{box.low[0], box.low[1]};
                plot::Position to{box.high[0], box.high[1]};
                const double at = static_cast<double>(i) / static_cast<double>(*cells);
                (k == 0 ? from.x : from.y) = (k == 0 ? to.x : to.y) =
                    box.low[k] + at * box.extent(k);
                picture.lines.emplace_back(from, to);
            }
        }
    }

    std::string picture() {
        if (request_.letters) style_.letter = 0;
        if (medium_ == Medium::text) return plot::figure_as_text(frames_, style_, room_);
        const plot::Drawing drawing = plot::draw_figure(frames_, style_);
        constexpr double pixel_bytes = 14;  // with coverage, and two copies for libpng
        if (medium_ == Medium::png)
            session_.run().need_memory(
                pixel_bytes * drawing.width * drawing.height * style_.scale * style_.scale,
                "the picture");
        const plot::PictureNotes notes = notes_of();
        return medium_ == Medium::svg   ? plot::svg_bytes(drawing, style_.scale, notes)
               : medium_ == Medium::pdf ? plot::pdf_bytes(drawing, style_.scale, notes)
                                        : plot::png_bytes_of(drawing, style_.scale, notes);
    }

    /// Rejects a logarithmic axis for a picture that cannot have one. @throws Error(usage)
    void refuse_scales(const char* what) const {
        for (const auto& [name, log] :
             {std::pair{"x-scale", style_.log_x}, {"y-scale", style_.log_y}})
            if (log.value_or(false))
                fail_with_hint(ErrorKind::usage,
                               "--chart histogram, distances, radial and pair-correlation have "
                               "axes that can be",
                               "--{}: a picture of {} has no logarithmic axes", name, what);
    }

    /// The table of the input, if --grid saved it.
    [[nodiscard]] std::optional<plot::SpectralTable> saved_table() const {
        std::vector<const PointSet*> sets;
        for (const Loaded& set : sets_) {
            if (set.source != sets_[0].source || !set.npy) return std::nullopt;
            sets.push_back(&set.points);
        }
        return plot::spectral_table(sets);
    }

    /// Axis names for a table of differences. @param pixel side of a pixel in mean distances, if
    /// known
    [[nodiscard]] plot::TableNames names_of(std::optional<double> pixel) const {
        if (!pixel) return renamed({.x = "Δx (pixels)", .y = "Δy (pixels)", .shade = "density"});
        return renamed({.x = "Δx / mean distance",
                        .y = "Δy / mean distance",
                        .shade = "density",
                        .cell = *pixel});
    }

    /// Replaces the axis names by those of --axes, if given.
    [[nodiscard]] plot::TableNames renamed(plot::TableNames names) const {
        if (axes_.empty()) return names;
        if (axes_.size() != 2)
            fail(ErrorKind::usage, "--axes: {} names; a table has x and y", axes_.size());
        names.x = axes_[0];
        names.y = axes_[1];
        return names;
    }

    void add_saved(const plot::SpectralTable& table) {
        const std::string& title = sets_[0].title;
        if (table.dimension == 1) return add(plot::power_chart(table.values, title));
        refuse_scales("a table");
        add_table(table.values, title, table.dimension == 3 ? "plane fz = 0" : "",
                  table.differences ? names_of(std::nullopt) : renamed({}));
    }

    /// Adds the table of each input; tables share colour bars at the ends of rows.
    void add_tables() {
        refuse_scales("a table");
        const std::vector<std::size_t> firsts = firsts_of_inputs();
        const std::vector<Measurement> found = analyzed_tables();
        for (std::size_t i = 0; i < found.size(); ++i) {
            const Loaded& first = sets_[firsts[i]];
            const Measurement& m = found[i];
            std::string title = m.sets > 1 ? m.source : first.title;
            if (found.size() == 1) title = fmt::format("{} of {}", grid_title_, title);
            const std::string subtitle =
                m.sets > 1 ? fmt::format("{} points, mean of {} sets", m.count, m.sets)
                           : subtitle_of(first) + number_of(first);
            const auto pixel = number_at(m.results, pixel_key);
            add_table(std::get<Grid>(*m.results.find("grid")), title, subtitle,
                      pixel ? names_of(pixel) : renamed({}));
            if (found.size() > 1) frames_.back().title = m.source;
        }
    }

    void add_table(const Grid& table, const std::string& title, const std::string& subtitle,
                   const plot::TableNames& names) {
        const auto draw = [=](const plot::PictureStyle& style, bool last_in_row) {
            plot::TableNames own = names;
            own.bar = last_in_row;
            return plot::draw_spectrum(table, title, subtitle, style, own);
        };
        const auto write = [=](const plot::TextRoom& room) {
            return plot::spectrum_as_text(table, room);
        };
        frames_.push_back({.title = title, .draw = draw, .write = write, .bar = true});
    }

    /// Measurements with a table, one for each input. @throws Error(input) unless sets are planar
    std::vector<Measurement> analyzed_tables() {
        auto found = analyzed();
        if (found.size() > most_frames) {
            session_.warn(
                fmt::format("the first {} of {} inputs are drawn", most_frames, found.size()));
            found.resize(most_frames);
        }
        for (const Measurement& m : found)
            if (m.dimension != 2)
                fail_with_hint(
                    ErrorKind::input, "--chart radial draws its radial mean",
                    "--chart: a {} in the plane needs points of 2 coordinates; these have {}",
                    chart_, m.dimension);
        return found;
    }

    /// Adds the local discrepancy of each set, with one colour scale for all and bars at the ends
    /// of rows.
    void add_local_discrepancies() {
        refuse_options(request_, "overlay,draw", "does not apply to the local discrepancy");
        refuse_scales("a local discrepancy");
        keep_few_sets(most_frames);
        std::vector<plot::WorstBoxes> worst;
        double largest = 0;
        for (const Loaded& set : sets_) {
            worst.push_back(naming(
                set.source, [&] { return plot::worst_boxes_of(set.points, session_.run()); }));
            largest = std::max(largest, worst.back().star());
        }
        const bool single = sets_.size() == 1;
        for (std::size_t i = 0; i < sets_.size(); ++i) {
            const Loaded& set = sets_[i];
            const std::string title =
                single ? "Local discrepancy of " + set.title : set.title + number_of(set);
            const std::string subtitle = subtitle_of(set) + (single ? number_of(set) : "");
            const auto draw = [=, this, &set, boxes = worst[i]](const plot::PictureStyle& style,
                                                                bool last_in_row) {
                return plot::draw_local_discrepancy(
                    set.points, boxes,
                    {.title = title,
                     .subtitle = subtitle,
                     .largest = largest,
                     .bar = last_in_row,
                     .resolution =
                         medium_ == Medium::png ? style.scale : std::max(style.scale, 2.0)},
                    style, session_.run());
            };
            const auto write = [=, this, &set, boxes = worst[i]](const plot::TextRoom& room) {
                return plot::local_discrepancy_as_text(set.points, boxes, largest, room,
                                                       session_.run());
            };
            frames_.push_back({.title = title, .draw = draw, .write = write, .bar = true});
        }
    }

    void add_distances() {
        std::vector<const PointSet*> sets;
        for (const Loaded& set : sets_) sets.push_back(&set.points);
        plot::Chart chart =
            plot::distance_chart(sets, names(), style_.log_x.value_or(false), session_.run());
        if (!different_titles()) chart.title += " of " + sets_[0].title;
        if (sets_.size() == 1) chart.subtitle = subtitle_of(sets_[0]) + number_of(sets_[0]);
        add(std::move(chart));
    }

    /// Measures with default options: one measurement for each input, the mean over its sets.
    std::vector<Measurement> analyzed() {
        const Analyzer& analyzer = *charted_;
        const Values options = analyzer.options.defaults();
        std::vector<Measurement> found;
        const std::vector<std::size_t> firsts = firsts_of_inputs();
        for (std::size_t i = 0; i < firsts.size(); ++i)
            found.push_back(analyzed(analyzer, options, firsts[i],
                                     i + 1 < firsts.size() ? firsts[i + 1] : sets_.size()));
        return found;
    }

    /// Index of the first set of each input.
    [[nodiscard]] std::vector<std::size_t> firsts_of_inputs() const {
        std::vector<std::size_t> firsts;
        for (std::size_t i = 0; i < sets_.size(); ++i)
            if (i == 0 || sets_[i].source != sets_[i - 1].source) firsts.push_back(i);
        return firsts;
    }

    Measurement analyzed(const Analyzer& analyzer, const Values& options, std::size_t first,
                         std::size_t last) {
        ReportAverage average;
        std::vector<Report> singles;
        for (std::size_t i = first; i < last; ++i) {
            const Loaded& set = sets_[i];
            naming(set.source, [&] { check_dimension(analyzer, set.points.dimension()); });
            const Report report = naming(
                set.source,
                [&] { return stipple::analyze(analyzer, set.points, options, session_.run()); },
                fmt::format("'stipple analyze {}' has options for others, and plot draws its JSON",
                            analyzer.name));
            average.add(report);
            singles.push_back(numbers_only(report));
        }
        const PointSet& points = sets_[first].points;
        Measurement m{.analyzer = analyzer.name,
                      .source = full_title(sets_[first]),
                      .count = points.count(),
                      .dimension = points.dimension(),
                      .domain = points.domain->spec()};
        take_mean(m, average, singles, analyzer, options);
        return m;
    }

    /// Whether each set of points has a frame of its own.
    [[nodiscard]] bool has_frames() const {
        return sets_.size() > 1 && chart_ != "histogram" && chart_ != "distances" &&
               !request_.overlay && std::ranges::any_of(sets_, [](const Loaded& set) {
                   return set.points.dimension() > 1;
               });
    }

    void require_one_dimension() const {
        for (const Loaded& set : sets_)
            if (set.points.dimension() != sets_[0].points.dimension())
                fail(ErrorKind::input,
                     "points of {} and of {} coordinates are not drawn in one frame",
                     sets_[0].points.dimension(), set.points.dimension());
    }

    void keep_few_sets(std::size_t most) {
        if (sets_.size() > most) {
            session_.warn(fmt::format("the first {} of {} sets are drawn; --set picks one", most,
                                      sets_.size()));
            sets_.resize(most);
        }
    }

    plot::PointsPicture points_picture() {
        const std::size_t d = sets_[0].points.dimension();
        if (d > plot::most_pair_coordinates && chart_ != "histogram")
            session_.warn(
                fmt::format("the first {} of {} coordinates are drawn; --column picks "
                            "others",
                            plot::most_pair_coordinates, d));
        plot::PointsPicture picture{.sets = {}, .names = names(), .title = {}};
        for (const Loaded& set : sets_) picture.sets.push_back(&set.points);
        if (chart_ == "points") picture.marking = plot::Marking::disks;
        if (chart_ == "density") picture.marking = plot::Marking::density;
        picture.pairs = chart_ == "pairs";
        picture.units = sets_[0].units;
        for (std::size_t k = 0; k < d; ++k) picture.log.push_back(is_log(k, picture.sets));
        picture.title = sets_[0].title;
        if (sets_.size() > 1 && different_titles()) picture.title = join(picture.names, ", ");
        picture.subtitle = subtitle_of(sets_[0]) + number_of(sets_[0]);
        if (sets_.size() > 1) picture.subtitle.clear();
        return picture;
    }

    /// Whether a coordinate has a logarithmic axis: by --x-scale or --y-scale or, if these are not
    /// given or do not apply, because it is a parameter on a log scale.
    [[nodiscard]] bool is_log(std::size_t k, std::span<const PointSet* const> sets) const {
        const bool histogram = chart_ == "histogram" || sets[0]->dimension() == 1;
        if (histogram && style_.log_x) return *style_.log_x;
        const bool plane = sets[0]->dimension() == 2 && !histogram;
        const std::optional<bool>& option = k == 0 ? style_.log_x : style_.log_y;
        const bool given = plane && option.has_value();
        if (!(given ? *option : sets_[0].log[k])) return false;
        if (plot::is_positive(sets, k)) return true;
        if (given)
            fail(ErrorKind::input,
                 "--{}-scale: a logarithmic axis cannot show this coordinate, which is not "
                 "positive everywhere",
                 k == 0 ? "x" : "y");
        return false;
    }

    [[nodiscard]] bool different_titles() const {
        return std::ranges::any_of(sets_,
                                   [&](const Loaded& set) { return set.title != sets_[0].title; });
    }

    [[nodiscard]] std::vector<std::string> names() const {
        const bool different = different_titles() || !labels_.empty();
        std::vector<std::string> found;
        for (const Loaded& set : sets_) {
            std::string name = different ? set.title : "";
            if (set.number) name += fmt::format("{}set {}", name.empty() ? "" : ", ", *set.number);
            found.push_back(name.empty() ? set.source : name);
        }
        return found;
    }

    // ---------------------------------------------------------------- provenance

    /// Metadata of the picture: version, command, and the provenance of a single generated set.
    [[nodiscard]] plot::PictureNotes notes_of() const {
        Json note = {{"tool", "stipple"},
                     {"version", STIPPLE_VERSION},
                     {"command", command_text(request_, {}, seed_)}};
        if (sets_.size() == 1 && !sets_[0].points.provenance.generator.empty())
            note["meta"] = io::to_json(sets_[0].points.provenance);
        return {{"Software", fmt::format("stipple {}", STIPPLE_VERSION)},
                {"stipple", json_text(note)}};
    }

    const PlotRequest& request_;
    Session& session_;
    std::string path_;
    Medium medium_;
    const std::string& chart_;
    const Analyzer* charted_ = nullptr;  ///< analyzer whose results --chart shows
    std::string grid_title_;             ///< title if the results are a grid; empty for a curve
    const std::vector<std::string>& labels_;
    const std::vector<std::string>& axes_;
    plot::PictureStyle style_;
    plot::TextRoom room_;
    std::vector<Loaded> sets_;
    std::vector<Measurement> reports_;
    std::vector<MeanRow> means_;
    std::size_t studies_ = 0;
    std::string first_study_;  ///< file of the first study
    std::vector<plot::Frame> frames_;
    std::uint64_t seed_ = 1;  ///< seed of --generate
};

}  // namespace

int PlotRequest::perform(Session& session) const { return Plot(*this, session).go(); }

}  // namespace stipple::cli
