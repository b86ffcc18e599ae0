// SPDX-License-Identifier: MIT
//
// stipple._stipple: the library's functions, wrapped by the Python package stipple. Points arrive
// as arrays (n, d) that the package has checked, settings as pairs of texts, domains as specs.
#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/json.hpp"
#include "core/spec.hpp"
#include "core/text.hpp"
#include "io/columns.hpp"
#include "io/provenance.hpp"
#include "page/experiment.hpp"
#include "pipeline/chain.hpp"
#include "pipeline/domains.hpp"
#include "pipeline/generated.hpp"
#include "pipeline/pipeline.hpp"
#include "pipeline/units.hpp"
#include "pipeline/warping.hpp"
#include "plot/points_picture.hpp"
#include "plot/report_charts.hpp"
#include "plot/study_chart.hpp"
#include "python/conversion.hpp"
#include "python/run.hpp"
#include "report/catalog.hpp"
#include "report/document.hpp"
#include "stipple/stipple.hpp"

namespace stipple::python {

/// A message as a text: names of files may have bytes that are not UTF-8.
static py::str readable(const std::string& message) {
    return py::reinterpret_steal<py::str>(PyUnicode_DecodeUTF8(
        message.data(), static_cast<Py_ssize_t>(message.size()), "backslashreplace"));
}

void show(const std::vector<std::string>& notes) {
    if (notes.empty()) return;
    const py::module_ errors = py::module_::import("stipple._errors");
    for (const std::string& sentence : notes) {
        const py::str text = errors.attr("in_python")(readable(sentence));
        if (PyErr_WarnEx(errors.attr("Note").ptr(), std::string(text).c_str(), 2) != 0)
            throw py::error_already_set();
    }
}

namespace {

using Given = std::tuple<Array, std::string, std::string>;  ///< rows, domain, provenance as JSON

/// Returns a set with its provenance. If `table`, the rows are not points of a domain, and
/// provenance and domain are those of their inputs. Warns of column names that are replaced.
PointSet set_of(const Given& given, bool table = false) {
    const auto& [rows, domain, meta] = given;
    PointSet points = points_of(rows, table ? "unit-cube" : domain);
    const Json known = meta.empty() ? Json::object() : parse_json(meta);
    points.provenance = io::provenance_from(known);
    points.provenance.domain = domain;
    const Json columns = known.value("columns", Json());
    if (columns.is_array() && std::ranges::all_of(columns, &Json::is_string)) {
        auto names = columns.get<std::vector<std::string>>();
        show(io::replace_names(names, table));
        points.provenance.columns = io::kept_names(std::move(names));
    }
    if (table) return points;
    points.provenance.count = points.count();
    points.provenance.dimension = points.dimension();
    complete(points.provenance);
    return points;
}

/// Provenance and domain of a set as a dictionary.
py::dict meta_of(const PointSet& set) {
    auto meta = object_of(io::to_json(set.provenance)).cast<py::dict>();
    if (set.domain) meta["domain"] = set.domain->spec();
    return meta;
}

Spec spec_of(const std::string& text, const Settings& settings) {
    Spec spec = parse_spec(text);
    spec.settings.insert(spec.settings.end(), settings.begin(), settings.end());
    return spec;
}

/// Arguments of generate().
struct Asked {
    std::string generator;
    Settings settings;
    std::optional<std::uint64_t> count;
    std::optional<std::size_t> dimension;
    std::uint64_t seed;
    std::uint64_t start;
    std::uint64_t sets;
    std::string bounds;  ///< empty: the unit cube
    std::vector<std::string> warps;
};

SetsToMake to_make(const Asked& asked) {
    const Spec spec = spec_of(asked.generator, asked.settings);
    const Generator& generator = find_generator(spec.name);
    SetsToMake make{.generator = &generator,
                    .options = spec.values(generator.options),
                    .request = {.count = asked.count,
                                .dimension = asked.dimension,
                                .start = asked.start,
                                .seed = asked.seed},
                    .sets = asked.sets};
    for (const std::string& warp : asked.warps) make.warps.push_back(parse_spec(warp));
    if (!asked.bounds.empty())
        make.request.bounds =
            parse_box(asked.bounds, plan_for(generator, make.request, make.options).dimension);
    make.command = command_of(make);
    return make;
}

/// Returns the points, and their provenance if requested.
py::tuple generate(const Asked& asked, bool with_meta, const How& how) {
    auto sets = released(how, [&](const RunContext& run) {
        const GeneratedSets made(to_make(asked), run);
        const double numbers =
            static_cast<double>(made.plan().count) * static_cast<double>(made.dimension());
        run.need_memory(static_cast<double>(asked.sets) * (sizeof(PointSet) + 8 * numbers),
                        asked.sets == 1 ? "the point set" : "the array of all sets");
        std::vector<PointSet> all;
        for (std::uint64_t set = 0; set < made.sets(); ++set) all.push_back(made.made(set, run));
        return all;
    });
    py::list meta;
    for (const PointSet& set : sets)
        if (with_meta) meta.append(object_of(io::to_json(set.provenance)));
    py::object points =
        asked.sets == 1 ? py::object(array_of(std::move(sets[0]))) : arrays_of(std::move(sets));
    return py::make_tuple(points, meta);
}

/// Returns the images or, if `back`, the preimages of points, and their provenance.
py::tuple warp(const std::string& text, const Settings& settings, const Given& given, bool back,
               const How& how) {
    const Spec spec = spec_of(text, settings);
    PointSet image = released(how, [&, points = set_of(given)](const RunContext& run) {
        return warped_set(points, spec, back, run);
    });
    const py::dict meta = meta_of(image);
    return py::make_tuple(array_of(std::move(image)), meta);
}

/// Domain of some columns of points; empty if they depend on other columns, so that it is unknown.
std::string domain_of_columns(const std::string& domain, std::size_t dimension,
                              const std::vector<std::size_t>& columns) {
    std::vector<Factor> kept;
    for (Factor& factor : warped_factors(parse_domain(domain, dimension))) {
        std::vector<std::size_t> places;
        for (const std::size_t coordinate : factor.coordinates)
            if (const auto at = std::ranges::find(columns, coordinate); at != columns.end())
                places.push_back(static_cast<std::size_t>(at - columns.begin()));
        if (places.empty()) continue;
        if (places.size() < factor.coordinates.size()) return {};
        kept.push_back({std::move(factor.domain), std::move(places)});
    }
    return filled_up(std::move(kept), columns.size())->spec();
}

/// Names of a domain's coordinates, None for those without a name, and their levels. A domain with
/// a single factor returns that factor's names, even if their number is not `dimension`.
py::tuple names_of_domain(const std::string& text, std::size_t dimension) {
    std::vector<std::optional<std::string>> names(dimension);
    py::dict levels;
    for (const auto& [domain, coordinates] : parse_factors(text, dimension)) {
        const auto own = domain->names();
        const bool whole = coordinates == all_coordinates(dimension);
        if (whole) names.assign(own.begin(), own.end());
        for (std::size_t k = 0; k < std::min(own.size(), coordinates.size()) && !whole; ++k)
            if (coordinates[k] < dimension) names[coordinates[k]] = own[k];
        for (const auto& [name, words] : domain->levels()) levels[py::str(name)] = words;
    }
    return py::make_tuple(names, levels);
}

/// The spec and the dimension of the domain that a parameter file describes.
std::pair<std::string, std::size_t> parameters(const std::string& path) {
    const DomainPtr domain = read_parameters(path);
    return {domain->spec(), domain->dimension()};
}

/// A chain of this warp alone, for images with `images` numbers per row.
WarpChain chain_to(const Spec& spec, std::size_t images) {
    const Warp& unit = find_warp(spec.name);
    const std::size_t given = spec.coordinates.empty() ? images : spec.coordinates.size();
    const auto mapping = unit.make(spec.values(unit.options), given, {});
    return {{&spec, 1}, images + mapping->cube_dimension() - mapping->domain()->dimension()};
}

std::string domain_of_images(const std::string& text, const Settings& settings,
                             std::size_t images) {
    return chain_to(spec_of(text, settings), images).domain()->spec();
}

py::array scramble(const std::string& text, const Settings& settings, const Array& rows,
                   const std::string& meta, std::uint64_t seed, std::uint64_t start,
                   const How& how) {
    const Spec spec = spec_of(text, settings);
    if (scramble_named(spec.name) == nullptr) refuse_unit("scramble", spec.name);
    std::vector<std::uint32_t> bases;
    if (!meta.empty()) bases = digit_bases(io::provenance_from(parse_json(meta)));
    return array_of(released(how, [&,
                                   points = points_of(rows, "unit-cube")](const RunContext& run) {
        const WarpChain chain({&spec, 1}, points.dimension(),
                              {.seed = seed, .count = start + points.count(), .bases = bases}, run);
        return image_of(points, chain, run, start);
    }));
}

py::array column(std::vector<double> values) {
    return array_of({std::move(values), 1}).attr("reshape")(-1).cast<py::array>();
}

/// Density of the warp's images, at each row.
py::array warp_density(const std::string& text, const Settings& settings, const Array& rows) {
    const PointSet points = points_of(rows, "unit-cube");
    return column(chain_to(spec_of(text, settings), points.dimension()).density(points.flat()));
}

/// Density of each point: according to the biased warps that made it, if any, or to its domain.
py::array density(const Given& given) {
    const PointSet points = set_of(given);
    auto biased = biased_densities(points, {});
    return column(biased.empty() ? densities(points) : std::move(biased));
}

/// Returns results, their text, unmet expectations, and the record that report_chart() takes.
py::tuple analyze(const std::string& text, const Settings& settings, const Given& given,
                  const How& how) {
    const Analyzer& analyzer = find_analyzer(parse_spec(text).name);
    PointSet points = set_of(given, analyzer.traits.table);
    Measurement found = {};
    found.source = "points";
    found.count = points.count();
    found.dimension = points.dimension();
    found.domain = points.provenance.domain;
    found.columns = points.provenance.columns;
    found.results = released(how, [&, points = std::move(points)](const RunContext& run) {
        return stipple::analyze(text, points, settings, run);
    });
    found.analyzer = analyzer.name;
    return py::make_tuple(
        dict_of(found.results), to_text({&found, 1}), found.results.unmet(),
        py::make_tuple(found.analyzer, found.count, found.dimension, found.domain));
}

py::list read(const std::string& path, const std::string& format, std::size_t dimension,
              bool single, const How& how) {
    auto sets = released(how, [&](const RunContext& run) {
        return read_sets(path, {.format = format, .dimension = dimension, .single = single}, run);
    });
    py::list all;
    for (PointSet& set : sets) {
        const py::dict meta = meta_of(set);
        all.append(py::make_tuple(array_of(std::move(set)), meta));
    }
    return all;
}

void write_points(const std::string& path, const std::vector<Given>& given,
                  const std::string& format, bool header, bool meta, bool single,
                  std::optional<int> precision, const How& how) {
    std::vector<PointSet> sets;
    for (const Given& one : given) sets.push_back(set_of(one));
    released(how, [&](const RunContext& run) {
        write(path, sets,
              {.format = format,
               .header = header,
               .meta = meta,
               .single = single,
               .precision = precision},
              run);
        return true;
    });
}

py::list study(const std::vector<std::string>& generators,
               const std::vector<std::string>& analyzers, const std::vector<std::string>& warps,
               const std::vector<std::uint64_t>& counts,
               const std::vector<std::uint64_t>& dimensions, std::uint64_t first_seed,
               std::uint64_t seeds, const std::vector<std::string>& keys, const How& how) {
    const auto values = released(how, [&](const RunContext& run) {
        return stipple::study({.generators = generators,
                               .analyzers = analyzers,
                               .warps = warps,
                               .counts = counts,
                               .dimensions = dimensions,
                               .first_seed = first_seed,
                               .seeds = seeds,
                               .keys = keys},
                              run);
    });
    py::list rows;
    for (const StudyValue& v : values)
        rows.append(py::make_tuple(v.generator, v.analyzer, v.dimension, v.count, v.seed, v.key,
                                   v.value ? py::object(py::float_(*v.value)) : py::none(),
                                   v.failure));
    return rows;
}

using StudyRow = std::tuple<std::string, std::string, std::uint64_t, std::uint64_t, std::uint64_t,
                            std::string, std::optional<double>, std::string>;

std::vector<StudyValue> values_of(const std::vector<StudyRow>& rows) {
    std::vector<StudyValue> values;
    for (const auto& [generator, analyzer, dimension, count, seed, key, value, failure] : rows)
        values.push_back({generator, analyzer, dimension, count, seed, key, value, failure});
    return values;
}

py::list means(const std::vector<StudyRow>& rows, double confidence) {
    py::list all;
    for (const StudyMean& m : means_of(values_of(rows), confidence))
        all.append(py::make_tuple(m.generator, m.analyzer, m.dimension, m.count, m.key, m.sets,
                                  m.mean, m.low, m.high, m.rms));
    return all;
}

void report(const std::string& path, const std::vector<std::pair<std::string, Given>>& given,
            const How& how) {
    std::vector<NamedSet> sets;
    for (const auto& [name, set] : given) sets.push_back({name, set_of(set)});
    released(how, [&](const RunContext& run) {
        write_report(path, sets, run);
        return true;
    });
}

plot::Drawing picture(const std::vector<std::pair<std::string, Given>>& given, double width,
                      double height, const std::optional<std::string>& title, const How& how) {
    std::vector<PointSet> sets;
    for (const auto& [name, set] : given) sets.push_back(set_of(set));
    plot::PointsPicture picture;
    for (std::size_t i = 0; i < sets.size(); ++i) {
        picture.sets.push_back(&sets[i]);
        picture.names.push_back(given[i].first);
    }
    picture.log = page::log_axes(sets[0]);
    picture.units = page::units_of(sets[0]);
    for (std::size_t k = 0; k < picture.log.size(); ++k)
        picture.log[k] = picture.log[k] && plot::is_positive(picture.sets, k);
    return released(how, [&](const RunContext& run) {
        const plot::PictureStyle style{.width = width, .height = height, .title = title};
        return plot::draw_points(picture, style, run);
    });
}

/// A report: name, the record made by analyze(), and results.
using Reported =
    std::tuple<std::string, std::tuple<std::string, std::uint64_t, std::size_t, std::string>,
               py::dict>;

plot::Chart report_chart(const std::vector<Reported>& reported, const std::string& key) {
    std::vector<Measurement> reports;
    for (const auto& [name, record, results] : reported) {
        const auto& [analyzer, count, dimension, domain] = record;
        reports.push_back({.analyzer = analyzer,
                           .source = name,
                           .count = count,
                           .dimension = dimension,
                           .domain = domain,
                           .results = report_of(results)});
    }
    return plot::chart_of(reports, key);
}

plot::Chart study_chart(const std::vector<StudyRow>& rows, const std::string& key) {
    plot::StudyChart found =
        plot::study_chart(summary_of(values_of(rows)).mean_rows({.resamples = 0}, {}), key);
    if (!found.left_out.empty())
        show({"not drawn: " + join(found.left_out, ", ") + "; key selects one result"});
    return std::move(found.chart);
}

plot::Drawing drawing_of(const plot::Chart& chart, double width, double height,
                         const std::optional<std::string>& title) {
    return plot::draw_chart(chart, {.width = width, .height = height, .title = title});
}

/// The content of a chart's panels: each curve has its name, x, y, and the limits of its band.
py::list panels_of(const plot::Chart& chart) {
    const auto curves = [](const std::vector<plot::Series>& all) {
        py::list found;
        for (const auto& s : all) found.append(py::make_tuple(s.name, s.x, s.y, s.low, s.high));
        return found;
    };
    py::list panels;
    for (const plot::ChartPanel& panel : chart.panels) {
        py::dict all;
        all["names"] = py::make_tuple(panel.x_name, panel.y_name);
        all["logs"] = py::make_tuple(panel.log_x, panel.log_y);
        all["series"] = curves(panel.series);
        all["bands"] = curves(panel.bands);
        py::list guides, bars;
        for (const auto& g : panel.guides) guides.append(py::make_tuple(g.name, g.x, g.y));
        for (const auto& b : panel.bars) bars.append(py::make_tuple(b.name, b.edges, b.heights));
        all["guides"] = guides;
        all["bars"] = bars;
        all["categories"] = panel.categories;
        panels.append(all);
    }
    return panels;
}

/// Encodes a drawing in the format, at the size that `stipple plot` uses.
py::bytes picture_bytes(const plot::Drawing& drawing, const std::string& format) {
    if (format == "png") return plot::png_bytes_of(drawing, 2);
    if (format == "pdf") return plot::pdf_bytes(drawing, 1);
    return plot::svg_bytes(drawing, 1);
}

/// Random access to the points of a sequence.
class Indexed {
  public:
    Indexed(const std::string& text, const Settings& settings, std::optional<std::size_t> d,
            std::uint64_t seed) {
        const Spec spec = spec_of(text, settings);
        const Generator& generator = find_generator(spec.name);
        const std::string whole =
            format_spec(generator.name, spec.values(generator.options), generator.options);
        sampler_ = std::make_unique<Sampler>(whole, Request{.dimension = d, .seed = seed});
        if (!generator.traits.prefix)
            fail(ErrorKind::usage, "{} is not a sequence: its points depend on the count",
                 generator.name);
    }

