#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "core/program/command_line.hpp"
#include "core/scene/reader.hpp"
#include "fem_solver/homogenise/fit.hpp"
#include "fem_solver/scene/homogenise_scene.hpp"

namespace talus::fem {

namespace {

struct Request {
  std::string scene, part;
  FitOptions fit{.strain = 0.01, .thickness = 1e-3};
  bool json = false;
};

const PartScene& chosen_part(const StructureScene& structure, const std::string& name) {
  std::string names;
  for (const auto& [part_name, part] : structure.parts) {
    if (part_name == name || (name.empty() && structure.parts.size() == 1)) return part;
    names += (names.empty() ? "" : ", ") + part_name;
  }
  if (name.empty())
    throw core::ConfigError("the structure has several parts: say which by --part; there are " + names);
  throw core::ConfigError("there is no part '" + name + "' in the structure; there are " + names);
}

void print_json(const HomogenisedSheet& sheet) {
  fmt::print("{}\n",
             nlohmann::json{{"thickness_m", sheet.thickness},
                            {"density_kg_per_m3", sheet.density},
                            {"youngs_modulus_x_Pa", sheet.moduli.youngs_modulus_x},
                            {"youngs_modulus_y_Pa", sheet.moduli.youngs_modulus_y},
                            {"poissons_ratio_xy", sheet.moduli.poissons_ratio_xy},
                            {"shear_modulus_Pa", sheet.moduli.shear_modulus},
                            {"prestress_Pa", {sheet.prestress.xx, sheet.prestress.yy, sheet.prestress.xy}},
                            {"error_relative", sheet.error},
                            {"remarks", sheet.remarks}}
                 .dump());
}

void print_text(const HomogenisedSheet& sheet, double strain) {
  fmt::print("thickness: {:.6g} m\ndensity: {:.6g} kg/m^3\n", sheet.thickness, sheet.density);
  fmt::print("youngs_modulus_x: {:.6g} Pa\nyoungs_modulus_y: {:.6g} Pa\n", sheet.moduli.youngs_modulus_x,
             sheet.moduli.youngs_modulus_y);
  fmt::print("poissons_ratio_xy: {:.6g}\nshear_modulus: {:.6g} Pa\n", sheet.moduli.poissons_ratio_xy,
             sheet.moduli.shear_modulus);
  fmt::print("prestress: [{:.6g}, {:.6g}, {:.6g}]  # Pa; xx, yy, xy\n", sheet.prestress.xx,
             sheet.prestress.yy, sheet.prestress.xy);
  fmt::print(
      "# Up to a strain of {:g} the membrane misses {:.2g} % of the net's stress (root mean square).\n",
      strain, 100 * sheet.error);
  for (const auto& remark : sheet.remarks) fmt::print("# {}\n", remark);
}

core::ExitCode homogenise(const Request& request) {
  const auto file = core::SceneFile::load(request.scene);
  core::SceneReader reader(file);
  const auto structure = reader.required<StructureScene>("structure");
  reader.finish();
  const auto sheet = fit_sheet(periodic_net(chosen_part(structure, request.part)), request.fit);
  request.json ? print_json(sheet) : print_text(sheet, request.fit.strain);
  return core::ExitCode::success;
}

}  // namespace

}  // namespace talus::fem

int main(int argc, char** argv) {
  using namespace talus;
  CLI::App app(
      "Finds the membrane that stands for a cable net: pulls and shears a cell of it and fits the moduli.",
      "talus homogenise");
  app.footer("Example:\n  talus homogenise configs/examples/cable_net.yaml --strain 0.05");
  fem::Request request;
  app.add_option("SCENE", request.scene, "the scene, a YAML file")->required();
  app.add_option("--part", request.part, "the part of the structure (default: the only one)");
  app.add_option("--strain", request.fit.strain, "largest strain the membrane is fitted at")
      ->check(CLI::Range(1e-6, 1.0))
      ->capture_default_str();
  app.add_option("--thickness", request.fit.thickness, "of the membrane, in metres")
      ->check(CLI::Range(1e-6, 1.0))
      ->capture_default_str();
  app.add_flag("--json", request.json, "print one JSON object");
  return core::run_main(app, argc, argv, [&] { return fem::homogenise(request); });
}
