// SPDX-License-Identifier: MIT
#include "generators/stratified/jitter_grid.hpp"

#include "core/error.hpp"
#include "math/functions/powers.hpp"

namespace stipple::generators {

std::uint64_t jitter_columns(std::uint64_t count, const Values& options) {
    if (options.given(shape_option)) return static_cast<std::uint64_t>(options[shape_option][0]);
    const std::uint64_t root = floor_root(count, 2);
    for (std::uint64_t a = root; a * a >= count - a * a; --a)
        if (count % a == 0) return a;
    return root;
}

Plan plan_jitter_grid(const Request& request, const Values& options) {
    if (!options.given(shape_option)) return default_plan(request);
    const auto sides = options[shape_option];
    const std::string text = format_value(Value(sides));
    if (sides.size() != 2)
        fail(ErrorKind::usage, "--shape: {} has {} sides; columns x rows are two", text,
             sides.size());
    std::uint64_t count = 0;
    if (__builtin_mul_overflow(static_cast<std::uint64_t>(sides[0]),
                               static_cast<std::uint64_t>(sides[1]), &count))
        fail(ErrorKind::usage, "--shape: {} has more than 2^64 cells", text);
    if (request.count.value_or(count) != count)
        fail(ErrorKind::usage, "--count: {} contradicts --shape {}, which has {} cells",
             *request.count, text, count);
    return default_plan(request, count);
}

}  // namespace stipple::generators
