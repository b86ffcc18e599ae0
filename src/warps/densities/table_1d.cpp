// SPDX-License-Identifier: MIT
//
// Unit cube onto an interval, each coordinate independently, with a density given by a table of
// rows x_i, f_i, by exact inversion (math/densities/line_table.hpp):
//
//     linear    the density is linear between rows
//     constant  the density is f_i from x_i up to x_i+1; the last f is not used
//
// Densities may have any scale: they are divided by their integral.
//
// Shape   any number of coordinates, all with the same distribution; at least 2 rows, x ascending.
//         If linear, two rows may have the same x: a jump.
// Strata  xi is the probability below x, used directly, not as 1 - xi; strata become intervals of
//         equal probability in the same order.
// Cost    O(1) a coordinate on average, with a guide table; about 5 ns on one core.
// Promise x in [first, last], last only for xi = 1; never inside a piece of mass 0. A round trip
//         returns the same xi within 1e-14 times max|x| / (width of the piece). The same bits on
//         every machine.

#include <array>
#include <cmath>
#include <cstdint>

#include "core/error.hpp"
#include "io/files.hpp"
#include "math/densities/line_table.hpp"
#include "warps/line_domain.hpp"

namespace stipple::warps::table_1d {
namespace {

constexpr Param<Points> rows{
    {.name = "rows",
     .fallback = "0,2 1,0",
     .help = "Table: x,density x,density ..., x increasing; the density may have any scale"}};

constexpr Param<Path> file{
    {.name = "file", .fallback = {}, .help = "CSV file of the table, with x,density on each line"}};

constexpr Param<Choice> interpolation{
    .name = "interpolation",
    .fallback = "linear",
    .choices = "linear|constant",
    .help =
        "linear: density interpolated between rows; constant: each density holds up to the next x"};

struct Tabulated final : LineDistribution {
    explicit Tabulated(LineTable pieces) : table(std::move(pieces)) {}

    LineTable table;

    /// xi = 1 maps to the upper end.
    void forward_all(std::span<double> numbers) const {
        std::array<std::uint8_t, 256> is_one;
        for (std::size_t first = 0; first < numbers.size(); first += is_one.size()) {
            const auto some =
                numbers.subspan(first, std::min(is_one.size(), numbers.size() - first));
            for (std::size_t i = 0; i < some.size(); ++i) is_one[i] = some[i] >= 1;
            table.quantiles(some);
            for (std::size_t i = 0; i < some.size(); ++i)
                if (is_one[i] != 0) some[i] = table.pieces().back().x_high;
        }
    }
    double inverse(double x) const override { return table.fraction(x); }
    double density(double x) const override { return contains(x) ? table.density(x) : 0; }
    std::pair<double, double> range() const override {
        return {table.pieces().front().x_low, table.pieces().back().x_high};
    }
    LineMoments moments() const override {
        return table.moments_of([this](double x) { return table.density(x); }, 1);
    }
    Positive positive() const override { return all_of(table.positive_intervals()); }
};

/// Returns the table's rows, from --rows or --file; `name` is for messages. @throws Error
Table table_of(const Values& options, const std::string& name, const RunContext& run) {
    Table table = options[rows];
    if (options.given(file)) {
        if (options.given(rows))
            fail(ErrorKind::usage, "--rows: cannot be combined with --file; give one of them");
        const PointSet read = io::read_given(file.name, options[file], {.all_columns = true}, run);
        table.clear();
        for (std::size_t i = 0; i < read.count(); ++i)
            table.emplace_back(read[i].begin(), read[i].end());
    }
    const auto kind = options.given(file) ? ErrorKind::input : ErrorKind::usage;
    if (table[0].size() != 2)
        fail(kind, "{}: rows of {} numbers; expected 2, x,density", name, table[0].size());
    if (table.size() < 2 || table.size() > (std::size_t{1} << 28))
        fail(kind, "{}: the table has {} row{}; expected 2 to 2^28", name, table.size(),
             table.size() == 1 ? "" : "s");
    return table;
}

void check_rows(const Table& table, bool linear, ErrorKind kind, const std::string& name) {
    for (std::size_t i = 0; i < table.size(); ++i) {
        if (!(std::abs(table[i][0]) <= 1e150))
            fail(kind, "{}: row {} has x = {}, outside [-1e150, 1e150]", name, i + 1, table[i][0]);
        if (!(table[i][1] >= 0 && table[i][1] <= 1e150))
            fail(kind, "{}: row {} has the density {}; expected [0, 1e150]", name, i + 1,
                 table[i][1]);
        if (i == 0) continue;
        const double before = table[i - 1][0];
        if (table[i][0] < before || (!linear && table[i][0] == before))
            fail(kind, "{}: row {} has x = {} after {}; x must increase", name, i + 1, table[i][0],
                 before);
    }
}

LineTable table_from(const Values& options, const RunContext& run) {
    const std::string name = options.given(file) ? options[file] : "--rows";
    const auto kind = options.given(file) ? ErrorKind::input : ErrorKind::usage;
    const bool linear = std::string(options[interpolation]) == "linear";
    const Table rows_given = table_of(options, name, run);
    check_rows(rows_given, linear, kind, name);
    std::vector<LinePiece> pieces;
    double mass = 0;
    for (std::size_t i = 0; i + 1 < rows_given.size(); ++i) {
        const auto& row = rows_given[i];
        const auto& next = rows_given[i + 1];
        if (!(row[0] < next[0])) continue;        // a jump between two rows of equal x
        pieces.push_back({.x_low = row[0] + 0.0,  // + 0.0 avoids -0 in the points
                          .x_high = next[0] + 0.0,
                          .f_low = row[1],
                          .f_high = linear ? next[1] : row[1]});
        mass += 0.5 * (pieces.back().f_low + pieces.back().f_high) * (next[0] - row[0]);
    }
    if (!(mass > 1e-290 && mass < 1e290))
        fail(kind, "{}: the integral of the density is {}; expected [1e-290, 1e290]", name, mass);
    return LineTable(std::move(pieces));
}

std::unique_ptr<Mapping> make(const WarpRequest& want) {
    const auto law = std::make_shared<const Tabulated>(table_from(want.options, want.run));
    return line_mapping(std::vector{law}, want.given, want.spec(), "probability below x");
}

}  // namespace

Warp unit() {
    return {.name = "table-1d",
            .summary = "Density from a table, on each coordinate, by exact inversion",
            .source = "Inverse of a distribution function with linear or parabolic pieces",
            .related = {"histogram", "inverse-cdf", "empirical", "piecewise-constant"},
            .strata = "xi is the probability below x, used directly: xi = 0 is the lower end",
            .options = Schema(rows, file, interpolation),
            .stream_version = 2,
            .mapping = make};
}

}  // namespace stipple::warps::table_1d
