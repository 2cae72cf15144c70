#include "fem_solver/elements/membrane.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "core/errors.hpp"

namespace talus::fem {
namespace {

std::string place(const Vector3& x) {
  return fmt::format("({:g}, {:g}, {:g})", x[0], x[1], x[2]);
}

Triple<double> triple(const Vector3& v) {
  return {v[0], v[1], v[2]};
}
Vector3 vector(const Triple<double>& v) {
  return {v.x, v.y, v.z};
}

struct Facing {
  Vector3 unit_normal;
  double twice_area = 0;  ///< m^2
};

Facing facing(const MembranePatch& patch) {
  const auto& [a, b, c] = patch.nodes;
  const Vector3 edge = b - a, other = c - a, normal = edge.cross(other);
  const double twice_area = normal.norm();
  constexpr double flattest = 1e-9;  // height over edge; below it the gradients have lost half their digits
  if (!(twice_area > flattest * std::max(edge.squaredNorm(), other.squaredNorm())))
    throw core::ConfigError(fmt::format("a membrane triangle has no area: its nodes are {}, {}, {} m",
                                        place(a), place(b), place(c)));
  return {normal / twice_area, twice_area};
}

Vector3 first_axis(const MembranePatch& patch, const Vector3& unit_normal) {
  const Vector3 wanted = patch.material_axis.value_or(patch.nodes[1] - patch.nodes[0]);
  const Vector3 projected = wanted - wanted.dot(unit_normal) * unit_normal;
  constexpr double steepest = 1.75e-4;  // sine of 0.01 degrees
  if (!(projected.norm() > steepest * wanted.norm()))
    throw core::ConfigError(
        fmt::format("the material axis {} stands upright on a membrane triangle whose first node is {} m",
                    place(wanted), place(patch.nodes[0])));
  return projected.normalized();
}

}  // namespace

MembraneTriangle<double> membrane_triangle(const MembranePatch& patch) {
  const auto [unit_normal, twice_area] = facing(patch);
  const Vector3 A1 = first_axis(patch, unit_normal), A2 = unit_normal.cross(A1);
  const Vector3 b = patch.nodes[1] - patch.nodes[0], c = patch.nodes[2] - patch.nodes[0];
  return {{triple(A1), triple(A2)},
          {{{A2.dot(c) / twice_area, -A1.dot(c) / twice_area},
            {-A2.dot(b) / twice_area, A1.dot(b) / twice_area}}},
          0.5 * twice_area * patch.thickness};
}

Matrix9 membrane_stiffness(const MembraneTriangle<double>& triangle,
                           const MembraneTriangle<double>::Deformation& deformation,
                           const PlaneStress<double>& stress, const PlaneMatrix& tangent) noexcept {
  const Vector3 a1 = vector(deformation.tangents[0]), a2 = vector(deformation.tangents[1]);
  const auto& g = triangle.gradient;
  const double g0[2] = {-g[0][0] - g[1][0], -g[0][1] - g[1][1]};
  const std::array<Eigen::Vector2d, 3> gradients{
      Eigen::Vector2d(g0[0], g0[1]), Eigen::Vector2d(g[0][0], g[0][1]), Eigen::Vector2d(g[1][0], g[1][1])};
  Eigen::Matrix<double, 3, 9> B;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector2d& gi = gradients[static_cast<std::size_t>(i)];
    B.col(3 * i) << gi[0] * a1[0], gi[1] * a2[0], gi[0] * a2[0] + gi[1] * a1[0];
    B.col(3 * i + 1) << gi[0] * a1[1], gi[1] * a2[1], gi[0] * a2[1] + gi[1] * a1[1];
    B.col(3 * i + 2) << gi[0] * a1[2], gi[1] * a2[2], gi[0] * a2[2] + gi[1] * a1[2];
  }
  Eigen::Matrix2d s;
  s << stress.xx, stress.xy, stress.xy, stress.yy;
  Matrix9 K = B.transpose() * tangent * B;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const double geometric =
          gradients[static_cast<std::size_t>(i)].dot(s * gradients[static_cast<std::size_t>(j)]);
      K.block<3, 3>(3 * i, 3 * j).diagonal().array() += geometric;
    }
  return triangle.volume * K;
}

}  // namespace talus::fem
