// SPDX-License-Identifier: MIT
//
// Points, reports and records as Python has them.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "stipple/points.hpp"
#include "stipple/report.hpp"

namespace stipple::python {

namespace py = pybind11;

using Array = py::array_t<double, py::array::c_style>;

/// The rows of an array (n, d) of finite numbers, copied; on a domain, as a spec.
PointSet points_of(const Array& rows, const std::string& domain);

/// An array (n, d) that owns the numbers of a set, which are not copied.
py::array array_of(PointSet points);

/// An array (sets, n, d) where all sets have as many points; else a list of arrays.
py::object arrays_of(std::vector<PointSet> sets);

/// Dictionaries, lists, numbers and texts.
py::object object_of(const nlohmann::ordered_json& value);

/// A dictionary of flags, numbers, texts, dictionaries and arrays: curves (k,), grids (rows, columns).
py::dict dict_of(const Report& report);

}  // namespace stipple::python
