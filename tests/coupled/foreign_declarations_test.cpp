#include <catch2/catch.hpp>

#include <map>

#include "coupler/launch/find_solver.hpp"
#include "coupler/messages/messages.hpp"
#include "coupler/participant.hpp"
#include "coupler/session/introduction.hpp"
#include "coupler/transport/segment.hpp"

using namespace talus;
using coupler::Action;
using coupler::Order;
using coupler::Role;
using coupler::transport::ArrayName;

// What participants in C and Python can say of themselves arrives in the coupler as a participant in C++ would say
// it. The programs are participants/everything.c and everything.py; what they say is written here once more.
namespace {

const std::string in_c = TALUS_BINARY_DIR "/bin/everything_c";
const std::string in_python = TALUS_SOURCE_DIR "/tests/coupled/participants/everything.py";
constexpr double length = 1e-3;

/// Both sides are programs in other languages, and the test is the coupler between them.
class ForeignPair {
 public:
  /// @param mode "free": explicit, the particles want the boundary's free velocity; "light": strong, they say where
  /// its light nodes went
  ForeignPair(const std::string& structure, const std::string& particles, const std::string& mode)
      : session_(coupler::transport::create_shared_segment(), {.timeout = 20}) {
    launch(Role::structure, structure, {"structure"});
    launch(Role::particles, particles, {"particles", mode});
    session_.wait_joined();
    interface_ = coupler::introduce(session_, coupler::identical_surfaces());
    coupler::lay_out_arrays(session_, interface_, {length},
                            mode == "free" ? Order::together : Order::iterated_light);
  }
  coupler::Session& session() { return session_; }
  const coupler::Interface& interface() const { return *interface_; }
  coupler::Peer& structure() { return *session_.find(Role::structure); }
  coupler::Peer& particles() { return *session_.find(Role::particles); }

 private:
  void launch(Role role, const std::string& file, const std::vector<std::string>& arguments) {
    auto program = coupler::launch::named_solver(file, file).value();
    program.command.insert(program.command.end(), arguments.begin(), arguments.end());
    session_.launch(role, program);
  }

  coupler::Session session_;
  std::optional<coupler::Interface> interface_;
};

mesh::Surface expected_surface() {
  return {.positions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0},
          .segments = {{3, 0}},
          .triangles = {{0, 1, 2}, {0, 2, 3}},
          .parts = {{.name = "rope", .material = "steel", .wire_radius = 0.01, .segment_end = 1},
                    {.name = "sheet", .segment_begin = 1, .segment_end = 1, .triangle_end = 2}},
          .start = {0, 0, 0, 0, 0, -0.5, 0, 0, 0, 0, 0, 0}};
}

core::OutputDescription expected_outputs() {
  using enum core::LedgerKind;
  return {.probes = {{.name = "middle.displacement_z_m", .watches = "node 2"}, {.name = "rim.force_N"}},
          .ledger = {{"structure.elastic_J", stored},
                     {"structure.damping_J", dissipated},
                     {"structure.gravity_J", supplied},
                     {"structure.rim_J", memo}},
          .groups = {{.name = "sheet",
                      .kind = core::CellKind::triangle,
                      .nodes = 4,
                      .cells = {0, 1, 2, 0, 2, 3},
                      .fields = {{.name = "displacement", .unit = "m", .components = 3},
                                 {.name = "strain", .unit = "1", .location = core::FieldLocation::cell}}}},
          .tables = {{.name = "below", .columns = {"time_s", "diameter_m"}, .capacity = 3},
                     {.name = "sizes",
                      .columns = {"diameter_m"},
                      .capacity = 2,
                      .kind = core::TableKind::distribution,
                      .rows = {"small", "large"}}},
          .facts = {{"structure.mass_kg", 6.5}}};
}

coupler::Declaration expected_declaration() {
  return {.program = "everything 1.0",
          .step = 1e-3,
          .insists_on_step = true,
          .free_velocity = true,
          .loses_cells = true,
          .checkpoints = true,
          .force_use = coupler::ForceUse::load,
          .limits = {{.name = "springs", .seconds = 2e-3, .reason = "2 sqrt(m/k)"},
                     {.name = "waves", .seconds = 1e-4, .stability = false, .reason = "l/c"}},
          .effects = {{.name = "damping",
                       .present = true,
                       .reason = "damping is given",
                       .key = "structure.damping",
                       .ledger_line = "structure.damping_J",
                       .may_hold = true,
                       .limit = "springs"},
                      {.name = "plasticity", .present = false, .reason = "no yield stress"}},
          .outputs = expected_outputs(),
          .warnings = {"the rim is soft"}};
}

std::vector<double> copied(std::span<const double> values) {
  return {values.begin(), values.end()};
}

}  // namespace

