#include "coupler/barrier/type_test.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>
#include <fstream>
#include <numbers>
#include <optional>

#include "core/errors.hpp"
#include "core/output/file.hpp"
#include "core/program/command_line.hpp"
#include "core/program/stop.hpp"
#include "coupler/barrier/measures.hpp"
#include "coupler/barrier/rules.hpp"
#include "coupler/barrier/scene_text.hpp"
#include "coupler/launch/find_solver.hpp"
#include "coupler/study/child_run.hpp"

namespace talus::barrier {

namespace {

namespace fs = std::filesystem;
using core::Vector3;
using nlohmann::json;

constexpr double rest_time = 1e-3;  // s; of stages that only come to rest
/// Crumpled nets come to rest slowly. What is left over, of the largest force, moves them by less than 1e-6 of the block's energy.
constexpr double left_over_at_rest = 3e-4;
constexpr int most_steps_to_rest = 1000000;

json as_json(const Vector3& p) {
  return {p.x(), p.y(), p.z()};
}
json as_json(std::span<const Vector3> points) {
  json list = json::array();
  for (const Vector3& p : points) list.push_back(as_json(p));
  return list;
}

/// The user has asked to stop.
struct Stopped {};

class Course {
 public:
  explicit Course(const TypeTest& test) : test_(test), layout_(layout_of(test.loaded.sheet)) {}

  json run() {
    std::error_code error;
    if (fs::create_directories(test_.folder, error); error)
      throw core::FileError(test_.folder, "created", error.value());
    if (!rest("settle", "The barrier comes to rest under its weight.", "{relaxation: {}}"))
      throw core::ConfigError(fmt::format("the barrier does not come to rest under its weight: {} ({})",
                                          study::last_line(log_of("settle")), log_of("settle").string()));
    if (test_.impacts.contains("sel")) service_impacts();
    if (test_.impacts.contains("mel")) impact("mel", "MEL", "settle", test_.loaded.sheet.block.mass);
    return report();
  }

 private:
  fs::path folder_of(const std::string& name) const { return test_.folder / name; }
  fs::path log_of(const std::string& name) const { return test_.folder / (name + ".log"); }
  static std::string after(const std::string& stage) {
    return fmt::format("{{after: {{state: {}/structure_state.h5, steps: {}, tolerance: {}}}}}", stage,
                       most_steps_to_rest, left_over_at_rest);
  }

  /// Writes the scene of a stage and runs it. @returns whether it finished
  bool run_stage(const std::string& name, const BarrierSheet& sheet, const Layout& layout,
                 const Stage& what) {
    const LoadedSheet own{.title = fmt::format("{}: {}", test_.loaded.title, name), .sheet = sheet};
    const fs::path scene = test_.folder / (name + ".yaml");
    core::replace_file(scene, stage_text(own, layout, what));
    test_.tell(fmt::format("{:<11} {}", name, what.purpose));
    std::vector<std::string> command;
    if (what.has_block)
      command = {coupler::launch::own_solver("talus").string(), "run"};
    else
      command = {coupler::launch::own_solver("fem_solver").string()};
    command.insert(command.end(), {scene.string(), "--out", folder_of(name).string(), "--overwrite"});
    const study::ChildEnd end = study::run_child(command, log_of(name), test_.time_limit);
    if (end.reason == study::ChildEnd::Reason::stop_requested) throw Stopped{};
    const bool finished = end.reason == study::ChildEnd::Reason::exited && end.code == 0;
    test_.tell(fmt::format("{:<11} {} after {:.1f} s", "", finished ? "done" : "failed", end.seconds));
    return finished;
  }

  /// A stage without the block.
  bool rest(const std::string& name, const std::string& purpose, const std::string& start) {
    return run_stage(name, test_.loaded.sheet, layout_,
                     {.purpose = purpose, .start = start, .has_block = false, .end = rest_time});
  }

  /// The block begins its own reach above the net as a stage has left it, so that it meets it with its speed.
  bool impact(const std::string& name, const std::string& title, const std::string& before, double mass) {
    BarrierSheet sheet = test_.loaded.sheet;
    sheet.block.mass = mass;
    Layout layout = layout_of(sheet);
    layout.block_centre.y() =
        net_reaches(folder_of(before), layout) + reach_of_block * layout.block_edge + sheet.block.distance;
    const bool ran =
        run_stage(name, sheet, layout,
                  {.purpose = fmt::format("{:.4g} kg at {:.4g} m/s into the barrier as '{}' has left it.",
                                          mass, sheet.block.speed, before),
                   .start = after(before),
                   .has_block = true,
                   .end = sheet.test.time});
    json data =
        ran ? measured(folder_of(name), sheet, layout) : json{{"finished", false}, {"block_mass_kg", mass}};
    data["why_not"] = ran ? json(nullptr) : json(study::last_line(log_of(name)));
    data["name"] = name;
    data["title"] = title;
    data["folder"] = name;
    tests_[name] = data;
    return ran;
  }

  void service_impacts() {
    const double mass = test_.loaded.sheet.block.mass / 3;
    if (impact("sel_1", "SEL, first impact", "settle", mass) &&
        rest("sel_1_rest", "The block is taken out, the barrier comes to rest.", after("sel_1")))
      impact("sel_2", "SEL, second impact without repair", "sel_1_rest", mass);
  }

