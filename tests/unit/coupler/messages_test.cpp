#include "coupler/messages/messages.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/errors.hpp"
#include "coupler/messages/output_arrays.hpp"
#include "coupler/messages/validate.hpp"

using namespace talus;
using namespace talus::coupler;
using Catch::Matchers::Contains;

TEST_CASE("a surface arrives as it was sent") {
  PublishedSurface sent;
  sent.surface.positions = {0, 0, 0, 1, 0.1, -1e-300, 0, 1, 1. / 3};
  sent.surface.segments = {{0, 1}, {1, 2}};
  sent.surface.triangles = {{0, 1, 2}};
  sent.surface.parts = {
      {.name = "net", .material = "wire", .wire_radius = 0.002, .segment_end = 2, .triangle_end = 1}};
  sent.node_masses = {0.03, 0.04, 0.05};
  const PublishedSurface got = decode_surface(encode(sent));
  CHECK(got.surface == sent.surface);
  CHECK(got.node_masses == sent.node_masses);
}

TEST_CASE("a declaration arrives as it was sent") {
  Declaration sent{.program = "dummy 1.0", .step = 5e-5, .insists_on_step = true};
  sent.limits = {{.name = "bars", .seconds = 6e-5, .stability = true, .reason = "2/w"}};
  sent.effects = {{.name = "friction",
                   .present = true,
                   .reason = "named",
                   .key = "contacts.friction",
                   .ledger_line = "dummy.friction_J",
                   .may_hold = true,
                   .limit = "none"}};
  sent.outputs.probes = {{"a.displacement_z_m", "node 7 of net"}};
  sent.outputs.ledger = {{"structure.kinetic_J", core::LedgerKind::stored},
                         {"structure.damping_J", core::LedgerKind::dissipated}};
  sent.outputs.groups = {
      {.name = "net",
       .kind = core::CellKind::segment,
       .nodes = 3,
       .cells = {0, 1, 1, 2},
       .fields = {{.name = "force", .unit = "N", .components = 1, .location = core::FieldLocation::cell}}}};
  sent.outputs.tables = {
      {.name = "gate", .columns = {"time_s", "stone"}, .capacity = 7, .kind = core::TableKind::distribution}};
  sent.outputs.facts = {{.name = "rock.spheres", .value = 16}};
  sent.warnings = {"steel of 1770 mPa"};
  const Declaration got = decode_declaration(encode(sent));
  REQUIRE(got.outputs.facts.size() == 1);
  CHECK(got.outputs.facts[0].name == "rock.spheres");
  CHECK(got.outputs.facts[0].value == 16);
  CHECK(got.warnings == sent.warnings);
  CHECK(got.program == sent.program);
  CHECK(got.step == sent.step);
  CHECK(got.insists_on_step);
  REQUIRE(got.limits.size() == 1);
  CHECK(got.limits[0].reason == "2/w");
  REQUIRE(got.outputs.probes.size() == 1);
  CHECK(got.outputs.probes[0].name == "a.displacement_z_m");
  CHECK(got.outputs.probes[0].watches == "node 7 of net");
  REQUIRE(got.effects.size() == 1);
  CHECK(got.effects[0].key == "contacts.friction");
  CHECK(got.effects[0].ledger_line == "dummy.friction_J");
  CHECK(got.effects[0].may_hold);
  CHECK(got.effects[0].limit == "none");
  REQUIRE(got.outputs.ledger.size() == 2);
  CHECK(got.outputs.ledger[1].kind == core::LedgerKind::dissipated);
  REQUIRE(got.outputs.groups.size() == 1);
  CHECK(got.outputs.groups[0].cells == sent.outputs.groups[0].cells);
  CHECK(got.outputs.groups[0].fields[0].location == core::FieldLocation::cell);
  REQUIRE(got.outputs.tables.size() == 1);
  CHECK(got.outputs.tables[0].name == "gate");
  CHECK(got.outputs.tables[0].columns == sent.outputs.tables[0].columns);
  CHECK(got.outputs.tables[0].capacity == 7);
  CHECK(got.outputs.tables[0].kind == core::TableKind::distribution);
}

TEST_CASE("a message cut short is the sender's fault, not a crash") {
  const Bytes whole = encode(PublishedSurface{.surface = {.positions = {0, 0, 0}}, .node_masses = {1}});
  for (std::size_t size = 0; size < whole.size(); ++size) {
    CHECK_THROWS_AS(decode_surface(ByteView(whole).first(size)), core::TransportError);
  }
}

