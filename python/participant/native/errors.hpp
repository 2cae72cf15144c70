#pragma once

#include <pybind11/pybind11.h>

#include <functional>

/// Errors keep their kind and their text on the way between C++ and Python (classes of talus_participant/errors.py).
namespace talus::python {

/// From here on the C++ errors of core/errors.hpp arrive in Python as the classes of the same names.
void register_errors();

/// Calls `use` with the C++ error that stands for a Python exception: ConfigError and NumericalError as such,
/// any other as a text that begins with the exception's type.
void with_error(const pybind11::object& exception, const std::function<void(const std::exception&)>& use);

}  // namespace talus::python