    [[nodiscard]] std::size_t dimension() const { return sampler_->dimension(); }

    [[nodiscard]] py::array part(std::uint64_t first, std::uint64_t count, const How& how) const {
        const std::size_t d = dimension();
        return array_of(released(how, [&](const RunContext& run) {
            run.need_memory(8 * static_cast<double>(count) * static_cast<double>(d),
                            "holding the points");
            PointSet points(Rows::unwritten(count, d), d);
            constexpr std::uint64_t some = 65'536;
            for (std::uint64_t i = 0; i < count; i += some) {
                run.check_stop();
                const std::uint64_t rows = std::min(some, count - i);
                sampler_->fill(first + i, points.flat().subspan(i * d, rows * d));
            }
            return points;
        }));
    }

  private:
    std::unique_ptr<Sampler> sampler_;
};

const char* word_of(ErrorKind kind) {
    switch (kind) {
        case ErrorKind::usage:
            return "usage";
        case ErrorKind::input:
            return "input";
        case ErrorKind::io:
            return "io";
        case ErrorKind::limit:
            return "limit";
        default:
            return "cancelled";
    }
}

void translate(std::exception_ptr thrown) {
    try {
        if (thrown) std::rethrow_exception(thrown);
    } catch (const Error& e) {
        const py::object type = py::module_::import("stipple._errors").attr("Error");
        const py::object error = type(readable(e.what()), word_of(e.kind()), readable(e.hint()));
        PyErr_SetObject(type.ptr(), error.ptr());
    } catch (const std::bad_alloc&) {
        translate(std::make_exception_ptr(Error(ErrorKind::limit, "there is not enough memory")));
    }
}

}  // namespace
}  // namespace stipple::python