TEST_CASE("errors of a participant are the same errors in the coupler") {
  const FailureContext context{
      .peer = "structure (x, pid 1)", .waited_for = "the answer to 'advance'", .window = 4};
  const core::ConfigError config(std::vector<core::Complaint>{{"a.yaml", 1, 2, "k", "is wrong"}});
  try {
    throw_failure(encode_failure(config), context);
  } catch (const core::ConfigError& error) {
    CHECK(error.complaints() == config.complaints());
  }
  const core::NumericalError numerical(
      {.what = "x is not finite", .entity = "node 3", .step = 7, .time = 0.1, .value = NAN});
  CHECK_THROWS_WITH(throw_failure(encode_failure(numerical), context), std::string(numerical.what()));
  const core::FileError full("state.part", "written", ENOSPC);
  CHECK_THROWS_AS(throw_failure(encode_failure(full), context), core::MachineError);
  CHECK_THROWS_WITH(throw_failure(encode_failure(full), context),
                    "structure (x, pid 1): 'state.part' cannot be written: No space left on device");
  CHECK_THROWS_WITH(throw_failure(encode_failure(std::runtime_error("no licence")), context),
                    Contains("structure (x, pid 1) gave up (no licence)") && Contains("window 4"));
}

TEST_CASE("a failure that does not say what it should is its sender's fault") {
  using nlohmann::json;
  const FailureContext context{.peer = "particles", .waited_for = "an answer"};
  for (const json& failure : {json{{"numerical", {{"what", "x"}}}}, json{{"numerical", 3}},
                              json{{"complaints", {{{"file", 1}}}}}, json{{"message", 5}}, json(7)}) {
    const std::vector<std::uint8_t> bytes = json::to_cbor(failure);
    CHECK_THROWS_AS(throw_failure(std::as_bytes(std::span(bytes)), context), core::TransportError);
  }
}

TEST_CASE("output values of a participant stand side by side and do not overlap") {
  core::OutputDescription description;
  description.probes.resize(2);
  description.ledger.resize(3);
  description.groups = {
      {.name = "a",
       .kind = core::CellKind::segment,
       .nodes = 4,
       .cells = {0, 1, 1, 2, 2, 3},
       .fields = {{.name = "u", .unit = "m", .components = 3},
                  {.name = "N", .unit = "N", .components = 1, .location = core::FieldLocation::cell}}}};
  description.tables = {{.name = "gate", .columns = {"time_s", "stone"}, .capacity = 4},
                        {.name = "sizes", .columns = {"count"}, .capacity = 1}};
  const OutputArrays arrays(description);
  std::vector<double> block(arrays.size());
  CHECK(arrays.size() == 2 + 3 + 12 + 12 + 3 + (1 + 8) + (1 + 1));
  const auto start = [&](std::span<double> part) { return part.data() - block.data(); };
  CHECK(start(arrays.probes(block)) == 0);
  CHECK(start(arrays.ledger(block)) == 2);
  CHECK(start(arrays.positions(block, 0)) == 5);
  CHECK(start(arrays.field(block, 0, 0)) == 17);
  CHECK(start(arrays.field(block, 0, 1)) == 29);
  CHECK(arrays.field(block, 0, 1).size() == 3);
  CHECK(&arrays.table_rows(block, 0) == block.data() + 32);
  CHECK(start(arrays.table(block, 0)) == 33);
  CHECK(arrays.table(block, 0).size() == 8);
  CHECK(&arrays.table_rows(block, 1) == block.data() + 41);
  CHECK(arrays.table(block, 1).size() == 1);
}

namespace {

PublishedSurface good_surface() {
  PublishedSurface good;
  good.surface.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  good.surface.segments = {{0, 1}, {1, 2}};
  good.surface.triangles = {{0, 1, 2}};
  good.surface.parts = {{.name = "net", .segment_end = 2, .triangle_end = 1}};
  good.node_masses = {1, 0, std::numeric_limits<double>::infinity()};
  return good;
}

Declaration good_declaration() {
  Declaration good{.program = "liar 1.0", .step = 1e-4};
  good.limits = {{.name = "bars", .seconds = 1e-3}};
  good.outputs.probes = {{"a.displacement_z_m"}};
  good.outputs.ledger = {{"a.kinetic_J", core::LedgerKind::stored}};
  good.outputs.groups = {{.name = "net", .kind = core::CellKind::segment, .nodes = 2, .cells = {0, 1}}};
  good.outputs.groups[0].fields = {{"displacement", "m", 3, core::FieldLocation::node}};
  good.outputs.tables = {{.name = "gate", .columns = {"time_s"}, .capacity = 4}};
  return good;
}

template <class Message>
struct Lie {
  const char* told;  ///< in the error
  std::function<void(Message&)> tell;
};

}  // namespace

