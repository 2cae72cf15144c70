#include <fmt/format.h>

#include <cstdlib>
#include <memory>
#include <string_view>

#include "dem_solver/app/particle_run.hpp"
#include "tests/verification/effects/lean_particles.hpp"

/// count_particles whole|lean SCENE STEPS: takes steps of a scene with the whole solver, or with one that
/// knows nothing but spheres in contact, with wires where the scene has some. Prints the bytes of heap that
/// the solver takes.
namespace {

using namespace talus;

class WholeParticles final : public test::Stepper {
 public:
  explicit WholeParticles(const dem::ParticleModel& model) : solver_(model) {
    // As a coupled run would tell: what the structure's nodes weigh.
    const auto nodes = static_cast<std::size_t>(solver_.boundary().node_count());
    if (model.implicit_contact) solver_.boundary().set_node_masses(std::vector<double>(nodes, 0.01), 0);
  }
  void step() override { solver_.step(); }

 private:
  dem::ParticleSolver solver_;
};

}  // namespace

int main(int count, char** arguments) {
  if (count != 4) return EXIT_FAILURE;
  const auto scene = dem::read_run_scene(core::SceneFile::load(arguments[2]));
  auto model = dem::build_model(scene.particles, dem::make_surface(scene.particles.boundaries),
                                {.step = *scene.time.step, .ledger = scene.output.has_value()});
  model.skin = 0.2 * model.spheres.front().radius;  // the same searches for both
  const std::size_t before = test::heap_bytes();
  std::unique_ptr<test::Stepper> stepper;
  if (std::string_view(arguments[1]) != "lean")
    stepper = std::make_unique<WholeParticles>(model);
  else if (model.boundary.empty())
    stepper = std::make_unique<test::LeanParticles>(model);
  else
    stepper = std::make_unique<test::LeanParticlesAndWires>(model);
  stepper->step();  // the first search for neighbours
  fmt::print("{}\n", test::heap_bytes() - before);
  test::counted_steps(*stepper, std::atoi(arguments[3]));
}
