// What a scene's structure costs without its rock: the explicit step limit, the condition number of an
// implicit step's matrix K + (4/dt^2) M with dt = 1 ms, and the time of an explicit step, best of several,
// while the panel swings. One JSON object. Usage: bench_panel_structure SCENE
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdio>

#include "core/scene/reader.hpp"
#include "fem_solver/app/structure.hpp"
#include "fem_solver/assembly/sparse_stiffness.hpp"
#include "fem_solver/integration/explicit.hpp"
#include "fem_solver/integration/linear_solver.hpp"

namespace {

using namespace talus::fem;

constexpr double implicit_step = 1e-3;  // s
constexpr int iterations = 300;         // of the power method; the crowded ends are found to about 1 %

/// Largest eigenvalue of a symmetric positive definite map by the power method.
template <class Map>
double largest_eigenvalue(Eigen::Index size, const Map& map) {
  Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(size, 1, 2).array().sin();
  double value = 0;
  for (int k = 0; k < iterations; ++k) {
    x = map(Eigen::VectorXd(x.normalized()));
    value = x.norm();
  }
  return value;
}

double condition_number(const Model& model) {
  const Equations equations(model);
  SparseStiffness stiffness(model, equations);
  std::vector<double> inertia;
  for (const double mass : model.node_masses)
    inertia.insert(inertia.end(), 3, 4 * mass / (implicit_step * implicit_step));
  const SparseMatrix& matrix =
      stiffness.assemble(std::vector<double>(model.reference.size(), 0.0), 1, inertia);
  LinearSolver solver;
  if (!solver.factorise(matrix)) return INFINITY;
  return largest_eigenvalue(matrix.rows(),
                            [&](const Eigen::VectorXd& x) {
                              return Eigen::VectorXd(matrix.selfadjointView<Eigen::Lower>() * x);
                            }) *
         largest_eigenvalue(matrix.rows(), [&](const Eigen::VectorXd& x) { return solver.solve(x); });
}

std::size_t elements(const Model& model) {
  std::size_t count = 0;
  for (const auto& part : model.parts)
    count += std::visit([](const auto& batch) { return batch.cells().size(); }, part.elements);
  for (const auto& slide : model.constrained_slides) count += slide.line.sliders.size();
  return count;
}

/// The panel swings down at up to 3 m/s, so that elements are taut, wrinkled and slack.
void swing(const Model& model, ExplicitState& state) {
  for (Index node = 0; node < model.nodes(); ++node) {
    const Vector3 x = model.position(node) * M_PI / 3;
    state.velocity[3 * static_cast<std::size_t>(node) + 2] = -3 * std::sin(x.x()) * std::sin(x.y());
  }
}

double seconds_a_step(Structure& structure) {
  constexpr int rounds = 20, steps = 100;
  auto& solver = dynamic_cast<ExplicitSolver&>(structure.integrator());
  swing(structure.model(), solver.state());
  double best = INFINITY, time = 0;
  for (int round = 0; round < rounds; ++round) {
    const auto start = std::chrono::steady_clock::now();
    for (int k = 0; k < steps; ++k, time += structure.step()) solver.step(time, structure.step());
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    best = std::min(best, spent.count() / steps);
  }
  return best;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    std::fputs("usage: bench_panel_structure SCENE\n", stderr);
    return 2;
  }
  try {
    StructuralScene scene = read_structural_scene(talus::core::SceneFile::load(arguments[1]));
    scene.structure.step.reset();  // half of the limit
    scene.time.step.reset();
    Structure structure(scene);
    const double condition =
        structure.model().constrained_slides.empty() ? condition_number(structure.model()) : NAN;
    const double seconds = seconds_a_step(structure);
    fmt::print(
        "{{\"step_limit_s\": {:.4g}, \"condition\": {}, \"elements\": {}, \"us_a_step\": {:.3g}, "
        "\"ns_an_element_step\": {:.3g}}}\n",
        structure.bounds().front().seconds,
        std::isfinite(condition) ? fmt::format("{:.2g}", condition) : "null", elements(structure.model()),
        1e6 * seconds, 1e9 * seconds / static_cast<double>(elements(structure.model())));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
