// SPDX-License-Identifier: MIT
#include "python/conversion.hpp"

#include <algorithm>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>
#include <variant>

#include "pipeline/chain.hpp"

namespace stipple::python {
namespace {

/// An array that views `numbers` and keeps their owner alive.
template <class T, class Owner>
py::array array_over(std::vector<py::ssize_t> shape, const T* numbers,
                     std::unique_ptr<Owner> owner) {
    const py::capsule keeper(owner.get(), [](void* held) { delete static_cast<Owner*>(held); });
    owner.release();
    return py::array_t<T>(std::move(shape), numbers, keeper);
}

template <class T>
py::array array_of_vector(const std::vector<T>& numbers, std::vector<py::ssize_t> shape) {
    auto owner = std::make_unique<std::vector<T>>(numbers);
    const T* first = owner->data();
    return array_over(std::move(shape), first, std::move(owner));
}

template <class T>
std::vector<T> vector_of(const py::array& array) {
    const py::array_t<T, py::array::c_style | py::array::forcecast> numbers(array);
    return {numbers.data(), numbers.data() + numbers.size()};
}

struct ItemToObject {
    py::object operator()(bool flag) const { return py::bool_(flag); }
    py::object operator()(std::int64_t number) const { return py::int_(number); }
    py::object operator()(double number) const { return py::float_(number); }
    py::object operator()(const std::string& text) const { return py::str(text); }
    py::object operator()(const Report::Curve& curve) const {
        return array_of_vector(curve, {static_cast<py::ssize_t>(curve.size())});
    }
    py::object operator()(const Report::Integers& numbers) const {
        return array_of_vector(numbers, {static_cast<py::ssize_t>(numbers.size())});
    }
    py::object operator()(const Grid& grid) const {
        return array_of_vector(grid.values, {static_cast<py::ssize_t>(grid.rows),
                                             static_cast<py::ssize_t>(grid.columns)});
    }
    py::object operator()(const Report& group) const { return dict_of(group); }
};

}  // namespace

PointSet points_of(const Array& rows, const std::string& domain) {
    const auto n = static_cast<std::size_t>(rows.shape(0));
    const auto d = static_cast<std::size_t>(rows.shape(1));
    PointSet points(Rows::unwritten(n, d), d);
    std::copy_n(rows.data(), n * d, points.flat().begin());
    points.domain = parse_domain(domain, d);
    return points;
}

py::array array_of(PointSet points) {
    auto owner = std::make_unique<PointSet>(std::move(points));
    const double* first = owner->flat().data();
    std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(owner->count()),
                                      static_cast<py::ssize_t>(owner->dimension())};
    return array_over(std::move(shape), first, std::move(owner));
}

py::object arrays_of(std::vector<PointSet> sets) {
    const std::size_t n = sets.front().count();
    const std::size_t d = sets.front().dimension();
    if (std::ranges::any_of(sets, [&](const PointSet& set) { return set.count() != n; })) {
        py::list arrays;
        for (PointSet& set : sets) arrays.append(array_of(std::move(set)));
        return arrays;
    }
    auto owner = std::make_unique<std::vector<double>>();
    owner->reserve(sets.size() * n * d);
    for (PointSet& set : sets) {
        owner->insert(owner->end(), set.flat().begin(), set.flat().end());
        set = {};
    }
    const double* first = owner->data();
    return array_over({static_cast<py::ssize_t>(sets.size()), static_cast<py::ssize_t>(n),
                       static_cast<py::ssize_t>(d)},
                      first, std::move(owner));
}

py::object object_of(const nlohmann::ordered_json& value) {
    if (value.is_object()) {
        py::dict all;
        for (const auto& [key, item] : value.items()) all[py::str(key)] = object_of(item);
        return all;
    }
    if (value.is_array()) {
        py::list all;
        for (const auto& item : value) all.append(object_of(item));
        return all;
    }
    if (value.is_string()) return py::str(value.get<std::string>());
    if (value.is_boolean()) return py::bool_(value.get<bool>());
    if (value.is_number_unsigned()) return py::int_(value.get<std::uint64_t>());
    if (value.is_number_integer()) return py::int_(value.get<std::int64_t>());
    if (value.is_number()) return py::float_(value.get<double>());
    return py::none();
}

Report report_of(const py::dict& values) {
    Report report;
    for (const auto& [key, value] : values) {
        const auto name = key.cast<std::string>();
        if (py::isinstance<py::dict>(value)) {
            report.add(name, report_of(value.cast<py::dict>()));
        } else if (py::isinstance<py::array>(value)) {
            const auto array = value.cast<py::array>();
            if (array.ndim() == 2)
                report.add(
                    name, Grid{static_cast<std::size_t>(array.shape(0)),
                               static_cast<std::size_t>(array.shape(1)), vector_of<double>(array)});
            else if (array.dtype().kind() == 'i')
                report.add(name, vector_of<std::int64_t>(array));
            else
                report.add(name, vector_of<double>(array));
        } else if (py::isinstance<py::bool_>(value)) {
            report.add(name, value.cast<bool>());
        } else if (py::isinstance<py::int_>(value)) {
            report.add(name, value.cast<std::int64_t>());
        } else if (py::isinstance<py::float_>(value)) {
            report.add(name, value.cast<double>());
        } else {
            report.add(name, value.cast<std::string>());
        }
    }
    return report;
}

py::dict dict_of(const Report& report) {
    py::dict all;
    for (const auto& [name, value, unit] : report.entries())
        all[py::str(name)] = std::visit(ItemToObject(), value);
    return all;
}

}  // namespace stipple::python
