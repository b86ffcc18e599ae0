// SPDX-License-Identifier: MIT
#include "math/densities/line_table.hpp"

#include <limits>
#include <queue>

#include "core/error.hpp"
#include "core/machine/wide.hpp"
#include "math/densities/expression.hpp"
#include "math/densities/quadrature.hpp"
#include "math/functions/powers.hpp"

namespace stipple {
namespace {

constexpr std::size_t most_pieces = std::size_t{1} << 20;
constexpr std::size_t first_pieces = 97;  // a prime, so that it does not divide likely periods
constexpr std::size_t fewest_probes = std::size_t{1} << 16;

/// A piece with samples of f at 0, 1/4, 1/2, 3/4 and 1.
struct Sampled {
    double low;
    double high;
    std::array<double, 5> f;
    bool gap = false;  ///< result of has_gap(); if true, the table gives the piece no mass

    [[nodiscard]] double width() const { return high - low; }
    [[nodiscard]] double at(double part) const { return low + part * width(); }
    [[nodiscard]] Estimate integral() const {
        const double simpson = width() / 12 * (f[0] + 4 * f[1] + 2 * f[2] + 4 * f[3] + f[4]);
        const double boole =
            width() / 90 * (7 * f[0] + 32 * f[1] + 12 * f[2] + 32 * f[3] + 7 * f[4]);
        return {boole, std::abs(boole - simpson)};
    }
    [[nodiscard]] double mass() const { return width() * 0.5 * (f[0] + f[4]); }
    [[nodiscard]] double error() const {
        return std::max(largest_bend(f), gap ? std::ranges::max(f) : 0) * width();
    }
};

class LineTabulator {
  public:
    LineTabulator(const std::string& what, const BlockFunction& f, const RunContext& run)
        : what_(what), f_(f), run_(run) {}

    std::vector<LinePiece> tabulate(const LineRange& range, double tolerance) {
        width_ = range.high - range.low;
        lay_out(range);
        refine(tolerance);
        std::ranges::sort(pieces_, {}, &Sampled::low);
        std::vector<LinePiece> pieces;
        double mass = 0;
        for (const Sampled& piece : pieces_) {
            pieces.push_back({piece.low, piece.high, piece.f[0], piece.f[4], piece.integral()});
            if (piece.gap) pieces.back().f_low = pieces.back().f_high = 0;
            mass += pieces.back().f_low + pieces.back().f_high;
        }
        if (!(mass > 0))
            fail(ErrorKind::usage, "{} is 0 at all points tried from {} to {}", what_, range.low,
                 range.high);
        sum_all();
        require_integral(what_, mass_);
        return pieces;
    }

  private:
    [[nodiscard]] double value(double x) const {
        double result = 0;
        f_({&x, 1}, {&result, 1});
        require_density(what_, {&x, 1}, result);
        return result;
    }

    /// Creates the first pieces. At breaks, f is sampled from inside each piece.
    void lay_out(const LineRange& range) {
        std::vector<double> ends = {range.low};
        ends.insert(ends.end(), range.breaks.begin(), range.breaks.end());
        ends.push_back(range.high);
        std::vector<Sampled> pieces;
        for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
            const double left = k == 0 ? ends[k] : std::nextafter(ends[k], range.high);
            const double right =
                k + 2 == ends.size() ? ends[k + 1] : std::nextafter(ends[k + 1], range.low);
            for (std::size_t i = 0; i < first_pieces; ++i) {
                const auto cut = [&](std::size_t j) {
                    const double part = static_cast<double>(j) / first_pieces;
                    return j == first_pieces ? ends[k + 1]
                                             : ends[k] + part * (ends[k + 1] - ends[k]);
                };
                Sampled piece{cut(i), cut(i + 1), {}};
                if (!(piece.low < piece.high)) continue;
                piece.f[0] = value(i == 0 ? left : piece.low);
                piece.f[2] = value(piece.at(0.5));
                piece.f[4] = value(i + 1 == first_pieces ? right : piece.high);
                fill_quarters(piece);
                pieces.push_back(piece);
            }
        }
        places_.resize(std::max<std::size_t>(16, fewest_probes / pieces.size()));
        for (const Sampled& piece : pieces) add_probed(piece);
    }

