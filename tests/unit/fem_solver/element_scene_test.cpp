#include <catch2/catch.hpp>
#include <cmath>

#include "core/errors.hpp"
#include "core/scene/reader.hpp"
#include "fem_solver/app/structure.hpp"
#include "tests/unit/fem_solver/structural_scenes.hpp"

// Scenes of membranes, sliding ropes, brakes and slides: what they compute, and what is said about bad ones.
namespace {

using namespace talus;
using namespace talus::fem;

using tests::complaint;
using tests::scene;

std::string part(const std::string& shape, const std::string& element) {
  return "  parts: {part: {" + shape + ", " + element + "}}\n";
}

const std::string line = "polyline: {points: [[0, 0, 0], [4, 0, 0]], divisions: 4}";
const std::string sheet = "sheet: {corner: [0, 0, 0], size: [1, 1], element_size: 0.5}";
const std::string section = "area: 1 cm^2, density: 8000, youngs_modulus: 100 GPa";

std::string membrane(const std::string& elasticity, const std::string& others = "") {
  return "membrane: {thickness: 1 mm, density: 1000, " + elasticity + others + "}";
}

/// Runs a static scene to its end.
Structure equilibrium(const std::string& structure) {
  Structure built(scene(structure));
  for (int k = 0; k < 10; ++k) built.integrator().advance(0.1 * k, 0.1);
  return built;
}

Vector3 displacement(Structure& structure, Index node) {
  return Vector3::Map(&structure.integrator().displacement()[3 * static_cast<std::size_t>(node)]);
}

}  // namespace

TEST_CASE("bad membranes, ropes and brakes get complaints that name the key and the numbers") {
  const auto check = [](const std::string& structure, const std::string& expected) {
    CHECK_THAT(complaint(structure), Catch::Contains(expected));
  };
  const std::string moduli = "youngs_modulus_x: 4 GPa, youngs_modulus_y: 1 GPa, shear_modulus: 1 MPa, ";
  const auto orthotropic = [&](const std::string& poisson) {
    return part(sheet, membrane("orthotropic: {" + moduli + poisson + "}", ", material_axis: [1, 0, 0]"));
  };
  check(orthotropic("poissons_ratio_xy: 0.1, poissons_ratio_yx: 0.1"),
        "must be v_xy E_x/E_y = 0.4 for a symmetric stiffness, but is 0.1");
  CHECK(complaint(orthotropic("poissons_ratio_xy: 0.1, poissons_ratio_yx: 0.4")) == "no complaint");
  check(orthotropic("poissons_ratio_xy: 0.6"), "must be smaller than sqrt(E_y/E_x) = 0.5 in magnitude");
  check(part(line, membrane("isotropic: {youngs_modulus: 1 GPa, poissons_ratio: 0.3}")),
        "a membrane needs a shape made of triangles, not of lines");
  check(part(sheet, "sliding_cable: {" + section + "}"),
        "a sliding cable needs a shape made of lines, not of triangles");
  check(part("mesh: {nodes: [[0, 0, 0], [1, 0, 0], [2, 0, 0]], segments: [[0, 1], [2, 1]]}",
             "sliding_cable: {" + section + "}"),
        "structure.parts.part: a sliding cable is one line from end to end, but after (1, 0, 0) m it goes on "
        "at (2, 0, 0) m");
  check(part("polyline: {points: [[0, 0, 0], [1, 0, 0], [1, 0, 0], [2, 0, 0]]}",
             "sliding_cable: {" + section + "}"),
        "(1, 0, 0)");
  check(part(line, "elastic_plastic_cable: {" + section + ", prestress: 2 MPa, yield_stress: 1 MPa}"),
        "must not exceed yield_stress");
  check(part(line, "brake: {table: [[0.1, 100], [0.2, 300]], mass_per_length: 1}"), "structure.parts.part");
  check(part(line, "brake: {table: [], mass_per_length: 1}"), "structure.parts.part");
}

