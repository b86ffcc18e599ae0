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
// Cost    O(1) a coordinate expected, by a guide table; about 9 ns on one core.
// Promise x in [first, last], never inside a piece of mass 0. Forward and back again is the same xi
//         within 1e-14, times max|x| / h of the piece. The same bits on every machine.

#include <cmath>
#include <limits>

#include "core/rng.hpp"
#include "core/spec.hpp"
#include "math/guide_table.hpp"
#include "math/points_file.hpp"
#include "math/running_sums.hpp"
#include "warps/per_coordinate.hpp"
#include "warps/placement.hpp"

namespace stipple::warps {
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

/// Straight pieces with their running masses.
struct Pieces {
    std::vector<double> x;     ///< ends, one more than pieces
    std::vector<double> from;  ///< density of each piece at its ends
    std::vector<double> to;
    std::vector<double> sums;  ///< masses up to each piece's end, over the total; the last is 1
    std::vector<std::uint32_t> starts;
    double total = 0;

    double before(std::size_t i) const { return i > 0 ? sums[i - 1] : 0; }
};

struct Tabulated {
    std::shared_ptr<const Pieces> of;

    bool operator==(const Tabulated&) const = default;

    double forward(double u) const {
        const double inside = std::min(u, one_minus_ulp);
        const std::size_t b = Buckets(1, of->starts.size() - 1).of(inside);
        const std::size_t i = first_above(of->sums, of->starts[b], of->starts[b + 1], inside);
        const double w = std::min((u - of->before(i)) / (of->sums[i] - of->before(i)), 1.0);
        const double f = of->from[i];
        const double g = of->to[i];
        const double below = f + std::sqrt((1 - w) * f * f + w * g * g);
        const double t = below > 0 ? w * (f + g) / below : 0;
        return std::min(of->x[i] + t * (of->x[i + 1] - of->x[i]), of->x[i + 1]);
    }

    /// The piece that x is in; at a seam the one that begins there, if it has a width.
    std::size_t piece(double x) const {
        const auto after = std::upper_bound(of->x.begin() + 1, of->x.end() - 1, x);
        return static_cast<std::size_t>(after - of->x.begin()) - 1;
    }
    double inverse(double x) const {
        const std::size_t i = piece(x);
        const double h = of->x[i + 1] - of->x[i];
        const double f = of->from[i];
        const double g = of->to[i];
        const double t = h > 0 ? (x - of->x[i]) / h : 0;
        const double w = f + g > 0 ? t * (f + f + t * (g - f)) / (f + g) : 0;
        return of->before(i) + w * (of->sums[i] - of->before(i));
    }
    double place(double x) const { return inverse(x); }
    double density(double x) const {
        if (!contains(x)) return 0;
        const std::size_t i = piece(x);
        const double h = of->x[i + 1] - of->x[i];
        const double t = h > 0 ? (x - of->x[i]) / h : 0;
        return ((1 - t) * of->from[i] + t * of->to[i]) / of->total;
    }
    bool contains(double x) const { return x >= of->x.front() && x <= of->x.back(); }
    double measure() const { return of->x.back() - of->x.front(); }
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
        for (std::size_t i = 0; i < of->from.size(); ++i) {
            const double h = of->x[i + 1] - of->x[i];
            for (std::size_t k = 0; k < 3; ++k) {
                const double t = places[k];
                const double mass = h * ((1 - t) * of->from[i] + t * of->to[i]) / of->total;
                sum += weights[k] * mass * f(of->x[i] + t * h);
            }
        }
        return sum;
    }
    std::pair<double, double> range() const { return {of->x.front(), of->x.back()}; }

    /// Neighbouring pieces where the density is not 0, as one.
    std::vector<std::pair<double, double>> parts() const {
        std::vector<std::pair<double, double>> found;
        for (std::size_t i = 0; i < of->from.size(); ++i) {
            if (!(of->from[i] + of->to[i] > 0) || !(of->x[i] < of->x[i + 1])) continue;
            if (!found.empty() && found.back().second == of->x[i])
                found.back().second = of->x[i + 1];
            else
                found.emplace_back(of->x[i], of->x[i + 1]);
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
        fail(kind, "{}: {} rows; 2 to 2^28 are needed", name, table.size());
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
        of->x.push_back(table[i][0] + 0.0);  // -0 would show in points
        of->from.push_back(table[i][1]);
        of->to.push_back(table[linear ? i + 1 : i][1]);
        masses.push_back(0.5 * (of->from[i] + of->to[i]) * (table[i + 1][0] - table[i][0]));
    }
    of->x.push_back(table.back()[0] + 0.0);
    of->sums = running_sums(masses);
    of->total = of->sums.back();
    if (!(of->total > 1e-290 && of->total < 1e290))
        fail(kind, "{}: the density's integral is {}; it must be in [1e-290, 1e290]", name,
             of->total);
    for (double& sum : of->sums) sum /= of->total;
    of->starts.resize(2 * of->sums.size() + 1);
    fill_guide(of->sums, of->starts);
    return of;
}

std::unique_ptr<Mapping> make(const Values& options, std::size_t given, const RunContext& run) {
    return std::make_unique<LineMapping<Tabulated>>(std::make_shared<LineDomain<Tabulated>>(
        std::vector<Tabulated>(given, Tabulated{pieces_of(options, run)}),
        format_spec("table-1d", options, schema()), "probability below x"));
}

}  // namespace

Warp table_1d() {
    return {.name = "table-1d",
            .summary = "Density from a table, on each coordinate, by exact inversion",
            .source = "Inverse of a distribution function of straight or parabolic pieces",
            .strata = "xi is the probability below x, as it is: xi = 0 is the lower end",
            .traits = {},
            .options = schema(),
            .make = make};
}

}  // namespace stipple::warps
