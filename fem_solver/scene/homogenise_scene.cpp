#include "fem_solver/scene/homogenise_scene.hpp"

#include "core/errors.hpp"

namespace talus::fem {

namespace {

template <class Shape>
concept RepeatingNet = requires(const Shape& shape) {
  lattice(shape);
};

AxialSection of_wires(AxialSection section, int wires) {
  section.area *= wires;
  return section;
}

}  // namespace

PeriodicNet periodic_net(const mesh::Lattice& lattice, const AxialSection& section, double density) {
  PeriodicNet net{.nodes = static_cast<int>(lattice.nodes.size()),
                  .area = lattice.cell.x() * lattice.cell.y(),
                  .wires = {}};
  for (const auto& link : lattice.links) {
    const mesh::Vector2 step(link.step[0] * lattice.cell.x(), link.step[1] * lattice.cell.y());
    const mesh::Vector2 reference = lattice.nodes[link.to] + step - lattice.nodes[link.from];
    net.wires.push_back({.near = static_cast<int>(link.from),
                         .far = static_cast<int>(link.to),
                         .reference = {reference.x(), reference.y(), 0},
                         .section = of_wires(section, lattice.parts[link.part].wires),
                         .density = density});
  }
  return net;
}

PeriodicNet periodic_net(const PartScene& part) {
  const auto* cable = std::get_if<CableScene>(&part.element);
  if (!cable)
    throw core::ConfigError(part.place + ": is not made of cables, so it cannot be homogenised as a net");
  const AxialSection section{
      .area = cable->area, .youngs_modulus = cable->youngs_modulus, .prestress = cable->prestress};
  return std::visit(
      [&](const auto& shape) -> PeriodicNet {
        if constexpr (RepeatingNet<std::decay_t<decltype(shape)>>)
          return periodic_net(lattice(shape), section, cable->density);
        else
          throw core::ConfigError(part.place + ": has no repeating openings, so it cannot be homogenised");
      },
      part.shape);
}

}  // namespace talus::fem
