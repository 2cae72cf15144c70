#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstring>
#include <memory>

#include "core/scene/reader.hpp"
#include "coupler/app/commands.hpp"
#include "coupler/launch/find_solver.hpp"
#include "coupler/scene/interface_scene.hpp"
#include "interface_mesh/files/mesh_file.hpp"
#include "interface_mesh/tubes.hpp"

namespace talus::coupler {

namespace {

struct MeshRequest {
  std::filesystem::path scene, out;
  mesh::Index tube_sides = 0;  ///< 0: wires stay lines
};

core::ExitCode write_boundary(const MeshRequest& request) {
  const auto file = core::SceneFile::load(request.scene);
  core::SceneReader reader(file);
  const auto interface = reader.required<InterfaceScene>("interface");
  reader.finish();
  if (std::holds_alternative<SameAsStructure>(interface.boundary.kind))
    throw core::ConfigError("interface.boundary: is the structure's own surface, not one that is generated");
  mesh::Net net;
  net.surface = plan_of(interface).make_boundary({});
  if (request.tube_sides > 0) net.surface = mesh::as_tubes(net.surface, request.tube_sides);
  mesh::write_mesh_file(net, request.out);
  fmt::print("{}: {} nodes, {} lines, {} triangles\n", request.out.string(), net.surface.node_count(),
             net.surface.segments.size(), net.surface.triangles.size());
  return core::ExitCode::success;
}

/// Becomes the program of that name beside this one.
core::ExitCode become(const std::string& program, std::vector<std::string> arguments) {
  const std::string path = launch::own_solver(program).string();
  std::vector<char*> pointers{const_cast<char*>(path.c_str())};
  for (auto& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  ::execv(path.c_str(), pointers.data());
  throw core::ConfigError(fmt::format("{}: cannot be started: {}", path, std::strerror(errno)));
}

}  // namespace

void add_mesh(CLI::App& app, Chosen& chosen) {
  auto* command = app.add_subcommand("mesh", "write the boundary net of a scene to a file");
  command->footer("Example:\n  talus mesh configs/examples/openings.yaml --out net.msh");
  const auto request = std::make_shared<MeshRequest>();
  command->add_option("SCENE", request->scene, "the scene, a YAML file")->required();
  command->add_option("--out", request->out, "the file: .msh (Gmsh 4.1), .stl, .obj or .ply")->required();
  command
      ->add_option("--tubes", request->tube_sides, "make each wire a tube of triangles with this many sides")
      ->check(CLI::Range(3, 100));
  command->callback([request, &chosen] { chosen.run = [request] { return write_boundary(*request); }; });
}

void add_homogenise(CLI::App& app, Chosen& chosen) {
  auto* command =
      app.add_subcommand("homogenise", "find the membrane that stands for a net of the structure");
  command->prefix_command();
  command->set_help_flag();  // --help is the program's own
  command->callback([command, &chosen] {
    chosen.run = [arguments = command->remaining()] { return become("homogenise_net", arguments); };
  });
}

}  // namespace talus::coupler
