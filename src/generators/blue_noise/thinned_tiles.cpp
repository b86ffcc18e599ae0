// SPDX-License-Identifier: MIT
#include "generators/blue_noise/thinned_tiles.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <mutex>
#include <optional>

#include "core/parallel.hpp"
#include "core/rng.hpp"

namespace stipple {
namespace {

/// A point that may be kept. `score` has the bits of a nonnegative double, which sort like doubles.
struct ScoredPoint {
    std::uint64_t score;
    std::uint64_t tile;
    std::uint64_t rank;
    auto operator<=>(const ScoredPoint&) const = default;
};

/// Range of scores whose bits, as integers, are in [low, low + 2^width).
struct Window {
    std::uint64_t low = 0;
    int width = 63;
    [[nodiscard]] std::uint64_t high() const { return low + (std::uint64_t{1} << width); }
};

/// Points of all tiles, as candidates with scores.
class TilesInWindow {
  public:
    TilesInWindow(const std::vector<Vec2>& tile, const Tiling& tiling,
                  std::shared_ptr<const DensityMap> density, std::uint64_t seed,
                  const RunContext& run)
        : tile_(tile),
          tiling_(tiling),
          density_(std::move(density)),
          shift_(Rng(seed, 1).bits(0)),
          largest_(tiling.tiles()) {
        for (std::uint64_t t = 0; t < tiling_.tiles(); ++t) {
            if (t % 1024 == 0) run.check_stop();
            const auto [x, y] = corner(t);
            largest_[t] = density_->largest_in(x / columns(), (x + 1) / columns(), y / rows(),
                                               (y + 1) / rows());
        }
    }

    [[nodiscard]] std::uint64_t tiles() const { return tiling_.tiles(); }
    [[nodiscard]] std::uint64_t ranks() const { return tile_.size(); }

    /// Calls use(candidate, x, y), by rank, for the points of the tile whose score has bits up to
    /// `most`, and possibly for others.
    template <class Use>
    void visit(std::uint64_t tile, std::uint64_t most, const Use& use) const {
        const double top = largest_[tile];
        if (!(top > 0)) return;
        const auto [column, row] = corner(tile);
        const double turned = offset(tile);
        for (std::uint64_t rank = 0; rank < tile_.size(); ++rank) {
            const double threshold = static_cast<double>(rank) + turned;
            if (bits_of(threshold / top) > most) return;
            const double x = (column + tile_[rank].x) / columns();
            const double y = (row + tile_[rank].y) / rows();
            const double score = threshold / density_->at(x, y);
            if (score < std::numeric_limits<double>::infinity())
                use(ScoredPoint{bits_of(score), tile, rank}, x, y);
        }
    }

  private:
    static std::uint64_t bits_of(double score) { return std::bit_cast<std::uint64_t>(score); }

    [[nodiscard]] double columns() const { return static_cast<double>(tiling_.columns); }
    [[nodiscard]] double rows() const { return static_cast<double>(tiling_.rows); }

    [[nodiscard]] Vec2 corner(std::uint64_t tile) const {
        return {static_cast<double>(tile % tiling_.columns),
                static_cast<double>(tile / tiling_.columns)};
    }

    /// u_c of the tile (thinned_tiles.hpp); the factors are 2^64 / p and 2^64 / p^2, p^3 = p + 1.
    [[nodiscard]] double offset(std::uint64_t tile) const {
        return to_unit(shift_ + 0xc13fa9a902a6328f * (tile % tiling_.columns) +
                       0x91e10da5c79e7b1c * (tile / tiling_.columns));
    }

