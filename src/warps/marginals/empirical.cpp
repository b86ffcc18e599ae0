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
    {.name = "values", .fallback = "0,1,2", .help = "The numbers, the same for all coordinates"}};
constexpr Param<Path> file{
    {.name = "file",
     .fallback = {},
     .help =
         "File whose columns hold the numbers, one column for all coordinates or one for each"}};
constexpr Param<Text> column{
    {.name = "file-columns",
     .fallback = {},
     .help = "Columns of the file, by name or number from 1, separated by commas; default: all"}};
constexpr Param<Choice> interpolation{.name = "interpolation",
                                      .fallback = "steps",
                                      .choices = "steps|linear",
                                      .help =
                                          "steps: only the numbers themselves occur; linear: "
                                          "interpolated between them, which must all differ"};

std::vector<std::vector<double>> columns_of(const Values& options, const RunContext& run) {
    if (!options.given(file)) {
        if (options.given(column))
            fail(ErrorKind::usage, "--file-columns: selects columns of --file, which is not given");
        return {options[numbers]};
    }
    if (options.given(numbers))
        fail(ErrorKind::usage, "--values: cannot be combined with --file; give one of them");
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
            fail(kind, "{}: {} numbers; expected 1 to 2^28", name, column_values.size());
        laws.push_back(measured_law(std::move(column_values), linear, kind, name));
    }
    return marginal_mapping(laws, want.given, want.spec());
}

}  // namespace

Warp unit() {
    return {.name = "empirical",
            .summary = "Distribution of given numbers, on each coordinate, by inversion",
            .source = "Hyndman, Fan 1996, doi:10.1080/00031305.1996.10473566",
            .related = {"data", "resampling", "bootstrap", "quantile"},
            .strata = "xi is used directly, and the numbers are in increasing order",
            .traits = {.discrete = true},
            .options = Schema(numbers, file, column, interpolation),
            .mapping = make};
}

}  // namespace stipple::warps::empirical
