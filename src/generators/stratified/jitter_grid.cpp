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

Plan plan_of_shape(const Request& request, const std::vector<std::int64_t>& sides,
                   std::string_view cells) {
    const std::string text = format_value(Value(sides));
    std::uint64_t count = 1;
    for (const std::int64_t k : sides)
        if (__builtin_mul_overflow(count, static_cast<std::uint64_t>(k), &count))
            fail(ErrorKind::usage, "--shape: {} has more than 2^64 {}", text, cells);
    if (request.count.value_or(count) != count)
        fail(ErrorKind::usage, "--count: {} contradicts --shape {}, which has {} {}",
             *request.count, text, count, cells);
    if (request.dimension.value_or(sides.size()) != sides.size())
        fail(ErrorKind::usage, "--dimension: {} contradicts --shape {}, which has {} directions",
             *request.dimension, text, sides.size());
    return default_plan(request, count, sides.size());
}

Plan plan_jitter_grid(const Request& request, const Values& options) {
    if (!options.given(shape_option)) return default_plan(request);
    const auto sides = options[shape_option];
    if (sides.size() != 2)
        fail(ErrorKind::usage, "--shape: {} has {} sides; columns x rows are two",
             format_value(Value(sides)), sides.size());
    return plan_of_shape(request, sides, "cells");
}

}  // namespace stipple::generators
