#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <span>

#include "coupler/participant.hpp"

/// What crosses between Python and the participant interface: surfaces and declarations by value, fields as
/// views of the shared memory.
namespace talus::python {

namespace py = pybind11;

/// Any array of numbers that NumPy can turn into doubles, or into node indices, in rows of one length.
using DoubleArray = py::array_t<double, py::array::c_style | py::array::forcecast>;
using IndexArray = py::array_t<mesh::Index, py::array::c_style | py::array::forcecast>;

/// From the attributes of talus.Surface (python/participant/description.py).
/// @throws UsageError where an array has another shape
mesh::Surface surface_from(const py::object& surface);
py::dict surface_arrays(const mesh::Surface& surface);
py::list surface_parts(const mesh::Surface& surface);

/// From the attributes of talus.Declaration (python/participant/description.py).
coupler::Declaration declaration_from(const py::object& declaration);

/// An array of `columns` values a row (0: one-dimensional) over memory that `owner` keeps alive. No copy.
py::array view(std::span<double> values, std::size_t columns, const py::object& owner);
py::array view(std::span<const double> values, std::size_t columns, const py::object& owner);

}  // namespace talus::python