PYBIND11_MODULE(_stipple, module) {
    namespace python = stipple::python;
    namespace py = pybind11;
    using python::How;
    py::register_exception_translator(python::translate);

    py::class_<stipple::plot::Chart>(module, "Chart")
        .def("panels", python::panels_of)
        .def("drawing", python::drawing_of);
    py::class_<stipple::plot::Drawing>(module, "Drawing").def("bytes", python::picture_bytes);
    py::class_<How>(module, "How")
        .def(py::init([](unsigned threads, double max_memory, py::object progress) {
            return How{threads, max_memory, std::move(progress)};
        }));
    py::class_<python::Asked>(module, "Asked")
        .def(py::init([](std::string generator, stipple::Settings settings,
                         std::optional<std::uint64_t> count, std::optional<std::size_t> dimension,
                         std::uint64_t seed, std::uint64_t start, std::uint64_t sets,
                         std::string bounds, std::vector<std::string> warps) {
            return python::Asked{
                std::move(generator), std::move(settings), count, dimension, seed, start, sets,
                std::move(bounds),    std::move(warps)};
        }));
    module.attr("version") = STIPPLE_VERSION;
    module.def("records", [] { return python::object_of(stipple::json_of(stipple::catalog())); });
    module.def("generate", python::generate);
    module.def("warp", python::warp);
    module.def("domain_of_images", python::domain_of_images);
    module.def("domain_of_columns", python::domain_of_columns);
    module.def("names_of_domain", python::names_of_domain);
    module.def("log_axes", [](const python::Given& given) {
        return stipple::page::log_axes(python::set_of(given));
    });
    module.def("is_word", stipple::io::is_word);
    module.def("parameters", python::parameters);
    module.def("scramble", python::scramble);
    module.def("warp_density", python::warp_density);
    module.def("density", python::density);
    module.def("takes_table", [](const std::string& spec) {
        return stipple::find_analyzer(stipple::parse_spec(spec).name).traits.table;
    });
    module.def("analyze", python::analyze);
    module.def("report_chart", python::report_chart);
    module.def("study_chart", python::study_chart);
    module.def("read", python::read);
    module.def("write", python::write_points);
    module.def("study", python::study);
    module.def("means", python::means);
    module.def("report", python::report);
    module.def("picture", python::picture);
    py::class_<python::Indexed>(module, "Indexed")
        .def(py::init<const std::string&, const stipple::Settings&, std::optional<std::size_t>,
                      std::uint64_t>())
        .def_property_readonly("dimension", &python::Indexed::dimension)
        .def("part", &python::Indexed::part);
}