TEST_CASE("a sheet whose stiffness or prestress differs by direction is refused without its axis") {
  const auto check = [](const std::string& elasticity, const std::string& others,
                        const std::string& directed) {
    const std::string without = complaint(part(sheet, membrane(elasticity, others)));
    INFO(elasticity << others);
    if (directed.empty()) {
      CHECK(without == "no complaint");
      return;
    }
    CHECK_THAT(without, Catch::Contains("structure.parts.part.membrane: needs `material_axis`, as the " +
                                        directed + " differs by direction"));
    CHECK(complaint(part(sheet, membrane(elasticity, others + ", material_axis: [0, 1, 0]"))) ==
          "no complaint");
  };
  const auto orthotropic = [](const std::string& x, const std::string& y, const std::string& shear) {
    return "orthotropic: {youngs_modulus_x: " + x + ", youngs_modulus_y: " + y +
           ", poissons_ratio_xy: 0.25, shear_modulus: " + shear + "}";
  };
  const std::string isotropic = "isotropic: {youngs_modulus: 1 GPa, poissons_ratio: 0.25}";
  check(orthotropic("1 GPa", "0.5 GPa", "0.4 GPa"), "", "stiffness");
  check(orthotropic("1 GPa", "1 GPa", "50 MPa"), "", "stiffness");  // as a square net: its diagonal is soft
  check(isotropic, ", prestress: {xx: 1 MPa}", "prestress");
  check(isotropic, ", prestress: {xx: 1 MPa, yy: 2 MPa}", "prestress");
  check(isotropic, ", prestress: {xx: 1 MPa, yy: 1 MPa, xy: 1 kPa}", "prestress");
  check(isotropic, "", "");
  check(isotropic, ", prestress: {xx: 1 MPa, yy: 1 MPa}", "");
  check(orthotropic("1 GPa", "1 GPa", "0.4 GPa"), "", "");  // G = E/(2 (1 + v)): isotropic in other words
  CHECK_THAT(complaint(part(sheet, membrane(isotropic, ", material_axis: [0, 0, 0]"))),
             Catch::Contains("must not be zero"));
}

TEST_CASE("stresses, moduli and areas of a lost unit are refused by every element that has them") {
  const auto check = [](const std::string& element, const std::string& expected) {
    CHECK_THAT(complaint(part(element.starts_with("membrane") ? sheet : line, element)),
               Catch::Contains(expected) && Catch::Contains("megapascals are written MPa"));
  };
  const std::string size = "area: 1 cm^2, density: 8000, ";
  check("bar: {" + size + "youngs_modulus: 1770 mPa}", "youngs_modulus: '1770 mPa' is 1.77 Pa");
  check("cable: {" + size + "youngs_modulus: 100000 mPa}", "youngs_modulus: '100000 mPa' is 100 Pa");
  check("sliding_cable: {" + section + ", prestress: 1000 mPa}", "prestress: '1000 mPa' is 1 Pa");
  check("elastic_plastic_cable: {" + section + ", yield_stress: 1770 mPa}", "yield_stress: '1770 mPa'");
  check(membrane("isotropic: {youngs_modulus: 200 mPa, poissons_ratio: 0.3}"), "youngs_modulus: '200 mPa'");
  check(membrane("orthotropic: {youngs_modulus_x: 4 GPa, youngs_modulus_y: 1 GPa, shear_modulus: 50 mPa, "
                 "poissons_ratio_xy: 0.1}"),
        "shear_modulus: '50 mPa'");
  CHECK_THAT(complaint(part(line, "cable: {area: 12.6 km^2, density: 8000, youngs_modulus: 100 GPa}")),
             Catch::Contains("area: '12.6 km^2'") && Catch::Contains("written mm^2"));
}

TEST_CASE("a structure without mass, and one in other units, are read") {
  CHECK(complaint(part("polyline: {points: [[0, 0, 0], [1, 0, 0]]}",
                       "bar: {area: 1, density: 1e-6, youngs_modulus: 10}")) == "no complaint");
}

namespace {

/// A rope of cables along x, and a net whose southern edge, moved off it in z, may run on it.
std::string slides(const std::string& slide, const std::string& others = "") {
  return "  parts:\n"
         "    rope: {polyline: {points: [[0, 0, 0], [3, 0, 0]], divisions: 4}, cable: {" +
         section +
         "}}\n"
         "    net: {square_net: {corner: [0, 0, 0], size: [3, 3], pitch: 1, rim: open}, cable: {" +
         section +
         "}}\n"
         "    post: {polyline: {points: [[0, 0, 0], [0, 0, 5]]}, bar: {" +
         section +
         "}}\n"
         "  slides: {edge: {" +
         slide + "}}\n" + others;
}

}  // namespace

