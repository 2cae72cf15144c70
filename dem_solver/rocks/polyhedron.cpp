#include "dem_solver/rocks/polyhedron.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace talus::dem {

namespace {

core::Vector3 node(const mesh::Surface& surface, mesh::Index i) {
  return core::Vector3(surface.positions[3 * i], surface.positions[3 * i + 1], surface.positions[3 * i + 2]);
}

struct Face {
  std::array<mesh::Index, 3> nodes;
  core::Vector3 a, b, c;
  Eigen::AlignedBox3d box() const { return Eigen::AlignedBox3d(a).extend(b).extend(c); }
  bool shares_node(const Face& other) const {
    return std::ranges::any_of(nodes, [&](mesh::Index i) { return std::ranges::count(other.nodes, i) > 0; });
  }
};

/// Whether p-q passes through the inside of the face.
bool pierces(const core::Vector3& p, const core::Vector3& q, const Face& f) {
  const auto volume = [](const core::Vector3& u, const core::Vector3& v, const core::Vector3& w) {
    return u.cross(v).dot(w);
  };
  const double above = volume(f.b - f.a, f.c - f.a, p - f.a), below = volume(f.b - f.a, f.c - f.a, q - f.a);
  if (above * below >= 0) return false;
  const core::Vector3 d = q - p;
  const double s = volume(d, f.a - p, f.b - p), t = volume(d, f.b - p, f.c - p),
               u = volume(d, f.c - p, f.a - p);
  return (s > 0 && t > 0 && u > 0) || (s < 0 && t < 0 && u < 0);
}

bool cross_each_other(const Face& f, const Face& g) {
  if (f.shares_node(g) || !f.box().intersects(g.box())) return false;
  for (const auto& [x, y] : {std::pair{&f, &g}, std::pair{&g, &f}})
    if (pierces(x->a, x->b, *y) || pierces(x->b, x->c, *y) || pierces(x->c, x->a, *y)) return true;
  return false;
}

std::string at(const core::Vector3& p) {
  return "(" + std::to_string(p.x()) + ", " + std::to_string(p.y()) + ", " + std::to_string(p.z()) + ") m";
}

/// Every edge must be run along once in each direction.
std::string open_edge(const mesh::Surface& surface) {
  std::map<std::pair<mesh::Index, mesh::Index>, int> edges;
  for (const auto& [a, b, c] : surface.triangles)
    for (const auto& edge : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}}) ++edges[edge];
  for (const auto& [edge, count] : edges) {
    const auto back = edges.find({edge.second, edge.first});
    if (count == 1 && back != edges.end()) continue;
    return "the surface is not closed: the edge from " + at(node(surface, edge.first)) + " to " +
           at(node(surface, edge.second)) +
           (count > 1 ? " belongs to several triangles of the same direction"
                      : " belongs to one triangle only");
  }
  return {};
}

std::string crossing(const mesh::Surface& surface) {
  std::vector<Face> faces;
  for (const auto& t : surface.triangles)
    faces.push_back({t, node(surface, t[0]), node(surface, t[1]), node(surface, t[2])});
  for (std::size_t i = 0; i < faces.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (cross_each_other(faces[i], faces[j]))
        return "the surface crosses itself: triangles " + std::to_string(j) + " and " + std::to_string(i) +
               " near " + at(faces[i].a);
  return {};
}

}  // namespace

VolumeMoments polyhedron_moments(const mesh::Surface& surface) {
  VolumeMoments total;
  for (const auto& t : surface.triangles) {
    const core::Vector3 a = node(surface, t[0]), b = node(surface, t[1]), c = node(surface, t[2]),
                        s = a + b + c;
    const double volume = a.dot(b.cross(c)) / 6;
    total.volume += volume;
    total.first += volume / 4 * s;
    total.second +=
        volume / 20 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose());
  }
  return total;
}

std::string closed_surface_fault(const mesh::Surface& surface) {
  if (surface.triangles.empty()) return "the surface has no triangles";
  if (std::string fault = open_edge(surface); !fault.empty()) return fault;
  if (polyhedron_moments(surface).volume <= 0)
    return "the surface is turned inside out: its volume is not positive";
  return crossing(surface);
}

double block_edge(double volume, double cut) {
  return std::cbrt(volume / (1 - 4.0 / 3 * cut * cut * cut));
}

mesh::Surface make_block(const BlockShape& shape) {
  // Each corner of the cube becomes three nodes, on the edges along x, y and z.
  const double h = 0.5 * shape.edge, inner = h - shape.cut * shape.edge;
  mesh::Surface surface;
  const auto corner = [](int sx, int sy, int sz) {
    return static_cast<mesh::Index>(3 * (sx + 2 * sy + 4 * sz));
  };
  for (int k = 0; k < 8; ++k) {
    const core::Vector3 s(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1);
    for (int axis = 0; axis < 3; ++axis) {
      core::Vector3 p = h * s;
      p[axis] = inner * s[axis];
      surface.positions.insert(surface.positions.end(), p.data(), p.data() + 3);
    }
  }
  const auto add = [&](mesh::Index a, mesh::Index b, mesh::Index c) {
    const core::Vector3 p = node(surface, a), n = (node(surface, b) - p).cross(node(surface, c) - p);
    if (n.dot(p) > 0)
      surface.triangles.push_back({a, b, c});  // the block is convex about the origin
    else
      surface.triangles.push_back({a, c, b});
  };
  for (mesh::Index k = 0; k < 8; ++k) add(3 * k, 3 * k + 1, 3 * k + 2);
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      std::vector<mesh::Index> ring;  // the octagon of this face, in order
      for (const auto& [su, sv] : {std::pair{0, 0}, std::pair{1, 0}, std::pair{1, 1}, std::pair{0, 1}}) {
        std::array<int, 3> s{};
        s[axis] = side;
        s[u] = su;
        s[v] = sv;
        const mesh::Index k = corner(s[0], s[1], s[2]);
        const bool along_u_next = su == sv;  // leaving (0, 0) and (1, 1) along u, the others along v
        ring.push_back(k + (along_u_next ? v : u));
        ring.push_back(k + (along_u_next ? u : v));
      }
      for (std::size_t i = 1; i + 1 < ring.size(); ++i) add(ring[0], ring[i], ring[i + 1]);
    }
  surface.parts = {{.name = "block", .triangle_end = static_cast<mesh::Index>(surface.triangles.size())}};
  return surface;
}

}  // namespace talus::dem
