// SPDX-License-Identifier: MIT
#include "math/fourier/spreading.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include "core/machine/wide.hpp"
#include "core/parallel.hpp"
#include "math/fourier/grid_cells.hpp"
#include "math/fourier/window_spreading.hpp"

namespace stipple {
namespace {

/// Minimum number of cells of a tile along each axis.
double smallest_tile(std::size_t dimension) {
    return dimension == 1 ? 1024 : dimension == 2 ? 32 : 16;
}

/// Points are sorted in streams, one thread each; chunks of points go to the streams in turn.
constexpr std::size_t streams = 2;
constexpr std::size_t stream_chunk = std::size_t{1} << 15;
constexpr std::size_t round_of_streams = streams * stream_chunk;
constexpr std::size_t sorting_block = std::size_t{1} << 12;  // in points; they fit the caches
constexpr std::size_t tiles_at_a_time = 128;  // tiles of a colour spread before those of the next

/// Maximum number of points summed in a tile's buffer: shorter sums have smaller rounding errors.
constexpr std::size_t fold_after = 512;

/// Number of points sorted at a time: about the number of cells, between 2^20 and 2^22.
std::size_t spreading_batch(const CellGrid& grid) {
    constexpr std::size_t most = std::size_t{1} << 30;  // within the range of 32-bit counters
    std::size_t cells = 1;
    for (std::size_t k = 0; k < grid.dimension; ++k) cells = std::min(most, cells * grid.side);
    // Batches much smaller than the grid would need too many passes over it.
    cells = std::clamp(cells, std::size_t{1} << 20, std::size_t{1} << 22);
    return cells / round_of_streams * round_of_streams;
}

}  // namespace

/// The grid, divided into an even number of tiles along each axis.
class Spreader::Tiling {
  public:
    Tiling(const CellGrid& grid, const WeightTable& window, bool weighted) : grid_(grid) {
        const std::size_t smallest =
            std::max(static_cast<std::size_t>(smallest_tile(grid.dimension)), window.width());
        pairs_ = std::max<std::size_t>(1, grid.side / (2 * smallest));
        along_ = 2 * pairs_;
        for (std::size_t t = 0; t <= along_; ++t) starts_.push_back(t * grid.side / along_);
        for (std::size_t t = 0; t < along_; ++t)
            widest_ = std::max(widest_, starts_[t + 1] - starts_[t]);
        assert(widest_ <= 4096);  // find_places() stores cell offsets in 12 bits
        common_ = {.side = static_cast<double>(grid.side),
                   .tiles = static_cast<double>(along_),
                   .shift = window.width() % 2 == 1 ? 0.5 : 0.0,
                   .lead = static_cast<double>((window.width() - 1) / 2),
                   .width = window.width(),
                   .piece_bits = static_cast<unsigned>(std::countr_zero(window.pieces())),
                   .coefficients = window.coefficients(),
                   .numbers = grid.dimension + (weighted ? 1 : 0),
                   .extent = (widest_ + WeightTable::row_of(window.width()) + 7) / 8 * 8};
    }

    [[nodiscard]] std::size_t count() const { return power(along_); }
    [[nodiscard]] std::size_t pairs() const { return pairs_; }  ///< pairs of tiles along an axis
    [[nodiscard]] std::size_t colours() const { return power(2); }
    [[nodiscard]] std::size_t count_of_colour() const { return power(pairs_); }
    [[nodiscard]] std::size_t buffer_size() const { return power(common_.extent); }

    void find(std::span<const double> rows, std::uint32_t* tile_of, double* places) const {
        find_places(rows, grid_.dimension, common_, tile_of, places);
    }

    /// Index of the i-th tile of a colour; bit k of the colour is the parity along axis k.
    [[nodiscard]] std::size_t tile(std::size_t colour, std::size_t i) const {
        std::size_t tile = 0;
        std::size_t step = 1;
        for (std::size_t k = 0; k < grid_.dimension; ++k, step *= along_, i /= pairs_)
            tile += (2 * (i % pairs_) + (colour >> k & 1)) * step;
        return tile;
    }

    [[nodiscard]] SpreadTile describe(std::size_t tile) const {
        SpreadTile description = common_;
        for (std::size_t k = 0; k < grid_.dimension; ++k, tile /= along_) {
            const std::size_t start = starts_[tile % along_];
            description.start[k] = static_cast<std::int64_t>(start);
            description.reach[k] = starts_[tile % along_ + 1] - start + common_.width - 1;
        }
        return description;
    }

    /// Adds a tile's buffer to the grid, with wraparound, and clears it. Touches no cell beyond the
    /// tile's reach, because another thread may be adding the next tile of the colour.
    STIPPLE_WIDE void add_back(const SpreadTile& tile, double* buffer) const {
        const std::size_t x = wrapped(tile.start[0], 0);
        const std::size_t before_end = std::min(tile.reach[0], grid_.side - x);
        for (std::size_t z = 0; z < tile.reach[2]; ++z)
            for (std::size_t y = 0; y < tile.reach[1]; ++y) {
                double* row = grid_.cells + line(tile, y, z) * grid_.stride;
                const double* from = buffer + (z * tile.extent + y) * tile.extent;
                for (std::size_t i = 0; i < before_end; ++i) row[x + i] += from[i];
                for (std::size_t i = before_end; i < tile.reach[0]; ++i)
                    row[i - before_end] += from[i];
            }
        std::fill_n(buffer, buffer_size(), 0.0);
    }