TEST_CASE("what a structure in C or Python says of itself is what one in C++ would say") {
  const std::string program = GENERATE(in_c, in_python);
  INFO(program);
  ForeignPair pair(program, in_c, "free");
  CHECK(pair.interface().structure == expected_surface());
  CHECK(pair.interface().structure_masses == std::vector<double>{1, 2, 3, 1e30});
  CHECK(coupler::encode(pair.structure().declaration()) == coupler::encode(expected_declaration()));
  pair.session().finish();
}

TEST_CASE("a structure in C or Python fills every output, its work and its counter") {
  const std::string program = GENERATE(in_c, in_python);
  INFO(program);
  ForeignPair pair(program, in_c, "free");
  coupler::Peer& structure = pair.structure();
  pair.session().ask(structure, {.action = Action::advance,
                                 .tentative = true,
                                 .window = 3,
                                 .iteration = 2,
                                 .time = 3e-3,
                                 .length = 5e-4,
                                 .regular_length = length});
  CHECK(copied(structure.array(ArrayName::displacement).first(3)) == std::vector<double>{3e-3, 5e-4, 1e-3});
  CHECK(copied(structure.array(ArrayName::velocity).first(2)) == std::vector<double>{1, 2});
  CHECK(structure.array(ArrayName::free_velocity)[0] == 0.75);
  CHECK(copied(structure.array(ArrayName::lost)) == std::vector<double>{0, 1, 0});
  CHECK(structure.window_work() == 0.125);
  CHECK(structure.force_evaluations() == 3);

  pair.session().ask(structure, {.action = Action::report, .fields = true, .window = 4});
  const auto block = structure.array(ArrayName::outputs);
  const coupler::OutputArrays& outputs = structure.output_arrays();
  CHECK(copied(outputs.probes(block)) == std::vector<double>{1, 2});
  CHECK(copied(outputs.ledger(block)) == std::vector<double>{3, 4, 5, 6});
  CHECK(copied(outputs.table(block, 0)) == std::vector<double>{7, 8, 9, 10, 0, 0});
  CHECK(outputs.table_rows(block, 0) == 2);
  CHECK(copied(outputs.table(block, 1)) == std::vector<double>{11, 12});
  CHECK(outputs.positions(block, 0)[11] == 13);
  CHECK(outputs.field(block, 0, 0)[11] == 14);
  CHECK(copied(outputs.field(block, 0, 1)) == std::vector<double>{0, 15});
  pair.session().finish();
}

TEST_CASE("particles in C or Python learn the boundary with its parts, masses and start") {
  const std::string program = GENERATE(in_c, in_python);
  INFO(program);
  ForeignPair pair(in_c, program, "free");
  std::map<std::string, double> learnt;
  for (const auto& fact : pair.particles().declaration().outputs.facts) learnt[fact.name] = fact.value;
  CHECK(learnt == std::map<std::string, double>{{"rope of steel", 1.01},
                                                {"sheet of any", 21},
                                                {"start of node 1", -0.5},
                                                {"mass of node 2", 3},
                                                {"corner of triangle 1", 2}});
  CHECK(pair.particles().declaration().free_velocity);
  CHECK(pair.particles().declaration().light_boundary);
  pair.session().finish();
}

TEST_CASE("particles in C or Python see the arrays that the run needs, and no others") {
  const std::string program = GENERATE(in_c, in_python);
  const std::string mode = GENERATE("free", "light");
  INFO(program << " " << mode);
  ForeignPair pair(in_c, program, mode);
  coupler::Peer& particles = pair.particles();
  particles.array(ArrayName::displacement)[0] = 0.5;
  particles.array(ArrayName::velocity)[1] = 0.25;
  particles.array(ArrayName::lost)[1] = 1;
  const bool light = mode == "light";
  if (light) {
    particles.array(ArrayName::end_displacement)[0] = 2;
    particles.array(ArrayName::end_velocity)[0] = 4;
  } else {
    particles.array(ArrayName::free_velocity)[0] = 8;
    particles.array(ArrayName::end_displacement)[0] = 2;  // the structure wants loads of the whole window
  }
  pair.session().ask(particles, {.action = Action::advance, .length = length, .force_shift = 1e-4});
  const auto force = particles.array(ArrayName::force);
  CHECK(copied(force.first(3)) == std::vector<double>{0.75, 1e-4, 1});
  CHECK(force[3] == (light ? -1 : 8));
  CHECK(force[4] == (light ? 6 : 2));
  REQUIRE(particles.array(ArrayName::moved_displacement).size() == (light ? 12 : 0));
  if (light) {
    CHECK(particles.array(ArrayName::moved_displacement)[0] == 16);
    CHECK(particles.array(ArrayName::moved_velocity)[0] == 17);
  }
  pair.session().finish();
}
