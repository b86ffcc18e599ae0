// SPDX-License-Identifier: MIT
//
// Conversion of points, reports and records to and from Python objects.
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

/// Copies the rows of an array (n, d) of finite numbers into a set on the domain with this spec.
PointSet points_of(const Array& rows, const std::string& domain);

/// An array (n, d) that takes over the numbers of a set without copying.
py::array array_of(PointSet points);

/// An array (sets, n, d) if all sets have the same number of points; otherwise a list of arrays.
py::object arrays_of(std::vector<PointSet> sets);

/// Converts JSON to dictionaries, lists, numbers and texts.
py::object object_of(const nlohmann::ordered_json& value);

/// Converts a dictionary made by dict_of() back to a report.
Report report_of(const py::dict& values);

/// Converts a report to a dictionary of flags, numbers, texts, dictionaries and arrays: curves
/// (k,), grids (rows, columns).
py::dict dict_of(const Report& report);

}  // namespace stipple::python
