#include "coupler/messages/messages.hpp"

#include <catch2/catch.hpp>

#include "core/errors.hpp"
#include "coupler/messages/output_arrays.hpp"

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
  const Declaration got = decode_declaration(encode(sent));
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
