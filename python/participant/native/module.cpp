#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <string>

#include "core/errors.hpp"
#include "core/scene/reader.hpp"
#include "core/scene/tree.hpp"
#include "core/units/units.hpp"
#include "coupler/participant.hpp"
#include "python/participant/native/conversions.hpp"
#include "python/participant/native/errors.hpp"

/// talus_participant._native: the participant interface of coupler/participant.hpp, call by call. The package around it
/// (python/participant/) is what users see.
namespace talus::python {
namespace {

using coupler::Action;
using coupler::Command;
using coupler::Participant;
using coupler::Role;

std::unique_ptr<Participant> join(const std::string& segment, Role role, double timeout) {
  return Participant::join({.segment = segment, .role = role, .timeout = timeout});
}

py::tuple receive_surface(Participant& participant) {
  std::vector<double> masses;
  mesh::Surface surface;
  {
    const py::gil_scoped_release others_may_run;
    surface = participant.receive_surface(masses);
  }
  return py::make_tuple(surface_arrays(surface), surface_parts(surface),
                        DoubleArray(static_cast<py::ssize_t>(masses.size()), masses.data()));
}

void declare(Participant& participant, const py::object& said) {
  const coupler::Declaration declaration = declaration_from(said);
  const py::gil_scoped_release others_may_run;
  participant.declare(declaration);
}

void publish_surface(Participant& participant, const py::object& surface, const DoubleArray& masses) {
  const mesh::Surface published = surface_from(surface);
  const py::gil_scoped_release others_may_run;
  participant.publish_surface(published, {masses.data(), static_cast<std::size_t>(masses.size())});
}

py::dict structure_fields(const py::object& self) {
  using namespace py::literals;
  const auto fields = self.cast<Participant&>().structure_fields();
  return py::dict(
      "force"_a = view(fields.force, 3, self), "displacement"_a = view(fields.displacement, 3, self),
      "velocity"_a = view(fields.velocity, 3, self), "free_velocity"_a = view(fields.free_velocity, 3, self),
      "lost"_a = view(fields.lost, 0, self));
}

py::dict particle_fields(const py::object& self) {
  using namespace py::literals;
  const auto fields = self.cast<Participant&>().particle_fields();
  return py::dict(
      "start_displacement"_a = view(fields.start_displacement, 3, self),
      "start_velocity"_a = view(fields.start_velocity, 3, self),
      "end_displacement"_a = view(fields.end_displacement, 3, self),
      "end_velocity"_a = view(fields.end_velocity, 3, self), "force"_a = view(fields.force, 3, self),
      "free_velocity"_a = view(fields.free_velocity, 3, self),
      "moved_displacement"_a = view(fields.moved_displacement, 3, self),
      "moved_velocity"_a = view(fields.moved_velocity, 3, self), "lost"_a = view(fields.lost, 0, self));
}

void bind_participant(py::module_& module) {
  const py::call_guard<py::gil_scoped_release> others_may_run;
  py::class_<Participant>(module, "Participant")
      .def(py::init(&join), py::arg("segment"), py::arg("role"), py::arg("timeout"))
      .def("publish_surface", &publish_surface)
      .def("receive_surface", &receive_surface)
      .def("declare", &declare)
      .def("next", &Participant::next, others_may_run)
      .def("answer", &Participant::answer)
      .def("fail",
           [](Participant& self, const py::object& exception) {
             with_error(exception, [&](const std::exception& error) { self.fail(error); });
           })
      .def("structure_fields", &structure_fields)
      .def("particle_fields", &particle_fields)
      .def("probes", [](const py::object& self) { return view(self.cast<Participant&>().probes(), 0, self); })
      .def("ledger", [](const py::object& self) { return view(self.cast<Participant&>().ledger(), 0, self); })
      .def("positions",
           [](const py::object& self, std::size_t group) {
             return view(self.cast<Participant&>().positions(group), 3, self);
           })
      .def("field",
           [](const py::object& self, std::size_t group, std::size_t field, std::size_t components) {
             return view(self.cast<Participant&>().field(group, field), components, self);
           })
      .def("table",
           [](const py::object& self, std::size_t table, std::size_t columns) {
             return view(self.cast<Participant&>().table(table), columns, self);
           })
      .def("set_table_rows", [](Participant& self, std::size_t table,
                                std::int64_t rows) { self.table_rows(table) = static_cast<double>(rows); })
      .def("tell_force_evaluations", &Participant::tell_force_evaluations)
      .def("book_work", &Participant::book_work);
}

void bind_command(py::module_& module) {
  py::enum_<Role>(module, "Role", "The side of the interface a participant computes.")
      .value("structure", Role::structure)
      .value("particles", Role::particles);
  py::enum_<Action>(module, "Action", "What the coupler wants done.")
      .value("advance", Action::advance)
      .value("save_state", Action::save_state)
      .value("restore_state", Action::restore_state)
      .value("report", Action::report)
      .value("write_checkpoint", Action::write_checkpoint)
      .value("read_checkpoint", Action::read_checkpoint)
      .value("finish", Action::finish);
  py::class_<Command>(module, "Command",
                      "One command of the coupler. Time is window x length, never accumulated.")
      .def_readonly("action", &Command::action)
      .def_readonly("fields", &Command::fields, "report: field frames are wanted too")
      .def_readonly("tentative", &Command::tentative,
                    "advance: the window may be taken back; its work is booked by the coupler")
      .def_readonly("window", &Command::window, "index of the window, from 0")
      .def_readonly("iteration", &Command::iteration, "of a strong scheme, from 0")
      .def_readonly("time", &Command::time, "s; the start of the window")
      .def_readonly("length", &Command::length, "s; of the window")
      .def_readonly("regular_length", &Command::regular_length,
                    "s; of a window in which nothing makes the coupler choose another")
      .def_readonly(
          "force_shift", &Command::force_shift,
          "s; advance of particles: how much earlier than the window the mean of the forces is wanted")
      .def_readonly("path", &Command::path, "of a checkpoint");
}

void bind_output_kinds(py::module_& module) {
  py::enum_<core::LedgerKind>(
      module, "LedgerKind",
      "How a line enters stored + dissipated - supplied = constant; a memo is only shown.")
      .value("stored", core::LedgerKind::stored)
      .value("dissipated", core::LedgerKind::dissipated)
      .value("supplied", core::LedgerKind::supplied)
      .value("memo", core::LedgerKind::memo);
  py::enum_<core::TableKind>(module, "TableKind", "What becomes of a table.")
      .value("events", core::TableKind::events)
      .value("distribution", core::TableKind::distribution);
  py::enum_<core::FieldLocation>(module, "FieldLocation", "What each row of a field belongs to.")
      .value("node", core::FieldLocation::node)
      .value("cell", core::FieldLocation::cell);
}

py::object python_value(const core::SceneNode& node) {
  using Kind = core::SceneNode::Kind;
  if (node.kind == Kind::scalar) return py::str(node.scalar);
  if (node.kind == Kind::null) return py::none();
  if (node.kind == Kind::list) {
    py::list items;
    for (const auto& item : node.items) items.append(python_value(item));
    return items;
  }
  py::dict entries;
  for (const auto& entry : node.entries) entries[py::str(entry.key)] = python_value(entry.value);
  return entries;
}

py::object read_scene(const std::string& path) {
  const auto file = core::SceneFile::load(path);
  std::vector<core::Complaint> complaints;
  return python_value(core::parse_yaml(file.text(), path, complaints));
}

double convert(double value, const std::string& unit, const std::string& wanted) {
  const auto converted = core::convert({.value = value, .unit = unit}, wanted);
  if (converted.outcome == core::UnitConversion::Outcome::ok) return converted.value;
  throw core::ConfigError("expects " + core::expected_quantity(wanted) + ", but the unit is '" + unit + "'");
}

}  // namespace
}  // namespace talus::python

PYBIND11_MODULE(_native, module) {
  using namespace talus::python;
  module.doc() =
      "The participant interface of Talus, call by call; use the package talus_participant instead.";
  register_errors();
  bind_output_kinds(module);
  bind_command(module);
  bind_participant(module);
  module.def("read_scene", &read_scene, py::arg("path"),
             "The scene after `extends`, as dicts, lists and texts.");
  module.def("convert", &convert, py::arg("value"), py::arg("unit"), py::arg("wanted"));
}
