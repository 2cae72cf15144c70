#include <catch2/catch.hpp>

#include "core/errors.hpp"
#include "fem_solver/assembly/assembly.hpp"
#include "tests/support/finite_differences.hpp"
#include "tests/unit/fem_solver/elements_support.hpp"

using namespace talus;
using namespace talus::fem;
using namespace talus::test;

namespace {

constexpr Index side =
    9;  // nodes a side: 128 triangles, not a multiple of the lanes in the last row of blocks

/// A square sheet of side x side nodes, bumpy, two triangles a field, one of them left out so that the last
/// pack is not full.
std::vector<double> sheet_nodes(Dice& dice) {
  std::vector<double> x;
  for (Index j = 0; j < side; ++j)
    for (Index i = 0; i < side; ++i) {
      const Vector3 p = Vector3(0.1 * i, 0.1 * j, 0) + dice.vector(0.02);
      x.insert(x.end(), p.begin(), p.end());
    }
  return x;
}
std::vector<std::array<Index, 3>> sheet_triangles() {
  std::vector<std::array<Index, 3>> triangles;
  for (Index j = 0; j + 1 < side; ++j)
    for (Index i = 0; i + 1 < side; ++i) {
      const Index a = j * side + i, b = a + 1, c = a + side, d = c + 1;
      triangles.push_back({a, b, d});
      triangles.push_back({a, d, c});
    }
  triangles.pop_back();
  return triangles;
}

const PlaneElasticity net = PlaneElasticity::from(OrthotropicSheet{3e5, 1e5, 0.2, 2e4});

template <class Law>
ElementBatch membrane(const std::vector<double>& nodes) {
  return MembraneBatch<Law>({0.01, 1000, Vector3(1, 0.2, 0)}, Law(net, {500, 200, 0}), sheet_triangles(),
                            nodes);
}

ElementBatch rope(const std::vector<double>& nodes) {
  std::vector<std::array<Index, 2>> segments;
  for (Index i = 0; i + 1 < side * side; ++i) segments.push_back({i, i + 1});
  return SlidingCableBatch({{1e-4, 1e7, 1e5}, 7850}, 0, segments, nodes);
}

Model model_of(const std::vector<double>& nodes, ElementBatch batch) {
  Model model;
  model.reference = nodes;
  std::vector<Index> all(nodes.size() / 3);
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<Index>(i);
  model.parts.push_back({"part", std::move(batch), std::move(all)});
  lump_masses(model);
  return model;
}

double energy(const Model& model, const Eigen::VectorXd& u) {
  return std::visit([&](const auto& batch) { return batch.energy(span_of(u)); }, model.parts[0].elements);
}

/// Energy, force, stiffness and its products of a batch against each other, in a state where sheets are taut,
/// wrinkled and slack.
void check_batch(const Model& model, double stiffness_scale, bool has_potential) {
  Assembly assembly(model);
  Eigen::VectorXd u = 0.01 * Eigen::VectorXd::Random(static_cast<Eigen::Index>(model.reference.size()));
  const auto force = [&](const Eigen::VectorXd& at) {
    Eigen::VectorXd f(at.size());
    assembly.internal_force(span_of(at), {f.data(), static_cast<std::size_t>(f.size())});
    return Eigen::VectorXd(-f);
  };
  const Eigen::VectorXd w = Eigen::VectorXd::Random(u.size());
  constexpr double step = 1e-7;  // m, of nodes 0.1 m apart: 1e-12 of curvature, 1e-9 of round-off
  if (has_potential) {
    const double slope = (energy(model, u + step * w) - energy(model, u - step * w)) / (2 * step);
    CHECK(slope == Approx(w.dot(force(u))).margin(1e-6 * stiffness_scale));
  }
  const Eigen::VectorXd difference = (force(u + step * w) - force(u - step * w)) / (2 * step);
  Eigen::VectorXd product(u.size()), blocks = Eigen::VectorXd::Zero(u.size());
  assembly.stiffness_product(span_of(u), span_of(w),
                             {product.data(), static_cast<std::size_t>(product.size())});
  std::visit(
      [&](const auto& batch) {
        batch.stiffness(span_of(u), [&](Index row, Index column, const Matrix3& block) {
          blocks.segment<3>(3 * row) += block * w.segment<3>(3 * column);
        });
      },
      model.parts[0].elements);
  CHECK((difference - product).norm() < 1e-5 * stiffness_scale * w.norm());
  CHECK((blocks - product).norm() < 1e-12 * stiffness_scale * w.norm());
  assembly.stiffest_product(span_of(u), span_of(w), {blocks.data(), static_cast<std::size_t>(blocks.size())});
  CHECK(w.dot(blocks) >= w.dot(product) - 1e-12 * stiffness_scale);
}

}  // namespace

