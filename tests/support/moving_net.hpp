#pragma once

#include <cmath>
#include <string>

#include "core/output/source.hpp"

namespace talus::test {

/// A source of results whose every value follows from the frame's number, so that a reader can tell a
/// complete frame from a torn one.
class MovingNet final : public core::OutputSource {
 public:
  explicit MovingNet(std::int64_t nodes = 5, const std::string& name = "net") : nodes_(nodes) {
    description_.probes = {{name + ".height_m"}, {name + ".speed_m_per_s"}};
    description_.ledger = {{name + ".kinetic_J", core::LedgerKind::stored},
                           {name + ".damping_J", core::LedgerKind::dissipated},
                           {name + ".gravity_J", core::LedgerKind::supplied}};
    core::GroupDescription group{
        .name = name, .kind = core::CellKind::segment, .nodes = nodes, .cells = {}, .fields = {}};
    for (std::int64_t i = 0; i + 1 < nodes; ++i) group.cells.insert(group.cells.end(), {i, i + 1});
    group.fields = {{"displacement", "m", 3, core::FieldLocation::node},
                    {"axial_force", "N", 1, core::FieldLocation::cell}};
    description_.groups = {group};
  }

  double frame = 0;
  double height = 0, kinetic = 0, damping = 0, gravity = 0;

  const core::OutputDescription& description() const override { return description_; }
  void fill_probes(std::span<double> values) const override {
    values[0] = height;
    values[1] = frame;
  }
  void fill_ledger(std::span<double> joules) const override {
    joules[0] = kinetic;
    joules[1] = damping;
    joules[2] = gravity;
  }
  void fill_positions(std::size_t, std::span<double> positions) const override {
    for (std::size_t i = 0; i < positions.size(); ++i) positions[i] = frame + static_cast<double>(i);
  }
  void fill_field(std::size_t, std::size_t field, std::span<double> values) const override {
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = 1000 * static_cast<double>(field + 1) + frame;
  }
  std::int64_t nodes() const { return nodes_; }

 private:
  std::int64_t nodes_;
  core::OutputDescription description_;
};

}  // namespace talus::test
