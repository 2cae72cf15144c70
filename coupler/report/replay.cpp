#include "coupler/report/replay.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/output/field_reader.hpp"
#include "coupler/report/colours.hpp"
#include "coupler/report/doubles.hpp"
#include "coupler/report/drawing.hpp"
#include "coupler/report/instants.hpp"
#include "coupler/report/packed.hpp"

namespace talus::report {

namespace {

using core::FieldReader;
using core::GroupDescription;
using nlohmann::json;

constexpr std::int64_t fewest_frames = 24;  // before cells are left out for more
constexpr int fine = 65535;                 // steps of a position

/// Bytes of text for so many bytes of numbers.
std::int64_t in_base64(std::int64_t bytes) {
  return bytes * 4 / 3;
}

struct Cost {
  std::int64_t once = 0, each_frame = 0;  ///< bytes
  std::int64_t frames(std::int64_t budget) const {
    return each_frame > 0 ? (budget - once) / each_frame : most_frames;
  }
};

Cost cost_of(const std::vector<Drawing>& drawings) {
  Cost cost;
  for (const Drawing& drawing : drawings) {
    cost.once += in_base64(std::ssize(drawing.cells) * (drawing.nodes.size() > fine ? 4 : 2));
    if (has_field(*drawing.group, "radius")) cost.once += in_base64(std::ssize(drawing.nodes) * 4);
    cost.each_frame += in_base64(std::ssize(drawing.nodes) * 6);
    if (is_coloured(*drawing.group)) cost.each_frame += in_base64(drawing.cell_count());
  }
  return cost;
}

/// As many cells as leave room for so many frames.
std::vector<Drawing> affordable_drawings(const std::vector<const GroupDescription*>& groups,
                                         std::int64_t frames, std::int64_t budget) {
  std::int64_t most_cells = 1;
  for (const auto* group : groups) most_cells = std::max(most_cells, group->cell_count());
  for (;; most_cells = most_cells * 4 / 5) {
    std::vector<Drawing> drawings;
    for (const auto* group : groups) drawings.push_back(drawing_of(*group, most_cells));
    if (most_cells < 10 || cost_of(drawings).frames(budget) >= frames) return drawings;
  }
}

/// Positions of all frames in steps of the group's own box. A group that does not move is stored once.
void add_positions(json& result, const FieldReader& fields, const Drawing& drawing,
                   const std::vector<std::int64_t>& frames) {
  std::vector<std::vector<double>> positions;
  std::array<Range, 3> box = empty_box;
  for (const auto frame : frames) {
    positions.push_back(at_nodes(drawing, fields.read(*drawing.group, "position", frame), 3));
    for (std::size_t i = 0; i < positions.back().size(); ++i) box[i % 3].take(positions.back()[i]);
  }
  if (std::ranges::all_of(positions, [&](const auto& frame) { return frame == positions.front(); }))
    positions.resize(1);
  std::vector<std::uint16_t> numbers;
  for (const auto& frame : positions)
    for (std::size_t i = 0; i < frame.size(); ++i)
      numbers.push_back(static_cast<std::uint16_t>(quantised(frame[i], box[i % 3], fine)));
  for (const Range& range : box) {
    result["low"].push_back(drawing.nodes.empty() ? 0 : range.low);
    result["step"].push_back(drawing.nodes.empty() ? 0 : range.step(fine));
  }
  result["moves"] = positions.size() > 1;
  result["positions"] = packed(numbers);
}

void add_cells(json& result, const Drawing& drawing) {
  const std::vector<std::uint16_t> narrow(drawing.cells.begin(), drawing.cells.end());
  const bool wide = drawing.nodes.size() > fine;
  result["wide"] = wide;
  result["cells"] = wide ? packed(drawing.cells) : packed(narrow);
}

json drawn_group(const FieldReader& fields, const Drawing& drawing, const std::vector<std::int64_t>& frames) {
  const GroupDescription& group = *drawing.group;
  json result{{"name", group.name},
              {"kind", static_cast<int>(group.kind)},
              {"structure", has_field(group, "displacement")},
              {"stride", drawing.stride},
              {"nodes", drawing.nodes.size()}};
  add_cells(result, drawing);
  add_positions(result, fields, drawing, frames);
  if (has_field(group, "radius")) {
    const auto radii = at_nodes(drawing, fields.read(group, "radius", frames.front()), 1);
    result["radii"] = packed(std::vector<float>(radii.begin(), radii.end()));
  }
  return result;
}

json place_in(const std::vector<std::int64_t>& frames, std::optional<std::int64_t> frame) {
  if (!frame) return nullptr;
  return std::ranges::lower_bound(frames, *frame) - frames.begin();
}

json replay_of(const FieldReader& fields, std::int64_t budget) {
  const auto lying_on = doubles(fields);
  std::vector<const GroupDescription*> groups;
  for (const auto& group : fields.groups())
    if (!lying_on.contains(group.name)) groups.push_back(&group);
  const Instants instants = instants_of(fields);
  const auto drawings = affordable_drawings(groups, std::min(fields.frames(), fewest_frames), budget);
  const std::int64_t most = std::clamp<std::int64_t>(cost_of(drawings).frames(budget), 4, most_frames);
  const auto frames = chosen_frames(fields.frames(), most, instants);
  json result{{"of", fields.frames()},
              {"frames", frames},
              {"times", json::array()},
              {"peak", place_in(frames, instants.peak)},
              {"contact", place_in(frames, instants.contact)},
              {"doubles", lying_on},
              {"groups", json::array()}};
  for (const auto frame : frames) result["times"].push_back(fields.times()[static_cast<std::size_t>(frame)]);
  for (const Drawing& drawing : drawings) result["groups"].push_back(drawn_group(fields, drawing, frames));
  result["colours"] = add_colours(result["groups"], fields, drawings, frames);
  return result;
}

}  // namespace

json replay(const std::filesystem::path& file, std::int64_t budget) {
  const auto nothing = [](const char* why) {
    return json{{"lacks", why}, {"times", json::array()}, {"groups", json::array()}};
  };
  if (!std::filesystem::exists(file))
    return nothing("the result has no fields.h5: its scene names no output.fields_every");
  const FieldReader fields(file);
  if (fields.frames() == 0) return nothing("no frame of the fields was written yet");
  json result = replay_of(fields, budget);
  if (fields.frames() == 1) result["lacks"] = "the fields hold one frame only, which does not move";
  return result;
}

}  // namespace talus::report