    /// Adds a piece after probing f at many points. If f differs from the table by more than the
    /// samples suggest, the piece is cut at all probes: a narrow feature would be missed otherwise.
    void add_probed(const Sampled& piece) {
        const std::size_t cuts = places_.size();
        const auto part = [&](std::size_t i) {
            return static_cast<double>(i + 1) / static_cast<double>(cuts + 1);
        };
        for (std::size_t i = 0; i < cuts; ++i) places_[i] = piece.at(part(i));
        values_.resize(cuts);
        f_(places_, values_);
        double worst = 0;
        for (std::size_t i = 0; i < cuts; ++i) {
            require_density(what_, {&places_[i], 1}, values_[i]);
            const double line = (1 - part(i)) * piece.f[0] + part(i) * piece.f[4];
            worst = std::max(worst, std::abs(values_[i] - line));
        }
        constexpr double rounding = 1e-12;
        const double expected = 2 * piece.error() / piece.width();
        if (worst <= expected + rounding * std::ranges::max(piece.f)) return add(piece);
        Sampled cut{piece.low, 0, {piece.f[0]}};
        for (std::size_t i = 0; i <= cuts; ++i) {
            cut.high = i < cuts ? places_[i] : piece.high;
            cut.f[4] = i < cuts ? values_[i] : piece.f[4];
            if (cut.low < cut.high) {
                cut.f[2] = value(cut.at(0.5));
                fill_quarters(cut);
                add(cut);
            }
            cut.low = cut.high;
            cut.f[0] = cut.f[4];
        }
    }

    void fill_quarters(Sampled& piece) const {
        piece.f[1] = value(piece.at(0.25));
        piece.f[3] = value(piece.at(0.75));
    }

    void add(const Sampled& piece) { put(pieces_.size(), piece); }

    /// Stores a piece at an index, or appends it.
    void put(std::size_t index, Sampled piece) {
        piece.gap = has_gap(piece);
        worst_.emplace(piece.error(), index);
        error_ += piece.error();
        mass_ += piece.mass();
        if (index == pieces_.size())
            pieces_.push_back(piece);
        else
            pieces_[index] = piece;
    }

    void refine(double tolerance) {
        while (error_ > tolerance * mass_) {
            const auto [error, index] = worst_.top();
            worst_.pop();
            const Sampled piece = pieces_[index];
            const double middle = piece.at(0.5);
            if (error <= 0) return;  // only rounding errors of the sum are left
            if (!(piece.low < middle && middle < piece.high) || pieces_.size() == most_pieces)
                refuse(piece, tolerance);
            if (pieces_.size() % 1024 == 0) run_.check_stop();
            error_ -= error;
            mass_ -= piece.mass();
            Sampled left{piece.low, middle, {piece.f[0], 0, piece.f[1], 0, piece.f[2]}};
            Sampled right{middle, piece.high, {piece.f[2], 0, piece.f[3], 0, piece.f[4]}};
            fill_quarters(left);
            fill_quarters(right);
            put(index, left);
            add(right);
            if (pieces_.size() % 64 == 0) sum_anew();
        }
    }

    /// Recomputes the sums, because rounding errors from additions and subtractions accumulate.
    void sum_anew() {
        if (pieces_.size() <= 4096 || pieces_.size() % 4096 == 0) sum_all();
    }

    void sum_all() {
        error_ = 0;
        mass_ = 0;
        for (const Sampled& piece : pieces_) {
            error_ += piece.error();
            mass_ += piece.mass();
        }
    }

    [[noreturn]] void refuse(const Sampled& piece, double tolerance) const {
        const double mean = mass_ / width_;
        if (std::ranges::max(piece.f) > 1e6 * mean)
            fail(ErrorKind::usage, "{} has no bound near x = {}; a density must be finite", what_,
                 piece.at(0.5));
        fail_with_hint(
            ErrorKind::limit, "give its jumps by --breaks, or raise --tolerance",
            "{}: --tolerance {} cannot be reached; the error is {:.2g}, largest near x = {}", what_,
            tolerance, error_ / mass_, piece.at(0.5));
    }