  private:
    /// Line of the grid to which a line of the buffer is added.
    [[nodiscard]] std::size_t line(const SpreadTile& tile, std::size_t y, std::size_t z) const {
        return wrapped(tile.start[2], z) * grid_.side + wrapped(tile.start[1], y);
    }
    [[nodiscard]] std::size_t power(std::size_t base) const {
        std::size_t value = 1;
        for (std::size_t k = 0; k < grid_.dimension; ++k) value *= base;
        return value;
    }
    [[nodiscard]] std::size_t wrapped(std::int64_t start, std::size_t offset) const {
        const std::size_t i = static_cast<std::size_t>(start) + offset;
        return i < grid_.side ? i : i - grid_.side;
    }

    CellGrid grid_;
    std::size_t pairs_ = 1;
    std::size_t along_ = 2;
    std::size_t widest_ = 0;
    std::vector<std::size_t> starts_;
    SpreadTile common_{};
};

Spreader::Spreader(const KaiserBessel& window, const CellGrid& grid, std::uint64_t count,
                   bool weighted)
    : table_(window),
      tiling_(std::make_unique<Tiling>(grid, table_, weighted)),
      dimension_(grid.dimension),
      width_(grid.dimension + (weighted ? 1 : 0)),
      batch_(static_cast<std::size_t>(std::min<std::uint64_t>(
          spreading_batch(grid), (count / round_of_streams + 1) * round_of_streams))) {
    assert(grid.side % 2 == 0 && grid.side >= CellGrid::smallest_side && grid.side < 1U << 24);
}

Spreader::~Spreader() = default;

double Spreader::bytes(double count, const CellGrid& grid, bool weighted) {
    const double points = std::min(count, static_cast<double>(spreading_batch(grid)));
    const double tiles = std::pow(static_cast<double>(grid.side) / smallest_tile(grid.dimension),
                                  static_cast<double>(grid.dimension));
    return TilePoints::bytes(points, streams * tiles, grid.dimension + (weighted ? 1 : 0));
}

void Spreader::add(std::span<const double> rows, const RunContext& run) {
    while (!rows.empty()) {
        const std::size_t count = std::min(rows.size() / width_, batch_ - waits_);
        sort(rows.first(count * width_), run);
        waits_ += count;
        if (waits_ == batch_) finish(run);
        rows = rows.subspan(count * width_);
    }
}

void Spreader::finish(const RunContext& run) {
    if (waits_ == 0) return;
    // Processes a few rows of tiles at a time, so that caches still hold the cells that tiles of
    // several colours add to.
    const std::size_t tiles = tiling_->count_of_colour();
    const std::size_t row = tiles / tiling_->pairs();
    const std::size_t some = (tiles_at_a_time + row - 1) / row * row;
    for (std::size_t first = 0; first < tiles; first += some)
        for (std::size_t colour = 0; colour < tiling_->colours(); ++colour)
            spread_colour(colour, first, std::min(tiles, first + some), run);
    for (TilePoints& points : points_) points.clear();
    waits_ = 0;
}

/// Sorts the points into tiles, stream by stream; within a tile, the order in a stream is kept.
void Spreader::sort(std::span<const double> rows, const RunContext& run) {
    const std::size_t end = waits_ + rows.size() / width_;
    while (points_.size() < (end > stream_chunk ? streams : 1))
        points_.emplace_back(tiling_->count(), width_, batch_ / streams);
    const auto sort_stream = [&](const Block& stream) {
        std::vector<std::uint32_t> tile_of(sorting_block);
        std::vector<double> places(sorting_block * width_);
        for (std::size_t at = waits_; at < end;) {
            const std::size_t chunk = at / stream_chunk;
            const std::size_t last = std::min(end, (chunk + 1) * stream_chunk);
            for (; chunk % streams == stream.index && at < last; at += sorting_block) {
                const std::size_t some = std::min(sorting_block, last - at);
                const auto here = rows.subspan((at - waits_) * width_, some * width_);
                tiling_->find(here, tile_of.data(), places.data());
                points_[stream.index].add(places.data(), tile_of.data(), some);
            }
            at = last;
        }
    };
    RunContext context = run;
    if (end - waits_ <= stream_chunk) context.threads = 1;
    for_each_block(silent(context), points_.size(), 1, sort_stream);
}

/// Spreads the points of tiles [first, last) of a colour.
void Spreader::spread_colour(std::size_t colour, std::size_t first, std::size_t last,
                             const RunContext& run) {
    // Enough blocks for all threads, but each with more work than it costs to start.
    const std::size_t tiles_per_block =
        std::max(1 + (last - first) / 128, 1024 * tiling_->count() / (waits_ + 1));
    for_each_block(silent(run), last - first, tiles_per_block, [&](const Block& b) {
        GridCells buffer(tiling_->buffer_size());
        for (std::size_t i = b.first; i < b.last; ++i)
            spread_tile(tiling_->tile(colour, first + i), buffer.get(), run);
    });
}

/// Spreads a tile's points through `buffer`, which must be 0 and is cleared again.
void Spreader::spread_tile(std::size_t number, double* buffer, const RunContext& run) const {
    const SpreadTile tile = tiling_->describe(number);
    std::size_t count = 0;  // points in the buffer
    const auto add_back = [&] {
        if (count > 0) tiling_->add_back(tile, buffer);
        count = 0;
    };
    const auto spread = [&](std::span<const double> rows) {
        run.check_stop();
        if (count + rows.size() / width_ > fold_after) add_back();
        count += rows.size() / width_;
        spread_points(rows, dimension_, tile, buffer);
    };
    for (const TilePoints& points : points_) points.visit(number, spread);
    add_back();
}

}  // namespace stipple
