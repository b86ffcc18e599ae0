// SPDX-License-Identifier: MIT
#include "warps/common_options.hpp"

#include "core/error.hpp"
#include "core/spec.hpp"

namespace stipple::warps {

void refuse_far(double x, double reach) {
    if (x + reach == x || x - reach == x)
        fail(ErrorKind::usage, "--center: {} is so far that a radius of {} is lost in rounding", x,
             reach);
}

std::vector<double> one_for_each(const Param<Numbers>& option, std::vector<double> numbers,
                                 std::size_t d) {
    if (numbers.size() == 1) return std::vector<double>(d, numbers[0]);
    if (numbers.size() != d)
        fail(ErrorKind::usage, "--{}: {} numbers for {} coordinates; one for all, or one for each",
             option.name, numbers.size(), d);
    return numbers;
}

std::string domain_spec(std::string_view name, const Values& options, const Schema& schema,
                        std::initializer_list<std::string_view> which) {
    Values law = schema.defaults();
    for (const std::string_view option : which) {
        const auto& item = options.find(option);
        law.put(option, item.value, item.given);
    }
    return format_spec(name, law, schema);
}

}  // namespace stipple::warps
