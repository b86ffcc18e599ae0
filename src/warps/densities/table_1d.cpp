// SPDX-License-Identifier: MIT
//
// Unit cube onto an interval, each coordinate by itself, with a density given by a table of rows
// x_i, f_i, by exact inversion in each piece [x_i, x_i+1] of mass M_i:
//
//     linear    the density is straight between rows: M_i = (f_i + f_i+1) h_i / 2
//     constant  the density is f_i from x_i on up to x_i+1; the last f is not used
//
// The piece is the first whose running mass is above xi times the total. With w the share of its
// mass below x and t = (x - x_i) / h_i,
//
//     t = w (f_i + f_i+1) / (f_i + sqrt((1 - w) f_i^2 + w f_i+1^2)),      constant: t = w,
//
// the solution of a quadratic without a difference. Densities may have any scale: they are divided
// by their integral.
//
// Shape   any number of coordinates by the same law; 2 rows or more, x rising. Where linear, two
//         rows may have the same x: a jump.
// Strata  xi is the probability below x, taken as it is, not as 1 - xi; strata become intervals of
//         equal probability in the same order.
// Cost    O(1) a coordinate expected, by a guide table; about 5 ns on one core.
// Promise x in [first, last], never inside a piece of mass 0. Forward and back again is the same xi
//         within 1e-14, times max|x| / h of the piece. The same bits on every machine.

#include <cmath>
#include <limits>

#include "core/rng.hpp"
#include "core/spec.hpp"
#include "math/densities/guide_table.hpp"
#include "math/functions/running_sums.hpp"
#include "media/points_file.hpp"
#include "warps/curved/placement.hpp"
#include "warps/densities/per_coordinate.hpp"

namespace stipple::warps::table_1d {
namespace {

constexpr Param<Points> rows{
    {.name = "rows",
     .fallback = "0,2 1,0",
     .help = "The table: x,density x,density ..., x rising; the density may have any scale"}};

constexpr Param<Path> file{{.name = "file",
                            .fallback = {},
                            .help = "The table from a CSV file with a row x,density a line"}};

constexpr Param<Choice> interpolation{
    .name = "interpolation",
    .fallback = "linear",
    .choices = "linear|constant",
    .help = "linear: straight between rows; constant: each density holds up to the next x"};

const Schema& schema() {
    static const Schema options(rows, file, interpolation);
    return options;
}

/// A straight piece: one line of the caches.
struct alignas(64) Piece {
    double before = 0;  ///< mass before it, over the total
    double after = 0;   ///< and with it; of the last piece, 1
    double from = 0;    ///< density at its ends
    double to = 0;
    double begin = 0;
    double end = 0;

    /// At t of the way, before it is divided by the total.
    [[nodiscard]] double density(double t) const { return (1 - t) * from + t * to; }
};

struct Pieces {
    std::vector<Piece> list;
    std::vector<double> sums;  ///< masses up to each piece's end, over the total; the last is 1
    std::vector<std::uint32_t> starts;
    std::size_t few = few_sums;  ///< that a bucket of the sums has at most, if it is few
    Buckets buckets;
    double total = 0;
};

struct Tabulated {
    std::shared_ptr<const Pieces> of;

    bool operator==(const Tabulated&) const = default;

    /// The numbers of the piece that u falls in.
    std::array<double, 6> start(double u) const {
        const double inside = std::min(u, one_minus_ulp);
        const std::size_t b = of->buckets.of(inside);
        const Piece& p =
            of->list[first_above(of->sums, of->starts[b], of->starts[b + 1], inside, of->few)];
        return {p.before, p.after, p.from, p.to, p.begin, p.end};
    }
    double finish(double u, const std::array<double, 6>& piece) const {
        const auto [before, after, f, g, begin, end] = piece;
        const double w = std::min((u - before) / (after - before), 1.0);
        const double below = f + std::sqrt((1 - w) * f * f + w * g * g);
        const double t = below > 0 ? w * (f + g) / below : 0;
        return std::min(begin + t * (end - begin), end);
    }

    /// The piece that x is in; at a seam the one that begins there, if it has a width.
    const Piece& piece(double x) const {
        const auto after =
            std::ranges::upper_bound(of->list.begin() + 1, of->list.end(), x, {}, &Piece::begin);
        return *(after - 1);
    }
    double inverse(double x) const {
        const auto& [before, after, f, g, begin, end] = piece(x);
        const double t = end > begin ? (x - begin) / (end - begin) : 0;
        const double w = f + g > 0 ? t * (f + f + t * (g - f)) / (f + g) : 0;
        return before + w * (after - before);
    }
    double place(double x) const { return inverse(x); }
    double density(double x) const {
        if (!contains(x)) return 0;
        const Piece& p = piece(x);
        const double h = p.end - p.begin;
        return p.density(h > 0 ? (x - p.begin) / h : 0) / of->total;
    }
    bool contains(double x) const { return x >= range().first && x <= range().second; }
    double measure() const { return range().second - range().first; }
    LineMoments moments() const {
        LineMoments m{.mean = sum_over([](double x) { return x; })};
        const double c = m.mean;
        m.variance = sum_over([c](double x) { return (x - c) * (x - c); });
        m.third = sum_over([c](double x) { return (x - c) * (x - c) * (x - c); });
        return m;
    }

