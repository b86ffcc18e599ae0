// SPDX-License-Identifier: MIT
#include "math/neighbors/void_and_cluster.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/rng.hpp"
#include "math/functions/exponential.hpp"

namespace stipple {
namespace {

constexpr double sigma = 1.5;  // in cells

/// One of the two ranges into which an interval of cells is split where it wraps around the torus.
struct Piece {
    std::size_t first = 0;   ///< coordinate of the range's first cell
    std::size_t length = 0;  ///< may be 0
    std::size_t offset = 0;  ///< offset of that cell within the interval
};

std::array<Piece, 2> wrapped(std::size_t center, std::size_t before, std::size_t length,
                             std::size_t period) {
    const std::size_t first = (center + period - before) % period;
    const std::size_t head = std::min(length, period - first);
    return {Piece{first, head, 0}, Piece{0, length - head, head}};
}

/// Finds the smallest of W x H numbers by a pyramid of minima over up to four numbers each.
class Smallest {
  public:
    Smallest(std::size_t width, std::size_t height) {
        levels_.push_back(level(width, height));
        while (levels_.back().keys.size() > 1)
            levels_.push_back(
                level((levels_.back().width + 1) / 2, (levels_.back().height + 1) / 2));
    }

    std::uint64_t& operator[](std::size_t cell) { return levels_[0].keys[cell]; }

    /// Updates the minima over a rectangle of cells.
    void refresh(const Piece& across, const Piece& along) {
        if (across.length == 0 || along.length == 0) return;
        std::size_t x0 = across.first, x1 = across.first + across.length - 1;
        std::size_t y0 = along.first, y1 = along.first + along.length - 1;
        for (std::size_t l = 1; l < levels_.size(); ++l) {
            x0 /= 2, x1 /= 2, y0 /= 2, y1 /= 2;
            for (std::size_t y = y0; y <= y1; ++y)
                for (std::size_t x = x0; x <= x1; ++x) renew(levels_[l - 1], levels_[l], x, y);
        }
    }

    [[nodiscard]] std::size_t find() const {
        std::size_t x = 0;
        std::size_t y = 0;
        for (std::size_t l = levels_.size() - 1; l-- > 0;) {
            const Level& fine = levels_[l];
            const std::uint64_t key = levels_.back().keys[0];
            const std::size_t right = std::min(2 * x + 1, fine.width - 1);
            const std::size_t above = std::min(2 * y + 1, fine.height - 1);
            const bool below = fine.at(2 * x, 2 * y) == key || fine.at(right, 2 * y) == key;
            y = below ? 2 * y : above;
            x = fine.at(2 * x, y) == key ? 2 * x : right;
        }
        return y * levels_[0].width + x;
    }

  private:
    struct Level {
        std::size_t width;
        std::size_t height;
        std::vector<std::uint64_t> keys;
        [[nodiscard]] std::uint64_t at(std::size_t x, std::size_t y) const {
            return keys[y * width + x];
        }
    };

    static Level level(std::size_t width, std::size_t height) {
        return {width, height, std::vector<std::uint64_t>(width * height, ~std::uint64_t{0})};
    }

    static void renew(const Level& fine, Level& coarse, std::size_t x, std::size_t y) {
        const std::size_t right = std::min(2 * x + 1, fine.width - 1);
        const std::size_t above = std::min(2 * y + 1, fine.height - 1);
        coarse.keys[y * coarse.width + x] =
            std::min(std::min(fine.at(2 * x, 2 * y), fine.at(right, 2 * y)),
                     std::min(fine.at(2 * x, above), fine.at(right, above)));
    }

