// SPDX-License-Identifier: MIT
#include "math/integrands/integrands.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/text.hpp"

namespace stipple {
namespace {

std::vector<IntegrandKind> collected() {
    std::vector<IntegrandKind> kinds = genz_integrands();
    for (auto&& family : {planar_integrands(), smooth_integrands()})
        kinds.insert(kinds.end(), family.begin(), family.end());
    return kinds;
}

}  // namespace

const std::vector<IntegrandKind>& integrand_kinds() {
    static const std::vector<IntegrandKind> kinds = collected();
    return kinds;
}

void require_normal(double exact, std::string_view name, std::size_t dimension) {
    if (!std::isnormal(exact))
        fail(ErrorKind::usage,
             "--integrand: {}: its integral in dimension {} is too {} for float64", name, dimension,
             exact < 1 ? "small" : "large");
}

const IntegrandKind& integrand_kind(std::string_view name) {
    const auto& kinds = integrand_kinds();
    const auto it = std::ranges::find(kinds, name, &IntegrandKind::name);
    if (it != kinds.end()) return *it;
    std::vector<std::string> names;
    for (const IntegrandKind& kind : kinds) names.push_back(kind.name);
    fail_with_hint(ErrorKind::usage, suggest(name, names), "'{}' is not an integrand", name);
}

}  // namespace stipple