    /// E f, exact for polynomials of degree 4, by Gauss's rule of 3 points on each piece.
    template <class F>
    double sum_over(const F& f) const {
        constexpr double places[] = {0.1127016653792583, 0.5, 0.8872983346207417};
        constexpr double weights[] = {5 / 18.0, 8 / 18.0, 5 / 18.0};
        double sum = 0;
        for (const Piece& p : of->list) {
            const double h = p.end - p.begin;
            for (std::size_t k = 0; k < 3; ++k) {
                const double t = places[k];
                sum += weights[k] * h * p.density(t) / of->total * f(p.begin + t * h);
            }
        }
        return sum;
    }
    std::pair<double, double> range() const {
        return {of->list.front().begin, of->list.back().end};
    }

    /// Neighbouring pieces where the density is not 0, as one.
    std::vector<std::pair<double, double>> parts() const {
        std::vector<std::pair<double, double>> found;
        for (const Piece& p : of->list) {
            if (!(p.from + p.to > 0) || !(p.begin < p.end)) continue;
            if (!found.empty() && found.back().second == p.begin)
                found.back().second = p.end;
            else
                found.emplace_back(p.begin, p.end);
        }
        return found;
    }
};

/// Numbers of the table in order, with the name that messages give it. @throws Error
Table table_of(const Values& options, const std::string& name, const RunContext& run) {
    Table table = options[rows];
    if (options.given(file)) {
        if (options.given(rows))
            fail(ErrorKind::usage, "--rows: --file is given, too; one of them is allowed");
        const PointSet read = read_points(options[file], run);
        table.clear();
        for (std::size_t i = 0; i < read.count(); ++i)
            table.emplace_back(read[i].begin(), read[i].end());
    }
    const auto kind = options.given(file) ? ErrorKind::input : ErrorKind::usage;
    if (table[0].size() != 2)
        fail(kind, "{}: rows of {} numbers; 2 are needed, x,density", name, table[0].size());
    if (table.size() < 2 || table.size() > (std::size_t{1} << 28))
        fail(kind, "{}: the table has {} row{}; 2 to 2^28 are needed", name, table.size(),
             table.size() == 1 ? "" : "s");
    return table;
}

void check_rows(const Table& table, bool linear, ErrorKind kind, const std::string& name) {
    for (std::size_t i = 0; i < table.size(); ++i) {
        if (!(std::abs(table[i][0]) <= 1e150))
            fail(kind, "{}: row {} has x = {}, outside [-1e150, 1e150]", name, i + 1, table[i][0]);
        if (!(table[i][1] >= 0 && table[i][1] <= 1e150))
            fail(kind, "{}: row {} has the density {}; [0, 1e150] is allowed", name, i + 1,
                 table[i][1]);
        if (i == 0) continue;
        const double before = table[i - 1][0];
        if (table[i][0] < before || (!linear && table[i][0] == before))
            fail(kind, "{}: row {} has x = {} after {}; x must rise", name, i + 1, table[i][0],
                 before);
    }
}

std::shared_ptr<const Pieces> pieces_of(const Values& options, const RunContext& run) {
    const std::string name = options.given(file) ? options[file] : "--rows";
    const auto kind = options.given(file) ? ErrorKind::input : ErrorKind::usage;
    const bool linear = std::string(options[interpolation]) == "linear";
    const Table table = table_of(options, name, run);
    check_rows(table, linear, kind, name);

    auto of = std::make_shared<Pieces>();
    std::vector<double> masses;
    for (std::size_t i = 0; i + 1 < table.size(); ++i) {
        const Piece p{.from = table[i][1],
                      .to = table[linear ? i + 1 : i][1],
                      .begin = table[i][0] + 0.0,  // -0 would show in points
                      .end = table[i + 1][0] + 0.0};
        of->list.push_back(p);
        masses.push_back(0.5 * (p.from + p.to) * (p.end - p.begin));
    }
    of->sums = running_sums(masses);
    of->total = of->sums.back();
    if (!(of->total > 1e-290 && of->total < 1e290))
        fail(kind, "{}: the density's integral is {}; it must be in [1e-290, 1e290]", name,
             of->total);
    double before = 0;
    for (std::size_t i = 0; i < of->sums.size(); ++i) {
        of->list[i].before = std::exchange(before, of->sums[i] /= of->total);
        of->list[i].after = before;
    }
    of->starts.resize(2 * of->sums.size() + 1);
    of->few = fill_guide(of->sums, of->starts);
    of->buckets = Buckets(1, of->starts.size() - 1);
    return of;
}

std::unique_ptr<Mapping> make(const Values& options, std::size_t given, const RunContext& run) {
    return std::make_unique<LineMapping<Tabulated>>(std::make_shared<LineDomain<Tabulated>>(
        std::vector<Tabulated>(given, Tabulated{pieces_of(options, run)}),
        format_spec("table-1d", options, schema()), "probability below x"));
}

}  // namespace

Warp unit() {
    return {.name = "table-1d",
            .summary = "Density from a table, on each coordinate, by exact inversion",
            .source = "Inverse of a distribution function of straight or parabolic pieces",
            .strata = "xi is the probability below x, as it is: xi = 0 is the lower end",
            .traits = {},
            .options = schema(),
            .make = make};
}

}  // namespace stipple::warps::table_1d
