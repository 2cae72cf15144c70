#include <fmt/format.h>

#include <cstdlib>
#include <memory>
#include <string_view>

#include "fem_solver/app/structure.hpp"
#include "fem_solver/integration/explicit.hpp"
#include "tests/verification/effects/lean_structure.hpp"

/// count_structure whole|lean SCENE STEPS: takes explicit steps of a scene with the whole solver, or with one
/// that knows nothing but elements and still supports. Prints the bytes of heap that the solver takes.
namespace {

using namespace talus;

class WholeStructure final : public test::Stepper {
 public:
  WholeStructure(const fem::Model& model, double step, bool watched)
      : step_(step), assembly_(model), solver_(model, assembly_, step) {
    if (watched) solver_.watch_step();
  }
  void step() override {
    solver_.advance(static_cast<double>(steps_) * step_, step_);
    ++steps_;
  }

 private:
  double step_;
  std::int64_t steps_ = 0;
  fem::Assembly assembly_;
  fem::ExplicitSolver solver_;
};

}  // namespace

int main(int count, char** arguments) {
  if (count != 4) return EXIT_FAILURE;
  const auto scene = fem::read_structural_scene(core::SceneFile::load(arguments[2]));
  fem::Structure structure(scene);
  const std::size_t before = test::heap_bytes();
  std::unique_ptr<test::Stepper> stepper;
  if (std::string_view(arguments[1]) == "lean")
    stepper = std::make_unique<test::LeanStructure>(structure.model(), structure.step());
  else
    stepper = std::make_unique<WholeStructure>(
        structure.model(), structure.step(),
        scene.structure.unstable_step == fem::StructureScene::UnstableStep::refused);
  stepper->step();
  fmt::print("{}\n", test::heap_bytes() - before);
  test::counted_steps(*stepper, std::atoi(arguments[3]));
}