    std::vector<Level> levels_;
};

/// Factor of the kernel on one axis: its values at distances -before, 1 - before, ... in cells,
/// each summed over all periodic copies.
struct Profile {
    std::size_t before = 0;
    std::vector<double> values = {};
};

Profile profile(std::size_t period, double width) {
    const auto reach = static_cast<std::int64_t>(6.5 * width);
    const auto size = static_cast<std::int64_t>(period);
    const std::int64_t length = std::min(size, 2 * reach + 1);
    Profile result{.before = static_cast<std::size_t>(length / 2)};
    for (std::int64_t i = 0; i < length; ++i) {
        double sum = 0;
        const std::int64_t nearest = i - length / 2;
        const std::int64_t turns = (reach + size) / size;
        for (std::int64_t m = -turns; m <= turns; ++m) {
            const std::int64_t distance = std::abs(nearest + m * size);
            const double t = static_cast<double>(distance) / width;
            if (distance <= reach) sum += exponential(-0.5 * t * t);
        }
        result.values.push_back(sum);
    }
    return result;
}

class Pattern {
  public:
    Pattern(std::size_t width, std::size_t height, double stretch, std::uint64_t seed)
        : width_(width),
          height_(height),
          stretch_(std::sqrt(stretch)),
          energies_(width * height),
          filled_(width * height),
          ties_(width * height),
          voids_(width, height),
          clusters_(width, height) {
        const Rng rng(seed, 1);
        for (std::size_t i = 0; i < ties_.size(); ++i)
            ties_[i] = static_cast<std::uint32_t>(rng.bits(i) >> (64 - tie_bits));
    }

    /// Fills or empties a cell without updating energies; use_sigma() must follow.
    void set(std::size_t cell, bool filled) { filled_[cell] = filled; }
    [[nodiscard]] bool filled(std::size_t cell) const { return filled_[cell] != 0; }

    /// Sets sigma to `width` cells and recomputes all energies.
    void use_sigma(double width, const RunContext& run) {
        constexpr double unit = 0x1p38;
        across_ = profile(width_, width / stretch_);
        along_ = profile(height_, width * stretch_);
        kernel_.clear();
        for (const double y : along_.values)
            for (const double x : across_.values)
                kernel_.push_back(static_cast<std::uint64_t>(x * y * unit + 0.5));
        std::ranges::fill(energies_, 0);
        for (std::size_t i = 0; i < filled_.size(); ++i) {
            if (i % 64 == 0) run.check_stop();
            if (filled(i)) add(i, 1);
        }
        const Piece columns{0, width_, 0};
        for (std::size_t y = 0; y < height_; ++y) {
            run.check_stop();
            for (std::size_t x = 0; x < width_; ++x) rank(y * width_ + x);
        }
        voids_.refresh(columns, {0, height_, 0});
        clusters_.refresh(columns, {0, height_, 0});
    }

    void fill(std::size_t cell) {
        set(cell, true);
        add(cell, 1);
        refresh(cell);
    }
    void empty(std::size_t cell) {
        set(cell, false);
        add(cell, ~std::uint64_t{0});
        refresh(cell);
    }

    [[nodiscard]] std::size_t largest_void() const { return voids_.find(); }
    [[nodiscard]] std::size_t tightest_cluster() const { return clusters_.find(); }

  private:
    static constexpr int tie_bits = 20;

    /// Adds a cell's contribution to all energies, times 1 or -1.
    void add(std::size_t cell, std::uint64_t sign) {
        for (const Piece& rows :
             wrapped(cell / width_, along_.before, along_.values.size(), height_))
            for (const Piece& columns :
                 wrapped(cell % width_, across_.before, across_.values.size(), width_))
                for (std::size_t j = 0; j < rows.length; ++j) {
                    const std::uint64_t* from =
                        kernel_.data() + (rows.offset + j) * across_.values.size() + columns.offset;
                    std::uint64_t* to =
                        energies_.data() + (rows.first + j) * width_ + columns.first;
                    for (std::size_t i = 0; i < columns.length; ++i) to[i] += sign * from[i];
                }
    }