    /// True if f is 0 at a sample inside the piece, but not at all samples. A 0 at an end counts
    /// only if f is also 0 at a point close to that end.
    [[nodiscard]] bool has_gap(const Sampled& piece) const {
        constexpr double near = 0x1p-12;
        if (std::ranges::max(piece.f) == 0) return false;
        if (piece.f[1] == 0 || piece.f[2] == 0 || piece.f[3] == 0) return true;
        return (piece.f[0] == 0 && value(piece.at(near)) == 0) ||
               (piece.f[4] == 0 && value(piece.at(1 - near)) == 0);
    }

    const std::string& what_;
    const BlockFunction& f_;
    const RunContext& run_;
    std::vector<Sampled> pieces_;
    std::priority_queue<std::pair<double, std::size_t>> worst_;
    std::vector<double> places_;  ///< positions of probes
    std::vector<double> values_;
    double width_ = 0;  ///< width of the range
    double error_ = 0;
    double mass_ = 0;
};

}  // namespace

void require_density(const std::string& what, std::span<const double> place, double value) {
    if (value >= 0 && std::isfinite(value)) return;
    // Drops the sign of a NaN, which has no meaning.
    const double shown = std::isnan(value) ? std::numeric_limits<double>::quiet_NaN() : value;
    fail(ErrorKind::usage, "{} is {} at {}; a density must be finite and not below 0", what, shown,
         place_text(place));
}

void require_integral(const std::string& what, double integral) {
    if (integral >= 1e-280 && integral <= 1e280) return;
    fail_with_hint(
        ErrorKind::usage, "multiply the formula by a factor, or choose another unit",
        "{}: the integral is about {:.3g}; expected one in [1e-280, 1e280], since others "
        "lose digits",
        what, integral);
}

double largest_bend(const std::array<double, 5>& f) {
    double worst = 0;
    for (std::size_t k = 1; k < 4; ++k) {
        const double part = 0.25 * static_cast<double>(k);
        worst = std::max(worst, std::abs(f[k] - ((1 - part) * f[0] + part * f[4])));
    }
    return worst;
}

std::vector<LinePiece> tabulate_line(const std::string& what, const BlockFunction& f,
                                     const LineRange& range, double tolerance,
                                     const RunContext& run) {
    return LineTabulator(what, f, run).tabulate(range, tolerance);
}

double mass_share(double a, double b, double t) {
    return a + b > 0 ? std::min(t * (2 * a + (b - a) * t) / (a + b), 1.0) : 0;
}

LineTable::LineTable(std::vector<LinePiece> pieces) : pieces_(std::move(pieces)) {
    double top = 0;
    for (const LinePiece& piece : pieces_) top = std::max({top, piece.f_low, piece.f_high});
    // Densities may have any scale. The largest is scaled to 2^500, or less if the range is long,
    // so that masses do not overflow and small densities keep their digits.
    const double range = pieces_.back().x_high - pieces_.front().x_low;
    const int down = std::ilogb(top);
    const int lift = 500 - std::max(0, std::ilogb(range)) - down;
    top = std::ldexp(top, -down);
    std::vector<double> sums;
    double sum = 0;
    for (LinePiece& piece : pieces_) {
        piece.f_low = std::ldexp(piece.f_low, lift) / top;
        piece.f_high = std::ldexp(piece.f_high, lift) / top;
        const double before = sum;
        const double width = piece.x_high - piece.x_low;
        sums.push_back(sum += 0.5 * (piece.f_low + piece.f_high) * width);
        // A quantile depends only on the ratio of f_low and f_high, so both are scaled to keep
        // their squares from overflowing.
        int size = 0;
        std::frexp(std::max(piece.f_low, piece.f_high), &size);
        rows_.push_back({before, sum - before, std::ldexp(piece.f_low, -size),
                         std::ldexp(piece.f_high, -size), piece.x_low, width,
                         std::nextafter(piece.x_high, piece.x_low)});
    }
    masses_ = GuideTable(std::move(sums), 2 * pieces_.size());
}