TEST_CASE("a batch of membranes or a rope gives the forces of its energy and the stiffness of its forces") {
  Dice dice(71);
  const std::vector<double> nodes = sheet_nodes(dice);
  const double sheet = 3e5 * 0.01, line = 1e7 * 1e-4;  // E t and E A
  check_batch(model_of(nodes, membrane<LinearSheet>(nodes)), sheet, true);
  check_batch(model_of(nodes, membrane<TensionField<ExactWrinkles>>(nodes)), sheet, true);
  check_batch(model_of(nodes, membrane<TensionField<PrincipalWrinkles>>(nodes)), sheet, false);
  check_batch(model_of(nodes, rope(nodes)), line / 0.1, true);
}

TEST_CASE(
    "springs that hold sliders on a rope give the forces of their energy and the stiffness of their forces") {
  // Two sliders beside a bent rope, between its nodes; the states of check_batch are within 0.01 m of it.
  const std::vector<double> nodes{0, 0, 0, 0.4, 0, 0, 0.8, 0.1, 0, 0.2, 0.05, 0.02, 0.6, 0.02, -0.03};
  const double penalty = 1e3;
  check_batch(model_of(nodes, PenaltySlideBatch({{0, 1, 2}, {3, 4}}, penalty, nodes)), penalty, true);
}

TEST_CASE("packed triangles have the bits of one triangle at a time") {
  Dice dice(72);
  const std::vector<double> nodes = sheet_nodes(dice);
  using Law = TensionField<ExactWrinkles>;
  const Law law(net, {500, 200, 0});
  const MembraneBatch<Law> batch({0.01, 1000, Vector3(1, 0.2, 0)}, law, sheet_triangles(), nodes);
  const Eigen::VectorXd u = 0.02 * Eigen::VectorXd::Random(static_cast<Eigen::Index>(nodes.size()));
  std::vector<double> slots(3 * static_cast<std::size_t>(batch.slots()));
  batch.internal_force(span_of(u), slots, {0, batch.size()});
  int states[3] = {};
  for (Index e = 0; e < batch.size(); ++e) {
    const auto [a, b, c] = batch.cells()[static_cast<std::size_t>(e)];
    const Vector3 w1 = u.segment<3>(3 * b) - u.segment<3>(3 * a),
                  w2 = u.segment<3>(3 * c) - u.segment<3>(3 * a);
    const auto triangle = batch.triangle(e);
    const auto deformation = triangle.deform({{{w1[0], w1[1], w1[2]}, {w2[0], w2[1], w2[2]}}});
    const auto [f1, f2] = triangle.force(deformation, law.stress(deformation.strain));
    const double* slot = &slots[6 * static_cast<std::size_t>(e)];
    CHECK((slot[0] == f1.x && slot[1] == f1.y && slot[2] == f1.z && slot[3] == f2.x && slot[4] == f2.y &&
           slot[5] == f2.z));
    ++states[static_cast<int>(batch.state(span_of(u), e))];
  }
  for (const int count : states) CHECK(count > 3);
}

TEST_CASE("the mass of a sheet and of a rope is density times volume") {
  Dice dice(73);
  const std::vector<double> nodes = sheet_nodes(dice);
  const Model sheet = model_of(nodes, membrane<LinearSheet>(nodes)), line = model_of(nodes, rope(nodes));
  double area = 0, length = 0;
  const auto at = [&](Index i) { return Vector3(Vector3::Map(&nodes[3 * static_cast<std::size_t>(i)])); };
  for (const auto& [a, b, c] : sheet_triangles()) area += 0.5 * (at(b) - at(a)).cross(at(c) - at(a)).norm();
  for (Index i = 0; i + 1 < side * side; ++i) length += (at(i + 1) - at(i)).norm();
  const auto total = [](const Model& model) {
    double sum = 0;
    for (const double m : model.node_masses) sum += m;
    return sum;
  };
  CHECK(total(sheet) == Approx(1000 * 0.01 * area).epsilon(1e-12));
  CHECK(total(line) == Approx(7850 * 1e-4 * length).epsilon(1e-12));
}

TEST_CASE(
    "a rope whose segments do not follow each other, or whose nodes coincide, is refused with the place") {
  using Catch::Matchers::Contains;
  const std::vector<double> nodes{0, 0, 0, 1, 0, 0, 2, 0, 0, 2, 0, 0};
  const AxialPart part{{1e-4, 1e7, 0}, 7850};
  CHECK_THROWS_WITH(SlidingCableBatch(part, 0, {{0, 1}, {2, 3}}, nodes),
                    Contains("after (1, 0, 0) m it goes on at (2, 0, 0) m"));
  CHECK_THROWS_WITH(SlidingCableBatch(part, 0, {{1, 2}, {2, 3}}, nodes), Contains("coincide at (2, 0, 0) m"));
}