    std::vector<Vec2> tile_;
    Tiling tiling_;
    std::shared_ptr<const DensityMap> density_;
    std::uint64_t shift_;
    std::vector<double> largest_;  ///< largest density in each tile
};

/// Number of tiles that a thread visits at a time.
std::uint64_t block_of(const TilesInWindow& candidates) {
    return std::max<std::uint64_t>(1, (std::uint64_t{1} << 17) / candidates.ranks());
}

constexpr int bin_bits = 12;
using Bins = std::array<std::uint64_t, 1 << bin_bits>;

/// Number of scores in each bin of a window, and of those below the window.
struct Histogram {
    std::uint64_t before = 0;
    Bins bins{};
};

Histogram histogram_of(const TilesInWindow& candidates, const Window& window,
                       const RunContext& run) {
    Histogram all;
    std::mutex adding;  // guards `all`, whose integers may be added in any order
    for_each_block(run, candidates.tiles(), block_of(candidates), [&](const Block& block) {
        Histogram part;
        for (std::uint64_t t = block.first; t < block.last; ++t)
            candidates.visit(t, window.high() - 1, [&](const ScoredPoint& c, double, double) {
                if (c.score < window.low)
                    ++part.before;
                else if (c.score < window.high())
                    ++part.bins[(c.score - window.low) >> std::max(0, window.width - bin_bits)];
            });
        const std::lock_guard lock(adding);
        all.before += part.before;
        for (std::size_t b = 0; b < all.bins.size(); ++b) all.bins[b] += part.bins[b];
    });
    return all;
}

/// Bin of the window that holds the score of index `wanted` (from 0); sets `held` to the number of
/// scores in the bin. Returns nullopt if the score is outside the window.
std::optional<Window> narrowed(const Window& window, const Histogram& found, std::uint64_t wanted,
                               std::uint64_t& held) {
    if (wanted < found.before) return {};
    wanted -= found.before;
    const int width = std::max(0, window.width - bin_bits);
    for (std::size_t b = 0; b < found.bins.size(); ++b) {
        held = found.bins[b];
        if (wanted < held) return Window{window.low + (std::uint64_t{b} << width), width};
        wanted -= held;
    }
    return {};
}

/// Window with the score of index `wanted` in ascending order, and at most 2^16 scores, or more if
/// all are equal; nullopt if there are too few scores.
std::optional<Window> window_of(const TilesInWindow& candidates, std::uint64_t wanted,
                                const RunContext& run) {
    constexpr std::uint64_t few = 1 << 16;
    const double mean = static_cast<double>(wanted + 1) / static_cast<double>(candidates.tiles());
    // Looks for the score from half to twice `mean` first; if it is not there, among all scores.
    Window window{std::bit_cast<std::uint64_t>(mean) - (std::uint64_t{1} << 52), 53};
    while (true) {
        std::uint64_t held = 0;
        const auto next = narrowed(window, histogram_of(candidates, window, run), wanted, held);
        if (next && (held <= few || next->width == 0)) return next;
        if (!next && window.width == Window{}.width) return {};
        window = next.value_or(Window{});
    }
}

class ThinnedTiles {
  public:
    ThinnedTiles(TilesInWindow candidates, const Window& window, std::uint64_t count,
                 const RunContext& run)
        : candidates_(std::move(candidates)), starts_(candidates_.tiles() + 1) {
        cut_at(window, count, run);
        for (std::uint64_t t = 0; t < candidates_.tiles(); ++t) starts_[t + 1] += starts_[t];
    }

    void operator()(std::uint64_t first, std::span<double> rows) const {
        const auto after = std::ranges::upper_bound(starts_, first);
        auto tile = static_cast<std::uint64_t>(after - starts_.begin()) - 1;
        std::uint64_t skipped = first - starts_[tile];
        for (std::size_t written = 0; written < rows.size(); ++tile)
            candidates_.visit(tile, last_.score, [&](const ScoredPoint& c, double x, double y) {
                if (c > last_ || written == rows.size()) return;
                if (skipped > 0) {
                    --skipped;
                    return;
                }
                rows[written++] = x;
                rows[written++] = y;
            });
    }

  private:
    /// Finds the last point that is kept; counts the kept points of each tile in starts_[tile + 1].
    void cut_at(const Window& window, std::uint64_t count, const RunContext& run) {
        std::vector<ScoredPoint> near;
        std::mutex adding;
        for_each_block(run, candidates_.tiles(), block_of(candidates_), [&](const Block& block) {
            std::vector<ScoredPoint> part;
            for (std::uint64_t t = block.first; t < block.last; ++t)
                candidates_.visit(t, window.high() - 1, [&](const ScoredPoint& c, double, double) {
                    if (c.score < window.low)
                        ++starts_[t + 1];
                    else if (c.score < window.high())
                        part.push_back(c);
                });
            const std::lock_guard lock(adding);
            near.insert(near.end(), part.begin(), part.end());
        });
        for (const std::uint64_t before : starts_) count -= before;
        std::ranges::sort(near);
        for (std::uint64_t i = 0; i < count; ++i) ++starts_[near[i].tile + 1];
        last_ = near[count - 1];
    }

    TilesInWindow candidates_;
    std::vector<std::uint64_t> starts_;  ///< index of each tile's first point
    ScoredPoint last_{};
};

}  // namespace

std::unique_ptr<Sequence> thinned_tiles(const std::vector<Vec2>& tile, const Tiling& tiling,
                                        std::shared_ptr<const DensityMap> density,
                                        std::uint64_t count, std::uint64_t seed,
                                        const RunContext& run) {
    run.need_memory(16 * static_cast<double>(tiling.columns) * static_cast<double>(tiling.rows),
                    "the tiling for this density");
    const RunContext steady = run.rising();
    TilesInWindow candidates(tile, tiling, std::move(density), seed, run);
    const auto window = window_of(candidates, count - 1, steady.stage(0, 0.7));
    if (!window) return {};
    return sequence_of(ThinnedTiles(std::move(candidates), *window, count, steady.stage(0.7, 1)));
}

}  // namespace stipple