  json layout_data() const;
  json envelope() const;
  json report() const;

  const TypeTest& test_;
  Layout layout_;
  Tests tests_;
};

json Course::layout_data() const {
  constexpr double degrees = 180 / std::numbers::pi;
  const Layout& l = layout_;
  const PostSheet& posts = test_.loaded.sheet.posts;
  return {{"feet", as_json(l.feet)},
          {"heads", as_json(l.heads)},
          {"retaining_anchors", as_json(l.retaining_anchors)},
          {"lateral_anchors", as_json(l.lateral_anchor)},
          {"upper_anchors", as_json(l.upper_anchor)},
          {"lower_anchors", as_json(l.lower_anchor)},
          {"upper_ends", as_json(l.upper_end)},
          {"lower_ends", as_json(l.lower_end)},
          {"net",
           {{"corner", as_json(l.net_corner)},
            {"up", as_json(l.up_the_post)},
            {"length", l.net_length},
            {"height", l.net_height}}},
          {"hit", as_json(l.hit)},
          {"block_centre", as_json(l.block_centre)},
          {"spacing", posts.spacing},
          {"post_length", posts.length},
          {"lean_deg", posts.lean * degrees},
          {"retaining_angle_deg", l.retaining_angle * degrees}};
}

/// Of every part the impact that used it most.
json Course::envelope() const {
  json rows = json::array();
  for (const auto& [name, test] : tests_) {
    if (!test.contains("forces")) continue;
    for (const json& row : test.at("forces")) {
      const auto same = std::find_if(rows.begin(), rows.end(),
                                     [&](const json& known) { return known.at("part") == row.at("part"); });
      if (same != rows.end() && same->at("force_N") >= row.at("force_N")) continue;
      json entry{{"test", name}};
      for (const char* key : {"part", "kind", "force_N", "limit_N", "utilisation"}) entry[key] = row.at(key);
      if (same != rows.end())
        *same = entry;
      else
        rows.push_back(entry);
    }
  }
  return rows;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  constexpr std::string_view mark = "default, verify: ";
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string line = text.substr(begin, end - begin);
    if (const auto found = line.find(mark); found != std::string::npos) line.erase(0, found + mark.size());
    if (!line.empty()) lines.push_back(line);
    begin = end + 1;
  }
  return lines;
}

json Course::report() const {
  const BarrierSheet& sheet = test_.loaded.sheet;
  const auto energy = [&](double mass) { return 0.5e-3 * mass * sheet.block.speed * sheet.block.speed; };
  const double mel = energy(sheet.block.mass);
  const int number = energy_class(mel);
  const auto left =
      tests_.contains("mel") ? tests_.at("mel").value("residual_share", json(nullptr)) : json(nullptr);
  json data{{"title", test_.loaded.title},
            {"sheet_file", test_.sheet_file},
            {"version", "talus " + core::version()},
            {"written", fmt::format("{:%Y-%m-%d}", fmt::localtime(std::time(nullptr)))},
            {"slope_deg", sheet.slope * 180 / std::numbers::pi},
            {"class",
             {{"mel_kJ", mel},
              {"mel_class", number >= 0 ? json(number) : json(nullptr)},
              {"sel_kJ", energy(sheet.block.mass / 3)},
              {"category", left.is_number() ? json(category(left.get<double>())) : json(nullptr)}}},
            {"block",
             {{"mass_kg", sheet.block.mass},
              {"edge_m", layout_.block_edge},
              {"density_kg_per_m3", sheet.block.density},
              {"speed_m_per_s", sheet.block.speed},
              {"energy_kJ", mel},
              {"form", sheet.block.form == BlockSheet::Form::eota_221 ? "eota_221" : "eota_111"}}},
            {"layout", layout_data()},
            {"rules", rules_of(tests_, sheet)},
            {"tests", json::array()},
            {"envelope", envelope()},
            {"assumptions", lines_of(assumptions(sheet))}};
  for (const char* name : {"sel_1", "sel_2", "mel"})
    if (tests_.contains(name)) data["tests"].push_back(tests_.at(name));
  data["not_covered"] = {"spans, post spacings, slopes and post lengths other than those of the sheet",
                         "hits beside the middle, on posts and on ropes, spinning blocks and other forms, "
                         "unless the sheet names them",
                         "openings beside posts and between net and ground",
                         "failure of wires of the net, of shackles and of foundations: their forces are "
                         "given, their strength is not known here",
                         "ground: nothing of the barrier or the block is stopped by it; the clearance says "
                         "whether it was reached"};
  data["how_sure"] = {
      "the balance of energy of each impact stands among the rules; it tells errors of the step, not of the "
      "model",
      "step, mesh and contact stiffness were not varied for this barrier; docs/barriers.md has what D1000 "
      "changes by",
      "components are taken from tables; no full-scale test was compared"};
  return data;
}

}  // namespace

std::optional<json> run_type_test(const TypeTest& test) {
  try {
    return Course(test).run();
  } catch (const Stopped&) {
    return std::nullopt;
  }
}

}  // namespace talus::barrier
