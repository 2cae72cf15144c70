#include "coupler/scene/interface_scene.hpp"

namespace talus::coupler {
namespace {

constexpr const char* material_help = "contact material of the boundary, a name in particles.materials";
constexpr const char* tolerance_help =
    "largest distance of a boundary node from the structure; absent: 1 % of the structure's extent";

mesh::Surface with_contact(mesh::Surface surface, const SameAsStructure& contact) {
  for (auto& part : surface.parts) {
    part.material = contact.material;
    part.wire_radius = contact.wire_radius.value_or(part.wire_radius);
  }
  return surface;
}

mesh::Surface with_contact(mesh::Surface surface, const std::string& material) {
  for (auto& part : surface.parts) part.material = material;
  return surface;
}

struct MakeBoundary {
  mesh::Surface operator()(const SameAsStructure& boundary) const {
    return with_contact(structure, boundary);
  }
  template <class SurfaceScene>
  mesh::Surface operator()(const OwnBoundary<SurfaceScene>& boundary) const {
    return with_contact(mesh::generate(boundary.surface).surface, boundary.material);
  }
  const mesh::Surface& structure;
};

struct Tie {
  mesh::TiedSurfaces operator()(const NearestFeature& mapping) const {
    return mesh::tie_to_nearest_feature(boundary, structure, mapping.tolerance);
  }
  mesh::TiedSurfaces operator()(const NearestNeighbour& mapping) const {
    return mesh::tie_to_nearest_node(boundary, structure, mapping.tolerance);
  }
  const mesh::Surface& boundary;
  const mesh::Surface& structure;
};

}  // namespace

void describe(core::Fields& fields, SameAsStructure& boundary) {
  fields.optional("wire_radius", boundary.wire_radius,
                  {.unit = "m",
                   .range = core::not_negative,
                   .help = "radius of the wires around the structure's lines; 0: their axes are touched; "
                           "absent: that of each net by its `wire_diameter`, with twists and rings as thick "
                           "as they are, and 0 of other lines"});
  fields.with_default("material", boundary.material, {.help = material_help});
}

template <class SurfaceScene>
void describe(core::Fields& fields, OwnBoundary<SurfaceScene>& boundary) {
  describe(fields, boundary.surface);
  fields.with_default("material", boundary.material, {.help = material_help});
}

void describe(core::Fields& fields, BoundaryScene& boundary) {
  std::vector<core::Fields::Alternative> kinds{
      {"same_as_structure", "the particles touch the structure's own lines and triangles"}};
  for (const auto& net : mesh::net_alternatives(
           {{"sheet", "a panel filled with triangles"}, {"mesh_file", "a mesh made elsewhere"}}))
    kinds.push_back(net);
  fields.one_of(boundary.kind, kinds);
}

void describe(core::Fields& fields, NearestFeature& mapping) {
  fields.optional("tolerance", mapping.tolerance,
                  {.unit = "m", .range = core::positive, .help = tolerance_help});
}

void describe(core::Fields& fields, NearestNeighbour& mapping) {
  fields.optional("tolerance", mapping.tolerance,
                  {.unit = "m", .range = core::positive, .help = tolerance_help});
}

void describe(core::Fields& fields, MappingScene& mapping) {
  fields.one_of(mapping.kind,
                {{"nearest_feature", "linear weights on the nearest triangle or line of the structure"},
                 {"nearest_neighbour",
                  "the nearest node alone: exact on identical surfaces, loses moments on others"}});
}

void describe(core::Fields& fields, InterfaceScene& interface) {
  fields.required("structure", interface.structure,
                  {.help = "the parts of the structure that particles can touch"});
  fields.section("boundary", interface.boundary, "what the particles touch there");
  fields.section("mapping", interface.mapping,
                 "how boundary and structure are tied; absent: nearest_feature");
  fields.rule(!interface.structure.empty(), "structure", "must name at least one part");
}

InterfacePlan plan_of(const InterfaceScene& interface) {
  const auto mapping = interface.mapping.value_or(MappingScene{}).kind;
  return {.make_boundary =
              [kind = interface.boundary.kind](const mesh::Surface& structure) {
                return std::visit(MakeBoundary{structure}, kind);
              },
          .tie =
              [mapping](const mesh::Surface& boundary, const mesh::Surface& structure) {
                return std::visit(Tie{boundary, structure}, mapping);
              }};
}

}  // namespace talus::coupler