TEST_CASE(
    "a surface that lies is refused with what is wrong, by the coupler and by the participant's own "
    "library") {
  CHECK_NOTHROW(decode_surface(encode(good_surface())));
  const std::vector<Lie<PublishedSurface>> lies{
      {"segment 1 has the node 3, but the surface has the nodes 0 to 2",
       [](auto& p) {
         p.surface.segments[1] = {1, 3};
       }},  // counted from 1
      {"triangle 0 has the node -1", [](auto& p) { p.surface.triangles[0][2] = -1; }},
      {"segment 0 has the node 1 twice",
       [](auto& p) {
         p.surface.segments[0] = {1, 1};
       }},
      {"10 coordinates; three a node", [](auto& p) { p.surface.positions.push_back(0); }},
      {"segment 0 (nodes 0 and 1) has no length", [](auto& p) { p.surface.positions[3] = 0; }},
      {"triangle 0 (nodes 0, 1, 2) has no area",
       [](auto& p) {
         p.surface.positions[6] = 2;
         p.surface.positions[7] = 0;
       }},
      {"the position of node 1 is nan", [](auto& p) { p.surface.positions[4] = std::nan(""); }},
      {"part 'net' has the segments 0 to 3, but there are 2",
       [](auto& p) { p.surface.parts[0].segment_end = 3; }},
      {"part 'net' has the triangles 1 to 0",
       [](auto& p) {
         p.surface.parts[0].triangle_begin = 1;
         p.surface.parts[0].triangle_end = 0;
       }},
      {"part 'net' has the segments -1", [](auto& p) { p.surface.parts[0].segment_begin = -1; }},
      {"the wire radius -1 m", [](auto& p) { p.surface.parts[0].wire_radius = -1; }},
      {"2 node masses for 3 nodes", [](auto& p) { p.node_masses.pop_back(); }},
      {"node 0 has the mass -1 kg", [](auto& p) { p.node_masses[0] = -1; }},
      {"node 1 has the mass nan kg", [](auto& p) { p.node_masses[1] = std::nan(""); }}};
  for (const auto& lie : lies) {
    PublishedSurface published = good_surface();
    lie.tell(published);
    CAPTURE(lie.told);
    CHECK_THROWS_WITH(validate(published), Contains(lie.told));
    CHECK_THROWS_WITH(decode_surface(encode(published), "structure (liar, pid 7)"),
                      Contains("structure (liar, pid 7) said what cannot be") && Contains(lie.told));
  }
}

TEST_CASE("a declaration that lies is refused with what is wrong") {
  CHECK_NOTHROW(decode_declaration(encode(good_declaration())));
  const auto kind = [](auto& to, int number) { to = static_cast<std::decay_t<decltype(to)>>(number); };
  const std::vector<Lie<Declaration>> lies{
      {"the step is -1 s", [](auto& d) { d.step = -1; }},
      {"the step is nan s", [](auto& d) { d.step = std::nan(""); }},
      {"the step limit 'bars' is 0 s", [](auto& d) { d.limits[0].seconds = 0; }},
      {"the step limit 'bars' is nan s", [](auto& d) { d.limits[0].seconds = std::nan(""); }},
      {"the use of forces has the unknown number 9", [&](auto& d) { kind(d.force_use, 9); }},
      {"the name of a probe is ''", [](auto& d) { d.outputs.probes[0].name = ""; }},
      {"the name of a probe is 'a,b'", [](auto& d) { d.outputs.probes[0].name = "a,b"; }},
      {"the name 'time_s' is that of the table's own first column",
       [](auto& d) { d.outputs.probes[0].name = "time_s"; }},
      {"the name 'a.kinetic_J' is given twice", [](auto& d) { d.outputs.probes[0].name = "a.kinetic_J"; }},
      {"ledger line 'a.kinetic_J' has the unknown kind 7",
       [&](auto& d) { kind(d.outputs.ledger[0].kind, 7); }},
      {"group 'net' has the unknown kind 0", [&](auto& d) { kind(d.outputs.groups[0].kind, 0); }},
      {"the name of a group of field output is '../../etc'",
       [](auto& d) { d.outputs.groups[0].name = "../../etc"; }},
      {"group 'net' has -1 nodes", [](auto& d) { d.outputs.groups[0].nodes = -1; }},
      {"group 'net' has 3 node numbers for cells of 2 nodes",
       [](auto& d) { d.outputs.groups[0].cells.push_back(0); }},
      {"a cell of group 'net' has the node 2, but there are 2",
       [](auto& d) { d.outputs.groups[0].cells[1] = 2; }},
      {"field 'displacement' of group 'net' has 0 components",
       [](auto& d) { d.outputs.groups[0].fields[0].components = 0; }},
      {"field 'displacement' has the unknown kind 5",
       [&](auto& d) { kind(d.outputs.groups[0].fields[0].location, 5); }},
      {"the name of a table is '../gate'", [](auto& d) { d.outputs.tables[0].name = "../gate"; }},
      {"table 'gate' has no columns", [](auto& d) { d.outputs.tables[0].columns.clear(); }},
      {"table 'gate' is to hold -4 rows", [](auto& d) { d.outputs.tables[0].capacity = -4; }},
      {"table 'gate' is to hold 4611686018427387904 rows",
       [](auto& d) { d.outputs.tables[0].capacity = std::int64_t{1} << 62; }}};
  for (const auto& lie : lies) {
    Declaration declaration = good_declaration();
    lie.tell(declaration);
    CAPTURE(lie.told);
    CHECK_THROWS_WITH(validate(declaration), Contains(lie.told));
    CHECK_THROWS_WITH(decode_declaration(encode(declaration), "structure (liar, pid 7)"),
                      Contains("structure (liar, pid 7) said what cannot be") && Contains(lie.told));
  }
}