std::size_t LineTable::piece_of(double x) const {
    const auto above = std::ranges::upper_bound(pieces_, x, {}, &LinePiece::x_low);
    return above == pieces_.begin() ? 0 : static_cast<std::size_t>(above - pieces_.begin()) - 1;
}

double LineTable::density(double x) const {
    const LinePiece& piece = pieces_[piece_of(x)];
    const double t = (x - piece.x_low) / (piece.x_high - piece.x_low);
    return ((1 - t) * piece.f_low + t * piece.f_high) / masses_.total();
}

LineMoments LineTable::moments_of(const std::function<double(double)>& f, double mass) const {
    const double unit = unit_for(pieces_.back().x_high - pieces_.front().x_low);
    const auto expect = [&](double about, std::size_t power) {
        const auto integrand = [&](double x) {
            return f(x) * whole_power((x - about) / unit, power);
        };
        double sum = 0;
        for (const LinePiece& piece : pieces_)
            sum += gauss_kronrod(integrand, piece.x_low, piece.x_high).value;
        return sum / mass;
    };
    const double middle =
        pieces_.front().x_low + 0.5 * (pieces_.back().x_high - pieces_.front().x_low);
    const double mean = middle + unit * expect(middle, 1);
    return {mean, expect(mean, 2), expect(mean, 3), unit};
}

std::vector<std::pair<double, double>> LineTable::positive_intervals() const {
    std::vector<std::pair<double, double>> found;
    for (const LinePiece& piece : pieces_) {
        if (!(piece.f_low + piece.f_high > 0) && !(piece.integral.value > 0)) continue;
        if (!found.empty() && found.back().second == piece.x_low)
            found.back().second = piece.x_high;
        else
            found.emplace_back(piece.x_low, piece.x_high);
    }
    return found;
}

double LineTable::quantile(double u) const {
    quantiles({&u, 1});
    return u;
}

namespace {

constexpr std::size_t batch_size = 128;

/// Data of the pieces for a batch of quantiles, by column, so that loops are vectorised.
struct Batch {
    using Column = std::array<double, batch_size>;
    Column wanted, before, mass, f_low, f_high, x_low, width, last;
};

STIPPLE_WIDE [[gnu::flatten]] void invert(const Batch& of, double* x, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) {
        const double share = (of.wanted[i] - of.before[i]) / of.mass[i];
        const double t = width_share(of.f_low[i], of.f_high[i], share);
        x[i] = std::min(of.x_low[i] + t * of.width[i], of.last[i]);
    }
}

}  // namespace

// Uses two loops, because the search cannot be vectorised, but processors overlap several searches.
void LineTable::quantiles(std::span<double> shares) const {
    Batch batch;
    for (std::size_t first = 0; first < shares.size(); first += batch_size) {
        const std::size_t size = std::min(batch_size, shares.size() - first);
        for (std::size_t i = 0; i < size; ++i) {
            const double wanted = shares[first + i] * masses_.total();
            const Row& row = rows_[masses_.at(wanted)];
            batch.wanted[i] = wanted;
            batch.before[i] = row.before;
            batch.mass[i] = row.mass;
            batch.f_low[i] = row.f_low;
            batch.f_high[i] = row.f_high;
            batch.x_low[i] = row.x_low;
            batch.width[i] = row.width;
            batch.last[i] = row.last;
        }
        invert(batch, shares.data() + first, size);
    }
}

double LineTable::fraction(double x) const {
    const std::size_t i = piece_of(x);
    const LinePiece& piece = pieces_[i];
    const double t = std::clamp((x - piece.x_low) / (piece.x_high - piece.x_low), 0.0, 1.0);
    const double share = mass_share(piece.f_low, piece.f_high, t);
    return std::min((masses_.begin(i) + share * masses_.width(i)) / masses_.total(), 1.0);
}

}  // namespace stipple
