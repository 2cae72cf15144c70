#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/scene/fields.hpp"
#include "coupler/session/introduction.hpp"
#include "interface_mesh/scene/mesh_file.hpp"
#include "interface_mesh/scene/nets.hpp"
#include "interface_mesh/scene/sheet.hpp"

/// `interface:` which parts of the structure the particles can touch, what they touch there, and how the two
/// are tied.
namespace talus::coupler {

/// Ω_D is the surface of Ω_S itself.
struct SameAsStructure {
  std::optional<double> wire_radius;  ///< m; 0: the axes are touched; absent: as the structure says
  std::string material;
};
void describe(core::Fields& fields, SameAsStructure& boundary);

/// Ω_D is a surface of its own, such as a net with its real openings and wires.
template <class SurfaceScene>
struct OwnBoundary {
  SurfaceScene surface;
  std::string material;
};

using BoundaryChoice =
    std::variant<SameAsStructure, OwnBoundary<mesh::SquareNetScene>, OwnBoundary<mesh::RhombicNetScene>,
                 OwnBoundary<mesh::HexagonalNetScene>, OwnBoundary<mesh::RingNetScene>,
                 OwnBoundary<mesh::SheetScene>, OwnBoundary<mesh::MeshFileScene>>;
struct BoundaryScene {
  BoundaryChoice kind;
};
void describe(core::Fields& fields, BoundaryScene& boundary);

/// Linear weights on the nearest triangle or segment of Ω_S.
struct NearestFeature {
  std::optional<double> tolerance;  ///< m
};
void describe(core::Fields& fields, NearestFeature& mapping);

/// The nearest node of Ω_S alone.
struct NearestNeighbour {
  std::optional<double> tolerance;  ///< m
};
void describe(core::Fields& fields, NearestNeighbour& mapping);

struct MappingScene {
  std::variant<NearestFeature, NearestNeighbour> kind;
};
void describe(core::Fields& fields, MappingScene& mapping);

struct InterfaceScene {
  std::vector<std::string> structure;  ///< names of parts
  BoundaryScene boundary;
  std::optional<MappingScene> mapping;  ///< absent: nearest_feature
};
void describe(core::Fields& fields, InterfaceScene& interface);

InterfacePlan plan_of(const InterfaceScene& interface);

}  // namespace talus::coupler
