#include "coupler/explain/facts.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/errors.hpp"
#include "core/output/result_writer.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/moving_net.hpp"

namespace talus::explain {
namespace {

/// A sheet of one triangle in pure shear of 300 Pa, which is 300 Pa of tension and of compression.
class ShearedSheet final : public core::OutputSource {
 public:
  ShearedSheet() {
    core::GroupDescription sheet{
        .name = "sheet", .kind = core::CellKind::triangle, .nodes = 3, .cells = {0, 1, 2}, .fields = {}};
    for (const char* name : {"stress_xx", "stress_yy", "stress_xy", "wrinkle_state"})
      sheet.fields.push_back({name, "Pa", 1, core::FieldLocation::cell});
    description_.groups = {sheet};
  }
  double turned = 0;  ///< rad; of the axes against those of the shear
  double state = 0;

  const core::OutputDescription& description() const override { return description_; }
  void fill_probes(std::span<double>) const override {}
  void fill_ledger(std::span<double>) const override {}
  void fill_positions(std::size_t, std::span<double> positions) const override {
    std::ranges::fill(positions, 0.0);
  }
  void fill_field(std::size_t, std::size_t field, std::span<double> values) const override {
    const double along = 300 * std::sin(2 * turned), shear = 300 * std::cos(2 * turned);
    const double fields[] = {100 + along, 100 - along, shear, state};
    values[0] = fields[field];
  }

 private:
  core::OutputDescription description_;
};

}  // namespace

TEST_CASE("the facts of a result are the largest stresses of all frames, in any axes") {
  test::Folder folder("explain");
  test::MovingNet net(4, "wires");
  ShearedSheet sheet;
  {
    core::ResultWriter writer({.folder = folder / "result", .frame_capacity = 2}, {&net, &sheet});
    for (const double time : {0.0, 1.0}) {
      net.frame = time;
      net.kinetic = 40 * time;
      net.damping = 5 * time;
      net.gravity = 45 * time;
      sheet.turned = 0.7 * time;
      sheet.state = time;
      writer.write_row(time);
      writer.write_fields(time);
    }
    writer.finish(core::RunStatus::finished);
  }
  const ResultFacts facts = read_facts(folder / "result");
  CHECK(facts.impact() == 45);  // what was supplied, which is more than the kinetic energy
  CHECK(facts.largest("wires.damping_J") == 5);
  CHECK_FALSE(facts.largest("no such line"));
  REQUIRE(facts.parts.size() == 2);
  const PartFacts &triangle = facts.parts[0], &wires = facts.parts[1];
  CHECK(triangle.name == "sheet");
  CHECK(triangle.tension == Approx(400));  // the mean of 100 Pa and the shear of 300 Pa
  CHECK(triangle.compression == Approx(200));
  CHECK(triangle.gave_way == true);
  CHECK(triangle.frames == 2);
  CHECK_FALSE(wires.gave_way);   // nothing tells
  CHECK(wires.tension == 2001);  // 2000 and the frame's number
  CHECK(wires.compression == 0);
}

TEST_CASE("a folder without a result is told by its name") {
  test::Folder folder("explain_nothing");
  CHECK_THROWS_WITH(read_facts(folder.path()), Catch::Contains("holds no result"));
}

}  // namespace talus::explain
