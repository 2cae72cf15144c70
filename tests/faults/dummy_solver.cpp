// A participant that misbehaves as its scene says: `misbehave: {structure: kill, at: 20}`, read as plain
// text.
//
//     dummy_solver_structure SCENE --join SEGMENT        the role is in the program's name

#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <thread>

#include "core/errors.hpp"
#include "tests/support/two_masses.hpp"

namespace {

using namespace talus;

struct Behaviour {
  std::string name = "none";
  std::int64_t window = 0;
};

Behaviour behaviour_of(const std::string& scene, const std::string& side) {
  std::ifstream file(scene);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  std::smatch found;
  if (!std::regex_search(text, found, std::regex(side + ":[^\\n]*behaviour: (\\w+), at: (-?\\d+)")))
    return {};
  return {.name = found[1], .window = std::stoll(found[2])};
}

void misbehave(const std::string& name) {
  if (name == "exit") _exit(7);
  if (name == "killed") raise(SIGKILL);
  if (name == "stopped") raise(SIGSTOP);
  if (name == "asleep") std::this_thread::sleep_for(std::chrono::hours(1));
  // Volatile, because a compiler may take it that a loop without effects ends.
  for (volatile bool busy = name == "busy"; busy;) {
  }
  if (name == "throws") throw std::runtime_error("the matrix is singular");
  if (name == "numerical") {
    throw core::NumericalError(
        {.what = "displacement is not finite", .entity = "node 0", .step = 20, .time = 0.02, .value = 1e300});
  }
  if (name == "refuses")
    throw core::ConfigError(
        std::vector<core::Complaint>{{"scene.yaml", 3, 1, "structure", "no such material"}});
}

/// The system of two masses, with a fault before a window is computed and a pause in each, so that a test can
/// act meanwhile.
class Faulty final : public coupler::Participant {
 public:
  Faulty(coupler::Participant& real, Behaviour behaviour) : real_(real), behaviour_(std::move(behaviour)) {}
  void publish_surface(const mesh::Surface& surface, std::span<const double> masses) override {
    real_.publish_surface(surface, masses);
  }
  mesh::Surface receive_surface(std::vector<double>& masses) override {
    return real_.receive_surface(masses);
  }
  void declare(const coupler::Declaration& declaration) override { real_.declare(declaration); }
  coupler::Command next() override {
    const auto command = real_.next();
    if (command.action != coupler::Action::advance) return command;
    if (command.window == behaviour_.window) misbehave(behaviour_.name);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return command;
  }
  void answer() override { real_.answer(); }
  void fail(const std::exception& error) noexcept override { real_.fail(error); }
  coupler::StructureFields structure_fields() override { return real_.structure_fields(); }
  coupler::ParticleFields particle_fields() override { return real_.particle_fields(); }
  std::span<double> probes() override { return real_.probes(); }
  std::span<double> ledger() override { return real_.ledger(); }
  std::span<double> positions(std::size_t group) override { return real_.positions(group); }
  std::span<double> field(std::size_t group, std::size_t field) override { return real_.field(group, field); }
  std::span<double> table(std::size_t table) override { return real_.table(table); }
  double& table_rows(std::size_t table) override { return real_.table_rows(table); }

 private:
  coupler::Participant& real_;
  Behaviour behaviour_;
};

}  // namespace

int main(int argc, char** argv) {
  const std::string program = argv[0], scene = argv[1], segment = argv[argc - 1];
  const bool is_structure = program.ends_with("structure");
  const Behaviour behaviour = behaviour_of(scene, is_structure ? "structure" : "particles");
  if (behaviour.window == -2) misbehave(behaviour.name);  // before it joins
  const coupler::JoinOptions options{
      .segment = segment, .role = is_structure ? coupler::Role::structure : coupler::Role::particles};
  return static_cast<int>(coupler::take_part(options, [&](coupler::Participant& participant) {
    if (behaviour.window == -1) misbehave(behaviour.name);  // before it introduces itself
    Faulty faulty(participant, behaviour);
    is_structure ? test::serve_structure(faulty, {}) : test::serve_particles(faulty, {});
  }));
}
