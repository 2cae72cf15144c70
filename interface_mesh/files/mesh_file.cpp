#include "interface_mesh/files/mesh_file.hpp"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>
#include <numeric>

#include "core/errors.hpp"
#include "interface_mesh/files/gmsh.hpp"
#include "interface_mesh/points.hpp"

namespace talus::mesh {

namespace {

/// Lower-case, without the dot.
std::string kind_of(const std::filesystem::path& path) {
  std::string kind = path.extension().string();
  std::transform(kind.begin(), kind.end(), kind.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return kind.empty() ? kind : kind.substr(1);
}

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& reason) {
  throw core::ConfigError(fmt::format("{}: {}", path.string(), reason));
}

void require_known_kind(const std::filesystem::path& path) {
  const auto kind = kind_of(path);
  if (kind != "msh" && kind != "stl" && kind != "obj" && kind != "ply")
    refuse(path, "is no mesh file: its name must end in .msh, .stl, .obj or .ply");
}

void add_object(const aiMesh& object, Surface& surface) {
  const Index first = surface.node_count();
  for (unsigned k = 0; k < object.mNumVertices; ++k)
    append(surface.positions, {object.mVertices[k].x, object.mVertices[k].y, object.mVertices[k].z});
  SurfacePart part{.name = object.mName.C_Str()};
  part.segment_begin = static_cast<Index>(surface.segments.size());
  part.triangle_begin = static_cast<Index>(surface.triangles.size());
  for (unsigned k = 0; k < object.mNumFaces; ++k) {
    const aiFace& face = object.mFaces[k];
    const auto node = [&](unsigned corner) { return first + static_cast<Index>(face.mIndices[corner]); };
    if (face.mNumIndices == 2) surface.segments.push_back({node(0), node(1)});
    if (face.mNumIndices == 3) surface.triangles.push_back({node(0), node(1), node(2)});
  }
  part.segment_end = static_cast<Index>(surface.segments.size());
  part.triangle_end = static_cast<Index>(surface.triangles.size());
  surface.parts.push_back(std::move(part));
}

Net read_with_assimp(const std::filesystem::path& path) {
  Assimp::Importer importer;
  // Corners that differ in their normal or colour only are one node.
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, aiComponent_NORMALS | aiComponent_TEXCOORDS |
                                                          aiComponent_COLORS | aiComponent_MATERIALS);
  const aiScene* scene = importer.ReadFile(
      path.string(), aiProcess_RemoveComponent | aiProcess_Triangulate | aiProcess_JoinIdenticalVertices);
  if (!scene) refuse(path, fmt::format("cannot be read: {}", importer.GetErrorString()));
  Net net;
  for (unsigned k = 0; k < scene->mNumMeshes; ++k) add_object(*scene->mMeshes[k], net.surface);
  if (net.surface.segments.empty() && net.surface.triangles.empty())
    refuse(path, "holds neither lines nor triangles");
  net.node_sets.push_back({"nodes", std::vector<Index>(static_cast<std::size_t>(net.surface.node_count()))});
  std::iota(net.node_sets[0].nodes.begin(), net.node_sets[0].nodes.end(), Index{0});
  return net;
}

/// assimp frees what a scene points to, so all of it is made by new.
void fill_scene(const Surface& surface, aiScene& scene) {
  auto* object = new aiMesh;
  object->mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
  object->mNumVertices = static_cast<unsigned>(surface.node_count());
  object->mVertices = new aiVector3D[object->mNumVertices];
  for (Index node = 0; node < surface.node_count(); ++node) {
    const core::Vector3 at = point(surface.positions, node);
    object->mVertices[node] = {static_cast<ai_real>(at.x()), static_cast<ai_real>(at.y()),
                               static_cast<ai_real>(at.z())};
  }
  object->mNumFaces = static_cast<unsigned>(surface.triangles.size());
  object->mFaces = new aiFace[object->mNumFaces];
  for (unsigned k = 0; k < object->mNumFaces; ++k) {
    object->mFaces[k].mNumIndices = 3;
    object->mFaces[k].mIndices = new unsigned[3];
    std::copy(surface.triangles[k].begin(), surface.triangles[k].end(), object->mFaces[k].mIndices);
  }
  scene.mNumMeshes = 1;
  scene.mMeshes = new aiMesh* [1] { object };
  scene.mNumMaterials = 1;
  scene.mMaterials = new aiMaterial* [1] { new aiMaterial };
  scene.mRootNode = new aiNode;
  scene.mRootNode->mNumMeshes = 1;
  scene.mRootNode->mMeshes = new unsigned[1]{0};
}

}  // namespace

Net read_mesh_file(const std::filesystem::path& path) {
  require_known_kind(path);
  if (!std::filesystem::is_regular_file(path)) refuse(path, "is no file");
  return kind_of(path) == "msh" ? read_gmsh(path) : read_with_assimp(path);
}

void write_mesh_file(const Net& net, const std::filesystem::path& path) {
  require_known_kind(path);
  if (kind_of(path) == "msh") return write_gmsh(net, path);
  if (!net.surface.segments.empty() || net.surface.triangles.empty())
    refuse(path, fmt::format(".{} files take triangles only, but the mesh has {} lines and {} triangles",
                             kind_of(path), net.surface.segments.size(), net.surface.triangles.size()));
  aiScene scene;
  fill_scene(net.surface, scene);
  Assimp::Exporter exporter;
  if (exporter.Export(&scene, kind_of(path), path.string()) != aiReturn_SUCCESS)
    refuse(path, fmt::format("cannot be written: {}", exporter.GetErrorString()));
}

Net extract_part(const Net& net, const std::string& name) {
  const auto& parts = net.surface.parts;
  const auto part =
      std::find_if(parts.begin(), parts.end(), [&](const SurfacePart& p) { return p.name == name; });
  if (part == parts.end()) {
    std::vector<std::string> names;
    for (const auto& each : parts) names.push_back(each.name);
    throw core::ConfigError(
        fmt::format("there is no part '{}' in the mesh; there are: {}", name, fmt::join(names, ", ")));
  }
  Net result;
  std::vector<Index> new_index(static_cast<std::size_t>(net.surface.node_count()), -1);
  const auto carry = [&](auto cell) {
    for (Index& node : cell) {
      Index& carried = new_index[static_cast<std::size_t>(node)];
      if (carried < 0) {
        carried = result.surface.node_count();
        append(result.surface.positions, point(net.surface.positions, node));
      }
      node = carried;
    }
    return cell;
  };
  for (Index k = part->segment_begin; k < part->segment_end; ++k)
    result.surface.segments.push_back(carry(net.surface.segments[static_cast<std::size_t>(k)]));
  for (Index k = part->triangle_begin; k < part->triangle_end; ++k)
    result.surface.triangles.push_back(carry(net.surface.triangles[static_cast<std::size_t>(k)]));
  result.surface.parts.push_back({.name = name,
                                  .material = part->material,
                                  .wire_radius = part->wire_radius,
                                  .segment_end = static_cast<Index>(result.surface.segments.size()),
                                  .triangle_end = static_cast<Index>(result.surface.triangles.size())});
  for (const auto& set : net.node_sets) {
    NodeSet cut{set.name, {}};
    for (const Index node : set.nodes)
      if (new_index[static_cast<std::size_t>(node)] >= 0)
        cut.nodes.push_back(new_index[static_cast<std::size_t>(node)]);
    if (!cut.nodes.empty()) result.node_sets.push_back(std::move(cut));
  }
  return result;
}

}  // namespace talus::mesh
