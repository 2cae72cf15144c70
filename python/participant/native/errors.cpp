#include "python/participant/native/errors.hpp"

#include <stdexcept>
#include <string>

#include "core/errors.hpp"

namespace talus::python {
namespace py = pybind11;
namespace {

py::object error_class(const char* name) {
  return py::module_::import("talus_participant.errors").attr(name);
}

void raise(const char* class_name, const std::exception& error) {
  PyErr_SetString(error_class(class_name).ptr(), error.what());
}

void raise_numerical(const core::NumericalError& error) {
  using namespace py::literals;
  const auto& details = error.details();
  const py::object made =
      error_class("NumericalError")(details.what, "entity"_a = details.entity, "step"_a = details.step,
                                    "time"_a = details.time, "value"_a = details.value);
  PyErr_SetObject(error_class("NumericalError").ptr(), made.ptr());
}

core::NumericalError numerical_error(const py::object& exception) {
  return core::NumericalError({.what = exception.attr("what").cast<std::string>(),
                               .entity = exception.attr("entity").cast<std::string>(),
                               .step = exception.attr("step").cast<std::int64_t>(),
                               .time = exception.attr("time").cast<double>(),
                               .value = exception.attr("value").cast<double>()});
}

core::ConfigError config_error(const py::object& exception, const std::string& text) {
  std::vector<core::Complaint> complaints;
  for (const py::handle said : exception.attr("complaints"))
    complaints.push_back({.file = said.attr("file").cast<std::string>(),
                          .line = said.attr("line").cast<int>(),
                          .column = said.attr("column").cast<int>(),
                          .key_path = said.attr("key_path").cast<std::string>(),
                          .message = said.attr("message").cast<std::string>()});
  return complaints.empty() ? core::ConfigError(text) : core::ConfigError(std::move(complaints));
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
    } catch (const core::NumericalError& error) {
      raise_numerical(error);
    } catch (const core::MachineError& error) {
      raise("MachineError", error);
    } catch (const core::UsageError& error) {
      raise("UsageError", error);
    }
  });
}

void with_error(const py::object& exception, const std::function<void(const std::exception&)>& use) {
  const auto text = py::str(exception).cast<std::string>();
  if (py::isinstance(exception, error_class("ConfigError"))) return use(config_error(exception, text));
  if (py::isinstance(exception, error_class("MachineError"))) return use(core::MachineError(text));
  if (py::isinstance(exception, error_class("NumericalError"))) return use(numerical_error(exception));
  const auto type = py::type::of(exception).attr("__name__").cast<std::string>();
  use(std::runtime_error(text.empty() ? type : type + ": " + text));
}

}  // namespace talus::python
