// SPDX-License-Identifier: MIT
#include "media/density_map.hpp"

#include <algorithm>
#include <cmath>

#include "core/bytes/file_bytes.hpp"
#include "core/bytes/npy_header.hpp"
#include "core/error.hpp"
#include "core/machine/large_pages.hpp"
#include "core/rng.hpp"
#include "core/text.hpp"
#include "media/png_picture.hpp"

namespace stipple {
namespace {

using Cells = PlaneValues;

Cells cells_of_png(std::string_view bytes, const std::string& path, bool invert,
                   const RunContext& run) {
    PngPicture picture = read_png(bytes, path, run);
    std::vector<double>& values = picture.grey;
    if (invert)
        for (double& value : values) value = 1 - value;
    for (std::size_t i = 0; i < picture.opacity.size(); ++i) values[i] *= picture.opacity[i];
    for (std::size_t j = 0; j < picture.height / 2; ++j) {
        const auto row = [&](std::size_t k) {
            return values.begin() + static_cast<std::ptrdiff_t>(k * picture.width);
        };
        std::swap_ranges(row(j), row(j + 1), row(picture.height - 1 - j));
    }
    return {picture.width, picture.height, std::move(values)};
}

/// Checks all values. @throws Error(input) naming the first value for which `good` is false
template <class Good>
void check_values(const Cells& cells, const std::string& path, const Good& good,
                  const char* expected) {
    const auto bad = std::ranges::find_if_not(cells.values, good);
    if (bad == cells.values.end()) return;
    const auto index = static_cast<std::size_t>(bad - cells.values.begin());
    fail(ErrorKind::input, "{}: value {} in row {}, column {}; expected {}", path,
         format_number(*bad), index / cells.width, index % cells.width, expected);
}

Cells cells_of_array(std::string_view bytes, const std::string& path, const RunContext& run) {
    const NpyHeader header = read_npy_header(bytes, path);
    if (header.shape.size() != 2)
        fail(ErrorKind::input, "{}: an array of shape {}; expected (rows, columns)", path,
             header.shown_shape);
    if (header.empty())
        fail(ErrorKind::input, "{}: an array of shape {} is empty", path, header.shown_shape);
    const std::size_t count = npy_numbers(header, bytes.size());
    run.need_memory(static_cast<double>(count) * 24, "the array " + path);
    Cells cells{header.shape[1], header.shape[0], std::vector<double>(count)};
    take_raw(bytes.substr(header.size), header.type, cells.values);
    if (header.columns_first) {
        const std::vector<double> stored = cells.values;
        for (std::size_t i = 0; i < count; ++i)
            cells.values[i] = stored[i / cells.width + i % cells.width * cells.height];
    }
    return cells;
}

/// Checks densities from a PFM or NPY file. Inverts them relative to their maximum, since these
/// formats do not define white.
Cells densities(Cells cells, const std::string& path, bool invert) {
    check_values(
        cells, path, [](double value) { return value >= 0 && std::isfinite(value); },
        "finite densities, none below 0");
    if (invert) {
        const double top = std::ranges::max(cells.values);
        for (double& value : cells.values) value = top - value;
    }
    return cells;
}

Cells read_cells(const std::string& path, bool invert, const RunContext& run) {
    const std::string bytes = read_file(path);
    if (bytes.empty())
        fail(ErrorKind::input,
             "{}: the file is empty; expected a PNG or PFM picture or an NPY array", path);
    Cells cells;
    if (bytes.starts_with(png_magic))
        cells = cells_of_png(bytes, path, invert, run);
    else if (bytes.starts_with(npy_magic))
        cells = densities(cells_of_array(bytes, path, run), path, invert);
    else if (looks_like_pfm(bytes))
        cells = densities(read_pfm(bytes, path, run), path, invert);
    else
        fail(ErrorKind::input, "{}: neither a PNG or PFM picture nor an NPY array", path);
    if (std::ranges::all_of(cells.values, [](double value) { return value == 0; }))
        fail(ErrorKind::input, "{}: all values are 0{}; no point can be placed", path,
             invert ? " when inverted" : "");
    return cells;
}

/// Fraction of the cell's mass below the cumulative sum `wanted`; less than 1.
double fraction_before(std::span<const double> sums, std::size_t cell, double wanted) {
    const double before = cell == 0 ? 0 : sums[cell - 1];
    return std::min((wanted - before) / (sums[cell] - before), one_minus_ulp);
}

/// Buckets with at most this number of sums, as most have, are searched in a fixed number of steps.
/// A higher limit would touch another cache line.
constexpr std::size_t few_in_bucket = 4;

/// Fraction of the total mass before a position in a cell.
double share_before(std::span<const double> sums, std::size_t cell, double fraction) {
    if (!(sums.back() > 0)) return 0;
    const double before = cell == 0 ? 0 : sums[cell - 1];
    return std::min((before + fraction * (sums[cell] - before)) / sums.back(), 1.0);
}

/// (cell + fraction) / cells, adjusted so that rounding does not leave the cell.
double coordinate(std::size_t cell, double fraction, std::size_t cells) {
    const auto count = static_cast<double>(cells);
    const auto floor = static_cast<double>(cell);
    double x = (floor + fraction) / count;
    while (x * count >= floor + 1) x = std::nextafter(x, 0.0);
    while (x * count < floor) x = std::nextafter(x, 1.0);
    return x;
}

}  // namespace

DensityMap::DensityMap(std::size_t width, std::size_t height, std::vector<double> values)
    : width_(width), height_(height), values_(std::move(values)) {
    fill_with_zeros(row_sums_, width * height);
    // Scales to a maximum of 1 first, so that the sum cannot overflow.
    const double top = std::ranges::max(values_);
    double sum = 0;
    for (double& value : values_) sum += value /= top;
    const double mean = sum / static_cast<double>(values_.size());
    std::vector<double> column;
    double total = 0;
    for (std::size_t j = 0; j < height_; ++j) {
        double row = 0;
        for (std::size_t k = j * width_; k < (j + 1) * width_; ++k) {
            values_[k] /= mean;
            row_sums_[k] = row += values_[k];
        }
        column.push_back(total += row);
    }
    largest_ = std::ranges::max(values_);
    column_ = GuideTable(std::move(column), height_);
    lay_out_guides();
}

// Buckets of about 2 cells, so that a bucket's sums mostly lie in one cache line.
void DensityMap::lay_out_guides() {
    const std::size_t buckets = (width_ + 1) / 2;
    row_guide_size_ = buckets + 1;
    fill_with_zeros(row_guides_, height_ * row_guide_size_);
    for (std::size_t j = 0; j < height_; ++j) {
        const auto sums = std::span(row_sums_).subspan(j * width_, width_);
        rows_.push_back({sums.back(), std::nextafter(sums.back(), 0.0), {sums.back(), buckets}});
        fill_guide(sums, std::span(row_guides_).subspan(j * row_guide_size_, row_guide_size_));
    }
}

inline DensityMap::Visit DensityMap::visit(double u, double v) const {
    const double mass = v * column_.total();
    const std::size_t row = column_.at(mass);
    const double wanted = std::min(u * rows_[row].total, rows_[row].most);
    return {row, row * row_guide_size_ + rows_[row].buckets.of(wanted), wanted,
            coordinate(row, fraction_before(column_.sums(), row, mass), height_)};
}

inline double DensityMap::across(const Visit& visit) const {
    const auto sums = std::span(row_sums_).subspan(visit.row * width_, width_);
    const std::size_t cell =
        first_above(sums, row_guides_[visit.bucket], row_guides_[visit.bucket + 1], visit.wanted,
                    few_in_bucket);
    return coordinate(cell, fraction_before(sums, cell, visit.wanted), width_);
}

double DensityMap::largest_in(double x0, double x1, double y0, double y1) const {
    double largest = 0;
    for (std::size_t j = cell_of(y0, height_); j <= cell_of(y1, height_); ++j)
        for (std::size_t i = cell_of(x0, width_); i <= cell_of(x1, width_); ++i)
            largest = std::max(largest, values_[j * width_ + i]);
    return largest;
}

std::array<double, 2> DensityMap::place(double u, double v) const {
    const Visit visit = this->visit(u, v);
    return {across(visit), visit.y};
}

/// Has three stages, each 8 points ahead of the next, so that memory accesses overlap.
[[gnu::flatten]] void DensityMap::place_all(std::span<const double> cube,
                                            std::span<double> image) const {
    constexpr std::size_t ahead = 8;
    constexpr std::size_t ring = 32;  // a power of two above 2 * ahead
    std::array<Visit, ring> visits;
    const std::size_t count = cube.size() / 2;
    for (std::size_t i = 0; i < count + 2 * ahead; ++i) {
        if (i < count) {
            Visit& next = visits[i % ring];
            next = visit(cube[2 * i], cube[2 * i + 1]);
            __builtin_prefetch(&row_guides_[next.bucket]);
        }
        if (i >= ahead && i - ahead < count) {
            const Visit& next = visits[(i - ahead) % ring];
            // The bucket's sums and the sum before them may be in two cache lines.
            const std::size_t sum = next.row * width_ + row_guides_[next.bucket];
            __builtin_prefetch(&row_sums_[std::max<std::size_t>(sum, 1) - 1]);
            __builtin_prefetch(&row_sums_[std::min(sum + 2, row_sums_.size() - 1)]);
        }
        if (i >= 2 * ahead) {
            const std::size_t at = i - 2 * ahead;
            image[2 * at] = across(visits[at % ring]);
            image[2 * at + 1] = visits[at % ring].y;
        }
    }
}

std::array<double, 2> DensityMap::find(double x, double y) const {
    const std::size_t j = cell_of(y, height_);
    const std::size_t i = cell_of(x, width_);
    const auto sums = std::span(row_sums_).subspan(j * width_, width_);
    return {
        share_before(sums, i, x * static_cast<double>(width_) - static_cast<double>(i)),
        share_before(column_.sums(), j, y * static_cast<double>(height_) - static_cast<double>(j))};
}

DensityMap read_density(const std::string& path, bool invert, const RunContext& run) {
    Cells cells = read_cells(path, invert, run);
    return {cells.width, cells.height, std::move(cells.values)};
}

PlaneValues read_lengths(const std::string& path, const RunContext& run) {
    const std::string bytes = read_file(path);
    if (!bytes.starts_with(npy_magic))
        fail(ErrorKind::input, "{}: not an NPY array; expected an NPY array of lengths", path);
    Cells cells = cells_of_array(bytes, path, run);
    check_values(
        cells, path, [](double value) { return value > 0 && std::isfinite(value); },
        "finite lengths above 0");
    return cells;
}

DensityMap read_mask(const std::string& path, bool invert, const RunContext& run) {
    Cells cells = read_cells(path, invert, run);
    for (double& value : cells.values) value = value != 0;
    return {cells.width, cells.height, std::move(cells.values)};
}

}  // namespace stipple
