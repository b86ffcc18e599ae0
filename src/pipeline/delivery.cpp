// SPDX-License-Identifier: MIT
#include "pipeline/delivery.hpp"

#include <oneapi/tbb/parallel_pipeline.h>

#include <algorithm>
#include <atomic>
#include <list>
#include <memory>
#include <mutex>
#include <unordered_map>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "io/carried_meta.hpp"
#include "io/files.hpp"

namespace stipple {
namespace {

std::vector<double> travel(std::vector<double> rows, const WarpChain& chain, std::uint64_t first,
                           const Route& route) {
    if (route.inverse) return chain.inverse(std::move(rows));
    if (route.bounds) scale_into(*route.bounds, rows);
    rows = chain.forward(std::move(rows), first);
    return route.columns.any() ? with_columns(rows, chain, route) : std::move(rows);
}

/// A block of rows and, later, of bytes.
struct Parcel {
    std::uint64_t first = 0;
    std::uint64_t last = 0;
    std::vector<double> rows;
    std::string bytes;
};

/// The rows of one set through fill, warps and format into the output.
class Conveyor {
  public:
    Conveyor(const Source& source, const Route& route, const Layout& layout, const Format& format,
             std::size_t set, io::Output& output, const RunContext& run)
        : source_(source),
          route_(route),
          layout_(layout),
          format_(format),
          set_(set),
          output_(output),
          run_(run),
          block_(std::max<std::uint64_t>(1, 16384 / source.dimension)) {}

    /// False: the pipe was closed.
    bool go() {
        if (run_.thread_count() == 1 || (source_.count <= block_ && !source_.read))
            go_alone();
        else
            within_threads(run_, [this] { go_parallel(); });
        if (source_.read && !closed_ && !route_.inverse)
            tell_kept(at_, rows_out_, *source_.chain, run_);
        return !closed_;
    }

  private:
    /// The next block in a free parcel; nullptr at the end. Called by one thread at a time.
    Parcel* next() {
        if (closed_ || (at_ == source_.count && !source_.read)) return nullptr;
        run_.check_stop();
        Parcel& parcel = take();
        parcel.first = at_;
        if (source_.read) return read(parcel) ? &parcel : nullptr;
        parcel.last = at_ = at_ + std::min(source_.count - at_, block_);
        parcel.bytes.clear();
        if (source_.in_order) fill(parcel);
        return &parcel;
    }

    /// False: all rows were read.
    bool read(Parcel& parcel) {
        parcel.rows.resize(block_ * source_.dimension);
        const std::size_t count = source_.read(parcel.rows);
        parcel.rows.resize(count * source_.dimension);
        parcel.last = at_ += count;
        parcel.bytes.clear();
        return count > 0;
    }

    /// Parcels are owned here and used again: a pipeline that is stopped drops what it holds.
    Parcel& take() {
        const std::lock_guard lock(mutex_);
        if (free_.empty()) {
            parcels_.push_back(std::make_unique<Parcel>());
            return *parcels_.back();
        }
        Parcel* parcel = free_.back();
        free_.pop_back();
        return *parcel;
    }

    void fill(Parcel& parcel) const {
        parcel.rows.resize((parcel.last - parcel.first) * source_.dimension);
        source_.fill(parcel.first, parcel.rows);
    }

    void work(Parcel& parcel) const {
        if (!source_.in_order && !source_.read) fill(parcel);
        parcel.rows =
            travel(std::move(parcel.rows), *source_.chain, source_.first + parcel.first, route_);
        format_.rows(layout_, set_, parcel.first, parcel.rows, parcel.bytes);
    }

    void deliver(Parcel& parcel) {
        if (!closed_ && !output_.write(parcel.bytes)) closed_ = true;
        rows_out_ += parcel.rows.size() / layout_.width();
        if (!source_.read) run_.tick(parcel.last, source_.count);
        const std::lock_guard lock(mutex_);
        free_.push_back(&parcel);
    }

    void go_alone() {
        while (Parcel* parcel = next()) {
            work(*parcel);
            deliver(*parcel);
        }
    }

    void go_parallel() {
        const auto first = tbb::make_filter<void, Parcel*>(tbb::filter_mode::serial_in_order,
                                                           [this](tbb::flow_control& control) {
                                                               Parcel* parcel = next();
                                                               if (!parcel) control.stop();
                                                               return parcel;
                                                           });
        const auto middle =
            tbb::make_filter<Parcel*, Parcel*>(tbb::filter_mode::parallel, [this](Parcel* parcel) {
                work(*parcel);
                return parcel;
            });
        const auto last = tbb::make_filter<Parcel*, void>(
            tbb::filter_mode::serial_in_order, [this](Parcel* parcel) { deliver(*parcel); });
        tbb::parallel_pipeline(4 * static_cast<std::size_t>(run_.thread_count()),
                               first & middle & last);
    }

