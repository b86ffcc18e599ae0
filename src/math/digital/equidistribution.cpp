// SPDX-License-Identifier: MIT
#include "math/digital/equidistribution.hpp"

#include <algorithm>
#include <array>

#include "core/machine/wide.hpp"
#include "core/parallel.hpp"
#include "math/combinatorics/primes.hpp"
#include "math/digital/stratum.hpp"
#include "math/functions/powers.hpp"

namespace stipple::equidistribution {
namespace {

/// Returns a + f c, digit by digit modulo the base.
std::int32_t digit_sum(std::int32_t a, std::int32_t c, std::uint32_t f, std::uint32_t base) {
    if (base == 2) return f == 1 ? a ^ c : a;
    auto x = static_cast<std::uint32_t>(a);
    auto y = static_cast<std::uint32_t>(c);
    std::uint64_t sum = 0;
    std::uint64_t place = 1;
    for (; x != 0 || y != 0; x /= base, y /= base, place *= base)
        sum += place * ((x % base + std::uint64_t{f} * (y % base)) % base);
    return static_cast<std::int32_t>(sum);
}

/// Digits of point b^j minus those of point 0, modulo b, for all j; coordinate by coordinate.
std::vector<std::int32_t> steps_of(const Net& net) {
    std::vector<std::int32_t> steps;
    for (std::size_t k = 0; k < net.dimension; ++k) {
        const auto cells = net.coordinate(k);
        for (std::size_t j = 0, i = 1; j < net.digits; ++j, i *= net.base)
            steps.push_back(digit_sum(cells[i], cells[0], net.base - 1, net.base));
    }
    return steps;
}

/// True if each point i > 0 is point i - b^j plus step j, with j the position of i's lowest nonzero
/// digit.
bool is_linear(const Net& net, std::span<const std::int32_t> steps, const RunContext& run) {
    for (std::size_t i = 1; i < net.count; ++i) {
        if (i % (1 + 65536 / net.dimension) == 0) run.check_stop();
        std::size_t j = 0;
        std::size_t unit = 1;
        for (; i / unit % net.base == 0; unit *= net.base) ++j;
        for (std::size_t k = 0; k < net.dimension; ++k) {
            const auto cells = net.coordinate(k);
            if (cells[i] != digit_sum(cells[i - unit], steps[k * net.digits + j], 1, net.base))
                return false;
        }
    }
    return true;
}

/// Sets to[i] to from[i] b^q plus the integer formed by the first q of the m digits of cells[i],
/// where scale = b^q and rest = b^(m-q). Adding 0.5 keeps each quotient further from an integer
/// than its rounding error.
STIPPLE_WIDE void append_digits(const std::int32_t* from, const std::int32_t* cells,
                                std::size_t count, std::int32_t scale, double rest,
                                std::int32_t* to) {
    const double inverse = 1 / rest;
    for (std::size_t i = 0; i < count; ++i)
        to[i] = from[i] * scale + static_cast<std::int32_t>((cells[i] + 0.5) * inverse);
}

class CountingProbe final : public Probe {
  public:
    CountingProbe(const Net& net, const RunContext& run) : net_(net), run_(run), boxes_(1) {
        boxes_[0].resize(net.count);
    }

    void cut(std::size_t depth, std::size_t coordinate, std::size_t digits) override {
        if (boxes_.size() < depth + 2) boxes_.emplace_back(net_.count);
        used_.resize(depth);
        for (std::size_t first = 0; first < net_.count; first += block)
            append(depth, coordinate, digits, first, boxes_[depth + 1].data() + first);
        used_.push_back(digits);
    }

    bool equal(std::size_t depth, std::size_t coordinate, std::size_t digits) override {
        used_.resize(depth);
        std::size_t total = digits;
        for (const std::size_t q : used_) total += q;
        const std::size_t boxes = saturating_power(net_.base, total);
        const auto share = static_cast<std::uint32_t>(net_.count / boxes);
        counts_.assign(boxes, 0);
        std::array<std::int32_t, block> part;
        for (std::size_t first = 0; first < net_.count; first += block) {
            append(depth, coordinate, digits, first, part.data());
            const std::size_t size = std::min(block, net_.count - first);
            for (std::size_t i = 0; i < size; ++i)
                if (++counts_[static_cast<std::size_t>(part[i])] > share) return false;
        }
        return true;
    }

  private:
    static constexpr std::size_t block = 4096;

    /// Computes the boxes of a block of points after one more cut, by `digits` of a coordinate.
    void append(std::size_t depth, std::size_t coordinate, std::size_t digits, std::size_t first,
                std::int32_t* to) const {
        run_.check_stop();
        append_digits(boxes_[depth].data() + first, net_.coordinate(coordinate).data() + first,
                      std::min(block, net_.count - first),
                      static_cast<std::int32_t>(saturating_power(net_.base, digits)),
                      static_cast<double>(saturating_power(net_.base, net_.digits - digits)), to);
    }

    const Net& net_;
    const RunContext& run_;
    std::vector<std::vector<std::int32_t>> boxes_;  ///< boxes_[c][i]: box of point i after c cuts
    std::vector<std::size_t> used_;                 ///< number of digits of each cut
    std::vector<std::uint32_t> counts_;
};

/// Tests the linear independence of matrix rows, kept in echelon form with pivots 1.
class RankProbe final : public Probe {
  public:
    RankProbe(const Matrices& matrices, const RunContext& run) : matrices_(matrices), run_(run) {}

