#include "python/talus_participant/native/errors.hpp"

#include <stdexcept>
#include <string>

#include "core/errors.hpp"

namespace talus::python {
namespace py = pybind11;
namespace {

py::object error_class(const char* name) {
  return py::module_::import("talus.errors").attr(name);
}

void raise(const char* class_name, const std::exception& error) {
  PyErr_SetString(error_class(class_name).ptr(), error.what());
}

core::NumericalError numerical_error(const py::object& exception) {
  return core::NumericalError({.what = exception.attr("what").cast<std::string>(),
                               .entity = exception.attr("entity").cast<std::string>(),
                               .step = exception.attr("step").cast<std::int64_t>(),
                               .time = exception.attr("time").cast<double>(),
                               .value = exception.attr("value").cast<double>()});
}

}  // namespace

void register_errors() {
  py::register_exception_translator([](std::exception_ptr pointer) {
    try {
      std::rethrow_exception(pointer);
    } catch (const core::ConfigError& error) {
      raise("ConfigError", error);
    } catch (const core::TransportError& error) {
      raise("TransportError", error);
    } catch (const core::UsageError& error) {
      raise("UsageError", error);
    }
  });
}

void with_error(const py::object& exception, const std::function<void(const std::exception&)>& use) {
  const auto text = py::str(exception).cast<std::string>();
  if (py::isinstance(exception, error_class("ConfigError"))) return use(core::ConfigError(text));
  if (py::isinstance(exception, error_class("NumericalError"))) return use(numerical_error(exception));
  const auto type = py::type::of(exception).attr("__name__").cast<std::string>();
  use(std::runtime_error(text.empty() ? type : type + ": " + text));
}

}  // namespace talus::python
