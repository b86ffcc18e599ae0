// SPDX-License-Identifier: MIT
#include "warps/warp.hpp"

#include <fmt/ranges.h>

#include "core/error.hpp"
#include "core/spec.hpp"

namespace stipple {

void Mapping::check_way_back() const {
    if (!no_way_back_.empty()) fail(ErrorKind::usage, "--inverse: {}", no_way_back_);
}

void Mapping::refuse_outside(std::span<const double> point) const {
    fail(ErrorKind::input, "the point ({}) is outside the domain {}", fmt::join(point, ", "),
         domain_->spec());
}

void Mapping::expect_inside(std::span<const double> image) const {
    check_way_back();
    const std::size_t m = domain_->dimension();
    for (std::size_t i = 0; i + m <= image.size(); i += m)
        if (!domain_->contains(image.subspan(i, m))) refuse_outside(image.subspan(i, m));
}

void Mapping::inverse(std::span<const double> image, std::span<double> cube) const {
    expect_inside(image);
    const std::size_t d = domain_->cube_dimension();
    const std::size_t m = domain_->dimension();
    for (std::size_t i = 0; i < image.size() / m; ++i)
        domain_->to_cube(image.subspan(m * i, m), cube.subspan(d * i, d));
}

std::string WarpRequest::spec() const { return format_spec(warp.name, options, warp.options); }

std::string WarpRequest::spec(std::initializer_list<std::string_view> which) const {
    Values some = warp.options.defaults();
    for (const std::string_view option : which) {
        const auto& item = options.find(option);
        some.put(option, item.value, item.given);
    }
    return format_spec(warp.name, some, warp.options);
}

}  // namespace stipple
