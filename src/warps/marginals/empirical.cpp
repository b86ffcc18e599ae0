// SPDX-License-Identifier: MIT
//
// Unit cube onto the distribution of measured numbers, each coordinate independently: for n numbers
// x_0 <= ... <= x_n-1,
//
//     steps   x_i for xi in [i / n, (i + 1) / n): each number as often as it occurs
//     linear  x_i + (h - i) (x_i+1 - x_i),  h = xi (n - 1),  i = floor(h): linear interpolation
//
// Shape   any number of coordinates; one column for all or one for each; linear requires at least 2
//         numbers, all distinct.
// Strata  xi is used directly, in the order of the numbers.
// Cost    O(1) a coordinate on average, with a guide table; about 5 ns on one core for few numbers.
// Promise steps: n strata give each number as often as it occurs. The same bits on every machine.
// Source  linear: definition 7 of R. J. Hyndman, Y. Fan, The American Statistician 50 (1996)
//         361-365, doi:10.1080/00031305.1996.10473566.

#include "core/error.hpp"
#include "core/text.hpp"
#include "io/files.hpp"
#include "math/distributions/families.hpp"
#include "warps/marginal_mapping.hpp"

namespace stipple::warps::empirical {
namespace {

constexpr Param<Numbers> numbers{
    {.name = "values", .fallback = "0,1,2", .help = "The numbers, for all coordinates"}};
constexpr Param<Path> file{
    {.name = "file",
     .fallback = {},
     .help = "The numbers from the columns of a file, one for all coordinates or one for each"}};
constexpr Param<Text> column{
    {.name = "file-columns",
     .fallback = {},
     .help = "Which columns of the file: names or numbers from 1, with commas; default: all"}};
constexpr Param<Choice> interpolation{
    .name = "interpolation",
    .fallback = "steps",
    .choices = "steps|linear",
    .help = "steps: the numbers alone; linear: straight between them, no two the same"};

std::vector<std::vector<double>> columns_of(const Values& options, const RunContext& run) {
    if (!options.given(file)) {
        if (options.given(column))
            fail(ErrorKind::usage,
                 "--file-columns: there is no --file, whose columns it would name");
        return {options[numbers]};
    }
    if (options.given(numbers))
        fail(ErrorKind::usage, "--values: --file is given, too; one of them is allowed");
    ReadOptions how{.all_columns = true};
    const std::string names = options[column];
    for (const std::string_view name : split(names, ',')) how.columns.emplace_back(trim(name));
    const PointSet read = io::read_given(file.name, options[file], how, run);
    std::vector<std::vector<double>> columns(read.dimension());
    for (std::size_t i = 0; i < read.count(); ++i)
        for (std::size_t k = 0; k < columns.size(); ++k) columns[k].push_back(read[i][k]);
    return columns;
}

std::unique_ptr<Mapping> make(const WarpRequest& want) {
    const bool from_file = want.options.given(file);
    const std::string name = from_file ? want.options[file] : "--values";
    const auto kind = from_file ? ErrorKind::input : ErrorKind::usage;
    const bool linear = std::string(want.options[interpolation]) == "linear";
    std::vector<MarginalPtr> laws;
    for (auto& column_values : columns_of(want.options, want.run)) {
        if (column_values.empty() || column_values.size() > (std::size_t{1} << 28))
            fail(kind, "{}: {} numbers; 1 to 2^28 are needed", name, column_values.size());
        laws.push_back(measured_law(std::move(column_values), linear, kind, name));
    }
    return marginal_mapping(laws, want.given, want.spec());
}

}  // namespace

Warp unit() {
    return {.name = "empirical",
            .summary = "The distribution of given numbers, on each coordinate, by inversion",
            .source = "Hyndman, Fan 1996, doi:10.1080/00031305.1996.10473566",
            .related = {"data", "resampling", "bootstrap", "quantile"},
            .strata = "numbers lie side by side in their order, xi as it is",
            .traits = {.discrete = true},
            .options = Schema(numbers, file, column, interpolation),
            .mapping = make};
}

}  // namespace stipple::warps::empirical