TEST_CASE("bad slides get complaints that name the slide, the node and the distance") {
  const auto check = [](const std::string& structure, const std::string& expected) {
    CHECK_THAT(complaint(structure), Catch::Contains(expected));
  };
  const std::string spring = ", penalty: {stiffness: 1 kN/m}";
  CHECK(complaint(slides("rope: rope, nodes: net.edge_south" + spring)) == "no complaint");
  CHECK(complaint(slides("rope: rope, nodes: net.edge_south, constraint: {}")) == "no complaint");
  check(slides("rope: robe, nodes: net.edge_south" + spring),
        "structure.slides.edge.rope: the structure has no part 'robe'");
  check(slides("rope: net, nodes: net.edge_south" + spring),
        "structure.slides.edge.rope: a sliding cable is one line");
  check(slides("rope: rope, nodes: net.edge_south"), "structure.slides.edge");
  check(slides("rope: rope, nodes: rope.start" + spring),
        "structure.slides.edge.nodes: node 0 of rope at (0, 0, 0) m is a node of the rope itself");
  check(slides("rope: rope, nodes: net.edge_north" + spring), "is 3 m away from the rope, more than 0.03 m");
  check(slides("rope: rope, nodes: net.edge_south, penalty: {stiffness: -1}"),
        "structure.slides.edge.penalty.stiffness");
  check(slides("rope: rope, nodes: net.edge_south, constraint: {}", "  implicit: {spectral_radius: 1}\n"),
        "has to be below 1 where `slides` hold by constraints");
}

TEST_CASE("a weight on a sliding cable of a scene settles at the lowest point of the ellipse") {
  // As for the element alone: equal angles to the vertical, sin a = span/L, drops d1 + d2 = L cos a.
  const double span = 4, rise = 1;
  const double L = std::hypot(1, 1.5) + std::hypot(3, 2.5), weight = 1000, EA = 1e7;
  Structure rope = equilibrium(
      part("polyline: {points: [[0, 0, 0], [1, 0, -1.5], [4, 0, 1]]}",
           "sliding_cable: {area: 1 cm^2, density: 8000, youngs_modulus: 100 GPa, prestress: 0.1 MPa}") +
      "  static: {steps: 10}\n"
      "  supports: [{nodes: part.start, fix: xyz}, {nodes: part.end, fix: xyz}]\n"
      "  loads: [{at: [1, 0, -1.5], force: [0, 0, -1000]}]\n");
  const double cosine = std::sqrt(1 - span * span / (L * L)), drop = 0.5 * (L * cosine - rise);
  const Vector3 expected(drop / cosine * span / L, 0, -drop);
  const double stretch = weight / (2 * cosine * EA);  // of the rope; moves the slider by about as much of L
  CHECK((Vector3(1, 0, -1.5) + displacement(rope, 1) - expected).norm() < 5 * stretch * L);
}

TEST_CASE(
    "a sheared panel of a scene has E gamma/4 of shear stress with the tension field and G gamma without") {
  // Narrow ends are free: a long panel, its middle counts.
  const double E = 1e6, poisson = 0.3, gamma = 0.01, length = 8, thickness = 1e-3;
  const auto force = [&](const std::string& field) {
    Structure panel =
        equilibrium(part("sheet: {corner: [0, 0, 0], size: [8, 0.5], element_size: 0.25}",
                         membrane("isotropic: {youngs_modulus: 1 MPa, poissons_ratio: 0.3}", field)) +
                    "  static: {steps: 10}\n"
                    "  supports: [{nodes: part, fix: z}, {nodes: part.edge_south, fix: xy},\n"
                    "             {nodes: part.edge_north, fix: xy, displacement: [5 mm, 0, 0]}]\n");
    const auto& supports = panel.model().supports;
    double sum = 0;
    std::size_t begin = supports[0].nodes.size() + supports[1].nodes.size();
    for (std::size_t k = 0; k < supports[2].nodes.size(); ++k)
      sum += panel.integrator().reactions()[3 * (begin + k)];
    return sum / (length * thickness);
  };
  const double taut = force(""), wrinkled = force(", tension_field: {wrinkle_direction: iterated}");
  // The free ends, over a height of 0.5 m each, and the second-order strain gamma^2/2 across.
  constexpr double ends = 0.08;
  CHECK(taut == Approx(E * gamma / (2 * (1 + poisson))).epsilon(ends));
  CHECK(wrinkled == Approx(E * gamma / 4).epsilon(ends));
  CHECK(wrinkled / taut == Approx((1 + poisson) / 2).epsilon(0.05));
}