    void cut(std::size_t depth, std::size_t coordinate, std::size_t digits) override {
        equal(depth, coordinate, digits);
        ends_.push_back(pivots_.size());
    }

    bool equal(std::size_t depth, std::size_t coordinate, std::size_t digits) override {
        run_.check_stop();
        ends_.resize(depth);
        pivots_.resize(depth == 0 ? 0 : ends_.back());
        for (std::size_t l = 0; l < digits; ++l)
            if (!add(matrices_.row(coordinate, l))) return false;
        return true;
    }

  private:
    /// Adds a row; returns false if it depends on the others.
    bool add(std::span<const std::uint32_t> row) {
        const std::size_t m = matrices_.size;
        const std::size_t rank = pivots_.size();
        rows_.resize((rank + 1) * m);
        const auto fresh = std::span(rows_).subspan(rank * m, m);
        std::ranges::copy(row, fresh.begin());
        for (std::size_t r = 0; r < rank; ++r)
            add_multiple(fresh, std::span(rows_).subspan(r * m, m), negative(fresh[pivots_[r]]));
        const auto pivot = std::ranges::find_if(fresh, [](auto x) { return x != 0; });
        if (pivot == fresh.end()) return false;
        pivots_.push_back(static_cast<std::size_t>(pivot - fresh.begin()));
        const std::uint32_t scale = inverse(*pivot);
        for (std::uint32_t& x : fresh) x = times(x, scale);
        return true;
    }

    void add_multiple(std::span<std::uint32_t> row, std::span<const std::uint32_t> other,
                      std::uint32_t factor) const {
        if (factor == 0) return;
        if (matrices_.base == 2) {
            for (std::size_t j = 0; j < row.size(); ++j) row[j] ^= other[j];
        } else {
            for (std::size_t j = 0; j < row.size(); ++j)
                row[j] = (row[j] + times(other[j], factor)) % matrices_.base;
        }
    }

    [[nodiscard]] std::uint32_t negative(std::uint32_t x) const {
        return x == 0 ? 0 : matrices_.base - x;
    }
    [[nodiscard]] std::uint32_t times(std::uint32_t x, std::uint32_t y) const {
        return static_cast<std::uint32_t>(std::uint64_t{x} * y % matrices_.base);
    }
    /// Inverse as x^(b - 2), by Fermat's theorem.
    [[nodiscard]] std::uint32_t inverse(std::uint32_t x) const {
        std::uint32_t power = 1;
        for (std::uint32_t e = matrices_.base - 2; e != 0; e /= 2, x = times(x, x))
            if (e % 2 == 1) power = times(power, x);
        return power;
    }

    const Matrices& matrices_;
    const RunContext& run_;
    std::vector<std::uint32_t> rows_;
    std::vector<std::size_t> pivots_;
    std::vector<std::size_t> ends_;  ///< number of rows in rows_ after each cut
};

}  // namespace

Net net_of(const PointSet& points, std::uint32_t base, std::size_t digits, const RunContext& run) {
    const std::size_t n = points.count();
    const std::size_t d = points.dimension();
    Net net{.base = base, .digits = digits, .count = n, .dimension = d};
    net.cells.resize(n * d);
    const RunContext part = worth_threads(run, 1e-8 * static_cast<double>(n * d));
    for_each_block(part, n, 1 + 16384 / d, [&](const Block& block) {
        for (std::size_t i = block.first; i < block.last; ++i)
            for (std::size_t k = 0; k < d; ++k)
                net.cells[k * n + i] =
                    static_cast<std::int32_t>(stratum_of(points[i][k], static_cast<double>(n)));
    });
    return net;
}

std::optional<Matrices> matrices_of(const Net& net, const RunContext& run) {
    if (!is_prime(net.base)) return std::nullopt;
    const auto steps = steps_of(net);
    if (!is_linear(net, steps, run)) return std::nullopt;
    const std::size_t m = net.digits;
    Matrices matrices{.base = net.base, .size = m, .entries = {}};
    matrices.entries.resize(net.dimension * m * m);
    for (std::size_t k = 0; k < net.dimension; ++k)
        for (std::size_t j = 0; j < m; ++j) {
            auto cell = static_cast<std::uint32_t>(steps[k * m + j]);
            for (std::size_t l = m; l-- > 0; cell /= net.base)
                matrices.entries[(k * m + l) * m + j] = cell % net.base;
        }
    return matrices;
}

std::unique_ptr<Probe> probe_of(const Net& net, const std::optional<Matrices>& matrices,
                                const RunContext& run) {
    if (matrices) return std::make_unique<RankProbe>(*matrices, run);
    return std::make_unique<CountingProbe>(net, run);
}

bool all_equal(Probe& probe, std::span<const std::size_t> along, std::size_t depth,
               std::size_t digits) {
    const std::size_t others = along.size() - depth - 1;
    if (others == 0) return probe.equal(depth, along[depth], digits);
    for (std::size_t q = 1; q + others <= digits; ++q) {
        probe.cut(depth, along[depth], q);
        if (!all_equal(probe, along, depth + 1, digits - q)) return false;
    }
    return true;
}

}  // namespace stipple::equidistribution