    /// Updates the order of all cells whose energy add(cell, ...) changed.
    void refresh(std::size_t cell) {
        for (const Piece& rows :
             wrapped(cell / width_, along_.before, along_.values.size(), height_))
            for (const Piece& columns :
                 wrapped(cell % width_, across_.before, across_.values.size(), width_)) {
                for (std::size_t j = 0; j < rows.length; ++j)
                    for (std::size_t i = 0; i < columns.length; ++i)
                        rank((rows.first + j) * width_ + columns.first + i);
                voids_.refresh(columns, rows);
                clusters_.refresh(columns, rows);
            }
    }

    void rank(std::size_t cell) {
        const std::uint64_t key = (energies_[cell] << tie_bits) | ties_[cell];
        voids_[cell] = filled(cell) ? ~std::uint64_t{0} : key;
        clusters_[cell] = filled(cell) ? ~key : ~std::uint64_t{0};
    }

    std::size_t width_;
    std::size_t height_;
    double stretch_;  ///< a cell's width divided by the square root of its area
    Profile across_;
    Profile along_;
    std::vector<std::uint64_t> kernel_;
    std::vector<std::uint64_t> energies_;
    std::vector<std::uint8_t> filled_;
    std::vector<std::uint32_t> ties_;
    Smallest voids_;
    Smallest clusters_;
};

/// Fills `count` cells at random; moves tightest clusters to largest voids until none moves.
void start(Pattern& pattern, std::size_t cells, std::size_t count, std::uint64_t seed,
           const RunContext& run) {
    const Rng rng(seed, 0);
    std::size_t filled = 0;
    for (std::uint64_t i = 0; filled < count; ++i) {
        const std::size_t cell = rng.below(i, cells);
        filled += !pattern.filled(cell);
        pattern.set(cell, true);
    }
    run.tick(0, 1);
    pattern.use_sigma(sigma, run);
    // Every move lowers the total energy or, at equal energy, the tie number. So the loop ends.
    for (std::uint64_t moves = 1;; ++moves) {
        const std::size_t from = pattern.tightest_cluster();
        pattern.empty(from);
        const std::size_t to = pattern.largest_void();
        pattern.fill(to);
        if (to == from) break;
        if (moves % 64 == 0) run.tick(std::min(moves, count), 2 * count);
    }
}

}  // namespace

std::vector<std::uint32_t> void_and_cluster_order(std::size_t width, std::size_t height,
                                                  std::size_t wanted, std::uint64_t seed,
                                                  const RunContext& run, double stretch) {
    const std::size_t cells = width * height;
    run.need_memory(45.0 * static_cast<double>(cells), "the torus of cells");
    const std::size_t tenth = std::max<std::size_t>(1, cells / 10);
    const RunContext steady = run.rising();
    const RunContext first = steady.stage(0, 0.2);
    const RunContext rest = steady.stage(0.2, 1);
    const std::size_t steps = std::max(wanted, tenth);

    Pattern pattern(width, height, stretch, seed);
    start(pattern, cells, tenth, seed, first);
    std::vector<std::uint32_t> order(steps);
    double wide = sigma;
    std::size_t widen = tenth / 4;
    for (std::size_t left = tenth; left-- > 0;) {
        if (left % 64 == 0) rest.tick(tenth - left, steps);
        const std::size_t cell = pattern.tightest_cluster();
        order[left] = static_cast<std::uint32_t>(cell);
        if (left == widen && left > 0) {
            pattern.set(cell, false);
            pattern.use_sigma(wide *= 2, rest);
            widen /= 4;
        } else {
            pattern.empty(cell);
        }
    }
    if (wanted > tenth) {
        for (std::size_t i = 0; i < tenth; ++i) pattern.set(order[i], true);
        pattern.use_sigma(sigma, rest);
        for (std::size_t i = tenth; i < wanted; ++i) {
            if (i % 64 == 0) rest.tick(i, steps);
            order[i] = static_cast<std::uint32_t>(pattern.largest_void());
            pattern.fill(order[i]);
        }
    }
    order.resize(wanted);
    return order;
}

}  // namespace stipple