    const Source& source_;
    const Route& route_;
    const Layout& layout_;
    const Format& format_;
    std::size_t set_;
    io::Output& output_;
    const RunContext& run_;
    std::uint64_t block_;
    std::uint64_t at_ = 0;
    std::uint64_t rows_out_ = 0;
    std::atomic<bool> closed_ = false;
    std::mutex mutex_;
    std::vector<std::unique_ptr<Parcel>> parcels_;
    std::vector<Parcel*> free_;
};

std::string span_text(std::size_t low, std::size_t high) {
    return low == high ? std::to_string(low) : fmt::format("{} to {}", low, high);
}

void check_format(const Format& format, const Layout& layout) {
    const auto& traits = format.traits;
    const std::size_t d = layout.dimension;
    if (d < traits.min_dimension || d > traits.max_dimension)
        fail(ErrorKind::usage, "--format: {} holds points of dimension {}; these have {}",
             format.name, span_text(traits.min_dimension, traits.max_dimension), d);
    if (!traits.many_sets && layout.counts.size() > 1)
        fail_with_hint(ErrorKind::usage, "write a file for each set: -o 'NAME_{set}...'",
                       "--format: {} holds one set; there are {}", format.name,
                       layout.counts.size());
    const bool equal = std::ranges::all_of(
        layout.counts, [&](auto count) { return count == layout.counts.front(); });
    if (traits.equal_sets && !equal)
        fail_with_hint(ErrorKind::usage, "write a file for each set: -o 'NAME_{set}...'",
                       "--format: {} holds sets of equal size only; these are not", format.name);
}

Layout layout_of(const Shipment& shipment, std::size_t first, std::size_t last,
                 const Target& target) {
    Layout layout{.dimension = shipment.dimension,
                  .header = target.header,
                  .meta = target.meta,
                  .single = target.single,
                  .precision = target.precision,
                  .provenance = shipment.provenance(first),
                  .extent = shipment.extent(first)};
    Provenance& meta = layout.provenance;
    if (target.precision && !target.format->traits.binary)
        meta.precision = std::min(meta.precision.value_or(*target.precision), *target.precision);
    meta.single |= target.single && target.format->traits.binary;
    layout.extras = target.columns.names();
    for (std::size_t set = first; set < last; ++set) layout.counts.push_back(shipment.counts[set]);
    return layout;
}

/// One file with sets [first, last) of the shipment.
bool ship_points(const Shipment& shipment, std::size_t first, std::size_t last,
                 const std::string& path, const Target& target, const RunContext& run) {
    const Format& format = *target.format;
    const Layout layout = layout_of(shipment, first, last, target);
    check_format(format, layout);
    // What is wrong with the first source shall be known before anything is written.
    RunContext part = lane(run, first, shipment.sets).rising();
    Source source = shipment.source(first, part);
    io::Output output = target.sink ? io::Output(target.sink) : io::Output(path, run.stop);
    std::string bytes;
    if (format.head) format.head(layout, bytes);
    for (std::size_t set = first; set < last; ++set) {
        if (set > first) {
            part = lane(run, set, shipment.sets).rising();
            source = shipment.source(set, part);
        }
        if (format.begin_set) format.begin_set(layout, set - first, bytes);
        if (!output.write(bytes)) return false;
        bytes.clear();
        Conveyor conveyor(source, shipment.route, layout, format, set - first, output, part);
        if (!conveyor.go()) return false;
    }
    if (format.tail) format.tail(layout, bytes);
    if (!output.write(bytes)) return false;
    output.commit();
    return true;
}

/// What comes with sets [first, last), written but not yet in its place.
std::list<io::Output> side_files(const Shipment& shipment, std::size_t first, std::size_t last,
                                 const RunContext& run) {
    std::list<io::Output> outputs;
    for (std::size_t set = first; set < last && shipment.side_files; ++set)
        for (const SideFile& file : shipment.side_files(set))
            outputs.emplace_back(file.path, run.stop).write(file.bytes);
    return outputs;
}

/// Provenance in a file beside the points, where the format has no place for it.
void put_meta_beside(const Shipment& shipment, std::size_t first, std::size_t last,
                     const std::string& path, const Target& target, const RunContext& run,
                     std::list<io::Output>& outputs) {
    if (!target.meta || !target.format->traits.meta_beside || target.sink) return;
    if (path == "-" || path.starts_with("/dev/")) {
        run.tell(fmt::format("--meta: {} has no place for provenance, and {} none beside it",
                             target.format->name, path == "-" ? "standard output" : path));
        return;
    }
    const Layout layout = layout_of(shipment, first, last, target);
    outputs.emplace_back(io::meta_path(path), run.stop)
        .write(io::to_text(
                   {target.format->name, layout.width(), layout.counts.size(), layout.provenance}) +
               "\n");
}

/// @throws Error(usage) where two sets would be one file
std::vector<std::string> paths_of_sets(const Shipment& shipment, const Target& target) {
    std::vector<std::string> paths;
    std::unordered_map<std::string, std::size_t> taken;
    for (std::size_t set = 0; set < shipment.sets; ++set) {
        const std::uint64_t seed =
            shipment.first_seed ? *shipment.first_seed + set : shipment.provenance(set).seed;
        paths.push_back(path_of_set(target.path, shipment.first_set + set, seed));
        const auto [there, is_new] = taken.try_emplace(paths.back(), set);
        if (!is_new)
            fail_with_hint(ErrorKind::usage, "use {set}",
                           "--output: sets {} and {} both have the seed {}, and would be one file",
                           shipment.first_set + there->second, shipment.first_set + set, seed);
    }
    return paths;
}

/// The points and what comes with them: all of it or, when it fails, nothing. Who closes the pipe
/// has seen enough of the points, but did not say so of the other files.
bool ship_file(const Shipment& shipment, std::size_t first, std::size_t last,
               const std::string& path, const Target& target, const RunContext& run) {
    auto beside = side_files(shipment, first, last, run);
    put_meta_beside(shipment, first, last, path, target, run, beside);
    const bool whole = ship_points(shipment, first, last, path, target, run);
    for (io::Output& file : beside) file.commit();
    return whole;
}

}  // namespace

bool file_per_set(const std::string& path) {
    return path.find("{set}") != std::string::npos || path.find("{seed}") != std::string::npos;
}

std::string path_of_set(std::string path, std::size_t set, std::uint64_t seed) {
    replace_all(path, "{set}", std::to_string(set));
    replace_all(path, "{seed}", std::to_string(seed));
    return path;
}

bool ship(const Shipment& shipment, const Target& target, const RunContext& run) {
    if (!file_per_set(target.path))
        return ship_file(shipment, 0, shipment.sets, target.path, target, run);
    const auto paths = paths_of_sets(shipment, target);
    for (std::size_t set = 0; set < shipment.sets; ++set)
        if (!ship_file(shipment, set, set + 1, paths[set], target, run)) return false;
    return true;
}

RunContext lane(const RunContext& run, std::size_t set, std::size_t sets) {
    const auto all = static_cast<double>(sets);
    return run.stage(static_cast<double>(set) / all, static_cast<double>(set + 1) / all);
}

void tell_kept(std::uint64_t count, std::uint64_t kept, const WarpChain& chain,
               const RunContext& run) {
    if (chain.drops() && kept < count)
        run.tell(
            fmt::format("kept {} of {} points (efficiency {:.3g}): the others have no image "
                        "under {}",
                        kept, count, static_cast<double>(kept) / static_cast<double>(count),
                        join(chain.specs(), ", ")));
    if (kept == 0)
        fail(ErrorKind::input, "none of {} points has an image under {}", count,
             join(chain.specs(), ", "));
}

std::vector<std::string> Columns::names() const {
    std::vector<std::string> names;
    if (pdf) names.emplace_back("pdf");
    if (weight) names.emplace_back("weight");
    return names;
}

/// Files hold no infinite numbers: no reader would take them.
static double finite(const char* column, double value, std::span<const double> point,
                     const Route& route) {
    if (std::isfinite(value)) return value;
    std::vector<std::string> words;
    for (const double x : point) words.push_back(format_number(x));
    fail_with_hint(ErrorKind::input,
                   route.starts
                       ? "--start 1 leaves out a sequence's first point, where coordinates are 0"
                       : "",
                   "--with-{}: it is infinite at the point ({})", column, join(words, ", "));
}

std::vector<double> with_columns(std::span<const double> rows, const WarpChain& chain,
                                 const Route& route) {
    const std::size_t d = chain.dimension_out();
    const auto density = chain.density(rows);
    std::vector<double> wide;
    wide.reserve(rows.size() + 2 * density.size());
    for (std::size_t i = 0; i < density.size(); ++i) {
        const auto row = rows.subspan(i * d, d);
        wide.insert(wide.end(), row.begin(), row.end());
        const double pdf = density[i] / route.volume;
        const double weight = route.volume / density[i];
        if (route.columns.pdf) wide.push_back(finite("pdf", pdf, row, route));
        if (route.columns.weight) wide.push_back(finite("weight", weight, row, route));
    }
    return wide;
}

}  // namespace stipple
